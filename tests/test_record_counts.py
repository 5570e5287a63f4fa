"""Counts of miniSEED and SAC, made here after their definitions: by a stated factor, refused where it is not known."""

from __future__ import annotations

import struct
import sys
from pathlib import Path

import numpy as np
import pytest

from seismass.base.errors import MissingPackage, RecordFormatError
from seismass.motions.records import Record, read_counts, read_record
from seismass.motions.records.formats.labels import is_vertical

COUNTS = (3, -5, 10, -8, 2, -2, 0, 0)
"""Their sum is 0, so that nothing is to be removed."""
FACTOR = 0.25
EXPECTED = [0.75, -1.25, 2.5, -2.0, 0.5, -0.5, 0.0, 0.0]
"""0.25 m/s2 of each count."""


def miniseed(channel: str = "HNE", second: int = 0, counts: tuple[int, ...] = COUNTS) -> bytes:
    """One data record of 512 bytes: fixed header, blockette 1000 (32-bit integers, big endian), samples, 100 Hz."""
    head = b"000001D " + b"NOW  " + b"00" + channel.encode() + b"XX"
    head += struct.pack(">HHBBBBH", 2000, 1, 0, 0, second, 0, 0)
    head += struct.pack(">HhhBBBBiHH", len(counts), 100, 1, 0, 0, 0, 1, 0, 64, 48)
    head += struct.pack(">HHBBBB", 1000, 0, 3, 1, 9, 0)
    return (head.ljust(64, b"\0") + struct.pack(f">{len(counts)}i", *counts)).ljust(512, b"\0")


def sac(
    idep: int = 8,
    channel: str = "HNN",
    counts: tuple[int, ...] = COUNTS,
    azimuth: float = -12345.0,
    from_up: float = -12345.0,
) -> bytes:
    """A binary SAC file of version 6: 70 reals, 40 integers, 192 letters, samples; step 0.01 s; CMPAZ and CMPINC."""
    reals = [-12345.0] * 70
    reals[57], reals[58] = azimuth, from_up
    reals[0], reals[5], reals[6] = 0.01, 0.0, 0.01 * (len(counts) - 1)
    whole = [-12345] * 40
    whole[0:6] = [2000, 1, 0, 0, 0, 0]
    whole[6], whole[9], whole[15], whole[16] = 6, len(counts), 1, idep
    whole[35:40] = [1, 1, 1, 1, 0]
    words = [b"-12345  "] * 24
    words[0], words[20], words[21] = b"NOW     ", channel.ljust(8).encode(), b"XX      "
    return struct.pack("<70f40i", *reals, *whole) + b"".join(words) + struct.pack(f"<{len(counts)}f", *counts)


def put(folder: Path, name: str, content: bytes) -> Path:
    path = folder / name
    path.write_bytes(content)
    return path


def read(path: Path, factor: object = FACTOR) -> tuple[Record, ...]:
    pytest.importorskip("obspy", reason="obspy is not installed: no counts are read")
    return read_counts(path, factor=factor)  # type: ignore[arg-type]


@pytest.mark.parametrize(("content", "component", "azimuth"), [(miniseed(), "HNE", 90.0), (sac(), "HNN", 0.0)])
def test_counts_times_the_factor_are_accelerations(
    tmp_path: Path, content: bytes, component: str, azimuth: float
) -> None:
    (record,) = read(put(tmp_path, "made.dat", content))
    assert record.acceleration.tolist() == EXPECTED
    assert (record.dt, record.component, record.azimuth) == (0.01, component, azimuth)
    assert (record.station, record.network, record.file_unit) == ("NOW", "XX", "counts")
    assert record.event.startswith("2000-01-01T00:00:00")
    assert record.remarks[:2] == ("mean of 0 m/s2 removed", "counts times 0.25 m/s2, as the caller said")


def test_the_mean_is_removed(tmp_path: Path) -> None:
    (record,) = read(put(tmp_path, "a.mseed", miniseed(counts=tuple(count + 8 for count in COUNTS))))
    assert record.acceleration.tolist() == EXPECTED
    assert record.remarks[0] == "mean of 2 m/s2 removed"


