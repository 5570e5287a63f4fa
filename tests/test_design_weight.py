"""Effective seismic weight: items and exceptions of ASCE 7, 12.7.2, and rules of other codes, by hand."""

from __future__ import annotations

import numpy as np
import pytest

import seismass as sm
from seismass import design
from seismass.model import codes
from seismass.model.codes import FROM_MEMORY, SECOND_HAND, VERIFIED


@pytest.mark.parametrize(
    "row", codes.code_table().drop_nulls("fraction").to_dicts(), ids=lambda row: f"{row['code_id']}-{row['use']}"
)
def test_floors_have_the_fraction_of_every_code(row: dict) -> None:
    """Two floors that are no roof: dead load and the fraction of the table, its status and its clause."""
    found = design.effective_seismic_weight(
        [100.0, 100.0], [400.0, 400.0], code_id=row["code_id"], use=row["use"], roof=False
    )
    np.testing.assert_allclose(found.weight, 100.0 + row["fraction"] * 400.0, rtol=1e-14)
    assert found.rules.rows() == [
        (f"{row['fraction']:g} of the live load ({row['use']})", row["clause"], row["status"])
    ]
    assert found.status == row["status"]
    assert found.total == pytest.approx(found.weight.sum())
    np.testing.assert_allclose(found.mass, found.weight / 9.80665, rtol=1e-15)


def test_storage_of_at_most_five_percent_is_exempt() -> None:
    """ASCE/SEI 7-10, 12.7.2, item 1a: 0.25 x 200 = 50 is 5 % of 1000; 0.25 x 204 = 51 is more; with 40 of equipment it
    is less than 5 % of 1040.
    """
    found = design.effective_seismic_weight([1000.0] * 3, [200.0, 204.0, 204.0], equipment=[0.0, 0.0, 40.0])
    np.testing.assert_allclose(found.weight, [1000.0, 1051.0, 1040.0], rtol=1e-14)
    assert found.table["exception"].to_list() == [
        "at most 5 % of the weight of the level",
        "",
        found.table["exception"][0],
    ]
    assert found.status == VERIFIED
    # 7-22: storage, equipment and landscaping together, 25 + 20 + 5 of 1000; then with 6 all of them count.
    for landscaping, expected in ((5.0, 1000.0), (6.0, 1051.0)):
        newer = design.effective_seismic_weight(
            [1000.0], [100.0], code_id="asce7-22", equipment=[20.0], landscaping=[landscaping]
        )
        assert newer.total == pytest.approx(expected, rel=1e-14)
        assert newer.status == SECOND_HAND
    # Elsewhere there is no such exception.
    assert design.effective_seismic_weight([1000.0], [10.0], code_id="nbc").total == pytest.approx(1006.0)


def test_garages_are_exempt_where_the_code_says_so() -> None:
    found = design.effective_seismic_weight([1000.0] * 2, [800.0] * 2, use=["garage", "storage"])
    np.testing.assert_allclose(found.weight, [1000.0, 1200.0], rtol=1e-14)
    assert found.table["exception"].to_list() == ["garage", ""]
    assert design.effective_seismic_weight([1.0], [9.0], code_id="nbc", use="garage").status == FROM_MEMORY
    with pytest.raises(
        sm.errors.InvalidOption, match="use of code nch433 must be storage or ordinary or shop or assembly; got garage"
    ):
        design.effective_seismic_weight([1.0], [9.0], code_id="nch433", use="garage")


def test_partitions_count_with_their_minimum() -> None:
    """Item 2: the larger of the actual weight and 0.48 kPa; floors without the provision count none."""
    area = [100.0, 100.0, 100.0]
    given = [30e3, 60e3, np.nan]
    found = design.effective_seismic_weight([1e6] * 3, [1.0] * 3, use="ordinary", area=area, partitions=given)
    np.testing.assert_allclose(found.table["partitions"], [48e3, 60e3, 0.0])
    elsewhere = design.effective_seismic_weight(
        [1e6] * 3, [1.0] * 3, code_id="gb50011", use="ordinary", partitions=given
    )
    np.testing.assert_allclose(elsewhere.table["partitions"], [30e3, 60e3, 0.0])
    with pytest.raises(
        sm.errors.InvalidOption, match="area of seismic weight must be given where partitions are; got none"
    ):
        design.effective_seismic_weight([1e6], [1.0], partitions=[1.0])


