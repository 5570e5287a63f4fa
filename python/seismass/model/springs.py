"""The numbers of a storey's spring: one table of name, default, unit, meaning and range.

`Building`, the call of the kernel, scene files, grids and digests of inputs read it. A new number is one entry here,
one in the extension module, and one declared attribute of `Building`.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, Any, Final, Literal, TypeAlias, TypedDict, TypeGuard, TypeVar, get_args, get_type_hints

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seismass import _kernel
from seismass.base.arguments import as_word
from seismass.base.errors import InvalidScene
from seismass.base.values import FloatArray, as_array, brief, frozen, is_list, refusal

DEFAULT_OVERSTRENGTH: Final = _kernel.DEFAULT_OVERSTRENGTH
"""Overstrength Omega, of the paper's section 4."""
DEFAULT_SECOND_SLOPE: Final = _kernel.DEFAULT_SECOND_SLOPE
"""Second slope r2 over the first: an inference from what the paper says of its results, not its number."""
DEFAULT_THIRD_SLOPE: Final = _kernel.DEFAULT_THIRD_SLOPE
"""Third slope r3 over the first: an inference, as r2."""

_Function = TypeVar("_Function", bound=Callable[..., Any])


Hysteresis: TypeAlias = Literal["masing", "peak-oriented", "flag-shaped"]
"""Masing's rules, straight to the largest drift so far (Clough and Johnston 1966), or self-centring (Christopoulos,
Filiatrault and Folz 2002)."""
HYSTERESES: Final[tuple[Hysteresis, ...]] = get_args(Hysteresis)

Part: TypeAlias = Literal["trilinear", "stop", Hysteresis]
"""What a storey's spring may have: a trilinear backbone, a stop on each side, a hysteresis."""
TRILINEAR: Final[frozenset[Hysteresis]] = frozenset({"masing", "peak-oriented"})
"""The hystereses that have a trilinear backbone where no other is given."""


@dataclass(frozen=True)
class SpringField:
    """A number that every storey's spring has: default, unit, symbol, meaning, range (both ends included), and the
    parts of a spring (trilinear backbone, stop, hysteresis; any) without which it has no effect.
    """

    default: float
    unit: str
    symbol: str
    meaning: str
    requirement: str
    low: float
    high: float
    parts: tuple[Part, ...] = ()

    def accepts(self, values: FloatArray | float) -> NDArray[np.bool_]:
        """Return which values are in the range."""
        return np.asarray((self.low <= values) & (values <= self.high))

    def matters(self, present: AbstractSet[Part]) -> bool:
        """Return whether it matters for springs that have these parts."""
        return not self.parts or any(part in present for part in self.parts)


_TINY: Final = float(np.nextafter(0.0, 1.0))
_BELOW_ONE: Final = float(np.nextafter(1.0, 0.0))
_HUGE: Final = float(np.finfo(np.float64).max)


class SpringShape(TypedDict, total=False):
    """What shapes a spring beside its stiffness and strength: numbers for all storeys, or lists with storey 1 first."""

    overstrength: Annotated[
        ArrayLike,
        SpringField(
            DEFAULT_OVERSTRENGTH,
            "",
            "Omega",
            "Omega >= 1: the second yield is at Omega V_y.",
            "finite and at least 1",
            1.0,
            _HUGE,
            ("trilinear",),
        ),
    ]
    second_slope: Annotated[
        ArrayLike,
        SpringField(
            DEFAULT_SECOND_SLOPE,
            "",
            "r2",
            "Slope r2 after the first yield over the initial one, 0 <= r2 <= 1.",
            "between 0 and 1",
            0.0,
            1.0,
            ("trilinear", "flag-shaped"),
        ),
    ]
    third_slope: Annotated[
        ArrayLike,
        SpringField(
            DEFAULT_THIRD_SLOPE,
            "",
            "r3",
            "Slope r3 after the second yield over the initial one, 0 <= r3 <= r2; peak-oriented: -1 <= r3 <= r2.",
            "between -1 and 1",
            -1.0,
            1.0,
            ("trilinear",),
        ),
    ]
    clearance: Annotated[
        ArrayLike,
        SpringField(
            np.inf,
            "m",
            "clearance",
            "Clearance to either side (m), beyond which an elastic stop acts beside the spring; infinite: no stop.",
            "positive (infinite: no stop)",
            _TINY,
            np.inf,
        ),
    ]
    stop_stiffness: Annotated[
        ArrayLike,
        SpringField(
            0.0,
            "N/m",
            "k_stop",
            "Stiffness of a stop (N/m); needed where there is a clearance.",
            "finite and not negative",
            0.0,
            _HUGE,
            ("stop",),
        ),
    ]
    unloading_exponent: Annotated[
        ArrayLike,
        SpringField(
            0.0,
            "",
            "a",
            "Exponent a of the unloading stiffness k (d_y/d_max)^a of peak-oriented hysteresis, 0 <= a < 1.",
            "at least 0 and below 1",
            0.0,
            _BELOW_ONE,
            ("peak-oriented",),
        ),
    ]
    energy_capacity: Annotated[
        ArrayLike,
        SpringField(
            np.inf,
            "",
            "lambda",
            "Energy that a peak-oriented storey can dissipate over V_y d_y; infinite: no cyclic loss of strength.",
            "positive (infinite: no cyclic loss)",
            _TINY,
            np.inf,
            ("peak-oriented",),
        ),
    ]
    residual_strength: Annotated[
        ArrayLike,
        SpringField(
            0.0,
            "",
            "residual",
            "Strength over V_y below which that of a peak-oriented storey does not fall, 0 to 1.",
            "between 0 and 1",
            0.0,
            1.0,
            ("peak-oriented",),
        ),
    ]
    flag_height: Annotated[
        ArrayLike,
        SpringField(
            1.0,
            "",
            "beta",
            "Height beta of flag-shaped hysteresis over V_y, 0 to 1: how far unloading falls with slope k; 0: no loss.",
            "between 0 and 1",
            0.0,
            1.0,
            ("flag-shaped",),
        ),
    ]


