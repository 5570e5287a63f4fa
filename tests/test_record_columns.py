"""Labels of columns: words of seven languages, numbers and what they count; which are times, motions of the ground."""

from __future__ import annotations

import itertools
import unicodedata
from pathlib import Path

import numpy as np
import pytest

from seismass.base.errors import RecordFormatError
from seismass.motions.records import Record, find_pairs, read_records, read_suite
from seismass.motions.records.suite import suite_of_file

POINTS = 80
MOTION = 0.3 * np.sin(0.31 * np.arange(POINTS)) * np.exp(-(((np.arange(POINTS) - 40.0) / 15.0) ** 2))
WORDS = {
    "en": ("Acceleration", "Time (s)", ("N-S", "E-W", "V"), ("north", "east", "vertical")),
    "es": ("Aceleraci\u00f3n", "Tiempo (s)", ("N-S", "E-O", "V"), ("Norte-Sur", "Este-Oeste", "Vertical")),
    "pt": ("Acelera\u00e7\u00e3o", "Tempo (s)", ("N-S", "E-O", "V"), ("norte", "leste", "vertical")),
    "it": ("Accelerazione", "Tempo (s)", ("N-S", "E-O", "V"), ("Nord-Sud", "Est-Ovest", "verticale")),
    "fr": ("Acc\u00e9l\u00e9ration", "Temps (s)", ("N-S", "E-O", "V"), ("nord", "est", "verticale")),
    "de": ("Beschleunigung", "Zeit (s)", ("N-S", "O-W", "V"), ("Nord", "Ost", "vertikal")),
    "tr": (
        "\u0130vme".replace("\u0130", "i"),
        "Zaman (s)",
        ("K-G", "D-B", "Z"),
        ("Kuzey", "Do\u011fu", "D\u00fc\u015fey"),
    ),
}
"""Of each language: an acceleration, a time, and north, east and up as letters and as words."""
COUNTS = (
    "floor", "roof floor", "storey", "story", "level", "node", "joint", "run", "mass", "dof", "piso", "planta", "nivel",
    "nodo", "andar", "piano", "\u00e9tage", "n\u0153ud", "Stockwerk", "Geschoss", "Knoten",
    "kat", "d\u00fc\u011f\u00fcm",
    "test",
)  # fmt: skip
PLACES = (
    "Roof",
    "Top floor",
    "Basement",
    "Lobby",
    "Azotea",
    "Dach",
    "Toit",
    "\u00c7at\u0131",
    "Specimen A",
    "Deck",
    "Base",
)
TIMES = (
    "time", "Time (s)", "t", "t (s)", "T (sec)", "time_s", "Time [sec]", "Relative time (s)", "elapsed time (s)",
    "time (ms)", "Tiempo", "Tempo (s)", "Temps (s)", "Zeit (s)", "Zaman (s)", "seconds", "time since trigger (s)",
)  # fmt: skip
NO_TIMES = (
    "T1", "T1 (s)", "Tn (s)", "Tp (s)", "T_n", "tau", "tau (s)", "D5-95 (s)", "D5-95", "mu", "node", "storey", "run",
    "year", "Rise time (s)", "x", "value", "case", "RP", "arrival (s)", "Td (s)", "angle", "h/H", "position",
)  # fmt: skip


def table(labels: list[str], times: str = "{:.3f}", step: float = 0.01) -> str:
    """Return a CSV of a first column that rises evenly and one motion after the other, of other sizes."""
    rows = (
        ",".join(
            [times.format(step * at), *(f"{(1.0 - 0.1 * index) * MOTION[at]:.6f}" for index in range(len(labels) - 1))]
        )
        for at in range(POINTS)
    )
    return ",".join(labels) + "\n" + "\n".join(rows) + "\n"


def read(folder: Path, labels: list[str], **given: str) -> tuple[Record, ...]:
    """Write and read such a table."""
    file = folder / "a.csv"
    file.write_text(table(labels, **given), encoding="utf-8")
    return read_records(file)


