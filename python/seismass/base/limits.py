"""Limits of everything that is read: beyond one a reader refuses in one sentence, before it takes the memory."""

from __future__ import annotations

from typing import Final

from seismass.base.errors import SeismassError
from seismass.base.values import refusal

_MB: Final = 2**20

MOST_BYTES: Final = 32 * _MB
"""Any input file that has no limit of its own."""
MOST_TOML: Final = 4 * _MB
"""Its reader takes some seconds; JSON, which is read a hundred times as fast, may have more."""
MOST_KEY_PARTS: Final = 50
"""Parts of a dotted key of TOML, whose reader takes the square of their number."""
MOST_LETTERS: Final = 10_000
"""A text of a scene, building or campaign file: figures take the square of the letters of a name."""
MOST_LEVELS: Final = 1000
"""Levels of a rack; storeys of a building are as many."""

MOST_TABLE: Final = 16 * _MB
"""Storey tables, workbooks (also unpacked), pushover curves, target spectra, hazard curves, lists of records."""
MOST_ROWS: Final = 10_000
MOST_COLUMNS: Final = 200
LONGEST_CELL: Final = 1000
"""Letters of a cell that are looked at."""

MOST_RECORD: Final = 24 * _MB
"""A record file: some two million samples as text."""
MOST_FLATFILE: Final = 64 * _MB
"""A table beside records, such as the flatfile of a project."""
LONGEST_LINE: Final = 4 * _MB
"""All samples of the longest records fit into one line of a record file."""
MOST_LINES: Final = 2_000_000
"""Lines of a record file: two hours of one column at 200 samples a second."""
MOST_TEXT_COLUMNS: Final = 32 * _MB
"""Text of columns that is read without being named; a longer one is read by its name."""
MOST_SAMPLES: Final = 10_000_000
"""Samples of a motion of a file, or to which one is continued: some hundred megabytes in a run."""
MOST_SECONDS: Final = 10_000.0
"""Longest motion of a file, and longest time to which one is continued (s): five times that of any recording. It keeps
the cost of a run to seconds, and a step in milliseconds exceeds it."""
MOST_MEMBERS: Final = 5000
MOST_DEEP: Final = 4
"""Archives in archives; an archive further down is a file that is not read."""
MOST_UNPACKED: Final = 1024 * _MB
"""An archive on the disk, unpacked: five hundred records of 2 MB."""

MOST_RESULT: Final = 256 * _MB
"""A file of a folder of results that is read again."""
MOST_FOOTER: Final = 64 * _MB
"""Footer of a Parquet file whose digest is compared; one of a part of a campaign has some kilobytes."""


def _size(number: int) -> str:
    return f"{number // _MB} MB"


LIMITS: Final = (
    ("scene, building and campaign files in JSON", "size", _size(MOST_BYTES)),
    ("the same in TOML", "size", _size(MOST_TOML)),
    ("the same", "parts of a key; letters of a text", f"{MOST_KEY_PARTS}; {MOST_LETTERS}"),
    ("the same", "storeys; levels of a rack", f"1000; {MOST_LEVELS}"),
    ("storey tables, workbooks, pushover curves", "size, also unpacked", _size(MOST_TABLE)),
    ("the same", "rows; columns; letters of a cell that are looked at", f"{MOST_ROWS}; {MOST_COLUMNS}; {LONGEST_CELL}"),
    ("target spectra, hazard curves, lists of records", "size; rows", f"{_size(MOST_TABLE)}; {MOST_ROWS}"),
    (
        "record files",
        "size; lines; bytes of a line",
        f"{_size(MOST_RECORD)}; {MOST_LINES}; {LONGEST_LINE}",
    ),
    ("tables beside records", "size; rows that are looked at", f"{_size(MOST_FLATFILE)}; {10 * MOST_ROWS}"),
    ("motions of files", "samples; seconds", f"{MOST_SAMPLES}; {MOST_SECONDS:g}"),
    (
        "archives of records",
        "members; archives in archives; size unpacked",
        f"{MOST_MEMBERS}; {MOST_DEEP}; {_size(MOST_UNPACKED)}",
    ),
    ("one member of an archive", "size unpacked", _size(MOST_RECORD)),
    ("files of folders of results", "size; footer of a table", f"{_size(MOST_RESULT)}; {_size(MOST_FOOTER)}"),
)
"""What is read, what of it is limited, and how: the table of docs/reliability.md."""


def within_rows(text: str, file: str, kind: type[SeismassError]) -> str:
    """Return a text; one of more lines than a table may have is refused before it is taken apart."""
    if text.count("\n") > MOST_ROWS:
        raise refusal(kind, "lines", file, f"at most {MOST_ROWS}", "more")
    return text
