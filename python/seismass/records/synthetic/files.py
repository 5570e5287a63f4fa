"""Files of the built-in suite: .AT2 with the word SYNTHETIC first, and the lists of the seven and of all eleven."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.files import written_whole
from seismass.base.units import STANDARD_GRAVITY
from seismass.records.builtin import MICRO
from seismass.records.record import Record
from seismass.records.synthetic.scenarios import SCENARIOS, generate_scenario
from seismass.records.synthetic.second import generate_second, seed_of
from seismass.records.synthetic.seven import RECIPES, Recipe, generate
from seismass.records.synthetic.site import SITE_RECIPES, SiteRecipe, generate_site

if TYPE_CHECKING:
    import polars as pl

ALL_RECIPES: Final = (*RECIPES, *SITE_RECIPES)

LISTS: Final = {"seven.csv": RECIPES, "suite.csv": ALL_RECIPES}
"""Lists of motions and what they name, in order."""


def version(recipe: Recipe | SiteRecipe) -> int:
    """Return the version of the generator that a recipe is for, as the first line of its file gives it."""
    return 1 if isinstance(recipe, Recipe) else 2


def made(recipe: Recipe | SiteRecipe) -> Record:
    """Make the motion of a recipe."""
    return generate(recipe) if isinstance(recipe, Recipe) else generate_site(recipe)


def at2_text(record: Record, generator: int = 1) -> str:
    """Return the record as .AT2 in g, labelled as synthetic in its first line. Version 1 has eight digits of a number,
    version 2 seven decimals: 1e-7 g is far above differences between machines.
    """
    rows = record.acceleration / STANDARD_GRAVITY + 0.0  # no minus sign before a zero
    if generator > 1:
        rows = rows.round(7) + 0.0
    header = (
        f"SYNTHETIC MOTION, NOT A RECORDING (seismass generator, version {generator})",
        f"{record.event}, {record.station}, {record.component}",
        "ACCELERATION TIME SERIES IN UNITS OF G",
        f"NPTS= {record.samples:6d}, DT= {record.dt:9.5f} SEC",
    )
    form = "16.7E" if generator == 1 else "12.7f"
    lines = ("".join(f"{value:{form}}" for value in rows[i : i + 5]) for i in range(0, len(rows), 5))
    return "\n".join((*header, *lines)) + "\n"


def write_motion(directory: Path, recipe: Recipe | SiteRecipe) -> None:
    """Write the motion of a recipe as an .AT2 file."""
    text = at2_text(made(recipe), version(recipe))
    with written_whole(directory / f"{recipe.name}.AT2") as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


def write_list(file: Path, recipes: Iterable[Recipe | SiteRecipe]) -> None:
    """Write a list of motions as `read_suite` takes it."""
    with written_whole(file) as temporary, temporary.open("w", newline="", encoding="utf-8") as stream:
        rows = csv.writer(stream, lineterminator="\n")
        rows.writerow(("number", "event", "station", "file", "note"))
        for recipe in recipes:
            rows.writerow((recipe.number, "synthetic", "none", f"{recipe.name}.AT2", recipe.note))


def forty_table() -> pl.DataFrame:
    """Make the forty motions: a row each, with its class and its samples as whole numbers of 1e-6 g."""
    import polars as pl

    rows = []
    for scenario in SCENARIOS:
        record = generate_scenario(scenario)
        samples = _stored(record)
        row = {name: getattr(scenario, name) for name in ("name", "seed", "magnitude", "distance", "site", "note")}
        rows.append({**row, "parameters": record.remarks[1], "dt": record.dt, "acceleration": samples})
    return pl.DataFrame(rows, schema_overrides={"acceleration": pl.List(pl.Int32)})


def seconds_table() -> pl.DataFrame:
    """Make the second components of the forty: a row each, with the name of the first and its samples as of that."""
    import polars as pl

    rows = []
    for scenario in SCENARIOS:
        record = generate_second(scenario)
        about = {"name": record.name, "first": scenario.name, "seed": seed_of(scenario), "note": record.remarks[0]}
        rows.append({**about, "parameters": record.remarks[1], "dt": record.dt, "acceleration": _stored(record)})
    return pl.DataFrame(rows, schema_overrides={"acceleration": pl.List(pl.Int32)})


def _stored(record: Record) -> NDArray[np.int32]:
    """Samples as whole numbers of 1e-6 g."""
    return np.rint(record.acceleration / (MICRO * STANDARD_GRAVITY)).astype(np.int32)


def write_suite(directory: Path) -> None:
    """Write every motion as an .AT2 file, the lists that name them, and the tables of the forty and their seconds."""
    directory.mkdir(parents=True, exist_ok=True)
    for recipe in ALL_RECIPES:
        write_motion(directory, recipe)
    for name, recipes in LISTS.items():
        write_list(directory / name, recipes)
    for name, table in (("forty.parquet", forty_table()), ("forty_second.parquet", seconds_table())):
        table.write_parquet(directory / name, compression="zstd", compression_level=19)
