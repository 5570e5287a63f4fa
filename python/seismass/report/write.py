"""The files of a study: all of them are written beside their places first, then renamed, or none appears."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any, Final

from seismass.errors import InvalidOption
from seismass.files import write_table, written_whole
from seismass.report.findings import findings
from seismass.study import StudyResult

FIGURE_FILE: Final = re.compile(r"(?:spectrum|underestimation|drift_R[\d.]+(?:e\+\d+)?)\.(?:png|svg)")
"""Names of the files of a study's figures; another file of a folder is not touched."""


def study_metadata(result: StudyResult) -> dict[str, Any]:
    """Return the metadata with scaling and findings, as study.json holds them and `--json` prints them."""
    scaling = result.scaling
    return {
        **result.metadata,
        "scaling": {
            "method": "ASCE/SEI 7-10, 16.1.3.1, two-step factors in the logarithm",
            "common_factor": scaling.common,
            "periods": [scaling.periods[0], scaling.periods[-1], len(scaling.periods)],
            "governing_period": scaling.governing_period,
        },
        "findings": findings(result.summary),
    }


def check_out(out: Path) -> None:
    """Refuse a folder that cannot be one, before a study runs.

    Raises
    ------
    InvalidOption
        `out`, or one of its parents, is a file.
    """
    existing = next((path for path in (out, *out.parents) if path.exists()), None)
    if existing is not None and not (existing.is_dir() and os.access(existing, os.W_OK)):
        raise InvalidOption(f"out of study must be a folder that can be written to; got {out}")


def write_study(result: StudyResult, out: Path, *, figures: bool = True) -> list[Path]:
    """Write tables (Parquet and CSV), metadata (JSON) and figures (PNG and SVG) of a study to a folder.

    Figures of an earlier study that are not written again are removed.

    Returns
    -------
    list of Path
        The files, in the order written.

    Raises
    ------
    OSError
        A file cannot be written; then none is changed.
    """
    writers: dict[str, Callable[[Path], object]] = {}
    tables = {
        "responses": result.responses,
        "summary": result.summary,
        "designs": result.designs,
        "spectrum": result.spectrum,
        "scaling": result.scaling.table(),
    }
    for name, table in tables.items():
        writers[f"{name}.parquet"] = partial(write_table, table, "parquet")
        writers[f"{name}.csv"] = partial(write_table, table, "csv")
    text = json.dumps(study_metadata(result), indent=2) + "\n"
    writers["study.json"] = partial(Path.write_text, data=text, encoding="utf-8")
    if figures:
        from seismass.report.figures import save_figure, study_figures

        for name, figure in study_figures(result).items():
            writers[f"{name}.png"] = partial(save_figure, figure, "png")
            writers[f"{name}.svg"] = partial(save_figure, figure, "svg")
    out.mkdir(parents=True, exist_ok=True)
    with ExitStack() as stack:
        for name, write in writers.items():
            write(stack.enter_context(written_whole(out / name)))
    for file in list(out.iterdir()):
        if FIGURE_FILE.fullmatch(file.name) and file.name not in writers and file.is_file():
            file.unlink()
    return [out / name for name in writers]
