"""The default suite beside the FEMA P-695 far-field recordings: peaks, spectra, and fourteen buildings."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

import seismass as sm
from pages.parts import Page, table
from seismass.base.values import signed
from seismass.motions.records import Suite, builtin_suite, read_suite
from seismass.motions.spectra import response_spectrum

Array = NDArray[np.float64]

SCALED_FOR: Final = (0.3, 0.57, 1.0, 1.6)
PERIODS: Final = (0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0)
CAP: Final = 0.10
"""Drift over storey height that a larger drift and a collapsed run count as."""
UNBOUNDED: Final = 100.0
"""An end of an interval of logarithms beyond this is of slips that are zero, or of collapses."""
LEAST_SLIP: Final = 0.001
"""Slip (m) below which two slips are not compared."""
RESAMPLES: Final = 2000
TARGETS: Final = {"b8_coldstore": sm.TargetSpectrum.eurocode8(1, "C", agr_g=0.30)}
"""Spectrum of the building whose file states none but in its name."""
FEW: Final = ("b1", "b7", "n2")
"""Beginnings of the files of the buildings that are returned where not all are asked for."""
HEADS_OF_BUILDINGS: Final = (
    "building | share: default, recorded | drift (%) | ln of the ratio | 84 % slip (mm) | ln of the ratio | collapses"
)
SLIPS: Final = {"friction as stated": "real", "the lower bound of friction": "real_mu_low"}


@dataclass(frozen=True)
class Compared:
    """A building under both suites: logarithms of default over recorded, and their bootstrap samples."""

    name: str
    cells: tuple[str, ...]
    drift: float
    drifts: Array
    slip: dict[str, float]
    slips: dict[str, Array]
    collapses: tuple[int, int]


def fill(page: Page) -> dict[str, Any]:
    """Put in the tables and the numbers of the sentences; return what tests ask.

    The fourteen buildings take minutes. Where they are not asked for, three of them are returned and nothing of them is
    put in.
    """
    suites = builtin_suite("forty"), Suite("far field", read_suite(page.records / "fema_p695_far_field").records)
    peaks, scaled = peaks_of(suites)
    spectra, sa = spectra_of(suites)
    page.tables(peaks, spectra)
    assert page.shared is not None
    folders = page.shared / "findings" / "answer", page.shared / "findings" / "buildings"
    files = [file for folder in folders for file in sorted(folder.glob("[bn][0-9]_*.toml")) if "_I" not in file.stem]
    whole = page.wants("fourteen")
    buildings = [compared(file, suites) for file in files if whole or file.stem[:2] in FEW]
    if whole:
        put_in(page, buildings, [len(files) * len(suite) for suite in suites])
    return {"peaks": scaled, "spectra": sa, "buildings": buildings}


def put_in(page: Page, buildings: list[Compared], runs: list[int]) -> None:
    """Put in the table of all buildings, and the numbers of its sentences."""
    page.tables(table(HEADS_OF_BUILDINGS, (one.cells for one in buildings)))
    drifts = np.array([one.drift for one in buildings])
    low, high = np.quantile(np.array([one.drifts for one in buildings]).mean(axis=0), (0.05, 0.95))
    page.words(
        "the mean of the logarithms is {} for drifts (90 % interval {} to {}), and {} of the {} intervals hold zero.",
        *(signed(value, "+.2f") for value in (drifts.mean(), low, high)),
        sum(is_within(one.drifts) for one in buildings),
        len(buildings),
    )
    for name in SLIPS:
        slips = np.array([one.slip[name] for one in buildings if name in one.slip])
        page.words(
            f"For 84 % slips at {name} it is {{}}, with {{}} of {{}} intervals.",
            signed(slips.mean(), "+.2f"),
            sum(is_within(one.slips[name]) for one in buildings if name in one.slip),
            len(slips),
        )
    collapses = np.sum([one.collapses for one in buildings], axis=0)
    page.words(
        "With goods that slide {} of {} runs collapse, and {} of {} under recordings.",
        collapses[0],
        runs[0],
        collapses[1],
        runs[1],
    )


def is_within(samples: Array) -> bool:
    """Whether the 90 % interval of a difference holds zero."""
    low, high = np.quantile(samples, (0.05, 0.95))
    return bool(low <= 0.0 <= high)


def three(values: Array) -> tuple[float, float, float]:
    """Median, standard deviation of the logarithm, and largest."""
    return float(np.median(values)), float(np.log(values).std(ddof=1)), float(values.max())


def row(name: str, each: list[tuple[float, float, float]]) -> list[str]:
    """A row of both suites: median, scatter and largest of each."""
    return [name, *(f"{value:.2f}" for one in each for value in one)]


HEADS: Final = "default: median | sd of ln | largest | recorded: median | sd of ln | largest"


def peaks_of(suites: tuple[Suite, Suite]) -> tuple[str, dict[str, list[tuple[float, float, float]]]]:
    """Return the table of peaks and durations, unscaled ratios first, and its numbers."""
    target = sm.TargetSpectrum.asce7()
    measures: dict[str, list[Array]] = {}
    for suite in suites:
        pga, pgv, pgd = (np.array([getattr(one, name) for one in suite]) for name in ("pga_g", "pgv", "pgd"))
        own = {"PGV/PGA (m/s per g)": pgv / pga, "PGD/PGV (s)": pgd / pgv}
        own["D5-95 (s)"] = np.array([one.d5_95 for one in suite])
        for period in SCALED_FOR:
            factors = sm.scaling.scale_asce7_10(suite, target, period, between=False).factors
            own |= {
                f"PGV (m/s), scaled for {period:g} s": pgv * factors,
                f"PGD (m), scaled for {period:g} s": pgd * factors,
            }
        for name, values in own.items():
            measures.setdefault(name, []).append(values)
    found = {name: [three(values) for values in both] for name, both in measures.items()}
    return table(f"measure | {HEADS}", (row(name, each) for name, each in found.items())), found


def spectra_of(suites: tuple[Suite, Suite]) -> tuple[str, dict[float, list[tuple[float, float, float]]]]:
    """Return the table of spectra scaled for 0.57 s, and its numbers."""
    target = sm.TargetSpectrum.asce7()
    scaled = []
    for suite in suites:
        factors = sm.scaling.scale_asce7_10(suite, target, 0.57, between=False).factors
        scaled.append(factors[:, None] * response_spectrum(suite, np.array(PERIODS)) / sm.STANDARD_GRAVITY)
    found = {period: [three(sa[:, place]) for sa in scaled] for place, period in enumerate(PERIODS)}
    return table(f"T (s) | {HEADS}", (row(f"{period:g}", each) for period, each in found.items())), found


def compared(file: Path, suites: tuple[Suite, Suite]) -> Compared:
    """Return a building under both suites."""
    results = [sm.assess(file, suite, TARGETS.get(file.stem), resamples=100) for suite in suites]
    drifts, slips, fallen = zip(*(of_runs(result.runs) for result in results), strict=True)
    source = np.random.default_rng(0)
    places = [source.integers(0, len(suite), (RESAMPLES, len(suite))) for suite in suites]
    means = [each[chosen].mean(axis=1).max(axis=1) for each, chosen in zip(drifts, places, strict=True)]
    whole = [float(each.mean(axis=0).max()) for each in drifts]
    samples, slip, resampled, shown = np.log(means[0] / means[1]), {}, {}, {}
    for name, model in SLIPS.items():
        both = [each[model] for each in slips]
        shown[name] = [upper(each) for each in both]
        if all(LEAST_SLIP <= each < np.inf for each in shown[name]):
            slip[name] = float(np.log(shown[name][0] / shown[name][1]))
            of = [np.maximum(upper(each[chosen]), 0.1 * LEAST_SLIP) for each, chosen in zip(both, places, strict=True)]
            with np.errstate(invalid="ignore", divide="ignore"):
                resampled[name] = np.nan_to_num(np.log(of[0] / of[1]), nan=0.0)
    name = results[0].building.name
    shares = ", ".join("none" if result.advised is None else f"{result.advised:.2f}" for result in results)
    of_slips = "; ".join(
        ", ".join(f"{1e3 * each:.0f}" if each < np.inf else "none" for each in two) for two in shown.values()
    )
    logs = "; ".join(with_interval(slip[key], resampled[key]) if key in slip else "-" for key in SLIPS)
    drift = float(np.log(whole[0] / whole[1]))
    cells = (
        name,
        shares,
        ", ".join(f"{100.0 * each:.2f}" for each in whole),
        with_interval(drift, samples),
        of_slips,
        logs,
    )
    counts = int(fallen[0].sum()), int(fallen[1].sum())
    return Compared(name, (*cells, f"{counts[0]}, {counts[1]}"), drift, samples, slip, resampled, counts)


def with_interval(value: float, samples: Array) -> str:
    """A number with its 90 % interval."""
    low, high = np.quantile(samples, (0.05, 0.95))
    ends = (signed(end, "+.2f") if abs(end) < UNBOUNDED else "none" for end in (low, high))
    return f"{signed(value, '+.2f')} [{', '.join(ends)}]"


def upper(slips: Array) -> Any:
    """The slip that 84 % of the motions do not exceed; infinite where more collapse."""
    return np.quantile(slips, 0.84, axis=-1, method="inverted_cdf")


def of_runs(runs: pl.DataFrame) -> tuple[Array, dict[str, Array], Array]:
    """Return drift ratios (motions, storeys) with goods that slide, a larger one and a collapse counting as the cap;
    the largest slip of each motion at each friction; and which motions collapse.
    """
    slips = {}
    for model in SLIPS.values():
        of = runs.filter(pl.col("model") == model).group_by("motion", maintain_order=True)
        rows = of.agg(pl.col("collapsed").any(), pl.col("peak_slip").max().fill_null(0.0))
        slips[model] = np.where(rows["collapsed"].to_numpy(), np.inf, rows["peak_slip"].to_numpy())
    real = runs.filter(pl.col("model") == "real")
    storeys = int(real["storey"].max())  # type: ignore[arg-type]
    fallen = real["collapsed"].to_numpy().reshape(-1, storeys)[:, 0]
    drifts = np.minimum(real["peak_drift_ratio"].to_numpy().reshape(-1, storeys), CAP)
    return np.where(fallen[:, None], CAP, drifts), slips, fallen
