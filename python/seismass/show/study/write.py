"""The files of a study: all of them are written beside their places first, then renamed, or none appears."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import polars as pl

from seismass.base.files import written_whole
from seismass.media.folder import PAGE, as_written, edited_files, write_folder
from seismass.show.study.tables import ANIMATION, DOCUMENT, OPTIONAL_TABLES, READ, StudyTables, read_study_tables
from seismass.study.columns import TABLES, units_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seismass.runs.batch import Progress

_NUMBER: Final = r"[\d.]+(?:e[+-]\d+)?"
FIGURE_FILE: Final = re.compile(
    rf"(?:spectrum|effective|sensitivity|(?:underestimation|heat|slip)(?:_mu{_NUMBER})?|drift_R{_NUMBER}(?:_mu{_NUMBER})?"
    r"|section4_[\w.-]+|platform_[\w.-]+)\.(?:png|svg)"
)
"""Names of the files of a study's figures."""


def write_study(
    result: StudyTables,
    out: Path,
    *,
    figures: bool = True,
    png: bool = False,
    progress: Progress | None = None,
) -> list[Path]:
    """Write tables (Parquet with units and inputs, CSV), JSON documents, figures (SVG) and the page of a study to a
    folder; return the files. Those of an earlier study in files.json are removed.
    """
    tables = result.tables
    documents = {"tables.json": _json(_tables_document(result.metadata, tables)), DOCUMENT: _json(result.metadata)}
    if result.animation is not None:
        documents[ANIMATION] = _json(result.animation, indent=None)
    drawn: dict[str, Figure] = {}
    if figures:
        from seismass.media.svg import figure_svgs
        from seismass.show.study.figures import phone_figures
        from seismass.show.study.page import study_page

        drawn, drawings = _drawn(result, progress)
        documents |= {f"{name}.svg": drawing for name, drawing in drawings.items()}
        documents[PAGE] = study_page(result, drawings, figure_svgs(phone_figures(result)))
    ours = {PAGE, ANIMATION} | {f"{name}.{kind}" for name in OPTIONAL_TABLES for kind in ("parquet", "csv")}
    return write_folder(
        out,
        tables=tables,
        documents=documents,
        figures=drawn if png else None,
        kinds=("png",),
        metadata={name: table_metadata(result.metadata, name, table) for name, table in tables.items()},
        earlier=lambda name: name in ours or FIGURE_FILE.fullmatch(name) is not None,
    )


def write_study_page(
    folder: Path, target: Path, *, force: bool = False, progress: Progress | None = None
) -> tuple[str, ...]:
    """Write the page of a study from the tables of its folder alone and return the files that were edited since they
    were written, which are read with `force` alone; `progress` as in `write_study`.
    """
    from seismass.media.svg import figure_svgs
    from seismass.show.study.figures import phone_figures
    from seismass.show.study.page import study_page

    edited = edited_files(folder, READ, force=force)
    with as_written(folder):
        result = read_study_tables(folder)
        _, drawings = _drawn(result, progress)
        page = study_page(result, drawings, figure_svgs(phone_figures(result)), edited)
    with written_whole(target) as temporary:
        temporary.write_text(page, encoding="utf-8")
    return edited


def _drawn(result: StudyTables, progress: Progress | None) -> tuple[dict[str, Figure], dict[str, str]]:
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
    content = {**made_from(metadata), "table": name, "units": units_of(name, table.columns)}
    return {f"seismass.{key}": json.dumps(value) for key, value in content.items()}


def _tables_document(metadata: dict[str, Any], tables: dict[str, pl.DataFrame]) -> dict[str, Any]:
    """What tables.json says: of each table its rows, and of each column its unit and meaning."""
    described = {}
    for name, table in tables.items():
        rows, columns = TABLES[name]
        units = units_of(name, table.columns)
        described[name] = {
            "rows": rows,
            "columns": {
                column: {"unit": units[column], "meaning": columns.get(column, columns.get("motion_*", ("", "")))[1]}
                for column in table.columns
            },
        }
    return {**made_from(metadata), "tables": described}
