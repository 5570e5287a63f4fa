"""Pairs: reading, finding, aligning, turning them; RotD over directions; the flatfile of NGA-West2."""

from __future__ import annotations

import math
import re
import runpy
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import seismass as sm
from pages.ground_motions import listed_pairs
from seismass.motions.records import Pair, Record, find_pairs, read_pair, rotd
from seismass.motions.records.pair import between

ROOT = Path(__file__).parents[1]
AT2_HEAD = "PEER NGA STRONG MOTION DATABASE RECORD\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\n"


def at2(folder: Path, name: str, title: str, samples: int = 20, dt: float = 0.01) -> Path:
    """Write a file of as many samples, different by name."""
    values = np.random.default_rng(sum(map(ord, name))).normal(size=samples)
    body = "\n".join(f"{value:.7E}" for value in values)
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / name
    file.write_text(AT2_HEAD.format(title=title) + f"NPTS= {samples}, DT= {dt:.4f} SEC\n{body}\n")
    return file


@pytest.fixture
def plane() -> tuple[np.ndarray, np.ndarray]:
    """Motion to the north and to the east."""
    north, east = np.random.default_rng(8).normal(size=(2, 400))
    return north, east


def towards(plane: tuple[np.ndarray, np.ndarray], azimuth: float) -> Record:
    angle = math.radians(azimuth)
    samples = math.cos(angle) * plane[0] + math.sin(angle) * plane[1]
    return Record(samples, 0.01, name=f"STA{azimuth:03.0f}", component=f"{azimuth:g}", azimuth=azimuth)


def test_quarter_turns_are_exact(plane: Any) -> None:
    """cos and sin of multiples of 90 degrees are 0 and 1: the same bits."""
    pair = Pair.from_records(towards(plane, 0.0), towards(plane, 90.0))
    first, second = pair.first.acceleration, pair.second.acceleration
    np.testing.assert_array_equal(pair.component(0.0).acceleration, first)
    np.testing.assert_array_equal(pair.component(90.0).acceleration, second)
    np.testing.assert_array_equal(pair.component(180.0).acceleration, -first)
    turned = pair.rotated(90.0)
    np.testing.assert_array_equal(turned.second.acceleration, -first)
    back = turned.rotated(-90.0)
    np.testing.assert_array_equal(back.first.acceleration, first)
    np.testing.assert_array_equal(back.second.acceleration, second)
    assert (turned.azimuths, back.azimuths) == ((90.0, 180.0), (0.0, 90.0))


@pytest.mark.parametrize("azimuths", [(0.0, 90.0), (90.0, 0.0), (225.0, 315.0), (9.0, 279.0), (350.0, 80.0)])
@pytest.mark.parametrize("wanted", [0.0, 33.0, 90.0, 200.0, 359.0])
def test_components_towards_an_azimuth(plane: Any, azimuths: tuple[float, float], wanted: float) -> None:
    """Whatever way the sensors stood, clockwise or not, motion towards an azimuth is that of the plane."""
    pair = Pair.from_records(*(towards(plane, azimuth) for azimuth in azimuths))
    component = pair.toward(wanted)
    np.testing.assert_allclose(component.acceleration, towards(plane, wanted).acceleration, atol=1e-13)
    assert component.azimuth == wanted
    # By an angle from the first towards the second, and its azimuth.
    turned = pair.component(30.0)
    assert turned.azimuth is not None
    np.testing.assert_allclose(turned.acceleration, towards(plane, turned.azimuth).acceleration, atol=1e-13)


@pytest.mark.parametrize("second", [87.0, 94.0, -88.0])
def test_directions_that_are_not_perpendicular_are_solved_for(plane: Any, second: float) -> None:
    pair = Pair.from_records(towards(plane, 10.0), towards(plane, 10.0 + second))
    assert f"{abs(second):g} degrees apart" in pair.remarks[0]
    for wanted in (10.0, 10.0 + second, 55.0):
        np.testing.assert_allclose(pair.toward(wanted).acceleration, towards(plane, wanted).acceleration, atol=1e-13)
    assert pair.rotated(20.0).azimuths is not None
    assert abs(pair.rotated(20.0).apart) == 90.0


