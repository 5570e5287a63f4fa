"""Recordings of every format: points, step, peak, its time and first sample against headers and other readers."""

from __future__ import annotations

import csv
import re
import time
from pathlib import Path

import numpy as np
import pytest

from pages.records import ARGUMENTS
from seismass.base.units import STANDARD_GRAVITY
from seismass.motions.records import read_record, read_records, read_suite
from seismass.motions.records.formats.common import NO_COUNT

ROOT = Path(__file__).parents[1]
with (ROOT / "tests" / "data" / "other_readers.csv").open(encoding="utf-8", newline="") as _file:
    OTHERS = list(csv.DictReader(_file))

# file, channel, what its header says of points, step (s), peak (unit of the file) and its time (s): copied by hand
CLAIMS: list[tuple[str, int, int | None, float | None, float | None, float | None, float]] = [
    ("at2_variants/crlf/RSN1616_DUZCE_362-E.AT2", 1, 4316, 0.01, None, None, STANDARD_GRAVITY),
    ("at2_variants/crlf_and_missing_comma/RSN6953_DARFIELD_PRPCS.AT2", 1, 10800, 0.005, None, None, STANDARD_GRAVITY),
    ("at2_variants/lower_case_dt/PBFEAS.AT2", 1, 2364, 0.01, None, None, STANDARD_GRAVITY),
    ("at2_variants/no_SEC_in_header/42.AT2", 1, 2676, 0.02, None, None, STANDARD_GRAVITY),
    ("at2_variants/old_header_pacific_engineering/ALH360.AT2", 1, 3000, 0.02, None, None, STANDARD_GRAVITY),
    ("at2_variants/one_value_per_line/GM11.AT2", 1, 8000, 0.005, None, None, STANDARD_GRAVITY),
    ("cosmos/us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c", 1, 42000, 0.005, -6.852, 76.215, 0.01),
    ("csmip/BadHeader.V2", 1, 12000, 0.005, 77.280, 30.585, 0.01),
    ("csmip/BadHeader.V2", 2, 12000, 0.005, 20.529, 30.585, 0.01),
    ("csmip/BadHeader.V2", 3, 12000, 0.005, -44.200, 30.575, 0.01),
    ("csmip/ce36456p_CE36456.V2", 1, 3251, 0.02, -267.957, 10.940, 0.01),
    ("csmip/ce36456p_CE36456.V2", 2, 3250, 0.02, -94.805, 11.680, 0.01),
    ("csmip/ce36456p_CE36456.V2", 3, 3250, 0.02, -256.231, 7.740, 0.01),
    ("esm/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC", 1, 19128, 0.005, 0.300022, 20.67, 0.01),
    ("knet/AOM0011801241951.EW", 1, 10200, 0.01, 4.078, None, 0.01),
    ("knet/test.knet", 1, 5900, 0.01, 4.383, None, 0.01),
    ("smc/0111a.smc", 1, 6001, 0.005, 104.4078, 10.17, 0.01),
    ("smc/2516b_a.smc", 1, 41200, 0.005, 39.103935, 47.615, 0.01),
    ("two_column/ChiChi.txt", 1, 11800, 0.005, None, None, STANDARD_GRAVITY),
]


@pytest.mark.parametrize(("file", "channel", "points", "dt", "peak", "at", "unit"), CLAIMS)
def test_a_recording_is_what_its_header_says(
    shared: Path,
    file: str,
    channel: int,
    points: int | None,
    dt: float | None,
    peak: float | None,
    at: float | None,
    unit: float,
) -> None:
    path = shared / "record_formats" / file
    record = read_records(path, **ARGUMENTS.get(path.name, {}))[channel - 1]
    where = int(np.argmax(np.abs(record.acceleration)))
    assert (record.samples, record.dt) == (points, pytest.approx(dt, rel=1e-12))
    if peak is not None:  # to the last of five digits of SMC's samples, or the last of the header
        assert record.acceleration[where] / unit == pytest.approx(peak, abs=0.51e-3 + 5e-5 * abs(peak))
    if at is not None:
        assert where * record.dt == pytest.approx(at, abs=1e-9)


@pytest.mark.parametrize("row", OTHERS, ids=[f"{row['file']} {row['channel']}" for row in OTHERS])
def test_other_readers_give_the_same(shared: Path, row: dict[str, str]) -> None:
    """Their numbers have seven digits; the mean of K-NET was removed from obspy's by hand."""
    path = shared / "record_formats" / row["file"]
    record = read_records(path, **ARGUMENTS.get(path.name, {}))[int(row["channel"]) - 1]
    where = int(np.argmax(np.abs(record.acceleration)))
    assert record.samples == int(row["points"])
    assert record.dt == pytest.approx(float(row["dt"]), rel=1e-12)
    assert record.acceleration[where] == pytest.approx(float(row["peak"]), rel=1e-6)
    assert where * record.dt == pytest.approx(float(row["time"]), rel=1e-5)
    assert record.acceleration[0] == pytest.approx(float(row["first"]), rel=1e-6, abs=1e-12)


