"""The strengths that a code asks for: random buildings against base shear and modes by own formulas of each code."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass import design
from seismass.design.rules import CATEGORIES
from seismass.model.codes import CODE_IDS, FROM_MEMORY, SECOND_HAND, VERIFIED
from seismass.show.assessment.sheet import sheet_html

G = sm.STANDARD_GRAVITY


def own_modes(mass: np.ndarray, stiffness: np.ndarray, spectrum: Callable[[float], float]) -> tuple[float, np.ndarray]:
    """First period (s) and SRSS of the modal storey shears (N) under a spectrum in g."""
    k = np.diag(stiffness + np.append(stiffness[1:], 0.0)) - np.diag(stiffness[1:], 1) - np.diag(stiffness[1:], -1)
    root = np.sqrt(mass)
    squares, vectors = np.linalg.eigh(k / np.outer(root, root))
    shapes = vectors / root[:, None]
    periods = 2.0 * np.pi / np.sqrt(squares)
    forces = mass[:, None] * shapes * (mass @ shapes) * G * np.array([spectrum(float(t)) for t in periods])
    shears = np.cumsum(forces[::-1], axis=0)[::-1]
    return float(periods[0]), np.sqrt((shears**2).sum(axis=1))


def asce(sds: float, sd1: float, t: float) -> float:
    """The two-period shape (g), T_L = 8 s."""
    t0, ts = 0.2 * sd1 / sds, sd1 / sds
    return sds * (0.4 + 0.6 * t / t0) if t < t0 else sds if t <= ts else sd1 / t if t <= 8.0 else 8.0 * sd1 / t**2


def ec8_design(ag: float, s: float, tb: float, tc: float, td: float, q: float, t: float) -> float:
    """EN 1998-1, 3.2.2.5(4), equations (3.13) to (3.16), beta = 0.2."""
    if t < tb:
        return ag * s * (2.0 / 3.0 + t / tb * (2.5 / q - 2.0 / 3.0))
    if t <= tc:
        return ag * s * 2.5 / q
    return max(ag * s * 2.5 / q * (tc / t if t <= td else tc * td / t**2), 0.2 * ag)


def expected(
    code: str, category: str, mass: np.ndarray, k: np.ndarray, r: float, site: Any
) -> tuple[float, np.ndarray]:
    """C_s (g) and V_y (N), with the numbers of the clauses that `rules_table` names."""
    number = CATEGORIES.index(category)
    weight = G * mass.sum()
    if code == "ec8":
        # Ground C, type 1: S 1.15, T_B 0.2, T_C 0.6, T_D 2.0 s; no scaling of modal shears.
        t, shears = own_modes(mass, k, lambda at: ec8_design(site, 1.15, 0.2, 0.6, 2.0, r, at))
        share = 0.85 if t <= 1.2 and len(mass) > 2 else 1.0
        return share * ec8_design(site, 1.15, 0.2, 0.6, 2.0, r, t), shears
    if code == "nzs1170.5":
        # Class C: C_h of the tables with and without brackets; R is mu.
        def shape(at: float) -> float:
            if at < 0.1:
                return 1.33 + 16.0 * at
            return min(2.93, 2.0 * (0.5 / at) ** 0.75) if at <= 1.5 else 1.32 / at if at <= 3.0 else 3.96 / at**2

        t = own_modes(mass, k, lambda at: 1.0)[0]
        at = max(t, 0.4)
        k_mu = r if at >= 0.7 else (r - 1.0) * at / 0.7 + 1.0
        factor = site * (0.7 if r >= 2.0 else 1.3 - 0.3 * r) / k_mu
        c = max(factor * min(shape(at), 2.36), site / 20.0 + 0.02, 0.03)
        shears = own_modes(mass, k, lambda at: factor * shape(at))[1]
        return c, shears * max(1.0, 0.8 * c * weight / shears[0])
    sds, sd1 = site
    importance = {
        "tbdy2018": (1.0, 1.0, 1.2, 1.5),
        "nbc": (0.8, 1.0, 1.3, 1.5),
    }.get(code, (1.0, 1.0, 1.25, 1.5))[number]
    t, shears = own_modes(mass, k, lambda at: asce(sds, sd1, at) * importance / r)
    c = min(sds, sd1 / t if t <= 8.0 else 8.0 * sd1 / t**2) * importance / r
    least = {
        "tbdy2018": 0.04 * sds * importance,
        "nbc": asce(sds, sd1, 2.0) * importance / r,
        "bnbc2017": 0.11 * 0.4 * sds * importance,
    }.get(code, max(0.044 * sds * importance, 0.01))
    c = max(c, least)
    share = {"asce7-10": 0.85, "bnbc2017": 0.85, "tbdy2018": 0.8, "nbc": 0.8}.get(code, 1.0)
    return c, shears * max(1.0, share * c * weight / shears[0])


CODES = ("asce7-10", "asce7-16", "asce7-22", "bnbc2017", "tbdy2018", "nbc", "ec8", "nzs1170.5")


@pytest.mark.parametrize("code", CODES)
def test_strengths_are_those_of_the_code(code: str) -> None:
    random = np.random.default_rng(CODES.index(code))
    scaled = 0
    for _ in range(24):
        storeys = int(random.integers(1, 9))
        mass = 1e5 * random.uniform(0.3, 1.0, storeys)
        k = 1e7 * random.uniform(1.0, 3.0, storeys)
        k *= (float(own_modes(mass, k, lambda at: 1.0)[0]) / random.uniform(0.08, 3.5)) ** 2
        r, category = float(random.uniform(1.0, 8.0)), str(random.choice(CATEGORIES))
        if code == "ec8":
            ag = float(random.uniform(0.05, 0.4))
            site, target = ag, sm.TargetSpectrum.eurocode8(1, "C", agr_g=ag)
        elif code == "nzs1170.5":
            site = float(random.uniform(0.1, 0.6))
            target = sm.TargetSpectrum.nzs1170("C", z=site)
        else:
            sds = float(random.uniform(0.1, 2.0))
            site = (sds, sds * float(random.uniform(0.3, 0.9)))
            target = sm.TargetSpectrum.asce7(*site)
        if own_modes(mass, k, lambda at: 1.0)[0] > 3.9:
            continue
        found = design.design_by_code(mass, k, target, r, code_id=code, risk_category=category)
        c_s, strength = expected(code, category, mass, k, r, site)
        # NZS: 2.36 is 2 (0.5/0.4)^0.75 rounded to three digits.
        assert found.coefficient == pytest.approx(c_s, rel=2e-3 if code == "nzs1170.5" else 1e-12)
        np.testing.assert_allclose(found.yield_shear, strength, rtol=2e-3 if code == "nzs1170.5" else 1e-10)
        assert found.weight == pytest.approx(G * mass.sum(), rel=1e-14)
        scaled += found.scale > 1.0
        if code in ("asce7-16", "asce7-22") and found.scale > 1.0:
            assert found.yield_shear[0] / (found.coefficient * found.weight) == pytest.approx(1.0, rel=1e-12)
    assert scaled > 0 or code == "ec8"


def test_limit_of_the_period_and_near_faults() -> None:
    """C_u T_a with C_u 1.4: concrete moment frame of 12 m, 0.0466 12^0.9; 0.5 S_1 I/R where S_1 is at least 0.6 g."""
    mass, k, target = np.full(3, 1e5), np.full(3, 4e6), sm.TargetSpectrum.asce7(1.0, 0.6)
    options: dict[str, Any] = {"code_id": "asce7-16", "system": "concrete-moment-frame", "height": 12.0}
    free = design.design_by_code(mass, k, target, 5.0, code_id="asce7-16")
    found = design.design_by_code(mass, k, target, 5.0, **options)
    limit = 1.4 * 0.0466 * 12.0**0.9
    assert free.period > limit == pytest.approx(found.period, rel=1e-12)
    assert found.coefficient == pytest.approx(0.6 / limit / 5.0, rel=1e-12)
    assert any("upper limit of T is not applied" in text for text in free.not_applied)
    assert not any("upper limit" in text for text in found.not_applied)
    near = design.design_by_code(mass, k, target, 5.0, **options, s_1=2.5, risk_category="IV")
    assert near.coefficient == pytest.approx(0.5 * 2.5 * 1.5 / 5.0, rel=1e-12)
    below = design.design_by_code(mass, k, target, 5.0, **options, s_1=0.59)
    assert below.coefficient == found.coefficient


def test_rules_have_clause_and_mark_and_name_what_is_missing() -> None:
    table = design.rules_table()
    assert set(table["status"]) <= {VERIFIED, SECOND_HAND, FROM_MEMORY}
    assert set(table["code_id"]) <= set(CODE_IDS)
    # Read in the text: ASCE 7-10 and BNBC 2017.
    assert set(table.filter(status=VERIFIED)["code_id"]) == {"asce7-10", "bnbc2017"}
    assert (table.filter(table["code_id"] != "as1170.4")["clause"] != "").all()
    found = design.design_by_code(np.ones(1), np.ones(1) * 400.0, sm.TargetSpectrum.asce7(), 2.0, code_id="is1893")
    assert found.coefficient is found.base_shear is None
    missing = " ".join(found.not_applied)
    assert all(f"no rule of the {name} is known" in missing for name in ("coefficient", "modal share"))


TABLES: dict[str, Any] = {
    "site": {"sds_g": 1.0, "sd1_g": 0.6},
    "building": {"period_s": 0.3, "height_m": 4, "area_m2": 500, "dead_load_kpa": 5, "design": True, "R": 4},
    "goods": {"live_load_kpa": 6, "mu": 0.2, "mu_factors": [1.0, 1.0]},
    "storeys": [{}, {}, {"live_load_kpa": 0}],
}


def with_code(code: str, **building: Any) -> dict[str, Any]:
    return TABLES | {"code": {"id": code}, "building": TABLES["building"] | building}


@pytest.mark.parametrize(("category", "factor"), [("I", 1.0), ("II", 1.0), ("III", 1.25), ("IV", 1.5)])
def test_a_category_changes_strength_and_limit_together(category: str, factor: float) -> None:
    plain, own = (sm.read_building(with_code("asce7-16", **each)) for each in ({}, {"risk_category": category}))
    np.testing.assert_allclose(own.structure().yield_shear, factor * plain.structure().yield_shear, rtol=1e-12)
    # Table 12.12-1, twice at MCE_R (16.4.1.2), to which 7-16 scales: 1.5 times the design spectrum.
    assert own.drift_limit == {"I": 0.04, "II": 0.04, "III": 0.03, "IV": 0.02}[category]
    assert own.motion_target()(0.5) == pytest.approx(1.5 * own.site_spectrum()(0.5), rel=1e-12)
    stated = sm.read_building(with_code("asce7-16", risk_category=category, drift_limit=0.017))
    assert stated.drift_limit == 0.017
    older = sm.read_building(
        with_code("asce7-16", risk_category=category) | {"code": {"id": "asce7-16", "scaling": "asce7-10"}}
    )
    assert (older.drift_limit, older.motion_target()) == (own.drift_limit / 2.0, older.site_spectrum())


def test_strengths_that_are_stated_stay() -> None:
    tables = with_code("asce7-16", risk_category="IV")
    stated = {key: value for key, value in tables["building"].items() if key not in ("design", "R")}
    own = sm.read_building(tables | {"building": stated | {"yield_shear_kn": 700.0}})
    np.testing.assert_array_equal(own.structure().yield_shear, 7e5)


@pytest.mark.parametrize(
    ("code", "target", "category", "label"),
    [
        ("ec8", "ec8:1:C:0.3", "III", "gamma_I = 1.2"),
        ("ec8", "ec8:1:C:0.3:1.3", "III", "gamma_I = 1.3"),
        ("nzs1170.5", "nzs1170:C:0.3", "IV", "R = 1.8"),
    ],
)
def test_importance_of_the_spectrum_is_in_site_and_motions(code: str, target: str, category: str, label: str) -> None:
    """EN 1998-1, 4.2.5: gamma_I is of a_g; NZS 1170.5, table 3.5: R_u; what the file states stands."""
    tables = with_code(code, risk_category=category) | {"site": {"target": target}}
    own = sm.read_building(tables)
    assert label in own.site_spectrum().label
    assert own.motion_target() == own.site_spectrum()
    assert (
        label not in sm.read_building(tables | {"code": {"id": "asce7-10"}}).site_spectrum().label or ":1.3" in target
    )


def test_another_code_brings_its_rules() -> None:
    """`code` of `assess` and --code of the command replace all that the file's code chose."""
    from seismass.assessment.building import with_code as under

    own = sm.read_building(with_code("asce7-10", risk_category="III"))
    other = under(own, sm.codes.code_fraction("asce7-16"))
    asked = sm.read_building(with_code("asce7-16", risk_category="III"))
    assert (other.drift_limit, other.scaling_code) == (asked.drift_limit, asked.scaling_code) == (0.03, "asce7-16")
    np.testing.assert_array_equal(other.structure().yield_shear, asked.structure().yield_shear)


def test_text_sheet_and_tables_have_the_design() -> None:
    result = sm.assess(with_code("asce7-10", risk_category="III"), sm.builtin_suite("seven")[:3], resamples=20)
    found, strength = result.building.code_design(), result.building.structure().yield_shear
    rows = {(row["quantity"], row["storey"]): row for row in result.tables["design"].iter_rows(named=True)}
    assert rows["C_s", None]["value"] == pytest.approx(1.25 / 4.0, rel=1e-12)
    assert [rows["V_y", storey]["value"] for storey in (1, 2, 3)] == strength.tolist()
    assert rows["W", None]["clause"] == "12.7.2, item 1"
    sheet = str(sheet_html(result))
    for quantity, value in (("W", found.weight), ("V", found.base_shear)):
        assert f"{quantity} = {1e-3 * value:.0f} kN" in sheet
        assert any(line.split()[:2] == [quantity, f"{1e-3 * value:.0f}"] for line in result.text.splitlines())
    assert f"V_y = {', '.join(f'{1e-3 * value:.0f}' for value in strength)} kN from storey 1 up" in sheet
    assert "12.8.1.1, equations 12.8-2 to 12.8-4" in sheet
    assert result.to_dict()["input"]["code_design"] == result.tables["design"].to_dicts()
