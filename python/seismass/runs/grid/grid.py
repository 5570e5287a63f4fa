"""Many scenes described by columns, not by objects: aligned columns, or the product of axes, formed as it is needed."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import Any, Final, Self, Unpack, get_args

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass.base.arguments import as_word, is_one_of
from seismass.base.errors import DoubtfulInput, InvalidOption, InvalidScene
from seismass.base.fork_check import require_polars
from seismass.base.values import FieldValue, FloatArray, as_count, as_number, brief, counted, refusal
from seismass.base.views import Card
from seismass.model.block import Block
from seismass.model.building import Building, chain_kernel
from seismass.model.scene import Scene
from seismass.model.springs import SHAPE_FIELDS
from seismass.runs.grid.columns import (
    ATTACHED_DAMPING,
    ATTACHED_OF,
    AXIS_OF,
    AttachedDamping,
    AttachedOf,
    BuildingColumns,
    Column,
    GridAxis,
    GridOptions,
    IndexArray,
    Roof,
    as_stated,
    axes_of,
    axis_lengths,
    block_values,
    changing_values,
    described,
    grid_options,
    index_values,
    listed_buildings,
    number_values,
    refuse_first,
    share_values,
    table_of,
    takes_grid_options,
)
from seismass.runs.grid.sample import CHANGING, SampleMethod, StrengthDesign, sampled_arguments

MAX_SCENES: Final = 2**53
"""Most scenes of a grid: beyond, doubles in which numbers of scenes may be read skip some."""
_CHECKED_AT_ONCE: Final = 2**16


class Grid(FieldValue, Card):
    """Scenes that differ in building, blocks and intensity, described by columns: a million need no million objects.

    A column is one value for all scenes, a list with one value per scene, or, for what blocks or storeys have, a table
    of scenes by blocks or storeys (a table of one row holds for all scenes). All scenes start at rest. `Grid.product`
    makes every combination of values instead. Scenes, buildings, motions, floors and blocks are counted from 1.

    Parameters
    ----------
    building : Building or sequence of Building, optional
        The building of all scenes, or those that `building_index` chooses from. Either it or `storeys` is needed.
    storeys : array_like of int, optional
        Number of storeys of each scene's building: `Building.uniform` with the first period that `period` gives.
    period : array_like, optional
        First period (s) of the building without live load. A building that is given has its stiffnesses, and a damping
        matrix, changed to have it.
    building_index : array_like of int, optional
        Number of the building of each scene, from 1; needed where several are given.
    strength : array_like, optional
        Factor of the V_y of each scene's building: 1/R where buildings are given with their elastic demand V_e.
    yield_shear_over_weight : array_like, optional
        V_y of each scene over the weight of its building without live load, instead of `strength`: one value for all
        storeys, or a row per scene, whose length is its number of storeys.
    R : array_like, optional
        Response modification factor of each scene, instead of `strength`: V_y is V_e / R by `design`.
    design : StrengthDesign, optional
        Spectrum and share of the design live load that give V_e; needed where R is given.
    overstrength, second_slope, ... : array_like, optional
        What shapes the springs of all storeys of each scene: the arguments of `Building` beside stiffness and strength.
    floors : array_like of int, optional
        Floor of each block, counted from 1; several blocks may share one. By default a block on every floor.
    roof : {"loaded", "bare"}, default "loaded"
        "bare": no block on the uppermost floor of each scene's own building, which floors that are given cannot tell.
    mass_ratio : array_like, optional
        Design live load over floor mass; 0: the scene has no such block. No scene has blocks where it is left out.
    occupancy : array_like, optional
        Share of the design live load that is present, 0 or more; 1 by default. A table of scenes by blocks where it
        differs from block to block.
    attached : array_like, optional
        Share of the live load, 0 to 1, that is attached to its floor as mass; 0 by default. To 2 with `attached_of`
        "design", as more than the design live load may be present.
    attached_of : {"present", "design"}, default "present"
        Of which live load that is a share: of what is present, as for goods that are tied down, or of the design live
        load, as for the fraction of a code, which does not know the occupancy.
    sliding : array_like, optional
        Share of the live load that is present, 0 to 1, that is a block; what is not attached by default. A code's
        model, which counts a quarter of the load and lets nothing slide, has `attached=0.25, sliding=0`.
    damping : {"same", "ratio"}, default "same"
        Where live load is attached: the damping matrix of the building without it, or that of the building's damping
        ratio with it.
    mu : array_like, optional
        Friction coefficient, static and kinetic. Where there are blocks, either it or `mu_s` is needed.
    mu_s, mu_k : array_like, optional
        Static and kinetic coefficients, mu_s >= mu_k >= 0; mu_k is mu_s by default.
    scale : array_like, optional
        Factor of the motion of each scene, both components; 1 by default.
    motion : array_like of int, optional
        Number of the motion of each scene, from 1, which then has one run. By default each scene is run under every
        motion.
    collapse_drift : float, optional
        Drift (m) at which any storey of any scene counts as collapsed.

    Attributes
    ----------
    buildings : tuple of Building
        The buildings as given, or one for each number of storeys and period.
    floors : tuple of int
        Floor of each block.

    Raises
    ------
    InvalidScene
        Columns differ in length, or a row describes no valid scene; the message names the first one, from 1.
    InvalidMotion
        A factor is not a finite number.
    InvalidOption
        A number of a motion is below 1, or there are too many scenes.

    Notes
    -----
    With P-Delta from gravity loads, the weight of the live load that is present is there, whatever share of it counts
    as mass or slides. A `geometric_stiffness` stays as given.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.2, 0.12])
    >>> grid = sm.Grid(building, mass_ratio=[0.5, 0.5, 1.0], mu=[0.2, 0.3, 0.3], scale=2.0)
    >>> len(grid)
    3
    >>> grid.scene(3).blocks
    (Block(floor=1, mass_ratio=1, mu=0.3), Block(floor=2, mass_ratio=1, mu=0.3))

    Bare roofs of two, three and four storeys, with sliding goods and as a code has them:

    >>> grid = sm.Grid.product(
    ...     storeys=[2, 3, 4],
    ...     period=[0.38, 0.47, 0.57],
    ...     roof="bare",
    ...     mass_ratio=[0.5, 1.0, 1.5],
    ...     attached=[0.0, 0.25],
    ...     sliding=[1.0, 0.0],
    ...     mu=0.4,
    ... )
    >>> len(grid), len(grid.scene(18).blocks), grid.scene(18).building.mass.tolist()
    (18, 0, [1.375, 1.375, 1.375, 1.0])
    """

    buildings: tuple[Building, ...]
    floors: tuple[int, ...]
    collapse_drift: float | None
    _length: int
    _columns: dict[str, Column[np.float64]]
    _indices: dict[str, Column[np.int64]]
    _formed: BuildingColumns
    _everywhere: bool
    _roof_is_bare: bool
    __slots__ = tuple(__annotations__)

    def __getstate__(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in self.__slots__}

    def __setstate__(self, state: dict[str, Any]) -> None:
        for name, value in state.items():
            setattr(self, name, value)

    @takes_grid_options
    def __init__(
        self,
        building: Building | Sequence[Building] | None = None,
        *,
        building_index: ArrayLike | None = None,
        motion: ArrayLike | None = None,
        **options: Unpack[GridOptions],
    ) -> None:
        settings = grid_options(dict(options), "Grid")
        storeys = settings["storeys"]
        index, periods = self._set_common(building, settings)
        if storeys is not None:
            if building_index is not None:
                raise refusal(InvalidScene, "building_index", "grid", "left out where storeys is given", "both")
        elif building_index is None and len(self.buildings) > 1:
            raise refusal(InvalidScene, "building_index", "grid", "given where there are several buildings", "none")
        else:
            index = index_values(building_index, "building_index", InvalidScene)
        values = self._values(settings)
        indices = {"building": index}
        if motion is not None:
            indices["motion"] = index_values(motion, "motion", InvalidOption)
        lengths = {name: len(column) for name, column in (*values.items(), *indices.items())}
        self._length = max(lengths.values())
        for name, length in lengths.items():
            if length not in (1, self._length):
                requirement = f"one value, or as many as the longest column has, {self._length}"
                what = "storeys" if name == "building" and storeys is not None else as_stated(name, settings["mu"])
                raise refusal(InvalidScene, what, "grid", requirement, f"{length} values")
        self._columns = {name: Column(column) for name, column in values.items()}
        self._indices = {name: Column(column) for name, column in indices.items()}
        self._set_formed(periods, settings["damping"], settings["attached_of"], settings["design"])
        self._check(range(self._length))

    @classmethod
    @takes_grid_options
    def product(cls, building: Building | Sequence[Building] | None = None, **options: Unpack[GridOptions]) -> Self:
        """Return every combination of the values of each axis, of which only the axes are held.

        The axes are building, period, strength or R, overstrength, slopes and what else shapes springs, mass ratio,
        occupancy, attached share, friction and scale, the last changing fastest: scenes that follow each other share
        propagators. Together they are one axis: `storeys` with `period`, `attached` with `sliding`, `mu_s` with `mu_k`.

        Parameters
        ----------
        building : Building or sequence of Building, optional
            The buildings.
        storeys, period : array_like, optional
            Numbers of storeys with the first period of each (s); or periods for every building.
        strength, R, overstrength, second_slope, ... : array_like, optional
            Values, each for all storeys.
        yield_shear_over_weight : array_like, optional
            Values for all storeys, or rows with one value per storey.
        mass_ratio, mu, mu_s, mu_k : array_like, optional
            One value, a list of values that all blocks share, or a table of values by blocks.
        occupancy, attached, sliding : array_like, optional
            Shares of the live load.
        scale : array_like, optional
            Factors of the motion.
        design, floors, roof, attached_of, damping, collapse_drift
            As for `Grid`.

        Raises
        ------
        InvalidScene, InvalidMotion, InvalidOption
            As for `Grid`.

        Warns
        -----
        DoubtfulInput
            One mass ratio loads the roof, and neither `roof` nor `floors` says that it is meant.

        Examples
        --------
        >>> import seismass as sm
        >>> building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.2, 0.12])
        >>> grid = sm.Grid.product(building, roof="loaded", mass_ratio=[0.5, 1.0], mu=[0.2, 0.3, 0.4], scale=[1.0, 2.0])
        >>> len(grid)
        12
        >>> grid.table(3, 4)["mu_s"].to_list()
        [0.3, 0.3]
        """
        settings = grid_options(dict(options), "Grid.product")
        grid = cls.__new__(cls)
        index, periods = grid._set_common(building, settings)
        values = grid._values(settings)
        one_ratio = "mass_ratio" in options and np.ndim(settings["mass_ratio"]) < 2
        if one_ratio and max(grid.floors, default=1) > 1 and not {"roof", "floors"} & set(options):
            warning = 'the roof carries goods, too: roof="bare" leaves it without, roof="loaded" says that it is meant'
            warnings.warn(warning, DoubtfulInput, stacklevel=2)
        if settings["storeys"] is None:
            index = np.arange(len(grid.buildings))
        lengths = {"building": len(index), **axis_lengths(values, settings["mu"])}
        each, total = {}, 1
        for axis in reversed(lengths):
            each[axis] = total
            total *= lengths[axis]
        if total > MAX_SCENES:
            raise refusal(InvalidOption, "scenes", "grid", f"at most {MAX_SCENES}", f"{total}")
        grid._length = total
        grid._columns = {name: Column(column, each[AXIS_OF[name]]) for name, column in values.items()}
        grid._indices = {"building": Column(index, each["building"])}
        grid._set_formed(periods, settings["damping"], settings["attached_of"], settings["design"])
        # Friction is judged by itself, all else with the first value of friction and scale.
        grid._check(range(0, total, each["attached"]))
        grid._check(range(0, each["attached"], each["friction"]))
        return grid

    @classmethod
    def sample(
        cls,
        building: Building | Sequence[Building] | None = None,
        *,
        samples: int | tuple[int, int, int],
        method: SampleMethod = "sobol",
        seed: int = 0,
        motions: int | None = None,
        mu_k_over_mu_s: Any = None,
        correlation: float = 0.0,
        crossed: Mapping[str, ArrayLike] | None = None,
        design: StrengthDesign | None = None,
        floors: ArrayLike | None = None,
        roof: Roof = "loaded",
        attached_of: AttachedOf = "present",
        damping: AttachedDamping = "same",
        collapse_drift: float | None = None,
        **axes: Any,
    ) -> Self:
        """Return a random sample of scenes.

        Parameters
        ----------
        building : Building or sequence of Building, optional
            The building, or several of which each is equally likely.
        samples : int or tuple of int
            Number of scenes. Three numbers are a nested sample: of each motion so many buildings, and of each building
            so many draws of what blocks have (`mass_ratio`, `occupancy`, `attached`, `sliding` and friction); all else
            is drawn once a building. The buildings of a seed do not depend on the number of draws of goods.
        method : {"sobol", "latin_hypercube", "random"}, default "sobol"
            Scrambled points of Sobol's sequence, balanced where their number is a power of 2; a Latin hypercube; or
            independent points. One dimension for each axis that is drawn (`scipy.stats.qmc`).
        seed : int, default 0
            The same seed gives the same sample.
        motions : int, optional
            Number of the motions of which each scene has one, equally likely; by default each scene has every motion.
        mu_k_over_mu_s : number, list of them or distribution, optional
            Instead of `mu_k`: the kinetic coefficient over the static one, which is `mu` or `mu_s`.
        correlation : float, default 0
            Correlation of the normal scores of blocks whose distributions are in one list, 0 to 1.
        crossed : mapping of str to array_like, optional
            Other arguments of `Grid` with values each of which every sample has, in every combination; the last one
            changes fastest.
        design, floors, roof, attached_of, damping, collapse_drift
            As for `Grid`.
        **axes
            Other arguments of `Grid`: `storeys`, `period`, `strength`, `R`, `yield_shear_over_weight`, what shapes the
            springs, `mass_ratio`, `occupancy`, `attached`, `sliding`, `mu`, `mu_s`, `mu_k`, `scale`. Each is a number;
            a list of values, or a table of rows, of which each is equally likely; or a distribution: anything with the
            quantiles `ppf`, as scipy.stats freezes it. Lists of `storeys` and `period` of one length are drawn
            together. A list with distributions draws one for each block, of `mass_ratio`, `occupancy` and friction.

        Raises
        ------
        InvalidScene, InvalidMotion, InvalidOption
            As for `Grid`; a value that was drawn may be out of its range, as from a normal distribution.

        Examples
        --------
        >>> import seismass as sm
        >>> building = sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13])
        >>> grid = sm.Grid.sample(
        ...     building,
        ...     samples=256,
        ...     seed=1,
        ...     mass_ratio=1.0,
        ...     occupancy=sm.distributions.beta(0.7, 0.15),
        ...     mu=sm.distributions.lognormal(0.4, 0.25),
        ...     scale=[0.5, 1.0, 2.0],
        ... )
        >>> grid.table()["mu_s"].median().__round__(2)
        0.4

        Each of 40 motions with 4 buildings, each of them with 2 loads, whose floors are alike by half, at two levels:

        >>> presence = sm.distributions.gamma(0.55, 0.5)
        >>> grid = sm.Grid.sample(
        ...     building,
        ...     samples=(40, 4, 2),
        ...     strength=sm.distributions.lognormal(1.5, 0.2),
        ...     floors=[1, 2],
        ...     mass_ratio=1.0,
        ...     occupancy=[presence, presence],
        ...     correlation=0.5,
        ...     mu=0.4,
        ...     crossed={"scale": [1.0, 1.5]},
        ... )
        >>> len(grid), grid.table()["strength"].n_unique()
        (640, 160)
        """
        drawn = sampled_arguments(
            building,
            axes,
            mu_k_over_mu_s,
            samples=samples,
            method=method,
            seed=seed,
            motions=motions,
            correlation=correlation,
            crossed={} if crossed is None else crossed,
        )
        return cls(
            building,
            design=design,
            floors=floors,
            roof=roof,
            attached_of=attached_of,
            damping=damping,
            collapse_drift=collapse_drift,
            **drawn,
        )

    def __len__(self) -> int:
        return self._length

    def scene(self, number: int) -> Scene:
        """Return one scene, counted from 1, as an object; its factor and its motion are in `table`.

        Raises
        ------
        InvalidOption
            There is no such scene.
        """
        index = as_count(number, "number", "grid", InvalidOption, least=1) - 1
        if index >= self._length:
            limits = f"that of a scene, counted from 1 to {self._length}"
            raise refusal(InvalidOption, "number", "grid", limits, str(number))
        scenes = np.array([index])
        formed = self._formed.of(scenes, self._building_of(scenes), self._per_block("mass_ratio", scenes))
        building = formed.buildings[int(formed.which[0])]
        ratio = formed.mass_ratio[0].tolist()
        static, kinetic = (self._per_block(name, scenes)[0].tolist() for name in ("mu_s", "mu_k"))
        blocks = [
            Block(floor, mass_ratio=ratio[j], mu_s=static[j], mu_k=kinetic[j])
            for j, floor in enumerate(self.floors)
            if ratio[j] != 0.0
        ]
        return Scene(building, blocks, collapse_drift=self.collapse_drift)

    def table(self, first: int = 1, last: int | None = None) -> pl.DataFrame:
        """Return the columns of the scenes from `first` to `last`, both included (default: all), as a frame.

        It has the number of the scene as `scene`, by which results are joined, the number of the `building`, its
        `storeys` and `period` (s, without live load), and of `strength`, `R`, `yield_shear_over_weight`, what shapes
        the springs, `mass_ratio`, `occupancy`, `attached`, `sliding`, `mu_s`, `mu_k`, `scale` and `motion` those that
        were given; lists where storeys or blocks differ.

        Raises
        ------
        InvalidOption
            A number is below 1 or not whole.
        SimulationError
            The process was forked from one in which Polars had been used.
        """
        require_polars("table")
        end = self._length if last is None else as_count(last, "last", "grid", InvalidOption)
        begin = as_count(first, "first", "grid", InvalidOption, least=1) - 1
        scenes = np.arange(begin, max(begin, min(end, self._length)))
        return table_of(self._described, scenes)

    def axes(self) -> list[GridAxis]:
        """Return what varies, each axis with its values: a product of any size has short ones.

        Examples
        --------
        >>> import seismass as sm
        >>> grid = sm.Grid.product(sm.Building.uniform(2, 0.3), mass_ratio=[0.5, 1.0], mu=[0.2, 0.3, 0.4])
        >>> [(axis.name, axis.each, axis.length) for axis in grid.axes()]
        [('constant', 1, 1), ('mass_ratio', 3, 2), ('friction', 1, 3)]
        """
        return axes_of(self._described, self._length)

    @property
    def _described(self) -> dict[str, Column[Any]]:
        return described(self.buildings, self._formed.periods, self._columns, self._indices)

    def __repr__(self) -> str:
        names = [name for name in self._columns if name != "mu_k"]
        columns = f", columns {', '.join(names)}" if names else ""
        parts = f"{counted(len(self.buildings), 'building')}, {counted(len(self.floors), 'block')} each"
        return f"Grid({counted(self._length, 'scene')}, {parts}{columns})"

    def _set_common(self, building: Any, settings: dict[str, Any]) -> tuple[IndexArray, FloatArray]:
        """Keep buildings, floors and collapse drift; return which building each value of storeys has, and periods."""
        floors, roof, mass_ratio = (settings[name] for name in ("floors", "roof", "mass_ratio"))
        collapse_drift = settings["collapse_drift"]
        self.buildings, index, periods = listed_buildings(building, settings["storeys"], settings["period"])
        self._everywhere = floors is None
        as_word(roof, get_args(Roof), "roof", "grid", InvalidScene)
        self._roof_is_bare = roof == "bare"
        if self._roof_is_bare and floors is not None:
            raise refusal(InvalidScene, "roof", "grid", "left out where floors is given", brief(roof))
        if mass_ratio is None:
            if floors is not None:
                raise refusal(InvalidScene, "floors", "grid", "left out where mass_ratio is", brief(floors))
            self.floors = ()
        elif floors is None:
            highest = max(item.storeys for item in self.buildings)
            self.floors = tuple(range(1, highest + 1 - self._roof_is_bare))
        else:
            self.floors = tuple((index_values(floors, "floors", InvalidScene) + 1).tolist())
        self.collapse_drift = (
            None if collapse_drift is None else as_number(collapse_drift, "collapse_drift", "grid", InvalidScene)
        )
        return index, periods

    def _values(self, settings: dict[str, Any]) -> dict[str, Any]:
        """Return the values of every column: of blocks, of buildings, of shares and of motions."""
        values = block_values(len(self.floors), *(settings[name] for name in ("mass_ratio", "mu", "mu_s", "mu_k")))
        changing = {name: settings[name] for name in ("strength", "R", "yield_shear_over_weight", *SHAPE_FIELDS)}
        period = None if settings["storeys"] is not None else settings["period"]
        values |= changing_values(self.buildings, period=period, **changing)
        shares = (settings[name] for name in ("attached", "sliding", "occupancy", "mass_ratio"))
        of_design = is_one_of(settings["attached_of"], ("design",))
        values |= share_values(*shares, blocks=len(self.floors), of_design=of_design)
        return values | number_values({"scale": settings["scale"]})

    def _set_formed(self, periods: FloatArray, damping: Any, attached_of: Any, design: Any) -> None:
        """Keep what forms the buildings of scenes, of columns that are known by now."""
        if not is_one_of(damping, ATTACHED_DAMPING):
            raise refusal(InvalidScene, "damping", "grid", "same or ratio, of attached live load", brief(damping))
        as_word(attached_of, ATTACHED_OF, "attached_of", "grid", InvalidScene)
        if design is not None and not isinstance(design, StrengthDesign):
            raise refusal(InvalidScene, "design", "grid", "a StrengthDesign", brief(design))
        if (design is None) != ("R" not in self._columns):
            requirement = "given where R is" if design is None else "left out where R is"
            raise refusal(InvalidScene, "design", "grid", requirement, "none" if design is None else brief(design))
        names = (*CHANGING, "occupancy", "attached", "sliding")
        columns = {name: column for name, column in self._columns.items() if name in names}
        self._formed = BuildingColumns(self.buildings, periods, self.floors, columns, damping, attached_of, design)

    def _per_block(self, name: str, scenes: IndexArray) -> FloatArray:
        """A property of the blocks of scenes, shape (scenes, blocks)."""
        shape = (len(scenes), len(self.floors))
        if name not in self._columns:
            return np.zeros(shape)
        values = self._columns[name].of(scenes)
        if name == "mass_ratio" and self._everywhere and (values.shape[1] == 1 or self._roof_is_bare):
            # A block on every floor of the scene's own building, the roof perhaps left out.
            storeys = np.array([building.storeys for building in self.buildings])[self._building_of(scenes)]
            loaded = np.array(self.floors, dtype=np.int64) <= storeys[:, None] - self._roof_is_bare
            return np.where(loaded, values, 0.0)
        return np.broadcast_to(values, shape)

    def _sliding(self, scenes: IndexArray) -> FloatArray:
        """Live load that slides over floor mass, shape (scenes, blocks); 0 where there is no block."""
        present = self._formed.present_of(scenes, self._per_block("mass_ratio", scenes))
        _, sliding = self._formed.shares_of(scenes)
        return present if sliding is None else present * sliding[:, None]

    def _kernel_columns(self, scenes: IndexArray) -> _kernel.Columns:
        """Scenes as the kernel takes them."""
        live_load = self._per_block("mass_ratio", scenes)
        formed = self._formed.of(scenes, self._building_of(scenes), live_load)
        return _kernel.Columns(
            [chain_kernel(building, "grids") for building in formed.buildings],
            self.floors,
            formed.which,
            formed.mass_ratio,
            self._per_block("mu_s", scenes),
            self._per_block("mu_k", scenes),
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
        limits = f"the number of a motion, counted from 1 to {motions}"
        refuse_first(index >= motions, index + 1, InvalidOption, "motion", limits, str)

    def _check(self, numbers: range) -> None:
        """Let the kernel judge scenes by their numbers."""
        index, count = self._indices["building"].values, len(self.buildings)
        limits = f"the number of a building, counted from 1 to {count}"
        refuse_first(index >= count, index + 1, InvalidScene, "building_index", limits, str)
        for first in range(0, len(numbers), _CHECKED_AT_ONCE):
            scenes = np.array(numbers[first : first + _CHECKED_AT_ONCE])
            self._kernel_columns(scenes).check(scenes + 1)
