"""Measures of a record: closed forms, invariants, values computed independently; how a record shows itself."""

from __future__ import annotations

import math
import pickle
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure

import seismass as sm
from seismass.motions.records import Record, intensity_table
from seismass.motions.records.intensity import integrals, peak_displacement, peak_velocity
from seismass.motions.records.rotd import MEASURES, drift_remarks

G = sm.STANDARD_GRAVITY
ARIAS = math.pi / (2.0 * G)


def test_constant_acceleration() -> None:
    """v = a t, d = a t^2/2, Arias = pi/(2 g) a^2 t, CAV = a t; shares of Arias are shares of time."""
    record = Record([2.0] * 11, 0.1)
    np.testing.assert_allclose(record.velocity, 2.0 * record.time, rtol=1e-14)
    np.testing.assert_allclose(record.displacement, record.time**2, rtol=1e-14, atol=1e-16)
    assert record.pgv == pytest.approx(2.0, rel=1e-14)
    assert record.pgd == pytest.approx(1.0, rel=1e-14)
    assert record.arias == pytest.approx(ARIAS * 4.0, rel=1e-14)
    assert record.cav == pytest.approx(2.0, rel=1e-14)
    assert record.d5_95 == pytest.approx(0.9, rel=1e-13)
    assert record.d5_75 == pytest.approx(0.7, rel=1e-13)
    assert record.bracketed_duration() == pytest.approx(1.0, rel=1e-14)


def test_triangle() -> None:
    """Up to A and down over two steps h: v = A h, d = A h^2, Arias of 2 A^2 h/3, of which t^3 at the start."""
    a, h = 3.0, 0.5
    record = Record([0.0, a, 0.0], h)
    assert record.velocity[-1] == pytest.approx(a * h, rel=1e-14)
    assert record.displacement[-1] == pytest.approx(a * h * h, rel=1e-14)
    assert record.arias == pytest.approx(ARIAS * 2.0 * a * a * h / 3.0, rel=1e-14)
    assert record.cav == pytest.approx(a * h, rel=1e-14)
    assert record.d5_95 == pytest.approx(2.0 * h * (1.0 - 0.1 ** (1.0 / 3.0)), rel=1e-13)
    assert record.significant_duration(0.0, 1.0) == pytest.approx(2.0 * h, rel=1e-13)
    assert record.significant_duration(0.5, 0.5) == 0.0
    assert record.bracketed_duration(0.1) == pytest.approx(2.0 * h * (1.0 - 0.1 * G / a), rel=1e-13)
    # A threshold that is just reached is reached.
    assert Record([0.0, 0.1 * G, -0.1 * G, 0.0], h).bracketed_duration(0.1) == h


def test_peaks_between_samples() -> None:
    """A line through zero: v is largest halfway. A velocity 1 + s - 3 s^2 is zero at s = (1 + sqrt(13))/6."""
    line = Record([1.0, -1.0], 1.0)
    assert line.velocity.tolist() == [0.0, 0.0]
    assert line.pgv == pytest.approx(0.25, rel=1e-15)
    assert line.pgd == pytest.approx(1.0 / 6.0, rel=1e-15)
    assert line.cav == pytest.approx(0.5, rel=1e-15)
    turning = Record([1.0, 1.0, -5.0], 1.0)
    s = (1.0 + math.sqrt(13.0)) / 6.0
    assert turning.pgd == pytest.approx(0.5 + s + 0.5 * s * s - s**3, rel=1e-14)


def test_sine() -> None:
    """A sin(w t) over whole periods T: PGV = 2 A/w, Arias = pi/(2 g) A^2 T/2, CAV = 2 A T/pi; lines miss by (w h)^2."""
    a, period, steps = 2.0, 0.5, 1000
    w, h = 2.0 * math.pi / period, period / steps
    record = Record(a * np.sin(w * h * np.arange(4 * steps + 1)), h)
    missed = (w * h) ** 2
    assert record.pgv == pytest.approx(2.0 * a / w, rel=missed)
    assert record.arias == pytest.approx(ARIAS * 0.5 * a * a * 4.0 * period, rel=missed)
    assert record.cav == pytest.approx(2.0 / math.pi * a * 4.0 * period, rel=missed)
    # Two whole periods of four in the middle hold half of it.
    assert record.significant_duration(0.25, 0.75) == pytest.approx(2.0 * period, rel=1e-6)
    # Displacement from rest: a t/w - a sin(w t)/w^2.
    assert record.displacement[-1] == pytest.approx(a / w * 4.0 * period, rel=missed)