def suite(folder: Path) -> list[Record]:
    """Return what the folder has as a suite, if anything."""
    try:
        return list(read_suite(folder))
    except RecordFormatError as error:
        assert "must be at least one horizontal record" in str(error)
        return []


def direction_cases() -> list[tuple[str, list[str]]]:
    """Return labels of every language: acceleration and direction in three forms, composed and decomposed letters."""
    found = []
    for word, time, *forms in WORDS.values():
        for north, east, up in forms:
            for form in ("{0} {1} (cm/s2)", "{1} (cm/s2)", "{0} {1} [g]", "{0}_{1} (g)"):
                labels = [time, *(form.format(word, one) for one in (north, east, up))]
                found += [(word, labels), (word, [unicodedata.normalize("NFD", one) for one in labels])]
    return found


def check_directions(folder: Path, labels: list[str]) -> None:
    """North and east make the suite and the pair, and the vertical stays out of the suite."""
    north, east, up = read(folder, labels)
    assert (north.azimuth, east.azimuth, up.azimuth) == (0.0, 90.0, None), labels
    assert [one.azimuth for one in suite(folder)] == [0.0, 90.0], labels
    (pair,) = find_pairs(folder)
    assert pair.azimuths == (0.0, 90.0)
    assert pair.vertical is not None


@pytest.mark.parametrize(("word", "labels"), direction_cases()[::17])
def test_directions_of_seven_languages(tmp_path: Path, word: str, labels: list[str]) -> None:
    check_directions(tmp_path, labels)


def test_every_direction_of_every_language(tmp_path: Path) -> None:
    assert len(direction_cases()) > 100
    for _, labels in direction_cases():
        check_directions(tmp_path, labels)


def count_cases() -> list[tuple[str, bool]]:
    """Return labels with a number, and whether it is an azimuth of 120 degrees."""
    said = []
    for word, *_ in WORDS.values():
        said += [(f"{word} {number} (g)", True) for number in ("120", "120 deg", "120\u00b0", "azimuth 120")]
        said += [(f"{word} {number} (g)", False) for number in ("1", "2", "12", "45")]
        for count in COUNTS:
            said += [(f"{count} {number} {word} (g)", False) for number in ("3", "12", "120")]
            said += [(f"{word} {count} {number} (g)", False) for number in ("7", "090")]
    return said


def check_count(folder: Path, label: str, azimuth: bool) -> None:
    """A number that counts is no direction, and what it counts is no ground."""
    (record,) = read(folder, ["time (s)", label])
    assert record.azimuth == (120.0 if azimuth else None), label
    of_ground = not any(count in label for count in COUNTS)
    assert len(suite(folder)) == of_ground, label


@pytest.mark.parametrize(("label", "azimuth"), count_cases()[::41])
def test_a_number_is_an_azimuth_only_where_it_says_so(tmp_path: Path, label: str, azimuth: bool) -> None:
    check_count(tmp_path, label, azimuth)


def test_every_number_and_what_it_counts(tmp_path: Path) -> None:
    assert len(count_cases()) > 800
    for label, azimuth in count_cases():
        check_count(tmp_path, label, azimuth)


