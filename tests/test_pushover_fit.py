"""Storey springs from pushover curves: springs of a known building come back, real curves have their misfit printed."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest

import seismass as sm
from seismass.assessment import read_pushover
from seismass.cli import main
from seismass.design import fit_pushover

KIP, INCH = 4448.2216152605, 0.0254  # N of 1000 lbf, m

BUILDING = sm.Building(
    [1.2e5, 1.0e5, 8e4],
    [1.0e8, 8.0e7, 5.0e7],
    yield_shear=[1.0e6, 8.0e5, 5.0e5],
    overstrength=[2.0, 1.8, 1.5],
    second_slope=[0.10, 0.20, 0.15],
    third_slope=[0.01, 0.02, 0.03],
    heights=3.0,
)
NAMES = ("stiffness", "yield_shear", "overstrength", "second_slope", "third_slope")


def pushed(building: sm.Building, reach: float) -> list[tuple[np.ndarray, np.ndarray]]:
    """Curve of each storey by the kernel's own springs, at 61 drifts, most corners between samples."""
    drift = np.linspace(0.0, reach, 61)
    return [(drift, building._kernel.spring_path(storey, drift).force) for storey in range(building.storeys)]


def test_springs_of_a_known_building_come_back_from_curves_of_its_storeys() -> None:
    drifts, shears = zip(*pushed(BUILDING, 0.15), strict=True)
    fit = fit_pushover(drifts, shears, shape="trilinear")
    for name in NAMES:
        np.testing.assert_allclose(getattr(fit, name), getattr(BUILDING, name), rtol=1e-11, err_msg=name)
    assert (fit.largest_misfit < 1e-12).all()
    again = sm.Building(BUILDING.mass, **fit.springs, heights=3.0)
    np.testing.assert_allclose(again.periods, BUILDING.periods, rtol=1e-11)


def test_two_lines_a_plateau_and_a_falling_branch_come_back() -> None:
    """k = 1e8 N/m up to 1 MN at 10 mm; then 0.05 k, or nothing; or 0.05 k up to 1.2 MN at 50 mm and -0.12 k."""
    drift = np.linspace(0.0, 0.1, 52)
    bilinear = np.interp(drift, [0.0, 0.01, 0.1], [0.0, 1e6, 1.45e6])
    fit = fit_pushover(drift, bilinear)
    assert [float(fit.springs[name][0]) for name in NAMES] == pytest.approx([1e8, 1e6, 1.0, 0.05, 0.05], rel=1e-11)
    flat = fit_pushover(drift[1:], np.minimum(1e8 * drift[1:], 1e6))  # the origin may be left out
    assert [float(flat.springs[name][0]) for name in NAMES] == pytest.approx(
        [1e8, 1e6, 1.0, 0.0, 0.0], rel=1e-11, abs=1e-9
    )
    falling = np.interp(drift, [0.0, 0.01, 0.05, 0.1], [0.0, 1e6, 1.2e6, 0.6e6])
    capped = fit_pushover(drift, falling, shape="capped")
    assert [float(capped.springs[name][0]) for name in NAMES] == pytest.approx([1e8, 1e6, 1.2, 0.05, -0.12], rel=1e-9)
    sm.Building(1e5, **capped.springs, hysteresis="peak-oriented")
    # Of two lines what comes after the largest shear is left out, and said.
    ascending = fit_pushover(drift, falling)
    assert ascending.third_slope[0] == pytest.approx(0.05, rel=1e-9)
    assert any("after the largest shear, from 50.98 mm on" in sentence for sentence in ascending.assumptions)


@pytest.mark.parametrize("shape", ["bilinear", "trilinear"])
def test_a_curve_of_the_roof_gives_the_storeys_back_by_their_relative_stiffness_and_strength(shape: str) -> None:
    """The curve is the exact polygon of `pushover`; storeys yield one after the other."""
    third = 0.05 if shape == "bilinear" else 0.02
    building = sm.Building(
        BUILDING.mass,
        BUILDING.stiffness,
        yield_shear=[1.0e6, 9.0e5, 5.0e5],
        overstrength=1.0 if shape == "bilinear" else 1.5,
        second_slope=0.05 if shape == "bilinear" else 0.10,
        third_slope=third,
    )
    path = sm.design.pushover(building, "uniform", drift_limit=0.3)
    roof = np.linspace(0.0, 0.3, 80)
    fit = fit_pushover(
        roof,
        path.base_shear_at(roof),
        shape=shape,  # type: ignore[arg-type]
        forces=building.mass,
        relative_stiffness=3.0 * building.stiffness,
        relative_strength=0.5 * building.yield_shear,
    )
    for name in NAMES:
        np.testing.assert_allclose(getattr(fit, name), getattr(building, name), rtol=1e-9, err_msg=name)


