"""The performance benchmark: its arithmetic, and its quick mode from end to end; no time is judged."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

FOLDER = Path(__file__).parents[1] / "benchmarks"
TIMINGS = {
    "runs": {
        "samples": 100.0,
        "events": 3.0,
        "peaks": 2e-5,
        "displacements": 3e-5,
        "histories": 5e-5,
        "leapfrog": 4e-5,
    },
    "steps": {"step": 3e-8, "chain": 1e-8, "chain_with_rates": 2e-8, "frequency": 5e9},
    "threads": {"one": 1.0, "two": 1.0},
}
"""What the program in Rust could print, in each of its processes: it is not built here."""
ANNOTATED = """\
Ir                 file:function
--------------------------------------------------------------------------------
1,000 (50.00%)  crates/seismass/src/step/series.rs:seismass::run::simulate::run [/somewhere/count]
  600 (30.00%)  /rustc/59807/library/core/src/num/f64.rs:seismass::run::simulate::run
  300 (15.00%)  ./malloc/./malloc/malloc.c:_int_free [/usr/lib/libc.so.6]
  100 ( 5.00%)  ???:std::time::now [/usr/lib/libc.so.6]
2,000 (100.0%)  PROGRAM TOTALS
"""


@pytest.fixture
def module(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Import a module of benchmarks/, which is no package."""
    monkeypatch.syspath_prepend(str(FOLDER))
    before = set(sys.modules)
    yield importlib.import_module
    for name in set(sys.modules) - before:
        if getattr(sys.modules[name], "__file__", None) and str(FOLDER) in str(sys.modules[name].__file__):
            del sys.modules[name]


def test_targets_say_what_is_missed(module: Any) -> None:
    base = module("targets.base")
    assert base.Target("time", 2.0, 2.0).verdict == "met"
    assert base.Target("time", 2.1, 2.0).verdict == "missed"
    assert base.Target("speed-up", 1.9, 1.95, at_most=False).verdict == "missed"
    assert base.Target("peer", None, 1.0, note="absent").verdict == "not measured"
    section = base.Section("One", [base.Target("a_b", 2.1, 2.0, "s"), base.Target("peer", None, 1.0)], "Words.\n")
    page = module("performance_page").page({"one": section}, "a machine", recorded=False)
    assert "Of 2 targets: 1 missed, 1 not measured." in page
    assert r"| a\_b | <= 2 s | 2.1 s | **missed** |" in page


def test_targets_within_scatter_are_marked_and_those_added_later_counted_apart(module: Any) -> None:
    base, written = module("targets.base"), module("performance_page")
    found = base.repeated(np.array([2.0, 2.2, 2.1, 1.9, 2.4]) / np.array([1.0, 1.0, 1.0, 1.0, 2.0]))
    assert [found.median, *found.quartiles] == pytest.approx([2.0, 1.9, 2.1])
    targets = [
        base.Target("near", found.median, 1.95, scatter=found.quartiles),
        base.Target("clear", found.median, 1.5, scatter=found.quartiles),
        base.Target("new", found.median, 3.0, scatter=found.quartiles, later=True),
    ]
    page = written.page({"one": base.Section("One", targets, "Words.\n")}, "a machine", recorded=False)
    assert "| near | <= 1.95 | 2 (1.9 to 2.1) | **missed**, within scatter |" in page
    assert "| clear | <= 1.5 | 2 (1.9 to 2.1) | **missed** |" in page
    first, later = page.split("Added after these had been measured")
    assert "Of 2 targets: 2 missed." in first
    assert "Of 1 targets: 1 met." in later
    assert "| new |" in later


def test_instructions_by_module_and_by_function(module: Any) -> None:
    modules, functions = module("targets.profile").shares(ANNOTATED)
    assert modules == {
        "step/series": 1000,
        "run": 600,
        "memory: allocated, copied, cleared": 300,
        "other libraries": 100,
    }
    assert functions["seismass::run::simulate::run"] == 1600