def test_every_recording_is_known_or_refused_with_the_right_reason(shared: Path) -> None:
    files = [path for path in (shared / "record_formats").rglob("*") if path.is_file()]
    compared = {row["file"] for row in OTHERS}
    names = {path.relative_to(shared / "record_formats").as_posix() for path in files}
    assert names - compared == {"at2_variants/truncated_files/43.AT2"}


def test_labels_of_recordings(shared: Path) -> None:
    formats = shared / "record_formats"

    def labels(file: str, channel: int = 1) -> tuple[str, str, str, float | None, str]:
        record = read_record(formats / file, channel=channel if file.startswith("csmip") else None)
        return record.event, record.station, record.component, record.azimuth, record.network

    assert labels("cosmos/us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c") == (
        "Point MacKenzie Earthquake of Fri Nov 30, 2018 17:29 UTC",
        "BMR, Bremner River, AK, USA",
        "BNZ",
        None,
        "AK",
    )
    coalinga = ("COALINGA EARTHQUAKE, MAY 2, 1983 16:42 PDT", "36456, PARKFIELD FAULT ZONE 14")
    assert labels("csmip/ce36456p_CE36456.V2", 1) == (*coalinga, "90 DEG", 90.0, "CDMG")
    assert labels("csmip/ce36456p_CE36456.V2", 2) == (*coalinga, "UP", None, "CDMG")
    assert labels("csmip/ce36456p_CE36456.V2", 3) == (*coalinga, "0 DEG", 0.0, "CDMG")
    assert labels("esm/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC") == (
        "GREECE, 20190728 160908",
        "ARS1, Town Hall,Argos,Argolis,Peloponnese",
        "HNE",
        90.0,
        "HI",
    )
    assert labels("knet/AOM0011801241951.EW") == ("2018/01/24 19:51:00, M 6.2", "AOM001", "E-W", 90.0, "K-NET")
    assert labels("smc/0111a.smc")[1:] == ("SAF0A, San Francisco, 1295 Shafter, F", "360", 0.0, "USGS")


def test_a_wrong_header_of_a_recording_is_remarked(shared: Path) -> None:
    first, second, third = read_records(shared / "record_formats/csmip/BadHeader.V2")
    assert first.remarks == ("direction is 360 Deg in the text of the header and 900 in its integers",)
    assert second.remarks == third.remarks == ()


def test_sound_recordings_have_no_remark(shared: Path) -> None:
    for path in sorted((shared / "record_formats").rglob("*")):
        if path.is_file() and path.name not in ("43.AT2", "BadHeader.V2"):
            for record in read_records(path, **ARGUMENTS.get(path.name, {})):
                expected = [NO_COUNT, "mean of", "first numbers"]
                assert all(any(word in remark for word in expected) for remark in record.remarks), path


def test_points_steps_and_peaks_of_all_peer_records(shared: Path) -> None:
    """Header and numbers cut out by one regular expression and NumPy."""
    files = sorted((shared / "records").rglob("*.AT2"))
    assert len(files) == 57
    for file in files:
        head, _, body = file.read_text().replace("\r", "").partition("NPTS=")
        counts, _, numbers = body.partition("\n")
        points, dt = re.findall(r"\d*\.?\d+", counts)[:2]
        values = np.array(numbers.split(), dtype=float)[: int(points)] * STANDARD_GRAVITY
        record = read_record(file)
        assert (record.samples, record.dt) == (int(points), float(dt)), head
        np.testing.assert_allclose(record.acceleration, values, rtol=1e-14)
        assert not [remark for remark in record.remarks if "zeros beyond" not in remark and "1/" not in remark]


def test_a_folder_of_recordings_of_all_formats(shared: Path, tmp_path: Path) -> None:
    for path in (shared / "record_formats").rglob("*"):
        if path.is_file() and path.name != "43.AT2":
            (tmp_path / path.name).symlink_to(path)
    suite = read_suite(tmp_path)
    assert len(suite) == 6 + 4 + 1 + 2 + 2 + 1  # AT2, CSMIP, ESM, K-NET, SMC, the CSV that states g
    reasons = {item.file.name: item.reason for item in suite.excluded}
    assert len(reasons) == 1 + 2 + 3  # the vertical of COSMOS, two of CSMIP, text without a unit
    assert sum("vertical component" in reason for reason in reasons.values()) == 3


def test_reading_is_quick(shared: Path) -> None:
    """An 8000-point file takes some 6 ms on an idle core; ten times that is allowed on a loaded one."""
    file = shared / "record_formats/at2_variants/one_value_per_line/GM11.AT2"
    times = []
    for _ in range(5):
        start = time.process_time()
        read_record(file)
        times.append(time.process_time() - start)
    assert min(times) < 0.06