def test_a_curve_of_the_roof_alone_gives_storeys_that_drift_alike() -> None:
    """Forces 1, 2, 3 at the floors: the storeys have 6/6, 5/6 and 3/6 of the base shear. A third of the roof each."""
    roof = np.linspace(0.0, 0.3, 61)
    fit = fit_pushover(roof, np.interp(roof, [0.0, 0.031, 0.3], [0.0, 1.2e6, 1.5e6]), forces=[1.0, 2.0, 3.0])
    share = np.array([1.0, 5.0 / 6.0, 0.5])
    np.testing.assert_allclose(fit.yield_shear, 1.2e6 * share, rtol=1e-9)
    np.testing.assert_allclose(fit.stiffness, 3.0 * 1.2e6 / 0.031 * share, rtol=1e-9)
    assert fit.third_slope[0] == pytest.approx((0.3e6 / 0.269) / (1.2e6 / 0.031), rel=1e-9)
    assert "the lateral forces give the storeys 1, 0.833, 0.5 of the base shear" in fit.text


def test_p_delta_of_the_analysis_is_added_to_the_spring() -> None:
    """k = 100 N/m, V_y = 10 N and P/h = 20 N/m: the analysis finds 80 N/m up to 8 N, then -20 N/m."""
    drift = np.linspace(0.0, 0.2, 41)
    shear = np.interp(drift, [0.0, 0.1, 0.2], [0.0, 8.0, 6.0])
    fit = fit_pushover(drift[:25], shear[:25], p_over_h=20.0, shape="capped")
    assert fit.stiffness[0] == pytest.approx(100.0, rel=1e-9)
    assert fit.yield_shear[0] == pytest.approx(10.0, rel=1e-9)
    assert any("P-Delta" in sentence for sentence in fit.assumptions)


def test_a_smooth_curve_has_its_misfit_said_and_drawn() -> None:
    """V = tanh: three lines are closer than two, and both numbers are those of the arrays."""
    drift = np.linspace(0.0, 0.12, 61)
    shear = 1e6 * np.tanh(drift / 0.02)
    two, three = fit_pushover(drift, shear), fit_pushover(drift, shear, shape="trilinear")
    assert 0.02 < three.largest_misfit[0] < 0.5 * two.largest_misfit[0]
    assert three.rms_misfit[0] < 0.5 * two.rms_misfit[0]
    misfit = np.abs(two.fitted[0] - two.shear[0]) / shear.max()
    assert two.largest_misfit[0] == misfit.max()
    # Even samples: half of the weight of the others at both ends.
    weights = np.r_[0.5, np.ones(59), 0.5]
    assert two.rms_misfit[0] == pytest.approx(np.sqrt(np.average(misfit**2, weights=weights)), rel=1e-12)
    assert f"{100 * misfit.max():.2f} %" in two.text
    axes = two.plot().axes[0]
    assert axes.get_title() == f"storey 1: misfit {100 * misfit.max():.2g} %, rms {100 * two.rms_misfit[0]:.2g} %"
    assert [len(fit_pushover([drift] * count, [shear] * count).plot().axes) for count in (1, 3, 6)] == [1, 3, 6]
    # More samples on the elastic line are the same curve, whose chords are 1e-4 nearer to it.
    dense = np.unique(np.r_[drift, np.linspace(0.0, 0.01, 40)])
    other = fit_pushover(dense, 1e6 * np.tanh(dense / 0.02))
    assert other.stiffness[0] == pytest.approx(two.stiffness[0], rel=2e-4)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([0.0, 0.01, 0.02], [0.0, 1.0, 2.0]), "samples of curve of pushover fit must be at least 4"),
        ((np.arange(9.0), np.arange(9.0)), "samples of pushover fit must be a curve that bends"),
        (([0.0, 0.02, 0.01, 0.03, 0.04], np.arange(5.0)), "0.01 m as sample 3"),
        ((np.arange(9.0), -np.arange(9.0)), "shear of curve of pushover fit must be positive"),
        ((np.arange(9.0), np.arange(8.0)), "shear of curve of pushover fit must be a list of 9 numbers; got 8"),
        (([np.arange(9.0)] * 2, [np.arange(9.0)]), "shear of pushover fit must be a list of 2 curves; got 1"),
    ],
)
def test_curves_that_are_none(arguments: tuple[object, object], message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=message):
        fit_pushover(*arguments)  # type: ignore[arg-type]


