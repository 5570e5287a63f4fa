"""A folder of results: tables, documents and figures, all written beside their places first, then renamed, or none."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import polars as pl

from seismass.files import write_table, written_whole
from seismass.report.figures import save_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def write_folder(
    out: Path,
    *,
    tables: Mapping[str, pl.DataFrame],
    documents: Mapping[str, str],
    figures: Mapping[str, Figure] | None = None,
) -> list[Path]:
    """Write tables (Parquet and CSV), documents and figures (PNG and SVG) to a folder, which is made if it is missing.

    Parameters
    ----------
    out : Path
        The folder.
    tables, figures : mapping
        By name without suffix.
    documents : mapping of str to str
        Text by file name.

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
    for name, table in tables.items():
        writers[f"{name}.parquet"] = partial(write_table, table, "parquet")
        writers[f"{name}.csv"] = partial(write_table, table, "csv")
    for name, text in documents.items():
        writers[name] = partial(Path.write_text, data=text, encoding="utf-8")
    for name, figure in (figures or {}).items():
        writers[f"{name}.png"] = partial(save_figure, figure, "png")
        writers[f"{name}.svg"] = partial(save_figure, figure, "svg")
    out.mkdir(parents=True, exist_ok=True)
    with ExitStack() as stack:
        for name, write in writers.items():
            write(stack.enter_context(written_whole(out / name)))
    return [out / name for name in writers]