def test_instruction_counts_are_appended_under_new_labels(
    module: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    instructions = module("instructions")
    monkeypatch.setattr(instructions, "RECORDED", tmp_path / "instructions.csv")
    rows = [("now", "scene, one", "per run", 200.04, "rustc 2"), ("now", "scene, one", "events", 3.0, "rustc 2")]
    counts = pl.DataFrame(rows, schema=instructions.SCHEMA, orient="row")
    instructions.record(counts, "before, with a comma")
    instructions.record(counts.with_columns(value=pl.col("value") / 2.0), "after")
    assert instructions.recorded()["value"].to_list() == [200.0, 3.0, 100.0, 1.5]
    with pytest.raises(ValueError, match="label must be new; got after"):
        instructions.record(counts, "after")
    printed = instructions.comparison(instructions.recorded()).splitlines()
    assert printed[0] == "A: before, with a comma (rustc 2)"
    assert printed[-2].split() == ["scene,", "one", "per", "run", "200.0", "100.0", "0.500"]


def test_instruction_counts_are_judged_beside_the_last_label(
    module: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """An old label was twice as dear, which hides nothing; rows from before `tools` was a column are read."""
    instructions = module("instructions")
    monkeypatch.setattr(instructions, "ROOT", tmp_path)
    monkeypatch.setattr(instructions, "RECORDED", tmp_path / "instructions.csv")
    old = ["old,a,per run,200.0", "last,a,per run,100.0", "last,a,events,3.0", "last,b,per run,50.0"]
    (tmp_path / "instructions.csv").write_text("\n".join(["label,scene,quantity,value", *old]) + "\n")
    now = [("a", "per run", 102.0), ("a", "events", 4.0), ("b", "per run", 50.4), ("c", "per run", 7.0)]
    counts = pl.DataFrame([("now", *row, "rustc 2") for row in now], schema=instructions.SCHEMA, orient="row")
    monkeypatch.setattr(instructions, "measured", lambda: counts)

    def run(*options: str) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["instructions.py", *options])
        return instructions.main(), *capsys.readouterr()

    status, printed, judged = run()
    assert (status, judged) == (1, "grown by more than 1 %: a, per run: +2.0 %\n")
    assert "old" not in printed
    assert ["a", "per", "run", "100.0", "102.0", "1.020"] in [line.split() for line in printed.splitlines()]
    status, printed, judged = run("--tolerance", "2.5", "--all")
    assert (status, judged) == (0, "")
    assert "A: old\nB: last\nC: now (rustc 2)\n" in printed
    assert run("--label", "dearer")[0] == 0
    assert instructions.recorded()["tools"].to_list() == [None] * 4 + ["rustc 2"] * 4
    assert run()[0] == 0


def test_without_valgrind_nothing_is_counted_and_that_is_said(
    module: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    instructions = module("instructions")
    monkeypatch.setattr(instructions.shutil, "which", lambda program: None)
    monkeypatch.setattr(sys, "argv", ["instructions.py"])
    assert instructions.main() == 1
    assert "valgrind is not installed" in capsys.readouterr().err


def test_recorded_counts_have_every_column_of_the_page(module: Any) -> None:
    found = {tuple(row) for row in module("instructions").recorded().select("scene", "quantity").iter_rows()}
    assert {(scene, quantity) for _, scene, quantity in module("targets.profile").HIGHLIGHTS} <= found


def test_changes_name_what_differs_and_where(module: Any) -> None:
    """Of nine counts the first falls by half, one run grows by 2 %, and one falls by less than is shown."""
    profile = module("targets.profile")
    assert len(profile.HIGHLIGHTS) == 9
    before = [100.0] * 9
    after = [50.0, 99.0, 100.0, 102.0, 100.0, 100.0, 100.0, 100.0, 100.0]
    assert profile.changes(before, after) == ("step -50 %, run +2 %", "yielding, 4 storeys; section 4")
    everywhere = [100.0, 100.0, 100.0, 90.0, 80.0, 90.0, 90.0, 90.0, 100.0]
    assert profile.changes(before, everywhere) == ("run -10 to -20 %", "all runs")
    assert profile.changes([None] * 9, after) == ("", "")


def test_quick_mode_writes_the_page(module: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def timings(work: str, *_: Any, **__: Any) -> dict[str, np.ndarray]:
        return {name: np.full(3, value) for name, value in TIMINGS[work].items()}

    performance = module("performance")
    for name in ("leapfrog", "step", "threads"):
        monkeypatch.setattr(module(f"targets.{name}"), "timings", timings)
    monkeypatch.setattr(performance, "ROOT", tmp_path)
    assert performance.main(["--quick"]) == 0
    docs = tmp_path / "out" / "bench" / "docs"
    page = (docs / "performance.md").read_text(encoding="utf-8")
    assert (docs / "figures" / "performance_storeys.png").stat().st_size > 10_000
    assert page.count("\n## ") == 2 + len(performance.SECTIONS)
    assert page.count("\n| after: ") == len(performance.SECTIONS)
    assert "{" not in page
    leapfrog = module("targets.leapfrog")
    assert page.count("| exact run / leapfrog pass") == len(leapfrog.scenes()) * len(leapfrog.OUTPUTS) >= 12
    assert "| plain step / bare chain of the state, 4 storeys | <= 2 | 3 (3 to 3) | **missed** |" in page
