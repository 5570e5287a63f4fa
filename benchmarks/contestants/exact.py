"""The exact kernel of seismass: with histories, as the others; and with peaks only, which is less work than theirs."""

from __future__ import annotations

import seismass as sm
from contestants.base import Outcome, Setting
from scenes import BenchmarkScene


def with_histories(bench: BenchmarkScene) -> Outcome:
    """Histories of drifts and slips at every sample, as the others give them."""
    run = sm.simulate(bench.scene, bench.motion, histories=True, displacements_only=True, events=False)
    return Outcome(run.drift, run.slip, run.peak_drift, run.peak_slip, run.residual_slip)


def peaks_only(bench: BenchmarkScene) -> Outcome:
    """Peaks and residuals alone, as the study asks for them."""
    run = sm.simulate(bench.scene, bench.motion, events=False, energy=False)
    return Outcome(None, None, run.peak_drift, run.peak_slip, run.residual_slip)


def settings() -> list[Setting]:
    """Return both."""
    return [
        Setting("seismass, exact", "histories", with_histories),
        Setting("seismass, peaks only", "peaks", peaks_only),
    ]
