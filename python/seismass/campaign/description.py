"""Campaign files: axes or samples, motions and what to keep, from TOML or JSON. Every key is known or refused."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from seismass.base.errors import InvalidCampaignFile
from seismass.base.input_kinds import CAMPAIGN_FILE, refuse_other_kind
from seismass.base.input_table import Table, load_table
from seismass.base.values import as_path, brief
from seismass.campaign.folder import Campaign
from seismass.campaign.values import axis_values
from seismass.records import Record, Suite, builtin_suite, read_suite
from seismass.records.builtin import data_directory
from seismass.runs.grid.grid import Grid
from seismass.runs.grid.sample import SAMPLED
from seismass.runs.scene_file import building_of_table
from seismass.spectra import TargetSpectrum

SCALINGS: Final = ("none", "asce7-10", "asce7-16")
"""How a campaign file may scale its motions."""

_SETTINGS: Final = ("floors", "roof", "damping", "attached_of", "collapse_drift")
TABLES: Final = {
    "": ("name", "note", "part_runs", "peaks_only", "columns", "single", "motions", "building", "grid", "sample"),
    "motions": ("builtin", "records", "scaling", "target", "period"),
    "grid": (*SAMPLED, *_SETTINGS, "design"),
    "grid.design": ("target", "share", "elastic_at_one", "combination"),
    "sample": ("samples", "method", "seed", "one_motion"),
}
"""Keys of each table of a campaign file, the file itself first; `building` has those of a scene file."""


def example_description() -> Path:
    """Return the campaign file that ships with the package: friction, goods and intensity of a warehouse."""
    return data_directory() / "examples" / "campaign.toml"


def read_campaign(source: str | os.PathLike[str] | Mapping[str, Any]) -> Campaign:
    """Read a campaign file.

    Parameters
    ----------
    source : path-like or mapping
        A .toml or .json file with the keys of docs/campaign.md, or its tables as a dict. Paths in it are relative to
        its folder.

    Raises
    ------
    InvalidCampaignFile
        The file cannot be read, or has an unknown, missing or contradicting key.
    InvalidScene, InvalidMotion, InvalidOption
        A value is not what it must be.
    RecordFormatError
        Motions that it names cannot be read.

    Examples
    --------
    >>> import seismass as sm
    >>> campaign = sm.campaign.read_campaign({
    ...     "motions": {"builtin": "seven"},
    ...     "building": {"storeys": 2, "period": 0.3, "yield_shear_over_weight": [0.2, 0.12]},
    ...     "grid": {"mass_ratio": [0.5, 1.0], "mu": {"from": 0.1, "to": 0.5, "count": 5}, "scale": [0.5, 1.0]},
    ... })
    >>> campaign.total
    140
    """
    if isinstance(source, Mapping):
        folder, top = Path(), Table(dict(source), "", "campaign", InvalidCampaignFile)
    else:
        path = as_path(source, "campaign file", InvalidCampaignFile)
        folder, top = path.parent, load_table(path, "campaign file", InvalidCampaignFile)
    refuse_other_kind(top, CAMPAIGN_FILE)
    top.known(TABLES[""])
    top.text("note")
    top.needed("grid")
    suite = _suite(top.table("motions") if "motions" in top.values else None, folder, top)
    options: dict[str, Any] = {name: top.flag(name, False) for name in ("peaks_only", "single") if name in top.values}
    columns = top.values.get("columns")
    if columns is not None and not (isinstance(columns, list) and all(isinstance(name, str) for name in columns)):
        top.refuse("columns", "a list of names", brief(columns))
    if "part_runs" in top.values:
        options["part_runs"] = top.count("part_runs")
    grid = _grid(top, folder, len(suite))
    return Campaign(grid, suite, name=top.text("name"), columns=columns, **options)


def _suite(table: Table | None, folder: Path, top: Table) -> list[Record]:
    """The motions, scaled."""
    from seismass.scaling import scale_asce7_10, scale_asce7_16

    if table is None:
        top.refuse("motions", "given, with builtin or records", "nothing")
    table.known(TABLES["motions"])
    table.needed("builtin", "records")
    table.excluded("records", "builtin")
    suite: Suite
    if "builtin" in table.values:
        name = table.choice("builtin", ("seven", "eleven"), requirement="seven or eleven")
        suite = builtin_suite("seven" if name == "seven" else "eleven")
    else:
        suite = read_suite(folder / table.text("records"))
    scaling = table.choice("scaling", SCALINGS, SCALINGS[0])
    if scaling == "none":
        table.left_out(("target", "period"), f"{table.key('scaling')} is none")
        return list(suite)
    target = _target(table, folder) if "target" in table.values else TargetSpectrum.asce7()
    scale = scale_asce7_10 if scaling == "asce7-10" else scale_asce7_16
    factors = scale(suite, target, table.number("period", 1.0)).factors
    return [record.scaled(float(factor)) for record, factor in zip(suite, factors, strict=True)]


def _target(table: Table, folder: Path) -> TargetSpectrum:
    from seismass.scaling.target_text import target_of

    text = table.text("target")
    file = folder / text
    return TargetSpectrum.from_csv(file) if file.is_file() else target_of(text)


def _grid(top: Table, folder: Path, motions: int) -> Grid:
    table = top.table("grid")
    table.known(TABLES["grid"])
    building = None
    if "building" in top.values:
        table.excluded("storeys", "building")
        if "storeys" in table.values:
            table.refuse("storeys", "left out where building is given", "both")
        building = building_of_table(top.table("building"))
    elif "storeys" not in table.values:
        table.refuse("storeys", "given, or building", "nothing")
    sampled = "sample" in top.values
    given: dict[str, Any] = {key: axis_values(table, key, sampled=sampled) for key in SAMPLED if key in table.values}
    given |= table.given(*_SETTINGS)
    if "design" in table.values:
        given["design"] = _design(table.table("design"), folder)
    if not sampled:
        return Grid.product(building, **given)
    sample = top.table("sample")
    sample.known(TABLES["sample"])
    sample.needed("samples")
    options: dict[str, Any] = {"samples": sample.count("samples")}
    if "method" in sample.values:
        options["method"] = sample.text("method")
    if "seed" in sample.values:
        options["seed"] = sample.count("seed")
    if sample.flag("one_motion", False):
        options["motions"] = motions
    return Grid.sample(building, **options, **given)


def _design(table: Table, folder: Path) -> Any:
    from seismass.runs.grid.design import StrengthDesign

    table.known(TABLES["grid.design"])
    table.needed("target")
    return StrengthDesign(_target(table, folder), **table.given(*TABLES["grid.design"][1:]))
