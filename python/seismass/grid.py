"""Many scenes described by columns, not by objects: aligned columns, or the product of axes, formed as it is needed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final, Generic, Self, TypeVar

import numpy as np
import polars as pl
from numpy.typing import ArrayLike, NDArray

from seismass import _kernel
from seismass._values import FloatArray, as_array, as_count, as_number, brief, refusal
from seismass.errors import InvalidMotion, InvalidOption, InvalidScene, SeismassError
from seismass.scene import Block, Building, Scene

IndexArray = NDArray[np.int64]
_T = TypeVar("_T", np.int64, np.float64)

MAX_SCENES: Final = 2**32 - 1
"""Most scenes of a grid: results number them by 32 bits."""
_CHECKED_AT_ONCE: Final = 2**16


@dataclass(frozen=True, slots=True)
class _Column(Generic[_T]):
    """Values that scenes take in turn, each for `each` scenes before the next; a table has one row per value."""

    values: NDArray[_T]
    each: int = 1

    def of(self, scenes: IndexArray) -> NDArray[_T]:
        """Return the value of each scene."""
        found: NDArray[_T] = self.values[scenes // self.each % len(self.values)]
        return found


class Grid:
    """Scenes that differ in building, blocks and intensity, described by columns: a million need no million objects.

    A column is one value for all scenes, a list with one value per scene, or, for what blocks have, a table of scenes
    by blocks (a table of one row holds for all scenes). All scenes start at rest. `Grid.product` makes every
    combination of values instead.

    Parameters
    ----------
    building : Building or sequence of Building
        The building of all scenes, or those that `building_index` chooses from.
    building_index : array_like of int, optional
        Index of the building of each scene, from 0; needed where there are several.
    floors : array_like of int, optional
        Floor of each block, counted from 1; several blocks may share one. By default a block on every floor.
    mass_ratio : array_like, optional
        Block mass over floor mass; 0: the scene has no such block. No scene has blocks where it is left out.
    mu : array_like, optional
        Friction coefficient, static and kinetic. Where there are blocks, either it or `mu_s` is needed.
    mu_s, mu_k : array_like, optional
        Static and kinetic coefficients, mu_s >= mu_k >= 0; mu_k is mu_s by default.
    scale : array_like, optional
        Factor of the motion of each scene, both components; 1 by default.
    motion : array_like of int, optional
        Index of the motion of each scene, from 0, which then has one run. By default each scene is run under every
        motion.
    collapse_drift : float, optional
        Drift (m) at which any storey of any scene counts as collapsed.

    Attributes
    ----------
    buildings : tuple of Building
        The buildings.
    floors : tuple of int
        Floor of each block.

    Raises
    ------
    InvalidScene
        Columns differ in length, or a row describes no valid scene; the message names the first one, from 0.
    InvalidMotion
        A factor is not a finite number.
    InvalidOption
        An index of a motion is negative, or there are too many scenes.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.2, 0.12])
    >>> grid = sm.Grid(building, mass_ratio=[0.5, 0.5, 1.0], mu=[0.2, 0.3, 0.3], scale=2.0)
    >>> len(grid)
    3
    >>> grid.scene(2).blocks
    (Block(floor=1, mass_ratio=1, mu=0.3), Block(floor=2, mass_ratio=1, mu=0.3))
    """

    __slots__ = ("_columns", "_everywhere", "_indices", "_length", "buildings", "collapse_drift", "floors")
    buildings: tuple[Building, ...]
    floors: tuple[int, ...]
    collapse_drift: float | None
    _length: int
    _columns: dict[str, _Column[np.float64]]
    _indices: dict[str, _Column[np.int64]]
    _everywhere: bool

    def __init__(
        self,
        building: Building | Sequence[Building],
        *,
        building_index: ArrayLike | None = None,
        floors: ArrayLike | None = None,
        mass_ratio: ArrayLike | None = None,
        mu: ArrayLike | None = None,
        mu_s: ArrayLike | None = None,
        mu_k: ArrayLike | None = None,
        scale: ArrayLike | None = None,
        motion: ArrayLike | None = None,
        collapse_drift: float | None = None,
    ) -> None:
        self._set_common(building, floors, mass_ratio, collapse_drift)
        if building_index is None and len(self.buildings) > 1:
            raise refusal(InvalidScene, "building_index", "grid", "given where there are several buildings", "none")
        values = self._block_values(mass_ratio, mu, mu_s, mu_k) | _scale_values(scale)
        indices = {"building": _index_values(building_index, "building_index", InvalidScene)}
        if motion is not None:
            indices["motion"] = _index_values(motion, "motion", InvalidOption)
        lengths = {name: len(column) for name, column in (*values.items(), *indices.items())}
        self._length = max(lengths.values())
        for name, length in lengths.items():
            if length not in (1, self._length):
                requirement = f"one value, or as many as the longest column has, {self._length}"
                raise refusal(InvalidScene, _as_given(name, mu), "grid", requirement, f"{length} values")
        self._columns = {name: _Column(column) for name, column in values.items()}
        self._indices = {name: _Column(column) for name, column in indices.items()}
        self._check(range(self._length))

    @classmethod
    def product(
        cls,
        building: Building | Sequence[Building],
        *,
        floors: ArrayLike | None = None,
        mass_ratio: ArrayLike | None = None,
        mu: ArrayLike | None = None,
        mu_s: ArrayLike | None = None,
        mu_k: ArrayLike | None = None,
        scale: ArrayLike | None = None,
        collapse_drift: float | None = None,
    ) -> Self:
        """Return every combination of the values of each axis, of which only the axes are held.

        The axes are building, mass ratio, friction and scale, the last changing fastest: scenes that follow each other
        share propagators. `mu_s` and `mu_k` are one axis.

        Parameters
        ----------
        building : Building or sequence of Building
            The buildings.
        mass_ratio, mu, mu_s, mu_k : array_like, optional
            One value, a list of values that all blocks share, or a table of values by blocks.
        scale : array_like, optional
            Factors of the motion.
        floors, collapse_drift
            As for `Grid`.

        Raises
        ------
        InvalidScene, InvalidMotion, InvalidOption
            As for `Grid`.

        Examples
        --------
        >>> import seismass as sm
        >>> building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.2, 0.12])
        >>> grid = sm.Grid.product(building, mass_ratio=[0.5, 1.0], mu=[0.2, 0.3, 0.4], scale=[0.5, 1.0, 2.0])
        >>> len(grid)
        18
        >>> grid.table(3, 5)["mu_s"].to_list()
        [0.3, 0.3]
        """
        grid = cls.__new__(cls)
        grid._set_common(building, floors, mass_ratio, collapse_drift)
        values = grid._block_values(mass_ratio, mu, mu_s, mu_k) | _scale_values(scale)
        friction = [len(values[name]) for name in ("mu_s", "mu_k") if name in values]
        if len(set(friction) - {1}) > 1:
            requirement = f"one value, or as many as mu_s has, {friction[0]}"
            raise refusal(InvalidScene, "mu_k", "grid", requirement, f"{friction[1]} values")
        lengths = {
            "building": len(grid.buildings),
            "mass_ratio": len(values.get("mass_ratio", (0,))),
            "friction": max(friction, default=1),
            "scale": len(values.get("scale", (0,))),
        }
        each, length = {}, 1
        for axis in reversed(lengths):
            each[axis] = length
            length *= lengths[axis]
        if length > MAX_SCENES:
            raise refusal(InvalidOption, "scenes", "grid", f"at most {MAX_SCENES}", f"{length}")
        grid._length = length
        axes = {"mu_s": "friction", "mu_k": "friction"}
        grid._columns = {name: _Column(column, each[axes.get(name, name)]) for name, column in values.items()}
        grid._indices = {"building": _Column(np.arange(len(grid.buildings)), each["building"])}
        # Masses are judged with buildings, friction by itself: scenes with the first value of the other axes will do.
        grid._check(range(0, length, each["mass_ratio"]))
        grid._check(range(0, each["mass_ratio"], each["friction"]))
        return grid

    def __len__(self) -> int:
        return self._length

    def scene(self, number: int) -> Scene:
        """Return one scene, counted from 0, as an object; its factor and its motion are in `table`.

        Raises
        ------
        InvalidOption
            There is no such scene.
        """
        index = as_count(number, "number", "grid", InvalidOption)
        if index >= self._length:
            raise refusal(InvalidOption, "number", "grid", f"that of a scene, 0 to {self._length - 1}", str(index))
        scenes = np.array([index])
        building = self.buildings[int(self._building_of(scenes)[0])]
        ratio, static, kinetic = (self._per_block(name, scenes)[0].tolist() for name in ("mass_ratio", "mu_s", "mu_k"))
        blocks = [
            Block(floor, mass_ratio=ratio[j], mu_s=static[j], mu_k=kinetic[j])
            for j, floor in enumerate(self.floors)
            if ratio[j] != 0.0
        ]
        return Scene(building, blocks, collapse_drift=self.collapse_drift)

    def table(self, first: int = 0, last: int | None = None) -> pl.DataFrame:
        """Return the columns of the scenes from `first` to before `last` (default: to the end) as a frame.

        It has the number of the scene as `scene`, by which results are joined, the index of the `building`, and of
        `mass_ratio`, `mu_s`, `mu_k`, `scale` and `motion` those that were given; lists where blocks differ.

        Raises
        ------
        InvalidOption
            A number is negative or not whole.
        """
        end = self._length if last is None else as_count(last, "last", "grid", InvalidOption)
        scenes = np.arange(as_count(first, "first", "grid", InvalidOption), min(end, self._length))
        found: dict[str, pl.Series] = {"scene": pl.Series(scenes.astype(np.uint32))}
        for name, index in self._indices.items():
            found[name] = pl.Series(index.of(scenes).astype(np.uint32))
        for name, column in self._columns.items():
            values = column.of(scenes)
            if values.ndim == 1 or values.shape[1] == 1:
                found[name] = pl.Series(values.reshape(-1))
            else:
                found[name] = pl.Series(values, dtype=pl.Array(pl.Float64, values.shape[1])).arr.to_list()
        order = ("scene", "building", "mass_ratio", "mu_s", "mu_k", "scale", "motion")
        return pl.DataFrame({name: found[name] for name in order if name in found})

    def __repr__(self) -> str:
        def counted(number: int, noun: str) -> str:
            return f"{number} {noun}" if number == 1 else f"{number} {noun}s"

        given = [name for name in self._columns if name != "mu_k"]
        columns = f", columns {', '.join(given)}" if given else ""
        of = f"{counted(len(self.buildings), 'building')}, {counted(len(self.floors), 'block')} each"
        return f"Grid({counted(self._length, 'scene')}, {of}{columns})"

    def _set_common(self, building: Any, floors: Any, mass_ratio: Any, collapse_drift: Any) -> None:
        listed = (building,) if isinstance(building, Building) else building
        if not isinstance(listed, Sequence) or not listed or not all(isinstance(item, Building) for item in listed):
            raise refusal(InvalidScene, "building", "grid", "a Building or a list of Buildings", brief(building))
        self.buildings = tuple(listed)
        self._everywhere = floors is None
        if mass_ratio is None:
            if floors is not None:
                raise refusal(InvalidScene, "floors", "grid", "left out where mass_ratio is", brief(floors))
            self.floors = ()
        elif floors is None:
            self.floors = tuple(range(1, max(item.storeys for item in self.buildings) + 1))
        else:
            self.floors = tuple(_index_values(floors, "floors", InvalidScene).tolist())
        self.collapse_drift = (
            None if collapse_drift is None else as_number(collapse_drift, "collapse_drift", "grid", InvalidScene)
        )

    def _block_values(self, mass_ratio: Any, mu: Any, mu_s: Any, mu_k: Any) -> dict[str, FloatArray]:
        """What blocks have, as tables of values by blocks; a width of one stands for all blocks."""
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
            "mass_ratio": self._block_table(mass_ratio, "mass_ratio"),
            "mu_s": self._block_table(static, "mu" if mu_s is None else "mu_s"),
        }
        values["mu_k"] = values["mu_s"] if mu_k is None else self._block_table(mu_k, "mu_k")
        return values

    def _block_table(self, value: Any, name: str) -> FloatArray:
        try:
            dimensions = 2 if np.ndim(value) == 2 else 1
        except ValueError:
            dimensions = 1
        array = as_array(value, name, "grid", InvalidScene, dimensions=dimensions, or_number=True)
        table = array if array.ndim == 2 else array.reshape(-1, 1)
        if not len(table):
            raise refusal(InvalidScene, name, "grid", "at least one value", "none")
        blocks = len(self.floors)
        if table.shape[1] not in (1, blocks):
            requirement = f"a list with one value per scene, or a table with one column per block, {blocks}"
            raise refusal(InvalidScene, name, "grid", requirement, f"a table of {table.shape[1]} columns")
        return table

    def _per_block(self, name: str, scenes: IndexArray) -> FloatArray:
        """A property of the blocks of scenes, shape (scenes, blocks)."""
        shape = (len(scenes), len(self.floors))
        if name not in self._columns:
            return np.zeros(shape)
        values = self._columns[name].of(scenes)
        if name == "mass_ratio" and self._everywhere and values.shape[1] == 1:
            # A block on every floor of the scene's own building.
            storeys = np.array([building.storeys for building in self.buildings])[self._building_of(scenes)]
            return np.where(np.array(self.floors) <= storeys[:, None], values, 0.0)
        return np.broadcast_to(values, shape)

    def _kernel_columns(self, scenes: IndexArray) -> _kernel.Columns:
        """Scenes as the kernel takes them."""
        return _kernel.Columns(
            [building._kernel for building in self.buildings],
            self.floors,
            self._building_of(scenes),
            *(self._per_block(name, scenes) for name in ("mass_ratio", "mu_s", "mu_k")),
            collapse_drift=self.collapse_drift,
        )

    def _building_of(self, scenes: IndexArray) -> IndexArray:
        return self._indices["building"].of(scenes)

    def _factor_of(self, scenes: IndexArray) -> FloatArray:
        return self._columns["scale"].of(scenes) if "scale" in self._columns else np.ones(len(scenes))

    def _runs_under(self, motions: int) -> int:
        """Number of runs under so many motions."""
        return self._length * (1 if "motion" in self._indices else motions)

    def _scene_and_motion(self, runs: IndexArray, motions: int) -> tuple[IndexArray, IndexArray]:
        """Scene and motion of each run."""
        if "motion" in self._indices:
            return runs, self._indices["motion"].of(runs)
        return runs // max(motions, 1), runs % max(motions, 1)

    def _check_motions(self, motions: int) -> None:
        """Refuse motions of which one that the column names is missing."""
        if "motion" not in self._indices:
            return
        index = self._indices["motion"].values
        wrong = np.flatnonzero(index >= motions)
        if len(wrong):
            limits = f"an index of a motion, below their number, {motions}"
            raise refusal(InvalidOption, "motion", "grid", limits, f"{index[wrong[0]]} at scene {wrong[0]}")

    def _check(self, numbers: range) -> None:
        """Let the kernel judge scenes by their numbers."""
        index = self._indices["building"]
        wrong = np.flatnonzero(index.values >= len(self.buildings))
        if len(wrong):
            limits = f"an index of a building, 0 to {len(self.buildings) - 1}"
            got = f"{index.values[wrong[0]]} at scene {wrong[0]}"
            raise refusal(InvalidScene, "building_index", "grid", limits, got)
        for part in _parts(numbers):
            scenes = np.arange(part.start, part.stop, part.step)
            self._kernel_columns(scenes).check(scenes)


def _parts(numbers: range) -> Iterator[range]:
    for first in range(0, len(numbers), _CHECKED_AT_ONCE):
        yield numbers[first : first + _CHECKED_AT_ONCE]


def _as_given(name: str, mu: Any) -> str:
    """Name under which the user gave a column."""
    names = {"building": "building_index"}
    return "mu" if name in ("mu_s", "mu_k") and mu is not None else names.get(name, name)


def _scale_values(scale: Any) -> dict[str, FloatArray]:
    if scale is None:
        return {}
    factors = as_array(scale, "scale", "grid", InvalidMotion, or_number=True).reshape(-1)
    if not len(factors):
        raise refusal(InvalidMotion, "scale", "grid", "at least one value", "none")
    wrong = np.flatnonzero(~np.isfinite(factors))
    if len(wrong):
        got = f"{factors[wrong[0]]:g} at index {wrong[0]}"
        raise refusal(InvalidMotion, "scale", "grid", "a finite number", got)
    return {"scale": factors}


def _index_values(value: Any, name: str, kind: type[SeismassError]) -> IndexArray:
    """One index or a list of them, from 0; the first one where nothing is given."""
    requirement = "a whole number from 0, or a list of them"
    try:
        given = np.asarray(0 if value is None else value)
    except (TypeError, ValueError):
        raise refusal(kind, name, "grid", requirement, brief(value)) from None
    if given.dtype.kind not in "iu" or given.ndim > 1 or not given.size or np.ma.is_masked(value):
        raise refusal(kind, name, "grid", requirement, brief(value))
    wrong = np.flatnonzero((given.reshape(-1) < 0) | (given.reshape(-1) >= 2**32))
    if len(wrong):
        got = f"{given.reshape(-1)[wrong[0]]} at index {wrong[0]}"
        raise refusal(kind, name, "grid", requirement, got)
    indices = given.reshape(-1).astype(np.int64)
    indices.setflags(write=False)
    return indices
