"""The summary of a small study beside one of an implementation of its own, which shares nothing with the package.

Everything is written here from the definitions: spectra by steps of the exact recurrence of an oscillator, scaling in
two steps, response spectrum analysis, springs as parallel elastic-plastic elements, a leapfrog with friction as an
impulse, and the statistics. The package gives the samples of three motions and the numbers that are compared.
"""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from scipy.linalg import expm

import seismass as sm
from seismass.studies.study import StudyParameters, run_study

G = 9.80665
STOREYS, PERIOD, ALPHA, MU = 2, 0.38, 1.0, 0.4
R = (1.0, 3.0)
SHARES = {"storage": 0.25, "commercial": 0.0}
OMEGA, R2, DAMPING = 2.0, 0.05, 0.05
SDS, SD1 = 1.07, 0.61
MODELS = ("real", "code", "attached")


def samples() -> tuple[np.ndarray, float]:
    """Eight seconds of strong motion of three built-in motions, each from rest, and their step."""
    records = [sm.builtin_record(name) for name in ("synthetic-1", "synthetic-4", "synthetic-6")]
    assert len({record.dt for record in records}) == 1
    dt = records[0].dt
    start, count = round(4.0 / dt), round(8.0 / dt)
    # A last sample of zero: how a ground comes to rest after its last sample is a convention.
    return np.array([[*record.acceleration[start : start + count], 0.0] for record in records]), dt


def spectrum(motions: np.ndarray, dt: float, periods: np.ndarray, parts: int = 40) -> np.ndarray:
    """Pseudo-acceleration, shape (motions, periods): the largest of `parts` instants per sample, which misses a peak by
    (omega dt / parts)^2 / 8 of it at most: 4e-6 at 0.2 s and 1e-5 of the second mode.
    """
    found = np.zeros((len(motions), len(periods)))
    h = dt / parts
    for column, period in enumerate(periods):
        omega = 2.0 * np.pi / period
        # State and input of a step: displacement, velocity, acceleration of the ground and its rate.
        system = np.zeros((4, 4))
        system[0, 1], system[2, 3] = 1.0, 1.0
        system[1] = [-(omega**2), -2.0 * DAMPING * omega, -1.0, 0.0]
        step = expm(h * system)
        powers = [np.linalg.matrix_power(step, part) for part in range(1, parts + 1)]
        rows = np.array([power[0] for power in powers]).T  # displacement at each part of a sample
        whole = powers[-1][:2].T
        # The ground rests after the last sample, for one period more.
        rates = np.diff(motions, axis=1) / dt
        rest = np.zeros((len(motions), int(np.ceil(period / dt)) + 1))
        inputs = np.stack([np.hstack([motions[:, :-1], rest]), np.hstack([rates, rest])])
        state, largest = np.zeros((len(motions), 2)), np.zeros(len(motions))
        for now in inputs.transpose(2, 1, 0):
            full = np.hstack([state, now])
            largest = np.maximum(largest, np.abs(full @ rows).max(axis=1))
            state = full @ whole
        found[:, column] = omega**2 * largest
    return found


def target(periods: np.ndarray) -> np.ndarray:
    """Shape of ASCE 7 (m/s2)."""
    corner = SD1 / SDS
    shape = np.where(periods < 0.2 * corner, SDS * (0.4 + 0.6 * periods / (0.2 * corner)), SDS)
    return G * np.where(periods > corner, SD1 / periods, shape)


def scaling(motions: np.ndarray, dt: float, periods: np.ndarray) -> np.ndarray:
    """Each motion to the target by least squares in the logarithm, then all until the mean is nowhere below it."""
    spectra, wanted = spectrum(motions, dt, periods), target(periods)
    own = np.exp(np.log(wanted / spectra).mean(axis=1))
    return own * (wanted / (own[:, None] * spectra).mean(axis=0)).max()


def chain(values: np.ndarray) -> np.ndarray:
    """Stiffness matrix of storeys in series."""
    matrix = np.diag(values + np.append(values[1:], 0.0))
    return matrix - np.diag(values[1:], 1) - np.diag(values[1:], -1)


