"""Sentences of headers on units and steps: what is said, of what, and in which language; each with its right answer."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS, stated_units
from seismass.motions.records import read_record

SAMPLES = 0.3 * np.sin(0.3 * np.arange(60.0)) * np.exp(-(((np.arange(60.0) - 30.0) / 12.0) ** 2))
COLUMN = "".join(f"{value:.6f}\n" for value in SAMPLES)
UNITS = {"g": "g", "cm/s2": "cm/s2", "Gal": "cm/s2", "cm/s/s": "cm/s2", "m/s^2": "m/s2", "m/sec2": "m/s2", "%g": "%g"}

OF_SAMPLES = (
    "unit: {}",
    "Unit(s): {}",
    "units of {}",
    "ACCELERATION TIME SERIES IN UNITS OF {}",
    "acceleration in {}",
    "Acceleration ({})",
    "acceleration [{}]",
    "Station TEST, acceleration, {}",
    "Corrected acceleration data in {}",
    "The unit of acceleration is {}",
    "Data unit = {}",
    "data given in {}",
    "units: s, {}",
    "time in s, acceleration in {}",
    "({})",
    "Unidad: {}",
    "Unidades de los datos: {}",
    "Aceleraci\u00f3n ({})",
    "Aceleraci\u00f3n en {}",
    "Acelera\u00e7\u00e3o em {}",
    "Unidade: {}",
    "Accelerazione in {}",
    "Unit\u00e0: {}",
    "Acc\u00e9l\u00e9ration ({})",
    "Unit\u00e9 : {}",
    "Beschleunigung in {}",
    "Einheit: {}",
    "\u0130vme ({})".replace("\u0130", "i"),
    "Birim: {}",
)
OF_SOMETHING_ELSE = (
    "peak 294.2 {}",
    "Amax=294 {}",
    "PGA (in {}): 0.3",
    "PGA 2.94 {} at 5.01 s",
    "peak acceleration ({}) = 0.3",
    "Maximum acceleration in {}: 0.3",
    "unit of the peak: {}",
    "threshold 5 {}",
    "trigger level in {}",
    "resolution 0.001 {}",
    "noise ({})",
    "full scale 2 {}",
    "offset of 0.1 {} removed",
    "1 g = 980.665 {}",
    "gravity 9.80665 {}",
    "acceleration of gravity in {}",
    "converted from {}",
    "divided by 981 to leave {}",
    "sensitivity 1 V per {}",
    "pico 294 {}",
    "Aceleraci\u00f3n m\u00e1xima: 294 {}",
    "umbral en {}",
    "acc\u00e9l\u00e9ration maximale en {}",
    "Spitzenwert 294 {}",
    "valore massimo in {}",
    "valor de pico em {}",
    "en b\u00fcy\u00fck de\u011fer ({})",
)


def answer(sentence: str, unit: str | None) -> str:
    """Return what is wrong about a sentence above a column, or nothing: its unit, or that it has none."""
    found = stated_units(sentence)
    return "" if found == ([unit] if unit else []) else f"{sentence!r}: {found}, not {unit}"


def cases() -> list[tuple[str, str | None]]:
    """Return every sentence with its answer: of the samples, of something else, and one of both in either order."""
    single = [(one.format(unit), name) for one in OF_SAMPLES for unit, name in UNITS.items()]
    others = [(one.format(unit), None) for one in OF_SOMETHING_ELSE for unit in UNITS]
    both = [
        (f"{first.format(unit)}\n{other.format(second)}", UNITS[unit])
        for first, other in itertools.product(OF_SAMPLES, OF_SOMETHING_ELSE)
        for unit, second in (("g", "cm/s2"), ("Gal", "g"))
    ]
    turned = [("\n".join(reversed(text.split("\n"))), unit) for text, unit in both]
    return [*single, *others, *both, *turned]


def test_a_unit_counts_where_it_is_said_of_the_samples() -> None:
    assert [wrong for text, unit in cases()[::29] if (wrong := answer(text, unit))] == []


def test_every_sentence_on_units() -> None:
    assert len(cases()) > 3000
    assert [wrong for text, unit in cases() if (wrong := answer(text, unit))] == []


@pytest.mark.parametrize("sentence", OF_SOMETHING_ELSE[::3])
@pytest.mark.parametrize("unit", ["g", "m/s2", "cm/s2"])
def test_the_right_unit_is_never_refused(tmp_path: Path, sentence: str, unit: str) -> None:
    file = tmp_path / "a.txt"
    file.write_text(f"{sentence.format('cm/s2')}\ndt = 0.01\n{COLUMN}", encoding="utf-8")
    with pytest.raises(RecordFormatError, match=r"unit of a\.txt must be given"):
        read_record(file)
    peak = np.max(np.abs(SAMPLES)) * ACCELERATION_UNITS[unit]
    assert read_record(file, unit=unit).pga == pytest.approx(peak, rel=1e-5)


def test_of_two_units_the_caller_says_which(tmp_path: Path) -> None:
    file = tmp_path / "a.txt"
    file.write_text(f"unit: g\ndt = 0.01\nacceleration in cm/s2\n{COLUMN}", encoding="utf-8")
    with pytest.raises(RecordFormatError, match=r"states cm/s2 and g: unit= says which"):
        read_record(file)
    assert read_record(file, unit="gal").pga == pytest.approx(read_record(file, unit="g").pga / 980.665, rel=1e-9)
    with pytest.raises(RecordFormatError, match=r"must be that of its header, cm/s2 and g"):
        read_record(file, unit="m/s2")


def test_an_at2_header_that_names_another_unit_than_g_is_a_doubt(tmp_path: Path) -> None:
    """Such a file is in g where its header says nothing: a unit that is said of an unknown thing is asked."""
    file = tmp_path / "a.AT2"
    head = "PEER\nExample, 1/2/2003, Test, 0\n{}\nNPTS= 60, DT= .0100 SEC\n"
    for said in ("ACCELERATION FROM KOBE IN CM/S2", "TRIGGER LEVEL IN GAL"):
        file.write_text(head.format(said) + COLUMN, encoding="utf-8")
        with pytest.raises(RecordFormatError, match=r"unit of a\.AT2 must be one of .*, or be given"):
            read_record(file)
        assert read_record(file, unit="gal").file_unit in ("gal", "cm/s2")
    file.write_text(head.format("PEAK 294 CM/S2") + COLUMN, encoding="utf-8")
    assert read_record(file).file_unit == "g"
