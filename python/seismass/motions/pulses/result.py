"""Results of pulse identification: candidates of one record or pair, and the class by orientation."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Literal

import numpy as np
import polars as pl

from seismass.base.values import FieldValue, FloatArray
from seismass.base.views import Card, view

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BAKER: Final = "Baker (2007)"
SHAHI_BAKER: Final = "Shahi and Baker (2014)"
PERIOD_OF_SCALE: Final = 1.4
"""Period of the wavelet over scale times step: one over its centre frequency, 5/7."""
Kind = Literal["pulse", "ambiguous", "no pulse"]


@dataclass(frozen=True, eq=False, repr=False)
class Candidate(FieldValue, Card):
    """One pulse taken out of a velocity, and how it is judged.

    Attributes
    ----------
    number : int
        1 for the largest.
    kind : {"pulse", "ambiguous", "no pulse"}
        What the method calls it.
    reasons : tuple of str
        Why it is not a pulse, one sentence for each criterion that is not met; empty for a pulse.
    scale : int
        Scale of its wavelets, in samples.
    dt : float
        Time step (s).
    angle : float
        Direction it was taken from, in degrees from the first component to the second, above -90 to 90; 0 for one
        component.
    azimuth : float, optional
        That direction in degrees from north, 0 to 180, where the records state theirs.
    indicator : float
        Pulse indicator of the method: 0 to 1 with limits 0.15 and 0.85 (2007), positive for a pulse (2014).
    energy_ratio : float
        r_E: the residual's energy over that of the velocity.
    early : bool
        Whether it arrives early, by the method's test.
    energy_before : float
        Share of the velocity's cumulative squared velocity that has come at `arrival`.
    arrival : float
        Time (s) at which the pulse has reached the share that the test of the method looks at, 10 % (2007) or 5 %.
    centres, coefficients : ndarray, shape (10,)
        Times (s) of the centres of its wavelets and their coefficients (m/s times the root of a sample).
    velocity, pulse, residual : ndarray, shape (samples,)
        Velocity in its direction, extracted pulse and what is left (m/s).
    """

    number: int
    kind: Kind
    reasons: tuple[str, ...]
    scale: int
    dt: float
    angle: float
    azimuth: float | None
    indicator: float
    energy_ratio: float
    early: bool
    energy_before: float
    arrival: float
    centres: FloatArray
    coefficients: FloatArray
    velocity: FloatArray
    pulse: FloatArray
    residual: FloatArray

    @property
    def is_pulse(self) -> bool:
        """Whether the method calls it a pulse."""
        return self.kind == "pulse"

    @property
    def time(self) -> float:
        """Time of the centre of its first wavelet (s)."""
        return float(self.centres[0])

    @property
    def pgv(self) -> float:
        """Peak of the velocity in its direction (m/s)."""
        return float(np.max(np.abs(self.velocity)))

    @property
    def residual_pgv(self) -> float:
        """Peak of the residual velocity (m/s)."""
        return float(np.max(np.abs(self.residual)))

    @property
    def pgv_ratio(self) -> float:
        """r_PGV: the residual's peak over that of the velocity."""
        return self.residual_pgv / self.pgv

    @property
    def period(self) -> float:
        """Pulse period (s): 1.4 scale dt, at which the wavelet's Fourier amplitude is largest."""
        return PERIOD_OF_SCALE * self.scale * self.dt


