"""Elastic response spectra beside eqsig and pyrotd, and against the same recurrence in many digits."""

from __future__ import annotations

import importlib
import importlib.metadata
from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise
from typing import Any, Final

import numpy as np

import seismass as sm
from scenes import FloatArray, suite
from targets.base import Section, Target, median_time, repeated, table, turns

PERIODS: Final = 200
DAMPING: Final = (0.01, 0.02, 0.05, 0.1, 0.2)
RECORDS: Final = 14
SAMPLES: Final = 8000
DIGITS: Final = 40
CHECKED: Final = (0.05, 0.2, 1.0, 5.0)
"""Periods at which many digits are used (s), with the first and the last damping ratio."""
AGREEMENT: Final = 1e-12

TEXT: Final = """\
{periods} periods from 0.05 to 5 s, {damping} damping ratios, {records} records of {samples} samples: {pairs:.0f}
million steps of an oscillator. seismass returns peaks in continuous time, with the free vibration after the record; the
other programs take the largest sample. eqsig runs the same recurrence (Nigam and Jennings) in numpy over all periods at
once; pyrotd multiplies by transfer functions in the frequency domain, one oscillator at a time. One thread each; each
alternates with seismass {least} times. Differences are relative to seismass, the largest one and the median.

{table}
Largest relative difference from the same recurrence in {digits} digits, peaks in continuous time searched in every
step, over {checked} oscillators under one record: {worst}.
"""


class _Absent(Exception):
    """A package is not installed."""