def test_fault_normal_and_parallel(plane: Any) -> None:
    """Parallel positive towards the strike, normal to its right; the other strike of the fault changes both signs."""
    up = towards(plane, 45.0).replace(azimuth=None, component="UP")
    pair = Pair.from_records(towards(plane, 225.0), towards(plane, 315.0), up)
    turned = pair.fault_normal_parallel(30.0)
    np.testing.assert_allclose(turned.second.acceleration, towards(plane, 30.0).acceleration, atol=1e-13)
    np.testing.assert_allclose(turned.first.acceleration, towards(plane, 120.0).acceleration, atol=1e-13)
    assert (turned.first.component, turned.first.azimuth) == ("fault-normal, strike 30", 120.0)
    assert "component towards azimuth 120 of 225 and 315" in turned.first.history
    assert turned.vertical == pair.vertical
    other = pair.fault_normal_parallel(210.0)
    np.testing.assert_allclose(other.first.acceleration, -turned.first.acceleration, atol=1e-13)
    np.testing.assert_allclose(other.second.acceleration, -turned.second.acceleration, atol=1e-13)


@given(st.floats(-720.0, 720.0))
def test_turning_keeps_the_energy(angle: float) -> None:
    one, other = np.random.default_rng(5).normal(size=(2, 50))
    pair = Pair.from_records(Record(one, 0.02), Record(other, 0.02))
    turned = pair.rotated(angle)
    assert turned.first.arias + turned.second.arias == pytest.approx(pair.first.arias + pair.second.arias, rel=1e-12)
    np.testing.assert_allclose(turned.rotated(-angle).first.acceleration, one, atol=1e-12)


def test_lengths_are_aligned_and_said() -> None:
    long, short = Record([1.0] * 10, 0.01, name="long"), Record([2.0] * 8, 0.01, name="short")
    up = Record([3.0] * 9, 0.01, name="up")
    cut = Pair.from_records(long, short, up)
    assert [record.samples for record in cut] == [8, 8, 8]
    assert cut.remarks == (
        "long cut to the 8 samples of its pair, from 10",
        "up cut to the 8 samples of its pair, from 9",
        "directions of the two horizontals are not both stated: taken as perpendicular",
    )
    assert cut.first.history == ("cut to the 8 samples of its pair",)
    padded = Pair.from_records(long, short, up, lengths="padded")
    assert padded.second.acceleration.tolist() == [2.0] * 8 + [0.0] * 2
    assert padded.vertical is not None
    assert padded.vertical.acceleration.tolist() == [3.0] * 9 + [0.0]
    assert padded.remarks[0] == "short padded by 2 zeros to its pair, from 8"
    assert long.samples == 10
    beside = Pair.from_records(long.with_vertical(long), long)
    assert beside.first.vertical is None
    assert "vertical accelerations that long had beside its own left out" in beside.remarks


def test_components_of_different_recordings_are_remarked(plane: Any) -> None:
    first, second = (one.replace(event="event", station="here") for one in (towards(plane, 0.0), towards(plane, 90.0)))
    assert Pair.from_records(first, second).remarks == ()
    elsewhere = Pair.from_records(first, second.replace(station="there"))
    assert elsewhere.remarks == ("station of the two horizontals differs: here and there",)


def test_each_component_is_changed_alike(plane: Any) -> None:
    up = towards(plane, 20.0).replace(azimuth=None, component="UP")
    pair = Pair.from_records(towards(plane, 0.0), towards(plane, 90.0), up)
    assert pair.scaled(2.0).vertical == pair.vertical.scaled(2.0) if pair.vertical else False
    assert {record.dt for record in pair.each(lambda record: record.resampled(0.005))} == {0.005}
    assert len(pair) == 3
    assert repr(pair).startswith("<Pair STA: 400 x 0.01 s, PGA ")


@pytest.mark.parametrize(
    ("names", "azimuths", "expected"),
    [
        (("RSN767_LOMAP_G03000", "RSN767_LOMAP_G03090"), (0.0, 90.0), "RSN767_LOMAP_G03"),
        (("RSN174_H-E11140", "RSN174_H-E11230"), (140.0, 230.0), "RSN174_H-E11"),
        (("A_ERZ-EW__x", "A_ERZ-NS__y"), (90.0, 0.0), "A_ERZ"),
        (("AOM0011801241951", "AOM0011801241951"), (90.0, 0.0), "AOM0011801241951"),
        (("CLW-LN", "CLW-TR"), (None, None), "CLW"),
        (("ce1 channel 1", "ce1 channel 3"), (90.0, 0.0), "ce1"),
        (("12", "11"), (None, None), "12 + 11"),
        (("", ""), (None, None), ""),
    ],
)
def test_name_of_a_pair(names: tuple[str, str], azimuths: Any, expected: str) -> None:
    records = [
        Record([1.0, 0.0], 0.01, name=name, azimuth=azimuth) for name, azimuth in zip(names, azimuths, strict=True)
    ]
    assert Pair.from_records(*records).name == expected


