"""Sentences of headers on units and steps: what is said, of what, and in which language; each with its right answer."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS, stated_units
from seismass.motions.records import read_record
from seismass.motions.records.formats.common import stated_step

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


STEPS = (
    "dt = {s}", "dt: {ms} ms", "dt(ms)={ms}", "dt [s] = {s}", "DT={s}SEC", "dt {s}", "time step {s} s",
    "time step is {s} s",
    "Time step (dt) = {s} s", "Time increment (s): {s}", "sampling interval: {s}", "SAMPLING_INTERVAL_S: {s}",
    "{s} s time step", "at {s} s intervals", "EQUALLY SPACED AT {s} SEC", "delta t = {s}",
    "INTERVALO DE MUESTREO (s): {s}", "Intervalo de muestreo: {ms} ms", "paso de tiempo = {s} s",
    "Intervalo de amostragem: {s} s", "passo temporale {s} s", "Intervallo di campionamento (s): {s}",
    "pas de temps : {s} s", "P\u00e9riode d'\u00e9chantillonnage: {s} s",
    "Zeitschritt: {s} s", "Abtastintervall = {ms} ms",
    "zaman ad\u0131m\u0131: {s} s", "\u00f6rnekleme aral\u0131\u011f\u0131 = {s} sn",
)  # fmt: skip
RATES = (
    "{hz} samples per second", "{hz} samples/s", "{hz} sps", "SPS {hz}", "sps = {hz}", "sampling rate: {hz} Hz",
    "Sampling frequency (Hz) = {hz}", "Sampling rate (samples/s): {hz}", "samples per second: {hz}", "fs = {hz} Hz",
    "sampled at {hz} Hz", "{hz} Hz sampling", "Frecuencia de muestreo: {hz} Hz", "{hz} muestras por segundo",
    "velocidad de muestreo (muestras/s): {hz}", "Frequenza di campionamento: {hz} Hz",
    "Fr\u00e9quence d'\u00e9chantillonnage : {hz} Hz", "Taxa de amostragem = {hz} Hz", "Abtastrate: {hz} Hz",
    "Abtastfrequenz (Hz): {hz}", "\u00f6rnekleme frekans\u0131: {hz} Hz", "{hz} points per second",
)  # fmt: skip
NO_STEPS = (
    "peak at 5.01 s", "filtered from 0.1 to 25 Hz", "duration 40 s", "corner frequency: 25 Hz",
    "instrument period 0.05 s",
    "damping 0.7", "start 0.02 s after the trigger", "record length = 40 s", "high pass at 0.1 Hz", "40 s long",
    "T = 0.5 s",
    "natural frequency: 100 Hz", "epicentral distance 100 km", "depth 10 km", "Station 100",
)  # fmt: skip
SIZES = (0.01, 0.005, 0.02, 0.004, 0.0025)


def step_cases() -> list[tuple[str, float]]:
    """Return every way to state every step, alone, with decimal commas, and beside what is none."""
    found = []
    for number, size in enumerate(SIZES):
        values = {"s": f"{size:g}", "ms": f"{1000.0 * size:g}", "hz": f"{1.0 / size:g}"}
        for form in (*STEPS, *RATES):
            text = form.format(**values)
            found += [(text, size), (f"Station TEST, {text}", size), (f"{text}\n{NO_STEPS[number]}", size)]
            found.append((f"{NO_STEPS[-1 - number]}\n{text}", size))
            if "{s}" in form:
                found.append((form.format(**{**values, "s": values["s"].replace(".", ",")}), size))
    return found


def wrong_steps(cases: list[tuple[str, float]]) -> list[tuple[str, float | None]]:
    """Return what is read wrongly, with the step that is read; rates are as exact as their division."""
    read = [(text, size, stated_step(text, "a.txt")) for text, size in cases]
    return [(text, got) for text, size, got in read if got is None or abs(got - size) > 1e-12]


def test_ways_to_state_a_step() -> None:
    assert wrong_steps(step_cases()[::31]) == []
    assert [text for text in NO_STEPS if stated_step(text, "a.txt") is not None] == []


def test_every_way_to_state_a_step() -> None:
    assert len(step_cases()) > 1000
    assert wrong_steps(step_cases()) == []


@pytest.mark.parametrize("form", [*STEPS[::4], *RATES[::4]])
def test_a_wrong_step_is_never_taken(tmp_path: Path, form: str) -> None:
    file = tmp_path / "a.txt"
    file.write_text(f"{form.format(s='0.01', ms='10', hz='100')}\nacceleration (g)\n{COLUMN}", encoding="utf-8")
    assert read_record(file).dt == read_record(file, dt=0.01).dt == 0.01
    with pytest.raises(RecordFormatError, match=r"dt of a\.txt must agree with the step of its header, 0\.01 s"):
        read_record(file, dt=0.02)


def test_of_two_steps_the_caller_says_which(tmp_path: Path) -> None:
    file = tmp_path / "a.txt"
    file.write_text(f"sampling rate 200 Hz\ndt = 0.01\nacceleration (g)\n{COLUMN}", encoding="utf-8")
    with pytest.raises(RecordFormatError, match=r"dt of a\.txt must be given, its header states 0\.01 and 0\.005 s"):
        read_record(file)
    assert (read_record(file, dt=0.005).dt, read_record(file, dt=0.01).dt) == (0.005, 0.01)


@pytest.mark.parametrize("rate", [150.0, 300.0, 128.0, 256.0, 409.6, 60.0, 120.0])
@pytest.mark.parametrize("digits", [4, 5])
def test_a_step_that_is_rounded_or_cut_takes_the_right_one(tmp_path: Path, rate: float, digits: int) -> None:
    """Headers round 1/150 s to .0067 or cut it to .0066: both are within a digit; two digits off is refused."""
    exact = 1.0 / rate
    file = tmp_path / "a.txt"
    at2 = tmp_path / "a.AT2"
    for written in (round(exact, digits), int(exact * 10**digits) / 10**digits):
        said = f"{written:.{digits}f}"
        file.write_text(f"dt = {said}\nacceleration (g)\n{COLUMN}", encoding="utf-8")
        at2.write_text(f"PEER\nA, 1/1/2000, B, 0\nIN UNITS OF G\nNPTS= 60, DT= {said} SEC\n{COLUMN}", encoding="utf-8")
        for path in (file, at2):
            assert read_record(path, dt=exact).dt == exact
            with pytest.raises(RecordFormatError, match=r"dt of a\.(?:txt|AT2) must agree with"):
                read_record(path, dt=written + 2.1e-4)