def _module(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as missing:
        raise _Absent(f"absent: {missing}") from missing


def _records(count: int, samples: int) -> list[sm.Motion]:
    """So many motions of so many samples: those of the suite, forwards and backwards, cut or repeated."""
    motions = [record.motion for record in suite()]
    both = [m.acceleration for m in motions] + [m.acceleration[::-1] for m in motions]
    steps = [m.dt for m in motions] * 2
    fitted = [np.resize(a, samples) for a in both]
    return [sm.Motion(a, dt) for a, dt in zip(fitted, steps, strict=True)][:count]


def _eqsig(motions: Sequence[sm.Motion], periods: FloatArray) -> FloatArray:
    spectra = _module("eqsig.sdof").pseudo_response_spectra
    return np.array(
        [[spectra(m.acceleration, m.dt, periods, ratio)[2] for ratio in DAMPING] for m in motions], dtype=np.float64
    )


def _pyrotd(motions: Sequence[sm.Motion], periods: FloatArray) -> FloatArray:
    pyrotd = _module("pyrotd")
    pyrotd.processes = 1
    frequencies = 1.0 / periods
    return np.array(
        [
            [pyrotd.calc_spec_accels(m.dt, m.acceleration, frequencies, ratio)["spec_accel"] for ratio in DAMPING]
            for m in motions
        ],
        dtype=np.float64,
    )


PEERS: Final[tuple[tuple[str, Callable[[Sequence[sm.Motion], FloatArray], FloatArray], float], ...]] = (
    ("eqsig", _eqsig, 100.0),
    ("pyrotd", _pyrotd, 30.0),
)
"""Name, what it runs, and the ratio of times aimed at."""


def in_many_digits(motion: sm.Motion, period: float, ratio: float) -> float:
    """Return the peak displacement (m) by the exact step in `DIGITS` digits; steps must be below half a period."""
    mpmath = _module("mpmath")
    with mpmath.workdps(DIGITS):
        mpf, sqrt, exp = mpmath.mpf, mpmath.sqrt, mpmath.exp
        dt, zeta = mpf(motion.dt), mpf(ratio)
        w = 2 * mpmath.pi / mpf(period)
        wd = w * sqrt(1 - zeta * zeta)

        def free(t: Any) -> tuple[Any, Any, Any, Any]:
            """Displacement and velocity at t of free vibrations from a unit displacement, and from a unit velocity."""
            decay, sine, cosine = exp(-zeta * w * t), mpmath.sin(wd * t), mpmath.cos(wd * t)
            g = decay * sine / wd
            f = decay * cosine + zeta * w * g
            return f, -w * w * g, g, decay * cosine - zeta * w * g

        def at(t: Any, state: tuple[Any, Any], p: tuple[Any, Any], of: tuple[Any, Any, Any, Any]) -> tuple[Any, Any]:
            """u and u' after t, about the particular solution p[0] + p[1] t."""
            u, v = state[0] - p[0], state[1] - p[1]
            return of[0] * u + of[2] * v + p[0] + p[1] * t, of[1] * u + of[3] * v + p[1]

        def peak_within(state: tuple[Any, Any], p: tuple[Any, Any], end: Any) -> Any:
            """|u| at the zero of u' that a change of its sign shows."""
            low, high, positive = mpf(0), end, state[1] > 0
            # Bisection to double precision of the time: the peak is flat there.
            for _ in range(60):
                middle = (low + high) / 2
                if (at(middle, state, p, free(middle))[1] > 0) == positive:
                    low = middle
                else:
                    high = middle
            return abs(at(low, state, p, free(low))[0])

        samples = [mpf(float(a)) for a in motion.acceleration] + [mpf(0)]
        whole = free(dt)
        state, peak = (mpf(0), mpf(0)), mpf(0)
        turns = []
        for a0, a1 in pairwise(samples):
            slope = (a1 - a0) / dt
            p1 = -slope / (w * w)
            p = (-a0 / (w * w) - 2 * zeta * p1 / w, p1)
            after = at(dt, state, p, whole)
            if state[1] * after[1] < 0:
                turns.append((max(abs(state[0]), abs(after[0])), state, p, dt))
            peak = max(peak, abs(after[0]))
            state = after
        turns.append((abs(state[0]), state, (mpf(0), mpf(0)), mpmath.pi / wd))
        # Between samples a turn exceeds the larger end by less than the share of a quarter swing that a step is.
        share = min(mpf(1), (w * dt) ** 2)
        likely = [turn for turn in turns[:-1] if turn[0] * (1 + share) + share * peak >= peak]
        return float(max([peak, *(peak_within(*turn[1:]) for turn in [*likely, turns[-1]])]))


def _worst(motion: sm.Motion, periods: Sequence[float]) -> float:
    ratios = (DAMPING[0], DAMPING[-1])
    ours = sm.response_spectrum(motion, periods, ratios, "displacement")[0]
    exact = np.array([[in_many_digits(motion, period, ratio) for period in periods] for ratio in ratios])
    return float((np.abs(ours - exact) / exact).max())


def section(*, quick: bool) -> Section:
    """Measure ours and the peers', and compare."""
    motions = _records(2 if quick else RECORDS, 1000 if quick else SAMPLES)
    periods = np.geomspace(0.05, 5.0, 20 if quick else PERIODS)
    least = 1 if quick else 3
    on = [partial(sm.response_spectrum, motions, periods, DAMPING, threads=threads) for threads in (1, 2)]
    one, two = (median_time(work, 0.0, least=1 if quick else 5) for work in on)
    ours = sm.response_spectrum(motions, periods, DAMPING)
    pairs = len(motions) * motions[0].samples * len(periods) * len(DAMPING)
    rows = [["seismass", f"{one:.3f}", f"{1e9 * one / pairs:.2f}", "1", "", ""]]
    rows.append(["seismass, 2 threads", f"{two:.3f}", f"{1e9 * two / pairs:.2f}", f"{two / one:.2f}", "", ""])
    targets = []
    for name, work, bound in PEERS:
        try:
            version = f"{name} {importlib.metadata.version(name)}"
            theirs = work(motions, periods)
            own, spent = np.array(turns([on[0], partial(work, motions, periods)], 0.0, least))
        except (_Absent, importlib.metadata.PackageNotFoundError) as absent:
            rows.append([name, "absent", "", "", "", ""])
            targets.append(Target(f"{name} / ours, spectra", None, bound, at_most=False, note=str(absent)))
            continue
        apart = np.abs(theirs - ours) / ours
        ratio, middle = repeated(spent / own), float(np.median(spent))
        row = [version, f"{middle:.2f}", f"{1e9 * middle / pairs:.1f}", f"{ratio.median:.0f}"]
        rows.append([*row, f"{apart.max():.0e}", f"{np.median(apart):.0e}"])
        what = f"{name} / ours, spectra"
        targets.append(Target(what, ratio.median, bound, at_most=False, scatter=ratio.quartiles))
    checked = CHECKED[1:3] if quick else CHECKED
    try:
        worst = _worst(_records(1, 300 if quick else SAMPLES)[0], checked)
        targets.append(Target(f"spectra against {DIGITS} digits", worst, AGREEMENT))
        told = f"{worst:.1e}"
    except _Absent as absent:
        targets.append(Target(f"spectra against {DIGITS} digits", None, AGREEMENT, note=str(absent)))
        told = f"not measured ({absent})"
    header = ("", "s", "ns per step", "time / ours", "largest difference", "median difference")
    text = TEXT.format(
        periods=len(periods),
        damping=len(DAMPING),
        records=len(motions),
        samples=motions[0].samples,
        pairs=pairs / 1e6,
        least=least,
        table=table(header, rows),
        digits=DIGITS,
        checked=2 * len(checked),
        worst=told,
    )
    return Section("Response spectra", targets, text)
