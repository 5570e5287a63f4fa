"""SciPy's DOP853 with terminal events and a state machine, restarted at events, or at events and every sample."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, Final

import numpy as np

from contestants.base import MAIN, Absent, Failed, FloatArray, Outcome, Setting, from_histories
from contestants.state_machine import Guard, Machine
from scenes import BenchmarkScene, system

try:
    from scipy.integrate import solve_ivp
except ImportError:
    solve_ivp = None

MAX_EVENTS: Final = 20000
LENGTH: Final = 1e-3
"""Absolute tolerance over the relative one (m, m/s)."""


def _line(t: float, start: float, value: float, slope: float) -> float:
    return value + slope * (t - start)


def _event(guard: Guard) -> Callable[[float, FloatArray], float]:
    def value(t: float, x: FloatArray) -> float:
        return float(guard.row @ x + guard.offset)

    function: Any = value
    function.terminal, function.direction = True, -1.0
    return value


class _Run:
    """One run: advances the machine from stop to stop and takes the samples on the way."""

    def __init__(self, bench: BenchmarkScene, tolerance: float) -> None:
        self.plain = system(bench)
        self.machine = Machine(self.plain, tolerance)
        self.tolerance = tolerance
        self.times = np.arange(len(self.plain.acceleration)) * self.plain.dt
        self.samples = np.zeros((len(self.times), 4 * self.machine.n))
        self.events = 0

    def ground(self, t: float) -> float:
        """Ground acceleration, linear between samples."""
        ground = self.plain.acceleration
        place = min(int(t / self.plain.dt), len(ground) - 2)
        return float(ground[place] + (ground[place + 1] - ground[place]) * (t / self.plain.dt - place))

    def advance(self, start: float, end: float, ground: Callable[[float], float], *, steps: float = np.inf) -> None:
        """Solve from start to end, restarting at events."""
        machine = self.machine
        while start < end:
            inside = self.times[(self.times > start) & (self.times <= end)]
            result = solve_ivp(
                lambda t, x: machine.rate(x, ground(t)),
                (start, end),
                machine.x,
                method="DOP853",
                t_eval=inside,
                rtol=self.tolerance,
                atol=self.tolerance * LENGTH,
                events=[_event(guard) for guard in machine.guards],
                max_step=steps,
            )
            if not result.success and result.status != 1:
                raise Failed(result.message)
            if len(result.t):
                first = round(inside[0] / self.plain.dt)
                self.samples[first : first + result.y.shape[1]] = result.y.T
            if result.status == 0:
                machine.x = result.y[:, -1].copy()
                return
            self.events += 1
            if self.events > MAX_EVENTS:
                raise Failed(f"more than {MAX_EVENTS} events at t = {start:.3f} s")
            number = next(j for j, times in enumerate(result.t_events) if len(times))
            start = float(result.t_events[number][0])
            machine.x = result.y_events[number][0].copy()
            machine.fire(machine.guards[number], ground(start))


def integrate(bench: BenchmarkScene, tolerance: float, *, at_samples: bool) -> Outcome:
    """Integrate with a relative tolerance; without restarts at samples no step exceeds a sample interval."""
    if solve_ivp is None:
        raise Absent("scipy")
    run = _Run(bench, tolerance)
    if at_samples:
        for i, (start, end) in enumerate(zip(run.times[:-1], run.times[1:], strict=True)):
            low, high = run.plain.acceleration[i : i + 2]
            run.advance(start, end, partial(_line, start=start, value=low, slope=(high - low) / run.plain.dt))
    else:
        run.advance(0.0, float(run.times[-1]), run.ground, steps=run.plain.dt)
    floors = list(run.plain.floors)
    drift, velocity, slip, relative = np.split(run.samples, 4, axis=1)
    rate = np.diff(velocity, axis=1, prepend=0.0)
    return from_histories(drift, slip[:, floors], rate, relative[:, floors], run.plain.dt)


def settings() -> list[Setting]:
    """Return restarts at every sample and at events only; many seconds each, so on one scene."""
    return [
        Setting(
            f"SciPy DOP853, events{' and samples' if at_samples else ''}",
            f"rtol {tolerance:g}",
            partial(integrate, tolerance=tolerance, at_samples=at_samples),
            scenes=MAIN,
            quick=quick,
        )
        for tolerance, at_samples, quick in (
            (1e-6, True, True),
            (1e-9, True, False),
            (1e-13, True, True),
            (1e-6, False, False),
            (1e-10, False, False),
        )
    ]
