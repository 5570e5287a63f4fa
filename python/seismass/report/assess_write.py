"""The files of an assessment: all of them are written beside their places first, then renamed, or none appears."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final

from seismass._values import as_path
from seismass.errors import InvalidOption
from seismass.files import write_table, written_whole
from seismass.report.write import check_out

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
    check_out(out)
    writers: dict[str, Callable[[Path], object]] = {
        "assessment.txt": partial(Path.write_text, data=result.text() + "\n", encoding="utf-8"),
        "assessment.json": partial(Path.write_text, data=result.to_json() + "\n", encoding="utf-8"),
    }
    for name, table in result.tables().items():
        writers[f"{name}.parquet"] = partial(write_table, table, "parquet")
        writers[f"{name}.csv"] = partial(write_table, table, "csv")
    if figures:
        from seismass.report.figures import save_figure

        for name, figure in result.figures().items():
            writers[f"{name}.png"] = partial(save_figure, figure, "png")
            writers[f"{name}.svg"] = partial(save_figure, figure, "svg")
    out.mkdir(parents=True, exist_ok=True)
    with ExitStack() as stack:
        for name, write in writers.items():
            write(stack.enter_context(written_whole(out / name)))
    ours = {f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg")}
    ours |= {f"{name}.{kind}" for name in TABLES for kind in ("parquet", "csv")}
    for name in ours - set(writers):
        (out / name).unlink(missing_ok=True)
    return [out / name for name in writers]
