"""Parts that outlive an interruption: kept for the same inputs, for one process at a time, and removed at the end."""

from __future__ import annotations

import random
import subprocess
import sys
from pathlib import Path

import polars as pl
import pytest
from polars.testing import assert_frame_equal

import seismass as sm
from seismass.base.files import Directory
from seismass.base.stored_results import StoredResults, inputs_digest, result_store
from seismass.studies.study import StudyParameters, run_study

TABLE = pl.DataFrame({"numbers": [1.0, 2.0], "words": ["a", None]})


def leave(place: Path, sha256: str) -> Path:
    """Keep a part, and be interrupted; return its path."""
    with pytest.raises(KeyboardInterrupt), result_store(place, "rows", sha256) as kept:
        path = kept.file("1", lambda: TABLE)
        raise KeyboardInterrupt
    return path


def is_kept(kept: StoredResults) -> bool:
    """Whether the part is taken and not made again."""
    made: list[int] = []
    kept.file("1", lambda: made.append(1) or TABLE)  # type: ignore[func-returns-value]
    return not made


def test_parts_stay_for_the_same_inputs_until_the_end(tmp_path: Path) -> None:
    leave(tmp_path, "a")
    with result_store(tmp_path, "rows", "a") as kept:
        assert is_kept(kept)
        assert_frame_equal(kept.of("1", pl.DataFrame), TABLE, check_exact=True)
    assert list(tmp_path.iterdir()) == []


def test_parts_of_other_inputs_are_removed(tmp_path: Path) -> None:
    part = leave(tmp_path, "a")
    with result_store(tmp_path, "rows", "b"):
        assert not part.exists()
    leave(tmp_path, "a")
    with result_store(tmp_path, "other", "a") as kept:
        assert not is_kept(kept)
    with result_store(tmp_path, "rows", "a") as kept:
        assert is_kept(kept)


def test_nothing_is_kept_where_there_is_nothing(tmp_path: Path) -> None:
    with pytest.raises(LookupError), result_store(tmp_path, "rows", "a"):
        raise LookupError
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(FileNotFoundError) as raised, result_store(tmp_path / "missing", "rows", "a"):
        pass
    assert raised.value.filename == str(tmp_path / "missing")


def test_an_owner_that_cannot_be_written_is_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It would keep the parts from every later process."""

    def refuse() -> str:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr("seismass.base.stored_results.temporary_name", refuse)
        with pytest.raises(OSError, match="No space left"), result_store(tmp_path, "rows", "a"):
            pass
    with result_store(tmp_path, "rows", "a") as kept:
        assert kept.folder is not None
        assert "kept-" in kept.folder.path.name
    assert list(tmp_path.iterdir()) == []


def test_a_process_that_works_on_the_same_has_a_folder_of_its_own(tmp_path: Path) -> None:
    with result_store(tmp_path, "rows", "a") as kept:
        part = kept.file("1", lambda: TABLE)
        with result_store(tmp_path, "rows", "a") as other:
            assert other.folder is not None
            assert other.folder.path != kept.folder.path
            assert list(other.folder.path.iterdir()) == []
        assert not other.folder.path.exists()
        assert part.exists()


@pytest.mark.skipif(sys.platform != "linux", reason="the start of a process is read from /proc")
def test_parts_of_a_killed_process_are_taken(tmp_path: Path) -> None:
    program = (
        "import os, sys\nfrom pathlib import Path\nfrom seismass.base.stored_results import result_store\n"
        "import polars as pl\n"
        "with result_store(Path(sys.argv[1]), 'rows', 'a') as kept:\n"
        "    kept.file('1', lambda: pl.DataFrame({'a': [1]}))\n    os.kill(os.getpid(), 9)\n"
    )
    subprocess.run([sys.executable, "-c", program, str(tmp_path)], check=False, timeout=60)
    with result_store(tmp_path, "rows", "a") as kept:
        assert is_kept(kept)
    assert list(tmp_path.iterdir()) == []


def test_a_result_is_made_once(tmp_path: Path) -> None:
    made: list[int] = []

    def make() -> pl.DataFrame:
        made.append(1)
        return TABLE

    for kept in (StoredResults(Directory(tmp_path), "a"), StoredResults(Directory(tmp_path), "a")):
        assert_frame_equal(kept.of("one", make), TABLE, check_exact=True)
    assert made == [1]
    StoredResults().of("one", make)
    assert made == [1, 1]


def test_a_part_with_one_changed_bit_is_made_again(tmp_path: Path) -> None:
    kept = StoredResults(Directory(tmp_path), "a")
    path = kept.file("1", lambda: TABLE)
    whole = path.read_bytes()
    for bit in random.Random(5).sample(range(8 * len(whole)), 100):
        damaged = bytearray(whole)
        damaged[bit // 8] ^= 1 << bit % 8
        path.write_bytes(damaged)
        assert not is_kept(kept), bit
        assert path.read_bytes() == whole


def test_a_part_of_another_place_or_of_other_inputs_is_made_again(tmp_path: Path) -> None:
    kept = StoredResults(Directory(tmp_path), "a")
    for other, name in ((kept, "2"), (StoredResults(Directory(tmp_path), "b"), "1")):
        (tmp_path / "part-1.parquet").unlink(missing_ok=True)
        other.file(name, lambda: TABLE).rename(tmp_path / "part-1.parquet")
        assert not is_kept(kept)
    (tmp_path / "elsewhere").write_bytes((tmp_path / "part-1.parquet").read_bytes())
    (tmp_path / "part-1.parquet").unlink()
    (tmp_path / "part-1.parquet").symlink_to(tmp_path / "elsewhere")
    assert not is_kept(kept)


def test_a_digest_tells_inputs_apart() -> None:
    scene, motion = sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)]), sm.Motion([1.0, 0.0], 0.1)
    same = inputs_digest([sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)])], sm.Motion([1.0, 0.0], 0.1))
    assert inputs_digest([scene], motion) == same
    assert inputs_digest([scene], sm.Motion([1.0, 0.1], 0.1)) != same


def test_a_study_takes_what_an_interrupted_one_has_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    suite, target = sm.builtin_suite("seven"), sm.TargetSpectrum.asce7()
    parameters = StudyParameters(mass_ratios=(1.0,), response_modification=(2.0, 4.0))
    whole = run_study(suite, target, parameters, effective=True)

    def interrupt(done: int, total: int) -> None:
        if total < 20 and done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_study(
            suite, target, parameters, effective=True, progress=interrupt, store=StoredResults(Directory(tmp_path))
        )
    left = {path.name for path in tmp_path.iterdir()}
    assert left == {f"part-{name}.parquet" for name in ("runs", "effective-1", "effective-2", "effective-3")}
    monkeypatch.setattr("seismass.studies.study.run.solve_many", None)
    again = run_study(suite, target, parameters, effective=True, store=StoredResults(Directory(tmp_path)))
    assert_frame_equal(again.responses, whole.responses, check_exact=True)
    assert_frame_equal(again.fractions, whole.fractions, check_exact=True)