@dataclass(frozen=True, eq=False)
class PulseResult(FieldValue, Card):
    """Whether a record or a pair is pulse-like, with every candidate that was looked at.

    Attributes
    ----------
    method : str
        "Baker (2007)" or "Shahi and Baker (2014)".
    names : tuple of str
        Names of the one or two records.
    candidates : tuple of Candidate
        What was taken out, the largest wavelet first: one by Baker (2007), five by Shahi and Baker (2014).
    remarks : tuple of str
        What was done to the records, and what the result cannot say.
    """

    method: str
    names: tuple[str, ...]
    candidates: tuple[Candidate, ...]
    remarks: tuple[str, ...]

    @property
    def primary(self) -> Candidate:
        """The first candidate that is a pulse; the first of all where none is."""
        return next((one for one in self.candidates if one.is_pulse), self.candidates[0])

    @property
    def is_pulse(self) -> bool:
        """Whether any candidate is a pulse."""
        return self.primary.is_pulse

    @property
    def ambiguous(self) -> bool:
        """Whether it is neither a pulse nor clearly none: Baker's indicator between 0.15 and 0.85."""
        return self.primary.kind == "ambiguous"

    @property
    def period(self) -> float | None:
        """Pulse period T_p (s) of a pulse-like record; None for any other."""
        return self.primary.period if self.is_pulse else None

    @property
    def indicator(self) -> float:
        """Pulse indicator of the chosen candidate."""
        return self.primary.indicator

    @property
    def pgv(self) -> float:
        """Peak velocity (m/s) in the direction of the chosen candidate."""
        return self.primary.pgv

    @property
    def pgv_ratio(self) -> float:
        """r_PGV of the chosen candidate."""
        return self.primary.pgv_ratio

    @property
    def energy_ratio(self) -> float:
        """r_E of the chosen candidate."""
        return self.primary.energy_ratio

    @property
    def early(self) -> bool:
        """Whether the chosen candidate arrives early."""
        return self.primary.early

    @property
    def angle(self) -> float:
        """Direction of the chosen candidate, in degrees from the first component to the second."""
        return self.primary.angle

    @property
    def pulse(self) -> FloatArray:
        """Velocity of the extracted pulse (m/s), shape (samples,)."""
        return self.primary.pulse

    @property
    def residual(self) -> FloatArray:
        """Velocity without the extracted pulse (m/s), shape (samples,)."""
        return self.primary.residual

    def table(self) -> pl.DataFrame:
        """Return one row per candidate: its class, direction, period, indicator and what it follows from."""
        return pl.DataFrame(
            {
                "candidate": np.array([one.number for one in self.candidates], dtype=np.uint32),
                "kind": [one.kind for one in self.candidates],
                "time": [one.time for one in self.candidates],
                "angle": [one.angle for one in self.candidates],
                "azimuth": pl.Series([one.azimuth for one in self.candidates], dtype=pl.Float64),
                "period": [one.period for one in self.candidates],
                "indicator": [one.indicator for one in self.candidates],
                "pgv": [one.pgv for one in self.candidates],
                "pgv_ratio": [one.pgv_ratio for one in self.candidates],
                "energy_ratio": [one.energy_ratio for one in self.candidates],
                "early": [one.early for one in self.candidates],
                "energy_before": [one.energy_before for one in self.candidates],
                "reasons": ["; ".join(one.reasons) for one in self.candidates],
            }
        )

    def wavelet_table(self) -> pl.DataFrame:
        """Return one row per wavelet of each candidate: its period, the time of its centre and its coefficient."""
        return pl.concat(
            pl.DataFrame(
                {
                    "candidate": np.full(len(one.centres), one.number, dtype=np.uint32),
                    "wavelet": np.arange(1, len(one.centres) + 1, dtype=np.uint32),
                    "period": np.full(len(one.centres), one.period),
                    "time": one.centres,
                    "coefficient": one.coefficients,
                }
            )
            for one in self.candidates
        )

    def history_table(self) -> pl.DataFrame:
        """Return one row per sample: time (s), and velocity, extracted pulse and residual (m/s) of the chosen one."""
        one = self.primary
        time = np.arange(len(one.velocity)) * one.dt
        return pl.DataFrame({"time": time, "velocity": one.velocity, "pulse": one.pulse, "residual": one.residual})

    @property
    def text(self) -> str:
        """The result in a few lines, for a terminal."""
        one = self.primary
        head = f"{' and '.join(name or '(unnamed)' for name in self.names)}, {self.method}: "
        if one.is_pulse:
            head += f"pulse-like, T_p = {one.period:.2f} s"
        else:
            head += "ambiguous" if self.ambiguous else "no pulse"
        where = ""
        if len(self.names) == 2:
            north = "" if one.azimuth is None else f" ({round(one.azimuth) % 360} degrees from north)"
            where = f", {round(one.angle)} degrees from the first component to the second{north}"
        lines = [
            head,
            f"  candidate {one.number} of {len(self.candidates)}, at {one.time:.2f} s{where}",
            f"  indicator {one.indicator:.3f}; PGV {100.0 * one.pgv:.1f} cm/s; the residual has {one.pgv_ratio:.2f} of "
            f"the peak and {one.energy_ratio:.2f} of the energy",
            f"  arrives {'early' if one.early else 'late'}: {100.0 * one.energy_before:.0f} % of the squared velocity "
            f"has come at {one.arrival:.2f} s, where the pulse begins",
            *(f"  {one.kind}: {reason}" for reason in one.reasons),
            *(f"  remark: {remark}" for remark in self.remarks),
        ]
        return "\n".join(lines)

    def __repr__(self) -> str:
        words = f"T_p {self.period:.2f} s" if self.period is not None else self.primary.kind
        return f"<PulseResult {' and '.join(self.names)}: {words}, {self.method}>"

    @view
    def plot(self) -> Figure:
        """Return the figure: velocity, extracted pulse, residual, and the energy with the test of arrival."""
        raise NotImplementedError


