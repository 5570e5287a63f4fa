"""diffsol (Rust, by pydiffsol): Tsit45 with stop conditions on the state machine, restarted at events and samples.

One compiled problem serves every regime of a scene: its coefficients are inputs. Compiling it is not timed. diffsol
stops where any guard changes its sign over a step, and does not tell which: the lowest is taken. Peaks are those of the
cubics over its steps.
"""

from __future__ import annotations

from functools import cache, partial
from typing import Any, Final

import numpy as np

from contestants.base import Absent, Failed, FloatArray, Outcome, Setting, hermite_peaks
from contestants.watched import Slot, Watched, slots
from scenes import BenchmarkScene, System, scenes, system

try:
    import pydiffsol as pydiffsol_module

    ds: Any = pydiffsol_module
except ImportError:
    ds = None

MAX_EVENTS: Final = 20000
LENGTH: Final = 1e-3
"""Absolute tolerance over the relative one (m, m/s)."""
PARTS: Final = (1.0, 0.7, 0.45, 0.2)
"""Of the way to the next sample, tried in turn."""
REFUSAL: Final = "Stop time is at the current state time"
"""Where a step of pydiffsol 0.6 happens to end within rounding of the end, it fails; with another end it does not."""


@cache
def _problem(n: int, watched: tuple[Slot, ...], tolerance: float) -> Any:
    """Compile. Inputs: state; ground acceleration and its slope; coefficients and limits of `Watched`."""
    inputs: list[str] = []

    def new(name: str) -> str:
        inputs.append(f"{name}{len(inputs)}")
        return inputs[-1]

    x = [f"{letter}{i}" for letter in "dvsr" for i in range(n)]
    start = [new("start") for _ in x]
    ground = f"({new('g')} + {new('g')} * t)"
    rates = [f"(v{i} - v{i - 1})" if i else "v0" for i in range(n)]
    floors = ["(" + " + ".join([*(f"{new('a')} * {name}" for name in x[: 2 * n]), new("a")]) + ")" for _ in range(n)]
    blocks = [f"{new('b')} * {floor} + {new('b')}" for floor in floors]
    quantities = {"yield": x[:n], "unload": rates, "slip": floors, "arrive": x[3 * n :]}
    factors = [f"{new('f')} * {quantities[kind][floor]}" for kind, floor, *_ in watched]
    guards = [f"{factor} + {new('f')}" for factor in factors]
    equations = [*rates, *(f"{floor} - {ground}" for floor in floors), *x[3 * n :], *blocks]
    tensors = {
        "in_i": [f"{name} = 0" for name in inputs],
        "u_i": [f"{name} = {value}" for name, value in zip(x, start, strict=True)],
        "F_i": equations,
    }
    if guards:
        tensors["stop_i"] = guards
    code = "\n".join(f"{name} {{ {', '.join(lines)} }}" for name, lines in tensors.items())
    problem = ds.Ode(code, ode_solver=ds.tsit45)
    problem.rtol, problem.atol = tolerance, tolerance * LENGTH
    return problem


class _Run:
    """One run: the state machine, and all steps of the solver that follows it."""

    def __init__(self, plain: System, tolerance: float) -> None:
        self.watched, self.problem = Watched(plain, tolerance), _problem(plain.storeys, slots(plain), tolerance)
        self.states: list[FloatArray] = []
        self.times: list[FloatArray] = []

    def _solve(self, inputs: FloatArray, left: float) -> tuple[FloatArray, float, bool]:
        """Return state and time of a stop, or else of the end, or of a part of the way: some ends pydiffsol refuses."""
        for part in PARTS:
            try:
                solution = self.problem.solve(inputs, part * left)
            except RuntimeError as failure:
                if REFUSAL not in str(failure):
                    raise
                continue
            states, times = solution.ys, solution.ts
            self.states.append(states)
            self.times.append(times)
            return states[:, -1], float(times[-1]), bool(times[-1] < part * left)
        raise Failed(f"no part of {left:g} s can be solved")

    def advance(self, x: FloatArray, start: float, acceleration: float, slope: float) -> FloatArray:
        """Return the state a sample interval later, restarting at events."""
        watched = self.watched
        left = watched.machine.plain.dt
        for _ in range(MAX_EVENTS):
            limits = watched.lifted(x, start)
            inputs = np.concatenate((x, (acceleration, slope), watched.coefficients, limits))
            x, spent, stopped = self._solve(inputs, left)
            if spent >= left:
                return x
            left, acceleration = left - spent, acceleration + slope * spent
            if stopped:
                watched.fire(int(np.argmin(watched.values(x) + limits - watched.limits)), x.copy(), acceleration)
                x = watched.machine.x
        raise Failed(f"more than {MAX_EVENTS} events in the interval from t = {start:.3f} s")


def integrate(bench: BenchmarkScene, tolerance: float) -> Outcome:
    """Integrate with a relative tolerance."""
    if ds is None:
        raise Absent("pydiffsol")
    plain = system(bench)
    run = _Run(plain, tolerance)
    samples = np.zeros((len(plain.acceleration), 4 * plain.storeys))
    slopes = np.diff(plain.acceleration) / plain.dt
    for i, slope in enumerate(slopes):
        samples[i + 1] = run.advance(samples[i], i * plain.dt, plain.acceleration[i], slope)
    if not np.isfinite(samples).all():
        raise Failed("the response is not finite")
    drift, velocity, slip, relative = np.split(np.concatenate(run.states, axis=1).T, 4, axis=1)
    # Times are from the last restart, at which the last state is there again: no cubic.
    lengths = np.maximum(np.diff(np.concatenate(run.times)), 0.0)[:, None]
    floors = list(plain.floors)
    return Outcome(
        drift=samples[:, : plain.storeys],
        slip=samples[:, 2 * plain.storeys : 3 * plain.storeys][:, floors],
        peak_drift=hermite_peaks(drift, np.diff(velocity, axis=1, prepend=0.0), lengths),
        peak_slip=hermite_peaks(slip[:, floors], relative[:, floors], lengths),
        residual_slip=slip[-1, floors],
    )


def settings() -> list[Setting]:
    """Return four tolerances, compiled for every scene."""
    points = ((1e-14, True), (1e-12, False), (1e-9, True), (1e-6, False))
    if ds is not None:
        for plain in map(system, scenes()):
            for tolerance, _ in points:
                _problem(plain.storeys, slots(plain), tolerance)
    return [
        Setting(
            "diffsol, events and samples", f"rtol {tolerance:g}", partial(integrate, tolerance=tolerance), quick=quick
        )
        for tolerance, quick in points
    ]
