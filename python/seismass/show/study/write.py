"""The folder of a study: its tables, documents, figures and page; text and figures of its results."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import polars as pl

from seismass.base.arguments import ProgressLike
from seismass.base.errors import InvalidOption
from seismass.base.folders import write_folder
from seismass.base.values import as_path
from seismass.media.result import ANIMATION, PAGE, named_figure, result_files
from seismass.media.text_table import change_text, text_table
from seismass.show.study.answer import DAMPING_TEXTS, findings_text
from seismass.studies.study.run import OWN_TABLES, StudyResult, motions_text
from seismass.studies.study.sensitivity import Sensitivity
from seismass.studies.study.tables import TABLES

if TYPE_CHECKING:
    from matplotlib.figure import Figure


_NUMBER: Final = r"[\d.]+(?:e[+-]\d+)?"
FIGURE_FILE: Final = re.compile(
    rf"(?:spectrum|effective|sensitivity|(?:underestimation|heat|slip)(?:_mu{_NUMBER})?|drift_R{_NUMBER}(?:_mu{_NUMBER})?"
    r"|section4_[\w.-]+|platform_[\w.-]+)\.(?:png|svg)"
)
"""Names of the files of a study's figures."""


def write_study(
    result: StudyResult,
    out: Path,
    *,
    figures: bool = True,
    png: bool = False,
    progress: ProgressLike = None,
) -> list[Path]:
    """Write tables (Parquet with units and inputs, CSV), JSON documents, figures (SVG) and the page of a study to a
    folder; return the files. Those of an earlier study in files.json are removed.
    """
    tables = result.tables
    documents = {"tables.json": _json(_tables_document(result.metadata, tables)), "study.json": _json(result.to_dict())}
    if result.animation is not None:
        documents[ANIMATION] = _json(result.animation, indent=None)
    drawn: dict[str, Figure] = {}
    if figures:
        drawn, drawings = _drawn(result, progress)
        documents |= {f"{name}.svg": drawing for name, drawing in drawings.items()}
        documents[PAGE] = _page(result, drawings)
    ours = {PAGE, ANIMATION} | {
        f"{name}.{kind}" for name in TABLES if name not in OWN_TABLES for kind in ("parquet", "csv")
    }
    files = result_files(
        tables=tables,
        documents=documents,
        figures=drawn if png else None,
        kinds=("png",),
        metadata={name: table_metadata(result.metadata, name, table) for name, table in tables.items()},
    )
    return write_folder(
        out, files, earlier=lambda name: name in ours or FIGURE_FILE.fullmatch(name) is not None, owner="study"
    )


def whole_page(result: StudyResult, edited: tuple[str, ...] = (), progress: ProgressLike = None) -> str:
    """Return the page of a study with its figures; `edited` are files that were edited; `progress` as above."""
    return _page(result, _drawn(result, progress)[1], edited)


def _page(result: StudyResult, drawings: dict[str, str], edited: tuple[str, ...] = ()) -> str:
    from seismass.media.svg import figure_svgs
    from seismass.show.study.figures import phone_figures
    from seismass.show.study.page import study_page

    return study_page(result, drawings, figure_svgs(phone_figures(result)), edited)


def _drawn(result: StudyResult, progress: ProgressLike) -> tuple[dict[str, Figure], dict[str, str]]:
    """Figures and their SVG texts, each drawn once for its file and for the page."""
    from seismass.media.style import fewer_collections
    from seismass.media.svg import figure_svgs
    from seismass.show.study.figures import page_figures

    with fewer_collections():
        figures = page_figures(result)
        return figures, figure_svgs(figures, progress)


def _json(document: dict[str, Any], indent: int | None = 2) -> str:
    return json.dumps(document, indent=indent, allow_nan=False) + "\n"


def made_from(metadata: dict[str, Any]) -> dict[str, Any]:
    """Return what the numbers of every table of a study depend on: versions, digest, parameters, code and target."""
    names = ("schema_version", "package_version", "instructions", "inputs_sha256", "parameters", "code", "target")
    return {name: metadata[name] for name in names}


def table_metadata(metadata: dict[str, Any], name: str, table: pl.DataFrame) -> dict[str, str]:
    """Return the key-value metadata of the Parquet file of a table, each value a JSON text: `seismass.` with the keys
    of `made_from`, `table`, and `units`, the unit of each column.
    """
    units = {column: unit for column, (unit, _) in _facts(name, table).items()}
    content = {**made_from(metadata), "table": name, "units": units}
    return {f"seismass.{key}": json.dumps(value) for key, value in content.items()}


def _tables_document(metadata: dict[str, Any], tables: dict[str, pl.DataFrame]) -> dict[str, Any]:
    """What tables.json says: of each table its rows, and of each column its unit and meaning."""
    described = {
        name: {
            "rows": TABLES[name][0],
            "columns": {
                column: {"unit": unit, "meaning": meaning} for column, (unit, meaning) in _facts(name, table).items()
            },
        }
        for name, table in tables.items()
    }
    return {**made_from(metadata), "tables": described}


def _facts(name: str, table: pl.DataFrame) -> dict[str, tuple[str, str]]:
    """Unit and meaning of each column of a table; those of motions have a row together."""
    known = TABLES[name][1]
    return {column: known[column if column in known else "motion_*"] for column in table.columns}