def test_pairs_are_found_by_number_header_and_name(tmp_path: Path) -> None:
    at2(tmp_path / "peer", "RSN5_QUAKE_TWN000.AT2", "Quake, 1/1/2000, Town, 0", samples=21)
    at2(tmp_path / "peer", "RSN5_QUAKE_TWN090.AT2", "Quake, 1/1/2000, Town, 90")
    at2(tmp_path / "peer", "RSN5_QUAKE_TWN-UP.AT2", "Quake, 1/1/2000, Town, UP")
    at2(tmp_path / "header", "11.AT2", "Quake, 1/1/2000, Village, N30E")
    at2(tmp_path / "header", "12.AT2", "Quake, 1/1/2000, Village, N60W")
    at2(tmp_path / "header", "13.AT2", "Quake, 2/1/2000, Village, N60W")
    for name, samples in (("HAMLET000", [0.0, 1.0]), ("HAMLET090", [1.0, 0.0]), ("MILL120", [1.0, 1.0])):
        lines = "\n".join(f"{0.01 * number:.2f}, {value}" for number, value in enumerate(samples))
        (tmp_path / f"{name}.csv").write_text(f"time (s), acceleration (m/s2)\n{lines}\n")
    (tmp_path / "notes.txt").write_text("no record\n")
    (tmp_path / ".hidden.AT2").write_text("no record\n")
    found = find_pairs(tmp_path)
    assert {pair.name: pair.azimuths for pair in found} == {
        "HAMLET": (0.0, 90.0),
        "RSN5_QUAKE_TWN": (0.0, 90.0),
        "11 + 12": (30.0, 300.0),
    }
    assert {item.file.name: item.reason for item in found.excluded if item.file.suffix != ".txt"} == {
        "13.AT2": "no second horizontal component beside it",
        "MILL120.csv": "no second horizontal component beside it",
    }
    assert [item.file.name for item in found.excluded] == ["MILL120.csv", "13.AT2", "notes.txt"]
    peer = next(pair for pair in found if pair.name.startswith("RSN5"))
    assert peer.vertical is not None
    assert peer.samples == 20
    table = found.table()
    assert table["pair"].to_list() == [1, 2, 3]
    assert table.filter(name="RSN5_QUAKE_TWN")["remarks"][0].startswith("RSN5_QUAKE_TWN000 cut to the 20 samples")
    assert read_pair(tmp_path / "peer" / "RSN5_QUAKE_TWN000.AT2", tmp_path / "peer" / "RSN5_QUAKE_TWN090.AT2",
                     tmp_path / "peer" / "RSN5_QUAKE_TWN-UP.AT2") == peer  # fmt: skip


def test_what_makes_no_pair_is_said(tmp_path: Path) -> None:
    for name, component, dt in (
        ("RSN1_A_X000", "0", 0.01),
        ("RSN1_A_X090", "90", 0.02),
        ("RSN2_A_X000", "0", 0.01),
        ("RSN2_A_X045", "45", 0.01),
        ("RSN3_A_X000", "0", 0.01),
        ("RSN3_A_X090", "90", 0.01),
        ("RSN3_A_X180", "180", 0.01),
        ("RSN4_A_X-UP", "UP", 0.01),
        ("RSN5_A_X000", "0", 0.01),
        ("RSN5_A_X090", "90", 0.01),
        ("RSN5_A_X-UP", "UP", 0.01),
        ("RSN5_A_X-VER", "VER", 0.01),
        ("RSN6_A_X000", "0", 0.01),
        ("RSN6_A_X090", "90", 0.01),
        ("RSN6_A_Y000", "0", 0.01),
        ("RSN6_A_Y090", "90", 0.01),
        *((f"RSN7.{line}{level}", f"{line}{level}", 0.01) for line in ("EW", "NS", "UD") for level in "12"),
    ):
        at2(tmp_path, f"{name}.AT2", f"Quake, 1/1/2000, Town, {component}", dt=dt)
    found = find_pairs(tmp_path)
    assert [pair.name for pair in found] == ["RSN5_A_X", "RSN6_A_X", "RSN6_A_Y", "RSN7", "RSN7"]
    borehole, surface = found.pairs[3:]
    assert [[record.name for record in pair] for pair in (borehole, surface)] == [
        ["RSN7.EW1", "RSN7.NS1", "RSN7.UD1"],
        ["RSN7.EW2", "RSN7.NS2", "RSN7.UD2"],
    ]
    assert found[0].vertical is None
    reasons = {item.file.stem: item.reason for item in found.excluded}
    assert (
        "dt of second component of pair RSN1_A_X must be that of the first, 0.01 s; got 0.02 s"
        in reasons["RSN1_A_X000"]
    )
    assert "azimuths of pair" in reasons["RSN2_A_X045"]
    assert "at right angles within 5 degrees; got 0 and 45 degrees" in reasons["RSN2_A_X045"]
    assert reasons["RSN3_A_X180"].startswith("3 horizontal components that belong together")
    assert reasons["RSN4_A_X-UP"] == "vertical component without horizontal ones"
    assert reasons["RSN5_A_X-VER"] == "more than one vertical component of its pair"
    assert len(found.excluded) == 2 + 2 + 3 + 1 + 2


