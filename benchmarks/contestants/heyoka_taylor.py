"""heyoka: Taylor integration with event detection on the state machine, restarted at events and samples.

One integrator serves every regime: its coefficients are parameters. Compiling it is not timed.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, partial
from typing import Any, Final

import numpy as np

from contestants.base import Absent, Failed, Outcome, Setting, from_histories
from contestants.state_machine import Guard, Machine
from scenes import BenchmarkScene, system

try:
    import heyoka as heyoka_module

    hy: Any = heyoka_module
except ImportError:
    hy = None

SCENES: Final = ("section4-0.05", "section4-0.5", "study-3", "sliding")
"""Three storeys each, so that one compiled integrator serves them."""
STOREYS: Final = 3
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


def _slots(n: int) -> Iterator[Slot]:
    for i in range(n):
        yield from (("yield", i, e, sign) for e in (0, 1) for sign in (1.0, -1.0))
        yield ("unload", i, 0, 0.0)
        yield ("arrive", i, 0, 0.0)
        yield from (("slip", i, 0, sign) for sign in (1.0, -1.0))


def _slot(guard: Guard) -> Slot:
    return guard.kind, guard.floor, guard.element, guard.sign if guard.kind in ("yield", "slip") else 0.0


def _columns(slot: Slot, n: int) -> list[int]:
    """Columns of the state that a guard depends on."""
    kind, i = slot[:2]
    if kind == "yield":
        return [i]
    if kind == "unload":
        return [n + i] if i == 0 else [n + i, n + i - 1]
    return [3 * n + i] if kind == "arrive" else list(range(2 * n))


@cache
def _integrator(n: int, tolerance: float) -> Any:
    names = [f"{letter}{i}" for letter in "dvsr" for i in range(n)]
    x = hy.make_vars(*names)
    numbered = _Parameters()
    rates = [x[n + i] - x[n + i - 1] if i else x[n] for i in range(n)]
    accelerations: list[Any] = []
    for _ in range(2 * n):
        terms = [numbered.new() * x[j] for j in range(2 * n)]
        accelerations.append(hy.sum([*terms, numbered.new(), numbered.new() * hy.time]))
    equations = [*rates, *accelerations[:n], *x[3 * n :], *accelerations[n:]]
    events = []
    for slot in _slots(n):
        value = hy.sum([*(numbered.new() * x[j] for j in _columns(slot, n)), numbered.new()])
        events.append(hy.t_event(value, direction=hy.event_direction.negative))
    return hy.taylor_adaptive(
        list(zip(x, equations, strict=True)),
        [0.0] * (4 * n),
        pars=[0.0] * numbered.count,
        t_events=events,
        tol=tolerance,
    )


def _load(integrator: Any, machine: Machine, acceleration: float, slope: float) -> dict[int, Guard]:
    """Give the regime and the course of the ground motion to the integrator; return the guards by event number."""
    n = machine.n
    active = {_slot(guard): guard for guard in machine.guards}
    parameters: list[float] = []
    for row in (*range(n, 2 * n), *range(3 * n, 4 * n)):
        parameters += machine.matrix[row, : 2 * n].tolist()
        parameters += [machine.constant[row] + acceleration * machine.ground[row], slope * machine.ground[row]]
    numbers: dict[int, Guard] = {}
    for number, slot in enumerate(_slots(n)):
        guard = active.get(slot)
        columns = _columns(slot, n)
        if guard is None:
            parameters += [0.0] * len(columns) + [1.0]
        else:
            numbers[number] = guard
            parameters += [*guard.row[columns].tolist(), guard.offset]
    integrator.pars[:] = parameters
    return numbers


def integrate(bench: BenchmarkScene, tolerance: float) -> Outcome:
    """Integrate with heyoka's tolerance."""
    if hy is None:
        raise Absent("heyoka")
    plain = system(bench)
    machine, integrator = Machine(plain, tolerance), _integrator(plain.storeys, tolerance)
    samples = np.zeros((len(plain.acceleration), 4 * plain.storeys))
    integrator.state[:] = machine.x
    events = 0
    for i, acceleration in enumerate(plain.acceleration[:-1]):
        slope = (plain.acceleration[i + 1] - acceleration) / plain.dt
        integrator.time = 0.0
        numbers = _load(integrator, machine, acceleration, slope)
        while True:
            outcome = int(integrator.propagate_until(plain.dt)[0].value)
            if not NO_EVENT < outcome < 0:
                break
            events += 1
            if events > MAX_EVENTS:
                raise Failed(f"more than {MAX_EVENTS} events at t = {i * plain.dt:.3f} s")
            guard = numbers[-outcome - 1]
            machine.x = np.array(integrator.state)
            now = acceleration + slope * integrator.time
            # A guard that starts at zero and rises is reported too.
            if guard.row @ machine.rate(machine.x, now) < -machine.slow * guard.scale:
                machine.fire(guard, now)
                integrator.state[:] = machine.x
                integrator.reset_cooldowns()
                numbers = _load(integrator, machine, acceleration, slope)
        samples[i + 1] = integrator.state
    floors = list(plain.floors)
    drift, velocity, slip, relative = np.split(samples, 4, axis=1)
    rate = np.diff(velocity, axis=1, prepend=0.0)
    return from_histories(drift, slip[:, floors], rate, relative[:, floors], plain.dt)


def settings() -> list[Setting]:
    """Return two tolerances, compiled."""
    points = ((1e-15, True), (1e-9, False))
    if hy is not None:
        for tolerance, _ in points:
            _integrator(STOREYS, tolerance)
    return [
        Setting(
            "heyoka, events and samples",
            f"tolerance {tolerance:g}",
            partial(integrate, tolerance=tolerance),
            scenes=SCENES,
            quick=quick,
        )
        for tolerance, quick in points
    ]
