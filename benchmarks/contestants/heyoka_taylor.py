"""heyoka: Taylor integration with event detection on the state machine, restarted at events and samples.

One compiled integrator serves every regime of a scene: its coefficients are parameters. Compiling it is not timed.

heyoka looks for roots of a guard's Taylor polynomial in a step, and guards often start a step at zero: that of a block
that has just begun to slide, say, or one whose event falls on a sample. Where the constant term is zero, heyoka takes
the start of the step for the root and misses the next one; where it is below zero by rounding, a falling guard has no
root left; and a root at which a guard hardly moves gets a cooldown so long that it hides the next. So such guards are
lifted (`Watched.lifted`). Then every root is an event.
"""

from __future__ import annotations

from functools import cache, partial
from typing import Any, Final

import numpy as np

from contestants.base import Absent, Failed, Outcome, Setting
from contestants.watched import Slot, Watched, slots
from scenes import BenchmarkScene, System, scenes, system

try:
    import heyoka as heyoka_module

    hy: Any = heyoka_module
except ImportError:
    hy = None

MAX_EVENTS: Final = 20000
NO_EVENT: Final = -(2**32)
"""Outcomes above this and below zero number the event that stopped the integration."""


class _Parameters:
    """Numbers the parameters of the integrator in the order in which its expressions ask for them."""

    def __init__(self) -> None:
        self.count = 0

    def new(self) -> Any:
        """Return the next parameter."""
        self.count += 1
        return hy.par[self.count - 1]


@cache
def _integrator(n: int, watched: tuple[Slot, ...], tolerance: float) -> Any:
    """Compile. Parameters: ground acceleration and its slope; floors; blocks; factors of the guards; their limits."""
    x = hy.make_vars(*(f"{letter}{i}" for letter in "dvsr" for i in range(n)))
    numbered = _Parameters()
    ground = numbered.new() + numbered.new() * hy.time
    rates = [x[n + i] - x[n + i - 1] if i else x[n] for i in range(n)]
    floors = [hy.sum([*(numbered.new() * x[j] for j in range(2 * n)), numbered.new()]) for _ in range(n)]
    blocks = [numbered.new() * floor + numbered.new() for floor in floors]
    equations = [*rates, *(floor - ground for floor in floors), *x[3 * n :], *blocks]
    quantities = {"yield": x[:n], "unload": rates, "slip": floors, "arrive": x[3 * n :]}
    values = [numbered.new() * quantities[kind][floor] for kind, floor, *_ in watched]
    peak = np.zeros(n)

    def turn(integrator: Any, time: float, _: int, storey: int) -> None:
        integrator.update_d_output(time)
        peak[storey] = max(peak[storey], abs(integrator.d_output[storey]))

    integrator = hy.taylor_adaptive(
        list(zip(x, equations, strict=True)),
        [0.0] * (4 * n),
        pars=[0.0] * (numbered.count + len(watched)),
        t_events=[hy.t_event(value + numbered.new(), direction=hy.event_direction.negative) for value in values],
        nt_events=[hy.nt_event(rate, partial(turn, storey=i)) for i, rate in enumerate(rates)],
        tol=tolerance,
    )
    return integrator, peak


class _Run:
    """One run: the state machine, and the integrator that follows it from sample to sample."""

    def __init__(self, plain: System, tolerance: float) -> None:
        self.watched = Watched(plain, tolerance)
        self.integrator, self.peak = _integrator(plain.storeys, slots(plain), tolerance)
        self.pars, self.state = self.integrator.pars, self.integrator.state
        self.events = 0
        self.peak[:] = 0.0
        self.slip = np.zeros(plain.storeys)
        self._enter()

    def _enter(self) -> None:
        """Take over state and regime of the machine."""
        watched = self.watched
        self.pars[2 : self.pars.size - len(watched.limits)] = watched.coefficients
        self.state[:] = watched.machine.x
        if len(watched.limits):
            self.integrator.reset_cooldowns()

    def note(self) -> None:
        """Count the state at an event or sample among the peaks."""
        drift, _, slip, _ = np.abs(self.state).reshape(4, -1)
        np.maximum(self.peak, drift, out=self.peak)
        np.maximum(self.slip, slip, out=self.slip)

    def advance(self, start: float, acceleration: float, slope: float) -> None:
        """Advance by a sample interval, restarting at events."""
        self.pars[:2] = acceleration, slope
        self.integrator.time = 0.0
        watched = self.watched
        while True:
            self.pars[self.pars.size - len(watched.limits) :] = watched.lifted(self.state, start)
            outcome = int(self.integrator.propagate_until(watched.machine.plain.dt)[0].value)
            if not NO_EVENT < outcome < 0:
                return
            self.events += 1
            if self.events > MAX_EVENTS:
                raise Failed(f"more than {MAX_EVENTS} events at t = {start:.3f} s")
            self.note()
            watched.fire(-outcome - 1, np.array(self.state), acceleration + slope * self.integrator.time)
            self._enter()


def integrate(bench: BenchmarkScene, tolerance: float) -> Outcome:
    """Integrate with heyoka's tolerance."""
    if hy is None:
        raise Absent("heyoka")
    plain = system(bench)
    run = _Run(plain, tolerance)
    samples = np.zeros((len(plain.acceleration), 4 * plain.storeys))
    slopes = np.diff(plain.acceleration) / plain.dt
    for i, slope in enumerate(slopes):
        run.advance(i * plain.dt, plain.acceleration[i], slope)
        samples[i + 1] = run.state
    if not np.isfinite(samples).all():
        raise Failed("the response is not finite")
    drift, _, slip, _ = np.split(samples, 4, axis=1)
    slip = slip[:, list(plain.floors)]
    return Outcome(
        drift,
        slip,
        np.maximum(run.peak, np.abs(drift).max(axis=0)),
        np.maximum(run.slip[list(plain.floors)], np.abs(slip).max(axis=0)),
        slip[-1],
    )


def settings() -> list[Setting]:
    """Return three tolerances, compiled for every scene."""
    points = ((1e-15, True), (1e-9, False), (1e-6, False))
    if hy is not None:
        for plain in map(system, scenes()):
            for tolerance, _ in points:
                _integrator(plain.storeys, slots(plain), tolerance)
    return [
        Setting(
            "heyoka, events and samples",
            f"tolerance {tolerance:g}",
            partial(integrate, tolerance=tolerance),
            quick=quick,
        )
        for tolerance, quick in points
    ]