def test_every_shared_folder_gives_its_pairs(shared: Path) -> None:
    """Seven folders of one record each (the last a pair and a component alone), and 18 pairs of FEMA P-695."""
    expected = {
        "01_Hector_Mine_1999_Hector": ((0.0, 90.0), 4531, True),
        "02_Loma_Prieta_1989_Gilroy_Array_3": ((0.0, 90.0), 7997, True),
        "03_Imperial_Valley_1979_Brawley_Airport": ((225.0, 315.0), 7575, True),
        "04_Duzce_1999_Lamont_1059": ((90.0, 0.0), 4067, True),
        "05_Erzincan_1992_Erzincan": ((90.0, 0.0), 4156, True),
        "06_Imperial_Valley_1940_El_Centro_Array_9": ((180.0, 270.0), 5346, True),
        "07_Kobe_1995_substitutes": ((0.0, 90.0), 4096, False),
    }
    for folder, (azimuths, samples, vertical) in expected.items():
        found = find_pairs(shared / "records" / folder)
        assert len(found) == 1
        assert (found[0].azimuths, found[0].samples, found[0].vertical is not None) == (azimuths, samples, vertical)
        alone = [item.file.name for item in found.excluded]
        assert alone == (["RSN1106_KOBE_KJM000.AT2"] if folder.startswith("07") else [])
    found = find_pairs(shared / "records" / "fema_p695_far_field")
    assert (len(found), found.excluded) == (18, ())
    assert [pair.name for pair in found if pair.azimuths is None] == ["RSN1633_MANJIL_ABBAR", "RSN848_LANDERS_CLW"]
    # The header's peaks of SOURCES.md.
    hector = find_pairs(shared / "records" / "01_Hector_Mine_1999_Hector")[0]
    assert [round(record.pga_g, 5) for record in (hector.first, hector.second)] == [0.26547, 0.32819]


def test_channels_of_one_file_make_a_triple(shared: Path) -> None:
    """Three channels of a CSMIP file: two horizontals and the vertical."""
    found = find_pairs(shared / "record_formats" / "csmip")
    assert [(pair.name, pair.azimuths, len(pair)) for pair in found] == [
        ("BadHeader", (0.0, 90.0), 3),
        ("ce36456p_CE36456", (90.0, 0.0), 3),
    ]
    assert found.excluded == ()


def test_rotd_of_a_line() -> None:
    """Motion along one line at 30 degrees: the ordinate at an angle is that of the line times |cos|."""
    record = sm.builtin_suite()[0]
    cosine, sine = math.cos(math.radians(30.0)), math.sin(math.radians(30.0))
    pair = Pair.from_records(*(record.replace(acceleration=part * record.acceleration) for part in (cosine, sine)))
    periods = [0.1, 0.5, 2.0]
    found = rotd(pair, periods, (0.0, 16.0, 50.0, 84.0, 100.0))
    shares = np.percentile(np.abs(np.cos(np.radians(np.arange(180.0) - 30.0))), (0.0, 16.0, 50.0, 84.0, 100.0))
    spectrum = sm.response_spectrum(record, periods)[0]
    np.testing.assert_allclose(found.values, np.outer(shares, spectrum), rtol=1e-9, atol=1e-12)
    assert found.angle.tolist() == [30.0] * 3
    assert found.azimuth is None
    for name in ("pga", "pgv", "pgd"):
        np.testing.assert_allclose(found.peaks[name], shares * getattr(record, name), rtol=1e-9, atol=1e-12)
        assert found.peak_angle[name] == 30.0


