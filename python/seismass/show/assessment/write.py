"""The files of an assessment: all of them are written beside their places first, then renamed, or none appears."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Final

from seismass.base.errors import InvalidOption
from seismass.base.files import written_whole
from seismass.base.values import as_path
from seismass.media.folder import PAGE, as_written, check_out, edited_files, write_folder
from seismass.show.assessment.tables import (
    ANIMATION,
    DOCUMENT,
    AssessmentTables,
    assessment_tables,
    read_assessment_tables,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seismass.assessment.result import Assessment
    from seismass.runs.batch import Progress

FIGURES: Final = ("effective_fraction", "drift", "slip", "spectrum")
"""Names of all figures; those of an earlier assessment that are not written again are removed."""
TABLES: Final = ("storeys", "governing", "analysis", "slip", "runs", "checks", "spectra", "curve", "scaling")
"""Names of all tables, likewise."""


def write_assessment(result: Assessment, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
    """Write text, tables (Parquet and CSV), assessment.json, figures (PNG and SVG) and the page to a folder; return the
    files in that order. On an error no file is changed.
    """
    out = as_path(folder, "assessment", InvalidOption)
    check_out(out, "assessment")
    documents = {"assessment.txt": result.text + "\n", DOCUMENT: result.to_json() + "\n"}
    drawn: dict[str, Figure] = {}
    if figures:
        tables = assessment_tables(result, animated=True)
        if tables.animation is not None:
            documents[ANIMATION] = json.dumps(tables.animation) + "\n"
        drawn, drawings = _drawn(tables)
        documents |= {f"{name}.svg": drawing for name, drawing in drawings.items()}
        documents[PAGE] = _page(tables, drawings)
    ours = {PAGE, ANIMATION} | {f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg")}
    ours |= {f"{name}.{kind}" for name in TABLES for kind in ("parquet", "csv")}
    return write_folder(
        out,
        tables=result.tables,
        documents=documents,
        figures=drawn,
        kinds=("png",),
        earlier=ours.__contains__,
    )


def write_assessment_page(
    folder: Path, target: Path, *, force: bool = False, progress: Progress | None = None
) -> tuple[str, ...]:
    """Write the page of an assessment from the tables of its folder alone and return the files that were edited since
    they were written, which are read with `force` alone. `progress` is called with (figures drawn, figures in all).
    """
    read = (DOCUMENT, ANIMATION, *(f"{name}.parquet" for name in TABLES))
    edited = edited_files(folder, read, force=force)
    with as_written(folder):
        tables = read_assessment_tables(folder)
        _, drawings = _drawn(tables, progress)
        page = _page(tables, drawings, edited)
    with written_whole(target) as temporary:
        temporary.write_text(page, encoding="utf-8")
    return edited


def _drawn(tables: AssessmentTables, progress: Progress | None = None) -> tuple[dict[str, Figure], dict[str, str]]:
    """Figures and their SVG texts, each drawn once for its file and for the page."""
    from seismass.media.svg import figure_svgs
    from seismass.show.assessment.figures import assessment_figures

    figures = assessment_figures(tables)
    return figures, figure_svgs(figures, progress)


def _page(tables: AssessmentTables, drawings: dict[str, str], edited: tuple[str, ...] = ()) -> str:
    from seismass.media.svg import figure_svgs
    from seismass.show.assessment.figures import PHONE_SIZE, assessment_figures
    from seismass.show.assessment.page import building_page

    return building_page(tables, drawings, figure_svgs(assessment_figures(tables, PHONE_SIZE)), edited)
