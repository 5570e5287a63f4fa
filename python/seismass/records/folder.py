"""The files of a folder of records."""

from __future__ import annotations

from pathlib import Path


def files_below(directory: Path) -> list[Path]:
    """Return the files in a directory and below, sorted by path, without hidden ones and those out of reach."""
    inside = ((file.relative_to(directory), file) for file in directory.rglob("*") if _is_file(file))
    seen = [(path.as_posix(), file) for path, file in inside if not any(part.startswith(".") for part in path.parts)]
    return [file for _, file in sorted(seen)]


def _is_file(path: Path) -> bool:
    """Whether a path is a file; not where a link leads to a place without access."""
    try:
        return path.is_file()
    except OSError:
        return False
