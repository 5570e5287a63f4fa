"""A limit that a value may reach is inclusive there: the value at it is accepted, the next one beyond it is not."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.base.errors import RecordFormatError
from seismass.base.units import STANDARD_GRAVITY
from seismass.effective_mass.result import remarks_of
from seismass.model.friction import bound_factors
from seismass.model.tipping import BlockSize
from seismass.motions.matching.match import matching_remarks
from seismass.motions.records.read import suspicions
from seismass.studies.fragility import HuntAndFill
from seismass.studies.slip.runs import Base, newmark_bound, newmark_pulse

TWO_STOREYS = Path(__file__).with_name("data") / "two_storeys.json"
BUILDING = sm.Building.uniform(2, 0.3, mass=1e5)
MODES = sm.design.vibration_modes(BUILDING.mass, BUILDING.stiffness)


def below(value: float) -> float:
    """The next number below."""
    return float(np.nextafter(value, -np.inf))


def above(value: float) -> float:
    """The next number above."""
    return float(np.nextafter(value, np.inf))


def file_with(place: str, key: str) -> Callable[[float], object]:
    """A building file with a number of a table."""

    def read(value: float) -> object:
        tables: dict[str, Any] = {
            **json.loads(TWO_STOREYS.read_text(encoding="utf-8")),
            "goods": {"live_load_kpa": 6.0, "mu_s": 0.3, "mu_k": 0.2},
            "storeys": [{}, {}],
        }
        tables[place][key] = value
        return sm.read_building(tables)

    return read


def of_map(name: str, *, several: bool = False) -> Callable[[float], object]:
    return lambda value: sm.EffectiveMassParameters(**{name: (value,) if several else value})


# What is made with a value, and the least and the largest value that it accepts; None where there is none.
LIMITS: dict[str, tuple[Callable[[float], object], float | None, float | None]] = {
    "friction": (lambda mu: sm.Scene(BUILDING, [sm.Block(1, mass=1.0, mu=mu)]), 0.0, None),
    "kinetic friction": (lambda mu: sm.Scene(BUILDING, [sm.Block(1, mass=1.0, mu_s=0.3, mu_k=mu)]), 0.0, 0.3),
    "damping": (lambda ratio: BUILDING.replace(damping=ratio), 0.0, 1.0),
    "overstrength": (lambda value: BUILDING.replace(yield_shear=1e5, overstrength=value), 1.0, None),
    "second slope": (lambda value: BUILDING.replace(yield_shear=1e5, second_slope=value), 0.0, 1.0),
    "share of a file": (file_with("goods", "occupied"), 0.0, 1.0),
    "static friction of a file": (file_with("goods", "mu_s"), 0.2, None),
    "kinetic friction of a file": (file_with("goods", "mu_k"), 0.0, 0.3),
    "live load of a file": (file_with("goods", "live_load_kpa"), 0.0, None),
    "R of a file": (file_with("building", "R"), 1.0, None),
    "lower bound of friction": (lambda low: bound_factors((low, 1.5), "goods"), None, 1.0),
    "upper bound of friction": (lambda high: bound_factors((0.5, high), "goods"), 1.0, None),
    "share of the mass in modes": (MODES.modes_needed, None, 1.0),
    "fraction of a code": (sm.occupancy.on_surveyed_goods, 0.0, 1.0),
    "design fraction of a map": (of_map("design_fraction"), 0.0, 1.0),
    "R of a map": (of_map("response_modification", several=True), 1.0, None),
    "friction of a map": (of_map("mus", several=True), 0.0, None),
    "centre of a block": (lambda centre: BlockSize(1.0, 1.2, centre), None, 1.2),
    "tolerance of a hunt": (lambda value: HuntAndFill(tolerance=value), 1e-14, None),
    "end of a hunt": (lambda value: HuntAndFill(beyond=value), 1.0, None),
    "exceedances of a fit": (lambda hit: sm.fragility.fit_counts([0.1, 0.2, 0.4], [hit, 5, 8], 10), 0.0, None),
    "largest exceedances of a fit": (lambda hit: sm.fragility.fit_counts([0.1, 0.2, 0.4], [1, 5, hit], 10), None, 10.0),
}


@pytest.mark.parametrize("name", LIMITS)
def test_a_value_at_its_limit_is_accepted_and_the_next_one_is_not(name: str) -> None:
    make, least, most = LIMITS[name]
    for limit, beyond in ((least, below), (most, above)):
        if limit is not None:
            make(limit)
            with pytest.raises(sm.errors.SeismassError):
                make(beyond(limit))


@pytest.mark.parametrize(
    ("make", "limit"),
    [
        (lambda value: HuntAndFill(tolerance=value), 1.0),
        (lambda value: HuntAndFill(step=value), 0.0),
        (lambda value: HuntAndFill(highest=value), 0.0),
        (of_map("confidence"), 0.0),
        (of_map("confidence"), 1.0),
        (of_map("mass_ratios", several=True), 0.0),
        (of_map("intensities", several=True), 0.0),
        (MODES.modes_needed, 0.0),
        (lambda low: bound_factors((low, 1.5), "goods"), 0.0),
        (lambda width: BlockSize(width, 1.0), 0.0),
    ],
)
def test_a_limit_that_no_value_may_reach_is_refused(make: Callable[[float], object], limit: float) -> None:
    make(above(limit) if limit == 0.0 else below(limit))
    with pytest.raises(sm.errors.InvalidOption):
        make(limit)


@pytest.mark.parametrize(("name", "least"), [("resamples", 1), ("shares", 2), ("seed", 0)])
def test_counts_of_a_map_reach_their_least(name: str, least: int) -> None:
    sm.EffectiveMassParameters(**{name: least})
    with pytest.raises(sm.errors.InvalidOption, match=name):
        sm.EffectiveMassParameters(**{name: least - 1})


def column(step: float, unit: str) -> str:
    """Times and accelerations."""
    lines = [f"{place * step:.9g},{0.01 * (-1) ** place:g}" for place in range(40)]
    return f"Time ({unit}),Acceleration (g)\n" + "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    ("unit", "least", "most", "less", "more"),
    # 10 us and 1 s in three units; all of them and their multiples are decimals.
    [("s", 1e-5, 1.0, 9e-6, 1.1), ("ms", 0.01, 1e3, 0.009, 1100.0), ("us", 10.0, 1e6, 9.0, 1.1e6)],
)
def test_steps_of_motions_are_from_ten_microseconds_to_a_second(
    tmp_path: Path, unit: str, least: float, most: float, less: float, more: float
) -> None:
    file = tmp_path / "a.csv"
    for step, seconds in ((least, 1e-5), (most, 1.0)):
        file.write_text(column(step, unit))
        assert sm.read_record(file).dt == pytest.approx(seconds, rel=1e-12)
    for step in (less, more):
        file.write_text(column(step, unit))
        with pytest.raises(RecordFormatError, match=r"step of a\.csv must be between 1e-05 and 1 s"):
            sm.read_record(file)


@pytest.mark.parametrize("word", ["dt = {} s", "time step: {} s", "sampling rate = {rate} Hz"])
def test_steps_of_headers_are_from_ten_microseconds_to_a_second(tmp_path: Path, word: str) -> None:
    file, samples = tmp_path / "a.txt", "\n".join(f"{0.01 * (-1) ** place:.4f}" for place in range(40))
    for step in (1e-5, 1.0):
        file.write_text(f"{word.format(f'{step:g}', rate=f'{1 / step:.0f}')}\n{samples}\n")
        assert sm.read_record(file, unit="g").dt == pytest.approx(step, rel=1e-12)
    for step in (8e-6, 2.0):
        file.write_text(f"{word.format(f'{step:g}', rate=f'{1 / step:g}')}\n{samples}\n")
        with pytest.raises(RecordFormatError, match=r"DT of a\.txt must be a step between 1e-05 and 1 s"):
            sm.read_record(file, unit="g")


@pytest.mark.parametrize(("step", "is_step"), [("0.0001", True), ("0.1", True), ("0.00009", False), ("0.11", False)])
def test_a_count_before_the_samples_has_a_step_from_a_tenth_of_a_millisecond(
    tmp_path: Path, step: str, is_step: bool
) -> None:
    """Beyond, the two numbers are a row like the others, times and accelerations, of which the first goes back."""
    samples = [f"{0.01 * (-1) ** place:.4f}" for place in range(40)]
    file = tmp_path / "a.txt"
    file.write_text(f"40 {step}\n" + "\n".join(samples) + "\n")
    if is_step:
        record = sm.read_record(file, unit="g")
        assert (record.dt, record.samples) == (float(step), 40)
    else:
        with pytest.raises(RecordFormatError):
            sm.read_record(file, unit="g")


def test_a_block_does_not_slide_where_the_peak_is_what_friction_holds() -> None:
    """A = mu g: both estimates of Newmark are zero there, and above zero for any larger peak; so at A = mu = 0."""
    motion = sm.Motion([0.0, 1.0, 0.0], 0.1)
    for mu in (0.3, 0.0):
        limit = mu * STANDARD_GRAVITY
        for estimate in (newmark_pulse, newmark_bound):
            assert estimate(Base(motion, limit, 0.7, 0.0), mu) == 0.0
            assert estimate(Base(motion, 1.001 * limit + 1e-3, 0.7, 0.0), mu) > 0.0


def matched(**changes: Any) -> Any:
    """A matched record of which nothing is to be remarked on."""
    peaks = SimpleNamespace(pgv=1.0, pgd=1.0)
    usual = {
        "converged": True,
        "factor": 1.0,
        "original": peaks,
        "record": peaks,
        "outside": {},
        "husid_difference": 0.0,
    }
    return SimpleNamespace(misfit=None, **(usual | changes))


@pytest.mark.parametrize(
    ("changes", "remark"),
    [
        (lambda value: {"record": SimpleNamespace(pgv=value, pgd=1.0)}, "PGV grew from 1 to 1.25 m/s, times 1.25"),
        (lambda value: {"record": SimpleNamespace(pgv=1.0, pgd=value)}, "PGD grew from 1 to 1.25 m, times 1.25"),
        (
            lambda value: {"outside": {"shorter": value}},
            "the spectrum at shorter periods than those matched grew by 1.25",
        ),
        (lambda value: {"husid_difference": value - 1.0}, "the build-up of Arias intensity differs by up to 25 %"),
    ],
)
def test_growth_is_remarked_on_above_a_quarter(changes: Callable[[float], dict[str, Any]], remark: str) -> None:
    assert matching_remarks(matched(**changes(1.25)), shortened=False) == ()
    (told,) = matching_remarks(matched(**changes(1.25 + 1e-9)), shortened=False)
    assert told.startswith(remark)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_factors_of_matching_are_usual_up_to_their_limits(sign: float) -> None:
    for limit, beyond in ((0.2, below), (5.0, above)):
        assert matching_remarks(matched(factor=sign * limit), shortened=False) == ()
        (told,) = matching_remarks(matched(factor=sign * beyond(limit)), shortened=False)
        assert told.startswith("scaled by ")


def test_a_storey_is_remarked_on_above_105_per_cent() -> None:
    storeys = pl.DataFrame(
        {"storey": [1, 2, 3], "ratio": [1.05, above(1.05), np.inf], "envelope_ratio": [1.0, 1.02, np.inf]}
    )
    remarks = remarks_of("root", [0.3], 0.3, 0.0, (0.2, 0.4), storeys, {"real": 0, "model": 0}, 7)
    (told,) = remarks
    assert told.startswith("storey 2 drifts 1.05 times the model at 0.30; with a second analysis without goods 1.02")


@pytest.mark.parametrize("motions", [6, 7])
def test_motions_are_few_below_seven(motions: int) -> None:
    storeys = pl.DataFrame({"storey": [1], "ratio": [1.0], "envelope_ratio": [1.0]})
    remarks = remarks_of("root", [0.3], 0.3, 0.0, (0.2, 0.4), storeys, {"real": 0, "model": 0}, motions)
    assert bool(remarks) is (motions == 6)


@pytest.mark.parametrize("samples", [49, 50, 99, 100])
def test_so_many_samples_have_both_signs_and_no_mean(samples: int) -> None:
    """From 50 samples on one sign is remarked on, from 100 on a mean that is no zero."""
    record = sm.Record(0.3 + 0.2 * (-1.0) ** np.arange(samples), 0.01, file_unit="m/s2")
    words = " ".join(suspicions(record, unit_is_stated=True))
    assert ("its samples have one sign" in words) is (samples >= 50)
    assert ("an offset was not removed" in words) is (samples >= 100)
