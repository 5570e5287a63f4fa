"""Scaling to the target at one period, Sa(T1)."""

from __future__ import annotations

from collections.abc import Iterable

from seismass.scaling.result import ScalingResult
from seismass.scaling.suite import suite_spectra
from seismass.spectra import GroundMotion, TargetSpectrum, as_motions, response_spectrum


def scale_sa_t1(
    records: Iterable[GroundMotion],
    target: TargetSpectrum,
    period: float = 1.0,
    *,
    damping: float = 0.05,
    period_range: tuple[float, float] = (0.2, 1.5),
    count: int = 100,
    threads: int | None = None,
) -> ScalingResult:
    """Return for each motion the factor by which its spectrum is the target at T1.

    Parameters
    ----------
    records, target, damping, count, threads
        As for `scale_asce7_10`; one motion is enough.
    period : float
        T1 (s).
    period_range : tuple of float
        Range of the comparison as multiples of T1, which the factors do not depend on.

    Raises
    ------
    InvalidOption, InvalidMotion
        As for `scale_asce7_10`.

    Notes
    -----
    SF_i = A_t(T1)/A_i(T1), the elastic ratio to which `scale_modal_pushover` comes down for R = 1.
    """
    motions = as_motions(records, "scaling")
    suite = suite_spectra(
        motions, target, period, damping=damping, period_range=period_range, count=count, threads=threads
    )
    ordinates = response_spectrum(motions, [suite.period], suite.damping, threads=threads)[:, 0]
    note = (
        f"the motions meet the target at {suite.period:g} s alone: scatter at other periods, those of higher modes and "
        "of a yielding building, is left as it is"
    )
    return suite.result("Sa(T1)", target(suite.period) / ordinates, notes=(note,))
