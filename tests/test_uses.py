"""The fraction that is applied to a floor, by code, by the use that is stated, and by what the file says is there."""

from __future__ import annotations

from typing import Any, get_args

import pytest

import seismass as sm
from seismass.assessment.advice import code_mass_remarks, code_remark
from seismass.model.codes import CODE_IDS, Use
from seismass.model.occupancy import OCCUPANCY_IDS

# Fractions for storage, archives, assembly, shops, ordinary floors, car parks, roofs and important buildings; None: the
# code's row is not known. Where a code says nothing of a use, archives are storage, and assembly, shops, roofs and
# important buildings are ordinary floors, but car parks are nothing. ASCE 7-10, 12.7.2 and 15.5.3.6, and BNBC 2017,
# 2.5.7.3, as read in these codes; TBDY 2018, table 4.3: depots 0.80, shops and schools 0.60, dwellings with car parks
# 0.30, as handbooks quote it; RPA 99/2003, beta: depots 0.50 and archives 1.00, the larger for storage, schools 0.40,
# other uses 0.60; EN 1998-1, 4.2.4: phi psi_2 of categories C to F, roofs phi 1.0 and psi_2 0.3; SIA 261: psi_2 of EN
# 1990; E.030: category C 0.25, A and B 0.50; NZS 1170.5, IS 1893, NCh2369, GB 50011 and COVENIN 1756 count nothing on
# roofs; others as docs/codes.md has them.
NONE = (None,) * 8
"""Of a code whose fractions are not known."""
FRACTIONS: dict[str, tuple[float | None, ...]] = {
    "asce7-10": (0.25, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "asce7-16": (0.25, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "asce7-22": (0.25, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "asce7-10-racks": (0.67, 0.67, None, None, None, None, None, None),
    "rmi-mh16.1": (0.67, 0.67, None, None, None, None, None, None),
    "asce61-14": (0.10, 0.10, None, None, None, None, None, None),
    "aashto": (0.0, 0.0, None, None, None, None, None, None),
    "ubc-97": (0.25, 0.25, 0.0, 0.0, 0.0, None, 0.0, 0.0),
    "ec8": (0.8, 0.8, 0.6, 0.6, 0.30, 0.6, 0.30, 0.30),
    "nzs1170.5": (0.6, 0.6, 0.3, 0.3, 0.3, None, 0.0, 0.3),
    "as1170.4": (0.6, 0.6, 0.3, 0.3, 0.3, None, 0.3, 0.3),
    "nbc": (0.6, 0.6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "is1893": (0.5, 0.5, 0.25, 0.25, 0.25, None, 0.0, 0.25),
    "bnbc2017": (0.5, 0.5, 0.25, 0.25, 0.25, None, 0.25, 0.25),
    "nch433": (0.5, 0.5, 0.5, 0.5, 0.25, None, 0.25, 0.25),
    "nch2369": (0.5, 0.5, 0.25, 0.25, 0.25, None, 0.0, 0.25),
    "e030": (0.8, 0.8, 0.25, 0.5, 0.25, None, 0.25, 0.5),
    "nsr-10": (0.25, 0.25, 0.0, 0.0, 0.0, None, 0.0, 0.0),
    "gb50011": (0.8, 0.8, 0.5, 0.5, 0.5, None, 0.0, 0.5),
    "japan-bsl": (1.0, 1.0, 0.48, 0.48, 0.48, None, 0.48, 0.48),
    "tbdy2018": (0.80, 0.80, 0.60, 0.60, 0.30, 0.30, 0.30, 0.30),
    "rpa99": (1.0, 1.0, 0.40, 0.60, 0.20, None, 0.20, 0.20),
    "iran2800": (0.6, 0.6, 0.4, 0.4, 0.2, None, 0.2, 0.2),
    "sni1726": (0.25, 0.25, 0.0, 0.0, 0.0, None, 0.0, 0.0),
    "kds41-17": (0.25, 0.25, 0.0, 0.0, 0.0, None, 0.0, 0.0),
    "nscp2015": (0.25, 0.25, 0.0, 0.0, 0.0, None, 0.0, 0.0),
    "ntc2023": NONE,
    "taiwan": NONE,
    "cirsoc103": NONE,
    "covenin1756": (1.0, 1.0, 0.5, 0.5, 0.25, 0.5, 0.0, 0.25),
    "nec-se-ds": (0.25, 0.25, 0.0, 0.0, 0.0, None, 0.0, 0.0),
    "rpa2024": NONE,
    "ts1170.5": NONE,
    "as1170.4-2024": NONE,
    "ec8-2": NONE,
    "is1893-2025": NONE,
    "sia261": (0.8, 0.8, 0.6, 0.6, 0.3, 0.6, 0.3, 0.3),
    "si413": NONE,
    "asce41": (0.25, 0.25, 0.0, 0.0, 0.0, None, 0.0, 0.0),
}
KNOWN = [code for code, row in FRACTIONS.items() if row is not NONE]
USES = ("storage", "archive", "assembly", "shop", "ordinary", "garage", "roof", "important")
USE_OF = {
    **dict.fromkeys(("storage", "heavy storage", "light industry", "heavy industry"), "storage"),
    "library": "archive",
    "retail": "shop",
    "office": "ordinary",
}
"""Use of each surveyed occupancy, by its name without ", sustained"."""
BY_LOAD = {"is1893": 3.0, "bnbc2017": 3.0}
"""Live load (kPa) above which a floor has the fraction of storage: IS 1893, table 10; BNBC 2017, 2.5.7.3."""


def building(code: dict[str, Any], storey: dict[str, Any], load: float = 2.5) -> sm.OwnBuilding:
    """One storey of 500 m2 and 5 kPa under a live load (kPa)."""
    return sm.read_building(
        {
            "site": {"sds_g": 1.0, "sd1_g": 0.6},
            "code": code,
            "building": {
                "stiffness_kn_per_m": 2.0e5,
                "height_m": 4.0,
                "area_m2": 500.0,
                "dead_load_kpa": 5.0,
                "yield_shear_kn": 900.0,
            },
            "goods": {"live_load_kpa": load, "mu": 0.3},
            "storeys": [storey],
        }
    )


def expected(code: str, uses: set[str], load: float) -> float:
    """The largest fraction of some uses, and of storage where the load decides."""
    of = dict(zip(USES, FRACTIONS[code], strict=True))
    chosen = uses | ({"storage"} if load > BY_LOAD.get(code, load) else set())
    return max(fraction for use in chosen if (fraction := of[use]) is not None)


def test_the_table_of_this_test_has_every_code_use_and_occupancy() -> None:
    assert list(FRACTIONS) == list(CODE_IDS)
    assert get_args(Use) == USES
    assert {len(row) for row in FRACTIONS.values()} == {len(USES)}
    assert [f"{name}, sustained" for name in USE_OF] == list(OCCUPANCY_IDS)


@pytest.mark.parametrize("code", KNOWN)
@pytest.mark.parametrize("use", [None, *USES])
def test_the_fraction_is_that_of_the_table(code: str, use: str | None) -> None:
    """In the code's table, in the file's [code], and on a floor; with nothing stated, that of storage."""
    fraction = FRACTIONS[code][USES.index(use or "storage")]
    stated = {} if use is None else {"use": use}
    if fraction is None:
        for wrong in ({"id": code, **stated}, stated), ({"id": code}, stated):
            with pytest.raises(sm.errors.InvalidBuildingFile, match=rf"use of building must be .*; got '?{use}"):
                building(*wrong)
        return
    assert sm.codes.code_fraction(code, use or "storage").fraction == fraction  # type: ignore[arg-type]
    for found in (building({"id": code, **stated}, {}), building({"id": code}, stated)):
        (counted,) = found.counted
        assert counted.fraction == fraction
        assert found.code_share == fraction


@pytest.mark.parametrize("code", [code for code, row in FRACTIONS.items() if row is NONE])
def test_a_code_of_which_nothing_is_known_is_refused_until_a_fraction_is_stated(code: str) -> None:
    """Whatever use is asked for, never as 0: the sentence says what to state."""
    words = "one whose fractions are known here, or state a fraction; got"
    for use in USES:
        with pytest.raises(sm.errors.InvalidOption, match=f"id of code must be {words} {code}"):
            sm.codes.code_fraction(code, use)  # type: ignore[arg-type]
        for where in ({"id": code, "use": use}, {}), ({"id": code}, {"use": use}):
            with pytest.raises(sm.errors.InvalidBuildingFile, match=f"code.id of building must be {words} .*{code}"):
                building(*where)
    assert building({"fraction": 0.4}, {}).code_share == 0.4


@pytest.mark.parametrize(
    ("code", "occupancy"),
    # Of each use one occupancy under every code; all under one where storage, shops and offices differ.
    [
        (code, occupancy)
        for code in KNOWN
        for occupancy in USE_OF
        if code == "e030" or occupancy in ("storage", "library", "retail", "office")
    ],
)
def test_goods_and_loads_of_a_larger_fraction_have_it_and_that_is_said(code: str, occupancy: str) -> None:
    """Whatever use is stated; never the lower number; `fraction` and `exempt` of the floor stand above it."""
    goods = {"occupancy": f"{occupancy}, sustained"}
    for use in USES:
        fraction = FRACTIONS[code][USES.index(use)]
        if fraction is None:
            continue
        for load in (2.5, 3.0, 3.5) if code in BY_LOAD else (3.5,):
            right = expected(code, {use, USE_OF[occupancy]}, load)
            for where in (
                {"use": use, **goods},
                {"use": use, "goods": [{"share": 0.4, "mu": 0.2}, {"share": 0.6, **goods}]},
            ):
                found = building({"id": code}, where, load)
                (counted,) = found.counted
                assert counted.fraction == right
                said = [line for line in code_mass_remarks(found) if "more than the use that is stated has" in line]
                assert len(said) == (right > fraction)
                assert all(f"floor 1: {right:g} of its live load is counted as " in line for line in said)
        # Bolted goods are mass in full, and say nothing of the loose ones; what is stated of the floor counts.
        bolted = [{"share": 0.4, "attached": True, **goods}, {"share": 0.6, "occupied": 1.0}]
        assert building({"id": code}, {"use": use, "goods": bolted}).counted[0].fraction == fraction
    assert building({"id": code}, {"fraction": 0.1, **goods}).counted[0].fraction == 0.1
    assert building({"id": code}, {"exempt": True, **goods}).counted[0].fraction == 0.0


def test_storage_under_a_code_of_two_classes_says_which_is_taken() -> None:
    """RPA 99: archives 1.00 where only storage is said, in the remarks and the assumptions; a depot states 0.5."""
    for code in ({"id": "rpa99"}, {"id": "rpa99", "use": "storage"}):
        found = building(code, {})
        assert found.code.fraction == 1.0
        assert "the upper end of 0.5 to 1" in code_remark(found)
        remark = "RPA 99/2003, Algeria has 0.5 to 1 for the use storage, and 1 is taken: 0.50 in depots and hangars"
        assert any(line.startswith(remark) for line in code_mass_remarks(found))
    assert building({"id": "rpa99"}, {"fraction": 0.5}).code_share == 0.5
    assert not any("is taken" in line for line in code_mass_remarks(building({"id": "rpa99", "use": "archive"}, {})))


def test_shops_are_as_full_as_surveys_find_them_and_car_parks_full() -> None:
    """Where nothing is stated: JCSS, 0.9 of 4.79 kPa in shops."""
    for use, share in (("shop", 0.9 / 4.79), ("ordinary", 0.5 / 2.4), ("garage", 1.0), ("archive", 1.0)):
        assert building({"id": "tbdy2018"}, {"use": use}).kinds[0].occupied == share