class SpringArguments(SpringShape, total=False):
    """What a spring has beside its stiffness."""

    yield_shear: Annotated[
        ArrayLike,
        SpringField(
            np.inf,
            "N",
            "V_y",
            "First yield shear V_y of each storey (N); infinite: the storey stays elastic.",
            "positive (infinite: elastic)",
            _TINY,
            np.inf,
        ),
    ]


def _fields(table: type) -> dict[str, SpringField]:
    return {name: get_args(hint)[1] for name, hint in get_type_hints(table, include_extras=True).items()}


SHAPE_FIELDS: Final = _fields(SpringShape)
"""Numbers that shape a spring, by the name of their argument."""
SPRING_FIELDS: Final = {"yield_shear": _fields(SpringArguments)["yield_shear"], **SHAPE_FIELDS}
"""All numbers of a spring beside its stiffness, by the name of their argument."""


@lru_cache(maxsize=1024)
def default_values(name: str, storeys: int) -> FloatArray:
    """Return the default of each storey: one array for all buildings of so many storeys."""
    return frozen(np.full(storeys, SPRING_FIELDS[name].default))


def is_default(values: Any, name: str) -> TypeGuard[FloatArray]:
    """Return whether values are the array of defaults itself; others may equal it."""
    if name not in SPRING_FIELDS or not isinstance(values, np.ndarray) or values.ndim != 1:
        return False
    return values is default_values(name, len(values))


def checked_names(parameters: dict[str, Any], known: dict[str, SpringField], owner: str) -> None:
    """Refuse an unknown keyword argument, as Python does."""
    for name in parameters:
        if name not in known:
            raise TypeError(f"{owner}() got an unexpected keyword argument {name!r}")


def takes_springs(fields: dict[str, SpringField], **instead: Any) -> Callable[[_Function], _Function]:
    """Return a decorator for a function whose `**` argument takes some of the fields: its signature names each of them.
    `instead` replaces the default of a field for that function.
    """

    def decorate(function: _Function) -> _Function:
        signature = inspect.signature(function)
        (rest,) = (item for item in signature.parameters.values() if item.kind is inspect.Parameter.VAR_KEYWORD)
        named = [
            inspect.Parameter(
                name,
                inspect.Parameter.KEYWORD_ONLY,
                default=instead.get("default", field.default),
                annotation="ArrayLike",
            )
            for name, field in fields.items()
        ]
        others = [item for item in signature.parameters.values() if item is not rest]
        changed = signature.replace(parameters=[*others, *named])
        function.__signature__ = changed  # type: ignore[attr-defined]
        return function

    return decorate


def documented(doc: str | None, fields: dict[str, SpringField]) -> str | None:
    """Return a docstring with the line `{springs}` in its list of parameters replaced by an entry for each field."""
    if doc is None:  # python -OO
        return None
    entries = []
    for name, field in fields.items():
        entries.append(f"{name} : array_like, default {field.default:g}\n    {field.meaning}")
    return inspect.cleandoc(doc).replace("{springs}", "\n".join(entries))


Backbone: TypeAlias = tuple[tuple[float, float], ...]
"""Points of drift (m) and force (N) beyond the origin, in order."""
BackboneLike: TypeAlias = ArrayLike | Sequence[ArrayLike | None]
"""Points for every storey, or a list with those of each storey, None where it has none."""

_NAMES: Final[dict[Part, str]] = {"trilinear": "a trilinear backbone", "stop": "a clearance"}
"""Names in errors of parts other than a hysteresis."""
_SAME: Final = 1e-9
"""Relative difference up to which a stiffness or strength is that of a backbone."""


