"""The benchmarks' own arithmetic, and the peers that need nothing installed, against the exact kernel."""

from __future__ import annotations

import importlib
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

import seismass as sm

FOLDER = Path(__file__).parents[1] / "benchmarks"


@pytest.fixture
def module(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Import a module of benchmarks/, which is no package."""
    monkeypatch.syspath_prepend(str(FOLDER))
    before = set(sys.modules)
    yield importlib.import_module
    for name in set(sys.modules) - before:
        if getattr(sys.modules[name], "__file__", None) and str(FOLDER) in str(sys.modules[name].__file__):
            del sys.modules[name]


@pytest.fixture
def bench(module: Any) -> Any:
    """The section-4 building under the first 2000 samples of a built-in motion."""
    scenes = module("scenes")
    motion = sm.builtin_suite("seven")[0]
    samples = motion.scaled(6.9 / motion.pga).acceleration[:2000]
    return scenes.BenchmarkScene("short", "short", scenes.section4(0.05), sm.Motion(samples, motion.dt), "synthetic")


def test_time_at_an_error_level_is_straight_in_log_log(module: Any) -> None:
    front = module("front")
    found = [(1e-2, 1.0), (1e-4, 10.0), (1e-3, 20.0)]
    assert front.envelope(found) == [(1e-2, 1.0), (1e-4, 10.0)]
    assert front.time_at(found, 1e-1) == 1.0
    assert front.time_at(found, 1e-3) == pytest.approx(10**0.5)
    assert front.time_at(found, 1e-5) is None


def test_cubic_peaks_lie_between_samples(module: Any) -> None:
    # A sine sampled beside its crests: the cubic's error is below (w dt)^4 / 384.
    dt, w = 0.05, 2.0
    t = np.arange(200) * dt
    value, rate = np.sin(w * t + 0.3)[:, None], w * np.cos(w * t + 0.3)[:, None]
    peak = module("contestants.base").hermite_peaks(value, rate, dt)
    assert abs(peak[0] - 1.0) < (w * dt) ** 4 / 384 < 1.0 - np.abs(value).max() + 1e-6


@pytest.mark.parametrize(
    ("method", "substeps", "located", "bound"), [("gauss", 5, 1e-12, 1e-7), ("leapfrog", 20, None, 1e-4)]
)
def test_reference_integrators_reach_python(
    module: Any, bench: Any, method: str, substeps: int, located: float | None, bound: float
) -> None:
    exact = module("contestants.exact").with_histories(bench)
    found = module("contestants.reference").run(bench, method, substeps, located)
    assert found.drift.shape == exact.drift.shape
    assert found.slip.shape == exact.slip.shape
    assert np.abs(found.drift - exact.drift).max() < bound * exact.peak_drift.max()
    assert np.abs(found.peak_slip - exact.peak_slip).max() < bound * exact.peak_slip.max()


def test_the_leapfrog_that_numba_compiles_agrees_with_the_kernel_and_with_that_in_rust(
    module: Any, bench: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As plain Python, over 200 strong samples, all blocks sliding; both leapfrogs do the same but for rounding."""
    contestant = module("contestants.numba_leapfrog")
    monkeypatch.setattr(contestant, "_compiled", contestant._leapfrog)
    strongest = int(np.abs(bench.motion.acceleration).argmax())
    samples = bench.motion.acceleration[strongest - 100 : strongest + 100]
    scene = module("scenes").section4(0.05, mu=0.05)
    short = replace(bench, scene=scene, motion=sm.Motion(samples, bench.motion.dt))
    exact = module("contestants.exact").with_histories(short)
    rust = module("contestants.reference").run(short, "leapfrog", 20)
    found = contestant.leapfrog(short, 20)
    assert exact.peak_slip.min() > 1e-3
    for name in ("drift", "slip", "peak_drift", "peak_slip", "residual_slip"):
        mine, theirs, true = (getattr(outcome, name) for outcome in (found, rust, exact))
        assert mine.shape == true.shape
        assert np.abs(mine - true).max() < 1e-4 * np.abs(true).max()
        assert np.abs(mine - theirs).max() < 1e-12 * np.abs(true).max()


def test_scipy_with_events_and_samples_agrees_with_the_kernel(module: Any, bench: Any) -> None:
    """A fresh state machine on an integrator that shares nothing with the kernel."""
    exact = module("contestants.exact").with_histories(bench)
    found = module("contestants.scipy_events").integrate(bench, 1e-12, at_samples=True)
    assert np.abs(found.drift - exact.drift).max() < 1e-10 * exact.peak_drift.max()
    assert np.abs(found.slip - exact.slip).max() < 1e-10 * exact.peak_slip.max()


@pytest.mark.parametrize(
    ("package", "contestant", "tolerance", "bound"),
    [("heyoka", "heyoka_taylor", 1e-15, 1e-11), ("pydiffsol", "diffsol_tsit45", 1e-14, 1e-10)],
)
def test_no_event_of_a_guard_that_starts_at_zero_is_lost(
    module: Any, bench: Any, package: str, contestant: str, tolerance: float, bound: float
) -> None:
    """Blocks that rest for moments only slip and come to rest again within a sample interval."""
    pytest.importorskip(package, reason=f"{package} is a package of the benchmarks, not of the tests")
    scenes = module("scenes")
    for scene in (scenes.section4(0.5), scenes.section4(0.05, mu=0.05)):
        short = replace(bench, scene=scene)
        exact = module("contestants.exact").with_histories(short)
        found = module(f"contestants.{contestant}").integrate(short, tolerance)
        assert np.abs(found.drift - exact.drift).max() < bound * exact.peak_drift.max()
        assert np.abs(found.slip - exact.slip).max() < bound * exact.peak_slip.max()
        assert np.abs(found.peak_drift - exact.peak_drift).max() < bound * exact.peak_drift.max()
        assert np.abs(found.peak_slip - exact.peak_slip).max() < bound * exact.peak_slip.max()


def test_guards_at_zero_are_lifted_and_guards_below_are_missed_events(module: Any, bench: Any) -> None:
    scenes, machine = module("scenes"), module("contestants.state_machine")
    rough = replace(bench, scene=scenes.section4(0.05, mu=10.0))
    watched = module("contestants.watched").Watched(scenes.system(rough), 1e-15)
    assert len(watched.limits) == len(watched.values(watched.machine.x)) == 3 * (4 + 1 + 3)
    x = np.zeros(12)
    assert (watched.lifted(x, 0.0) == watched.limits).all()
    yields = next(number for number, guard in watched.guards.items() if guard.kind == "yield" and guard.floor == 0)
    guard = watched.guards[yields]
    x[0] = -guard.offset / guard.row[0]
    lifted = watched.lifted(x, 0.0) - watched.limits
    assert lifted[yields] == pytest.approx(machine.ROUNDING, rel=1e-9)
    assert np.count_nonzero(lifted) == 1
    with pytest.raises(module("contestants.base").Failed, match="missed"):
        watched.lifted(1.01 * x, 0.0)


@pytest.mark.parametrize("ratio", [1.0, 1e4])
def test_steps_of_central_difference_are_below_its_limit_of_stability(module: Any, bench: Any, ratio: float) -> None:
    """One floor and a block of the same mass m on a spring of r k: m w^2 / k = (1 + 2 r + sqrt(1 + 4 r^2)) / 2."""
    opensees, scenes = module("contestants.opensees"), module("scenes")
    building = sm.Building.uniform(1, 0.5, damping=0.05)
    plain = scenes.system(replace(bench, scene=sm.Scene(building, sm.blocks_on_floors([1.0], mu=0.3))))
    highest = 2 * np.pi / 0.5 * np.sqrt(0.5 * (1 + 2 * ratio + np.sqrt(1 + 4 * ratio**2)))
    enough = int(0.5 * plain.dt * highest) + 1
    opensees.check_stability(plain, opensees.Recipe(ratio, enough))
    with pytest.raises(module("contestants.base").Failed, match=rf"substeps must be above .*; got {enough - 1}"):
        opensees.check_stability(plain, opensees.Recipe(ratio, enough - 1))


def test_settings_of_central_difference_are_stable_on_all_scenes(module: Any) -> None:
    opensees, scenes = module("contestants.opensees"), module("scenes")
    recipes = [setting.work.keywords["recipe"] for setting in opensees.settings()]
    explicit = [recipe for recipe in recipes if recipe.integrator == opensees.CENTRAL_DIFFERENCE]
    assert len(explicit) == 3
    for scene in scenes.scenes():
        for recipe in explicit:
            opensees.check_stability(scenes.system(scene), recipe)


def test_part_of_the_benchmark_is_run_and_not_written(
    module: Any, bench: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    benchmark, judge = module("work_precision"), module("judge")
    solved = module("contestants.exact").with_histories(bench)
    monkeypatch.setattr(benchmark, "scenes", lambda: [replace(bench, name=name) for name in ("sliding", "elastic")])
    monkeypatch.setattr(benchmark, "reference", lambda _: judge.Reference(solved, solved.drift, solved.slip, 7))
    monkeypatch.setattr(benchmark, "write", lambda *_: pytest.fail("written"))
    assert benchmark.main(["--quick", "--contestants", "exact", "--scenes", "sliding"]) == 0
    rows = [line.split()[0] for line in capsys.readouterr().out.splitlines() if line.startswith("  ")]
    assert rows
    assert set(rows) == {"seismass,"}
    with pytest.raises(SystemExit):
        benchmark.main(["--contestants", "heyoka"])


def rows_of(module: Any, *rows: tuple[str, str, float, float | None, float]) -> pl.DataFrame:
    """A table of points on one scene: family, setting, time, error of the drift history and of the peak drift."""
    schema = module("work_precision").SCHEMA
    names = ("family", "setting", "time", "drift_error", "peak_drift_error")
    return pl.DataFrame(
        [dict.fromkeys(schema) | {"scene": "one", "status": "ok"} | dict(zip(names, row, strict=True)) for row in rows],
        schema=schema,
    )


def test_a_run_for_peaks_only_is_compared_with_nobody(module: Any) -> None:
    page, exact = module("page"), module("contestants.exact")
    assert [setting.family for setting in exact.settings()] == [page.OURS, page.PEAKS_ONLY]
    table = rows_of(
        module,
        (page.OURS, "histories", 2.0, 1e-15, 1e-15),
        (page.PEAKS_ONLY, "peaks", 1.0, None, 1e-15),
        ("leapfrog, Rust", "dt / 1", 1.5, 1e-3, 1e-3),
    )
    assert page.fastest(table, "one", "peak_drift_error", 1e-2) == [(1.5, "leapfrog, Rust"), (2.0, page.OURS)]
    assert page.fastest(table, "one", "peak_drift_error", 1e-6) == [(2.0, page.OURS)]


def test_what_the_page_says_of_friction_springs_comes_from_the_points(module: Any) -> None:
    page = module("page")
    settings = [*module("contestants.reference").settings(), *module("contestants.opensees").settings()]
    assert set(page.SAME_SPRINGS) <= {(setting.family, setting.label) for setting in settings}
    compiled, theirs = page.SAME_SPRINGS
    told = page.same_springs(rows_of(module, (*compiled, 1e-3, 1e-2, 1e-2), (*theirs, 0.05, 1.01e-2, 1e-2)))
    assert "differ by at most 1 % on 1 scenes" in " ".join(told.split())
    assert "50 to 50 times as long" in told
    assert "No scene" in page.same_springs(rows_of(module, (*compiled, 1e-3, 1e-2, 1e-2)))


def test_the_profile_is_told_in_words(module: Any) -> None:
    profile = module("targets.profile")
    counts = Counter({"plain": 40, "step/series": 20, profile.MEMORY: 4, "lanes": 36})
    told = profile.in_words("a scene", 100, counts)
    for part in ("40 % take plain steps", "20 % form the series", "0 % form regimes", "4 % allocate", "other 36 %"):
        assert part in told
    named = {name for _, names in profile.ACTIVITIES for name in names} - {profile.MEMORY}
    sources = FOLDER.parent / "crates/seismass/src"
    modules = {path.relative_to(sources).with_suffix("").as_posix() for path in sources.rglob("*")}
    assert named <= modules


def test_a_large_batch_is_streamed_whole(module: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    million = module("million")
    monkeypatch.setattr(million, "LEAST_TIME", 0.0)
    found = million.measured_here(27, threads=2)
    assert (found["runs"], found["failed"], found["repeats"]) == (27, 0, 1)
    assert found["events"] == sm.simulate_many(million.grid(27), million.motion())["events"].sum()
