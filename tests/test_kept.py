"""Parts that outlive an interruption: kept for the same inputs, for one process at a time, and removed at the end."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from polars.testing import assert_frame_equal

import seismass as sm
from seismass.base.kept import KeptResults, digest_of, kept_folder
from seismass.study import StudyParameters, run_study


def leave(place: Path, sha256: str, content: str) -> None:
    """Keep a part, and be interrupted."""
    with pytest.raises(KeyboardInterrupt), kept_folder(place, "rows", sha256) as folder:
        (folder / "part").write_text(content)
        raise KeyboardInterrupt


def test_parts_stay_for_the_same_inputs_until_the_end(tmp_path: Path) -> None:
    leave(tmp_path, "a", "1")
    with kept_folder(tmp_path, "rows", "a") as folder:
        assert (folder / "part").read_text() == "1"
    assert list(tmp_path.iterdir()) == []


def test_parts_of_other_inputs_are_removed(tmp_path: Path) -> None:
    leave(tmp_path, "a", "1")
    with kept_folder(tmp_path, "rows", "b") as folder:
        assert not (folder / "part").exists()
    leave(tmp_path, "a", "1")
    with kept_folder(tmp_path, "other", "a") as folder:
        assert not (folder / "part").exists()
    with kept_folder(tmp_path, "rows", "a") as folder:
        assert (folder / "part").exists()


def test_nothing_is_kept_where_there_is_nothing(tmp_path: Path) -> None:
    with pytest.raises(LookupError), kept_folder(tmp_path, "rows", "a"):
        raise LookupError
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(FileNotFoundError) as raised, kept_folder(tmp_path / "missing", "rows", "a"):
        pass
    assert raised.value.filename == str(tmp_path / "missing")


def test_a_process_that_works_on_the_same_has_a_folder_of_its_own(tmp_path: Path) -> None:
    with kept_folder(tmp_path, "rows", "a") as folder:
        (folder / "part").write_text("1")
        with kept_folder(tmp_path, "rows", "a") as other:
            assert other != folder
            assert list(other.iterdir()) == []
        assert not other.exists()
        assert (folder / "part").exists()


@pytest.mark.skipif(sys.platform != "linux", reason="the start of a process is read from /proc")
def test_parts_of_a_killed_process_are_taken(tmp_path: Path) -> None:
    program = (
        "import os, sys\nfrom pathlib import Path\nfrom seismass.base.kept import kept_folder\n"
        "with kept_folder(Path(sys.argv[1]), 'rows', 'a') as folder:\n"
        "    (folder / 'part').write_text('1')\n    os.kill(os.getpid(), 9)\n"
    )
    subprocess.run([sys.executable, "-c", program, str(tmp_path)], check=False, timeout=60)
    with kept_folder(tmp_path, "rows", "a") as folder:
        assert (folder / "part").read_text() == "1"
    assert list(tmp_path.iterdir()) == []


def test_a_result_is_made_once(tmp_path: Path) -> None:
    made: list[int] = []

    def make() -> dict[str, Any]:
        made.append(1)
        return {"numbers": [1.0, 2.0]}

    kept = KeptResults(tmp_path)
    assert kept.of("one", make) == KeptResults(tmp_path).of("one", make) == {"numbers": [1.0, 2.0]}
    assert made == [1]
    assert KeptResults().of("one", make) == {"numbers": [1.0, 2.0]}
    assert made == [1, 1]


def test_a_digest_tells_inputs_apart() -> None:
    scene, motion = sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)]), sm.Motion([1.0, 0.0], 0.1)
    same = digest_of([sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)])], sm.Motion([1.0, 0.0], 0.1))
    assert digest_of([scene], motion) == same
    assert digest_of([scene], sm.Motion([1.0, 0.1], 0.1)) != same


def test_a_study_takes_what_an_interrupted_one_has_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    suite, target = sm.builtin_suite("seven"), sm.TargetSpectrum.asce7()
    parameters = StudyParameters(mass_ratios=(1.0,), response_modification=(2.0, 4.0))
    whole = run_study(suite, target, parameters, effective=True)

    def interrupt(done: int, total: int) -> None:
        if total < 20 and done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_study(suite, target, parameters, effective=True, progress=interrupt, kept=KeptResults(tmp_path))
    left = {path.name for path in tmp_path.iterdir()}
    assert left == {"runs.pickle", "effective-1.pickle", "effective-2.pickle", "effective-3.pickle"}
    monkeypatch.setattr("seismass.study.run.simulate_many", None)
    again = run_study(suite, target, parameters, effective=True, kept=KeptResults(tmp_path))
    assert_frame_equal(again.responses, whole.responses, check_exact=True)
    assert_frame_equal(again.fractions, whole.fractions, check_exact=True)
