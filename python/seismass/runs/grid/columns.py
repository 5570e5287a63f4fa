"""Columns of a grid: values that its scenes take in turn, read from what the user gives, with their ranges judged."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Generic, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seismass.base.errors import InvalidMotion, InvalidScene, SeismassError
from seismass.base.values import FloatArray, as_array, brief, frozen, read_only, refusal
from seismass.model.springs import SHAPE_FIELDS

IndexArray = NDArray[np.int64]
_T = TypeVar("_T", np.int64, np.float64)


@dataclass(frozen=True, slots=True)
class Column(Generic[_T]):
    """Values that scenes take in turn, each for `each` scenes before the next; a table has one row per value."""

    values: NDArray[_T]
    each: int = 1

    def of(self, scenes: IndexArray) -> NDArray[_T]:
        """Return the value of each scene."""
        found: NDArray[_T] = self.values[scenes // self.each % len(self.values)]
        return found


_RANGES: Final[dict[str, tuple[type[SeismassError], str, Callable[[FloatArray], NDArray[np.bool_]]]]] = {
    "period": (InvalidScene, "a positive number", lambda v: np.isfinite(v) & (v > 0.0)),
    "strength": (InvalidScene, "a positive number", lambda v: np.isfinite(v) & (v > 0.0)),
    "R": (InvalidScene, "a positive number", lambda v: np.isfinite(v) & (v > 0.0)),
    **{name: (InvalidScene, field.requirement, field.accepts) for name, field in SHAPE_FIELDS.items()},
    "occupancy": (InvalidScene, "a number of at least 0", lambda v: np.isfinite(v) & (v >= 0.0)),
    "attached": (InvalidScene, "between 0 and 1", lambda v: (v >= 0.0) & (v <= 1.0)),
    "sliding": (InvalidScene, "between 0 and 1", lambda v: (v >= 0.0) & (v <= 1.0)),
    "scale": (InvalidMotion, "a finite number", np.isfinite),
}

AXES: Final = {
    "period": ("period",),
    "strength": ("strength", "yield_shear_over_weight", "R"),
    **{name: (name,) for name in SHAPE_FIELDS},
    "mass_ratio": ("mass_ratio",),
    "occupancy": ("occupancy",),
    "attached": ("attached", "sliding"),
    "friction": ("mu_s", "mu_k"),
    "scale": ("scale",),
}
"""Axes of a product beside the building, and what each of them holds."""


def number_values(given: dict[str, ArrayLike | None]) -> dict[str, FloatArray]:
    """Return columns of one number per scene, by name; those that are None are left out."""
    found = {}
    for name, value in given.items():
        if value is None:
            continue
        kind, requirement, is_right = _RANGES[name]
        values = as_array(value, name, "grid", kind, or_number=True).reshape(-1)
        if not len(values):
            raise refusal(kind, name, "grid", "at least one value", "none")
        wrong = np.flatnonzero(~is_right(values))
        if len(wrong):
            raise refusal(kind, name, "grid", requirement, f"{values[wrong[0]]:g} as value {wrong[0] + 1}")
        found[name] = values
    return found


def index_values(value: Any, name: str, kind: type[SeismassError], *, of: str = "a list of them") -> IndexArray:
    """Return one number counted from 1, or a list of them, as indices from 0; the first where nothing is given."""
    requirement = f"a whole number counted from 1, or {of}"
    try:
        given = np.asarray(1 if value is None else value)
    except (TypeError, ValueError):
        raise refusal(kind, name, "grid", requirement, brief(value)) from None
    if given.dtype.kind not in "iu" or given.ndim > 1 or not given.size or np.ma.is_masked(value):
        raise refusal(kind, name, "grid", requirement, brief(value))
    numbers = given.reshape(-1)
    wrong = np.flatnonzero((numbers < 1) | (numbers > 2**32))
    if len(wrong):
        raise refusal(kind, name, "grid", requirement, f"{numbers[wrong[0]]} as value {wrong[0] + 1}")
    return read_only(numbers.astype(np.int64) - 1)


def block_table(value: Any, name: str, blocks: int) -> FloatArray:
    """Return what blocks have as a table of values by blocks; a width of one stands for all blocks."""
    try:
        dimensions = 2 if np.ndim(value) == 2 else 1
    except ValueError:
        dimensions = 1
    array = as_array(value, name, "grid", InvalidScene, dimensions=dimensions, or_number=True)
    table = array if array.ndim == 2 else array.reshape(-1, 1)
    if not len(table):
        raise refusal(InvalidScene, name, "grid", "at least one value", "none")
    if table.shape[1] not in (1, blocks):
        requirement = f"a list with one value per scene, or a table with one column per block, {blocks}"
        raise refusal(InvalidScene, name, "grid", requirement, f"a table of {table.shape[1]} columns")
    return table


def strength_table(value: Any) -> FloatArray:
    """Return V_y over the weight as a table of values by storeys; a width of one stands for all storeys. Shorter rows,
    of lower buildings, are filled with NaN.
    """
    name = "yield_shear_over_weight"
    rows = list(value) if isinstance(value, Sequence | np.ndarray) and np.ndim(_first(value)) == 1 else None
    if rows is None:
        table = as_array(value, name, "grid", InvalidScene, or_number=True).reshape(-1, 1)
    else:
        read = [as_array(row, name, "grid", InvalidScene) for row in rows]
        table = np.full((len(read), max(map(len, read))), np.nan)
        for number, row in enumerate(read):
            table[number, : len(row)] = row
    if not table.size:
        raise refusal(InvalidScene, name, "grid", "at least one value", "none")
    wrong = np.flatnonzero((table <= 0.0).any(axis=1) | np.isnan(table[:, 0]))
    if len(wrong):
        raise refusal(
            InvalidScene, name, "grid", "positive", f"{brief(table[wrong[0]].tolist())} as value {wrong[0] + 1}"
        )
    return frozen(table)


def _first(value: Any) -> Any:
    return value[0] if len(value) else 0.0


def block_values(blocks: int, mass_ratio: Any, mu: Any, mu_s: Any, mu_k: Any) -> dict[str, FloatArray]:
    """Return what blocks have, as tables of values by blocks; a width of one stands for all blocks."""
    given = {"mu": mu, "mu_s": mu_s, "mu_k": mu_k}
    if mass_ratio is None:
        for name, value in given.items():
            if value is not None:
                raise refusal(InvalidScene, name, "grid", "left out where mass_ratio is", brief(value))
        return {}
    if mu is not None and (mu_s is not None or mu_k is not None):
        raise refusal(InvalidScene, "mu", "grid", "left out where mu_s or mu_k is given", brief(mu))
    static = mu if mu_s is None else mu_s
    if static is None:
        raise refusal(InvalidScene, "mu", "grid", "given, or mu_s", "neither")
    values = {
        "mass_ratio": block_table(mass_ratio, "mass_ratio", blocks),
        "mu_s": block_table(static, "mu" if mu_s is None else "mu_s", blocks),
    }
    values["mu_k"] = values["mu_s"] if mu_k is None else block_table(mu_k, "mu_k", blocks)
    return values


def share_values(
    attached: Any, sliding: Any, occupancy: Any, mass_ratio: Any, *, of_design: bool
) -> dict[str, FloatArray]:
    """Return shares of the live load; of what is present no more than all is attached or slides."""
    for name, value in (("occupancy", occupancy), ("attached", attached), ("sliding", sliding)):
        if value is not None and mass_ratio is None:
            raise refusal(InvalidScene, name, "grid", "left out where mass_ratio is", brief(value))
    values = number_values({"occupancy": occupancy, "attached": attached, "sliding": sliding})
    shares = [values[name] for name in ("attached", "sliding") if name in values]
    if len(shares) == 2 and len({len(column) for column in shares} - {1}) < 2 and not of_design:
        both = shares[0] + shares[1]
        wrong = np.flatnonzero(both > 1.0 + 1e-12)
        if len(wrong):
            got = f"{both[wrong[0]]:g} together as value {wrong[0] + 1}"
            raise refusal(InvalidScene, "attached and sliding", "grid", "shares of at most 1 together", got)
    return values


def axis_lengths(values: dict[str, FloatArray], mu: Any) -> dict[str, int]:
    """Return the number of values of each axis of a product; 1 where it has none."""
    lengths = {}
    for axis, names in AXES.items():
        given = {name: len(values[name]) for name in names if name in values}
        lengths[axis] = next((length for length in given.values() if length > 1), 1)
        for name, length in given.items():
            if length not in (1, lengths[axis]):
                other = next(other for other in names if other != name)
                requirement = f"one value, or as many as {other} has, {lengths[axis]}"
                raise refusal(InvalidScene, as_given(name, mu), "grid", requirement, f"{length} values")
    return lengths


def as_given(name: str, mu: Any) -> str:
    """Return the name under which the user gave a column."""
    names = {"building": "building_index"}
    return "mu" if name in ("mu_s", "mu_k") and mu is not None else names.get(name, name)
