"""Labels of columns as loggers, networks and programs write them: what each is of, and its direction."""

from __future__ import annotations

import pytest

from seismass.motions.records.formats.labels import labels_of, no_motion

T, A, V, D, COUNT, NO = "times", "acceleration", "velocity", "displacement", "index", "no motion"


@pytest.mark.parametrize(
    ("line", "kinds", "directions"),
    [
        ("Time (s),Acceleration (g)", [T, A], ["", ""]),
        ("# Time (s),Acceleration (g's)", [T, A], ["", ""]),
        ("time (s) acceleration (g)", [T, A], ["", ""]),
        ("TIME (SEC) ACCELERATION (G)", [T, A], ["", ""]),
        ("acceleration (g),time (s)", [A, T], ["", ""]),
        ("t (s);a (m/s2)", [T, A], ["", ""]),
        ("t_sec,acc_g", [T, A], ["", ""]),
        ("s,g", [T, A], ["", ""]),
        ("T (s), a (g)", [T, A], ["", ""]),
        ("time(s),NS(gal),EW(gal),UD(gal)", [T, A, A, A], ["", "NS", "EW", "UD"]),
        ("T(s)   EO   NS   Z", [T, A, A, A], ["", "EO", "NS", "Z"]),
        ("time,U,N,E", [T, A, A, A], ["", "U", "N", "E"]),
        ("t,ax,ay,az", [T, A, A, A], ["", "x", "y", "z"]),
        ("Time (s) HNE HNN HNZ", [T, A, A, A], ["", "HNE", "HNN", "HNZ"]),
        ("Tiempo(s) N00E N90W V", [T, A, A, A], ["", "N00E", "N90W", "V"]),
        ("Time (s) Acceleration 090 (g) Acceleration 360 (g)", [T, A, A], ["", "090", "360"]),
        ("Time (s)\tAccel. NS (cm/s/s)\tAccel. EW (cm/s/s)", [T, A, A], ["", "NS", "EW"]),
        ("time acc vel disp", [T, A, V, D], ["", "", "", ""]),
        ("T[s] Acc[cm/s2] Vel[cm/s] Dis[cm]", [T, A, V, D], ["", "", "", ""]),
        ("sample,acceleration (g)", [COUNT, A], ["", ""]),
        ("Time [s], V [cm/s]", [T, V], ["", ""]),
        ("Time (s),Base shear (kN)", [T, NO], ["", ""]),
        ("period (s),Sa (g)", [NO, NO], ["", ""]),
        ("T,SA(g)", [T, NO], ["", ""]),
        ("T (s),Sa_x (g),Sa_y (g)", [T, NO, NO], ["", "", ""]),
        ("Frequency (Hz)  FAS (g)", [NO, NO], ["", ""]),
        ("lat,lon", [NO, NO], ["", ""]),
    ],
)
def test_what_labels_say(line: str, kinds: list[str], directions: list[str]) -> None:
    labels = labels_of([line], len(kinds))
    assert labels is not None
    assert [label.kind for label in labels] == kinds
    assert [label.direction for label in labels] == directions
    assert (no_motion(labels) is not None) is (NO in kinds)


@pytest.mark.parametrize(
    "line",
    ["Imperial Valley, PGA 0.31 g", "Example 1/2/2003, Test", "dt = 0.01, PGA (g)", "X,Y", "ground motion, 2003"],
)
def test_prose_is_no_row_of_labels(line: str) -> None:
    assert labels_of([line], 2) is None


def test_units_may_stand_in_a_line_of_their_own() -> None:
    labels = labels_of(["Time,NS,EW", "(ms),(gal),(gal)"], 3)
    assert labels is not None
    assert [(label.kind, label.unit) for label in labels] == [(T, "ms"), (A, "gal"), (A, "gal")]
