"""A folder of results: tables, documents and figures, all written beside their places first, then renamed, or none."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.files import write_table, written_whole
from seismass.base.values import refusal

if TYPE_CHECKING:
    from matplotlib.figure import Figure


PAGE: Final = "report.html"
"""File of the page of a folder."""


def check_out(out: Path, owner: str) -> None:
    """Refuse a folder that cannot be one, before anything is solved.

    Raises
    ------
    InvalidOption
        `out`, or one of its parents, is a file, or it cannot be written to.
    """
    existing = next((path for path in (out, *out.parents) if path.exists()), None)
    if existing is not None and not (existing.is_dir() and os.access(existing, os.W_OK)):
        raise refusal(InvalidOption, "out", owner, "a folder that can be written to", str(out))


@contextmanager
def folder_for(out: Path) -> Iterator[None]:
    """Make a folder for what is written to it, which goes again where an error or Ctrl-C leaves it empty.

    Raises
    ------
    OSError
        The folder cannot be made.
    """
    made = [path for path in (out, *out.parents) if not path.exists()]
    out.mkdir(parents=True, exist_ok=True)
    try:
        yield
    except BaseException:
        with suppress(OSError):
            for path in made:
                path.rmdir()
        raise


def write_folder(
    out: Path,
    *,
    tables: Mapping[str, pl.DataFrame],
    documents: Mapping[str, str],
    figures: Mapping[str, Figure] | None = None,
    kinds: Sequence[Literal["png", "svg"]] = ("png", "svg"),
    metadata: Mapping[str, dict[str, str]] | None = None,
) -> list[Path]:
    """Write tables (Parquet and CSV), documents and figures to a folder, which is made if it is missing.

    Parameters
    ----------
    out : Path
        The folder.
    tables, figures : mapping
        By name without suffix.
    documents : mapping of str to str
        Text by file name.
    kinds : sequence of {"png", "svg"}
        Formats of the figures.
    metadata : mapping of str to dict, optional
        Key-value metadata of the Parquet file of each table that has any.

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
        about = None if metadata is None else metadata.get(name)
        writers[f"{name}.parquet"] = partial(write_table, table, "parquet", metadata=about)
        writers[f"{name}.csv"] = partial(write_table, table, "csv")
    for name, text in documents.items():
        writers[name] = partial(Path.write_text, data=text, encoding="utf-8")
    if figures:
        from seismass.media.figure_file import save_figure  # matplotlib, which tables do not need

        for name, figure in figures.items():
            for kind in kinds:
                writers[f"{name}.{kind}"] = partial(save_figure, figure, kind)
    out.mkdir(parents=True, exist_ok=True)
    with ExitStack() as stack:
        for name, write in writers.items():
            write(stack.enter_context(written_whole(out / name)))
    return [out / name for name in writers]
