"""Code fractions and friction pairs: values as their sources have them, and what is refused."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.cli import main
from seismass.model import codes
from seismass.model.codes import CODE_IDS, VERIFIED
from seismass.model.friction import FRICTION_IDS
from seismass.show.effective_mass import CODES_LEGEND, STORAGE_CODES
from seismass.show.explore.page import _codes


@pytest.mark.parametrize(
    ("code_id", "use", "low", "fraction"),
    [
        # The clauses of the table: ASCE 7-10 12.7.2 and 15.5.3.6; EN 1998-1 4.2.4, phi psi_2 = 1.0 x 0.8, and 0.5 x 0.3
        # to 1.0 x 0.3; NZS 1170.5 4.2; NBC 4.1.8.2; Japan art. 85, offices 0.8 of 2.9 kPa, classrooms 1.1 of 2.3.
        ("asce7-10", "storage", 0.25, 0.25),
        ("asce7-10", "ordinary", 0.0, 0.0),
        ("asce7-10-racks", "storage", 0.67, 0.67),
        ("asce61-14", "storage", 0.10, 0.10),
        ("aashto", "storage", 0.0, 0.0),
        ("ec8", "storage", 0.8, 0.8),
        ("ec8", "ordinary", 0.15, 0.30),
        ("nzs1170.5", "storage", 0.6, 0.6),
        ("nbc", "storage", 0.6, 0.6),
        ("japan-bsl", "ordinary", 0.28, 0.48),
        ("e030", "storage", 0.8, 0.8),
        ("gb50011", "ordinary", 0.5, 0.5),
        # TBDY 2018, table 4.3, as handbooks quote it: depots; schools, shops and restaurants; dwellings and car parks.
        ("tbdy2018", "storage", 0.8, 0.8),
        ("tbdy2018", "shop", 0.6, 0.6),
        ("tbdy2018", "garage", 0.3, 0.3),
        ("tbdy2018", "ordinary", 0.3, 0.3),
        # RPA 99/2003, table of beta, from memory: 0.50 depots, 1.00 archives and libraries, 0.60 other uses.
        ("rpa99", "storage", 0.5, 1.0),
        ("rpa99", "archive", 1.0, 1.0),
        # E.030, article 26; EN 1998-1, 4.2.4 with EN 1990, psi_2 of categories C and F, phi of the roof; NZS
        # and IS 1893 count no roofs; COVENIN 1756, 7.1; SNI 1726, 7.7.2.
        ("e030", "important", 0.5, 0.5),
        ("e030", "roof", 0.25, 0.25),
        ("ec8", "assembly", 0.3, 0.6),
        ("ec8", "garage", 0.6, 0.6),
        ("ec8", "roof", 0.3, 0.3),
        ("nzs1170.5", "roof", 0.0, 0.0),
        ("is1893", "roof", 0.0, 0.0),
        ("tbdy2018", "assembly", 0.6, 0.6),
        ("covenin1756", "assembly", 0.5, 0.5),
        ("sni1726", "storage", 0.25, 0.25),
        ("asce7-10", "assembly", 0.0, 0.0),
        ("rpa99", "shop", 0.6, 0.6),
        # Without a row of their own: archives are storage, shops ordinary floors.
        ("tbdy2018", "archive", 0.8, 0.8),
        ("asce7-10", "archive", 0.25, 0.25),
        ("asce7-10", "shop", 0.0, 0.0),
        ("asce7-10", "garage", 0.0, 0.0),
    ],
)
def test_fraction_of_a_code(code_id: str, use: codes.Use, low: float, fraction: float) -> None:
    row = sm.codes.code_fraction(code_id, use)
    assert (row.low, row.fraction, row.high) == (low, fraction, fraction)


def test_fractions_for_storage_spread_over_the_whole_range() -> None:
    """The spread of domain knowledge: 0, 0.10, 0.25, 0.50, 0.60, 0.67, 0.80, 1.0."""
    storage = sm.codes.code_table().filter(use="storage")
    assert storage["fraction"].drop_nulls().unique().sort().to_list() == [0.0, 0.10, 0.25, 0.50, 0.60, 0.67, 0.80, 1.0]


def test_every_row_is_in_range_and_says_how_it_was_checked() -> None:
    table = sm.codes.code_table()
    assert table.select("code_id", "use").is_unique().all()
    assert set(table["status"]) == {VERIFIED, "second-hand", "from memory, unverified", codes.NOT_KNOWN}
    # Nothing is known of these: rows without a number.
    unknown = table.filter(status=codes.NOT_KNOWN)
    assert unknown["fraction"].null_count() == unknown.height > 0
    assert table["fraction"].null_count() == unknown.height
    with pytest.raises(sm.errors.InvalidOption, match="id of code must be one whose fractions are known here"):
        sm.codes.code_fraction("taiwan", "shop")
    for row in table.filter(pl.col("status") != codes.NOT_KNOWN).iter_rows(named=True):
        assert 0.0 <= row["low"] <= row["fraction"] == row["high"] <= 1.0
        assert row["code"]
    # Read in the text of the code itself: ASCE 7-10 and BNBC 2017.
    verified = table.filter(status=VERIFIED)["code_id"].unique().sort().to_list()
    assert verified == ["asce7-10", "asce7-10-racks", "bnbc2017"]


def test_codes_are_found_in_any_case_and_close_ones_are_named() -> None:
    assert sm.codes.code_fraction(" ASCE7-22 ").code == "ASCE/SEI 7-22"
    with pytest.raises(sm.errors.InvalidOption, match=re.escape("did you mean asce7-16?); got 'asce7-11'")):
        sm.codes.code_fraction("asce7-11")
    with pytest.raises(sm.errors.InvalidOption, match="use of code aashto must be storage; got ordinary"):
        sm.codes.code_fraction("aashto", "ordinary")
    with pytest.raises(
        sm.errors.InvalidOption, match="use of code nch433 must be storage or ordinary or shop or assembly; got garage"
    ):
        sm.codes.code_fraction("nch433", "garage")
    with pytest.raises(sm.errors.InvalidOption, match=r"use of code must be one of storage, archive, .*; got 'office'"):
        sm.codes.code_fraction("ec8", "office")  # type: ignore[arg-type]
    with pytest.raises(sm.errors.InvalidOption, match=r"id of code must be one of asce7-10, .*; got 7"):
        sm.codes.code_fraction(7)  # type: ignore[arg-type]
    assert len(CODE_IDS) >= 15


@pytest.mark.parametrize(
    ("pair_id", "mu_s", "mu_k"),
    [
        # UNECE CTU Code, appendix 2, kinetic 75 % of static; the EU guideline; pull tests 0.37 to 0.45.
        ("timber-on-plywood", 0.45, 0.3375),
        ("steel-crate-on-stainless", 0.20, 0.15),
        ("concrete-on-timber", 0.70, 0.525),
        ("timber-on-steel", 0.40, 0.30),
        ("pallet-on-wire-deck", 0.41, 0.41),
        ("pallet-on-steel-beam", 0.37, 0.37),
        # Abstracts of Rabbat and Russell 1985 (dry) and TRL LR491 (0.03 to 0.07); roymech.org; two tables on the web.
        ("steel-on-concrete", 0.57, 0.57),
        ("ptfe-slider-on-steel", 0.05, 0.05),
        ("felt-pad-on-metal", 0.22, 0.22),
        ("wheel-on-rail", 0.002, 0.002),
    ],
)
def test_friction_of_a_contact(pair_id: str, mu_s: float, mu_k: float) -> None:
    pair = sm.friction.friction_pair(pair_id)
    assert (pair.mu_s, pair.mu_k) == (mu_s, mu_k)
    assert pair.source
    low, high = pair.bounds()
    assert (low, high) == (0.67 * mu_s, 1.5 * mu_s)  # EN 16681, second-hand


def test_contacts_without_a_measurement_say_so() -> None:
    table = sm.friction.friction_table()
    assumed = table.filter(kind="assumption")
    assert assumed["pair_id"].to_list() == ["container-validation", "container-study", "book-on-metal-shelf"]
    assert assumed["source"].str.contains("no measurement of this contact was found").all()


def test_friction_table_has_bounds_by_the_factors_given() -> None:
    table = sm.friction.friction_table((0.8, 1.25))
    assert table["pair_id"].to_list() == list(FRICTION_IDS)
    for row in table.iter_rows(named=True):
        assert 0.0 < row["mu_k"] <= row["mu_s"] < 1.0
        assert (row["mu_low"], row["mu_high"]) == (0.8 * row["mu_s"], 1.25 * row["mu_s"])


def test_contacts_that_are_none_are_refused_with_close_ones() -> None:
    with pytest.raises(sm.errors.InvalidOption, match=r"did you mean timber-on-steel or .*\); got 'wood-on-steel'"):
        sm.friction.friction_pair("wood-on-steel")
    with pytest.raises(sm.errors.InvalidOption, match="did you mean container-study or container-validation"):
        sm.friction.friction_pair("container")
    for factors in ((1.5, 0.67), (0.0, 1.5), (0.67, float("inf")), (1.0,), "ab"):
        with pytest.raises(sm.errors.InvalidOption, match=r"mu_factors of friction pair must be two factors, .*; got"):
            sm.friction.friction_table(factors)  # type: ignore[arg-type]


def test_the_page_has_every_row() -> None:
    page = (Path(__file__).parents[1] / "docs" / "codes.md").read_text(encoding="utf-8")
    for row in sm.codes.code_table().iter_rows(named=True):
        known = row["fraction"] is not None
        ranged = known and row["low"] < row["high"]
        fraction = f"{row['low']:g} to {row['high']:g}" if ranged else f"{row['fraction']:g}" if known else ""
        code = row["code"] + codes.MARK * (not row["checked"])
        cells = (
            f"`{row['code_id']}`",
            code,
            row["edition"],
            row["use"],
            fraction,
            row["clause"],
            row["status"],
            row["note"],
        )
        assert f"| {' | '.join(cells)} |\n" in page
    for row in sm.friction.friction_table().iter_rows(named=True):
        numbers = (f"{row['mu_s']:g}", f"{row['mu_k']:.4g}")
        cells = (f"`{row['pair_id']}`", row["contact"], *numbers, row["source"], row["kind"])
        assert f"| {' | '.join(cells)} |\n" in page


def test_figures_mark_the_shares_of_the_table_of_codes() -> None:
    assert dict(STORAGE_CODES) == {
        "ASCE 7, NSR-10†": 0.25,
        "IS 1893†, NCh2369†": 0.50,
        "NBC†, NZS 1170.5†": 0.60,
        "Eurocode 8†, E.030†": 0.80,
    }


def test_rows_that_were_not_read_in_the_code_are_marked_and_counted_everywhere(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """One mark and one legend, in the table of the command, the page, the README, the live page and figures."""
    table = sm.codes.code_table()
    counts = {status: table.filter(status=status).height for status in set(table["status"])}
    legend = sm.codes.code_legend()
    assert legend == (
        f"† not checked against the code: {counts['second-hand']} of {table.height} rows are second-hand, "
        f"{counts['from memory, unverified']} from memory, {counts[codes.NOT_KNOWN]} empty; {counts['verified']} were "
        "read in the text named"
    )
    assert table.filter(checked=False).height == table.height - counts["verified"]
    assert main(["building", "--codes"]) == 0
    printed = capsys.readouterr().out
    assert legend in printed
    assert printed.count("†") == table.filter(checked=False).height + 1
    root = Path(__file__).parents[1]
    for page in ("README.md", "docs/codes.md"):
        text = " ".join((root / page).read_text(encoding="utf-8").replace("**", "").split())
        assert legend in text, page
    rows = [sm.codes.code_fraction(code_id, "storage") for code_id in ("asce7-10", "nbc")]
    assert [row.mark for row in rows] == ["", "†"]
    assert CODES_LEGEND == "† not checked against the code"
    assert [text.count("†") for _, text in _codes()] == [0, 0, 1, 1, 0]


G = sm.STANDARD_GRAVITY


def building_of(kinds: list[dict], **code: object) -> sm.OwnBuilding:
    """One floor of 100 m2 with 10 kPa of goods of several kinds, its share and use each."""
    return sm.read_building(
        {
            "code": {"id": "asce7-16"} | code,
            "building": {"period_s": 0.5, "area_m2": 100, "dead_load_kpa": 5, "yield_shear_over_weight": 0.3},
            "goods": {"live_load_kpa": 10.0, "mu": 0.3, "occupied": 1.0},
            "storeys": [{"goods": kinds}, {"use": "storage"}],
        }
    )


@pytest.mark.parametrize("seed", range(8))
def test_a_floor_counts_each_kind_of_goods_by_its_use(seed: int) -> None:
    """The fraction of a floor is the mean of those of its kinds by their live loads; bolted goods are mass already."""
    random = np.random.default_rng(seed)
    code = str(random.choice(["ec8", "tbdy2018", "rpa99", "covenin1756", "e030", "iran2800"]))
    shares = random.dirichlet(np.ones(3))
    uses = random.choice(["storage", "archive", "assembly", "shop", "ordinary"], 3)
    kinds = [{"share": float(share), "use": str(use)} for share, use in zip(shares, uses, strict=True)]
    own = building_of(kinds, id=code)
    expected = sum(share * sm.codes.code_fraction(code, use).fraction for share, use in zip(shares, uses, strict=True))
    assert own.counted[0].fraction == pytest.approx(expected, rel=1e-12)
    assert own.counted[1].fraction == sm.codes.code_fraction(code, "storage").fraction
    assert own.code_mass[0] == pytest.approx(expected * 1e6 / G, rel=1e-12)
    assert all(use in own.uses for use in uses)


def test_uses_stand_by_floor_where_they_differ_and_goods_have_one_for_all() -> None:
    own = sm.read_building(
        {
            "code": {"id": "asce7-16", "use": "ordinary"},
            "building": {"period_s": 0.5, "area_m2": 100, "dead_load_kpa": 5, "yield_shear_over_weight": 0.3},
            "goods": {"live_load_kpa": 10.0, "mu": 0.3},
            "storeys": [{}, {"use": "archive"}, {}, {"live_load_kpa": 0}],
        }
    )
    assert own.uses == "ordinary (floor 1, 3) and archive (floor 2)"
    assert [one.fraction for one in own.counted][:3] == [0.0, 0.25, 0.0]
    assert building_of([{"share": 1.0}], use="shop").uses == "shop (floor 1) and storage (floor 2)"
    # Storage of two kinds on one floor is exempt together or not at all (12.7.2): 0.25 x 0.9 of 5 kPa is 4.5 %.
    small = building_of([{"share": 0.06, "use": "storage"}, {"share": 0.94, "use": "ordinary"}])
    assert "exempt" in small.counted[0].exception
    both = building_of([{"share": 0.06, "use": k} for k in ("storage", "archive")] + [{"share": 0.88, "use": "shop"}])
    assert both.counted[0].fraction == pytest.approx(0.12 * 0.25, rel=1e-12)
    with pytest.raises(
        sm.errors.InvalidBuildingFile, match=r"goods.1..use of building must be one of storage, archive"
    ):
        building_of([{"share": 1.0, "use": "office"}])
