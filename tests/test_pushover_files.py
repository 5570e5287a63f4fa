"""Pushover curves as programs write them, made at random with right answers: names, cases, gravity, unloading."""

from __future__ import annotations

import itertools
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.assessment import read_pushover
from seismass.design import fit_pushover

UNITS = {"kN": 1e3, "kip": 0.45359237 * 9806.65, "tonf": 9806.65, "N": 1.0}
LENGTHS = {"m": 1.0, "mm": 1e-3, "in": 0.0254}
# Title, columns of case, step, displacement and force, and words of the row of units in the two first.
PROGRAMS = {
    "sap2000": (
        'TABLE:  "Pushover Capacity Curve"',
        "LoadCase",
        "Step",
        "Displacement",
        "BaseForce",
        "Text",
        "Unitless",
    ),
    "etabs": (
        *("TABLE:  Base Shear vs Monitored Displacement", "Output Case", "Step", "Monitored Displ", "Base Force"),
        *("", ""),
    ),
    "spanish": ("TABLE:  Curva", "Caso de carga", "Paso", "Desplazamiento", "Cortante basal", "", ""),
    "turkish": ("TABLE:  Egri", "Yükleme", "Ad\u0131m", "Tepe yer değiştirmesi", "Taban kesme kuvveti", "", ""),
    "by hand": ("", "Case", "Step", "Roof displacement", "Base shear", "", ""),
}


def pushed(chooser: random.Random) -> tuple[np.ndarray, np.ndarray]:
    """A curve of a push (m, N), which rises from nothing."""
    count = chooser.randint(6, 20)
    drift = np.round(np.cumsum([chooser.uniform(0.004, 0.03) for _ in range(count)]), 5)
    shear = np.round(9e6 * np.tanh(drift / chooser.uniform(0.03, 0.1)), -2)
    return np.r_[0.0, drift], np.r_[0.0, shear]