def test_arguments_that_do_not_belong_together() -> None:
    drift = np.linspace(0.0, 0.1, 30)
    shear = np.minimum(1e8 * drift, 1e6)
    for given, message in (
        ({"shape": "round"}, "one of bilinear, trilinear, capped"),
        ({"relative_stiffness": [1.0]}, "relative_stiffness of pushover fit must be given with forces alone"),
        ({"forces": [1.0, 1.0], "shape": "capped"}, "which storey falls is not seen in it"),
        ({"forces": [1.0, 1.0], "p_over_h": 1.0}, "left out with a curve of the roof"),
        ({"forces": [1.0, -1.0]}, "every storey has a positive shear"),
        ({"forces": [1.0, 1.0], "relative_strength": [1.0]}, "2 positive numbers"),
        ({"p_over_h": -1.0}, "none of them negative"),
    ):
        with pytest.raises(sm.errors.InvalidOption, match=message):
            fit_pushover(drift, shear, **given)  # type: ignore[arg-type]
    with pytest.raises(sm.errors.InvalidOption, match="forces of pushover fit must be given with one curve"):
        fit_pushover([drift] * 2, [shear] * 2, forces=[1.0, 1.0])


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def test_files_of_storeys_and_of_the_roof_in_their_units(tmp_path: Path) -> None:
    rows = "".join(f"{name},{d},{v}\n" for name in ("Roof", "L1") for d, v in ((0, 0), (-0.5, -100), (-2, -150)))
    found = read_pushover(write(tmp_path / "a.csv", f"Story,Story Drift (in),Story Shear (kip)\n{rows}"))
    assert found.names == ("L1", "Roof")
    assert found.drift[0].tolist() == pytest.approx([0.0, 0.5 * INCH, 2.0 * INCH])
    assert found.shear[1].tolist() == pytest.approx([0.0, 100 * KIP, 150 * KIP])
    assert found.remarks == ("signs are turned, so that drifts and shears are positive",)
    etabs = "TABLE: Base Shear vs Monitored Displacement\nStep,Monitored Displ,Base Force\n,mm,kN\n0,0,0\n1,50,400\n"
    roof = read_pushover(write(tmp_path / "b.csv", etabs))
    assert (roof.names, roof.drift[0].tolist(), roof.shear[0].tolist()) == ((), [0.0, 0.05], [0.0, 4e5])
    stated = read_pushover(write(tmp_path / "c.csv", "Roof Drift;Base Shear\n0;0\n20,5;400\n"), units="kN-mm")
    assert stated.drift[0].tolist() == [0.0, 0.0205]
    ratio = read_pushover(write(tmp_path / "d.csv", "Roof Drift (%),Base Shear (kN)\n0,0\n1.5,400\n"))
    assert ratio.drift_in_metres(np.array([4.0, 3.0]))[0].tolist() == pytest.approx([0.0, 0.105])
    with pytest.raises(
        sm.errors.InvalidBuildingFile, match=r"heights of d\.csv must be known, since drifts are ratios"
    ):
        ratio.drift_in_metres(None)
    for text, message in (
        ("Roof Drift (mm),Base Shear\n0,0\n", "unit of the column shear of e.csv must be stated"),
        ("Drift,Other\n0,0\n", "rows of e.csv must be below a head with a column of drifts"),
        ("Roof Drift (mm),Base Shear (kN)\n1,\n", "shear of e.csv must be a number in every row"),
        ("Roof Drift (mm),Base Shear (kN)\n1,1\n-1,-1\n", "of one sign: a push in one direction"),
        ("Roof Drift (mm),Base Shear (kN)\n", "rows of e.csv must be samples of a curve"),
    ):
        with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
            read_pushover(write(tmp_path / "e.csv", text))