def test_rotd_of_a_circle() -> None:
    """A vector of constant length that turns by a degree per sample: PGA is its length at every whole degree.

    It rises and falls over ten turns each, so that oscillators answer alike in every direction: within 1 %.
    """
    turn = np.radians(np.arange(0.0, 10_801.0))
    share = np.minimum(np.minimum(turn, turn[::-1]) / (20.0 * math.pi), 1.0)
    rise = np.sin(0.5 * math.pi * share) ** 2
    pair = Pair.from_records(Record(np.cos(turn) * rise, 0.005), Record(np.sin(turn) * rise, 0.005))
    found = rotd(pair, [0.9, 3.6])
    np.testing.assert_allclose(found.peaks["pga"], 1.0, rtol=1e-12)
    assert np.all(found[100] / found[0] < 1.01)


@settings(max_examples=25)
@given(st.integers(0, 10_000), st.integers(-400, 400), st.floats(0.1, 10.0))
def test_rotd_does_not_know_how_sensors_stood(seed: int, angle: int, factor: float) -> None:
    """RotD00 <= RotD50 <= RotD100 <= the root of the sum of squares; the same for the pair turned; in proportion."""
    one, other = np.random.default_rng(seed).normal(size=(2, 60))
    pair = Pair.from_records(Record(one, 0.05), Record(other, 0.05))
    periods = [0.1, 0.4, 1.5]
    found = rotd(pair, periods, threads=1)
    assert np.all(found[0] <= found[50])
    assert np.all(found[50] <= found[100])
    components = sm.response_spectrum([pair.first, pair.second], periods)
    assert np.all(found[100] <= np.hypot(*components) * (1.0 + 1e-12))
    assert np.all(found[100] * (1.0 + 1e-12) >= components.max(axis=0))
    assert np.all(found[0] <= components.min(axis=0) * (1.0 + 1e-12))
    turned = rotd(pair.rotated(float(angle)).scaled(factor), periods, threads=1)
    np.testing.assert_allclose(turned.values, factor * found.values, rtol=1e-9)
    for name in ("pga", "pgv", "pgd"):
        np.testing.assert_allclose(turned.peaks[name], factor * found.peaks[name], rtol=1e-9)


def test_azimuth_of_the_largest(plane: Any) -> None:
    """The component towards it has the largest ordinate, clockwise pairs and others."""
    for azimuths in ((225.0, 315.0), (9.0, 279.0)):
        pair = Pair.from_records(*(towards(plane, azimuth) for azimuth in azimuths))
        found = rotd(pair, [0.3, 1.0])
        assert found.azimuth is not None
        for column, azimuth in enumerate(found.azimuth):
            spectrum = sm.response_spectrum(pair.toward(float(azimuth)), [0.3, 1.0])[0]
            assert spectrum[column] == pytest.approx(found[100][column], rel=1e-12)
    table = found.table()
    assert table.columns == ["period", "rotd00", "rotd50", "rotd100", "angle", "azimuth"]


def test_flatfile(shared: Path) -> None:
    """Peaks and RotD50 of 13 pairs beside those that NGA-West2 lists.

    The flatfile's ordinates are peaks at samples, no fewer than ten a period: between them a vibration of that period
    exceeds the largest by at most 1/cos(pi/10) - 1 = 5.1 %. Its numbers have five to seven digits.
    """
    listed = listed_pairs(shared / "records", find_pairs(shared / "records"))
    assert len(listed) == 13
    for item in listed[::4]:
        found = rotd(item.pair, item.periods)
        ratio = found[50] / item.spectrum
        assert ratio.min() > 1.0 - 1e-5
        assert ratio.max() < 1.0 / math.cos(math.pi / 10.0)
        np.testing.assert_allclose(ratio[item.periods >= 1.0], 1.0, atol=1e-3)
        for name, tolerance in (("pga", 5e-5), ("pgv", 1.5e-3), ("pgd", 5e-4)):
            assert found.peaks[name][1] == pytest.approx(item.peaks[name], rel=tolerance)


def test_documentation_has_the_peers() -> None:
    """Versions and the row by which the flatfile is reproduced, as benchmarks/ground_motions.py wrote them."""
    text = (ROOT / "docs" / "ground_motions.md").read_text(encoding="utf-8")
    assert re.search(r"\| eqsig [\d.]+, 10 samples a period \| 0\.00 to 0\.00 \|", text)
    assert re.search(r"\| pyrotd [\d.]+ \|", text)


