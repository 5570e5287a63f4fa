"""Columns that describe the scenes of a grid: axes, buildings, options."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Generic, Literal, NamedTuple, TypeAlias, TypeVar, get_args

import numpy as np
import polars as pl
from numpy.typing import ArrayLike, NDArray

from seismass.base.errors import InvalidMotion, InvalidScene, SeismassError
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FieldValue, FloatArray, as_array, brief, frozen, is_list, read_only, refusal
from seismass.model.building import Building, changed_building, of_storeys_alone
from seismass.model.springs import SHAPE_FIELDS, SpringShape
from seismass.runs.grid.sample import CHANGING, LOADS, StrengthDesign

IndexArray = NDArray[np.int64]
_T = TypeVar("_T", np.int64, np.float64)


@dataclass(frozen=True, slots=True)
class Column(Generic[_T]):
    """Values that scenes take in turn, each for `each` scenes before the next; a table has one row per value."""

    values: NDArray[_T]
    each: int = 1

    def of(self, scenes: IndexArray) -> NDArray[_T]:
        """Return the value of each scene."""
        values: NDArray[_T] = self.values[scenes // self.each % len(self.values)]
        return values


MOST_OF_DESIGN: Final = 2.0
"""Largest share of the design live load that is attached: surveys find more than that load on some floors."""
_RANGES: Final[dict[str, tuple[type[SeismassError], str, Callable[[FloatArray], NDArray[np.bool_]]]]] = {
    "period": (InvalidScene, "a positive number", lambda v: np.isfinite(v) & (v > 0.0)),
    "strength": (InvalidScene, "a positive number", lambda v: np.isfinite(v) & (v > 0.0)),
    "R": (InvalidScene, "a positive number", lambda v: np.isfinite(v) & (v > 0.0)),
    **{name: (InvalidScene, field.requirement, field.accepts) for name, field in SHAPE_FIELDS.items()},
    "attached": (InvalidScene, "between 0 and 2", lambda v: (v >= 0.0) & (v <= MOST_OF_DESIGN)),
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


def refuse_first(
    wrong: Any, values: Any, kind: type[SeismassError], name: str, requirement: str, text: Callable[[Any], str]
) -> None:
    """Refuse the first of values that is wrong, written by `text`."""
    places = np.flatnonzero(wrong).tolist()
    if places:
        raise refusal(kind, name, "grid", requirement, f"{text(values[places[0]])} as value {places[0] + 1}")


def number_values(parameters: dict[str, ArrayLike | None]) -> dict[str, FloatArray]:
    """Return columns of one number per scene, by name; those that are None are left out."""
    arrays = {}
    for name, value in parameters.items():
        if value is None:
            continue
        kind, requirement, is_right = _RANGES[name]
        values = as_array(value, name, "grid", kind, or_number=True).reshape(-1)
        if not len(values):
            raise refusal(kind, name, "grid", "at least one value", "none")
        refuse_first(~is_right(values), values, kind, name, requirement, "{:g}".format)
        arrays[name] = values
    return arrays


def index_values(value: Any, name: str, kind: type[SeismassError], *, expected: str = "a list of them") -> IndexArray:
    """Return one number counted from 1, or a list of them, as indices from 0; the first where nothing is given."""
    requirement = f"a whole number counted from 1, or {expected}"
    try:
        array = np.asarray(1 if value is None else value)
    except (TypeError, ValueError):
        raise refusal(kind, name, "grid", requirement, brief(value)) from None
    if array.dtype.kind not in "iu" or array.ndim > 1 or not array.size or np.ma.is_masked(value):
        raise refusal(kind, name, "grid", requirement, brief(value))
    numbers = array.reshape(-1)
    refuse_first((numbers < 1) | (numbers > 2**32), numbers, kind, name, requirement, str)
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
    rows = list(value) if is_list(value) and is_list(_first(value)) else None
    if rows is None:
        table = as_array(value, name, "grid", InvalidScene, or_number=True).reshape(-1, 1)
    else:
        read = [as_array(row, name, "grid", InvalidScene) for row in rows]
        table = np.full((len(read), max(map(len, read))), np.nan)
        for number, row in enumerate(read):
            table[number, : len(row)] = row
    if not table.size:
        raise refusal(InvalidScene, name, "grid", "at least one value", "none")
    wrong = (table <= 0.0).any(axis=1) | np.isnan(table[:, 0])
    refuse_first(wrong, table, InvalidScene, name, "positive", lambda row: brief(row.tolist()))
    return frozen(table)


def _first(value: Any) -> Any:
    return value[0] if len(value) else 0.0


def block_values(blocks: int, mass_ratio: Any, mu: Any, mu_s: Any, mu_k: Any) -> dict[str, FloatArray]:
    """Return what blocks have, as tables of values by blocks; a width of one stands for all blocks."""
    parameters = {"mu": mu, "mu_s": mu_s, "mu_k": mu_k}
    if mass_ratio is None:
        for name, value in parameters.items():
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
    attached: Any, sliding: Any, occupancy: Any, mass_ratio: Any, *, blocks: int, of_design: bool
) -> dict[str, FloatArray]:
    """Return shares of the live load; of what is present no more than all is attached or slides."""
    for name, value in (("occupancy", occupancy), ("attached", attached), ("sliding", sliding)):
        if value is not None and mass_ratio is None:
            raise refusal(InvalidScene, name, "grid", "left out where mass_ratio is", brief(value))
    values = number_values({"attached": attached, "sliding": sliding})
    if not of_design and "attached" in values:
        share = values["attached"]
        refuse_first(share > 1.0, share, InvalidScene, "attached", "between 0 and 1", "{:g}".format)
    if occupancy is not None:
        values["occupancy"] = block_table(occupancy, "occupancy", blocks)
        wrong = ~(values["occupancy"] >= 0.0).all(axis=1)
        refuse_first(wrong, wrong, InvalidScene, "occupancy", "a number of at least 0", lambda _: brief(occupancy))
    shares = [values[name] for name in ("attached", "sliding") if name in values]
    if len(shares) == 2 and len({len(column) for column in shares} - {1}) < 2 and not of_design:
        both = shares[0] + shares[1]
        most, name = "shares of at most 1 together", "attached and sliding"
        refuse_first(both > 1.0 + 1e-12, both, InvalidScene, name, most, "{:g} together".format)
    return values


def axis_lengths(values: dict[str, FloatArray], mu: Any) -> dict[str, int]:
    """Return the number of values of each axis of a product; 1 where it has none."""
    lengths = {}
    for axis, names in AXES.items():
        known = {name: len(values[name]) for name in names if name in values}
        lengths[axis] = next((length for length in known.values() if length > 1), 1)
        for name, length in known.items():
            if length not in (1, lengths[axis]):
                other = next(other for other in names if other != name)
                requirement = f"one value, or as many as {other} has, {lengths[axis]}"
                raise refusal(InvalidScene, as_stated(name, mu), "grid", requirement, f"{length} values")
    return lengths


def as_stated(name: str, mu: Any) -> str:
    """Return the name under which the user gave a column."""
    names = {"building": "building_index"}
    return "mu" if name in ("mu_s", "mu_k") and mu is not None else names.get(name, name)


AXIS_OF: Final = {
    **{name: axis for axis, names in AXES.items() for name in names},
    **dict.fromkeys(("building", "storeys", "period"), "building"),
}
"""Axis of each column of a product."""
TABLE_COLUMNS: Final = ("building", "storeys", *CHANGING, *LOADS, "mu_s", "mu_k", "scale", "motion")
"""Columns that the table of a grid may have beside `scene`, in their order."""
_NUMBERS: Final = ("building", "storeys", "motion")


@dataclass(frozen=True, eq=False)
class GridAxis(FieldValue):
    """What varies together over the scenes of a grid.

    Attributes
    ----------
    name : str
        "constant" for what all scenes share, "scene" where each scene has a value of its own, else the axis of
        `Grid.product`.
    each, length : int
        Scene s, from 1, has row (s - 1) // each % length, from 0.
    columns : dict of str to ndarray
        Values by the names of `Grid.table`, one row each; shape (length, blocks) or (length, storeys) where blocks or
        storeys differ, filled up with NaN.
    """

    name: str
    each: int
    length: int
    columns: dict[str, np.ndarray[Any, Any]]


def described(
    buildings: tuple[Building, ...],
    periods: FloatArray,
    columns: dict[str, Column[np.float64]],
    indices: dict[str, Column[np.int64]],
) -> dict[str, Column[Any]]:
    """Return columns by the names of `Grid.table`: numbers from 1, and storeys and periods of buildings."""
    index = indices["building"]
    storeys = np.array([building.storeys for building in buildings])[index.values]
    columns_by_name: dict[str, Column[Any]] = {
        "building": Column(index.values + 1, index.each),
        "storeys": Column(storeys, index.each),
        "period": Column(periods[index.values], index.each),
    }
    for name, column in columns.items():
        narrow = column.values.ndim == 2 and column.values.shape[1] == 1
        columns_by_name[name] = Column(column.values.reshape(-1) if narrow else column.values, column.each)
    if "motion" in indices:
        columns_by_name["motion"] = Column(indices["motion"].values + 1)
    return columns_by_name


def axes_of(columns: dict[str, Column[Any]], scenes: int) -> list[GridAxis]:
    """Return the axes of columns by their names in `Grid.table`; what all scenes share is the axis "constant"."""
    axes: dict[tuple[int, int], GridAxis] = {}
    for name, column in columns.items():
        length = len(column.values)
        key = (1, 1) if length == 1 else (column.each, length)
        if key not in axes:
            axis_name = "constant" if length == 1 else "scene" if key == (1, scenes) else AXIS_OF[name]
            axes[key] = GridAxis(axis_name, *key, {})
        axes[key].columns[name] = column.values
    return sorted(axes.values(), key=lambda axis: (axis.length > 1, -axis.each))


def table_of(columns: dict[str, Column[Any]], scenes: IndexArray) -> pl.DataFrame:
    """Return columns by their names in `Grid.table` as a frame, a row for each of these scenes, numbered from 0."""
    series: dict[str, pl.Series] = {"scene": pl.Series((scenes + 1).astype(np.uint64))}
    for name in TABLE_COLUMNS:
        if name not in columns:
            continue
        values = columns[name].of(scenes)
        if values.ndim == 1:
            series[name] = pl.Series(values.astype(np.uint32) if name in _NUMBERS else values)
        else:
            lists = pl.Series(values, dtype=pl.Array(pl.Float64, values.shape[1])).arr.to_list()
            unused = np.isnan(values).any()
            series[name] = lists.list.eval(pl.element().filter(pl.element().is_not_nan())) if unused else lists
    return pl.DataFrame(series)


AttachedDamping: TypeAlias = Literal["same", "ratio"]
"""Damping of a building to which live load is attached: the matrix that it has without, or its ratio in new modes."""
ATTACHED_DAMPING: Final = get_args(AttachedDamping)

AttachedOf: TypeAlias = Literal["present", "design"]
"""Live load of which a share is attached: what is present, or what the building was designed for."""
ATTACHED_OF: Final = get_args(AttachedOf)


class Formed(NamedTuple):
    """Buildings of some scenes, which of them each scene has, and block masses over the floor masses they have."""

    buildings: list[Building]
    which: IndexArray
    mass_ratio: FloatArray


@dataclass(frozen=True, slots=True)
class BuildingColumns:
    """What forms the building of a scene: buildings given with first periods (s), the floor of each block (from 1), the
    columns of `CHANGING`, `attached` and `sliding`; `design` gives V_y by the column R.
    """

    buildings: tuple[Building, ...]
    periods: FloatArray
    floors: tuple[int, ...]
    columns: dict[str, Column[np.float64]]
    damping: AttachedDamping
    attached_of: AttachedOf
    design: StrengthDesign | None

    def of(self, scenes: IndexArray, index: IndexArray, design_load: FloatArray) -> Formed:
        """Return the buildings of scenes (numbers from 0) from the index of each given one. `design_load` is the mass
        of the design live load over that of its floor, shape (scenes, blocks).
        """
        attached, sliding = self.shares_of(scenes)
        present = self.present_of(scenes, design_load)
        blocks = present if sliding is None else present * sliding[:, None]
        changing = [self.columns[name].of(scenes).reshape(len(scenes), -1) for name in CHANGING if name in self.columns]
        if attached is None and not changing:
            return Formed(list(self.buildings), index, blocks)
        if self.design is not None:
            changing.append(design_load)
        without_load = np.column_stack([index, *changing])
        loads = np.zeros((len(scenes), 2, len(self.floors)))
        if attached is not None and sliding is not None:
            loads[:, 0] = attached[:, None] * (present if self.attached_of == "present" else design_load)
            loads[:, 1] = (1.0 - sliding)[:, None] * present
            changing.append(loads.reshape(len(scenes), -1))
        keys = np.nan_to_num(np.column_stack([index, *changing]), nan=-1.0, posinf=np.inf)
        _, first, which = np.unique(keys, axis=0, return_index=True, return_inverse=True)
        which = which.reshape(-1)
        formed, added = [], []
        designed: dict[Hashable, FloatArray] = {}
        known: dict[bytes, Building] = {}  # buildings without live load
        for place in first.tolist():
            scene = scenes[place : place + 1]
            try:
                key = without_load[place].tobytes()
                if key not in known:
                    known[key] = self._changed(scene, int(index[place]), design_load[place], designed)
                changed = known[key]
                if attached is not None:
                    self._on_floors(design_load[place], changed.storeys)  # of floors that are there
                building, more = self._loaded(changed, *loads[place])
            except InvalidScene as error:
                message = str(error).replace(" must be ", f" of scene {scenes[place] + 1} must be ", 1)
                raise InvalidScene(message) from None
            formed.append(building)
            added.append(more)
        if attached is not None:
            blocks = blocks / np.array(added)[which]
        return Formed(formed, which, blocks)

    def shares_of(self, scenes: IndexArray) -> tuple[FloatArray | None, FloatArray | None]:
        """Return the shares of the live load that are attached and that slide, or None where all of it slides."""
        if not {"attached", "sliding"} & self.columns.keys():
            return None, None
        shares = {name: self.columns[name].of(scenes) for name in ("attached", "sliding") if name in self.columns}
        attached = shares.get("attached", np.zeros(len(scenes)))
        return attached, shares.get("sliding", 1.0 - attached)

    def present_of(self, scenes: IndexArray, design_load: FloatArray) -> FloatArray:
        """Return the live load that is present over floor mass, shape (scenes, blocks)."""
        if "occupancy" not in self.columns:
            return design_load
        return design_load * self.columns["occupancy"].of(scenes)

    def _changed(
        self, scene: IndexArray, index: int, design_load: FloatArray, designed: dict[Hashable, FloatArray]
    ) -> Building:
        """The building of a scene without live load; V_e of each design is computed once."""
        building = self.buildings[index]
        value = {name: self.columns[name].of(scene)[0] for name in CHANGING if name in self.columns}
        changes: dict[str, Any] = {name: value[name] for name in SHAPE_FIELDS if name in value}
        if "period" in value:
            faster = float(building.periods[0]) / value["period"]
            changes["stiffness"] = building.stiffness * faster**2
            if isinstance(building.damping, np.ndarray):  # the same ratios in its modes
                changes["damping"] = building.damping * faster
        if "strength" in value:
            changes["yield_shear"] = building.yield_shear * value["strength"]
        elif "yield_shear_over_weight" in value:
            changes["yield_shear"] = _strengths(value["yield_shear_over_weight"], building.storeys) * building.weight
        elif "R" in value and self.design is not None:
            reduction = float(value["R"])
            if reduction == 1.0 and self.design.elastic_at_one:
                changes["yield_shear"] = np.full(building.storeys, np.inf)
            else:
                key = (index, value.get("period"), design_load.tobytes())
                if key not in designed:
                    stiffer = changed_building(building, **changes)
                    designed[key] = self.design.elastic_shear(stiffer, self._on_floors(design_load, building.storeys))
                changes["yield_shear"] = designed[key] / reduction
        return changed_building(building, **changes) if changes else building

    def _loaded(self, building: Building, attached: FloatArray, still: FloatArray) -> tuple[Building, FloatArray]:
        """A building with live load attached as mass and some whose weight does not slide, both over floor mass, and
        the mass of each block's floor over that without attached live load.
        """
        more = np.ones(len(self.floors))
        changes: dict[str, Any] = {}
        if attached.any():
            changes["mass"] = building.mass + self._on_floors(attached, building.storeys) * building.mass
            if self.damping == "same":
                changes["damping"] = building.damping_matrix
            for j, floor in enumerate(self.floors):
                if floor <= building.storeys:
                    more[j] = changes["mass"][floor - 1] / building.mass[floor - 1]
        if building.gravity_load is not None and still.any():
            # The weight of what does not slide is there, however much of it is counted as mass.
            weight = self._on_floors(still, building.storeys) * building.mass * STANDARD_GRAVITY
            changes["gravity_load"] = building.gravity_load + weight
        return (changed_building(building, **changes) if changes else building), more

    def _on_floors(self, load: FloatArray, storeys: int) -> FloatArray:
        """What blocks have, summed on their floors."""
        sums = np.zeros(storeys)
        for floor, value in zip(self.floors, load.tolist(), strict=True):
            if value != 0.0:
                if floor > storeys:
                    requirement = f"a floor of the building, 1 to {storeys}"
                    raise refusal(InvalidScene, "floor", "live load", requirement, str(floor))
                sums[floor - 1] += value
        return sums


def _strengths(over_weight: FloatArray, storeys: int) -> FloatArray:
    """V_y over the weight of each storey, from a row that may be longer than the building is high."""
    values = np.full(storeys, over_weight[0]) if len(over_weight) == 1 else over_weight[:storeys]
    if len(values) < storeys or np.isnan(values).any():
        count = int((~np.isnan(over_weight)).sum())
        requirement = f"one number or {storeys} values, one per storey"
        raise refusal(InvalidScene, "yield_shear_over_weight", "building", requirement, f"{count} values")
    return values


def listed_buildings(building: Any, storeys: Any, period: Any) -> tuple[tuple[Building, ...], IndexArray, FloatArray]:
    """Return the buildings of a grid, which of them each value of storeys and periods has, and their periods."""
    if (building is None) == (storeys is None):
        got = "neither" if building is None else "both"
        raise refusal(InvalidScene, "building", "grid", "given either as building or as storeys", got)
    if storeys is None:
        listed = (building,) if isinstance(building, Building) else building
        if not isinstance(listed, Sequence) or not listed or not all(isinstance(item, Building) for item in listed):
            raise refusal(InvalidScene, "building", "grid", "a Building or a list of Buildings", brief(building))
        for item in listed:
            of_storeys_alone(item, "grids")
        periods_of_list = np.array([float(item.periods[0]) for item in listed])
        return tuple(listed), np.zeros(1, dtype=np.int64), periods_of_list
    if period is None:
        raise refusal(InvalidScene, "period", "grid", "given where storeys is", "none")
    heights = index_values(storeys, "storeys", InvalidScene, expected="a list of such numbers") + 1
    periods = number_values({"period": period})["period"]
    if len(heights) != len(periods) and 1 not in (len(heights), len(periods)):
        requirement = f"one value, or as many as storeys has, {len(heights)}"
        raise refusal(InvalidScene, "period", "grid", requirement, f"{len(periods)} values")
    pairs = np.column_stack(np.broadcast_arrays(heights, periods))
    distinct, first, which = np.unique(pairs, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)  # buildings are numbered as they are listed
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    buildings = tuple(Building.uniform(int(count), float(seconds)) for count, seconds in distinct[order])
    return buildings, place[which.reshape(-1)], distinct[order, 1]


def changing_values(
    buildings: Sequence[Building], *, yield_shear_over_weight: Any, **numbers: Any
) -> dict[str, FloatArray]:
    """Return what changes buildings."""
    values = number_values(numbers)
    if "R" in values and ("strength" in values or yield_shear_over_weight is not None):
        other = "strength" if "strength" in values else "yield_shear_over_weight"
        raise refusal(InvalidScene, "R", "grid", f"left out where {other} is given", "both")
    if yield_shear_over_weight is not None:
        if "strength" in values:
            raise refusal(InvalidScene, "strength", "grid", "left out where yield_shear_over_weight is given", "both")
        values["yield_shear_over_weight"] = strength_table(yield_shear_over_weight)
    if any(building.backbone is not None for building in buildings):
        for name, column in values.items():
            requirement = "left out where a building has a backbone"
            raise refusal(InvalidScene, name, "grid", requirement, brief(column.tolist()))
    if "strength" in values and all(np.isinf(building.yield_shear).all() for building in buildings):
        requirement = "left out where buildings are elastic (yield_shear_over_weight makes them yield)"
        raise refusal(InvalidScene, "strength", "grid", requirement, brief(numbers["strength"]))
    return values


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
"""Default of each option, None except for three."""


def grid_options(options: dict[str, Any], owner: str) -> dict[str, Any]:
    """Return all options, with defaults for those that are not given; an unknown one is a TypeError."""
    for name in options:
        if name not in DEFAULTS:
            raise TypeError(f"{owner}() got an unexpected keyword argument {name!r}")
    return DEFAULTS | options


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
