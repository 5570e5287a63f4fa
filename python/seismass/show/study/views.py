"""What a study shows of itself: its findings in words, its figures, and its folder."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from seismass.base.errors import InvalidOption
from seismass.base.values import as_path
from seismass.media.result import named_figure
from seismass.show.study.findings import findings_text
from seismass.show.study.sensitivity import sensitivity_text
from seismass.study.run import StudyResult
from seismass.study.sensitivity import Sensitivity

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def study_text(result: StudyResult) -> str:
    """Return the underestimation of drift by the code's model, with its scatter, as lines."""
    document = result.to_dict()
    head = f"Underestimation of mean peak drift, (goods slide - code) / code, code: {document['code']['name']}"
    return f"{head}\n{findings_text(document['findings'])}"


def figure_names(result: StudyResult) -> tuple[str, ...]:
    """Return the names of the figures."""
    from seismass.show.study.figures import drawings

    return tuple(drawings(result))


def study_figure(result: StudyResult, name: str | None = None) -> Figure:
    """Return a figure by its name."""
    import matplotlib as mpl

    from seismass.media.style import STYLE, lay_out
    from seismass.show.study.figures import drawings

    with mpl.rc_context(STYLE):
        return lay_out(drawings(result)[named_figure(result, name)]())


def write_result(result: StudyResult, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
    """Write a study by itself, without sensitivity and validations; see `StudyResult.write`."""
    from seismass.show.study.tables import study_tables
    from seismass.show.study.write import write_study

    return write_study(study_tables(result), as_path(folder, "study", InvalidOption), figures=figures)


def text_of_sensitivity(result: Sensitivity) -> str:
    """Return the table of a sensitivity as lines."""
    return sensitivity_text(result.table)


def figure_of_sensitivity(result: Sensitivity, name: str | None = None) -> Figure:
    """Return the figure of a sensitivity."""
    from seismass.show.study.sensitivity_figure import sensitivity_figure

    named_figure(result, name)
    return sensitivity_figure(result.table)