ANSWERS = [
    *("--height", "3.5", "--area", "900", "--dead-load", "6", "--sds", "1", "--sd1", "0.6"),
    *("--live-load", "7.2", "--friction", "0.3"),
]


def test_new_writes_the_springs_into_a_building_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Drifts as ratios of 3.5 m; the springs are those of the curves."""
    monkeypatch.chdir(tmp_path)
    drift = np.linspace(0.0, 0.03, 31)
    rows = [
        f"{name},{d!r},{v!r}"
        for name, part in (("2nd", 0.5), ("1st", 1.0))
        for d, v in zip(
            drift.tolist(), (part * np.interp(drift, [0, 0.005, 0.03], [0, 2e3, 3e3])).tolist(), strict=True
        )
    ]
    write(tmp_path / "push.csv", "\n".join(["Storey,Drift Ratio,Shear (kN)", *rows, ""]))
    assert main(["new", "own.toml", "--pushover", "push.csv", *ANSWERS]) == 0
    printed = capsys.readouterr().out
    assert "drifts without a unit are ratios of the height" in printed
    assert "own_pushover.png is drawn" in printed
    assert (tmp_path / "own_pushover.png").stat().st_size > 5000
    tables = tomllib.loads((tmp_path / "own.toml").read_text(encoding="utf-8"))
    assert [storey["name"] for storey in tables["storeys"]] == ["1st", "2nd"]
    first = tables["storeys"][0]
    assert first["yield_shear_kn"] == pytest.approx(2000.0, rel=1e-9)
    assert first["stiffness_kn_per_m"] == pytest.approx(2000.0 / (0.005 * 3.5), rel=1e-9)
    assert first["overstrength"] == 1.0
    assert first["third_slope"] == pytest.approx((1000.0 / 0.025) / (2000.0 / 0.005), rel=1e-9)
    assert "period_s" not in tables["building"]
    assert "design" not in tables["building"]
    assert sm.read_building(tmp_path / "own.toml").third_slope.tolist() == pytest.approx([0.1, 0.1])


def test_new_shares_a_curve_of_the_roof_by_the_storey_table(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Relative stiffnesses 2 to 1 of the table; uniform forces on 600 and 400 t: 1 and 0.4 of the base shear."""
    roof = np.linspace(0.0, 0.2, 41)
    shear = np.interp(roof, [0.0, 0.05, 0.2], [0.0, 3e3, 3.6e3])
    curve = "".join(f"{1e3 * d:.6f},{v:.9f}\n" for d, v in zip(roof, shear, strict=True))
    push = write(tmp_path / "push.csv", f"Roof Displacement (mm),Base Shear (kN)\n{curve}")
    storeys = write(tmp_path / "s.csv", "Story,Height (m),Mass (t),Stiffness (kN/m)\nRoof,4,400,1\nL1,4,600,2\n")
    out = tmp_path / "own.toml"
    few = [word for word in ANSWERS if word not in ("--height", "3.5", "--dead-load", "6")]
    command = ["new", str(out), "--from", str(storeys), "--pushover", str(push), "--forces", "uniform", *few]
    assert main(command) == 0
    assert "in the given proportion" in capsys.readouterr().out
    springs = tomllib.loads(out.read_text(encoding="utf-8"))["storeys"]
    k = [storey["stiffness_kn_per_m"] for storey in springs]
    assert k[0] == pytest.approx(2.0 * k[1], rel=1e-9)
    # In series, with shares 1 and 0.4: 1/k_1 + 0.4/k_2 = 0.05/3000.
    assert 1.0 / k[0] + 0.4 / k[1] == pytest.approx(0.05 / 3e3, rel=1e-5)
    assert main(["new", str(tmp_path / "x.toml"), "--pushover", str(push), *ANSWERS]) == 2
    assert "storeys of new building must be given, by --storeys" in capsys.readouterr().err