def one(chooser: random.Random, folder: Path) -> tuple[Path, dict[str, Any], np.ndarray, np.ndarray, list[str]]:
    """A file, its options, the curve that must come out and what must be said."""
    title, case, step, displacement, force, text, number = PROGRAMS[program := chooser.choice(list(PROGRAMS))]
    f, metre = chooser.choice(list(UNITS)), chooser.choice(list(LENGTHS))
    separator = chooser.choice(("\t", ",", ";"))
    cases = chooser.choice((["PUSHX"], ["PUSHX", "PUSHY"]))
    drift, shear = pushed(chooser)
    said: list[str] = []
    rows = []
    for name in cases:
        d, v = (drift, shear) if name == "PUSHX" else pushed(chooser)
        d, v = list(d), list(v)
        start = 0.0
        if chooser.random() < 0.6:  # steps of gravity: no lateral force, the roof moves a little
            start = chooser.choice((-4.7e-5, 2e-5, -3e-4))
            steps = chooser.randint(1, 4)
            gravity = [start * (i + 1) / steps for i in range(steps)]
            d = [*gravity, *(each + start for each in d[1:])]
            v = [*[0.0] * steps, *v[1:]]
            said += ["counted from the end of gravity"] if name == "PUSHX" else []
        if chooser.random() < 0.5:  # unloading at the end, or on the way and loading again
            at = chooser.choice((len(d) - 1, len(d) // 2))
            back = [(d[at] * (1 - 0.1 * i), v[at] * (1 - 0.3 * i)) for i in range(1, 4)]
            back += [(d[at] * 0.9, v[at] * 0.7)] if at < len(d) - 1 else []
            d[at + 1 : at + 1] = [one_d for one_d, _ in back]
            v[at + 1 : at + 1] = [one_v for _, one_v in back]
            said += ["as after unloading, are left out"] if name == "PUSHX" else []
        sign = chooser.choice((1.0, -1.0))
        said += ["signs are turned"] if sign < 0.0 and name == "PUSHX" else []
        rows += [
            [name, str(i), f"{sign * each / LENGTHS[metre]:.9f}", f"{sign * v[i] / UNITS[f]:.7f}"]
            for i, each in enumerate(d)
        ]
    lines = [[case, step, displacement, force], [text, number, metre, f if program != "sap2000" else f.upper()], *rows]
    if chooser.random() < 0.3:
        lines = [[*lines[0][:2], f"{displacement} ({metre})", f"{force} ({f})"], *rows]
    content = "\n".join([*([title] if title else []), *(separator.join(line) for line in lines)])
    file = folder / "push.txt"
    file.write_text(content, encoding="utf-16" if chooser.random() < 0.3 else "utf-8")
    return file, ({"case": "pushx"} if len(cases) > 1 else {}), drift, shear, said


def check(chooser: random.Random, folder: Path) -> None:
    file, options, drift, shear, said = one(chooser, folder)
    if options:
        with pytest.raises(sm.errors.InvalidBuildingFile, match=r"one: state it by --pushover-case; got PUSHX, P"):
            read_pushover(file)
    found = read_pushover(file, **options)
    told = file.read_bytes().decode("utf-16" if file.read_bytes()[:2] == b"\xff\xfe" else "utf-8")
    assert found.names == ()
    # Printed with seven decimals of a kip and nine of a metre; differences of such numbers.
    assert found.drift[0] == pytest.approx(drift, abs=2e-9), told
    assert found.shear[0] == pytest.approx(shear, abs=1e-2), told
    assert len(found.remarks) == len(said), (found.remarks, said)
    for sentence in said:
        assert any(sentence in remark for remark in found.remarks), told
    fit_pushover(found.drift[0], found.shear[0])


def test_curves_of_programs_are_read_right(tmp_path: Path) -> None:
    chooser = random.Random(2)
    for _ in range(30):
        check(chooser, tmp_path)


def test_hundreds_of_curves_of_programs(tmp_path: Path) -> None:
    chooser = random.Random(3)
    for _ in range(300):
        check(chooser, tmp_path)


@pytest.mark.parametrize(
    ("rows", "options", "message"),
    [
        ("P,0,0\nP,1,5\nP,-1,-5\nP,2,6\n", {}, "of push.txt must be of one sign"),
        ("P,0,0\nP,1,-5\nP,2,6\nP,3,7\n", {}, "of one sign"),
        ("P,-1,0\nP,1,5\nP,2,6\nP,3,7\n", {}, "of one sign"),  # a third of the push is no gravity
        ("P,0,0\nP,1,5\n", {"case": "Q"}, "load case of push.txt must be one of P; got Q"),
        ("P,0,0\nP,0,0\n", {}, "of one sign"),
    ],
)
def test_curves_that_are_no_push_are_refused(tmp_path: Path, rows: str, options: dict[str, str], message: str) -> None:
    file = tmp_path / "push.txt"
    file.write_text(f"LoadCase,Displacement (m),BaseForce (kN)\n{rows}", encoding="utf-8")
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        read_pushover(file, **options)


DRIFTS = ("Roof Drift", "Top displacement", "Roof disp.", "Control displacement", "Displ X", "d", "Monitored Displ",
          "Desplazamiento en el techo", "Spostamento nodo di controllo", "Déplacement en tête", "Dachverschiebung",
          "Tepe yer değiştirmesi", "displacement, d")  # fmt: skip
SHEARS = ("Base Shear", "BaseForce", "V base", "Vb", "Lateral force", "Base shear X", "Cortante en la base", "FX",
          "Taglio alla base", "Effort tranchant à la base", "Taban kesme kuvveti", "Base shear, V")  # fmt: skip


@pytest.mark.parametrize("form", ["{} ({})", "{} [{}]", "{} {}", "{}_{}", "{} in {}"])
def test_names_of_drifts_and_shears_in_every_form(tmp_path: Path, form: str) -> None:
    file = tmp_path / "push.csv"
    for number, (drift, shear) in enumerate(itertools.product(DRIFTS, SHEARS)):
        if number % 5 == len(form) % 5:
            head = f"{form.format(drift, 'in')};{form.format(shear, 'kips')}"
            file.write_text(f"{head}\n0;0\n1;400\n2;500\n4;520\n", encoding="utf-8")
            found = read_pushover(file)
            assert found.drift[0][-1] == pytest.approx(4 * 0.0254), head
            assert found.shear[0][-1] == pytest.approx(520 * UNITS["kip"]), head


@pytest.mark.parametrize(
    ("head", "message"),
    [
        ("Story,Displacement (mm),Story Shear (kN)", "called Story Drift and Story Shear"),
        ("Story,Verschiebung (mm),Querkraft (kN)", "called Story Drift and Story Shear"),
        ("Story,Story Drift (mm),Story Force (kN)", "called Story Drift and Story Shear"),
        ("Story,Story Drift,Story Shear (kN)", "unit of the column drift"),
        ("Case,Roof Drift,Base Shear (kN)", "unit of the column drift"),
        ("Case,Displacement,Base Shear (kN)", "unit of the column drift"),
        ("Case,Roof Drift (%),Base Shear (kN)", "unit of the column drift"),
    ],
)
def test_displacements_of_floors_and_drifts_without_a_unit_are_no_ratios(
    tmp_path: Path, head: str, message: str
) -> None:
    file = tmp_path / "push.csv"
    file.write_text(f"{head}\nL1,0,0\nL1,30,400\nL1,60,500\n", encoding="utf-8")
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        read_pushover(file)


@pytest.mark.parametrize(
    ("name", "curves", "last"),
    [
        ("sap_pushover.txt", 1, (0.2602 + 4.7e-5, 9010.3e3)),
        ("etabs_pushover.csv", 1, (0.275, 6900e3)),
        ("story_pushover.csv", 4, (0.110, 10100e3)),
    ],
)
def test_curves_that_were_handed_out(shared: Path, name: str, curves: int, last: tuple[float, float]) -> None:
    file = shared / "findings" / "tables" / name
    if not file.exists():
        pytest.skip(f"{name} is not in SEISMASS_SHARED")
    found = read_pushover(file)
    assert len(found.drift) == curves
    assert (found.drift[0][-1], found.shear[0][-1]) == pytest.approx(last, rel=1e-12)