_HEADS = ("choice", "setting", "largest", "smallest R", "largest R", "mass", "sliding")
_VALUES = ("largest_percent", "least_R_percent", "most_R_percent", "mass_percent", "sliding_percent")


def sensitivity_text(table: pl.DataFrame) -> str:
    """Return `Sensitivity.table` as lines, one block per occupancy and friction coefficient."""
    blocks = []
    for title, rows in _groups(table):
        lines = [
            f"{title}: first storeys, underestimation (goods slide - code) / code",
            *text_table([_HEADS, *rows], left=2),
        ]
        blocks.append("\n".join(lines))
    notes = (
        "largest: of all first storeys. smallest R, largest R: mean of those with the largest alpha, at that\n"
        "R. mass, sliding: what the last one is made of, all attached over code and goods slide over all."
    )
    return "\n".join([*blocks, notes])


def sensitivity_markdown(table: pl.DataFrame) -> str:
    """Return the table in Markdown, one table per occupancy and friction coefficient."""
    parts = []
    for title, rows in _groups(table):
        lines = [f"| {' | '.join(_HEADS)} |", "| --- | --- | --: | --: | --: | --: | --: |"]
        lines += [f"| {' | '.join(row)} |" for row in rows]
        parts.append(f"{title}:\n\n" + "\n".join(lines))
    return "\n\n".join(parts)


def _groups(table: pl.DataFrame) -> list[tuple[str, list[list[str]]]]:
    """Title and rows of text of each occupancy and friction coefficient; a choice is named once."""
    groups = []
    several = table["mu"].n_unique() > 1
    for (occupancy, mu), rows in table.group_by("occupancy", "mu", maintain_order=True):
        title = f"{occupancy}, mu = {mu:g}" if several else str(occupancy)
        texts: list[list[str]] = []
        before = None
        for row in rows.iter_rows(named=True):
            name = "" if row["choice"] == before else row["choice"]
            before = row["choice"]
            collapsed = f" ({row['collapses']} runs collapse)" if row["collapses"] else ""
            texts.append([name, row["setting"] + collapsed, *(change_text(row[column]) for column in _VALUES)])
        groups.append((title, texts))
    return groups


def study_text(result: StudyResult) -> str:
    """Return the underestimation of drift by the code's model, with its scatter, as lines."""
    document = result.to_dict()
    head = f"Underestimation of capped mean drift, (goods slide - code) / code, code: {document['code']['name']}"
    return f"{head}\n{findings_text(document['findings'])}"


def figure_names(result: StudyResult) -> tuple[str, ...]:
    """Return the names of the figures."""
    from seismass.show.study.figures import drawings

    return tuple(drawings(result))


def study_figure(result: StudyResult, name: str | None = None) -> Figure:
    """Return a figure by its name."""
    from seismass.media.style import drawing, lay_out
    from seismass.show.study.figures import drawings

    with drawing():
        return lay_out(drawings(result)[named_figure(result, name)]())


def write_result(result: StudyResult, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
    """Write a study by itself, without sensitivity and validations; see `StudyResult.write`."""
    return write_study(result, as_path(folder, "study", InvalidOption), figures=figures)


def text_of_sensitivity(result: Sensitivity) -> str:
    """Return the table of a sensitivity as lines."""
    return sensitivity_text(result.table)


def figure_of_sensitivity(result: Sensitivity, name: str | None = None) -> Figure:
    """Return the figure of a sensitivity."""
    from seismass.show.study.figures import sensitivity_figure

    named_figure(result, name)
    return sensitivity_figure(result.table)


def inputs_text(metadata: dict[str, Any]) -> str:
    """Return motions, target, runs, springs, damping, code and remarks as lines, from the metadata of a study."""
    counts, parameters, suite = metadata["counts"], metadata["parameters"], metadata["suite"]
    none_recorded = ", none recorded" * (suite["synthetic"] == len(suite["motions"]))
    lines = [f"suite    {suite['name']}: {motions_text(suite)}{none_recorded}"]
    for motion in suite["motions"]:
        lines.append(f"         {motion['motion']:>2}  x {motion['factor']:<7.4f} {motion['record']}")
        lines += [f"{'':25}{remark}" for remark in motion["remarks"]]
    lines += [
        f"target   {metadata['target']['label']}",
        f"runs     {counts['buildings']} buildings, {counts['analyses']} analyses, {counts['distinct']} distinct: "
        f"{counts['completed']} completed, {counts['collapsed']} collapsed, {counts['failed']} failed",
        f"springs  Omega = {parameters['overstrength']:g}, r2 = {parameters['second_slope']:g}, "
        f"r3 = {parameters['third_slope']:g} (r2, r3: not the paper's numbers)",
        f"damping  {100.0 * parameters['damping']:g} %, {DAMPING_TEXTS[parameters['damping_base']]}",
    ]
    for name, row in metadata["code"]["fractions"].items():
        where = ", ".join(part for part in (row["clause"], row["status"]) if part)
        lines.append(f"code     {metadata['code']['name']}, {name}: {row['fraction']:g} of the live load ({where})")
    return "\n".join([*lines, *(f"remark   {remark}" for remark in metadata["remarks"])])
