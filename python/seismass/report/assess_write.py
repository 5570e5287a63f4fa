"""The files of an assessment: all of them are written beside their places first, then renamed, or none appears."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Final

from seismass._values import as_path
from seismass.errors import InvalidOption
from seismass.report.folder import check_out, write_folder

if TYPE_CHECKING:
    from seismass.assessment.result import Assessment

FIGURES: Final = ("effective_fraction", "drift", "slip")
"""Names of all figures; those of an earlier assessment that are not written again are removed."""
TABLES: Final = ("storeys", "slip", "runs", "curve", "scaling")
"""Names of all tables, likewise."""


def write_assessment(result: Assessment, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
    """Write text, tables (Parquet and CSV), assessment.json and figures (PNG and SVG) to a folder.

    Returns
    -------
    list of Path
        The files, in the order written.

    Raises
    ------
    InvalidOption
        The folder is a file, or cannot be written to.
    OSError
        A file cannot be written; then none is changed.
    """
    out = as_path(folder, "assessment", InvalidOption)
    check_out(out, "assessment")
    files = write_folder(
        out,
        tables=result.tables(),
        documents={"assessment.txt": result.text() + "\n", "assessment.json": result.to_json() + "\n"},
        figures=result.figures() if figures else None,
    )
    ours = {f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg")}
    ours |= {f"{name}.{kind}" for name in TABLES for kind in ("parquet", "csv")}
    for name in ours - {path.name for path in files}:
        (out / name).unlink(missing_ok=True)
    return files