@pytest.mark.parametrize(
    ("code_id", "snow", "share"),
    [
        # ASCE/SEI 7-10: 20 % above 1.44 kPa (30 psf); 7-22: 15 % above 45 psf; NBC: 25 % always.
        ("asce7-10", 1440.0, 0.0),
        ("asce7-10", 1500.0, 0.2),
        ("asce7-22", 2000.0, 0.0),
        ("asce7-22", 2500.0, 0.15),
        ("nbc", 500.0, 0.25),
    ],
)
def test_snow_on_the_roof(code_id: str, snow: float, share: float) -> None:
    found = design.effective_seismic_weight(
        [1e6, 1e6], [0.0, 0.0], code_id=code_id, use="ordinary", area=[200.0, 100.0], snow=snow
    )
    np.testing.assert_allclose(found.weight, [1e6, 1e6 + share * snow * 100.0], rtol=1e-14)


def test_roofs_of_other_codes() -> None:
    """IS 1893 and NZS 1170.5 count no live load of the roof; Eurocode 8 0.3 (phi = 1.0)."""
    for code_id, use, roof, floor in (
        ("is1893", "storage", 0.0, 0.5),
        ("nzs1170.5", "ordinary", 0.0, 0.3),
        ("ec8", "ordinary", 0.3, 0.3),
        ("asce7-10", "storage", 0.25, 0.25),
    ):
        found = design.effective_seismic_weight([100.0] * 2, [100.0] * 2, code_id=code_id, use=use)  # type: ignore[arg-type]
        np.testing.assert_allclose(found.weight, [100.0 + 100.0 * floor, 100.0 + 100.0 * roof], rtol=1e-14)


def test_live_load_per_area_decides_in_some_codes() -> None:
    """BNBC 2017, 2.5.7.3: 25 % up to and including 3 kPa, 50 % above."""
    found = design.effective_seismic_weight([0.0] * 3, [2e5, 3e5, 4e5], code_id="bnbc2017", area=[100.0] * 3)
    np.testing.assert_allclose(found.weight, [5e4, 7.5e4, 2e5], rtol=1e-14)
    assert found.table["use"].to_list() == ["ordinary", "ordinary", "storage"]
    assert found.status == VERIFIED
    stated = design.effective_seismic_weight([0.0], [2e5], code_id="bnbc2017", area=[100.0], use="storage")
    assert stated.total == pytest.approx(1e5)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"live": [1.0]}, "live of seismic weight must be 2 values, one per floor; got 1 values"),
        ({"dead": [1.0, -1.0]}, r"dead of seismic weight must be numbers of at least 0; got \[1.0, -1.0\]"),
        (
            {"use": "office"},
            "use of seismic weight must be one of storage, archive, assembly, shop, .*; got 'office'",
        ),
        ({"use": ["storage"]}, "use of seismic weight must be one use or a list of 2, one per floor; got 1 of them"),
        ({"snow": 1e3, "code_id": "ec8"}, "snow of code ec8 must be left out: its rule for snow is not known here"),
        ({"snow": 1e3}, "area of seismic weight must be given where snow is; got none"),
        ({"area": [1.0]}, "area of seismic weight must be 2 values, one per floor; got 1 values"),
        ({"code_id": "aashto", "use": "ordinary"}, "use of code aashto must be storage; got ordinary"),
    ],
)
def test_bad_arguments_are_refused(arguments: dict, message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=message):
        design.effective_seismic_weight(**({"dead": [1.0, 1.0], "live": [1.0, 1.0]} | arguments))