def test_benchmark_marks_what_is_absent(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its own row has no differences from its own spectra, and programs that are not installed are said."""
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    monkeypatch.setitem(sys.modules, "eqsig.sdof", None)
    benchmark = runpy.run_path(str(ROOT / "benchmarks" / "ground_motions.py"))
    record = sm.builtin_suite()[0].with_duration(5.0)
    pair = Pair.from_records(record, record.replace(acceleration=record.acceleration[::-1]))
    periods = np.array([0.02, 0.1, 0.5, 2.0])
    listed = [SimpleNamespace(pair=pair, periods=periods, spectrum=rotd(pair, periods)[50])]
    rows = benchmark["spectra_rows"](listed, lambda value: f"{value:.2f}")
    assert len(rows) == len(benchmark["PROGRAMS"])
    assert rows[0][1:6] == ("0.00 to 0.00",) * 4 + ("0.00",)
    assert all(row[0].startswith("eqsig: absent") and len(row) == len(rows[0]) for row in rows[1:3])


@pytest.mark.parametrize(
    ("wrong", "kind", "message"),
    [
        (
            lambda p: Pair.from_records(p.first, 3),
            sm.errors.InvalidMotion,
            "second component of pair must be a Record; got 3",
        ),
        (
            lambda p: Pair.from_records(p.first, p.second, "up"),
            sm.errors.InvalidMotion,
            "vertical component of pair must be a",
        ),
        (
            lambda p: Pair.from_records(p.first, p.second.replace(component="UP", azimuth=None)),
            sm.errors.InvalidMotion,
            "second component of pair .* must be a horizontal one; got UP",
        ),
        (
            lambda p: Pair.from_records(*(p.first.replace(source=Path("a.txt"), azimuth=None, component=""),) * 2),
            sm.errors.InvalidMotion,
            "second component of pair must be another than the first; got a.txt twice",
        ),
        (
            lambda p: Pair.from_records(p.first, p.second, p.first.replace(component="90")),
            sm.errors.InvalidMotion,
            "vertical component of pair .* must be a vertical one; got 90",
        ),
        (
            lambda p: Pair.from_records(p.first, p.second, lengths="long"),
            sm.errors.InvalidOption,
            "lengths of pair must be",
        ),
        (
            lambda p: Pair(p.first, p.second.with_duration(1.0)),
            sm.errors.InvalidMotion,
            "samples of second component of pair",
        ),
        (
            lambda p: p.component(float("inf")),
            sm.errors.InvalidOption,
            "angle of pair must be a finite number of degrees",
        ),
        (lambda p: p.toward("north"), sm.errors.InvalidOption, "azimuth of pair must be a number; got 'north'"),
        (
            lambda p: p.fault_normal_parallel(float("nan")),
            sm.errors.InvalidOption,
            "strike of pair must be a finite number",
        ),
        (
            lambda p: p.replace(second=p.second.replace(azimuth=None)).toward(0.0),
            sm.errors.InvalidOption,
            r"azimuths of pair STA0 must be stated, as record.replace\(azimuth=...\) does",
        ),
        (lambda p: rotd(p.first, [1.0]), sm.errors.InvalidMotion, "pair of RotD must be a Pair"),
        (
            lambda p: rotd(p, [1.0], (101.0,)),
            sm.errors.InvalidOption,
            "percentiles of RotD must be a list of numbers from 0",
        ),
        (lambda p: rotd(p, [1.0], ()), sm.errors.InvalidOption, "percentiles of RotD must be a list of numbers from 0"),
        (
            lambda p: rotd(p, [1.0], angles=1),
            sm.errors.InvalidOption,
            "angles of RotD must be a whole number of at least 2",
        ),
        (lambda p: rotd(p, [1.0], kind="force"), sm.errors.InvalidOption, "kind of spectrum must be one of"),
        (lambda p: rotd(p, [1.0], damping=1.5), sm.errors.InvalidOption, "damping"),
        (lambda p: rotd(p, [1.0])[33], sm.errors.InvalidOption, "percentile of RotD must be one of 0, 50, 100; got 33"),
        (lambda _: find_pairs("/no/such/folder"), sm.errors.RecordFormatError, "folder of pairs must be a directory"),
    ],
)
def test_wrong_input(plane: Any, wrong: Any, kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=message):
        wrong(Pair.from_records(towards(plane, 0.0), towards(plane, 90.0)))


def test_angles_between_azimuths() -> None:
    assert [between(*pair) for pair in ((0.0, 90.0), (90.0, 0.0), (350.0, 80.0), (10.0, 190.0))] == [
        90.0,
        -90.0,
        90.0,
        -180.0,
    ]
