"""A folder of results: tables, documents and figures, all written beside their places first, then renamed, or none."""

from __future__ import annotations

import hashlib
import json
import os
import stat
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

import polars as pl

from seismass.base.errors import InvalidOption, SeismassError
from seismass.base.files import open_regular, read_file, write_table, written_whole
from seismass.base.values import refusal, short

if TYPE_CHECKING:
    from matplotlib.figure import Figure


PAGE: Final = "report.html"
"""File of the page of a folder."""
FILES: Final = "files.json"
"""File with the names and SHA-256 of what was written, and that of the list: a later call knows its own by it."""


def check_out(out: Path, owner: str) -> None:
    """Refuse a folder that cannot be one, before anything is solved."""
    existing = next((path for path in (out, *out.parents) if path.exists()), None)
    if existing is not None and not (existing.is_dir() and os.access(existing, os.W_OK)):
        raise refusal(InvalidOption, "out", owner, "a folder that can be written to", str(out))


@contextmanager
def folder_for(out: Path) -> Iterator[None]:
    """Make a folder for output; it is removed again where an error or Ctrl-C leaves it empty."""
    made = [path for path in (out, *out.parents) if not path.exists()]
    out.mkdir(parents=True, exist_ok=True)
    try:
        yield
    except BaseException:
        with suppress(OSError):
            for path in made:
                path.rmdir()
        raise


@contextmanager
def as_written(folder: Path) -> Iterator[None]:
    """Refuse a folder whose documents and tables do not fit together, whatever error they cause."""
    try:
        yield
    except SeismassError:
        raise
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, pl.exceptions.PolarsError) as error:
        got = f"{type(error).__name__}: {error}"
        requirement = "with documents and tables as seismass wrote them"
        raise refusal(InvalidOption, f"folder {folder}", "report", requirement, short(got)) from None


def write_folder(
    out: Path,
    *,
    tables: Mapping[str, pl.DataFrame],
    documents: Mapping[str, str],
    figures: Mapping[str, Figure] | None = None,
    kinds: Sequence[Literal["png", "svg"]] = ("png", "svg"),
    metadata: Mapping[str, dict[str, str]] | None = None,
    earlier: Callable[[str], bool] | None = None,
) -> list[Path]:
    """Write tables (Parquet and CSV), documents and figures to a folder; on an error no file is changed. Files of an
    earlier call (files.json) that `earlier` accepts and nobody changed are removed.
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
    before = {} if earlier is None else _listed(out)
    with ExitStack() as stack:
        places = {}
        for name, write in writers.items():
            places[name] = stack.enter_context(written_whole(out / name))
            write(places[name])
        if earlier is not None:
            listed = {name: _sha256(place) for name, place in places.items()}
            text = json.dumps({"sha256": listed, "sha256_of_list": _list_sha256(listed)}, indent=1) + "\n"
            places[FILES] = stack.enter_context(written_whole(out / FILES))
            places[FILES].write_text(text, encoding="utf-8")
    if earlier is not None:
        for name in before:
            if name not in places and earlier(name) and _is_file_with(out / name, before[name]):
                (out / name).unlink()
    return [out / name for name in places]


def edited_files(folder: Path, read: Sequence[str], *, force: bool = False) -> tuple[str, ...]:
    """Return which files of a folder that are read are not as files.json has them, and how they differ.

    Parameters
    ----------
    folder : Path
        The folder.
    read : sequence of str
        Names of all files that may be read, that by which the folder is known first.
    force : bool
        Return them; else the first is refused.

    Raises
    ------
    InvalidOption
        A file differs, is missing, or is not listed, or the list itself is not as it was written.
    """
    if not (folder / read[0]).exists():
        return ()  # what the reader says of a folder of another kind says more
    listed = _whole_list(folder)
    if listed is None:
        found = [(FILES, "other content" if (folder / FILES).exists() else "none")]
    else:
        found = [(name, "none") for name in read if name in listed and not (folder / name).exists()]
        there = [name for name in read if (folder / name).exists()]
        found += [(name, "a file that files.json does not list") for name in there if name not in listed]
        changed = (name for name in there if name in listed and not _is_file_with(folder / name, listed[name]))
        found += [(name, "other content") for name in changed]
    if found and not force:
        need = "as it was written, by the digests of files.json, or --force be given"
        raise refusal(InvalidOption, found[0][0], f"folder {folder}", need, found[0][1])
    return tuple(f"{name} ({how})" for name, how in found)


def _whole_list(folder: Path) -> dict[str, str] | None:
    """Digests by name of files.json; None where it is missing or not as it was written."""
    try:
        document = json.loads(read_file(folder / FILES, follow=False))
        listed: dict[str, str] = document["sha256"]
        return listed if document["sha256_of_list"] == _list_sha256(listed) else None
    except (OSError, ValueError, RecursionError, LookupError, TypeError):
        return None


def _list_sha256(listed: Mapping[str, str]) -> str:
    return hashlib.sha256(json.dumps(listed, sort_keys=True).encode()).hexdigest()


def _listed(out: Path) -> dict[str, str]:
    """Digests by name of the files that an earlier call has written; none where that is not known."""
    try:
        found = json.loads(read_file(out / FILES, follow=False))["sha256"]
        return {name: sha256 for name, sha256 in found.items() if isinstance(sha256, str) and Path(name).name == name}
    except (OSError, ValueError, RecursionError, LookupError, TypeError, AttributeError):
        return {}


def _is_file_with(path: Path, sha256: str) -> bool:
    """Whether a regular file, and no link, has these bytes."""
    try:
        return stat.S_ISREG(path.lstat().st_mode) and _sha256(path) == sha256
    except OSError:
        return False


def _sha256(path: Path) -> str:
    with open_regular(path, follow=False) as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
