"""Laws of storey springs beside their numbers: backbones through points and kinds of hysteresis, read per storey."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidScene
from seismass.base.values import FloatArray, as_array, brief, frozen, is_one_of, refusal
from seismass.model.springs import HYSTERESES, SPRING_FIELDS, TRILINEAR, Hysteresis, Part

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
    return isinstance(backbone, Sequence | np.ndarray) and any(
        item is None or (isinstance(item, Sequence | np.ndarray) and _dimensions(item) == 2) for item in backbone
    )


def read_backbones(value: Any, storeys: int) -> tuple[Backbone | None, ...] | None:
    """Return the backbone of each storey, or None where no storey has one."""
    if value is None:
        return None
    given = list(value) if is_per_storey(value) else [value] * storeys
    if len(given) != storeys:
        requirement = f"one list of points or a list of {storeys} of them, one per storey"
        raise refusal(InvalidScene, "backbone", "building", requirement, f"{len(given)} of them")
    found = tuple(
        None if points is None else _points(points, f"storey {number}") for number, points in enumerate(given, start=1)
    )
    return None if all(points is None for points in found) else found


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
    given: list[Any] = [value] * storeys if isinstance(value, str) or not isinstance(value, Sequence) else list(value)
    if len(given) != storeys:
        requirement = f"one name or a list of {storeys}, one per storey"
        raise refusal(InvalidScene, "hysteresis", "building", requirement, f"{len(given)} of them")
    for item in given:
        if not is_one_of(item, HYSTERESES):
            raise refusal(InvalidScene, "hysteresis", "building", " or ".join(HYSTERESES), brief(item))
    checked: tuple[Hysteresis, ...] = tuple(given)
    return checked


def of_first_segment(given: FloatArray, name: str, backbones: tuple[Backbone | None, ...]) -> FloatArray:
    """Return stiffnesses or yield shears, taken from the backbones where they are not given (NaN, or one number for the
    storeys without a backbone); both must agree where both are given.
    """
    values = np.array(np.broadcast_to(given, len(backbones)))
    for i, points in enumerate(backbones):
        if points is None:
            continue
        drift, force = points[0]
        with np.errstate(divide="ignore", invalid="ignore"):
            own = float(np.float64(force) / drift) if name == "stiffness" else (force if len(points) > 1 else np.inf)
        if given.ndim == 0 or np.isnan(values[i]) or np.isclose(values[i], own, rtol=_SAME, atol=0.0):
            values[i] = own
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
    found: set[Part] = {name for name in hysteresis if name != "masing"}
    listed = backbones or [None] * len(hysteresis)
    if any(points is None and name in TRILINEAR for points, name in zip(listed, hysteresis, strict=True)):
        found.add("trilinear")
    if "clearance" in springs and (springs["clearance"] < np.inf).any():
        found.add("stop")
    return found


def without_own(values: FloatArray, backbones: tuple[Backbone | None, ...]) -> FloatArray:
    """Return stiffnesses or yield shears with NaN, not given, where a storey has a backbone."""
    return np.where([points is not None for points in backbones], np.nan, values)
