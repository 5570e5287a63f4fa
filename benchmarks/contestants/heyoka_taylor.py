"""heyoka: Taylor integration with event detection on the state machine, restarted at events and samples.

One compiled integrator serves every regime of a scene: its coefficients are parameters. Compiling it is not timed.

heyoka looks for roots of a guard's Taylor polynomial in a step, and guards often start a step at zero: that of a block
that has just begun to slide, say, or one whose event falls on a sample. Where the constant term is zero, heyoka takes
the start of the step for the root and misses the next one; where it is below zero by rounding, a falling guard has no
root left; and a root at which a guard hardly moves gets a cooldown so long that it hides the next. So a guard that
starts below `ROUNDING` is lifted to it, until the next event or sample. Then every root is an event.
"""

from __future__ import annotations

from functools import cache, partial
from typing import Any, Final

import numpy as np

from contestants.base import Absent, Failed, Outcome, Setting
from contestants.state_machine import GRAVITY, ROUNDING, Guard, Machine
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


Slot = tuple[str, int, int, float]
"""Kind, floor, element and sign of a guard; no sign where a regime has one of both signs."""


def slots(plain: System) -> tuple[Slot, ...]:
    """Return the guards that a scene can have: an integrator has no others to watch."""
    found: list[Slot] = []
    for i, elements in enumerate(plain.elements):
        yielding = [e for e, (stiffness, strength) in enumerate(elements) if stiffness > 0.0 and np.isfinite(strength)]
        found += [("yield", i, e, sign) for e in yielding for sign in (1.0, -1.0)]
        if yielding:
            found.append(("unload", i, 0, 0.0))
        if plain.block_mass[i] > 0.0:
            found += [("slip", i, 0, 1.0), ("slip", i, 0, -1.0), ("arrive", i, 0, 0.0)]
    return tuple(found)


def _slot(guard: Guard) -> Slot:
    return guard.kind, guard.floor, guard.element, guard.sign if guard.kind in ("yield", "slip") else 0.0


def _factor(guard: Guard) -> float:
    """Return the factor of a guard on its quantity: drift, its rate, relative velocity, or floor acceleration."""
    if guard.kind == "yield":
        return float(guard.row[guard.floor])
    return -guard.sign if guard.kind == "slip" else guard.sign


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
        watched = slots(plain)
        self.numbers = {slot: number for number, slot in enumerate(watched)}
        self.machine = Machine(plain, tolerance)
        self.integrator, self.peak = _integrator(plain.storeys, watched, tolerance)
        self.pars, self.state = self.integrator.pars, self.integrator.state
        self.events = 0
        self.peak[:] = 0.0
        self.slip = np.zeros(plain.storeys)
        self._enter()

    def _enter(self) -> None:
        """Take over state and regime of the machine; a guard that the regime does not have is 1."""
        n, machine, count = self.machine.n, self.machine, len(self.numbers)
        floors = np.column_stack((machine.matrix[n : 2 * n, : 2 * n], machine.constant[n : 2 * n]))
        blocks = np.column_stack((-np.abs(machine.slides), -GRAVITY * machine.plain.mu * machine.slides))
        self.guards = {self.numbers[_slot(guard)]: guard for guard in machine.guards}
        factors, self.offsets, self.limits = np.zeros(count), np.ones(count), np.ones(count)
        self.rows = np.zeros((count, 4 * n))
        for number, guard in self.guards.items():
            factors[number], self.rows[number] = _factor(guard) / guard.scale, guard.row / guard.scale
            self.offsets[number] = guard.offset / guard.scale
            self.limits[number] = 1.0 if guard.kind == "slip" else self.offsets[number]
        self.pars[2 : self.pars.size - count] = np.concatenate((floors.ravel(), blocks.ravel(), factors))
        self.state[:] = machine.x
        if count:
            self.integrator.reset_cooldowns()

    def _lift(self, instant: float) -> None:
        """Lift the guards that start at zero; one far below has been missed."""
        values = self.rows @ self.state + self.offsets
        if values.min(initial=1.0) < -self.machine.zero:
            raise Failed(f"an event was missed before t = {instant:.3f} s")
        self.pars[self.pars.size - len(values) :] = self.limits + np.maximum(ROUNDING - values, 0.0)

    def note(self) -> None:
        """Count the state at an event or sample among the peaks."""
        drift, _, slip, _ = np.abs(self.state).reshape(4, -1)
        np.maximum(self.peak, drift, out=self.peak)
        np.maximum(self.slip, slip, out=self.slip)

    def advance(self, start: float, acceleration: float, slope: float) -> None:
        """Advance by a sample interval, restarting at events."""
        self.pars[:2] = acceleration, slope
        self.integrator.time = 0.0
        while True:
            self._lift(start + self.integrator.time)
            outcome = int(self.integrator.propagate_until(self.machine.plain.dt)[0].value)
            if not NO_EVENT < outcome < 0:
                return
            self.events += 1
            if self.events > MAX_EVENTS:
                raise Failed(f"more than {MAX_EVENTS} events at t = {start:.3f} s")
            self.machine.x = np.array(self.state)
            self.note()
            self.machine.fire(self.guards[-outcome - 1], acceleration + slope * self.integrator.time)
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
