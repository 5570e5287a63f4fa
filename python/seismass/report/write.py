"""The files of a study: all of them are written beside their places first, then renamed, or none appears."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any, Final

import polars as pl

from seismass.report.findings import findings
from seismass.report.folder import write_folder
from seismass.study import Sensitivity, StudyResult
from seismass.study.columns import TABLES, units_of

_NUMBER: Final = r"[\d.]+(?:e[+-]\d+)?"
FIGURE_FILE: Final = re.compile(
    rf"(?:spectrum|effective|underestimation(?:_mu{_NUMBER})?|drift_R{_NUMBER}(?:_mu{_NUMBER})?)\.(?:png|svg)"
)
"""Names of the files of a study's figures; another file of a folder is not touched."""

_METHODS: Final = {"ASCE 7-10": "ASCE/SEI 7-10, 16.1.3.1, two-step factors in the logarithm"}
"""Methods of scaling as study.json names them; others by their own name."""


def study_metadata(result: StudyResult) -> dict[str, Any]:
    """Return the metadata with scaling and findings, as study.json holds them and `--json` prints them."""
    scaling = result.scaling
    return {
        **result.metadata,
        "scaling": {
            "method": _METHODS.get(scaling.method, scaling.method),
            "common_factor": scaling.common,
            "periods": [scaling.periods[0], scaling.periods[-1], len(scaling.periods)],
            "governing_period": scaling.governing_period,
        },
        "findings": findings(result.summary, result.fractions, result.metadata["code"]["name"]),
    }


def write_study(
    result: StudyResult, out: Path, *, figures: bool = True, sensitivity: Sensitivity | None = None
) -> list[Path]:
    """Write tables (Parquet and CSV), metadata (JSON) and figures (PNG and SVG) of a study to a folder.

    Every Parquet file carries what the numbers depend on, and the unit of each column; tables.json says the same of the
    CSV files. Figures and a sensitivity table of an earlier study that are not written again are removed.

    Returns
    -------
    list of Path
        The files, in the order written.

    Raises
    ------
    OSError
        A file cannot be written; then none is changed.
    """
    tables = {
        "responses": result.responses,
        "summary": result.summary,
        "fractions": result.fractions,
        "designs": result.designs,
        "spectrum": result.spectrum,
        "scaling": result.scaling.table(),
        **({} if sensitivity is None else {"sensitivity": sensitivity.table}),
    }
    drawn = None
    if figures:
        from seismass.report.study_figures import study_figures

        drawn = study_figures(result)
    files = write_folder(
        out,
        tables=tables,
        documents={
            file: json.dumps(document, indent=2, allow_nan=False) + "\n"
            for file, document in (
                ("tables.json", _tables_document(result.metadata, tables)),
                ("study.json", study_metadata(result)),
            )
        },
        figures=drawn,
        metadata={name: table_metadata(result.metadata, name, table) for name, table in tables.items()},
    )
    written = {path.name for path in files}
    for path in list(out.iterdir()):
        ours = FIGURE_FILE.fullmatch(path.name) or path.name in ("sensitivity.parquet", "sensitivity.csv")
        if ours and path.name not in written and path.is_file():
            path.unlink()
    return files


def made_from(metadata: dict[str, Any]) -> dict[str, Any]:
    """Return what the numbers of every table of a study depend on: versions, digest, parameters, code and target."""
    names = ("schema_version", "package_version", "instructions", "inputs_sha256", "parameters", "code", "target")
    return {name: metadata[name] for name in names}


def table_metadata(metadata: dict[str, Any], name: str, table: pl.DataFrame) -> dict[str, str]:
    """Return the key-value metadata of the Parquet file of a table, each value a JSON text.

    Keys are `seismass.` with what `made_from` gives, `table`, and `units`: the unit of each column.
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
