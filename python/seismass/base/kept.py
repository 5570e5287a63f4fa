"""Parts of a long result that outlive an interruption, so that the same call goes on where it stopped.

They are kept in a hidden folder beside the file or in the folder that they are for, and removed when that is written.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, TypeVar

from seismass.base.files import written_whole
from seismass.base.temporary import PREFIX, is_left_behind, reported_as, temporary_folder, temporary_name

_T = TypeVar("_T")
_INPUTS: Final = "inputs"
_OWNER: Final = "owner"


@contextmanager
def kept_folder(place: Path, name: str, sha256: str) -> Iterator[Path]:
    """Give a folder for parts of a result, which stays where the work is interrupted and is removed at its end.

    Parameters
    ----------
    place : Path
        Folder in which it is made.
    name : str
        What the parts are for; one name has one such folder.
    sha256 : str
        Digest of the inputs: parts of others are removed first.

    Notes
    -----
    While another process works on the same result, or where that cannot be known, the folder is a temporary one.

    Raises
    ------
    OSError
        The folder cannot be made or written to.
    """
    folder = place / f"{PREFIX}kept-{hashlib.sha256(os.fsencode(name)).hexdigest()[:16]}"
    with reported_as(place):
        folder.mkdir(mode=0o700, exist_ok=True)
    if not _claimed(folder):
        with temporary_folder(place) as private:
            yield private
        return
    try:
        _clear_unless_of(folder, sha256)
        yield folder
    except BaseException:
        if {path.name for path in folder.iterdir()} <= {_INPUTS, _OWNER}:
            shutil.rmtree(folder, ignore_errors=True)
        else:
            (folder / _OWNER).unlink(missing_ok=True)
        raise
    shutil.rmtree(folder, ignore_errors=True)


def _claimed(folder: Path) -> bool:
    """Take a folder for this process, unless another one has it."""
    owner = folder / _OWNER
    try:
        if not is_left_behind(owner.read_text(encoding="ascii", errors="replace")):
            return False
        owner.unlink(missing_ok=True)
    except FileNotFoundError:
        pass
    try:
        with owner.open("x", encoding="ascii") as file:
            file.write(temporary_name())
    except FileExistsError:
        return False
    return True


def _clear_unless_of(folder: Path, sha256: str) -> None:
    """Remove parts of other inputs, and say whose parts are kept from now on."""
    inputs = folder / _INPUTS
    if inputs.is_file() and inputs.read_text(encoding="ascii", errors="replace") == sha256:
        return
    for path in folder.iterdir():
        if path.name != _OWNER:
            path.unlink()
    with written_whole(inputs) as temporary:
        temporary.write_text(sha256, encoding="ascii")


def digest_of(*inputs: Any) -> str:
    """Return a digest of objects that can be pickled: equal ones made in the same way have the same."""
    return hashlib.sha256(pickle.dumps(inputs, protocol=5)).hexdigest()


@dataclass(frozen=True)
class KeptResults:
    """Results that are made once for the same inputs, however often the work is interrupted.

    Attributes
    ----------
    folder : Path or None
        Where they are kept; None: nowhere.
    """

    folder: Path | None = None

    def of(self, name: str, make: Callable[[], _T]) -> _T:
        """Return the result of this name as it was kept, or make and keep it."""
        if self.folder is None:
            return make()
        path = self.folder / f"{name}.pickle"
        if path.is_file():
            with path.open("rb") as file:
                found: _T = pickle.load(file)
            return found
        found = make()
        with written_whole(path, durable=True) as temporary:
            temporary.write_bytes(pickle.dumps(found))
        return found


NOTHING_KEPT: Final = KeptResults()
"""Results are made anew, and none is kept."""