@dataclass(frozen=True, eq=False)
class OrientationScan(FieldValue, Card):
    """The class of one pair by orientation, each judged as one component by Baker (2007).

    Attributes
    ----------
    names : tuple of str
        Names of the two records.
    results : tuple of PulseResult
        One per orientation.
    angles : ndarray, shape (orientations,)
        Degrees from the first component to the second, from 0 to below 180.
    remarks : tuple of str
        What was done to the records.
    """

    names: tuple[str, ...]
    results: tuple[PulseResult, ...]
    angles: FloatArray
    remarks: tuple[str, ...]

    @property
    def pulses(self) -> int:
        """Number of orientations in which the record is pulse-like."""
        return sum(one.is_pulse for one in self.results)

    @property
    def ambiguous(self) -> int:
        """Number of orientations in which it is ambiguous."""
        return sum(one.ambiguous for one in self.results)

    @property
    def strongest(self) -> PulseResult:
        """The result with the largest indicator among the pulses; among all where there is none."""
        among = [one for one in self.results if one.is_pulse] or list(self.results)
        return max(among, key=lambda one: (one.indicator, one.pgv))

    def table(self) -> pl.DataFrame:
        """Return one row per orientation: angle, azimuth where known, class, period, indicator and the reasons."""
        rows = [one.primary for one in self.results]
        return pl.DataFrame(
            {
                "angle": self.angles,
                "azimuth": pl.Series([one.azimuth for one in rows], dtype=pl.Float64),
                "kind": [one.kind for one in rows],
                "period": [one.period for one in rows],
                "indicator": [one.indicator for one in rows],
                "pgv": [one.pgv for one in rows],
                "pgv_ratio": [one.pgv_ratio for one in rows],
                "energy_ratio": [one.energy_ratio for one in rows],
                "early": [one.early for one in rows],
                "reasons": ["; ".join(one.reasons) for one in rows],
            }
        )

    @property
    def text(self) -> str:
        """The scan in a few lines, for a terminal."""
        head = (
            f"{' and '.join(name or '(unnamed)' for name in self.names)}, {BAKER}: pulse-like in {self.pulses} of "
            f"{len(self.results)} orientations, ambiguous in {self.ambiguous}"
        )
        lines = [head]
        if self.pulses:
            periods = [one.period for one in self.results if one.period is not None]
            lines.append(f"  T_p from {min(periods):.2f} to {max(periods):.2f} s, median {np.median(periods):.2f} s")
            lines.append(f"  orientations {self._ranges()} degrees from the first component to the second")
        else:
            one = self.strongest
            lines.append(
                f"  largest indicator {one.indicator:.3f}, at {one.angle:.0f} degrees: {'; '.join(one.primary.reasons)}"
            )
        lines += [f"  remark: {remark}" for remark in self.remarks]
        return "\n".join(lines)

    def _ranges(self) -> str:
        """The angles of pulses as ranges, "0 to 45, 150 to 175"."""
        marked = [one.is_pulse for one in self.results]
        runs: list[list[float]] = []
        for place, angle in enumerate(self.angles):
            if not marked[place]:
                continue
            if place and marked[place - 1]:
                runs[-1][1] = angle
            else:
                runs.append([angle, angle])
        return ", ".join(f"{low:g}" if math.isclose(low, high) else f"{low:g} to {high:g}" for low, high in runs)

    def __repr__(self) -> str:
        return f"<OrientationScan {' and '.join(self.names)}: pulse-like in {self.pulses} of {len(self.results)}>"

    @view
    def plot(self) -> Figure:
        """Return the figure: indicator and peak velocity over the orientation, with the limits of the method."""
        raise NotImplementedError