def modes(mass: np.ndarray, stiffness: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Circular frequencies and mass-normalised modes."""
    root = np.sqrt(mass)
    values, vectors = np.linalg.eigh(chain(stiffness) / np.outer(root, root))
    return np.sqrt(values), vectors / root[:, None]


class Golden:
    """All buildings, models and motions at once: arrays of shape (runs, storeys)."""

    def __init__(self) -> None:
        self.motions, self.dt = samples()
        mass = np.ones(STOREYS)
        goods = np.array([ALPHA] * (STOREYS - 1) + [0.0])
        # First frequency of a uniform shear building: 2 sqrt(k/m) sin(pi / (2 (2 N + 1))).
        k = (np.pi / PERIOD / np.sin(0.5 * np.pi / (2 * STOREYS + 1))) ** 2
        stiffness = np.full(STOREYS, k)
        omega, shapes = modes(mass, stiffness)
        self.damping = (mass[:, None] * shapes) @ np.diag(2.0 * DAMPING * omega) @ (mass[:, None] * shapes).T
        self.k = k
        self.goods_mass, self.mass = goods, mass

    def design(self, factors: np.ndarray) -> dict[str, np.ndarray]:
        """V_e (N) of each occupancy: square root of the sum of squares of the modal storey shears."""
        found = {}
        for name, share in SHARES.items():
            mass = self.mass + share * self.goods_mass
            omega, shapes = modes(mass, np.full(STOREYS, self.k))
            ordinates = factors @ spectrum(self.motions, self.dt, 2.0 * np.pi / omega) / len(factors)
            forces = mass[:, None] * shapes * (mass @ shapes) * ordinates
            shears = np.cumsum(forces[::-1], axis=0)[::-1]
            found[name] = np.sqrt((shears**2).sum(axis=1))
        return found

    def peaks(self, factors: np.ndarray, design: dict[str, np.ndarray], substeps: int) -> dict[str, np.ndarray]:
        """Peak drifts and slips (m), shape (occupancies, R, models, motions, storeys), by a leapfrog."""
        runs = list(product(SHARES, R, MODELS, range(len(self.motions))))
        attached = np.array([{"real": 0.0, "code": SHARES[name], "attached": 1.0}[model] for name, _, model, _ in runs])
        mass = self.mass + attached[:, None] * self.goods_mass
        block = np.array([model == "real" for _, _, model, _ in runs])[:, None] * self.goods_mass
        strength = np.array(
            [np.full(STOREYS, np.inf) if factor == 1.0 else design[name] / factor for name, factor, *_ in runs]
        )
        # Two elastic-plastic elements side by side yield at the two breaks of the trilinear backbone.
        stiff = self.k * np.array([1.0 - R2, R2])
        with np.errstate(invalid="ignore"):
            breaks = [strength / self.k, strength / self.k + (OMEGA - 1.0) * strength / (R2 * self.k)]
        limits = [own * drift for own, drift in zip(stiff, breaks, strict=True)]
        ground = np.array([factors[motion] * self.motions[motion] for *_, motion in runs])
        h = self.dt / substeps
        shape = (len(runs), STOREYS)
        velocity, own_velocity, slip = np.zeros(shape), np.zeros(shape), np.zeros(shape)
        drift, force = np.zeros(shape), [np.zeros(shape), np.zeros(shape)]
        largest_drift, largest_slip = np.zeros(shape), np.zeros(shape)
        loaded = block > 0.0
        common = np.where(loaded, mass * block / (mass + block), 0.0)
        grip = MU * G * block * h
        inverse = np.where(loaded, 1.0 / np.where(loaded, block, 1.0), 0.0)
        for sample in range(ground.shape[1] - 1):
            for part in range(substeps):
                share = part / substeps
                pushed = ((1.0 - share) * ground[:, sample] + share * ground[:, sample + 1])[:, None]
                spring = force[0] + force[1]
                net = -spring - velocity @ self.damping
                net[:, :-1] += spring[:, 1:]
                free = velocity + h * (net / mass - pushed)
                alone = own_velocity - h * pushed * loaded
                impulse = np.clip(common * (alone - free), -grip, grip)
                velocity = free + impulse / mass
                own_velocity = np.where(loaded, alone - impulse * inverse, 0.0)
                step = h * velocity
                step[:, 1:] -= h * velocity[:, :-1]
                drift = drift + step
                force = [
                    np.clip(own + each * step, -limit, limit)
                    for own, each, limit in zip(force, stiff, limits, strict=True)
                ]
                slip = slip + np.where(loaded, h * (own_velocity - velocity), 0.0)
                np.maximum(largest_drift, np.abs(drift), out=largest_drift)
                np.maximum(largest_slip, np.abs(slip), out=largest_slip)
        full = (len(SHARES), len(R), len(MODELS), len(self.motions), STOREYS)
        return {"drift": largest_drift.reshape(full), "slip": largest_slip.reshape(full)}


def summary(peaks: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Columns of the summary, shape (occupancies, R, storeys)."""
    real, code, attached = (peaks["drift"][:, :, place] for place in range(3))
    mean = {name: values.mean(axis=2) for name, values in zip(MODELS, (real, code, attached), strict=True)}
    each = np.sort(100.0 * (real / code - 1.0), axis=2)
    missed = 100.0 * (mean["real"] / mean["code"] - 1.0)
    others = [[place for place in range(real.shape[2]) if place != left] for left in range(real.shape[2])]
    without = np.stack(
        [100.0 * (real[:, :, kept].mean(axis=2) / code[:, :, kept].mean(axis=2) - 1.0) for kept in others], axis=2
    )
    changes = np.abs(without - missed[:, :, None])
    found = {f"mean_peak_drift_{name}": values for name, values in mean.items()}
    found |= {
        f"geometric_mean_peak_drift_{name}": np.cbrt(values.prod(axis=2))
        for name, values in zip(MODELS, (real, code, attached), strict=True)
    }
    found |= {
        "underestimation_percent": missed,
        "ratio_mass": mean["attached"] / mean["code"],
        "ratio_sliding": mean["real"] / mean["attached"],
        "median_underestimation_percent": each[:, :, 1],
        # Of three values the 16 % one is 0.32 of the way from the first to the second.
        "p16_underestimation_percent": each[:, :, 0] + 0.32 * (each[:, :, 1] - each[:, :, 0]),
        "p84_underestimation_percent": each[:, :, 1] + 0.68 * (each[:, :, 2] - each[:, :, 1]),
        "leave_one_out_percent": np.take_along_axis(without, changes.argmax(axis=2)[:, :, None], axis=2)[:, :, 0],
        "mean_peak_slip": peaks["slip"][:, :, 0].mean(axis=2),
    }
    return found


@pytest.fixture(scope="module")
def study() -> object:
    motions, dt = samples()
    suite = sm.Suite("three", tuple(sm.Record(motion, dt, f"motion {i}") for i, motion in enumerate(motions, start=1)))
    chosen = StudyParameters(buildings=((STOREYS, PERIOD),), response_modification=R, mass_ratios=(ALPHA,), mu=(MU,))
    return run_study(suite, sm.TargetSpectrum.asce7(SDS, SD1), chosen)


def test_summary_is_that_of_an_implementation_of_its_own(study: object) -> None:
    golden = Golden()
    shortest, longest, count = study.metadata["scaling"]["periods"]
    assert (shortest, longest) == pytest.approx((0.2, 1.5), rel=1e-12)
    factors = scaling(golden.motions, golden.dt, np.geomspace(shortest, longest, count))
    # Peaks of the spectra are missed by 1e-5 of themselves at most.
    assert study.scaling.factors == pytest.approx(factors, rel=2e-5)
    design = golden.design(factors)
    rows = study.designs.sort("occupancy", "R", "storey", descending=[True, False, False])
    strength = rows.filter(R=R[1])["yield_shear_over_weight"].to_numpy().reshape(2, STOREYS)
    expected = np.array([design[name] for name in SHARES]) / R[1] / (G * STOREYS)
    assert strength == pytest.approx(expected, rel=4e-5)

    coarse, fine = (summary(golden.peaks(factors, design, substeps)) for substeps in (20, 40))
    table = study.summary.sort("occupancy", "R", "storey", descending=[True, False, False])
    for name, values in fine.items():
        found = np.nan_to_num(table[name].to_numpy()).reshape(values.shape)  # no goods on the roof: null there, 0 here
        # The leapfrog is of first order in its step: its error at the finer step is about the difference between both.
        size = 1.0 if name.startswith("ratio") else 100.0 if name.endswith("percent") else np.abs(values).max()
        error = np.abs(values - coarse[name]).max() / size
        assert error < 5e-3, name
        # Scaling factors add what their spectra miss.
        assert np.abs(found - values).max() / size < 1.5 * error + 2e-5, name
    # The case has what it is to show: goods slide, springs yield, and the code's model misses drift.
    assert fine["mean_peak_slip"][:, 0, 0].min() > 0.01
    assert fine["underestimation_percent"][1, 1, 0] > 20.0
