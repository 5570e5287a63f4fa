"""The options that `Grid` and `Grid.product` share, stated once: names, types and defaults."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, Final, Literal, TypeAlias, TypeVar

from numpy.typing import ArrayLike

from seismass.model.springs import SHAPE_FIELDS, SpringShape
from seismass.runs.grid.buildings import AttachedDamping, AttachedOf
from seismass.runs.grid.design import StrengthDesign

Roof: TypeAlias = Literal["loaded", "bare"]
"""Whether the uppermost floor of a building carries blocks."""

_Function = TypeVar("_Function", bound=Callable[..., Any])


class GridOptions(SpringShape, total=False):
    """What `Grid` and `Grid.product` take beside buildings; see `Grid`."""

    storeys: ArrayLike | None
    period: ArrayLike | None
    strength: ArrayLike | None
    R: ArrayLike | None
    design: StrengthDesign | None
    yield_shear_over_weight: ArrayLike | None
    floors: ArrayLike | None
    roof: Roof
    mass_ratio: ArrayLike | None
    occupancy: ArrayLike | None
    attached: ArrayLike | None
    attached_of: AttachedOf
    sliding: ArrayLike | None
    damping: AttachedDamping
    mu: ArrayLike | None
    mu_s: ArrayLike | None
    mu_k: ArrayLike | None
    scale: ArrayLike | None
    collapse_drift: float | None


_STATED: Final[dict[str, Any]] = {"roof": "loaded", "attached_of": "present", "damping": "same"}
_SHAPE: Final = frozenset(SpringShape.__annotations__)
DEFAULTS: Final[dict[str, Any]] = {
    **{name: _STATED.get(name) for name in GridOptions.__annotations__ if name not in _SHAPE},
    **dict.fromkeys(SHAPE_FIELDS),
}
"""Default of each option, None but for three."""


def grid_options(given: dict[str, Any], owner: str) -> dict[str, Any]:
    """Return all options, with defaults for those that are not given; an unknown one is a TypeError."""
    for name in given:
        if name not in DEFAULTS:
            raise TypeError(f"{owner}() got an unexpected keyword argument {name!r}")
    return DEFAULTS | given


def takes_grid_options(function: _Function) -> _Function:
    """Name each of the options in the signature of a function that takes them as `**`, for help and completion."""
    signature = inspect.signature(function)
    others = [item for item in signature.parameters.values() if item.kind is not inspect.Parameter.VAR_KEYWORD]
    named = [
        inspect.Parameter(
            name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=GridOptions.__annotations__.get(name)
        )
        for name, default in DEFAULTS.items()
    ]
    function.__signature__ = signature.replace(parameters=[*others, *named])  # type: ignore[attr-defined]
    return function