SAMPLES = st.lists(st.floats(-20.0, 20.0), min_size=2, max_size=30)


@given(SAMPLES, st.sampled_from([0.005, 0.01, 0.3]))
def test_measures_are_those_of_the_refined_motion(samples: list[float], dt: float) -> None:
    """Samples added on the lines change nothing; the largest of many samples is below the peak by at most h^2/8."""
    record = Record(samples, dt)
    times = 40
    finer = record.resampled(dt / times)
    scale = max(record.pga, 1e-3)
    for name, size in (("velocity", dt), ("displacement", dt * dt)):
        whole, part = getattr(record, name), getattr(finer, name)[::times]
        np.testing.assert_allclose(part, whole, atol=1e-11 * scale * size * len(samples) ** 2)
    assert finer.arias == pytest.approx(record.arias, rel=1e-10, abs=1e-12)
    assert finer.cav == pytest.approx(record.cav, rel=1e-10, abs=1e-12)
    h = finer.dt
    slope = float(np.max(np.abs(np.diff(record.acceleration)))) / dt
    for peak, history, curvature in (
        (record.pgv, finer.velocity, slope),
        (record.pgd, finer.displacement, record.pga),
    ):
        largest = float(np.max(np.abs(history)))
        assert largest <= peak * (1.0 + 1e-9) + 1e-12
        assert peak <= largest + curvature * h * h / 8.0 + 1e-9 * peak + 1e-12


@given(SAMPLES, st.floats(0.01, 0.49))
def test_significant_duration_against_a_search(samples: list[float], share: float) -> None:
    """The build-up up to the times of two shares is those shares, by the integral of the cut motion."""
    record = Record(samples, 0.02)
    if record.arias < 1e-6:
        return
    first = record.significant_duration(0.0, share)
    # Arias up to `first`: whole steps, then the part of a line.
    whole = int(first / record.dt)
    part = first / record.dt - whole
    a = record.acceleration
    built = sum((x * x + x * y + y * y) * record.dt / 3.0 for x, y in pairwise(a[: whole + 1]))
    if whole + 1 < len(a):
        x, y = float(a[whole]), float(a[whole] + part * (a[whole + 1] - a[whole]))
        built += (x * x + x * y + y * y) * part * record.dt / 3.0
    assert ARIAS * built == pytest.approx(share * record.arias, rel=1e-6)


def test_batches_of_motions_have_the_peaks_of_each() -> None:
    motions = np.random.default_rng(1).normal(size=(3, 200))
    velocity, displacement = integrals(motions, 0.01)
    together = peak_velocity(motions, 0.01, velocity), peak_displacement(motions, 0.01, velocity, displacement)
    for number, motion in enumerate(motions):
        record = Record(motion, 0.01)
        assert (together[0][number], together[1][number]) == (record.pgv, record.pgd)


def test_gilroy_by_an_independent_computation(shared: Path) -> None:
    """Arias, D5-95 and CAV of RSN767, 0 degrees, by another program that integrates the same lines exactly."""
    record = sm.read_record(next((shared / "records").glob("02_*/RSN767_LOMAP_G03000.AT2")))
    assert record.arias == pytest.approx(2.08595, abs=5e-6)
    assert record.d5_95 == pytest.approx(6.373, abs=5e-4)
    assert record.cav == pytest.approx(9.9824, abs=5e-5)


def test_recordings_end_at_rest(shared: Path) -> None:
    """Processed records of NGA-West2 drift nowhere; what they say when a constant is added, or they are cut."""
    for record in sm.read_suite(shared / "records" / "fema_p695_far_field"):
        assert drift_remarks(record) == ()
    record = sm.read_record(next((shared / "records").glob("06_*/*ELC180-hor1.AT2")))
    drifting = record.replace(acceleration=record.acceleration + 0.02)
    velocity, displacement = drift_remarks(drifting)
    assert "100 % of PGV" in velocity
    assert "100 % of PGD" in displacement
    assert drift_remarks(record.with_duration(2.1))
    assert intensity_table([drifting])["remarks"][0].to_list() == [velocity, displacement]
    assert "baseline doubtful" in drifting._repr_html_()