def test_factors_of_channels(tmp_path: Path) -> None:
    file = put(tmp_path, "two.mseed", miniseed() + miniseed("HNN"))
    east, north = read(file, {"HNE": FACTOR, "XX.NOW.00.HNN": -2.0 * FACTOR})
    assert (east.component, north.component) == ("HNE", "HNN")
    assert east.acceleration.tolist() == EXPECTED
    assert north.acceleration.tolist() == [-2.0 * value for value in EXPECTED]
    with pytest.raises(RecordFormatError, match=r"factor of two.mseed must be given for channel HNN; got"):
        read(file, {"HNE": FACTOR})


@pytest.mark.parametrize("factor", [0.0, float("nan"), None, "1"])
def test_a_factor_is_a_number(tmp_path: Path, factor: object) -> None:
    with pytest.raises(RecordFormatError, match=r"factor of a.mseed must be"):
        read_counts(put(tmp_path, "a.mseed", miniseed()), factor=factor)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (miniseed("HHE"), r"quantity of channel HHE of a.dat must be acceleration; got velocity"),
        (sac(7), r"quantity of channel HNN of a.dat must be acceleration; got velocity"),
        (sac(6), r"quantity of channel HNN of a.dat must be acceleration; got displacement"),
        (miniseed() + miniseed(second=9), r"channel XX.NOW.00.HNE of a.dat must be without gaps; got 2 parts"),
        (sac()[:640], r"content of a.dat must be a sound SAC file; got"),
    ],
)
def test_what_is_no_whole_acceleration_is_refused(tmp_path: Path, content: bytes, message: str) -> None:
    with pytest.raises(RecordFormatError, match=message):
        read(put(tmp_path, "a.dat", content))


def test_a_channel_without_a_code_has_a_remark(tmp_path: Path) -> None:
    (record,) = read(put(tmp_path, "a.sac", sac(-12345, "")))
    assert record.acceleration.tolist() == EXPECTED
    assert "that it is an acceleration is the caller's word" in record.remarks[2]


def test_other_files_and_a_missing_package_are_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(RecordFormatError, match=r"content of a.txt must be miniSEED or SAC; got something else"):
        read_counts(put(tmp_path, "a.txt", b"0.0\n" * 99), factor=1.0)
    with pytest.raises(
        RecordFormatError, match=r"got SAC: read it by seismass.motions.records.read_counts with the m/s2"
    ):
        read_record(put(tmp_path, "a.sac", sac()))
    monkeypatch.setitem(sys.modules, "obspy", None)
    with pytest.raises(
        MissingPackage, match=r"ObsPy of SAC files must be installed \(pip install \"seismass\[obspy\]\"\)"
    ):
        read_counts(tmp_path / "a.sac", factor=1.0)


def test_the_sum_of_the_counts_is_zero() -> None:
    assert np.sum(COUNTS) == 0


@pytest.mark.parametrize("channel", ["HNN", "HNE", "HN1", "HN2", "BNX", "HNZ"])
@pytest.mark.parametrize("azimuth", [-12345.0, 0.0, 90.0, 238.0, 328.0, 360.0])
@pytest.mark.parametrize("from_up", [-12345.0, 0.0, 90.0, 180.0])
def test_cmpaz_and_cmpinc_of_sac_say_the_direction(
    tmp_path: Path, channel: str, azimuth: float, from_up: float
) -> None:
    """CMPAZ is clockwise from north and CMPINC 90 for a horizontal; where they are undefined the code says."""
    (record,) = read(put(tmp_path, "a.sac", sac(channel=channel, azimuth=azimuth, from_up=from_up)))
    vertical = from_up in (0.0, 180.0) or (from_up == -12345.0 and channel == "HNZ")
    by_code = {"HNN": 0.0, "HNE": 90.0}.get(channel)
    expected = None if vertical else by_code if azimuth == -12345.0 else azimuth % 360.0
    assert record.azimuth == expected
    assert is_vertical(record.component) is (vertical or channel == "HNZ")
    told = any("by its CMPAZ" in remark for remark in record.remarks)
    assert told is (expected is not None and by_code is not None and expected != by_code)
