"""The rows of a batch in the long format: one row per run and storey, with what the scenes are beside what they did."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption
from seismass.base.fork_check import require_polars
from seismass.base.values import as_one_of, brief, refusal
from seismass.model.scene import Scene
from seismass.runs.batch_tables import PER_BLOCK, PER_STOREY, listed_scenes
from seismass.runs.grid.columns import TABLE_COLUMNS, table_of
from seismass.runs.grid.grid import Grid
from seismass.runs.quantities import QUANTITIES, names_read_by
from seismass.runs.response import Response

_HISTORIES: Final = ("_history", "_displacement", "_histories_of_racks", "_ground")  # methods of a response
_OF_RUN: Final = ("status", "reason", "end_time", "collapsed_storey", "peak_base_shear", "events", "yields", "slips")


def long_table(table: pl.DataFrame, scenes: Scene | Iterable[Scene] | Grid) -> pl.DataFrame:
    """Return the rows of `simulate_many` with one row per run and storey.

    Parameters
    ----------
    table : polars.DataFrame
        Rows of `simulate_many`, of a frame of `stream_many`, or of the file of `write_many`; any of them, in any order.
    scenes : Scene, sequence of Scene, or Grid
        The scenes that were solved, all of them, as they were given to it.

    Returns
    -------
    polars.DataFrame
        For each row of `table`, in its order, a row per storey from 1: `run` (number of the row, from 1), `scene`,
        `motion`, `record`; `storeys` and first `period` (s) of the building without blocks; of a grid the columns of
        `Grid.table`, so `building`, `mass_ratio`, `mu_s` and whatever else it varies, those that have a value per
        storey or block taken at the row's storey; `storey`; what the batch has per storey; `block`, the number of the
        block on the row's floor, and what the batch has per block; then what it has per run. SI units.

        Of several blocks on a floor the one with the largest peak slip is taken, all its values with it. Where there is
        no block on the floor they are null. Goods of a rack count on the floor on which it stands. Blocks on the ground
        have no row. A run that failed has one row, its storey
        null; so has a scene without a building.

    Raises
    ------
    InvalidScene
        The scenes are not what they must be.
    InvalidOption
        The table lacks columns of a batch, or has a scene that was not given.
    SimulationError
        The process was forked from one in which Polars had been used.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.2, 0.12])
    >>> grid = sm.Grid.product(building, roof="bare", mass_ratio=[0.5, 1.0], mu=[0.1, 0.3])
    >>> table = sm.long_table(sm.simulate_many(grid, sm.builtin_suite("seven")), grid)
    >>> table.columns[:9]
    ['run', 'scene', 'motion', 'record', 'building', 'storeys', 'period', 'mass_ratio', 'mu_s']
    >>> table.filter(table["storey"] == 2)["peak_slip"].null_count(), len(table)
    (28, 56)
    """
    require_polars("long_table")
    _check_table(table)
    described, blocks = _of_grid(scenes, table) if isinstance(scenes, Grid) else _of_scenes(scenes, table)
    runs = table.with_row_index("run", offset=1)
    number = _numbered(runs, "peak_drift").select("run", "scene", "motion", "record", *_OF_RUN, storey="number")
    long = pl.concat([number, _flat(runs, PER_STOREY)], how="horizontal")
    slid = _numbered(runs, "peak_slip").select("run", "scene", block="number")
    of_blocks = (
        pl.concat([slid, _flat(runs, PER_BLOCK)], how="horizontal")
        .join(blocks, on=["scene", "block"], how="inner", maintain_order="left")
        .drop("scene")
    )
    if blocks.select("scene", "storey").is_duplicated().any():
        of_blocks = of_blocks.sort("run", "storey", "peak_slip", descending=[False, False, True], maintain_order=True)
        of_blocks = of_blocks.unique(["run", "storey"], keep="first", maintain_order=True)
    joined = long.join(described, on="scene", how="left", maintain_order="left").join(
        of_blocks, on=["run", "storey"], how="left", maintain_order="left"
    )
    strength = "yield_shear_over_weight"
    if isinstance(described.schema.get(strength), pl.List):
        joined = joined.with_columns(pl.col(strength).list.get(pl.col("storey").cast(pl.Int64) - 1, null_on_oob=True))
    by_floor = [name for name in blocks.columns if name not in ("scene", "storey", "block")]
    of_scene = [name for name in described.columns if name != "scene"]
    varied = [name for name in TABLE_COLUMNS if name in of_scene or name in by_floor]
    return joined.select(
        "run", "scene", "motion", "record", *varied, "storey", *PER_STOREY, "block", *PER_BLOCK, *_OF_RUN
    )


Places: TypeAlias = Literal["storeys", "blocks", "levels", "ground"]
"""What has histories: storeys with their floors, blocks, levels of all racks one rack after the other, the ground."""


def history_table(response: Response, places: Places = "storeys") -> pl.DataFrame:
    """Return the histories of a run with one row per time and place.

    Parameters
    ----------
    response : Response
        A run with histories.
    places : {"storeys", "blocks", "levels", "ground"}, default "storeys"
        What they are of: storeys with their floors, blocks, levels of racks (counted on from rack to rack), the ground.

    Returns
    -------
    polars.DataFrame
        `time` (s); `storey`, `block` or `level` from 1; and the histories of `Response` that were kept, by their names
        and in SI units. `to_pandas()` gives a table of pandas, and of that `set_index(["time", "storey"]).to_xarray()`
        a data set of xarray.

    Raises
    ------
    InvalidOption
        No histories were kept, or there are no such places.
    SimulationError
        The process was forked from one in which Polars had been used.

    Examples
    --------
    >>> import seismass as sm
    >>> scene = sm.Scene(sm.Building.uniform(2, 0.3), sm.blocks_on_floors([0.5, 0.0], mu=0.1))
    >>> response = sm.simulate(scene, sm.Motion([2.0, 2.0, 0.0, 0.0], dt=0.1), histories=True)
    >>> sm.runs.history_table(response).columns[:4], sm.runs.history_table(response, "blocks").shape
    (['time', 'storey', 'drift', 'floor_velocity'], (4, 4))
    """
    require_polars("history_table")
    as_one_of(response, Response, "response", "history_table", InvalidOption)
    as_word(places, get_args(Places), "places", "history_table")
    time, columns = response.time, {}
    for name in (name for method in _HISTORIES for name in names_read_by(Response, method)):
        if QUANTITIES[name].places == ("" if places == "ground" else places):
            with suppress(InvalidOption):  # displacements alone were kept
                values = getattr(response, name)
                columns[name] = np.column_stack(values) if isinstance(values, tuple) and values else values
    count = 1 if places == "ground" else max((len(values.T) for values in columns.values() if len(values)), default=0)
    if not count:
        raise refusal(InvalidOption, "places", "history_table", "what the scene has", brief(places))
    table = {"time": np.repeat(time, count)}
    if places != "ground":
        table[places.removesuffix("s")] = np.tile(np.arange(1, count + 1, dtype=np.uint32), len(time))
    return pl.DataFrame(table | {name: values.reshape(-1) for name, values in columns.items()})


def _check_table(table: Any) -> None:
    needed = {"scene", "motion", "record", *PER_STOREY, *PER_BLOCK, *_OF_RUN}
    missing = sorted(needed - set(table.columns)) if isinstance(table, pl.DataFrame) else None
    if missing is None or missing:
        got = brief(table) if missing is None else f"none of {', '.join(missing)}"
        raise refusal(InvalidOption, "table", "long_table", "rows of a batch", got)


def _numbered(runs: pl.DataFrame, name: str) -> pl.DataFrame:
    """Every run once per value of its list `name`, numbered from 1; once with null where there is none."""
    count = runs[name].list.len().fill_null(0).to_numpy().astype(np.int64)
    rows = np.maximum(count, 1)
    first = np.repeat(np.cumsum(rows) - rows, rows)
    number = pl.Series("number", (np.arange(len(first)) - first + 1).astype(np.uint32))
    lists = [column for column, dtype in runs.schema.items() if isinstance(dtype, pl.List)]
    repeated = runs.drop(lists)[np.repeat(np.arange(len(rows)), rows)]
    has = pl.Series(np.repeat(count > 0, rows))
    return repeated.with_columns(number=pl.select(pl.when(has).then(number)).to_series())


def _flat(runs: pl.DataFrame, names: tuple[str, ...]) -> pl.DataFrame:
    """Lists of equal lengths one below the other; null once for a run whose first list is empty or null."""
    count = pl.col(names[0]).list.len().fill_null(0)
    unknown = pl.lit(None, pl.Float64).repeat_by(pl.max_horizontal(count, 1))
    filled = (
        pl.when((count > 0) & (pl.col(name).list.len() == count)).then(pl.col(name)).otherwise(unknown).alias(name)
        for name in names
    )
    return runs.select(filled).explode(*names)


def _of_grid(grid: Grid, table: pl.DataFrame) -> tuple[pl.DataFrame, pl.DataFrame]:
    """What describes the scenes of a table, and their blocks: number, floor, and what has a value per block."""
    used = _used(table, len(grid))
    scenes = used - 1
    described = table_of(grid._described, scenes).drop("motion", strict=False)
    per_block = [name for name in ("mass_ratio", "mu_s", "mu_k") if isinstance(described.schema.get(name), pl.List)]
    row, column = np.nonzero(grid._sliding(scenes))
    blocks = _block_table(used[row], np.array(grid.floors, dtype=np.int64)[column])
    blocks = blocks.with_columns(
        pl.Series(name, grid._per_block(name, scenes)[row, column], dtype=pl.Float64) for name in per_block
    )
    return described.drop(per_block), blocks


def _of_scenes(scenes: Any, table: pl.DataFrame) -> tuple[pl.DataFrame, pl.DataFrame]:
    """As `_of_grid`, of scenes that are objects."""
    listed = listed_scenes(scenes, "long_table")
    used = _used(table, len(listed))
    scenes_used = [listed[number - 1] for number in used.tolist()]
    periods = [None if scene.building is None else float(scene.building.periods[0]) for scene in scenes_used]
    described = pl.DataFrame(
        {
            "scene": used.astype(np.uint64),
            "storeys": pl.Series([scene.storeys for scene in scenes_used], dtype=pl.UInt32),
            "period": pl.Series(periods, dtype=pl.Float64),
        }
    )
    counts = [len(scene.goods_floor) for scene in scenes_used]
    floors = [floor for scene in scenes_used for floor in scene.goods_floor]
    return described, _block_table(np.repeat(used, counts), np.array(floors, dtype=np.int64))


def _used(table: pl.DataFrame, scenes: int) -> NDArray[np.int64]:
    """Numbers of the scenes that a table has, in order."""
    used = np.unique(table["scene"].to_numpy()).astype(np.int64)
    if len(used) and not 1 <= used[0] <= used[-1] <= scenes:
        got = str(used[0] if used[0] < 1 else used[-1])
        limits = f"the number of a scene that is given, counted from 1 to {scenes}"
        raise refusal(InvalidOption, "scene", "long_table", limits, got)
    return used


def _block_table(scene: NDArray[np.int64], floor: NDArray[np.int64]) -> pl.DataFrame:
    """Blocks of scenes, which follow each other, counted from 1 in each; those on the ground are left out."""
    _, first, count = np.unique(scene, return_index=True, return_counts=True)
    block = np.arange(len(scene)) - np.repeat(first, count) + 1
    columns = {"scene": scene, "block": block, "storey": floor}
    blocks = pl.DataFrame(columns).cast({"scene": pl.UInt64, "block": pl.UInt32, "storey": pl.UInt32})
    return blocks.filter(pl.col("storey") > 0)