def listed_storeys(backbone: Any, hysteresis: Any) -> Iterator[int]:
    """Yield the number of storeys of each of the two that has one value per storey."""
    if backbone is not None and is_per_storey(backbone):
        yield len(backbone)
    if not isinstance(hysteresis, str) and isinstance(hysteresis, Sequence):
        yield len(hysteresis)


def is_per_storey(backbone: Any) -> bool:
    """Return whether a backbone is a list with one per storey, not one for all."""
    return is_list(backbone) and any(
        item is None or (isinstance(item, Sequence | np.ndarray) and _dimensions(item) == 2) for item in backbone
    )


def read_backbones(value: Any, storeys: int) -> tuple[Backbone | None, ...] | None:
    """Return the backbone of each storey, or None where no storey has one."""
    if value is None:
        return None
    listed = list(value) if is_per_storey(value) else [value] * storeys
    if len(listed) != storeys:
        requirement = f"one list of points or a list of {storeys} of them, one per storey"
        raise refusal(InvalidScene, "backbone", "building", requirement, f"{len(listed)} of them")
    backbones = tuple(
        None if points is None else _points(points, f"storey {number}") for number, points in enumerate(listed, start=1)
    )
    return None if all(points is None for points in backbones) else backbones


def _points(value: Any, owner: str) -> Backbone:
    requirement = "a list of points, pairs of drift and force"
    if isinstance(value, Sequence) and len(value) == 0:
        raise refusal(InvalidScene, "backbone", owner, requirement, "none")
    points = as_array(value, "backbone", owner, InvalidScene, dimensions=2)
    if points.shape[1] != 2:
        raise refusal(InvalidScene, "backbone", owner, requirement, f"{points.shape[1]} numbers in each")
    return tuple((drift, force) for drift, force in points.tolist())


def _dimensions(value: Any) -> int:
    try:
        return int(np.ndim(value))
    except ValueError:  # lists of different lengths
        return -1


def read_hysteresis(value: Any, storeys: int) -> tuple[Hysteresis, ...]:
    """Return the hysteresis of each storey."""
    listed: list[Any] = [value] * storeys if isinstance(value, str) or not isinstance(value, Sequence) else list(value)
    if len(listed) != storeys:
        requirement = f"one name or a list of {storeys}, one per storey"
        raise refusal(InvalidScene, "hysteresis", "building", requirement, f"{len(listed)} of them")
    return tuple(as_word(item, HYSTERESES, "hysteresis", "building", InvalidScene) for item in listed)


def of_first_segment(array: FloatArray, name: str, backbones: tuple[Backbone | None, ...]) -> FloatArray:
    """Return stiffnesses or yield shears, taken from the backbones where they are not given (NaN, or one number for the
    storeys without a backbone); both must agree where both are given.
    """
    values = np.array(np.broadcast_to(array, len(backbones)))
    for i, points in enumerate(backbones):
        if points is None:
            continue
        drift, force = points[0]
        with np.errstate(divide="ignore", invalid="ignore"):
            implied = (
                float(np.float64(force) / drift) if name == "stiffness" else (force if len(points) > 1 else np.inf)
            )
        if array.ndim == 0 or np.isnan(values[i]) or np.isclose(values[i], implied, rtol=_SAME, atol=0.0):
            values[i] = implied
    return frozen(values)


def check_parts(
    springs: dict[str, FloatArray],
    backbones: tuple[Backbone | None, ...] | None,
    hysteresis: tuple[Hysteresis, ...],
) -> None:
    """Refuse numbers of what no storey has; those that are left out are the defaults."""
    has = parts(springs, backbones, hysteresis)
    for name, values in springs.items():
        field = SPRING_FIELDS.get(name)
        if field is None or field.matters(has) or (values == field.default).all():
            continue
        missing = " or ".join(_NAMES.get(part, f"{part} hysteresis") for part in field.parts)
        requirement = f"left out where no storey has {missing}"
        raise refusal(InvalidScene, name, "building", requirement, brief(values.tolist()))


def parts(
    springs: dict[str, FloatArray],
    backbones: tuple[Backbone | None, ...] | None,
    hysteresis: tuple[Hysteresis, ...],
) -> set[Part]:
    """Return what the springs of a building have of what may be absent."""
    kinds: set[Part] = {name for name in hysteresis if name != "masing"}
    listed = backbones or [None] * len(hysteresis)
    if any(points is None and name in TRILINEAR for points, name in zip(listed, hysteresis, strict=True)):
        kinds.add("trilinear")
    if "clearance" in springs and (springs["clearance"] < np.inf).any():
        kinds.add("stop")
    return kinds


def without_implied(values: FloatArray, backbones: tuple[Backbone | None, ...]) -> FloatArray:
    """Return stiffnesses or yield shears with NaN, not given, where a storey has a backbone."""
    return np.where([points is not None for points in backbones], np.nan, values)
