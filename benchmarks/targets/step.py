"""The plain step beside the bare chain of the same size, and the event."""

from __future__ import annotations

import statistics

import numpy as np

import instructions
from scenes import suite
from study import distinct_runs, run_times, split
from targets.base import Section, Target, four_storeys, repeated, strong_motions, table
from targets.program import timings

CLOCK = 2.5e9
"""Frequency at which the target of the plain step is meant (Hz)."""
ROUNDS = 40
"""Rounds of the runs that an event is found from: some seconds in all, so that no moment decides."""
TEXT = """\
A plain step of the building of 4 storeys with a block on each floor: the additional time of a run without events when
its motion is longer, per sample. For comparison, in the same run, the bare recurrence y = P x + c: a dense matrix on
the 8 numbers of the state, and on these with the 8 rows of floor accelerations and their rates, which the proof of a
plain step needs.

{steps}
The processor ran at {frequency:.2f} GHz, by a chain of dependent multiplications; the target of 20 ns refers to 2.5
GHz.

An event, by least squares over the {runs} runs of the study with 4 storeys and blocks, each run by itself, so that it
forms its own regimes: time = a samples + b events + c regimes. The runs are repeated {rounds} times; medians over the
repetitions are shown and, for the event, quartiles.

{events}
{counts}"""

COUNTS = """\
Instructions by callgrind, on the path for AVX2 (valgrind knows no AVX-512); "per event" is everything that is neither
a plain step nor a regime, divided by the events. Recorded changes of the code are compared below.

"""


def _counts() -> str:
    try:
        counted = instructions.measured()
    except instructions.Missing as missing:
        return f"Instructions: {missing}.\n"
    found = {(scene, quantity): value for _, scene, quantity, value, _ in counted.iter_rows()}
    quantities = (instructions.STEP, instructions.EVENT, instructions.REGIME)
    rows = [[scene, *(f"{found[scene, name]:,.0f}" for name in quantities)] for scene in instructions.STEPPED]
    return COUNTS + table(("scene", *quantities), rows)


def section(*, quick: bool) -> Section:
    """Measure both; instructions too where valgrind is installed, unless quick."""
    name, motion = strong_motions()[0]
    found = timings("steps", four_storeys(motion, name), 0.3 if quick else 5.0, native=True)
    over_chain = repeated(found["step"] / found["chain"])
    at_clock = repeated(1e9 * found["step"] * found["frequency"] / CLOCK)
    runs = [
        (scene, motion)
        for scene, motion in distinct_runs(suite())
        if scene.blocks and scene.building is not None and scene.building.storeys == 4
    ]
    rounds = [run_times(runs[:: 3 if quick else 1], 1 if quick else 3) for _ in range(1 if quick else ROUNDS)]
    parts = np.array([split(rows, ("samples", "events", "regimes")) for rows in rounds])
    sample, _, regime = np.median(parts, axis=0)
    event = repeated(1e6 * parts[:, 1])
    targets = [
        Target("plain step / bare chain of the state, 4 storeys", over_chain.median, 2.0, scatter=over_chain.quartiles),
        Target("plain step, 4 storeys, at 2.5 GHz", at_clock.median, 20.0, "ns", scatter=at_clock.quartiles),
        Target("event, 4 storeys", event.median, 0.5, "us", scatter=event.quartiles),
    ]
    steps = table(
        ("", "ns", "ns at 2.5 GHz", "plain step over it"),
        [
            [
                what,
                f"{1e9 * np.median(found[key]):.1f}",
                f"{1e9 * np.median(found[key] * found['frequency']) / CLOCK:.1f}",
                "" if key == "step" else f"{np.median(found['step'] / found[key]):.2f}",
            ]
            for what, key in (
                ("plain step", "step"),
                ("bare chain, 8 x 8", "chain"),
                ("bare chain with rates, 16 x 8", "chain_with_rates"),
            )
        ],
    )
    events = table(
        ("a: sample (ns)", "b: event (us)", "quartiles of b", "c: regime (us)", "median run (us)", "median events"),
        [
            [
                f"{1e9 * sample:.1f}",
                f"{event.median:.2f}",
                f"{event.quartiles[0]:.2f} to {event.quartiles[1]:.2f}",
                f"{1e6 * regime:.2f}",
                f"{1e6 * statistics.median(row.time for rows in rounds for row in rows):.0f}",
                f"{statistics.median(row.events for row in rounds[0]):.0f}",
            ]
        ],
    )
    text = TEXT.format(
        steps=steps,
        frequency=np.median(found["frequency"]) / 1e9,
        runs=len(rounds[0]),
        rounds=len(rounds),
        events=events,
        counts="" if quick else _counts(),
    )
    return Section("The plain step and the event", targets, text)