@pytest.mark.parametrize(
    ("labels", "azimuths"),
    [
        (("Acc 0 (g)", "Acc 90 (g)"), (0.0, 90.0)),
        (("Acc 45 (g)", "Acc 135 (g)"), (45.0, 135.0)),
        (("comp 67 (g)", "comp 337 (g)"), (67.0, 337.0)),
        (("Acc 1 (g)", "Acc 2 (g)"), (None, None)),
        (("Acc 10 (g)", "Acc 90 (g)"), (None, None)),
        (("node 0 acc (g)", "node 90 acc (g)"), (None, None)),
        (("ch 10 (g)", "ch 100 (g)"), (None, None)),
    ],
)
def test_two_numbers_ninety_apart_are_azimuths(
    tmp_path: Path, labels: tuple[str, str], azimuths: tuple[float | None, float | None]
) -> None:
    first, second = read(tmp_path, ["time (s)", *labels])
    assert (first.azimuth, second.azimuth) == azimuths


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("word", ["acceleration", "Aceleraci\u00f3n", "acc."])
def test_columns_of_structures_are_read_by_name_and_stay_out_of_suites(tmp_path: Path, place: str, word: str) -> None:
    first, second = read(tmp_path, ["time (s)", f"{place} {word} (g)", f"Free field {word} (g)"])
    assert first.place.startswith(place)
    assert [one.place for one in suite(tmp_path)] == [second.place]
    assert len(suite_of_file(tmp_path / "a.csv")) == 1


@pytest.mark.parametrize(
    ("raw", "corrected"),
    [
        ("acc raw (g)", "acc filtered (g)"),
        ("acc (g)", "acc filtered (g)"),
        ("Uncorrected acceleration (g)", "Corrected acceleration (g)"),
        ("Aceleraci\u00f3n cruda (g)", "Aceleraci\u00f3n corregida (g)"),
        ("Beschleunigung roh (g)", "Beschleunigung gefiltert (g)"),
        ("NS raw (g)", "NS corrected (g)"),
    ],
)
def test_of_a_raw_and_a_corrected_column_the_corrected_one_counts(tmp_path: Path, raw: str, corrected: str) -> None:
    records = read(tmp_path, ["time (s)", raw, corrected])
    assert len(records) == 2
    assert [one.pga for one in suite(tmp_path)] == [records[1].pga]
    turned = read(tmp_path, ["time (s)", corrected, raw])
    assert [one.pga for one in suite(tmp_path)] == [turned[0].pga]
    both = read(tmp_path, ["time (s)", "NS filtered (g)", "EW filtered (g)"])
    assert len(suite(tmp_path)) == len(both) == 2


@pytest.mark.parametrize("label", TIMES)
def test_what_a_column_of_times_is_called(tmp_path: Path, label: str) -> None:
    ms = "ms" in label
    (record,) = read(
        tmp_path, [label, "acceleration (g)"], times="{:.0f}" if ms else "{:.2f}", step=10.0 if ms else 0.01
    )
    assert (record.dt, record.samples) == (0.01, POINTS)


@pytest.mark.parametrize("label", NO_TIMES)
@pytest.mark.parametrize("separator", [",", "  ", "\t"])
def test_what_is_not_called_a_time_is_asked(tmp_path: Path, label: str, separator: str) -> None:
    """The step decides: where it agrees with the column that is what it holds."""
    file = tmp_path / "a.csv"
    file.write_text(table([label, "acc (g)"]).replace(",", separator), encoding="utf-8")
    with pytest.raises(RecordFormatError, match=r"a\.csv must"):
        read_records(file)
    if label not in ("Tp (s)", "RP"):
        try:
            (record,) = read_records(file, dt=0.01)
        except RecordFormatError as error:
            assert "must be a motion" in str(error)
        else:
            assert record.dt == 0.01
    with pytest.raises(RecordFormatError, match=r"a\.csv must"):
        read_records(file, dt=0.02)
    assert suite(tmp_path) == []


def test_every_pair_of_labels_is_read_or_refused(tmp_path: Path) -> None:
    """A first column counts as times exactly where it is called so, whatever stands beside it."""
    seconds = ("acceleration (g)", "Acc (cm/s2)", "NS (gal)", "Aceleraci\u00f3n (m/s2)", "HNE (g)")
    for first, second in itertools.product((*TIMES, *NO_TIMES), seconds):
        if "ms" in first:
            continue
        try:
            records = read(tmp_path, [first, second])
        except RecordFormatError:
            assert first in NO_TIMES, (first, second)
        else:
            assert first in TIMES and records[0].dt == 0.01, (first, second)