@pytest.mark.parametrize("samples", [[0.0], [1.0], [0.0] * 5])
def test_records_without_motion_have_measures(samples: list[float]) -> None:
    record = Record(samples, 0.01)
    expected: dict[str, float] = dict.fromkeys(MEASURES, 0.0)
    assert record.measures() == expected | {"pga_g": samples[0] / G}
    assert "<svg" in record._repr_html_()
    assert isinstance(record.plot(), Figure)


def test_arrays_are_read_only_and_records_stay_values() -> None:
    record = sm.builtin_suite()[0]
    for values in (record.velocity, record.displacement):
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 1.0
    assert record.velocity is record.velocity
    copy = pickle.loads(pickle.dumps(record))
    assert copy == record
    assert copy.pgd == record.pgd


def test_table_has_a_row_per_record() -> None:
    suite = sm.builtin_suite()
    table = intensity_table(suite)
    assert table["motion"].to_list() == list(range(1, len(suite) + 1))
    assert table.columns[8:-1] == list(MEASURES)
    assert table["arias"].to_list() == [record.arias for record in suite]
    assert intensity_table(suite[0]).equals(table[:1])
    twice = intensity_table([record.scaled(2.0) for record in suite])
    powers = {"pga_g": 2.0, "pgv": 2.0, "pgd": 2.0, "arias": 4.0, "cav": 2.0, "d5_75": 1.0, "d5_95": 1.0}
    for name, factor in powers.items():
        np.testing.assert_allclose(twice[name], factor * table[name], rtol=1e-12)


@pytest.mark.parametrize(
    ("wrong", "kind", "message"),
    [
        (
            lambda r: r.significant_duration(-0.1, 0.9),
            sm.errors.InvalidOption,
            "start of significant duration must be a share",
        ),
        (
            lambda r: r.significant_duration(0.5, 0.4),
            sm.errors.InvalidOption,
            "end of significant duration must be a share",
        ),
        (lambda r: r.significant_duration(0.5, float("nan")), sm.errors.InvalidOption, "end of significant duration"),
        (
            lambda r: r.bracketed_duration(0.0),
            sm.errors.InvalidOption,
            "threshold_g of bracketed duration must be a positive",
        ),
        (
            lambda r: r.bracketed_duration("much"),
            sm.errors.InvalidOption,
            "threshold_g of bracketed duration must be a number",
        ),
        (
            lambda r: intensity_table([r, 3]),
            sm.errors.InvalidMotion,
            "record 2 of intensity table must be a Record; got 3",
        ),
        (lambda r: intensity_table(7), sm.errors.InvalidMotion, "records of intensity table must be Records; got 7"),
        (lambda r: r.plot(axes=[]), sm.errors.InvalidOption, "axes of plot must be 4 Axes"),
        (lambda r: r.plot(axes=[], figure=Figure()), sm.errors.InvalidOption, "axes of plot must be left out where"),
    ],
)
def test_wrong_input(wrong: Any, kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=message):
        wrong(Record([0.0, 1.0, -1.0], 0.01))


def test_html_is_whole_escaped_and_alone() -> None:
    record = Record(np.sin(np.arange(2000.0)), 0.01, name="<script>", event='A & "B"', remarks=("<b>doubtful</b>",))
    for one in (record, record.with_duration(1.0).scaled(2.0)):
        html = one._repr_html_()
        tree = ElementTree.fromstring(html.replace("&nbsp;", " "))  # well formed
        text = "".join(tree.itertext())
        assert "<script>" in text
        assert 'A & "B"' in text
        assert "<b>doubtful</b>" in text
        assert "<script" not in html
        assert not any(word in html for word in ("http", "src=", "href=", "background", "url("))
        assert len(html) < 20_000
    assert "scaled by 2" in html


def test_plot_draws_into_what_it_is_given() -> None:
    record = sm.builtin_suite()[0]
    alone = record.plot()
    assert not hasattr(alone, "number")  # which pyplot's figures have
    labels = ["acceleration (g)", "velocity (m/s)", "displacement (m)", "Arias (m/s)"]
    assert [axes.get_ylabel() for axes in alone.axes] == labels
    lines = [float(line.get_xdata()[0]) for line in alone.axes[3].lines[1:]]
    assert lines[1] - lines[0] == pytest.approx(record.d5_95, rel=1e-12)
    figure = Figure(layout="constrained")
    left, right = figure.subfigures(1, 2)
    assert record.plot(figure=left) is figure
    axes = right.subplots(4, 1)
    assert record.plot(axes=axes) is figure
    assert len(figure.axes) == 8
    np.testing.assert_array_equal(axes[1].lines[0].get_ydata(), record.velocity)
