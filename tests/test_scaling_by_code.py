"""Rules of scaling by code, one name each: every one against an own computation of its clause, singles and pairs."""

from __future__ import annotations

import numpy as np
import pytest

import seismass as sm
from seismass.commands.scale import BY_CODE
from seismass.design.scaling import SCALING_CODES, scale_by_code

TARGET = sm.TargetSpectrum.asce7(1.1, 0.5)
EC8 = sm.TargetSpectrum.eurocode8(1, "C", agr_g=0.25)
T = 0.62


def short_pairs(count: int) -> list[sm.Pair]:
    """The strong part of built-in pairs, with an own factor for each component, so that no two are alike."""
    found = []
    for number, pair in enumerate(sm.records.builtin_pairs()[:count]):
        middle = int(np.argmax(np.abs(pair.first.acceleration)))
        part = slice(max(0, middle - 150), middle + 350)
        records = [
            sm.Record(record.acceleration[part] * (1.0 + 0.13 * number) * factor, record.dt, f"p{number}{axis}")
            for axis, record, factor in (("a", pair.first, 1.0), ("b", pair.second, 0.6 + 0.1 * (number % 7)))
        ]
        found.append(sm.Pair.from_records(*records))
    return found


PAIRS = short_pairs(12)
SINGLES = [pair.first for pair in PAIRS]


def components(periods: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    first, second = (sm.response_spectrum([getattr(p, name) for p in PAIRS], periods) for name in ("first", "second"))
    return first, second


def largest_direction(periods: np.ndarray) -> np.ndarray:
    return np.array([sm.records.rotd(pair, periods)[100] for pair in PAIRS])


# Range as multiples of T, share of the target (singles, pairs), and the spectrum of a pair, as the clauses have them.
MEAN_RULES = {
    "asce7-10": ((0.2, 1.5), (1.0, 1.0), lambda at: np.hypot(*components(at))),
    "asce7-16": ((0.2, 2.0), (0.9, 0.9), largest_direction),
    "asce7-22": ((0.2, 2.0), (0.9, 0.9), largest_direction),
    "ec8": ((0.2, 2.0), (0.9, 0.9), lambda at: 0.5 * sum(components(at))),
    "tbdy2018": ((0.2, 1.5), (1.0, 1.3), lambda at: np.hypot(*components(at))),
    "bnbc2017": ((0.2, 1.5), (1.0, 1.3), lambda at: np.hypot(*components(at))),
    "geometric-mean": ((0.2, 1.5), (1.0, 1.0), lambda at: np.sqrt(np.prod(components(at), axis=0))),
}


def test_names_are_those_of_the_command_and_each_is_checked_here() -> None:
    assert BY_CODE == SCALING_CODES
    assert set(SCALING_CODES) == {*MEAN_RULES, "nzs1170.5"}


@pytest.mark.parametrize("pairs", [False, True], ids=["singles", "pairs"])
@pytest.mark.parametrize("code", MEAN_RULES)
def test_the_mean_reaches_the_share_of_the_target_over_the_range(code: str, pairs: bool) -> None:
    (low, high), shares, of_pair = MEAN_RULES[code]
    found = scale_by_code(PAIRS if pairs else SINGLES, TARGET, T, code_id=code, between=False)
    at = np.geomspace(low * T, high * T, 100)
    np.testing.assert_allclose(found.periods, at, rtol=1e-12)
    spectra = of_pair(at) if pairs else components(at)[0]
    individual = np.exp(np.mean(np.log(TARGET(at) / spectra), axis=1))
    mean = np.mean(individual[:, None] * spectra, axis=0)
    common = np.max(shares[pairs] * TARGET(at) / mean)
    if code == "ec8":
        # 3.2.3.1.2(4)b: the mean of the peak accelerations is not below that of the spectrum at T = 0.
        peaks = [np.mean([np.abs(r.acceleration).max() for r in pair][: 1 + pairs]) for pair in PAIRS]
        common = max(common, TARGET(0.0) / np.mean(individual * peaks))
    np.testing.assert_allclose(found.factors, individual * common, rtol=1e-10)


def test_zero_period_of_eurocode_8_can_decide() -> None:
    smooth = [sm.Motion(np.sin(2.0 * np.pi * np.arange(2000) * 0.005 / (0.3 + 0.1 * n)) * 0.1, 0.005) for n in range(4)]
    found = scale_by_code(smooth, EC8, T, code_id="ec8", between=False)
    peaks = found.factors * [np.abs(motion.acceleration).max() for motion in smooth]
    assert (
        np.mean(peaks) == pytest.approx(0.25 * 1.15 * sm.STANDARD_GRAVITY, rel=1e-12) or found.least_ratio < 0.9 + 1e-9
    )
    assert np.mean(peaks) >= 0.25 * 1.15 * sm.STANDARD_GRAVITY * (1.0 - 1e-12)
    assert any("4 motions" in note and "seven" in note for note in found.notes)


@pytest.mark.parametrize("pairs", [False, True], ids=["singles", "pairs"])
@pytest.mark.parametrize(("mu", "s_p"), [(None, 0.7), (1.0, 1.0), (1.5, 0.85), (4.0, 0.7)])
@pytest.mark.parametrize("period", [0.25, 0.62])
def test_new_zealand_has_k1_of_each_record_and_k2_of_the_family(
    pairs: bool, mu: float | None, s_p: float, period: float
) -> None:
    """NZS 1170.5, 5.5.2: the integral over the period on a fine grid of its own; T of at least 0.4 s."""
    found = scale_by_code(PAIRS if pairs else SINGLES, TARGET, period, code_id="nzs1170.5", ductility=mu)
    longest = max(period, 0.4)
    at = np.linspace(0.4 * longest, 1.3 * longest, 400)
    target = 0.5 * (1.0 + s_p) * TARGET(at)
    first, second = components(at)
    k_1 = [np.exp(np.mean(np.log(target / spectra), axis=1)) for spectra in (first, second)]
    principal = np.argmin(k_1, axis=0) if pairs else np.zeros(len(PAIRS), dtype=int)
    factors = np.array([k_1[axis][n] for n, axis in enumerate(principal)])
    spectra = np.array([(first, second)[axis][n] for n, axis in enumerate(principal)])
    k_2 = max(1.0, np.max(target / np.max(factors[:, None] * spectra, axis=0)))
    # The mean over 100 periods in geometric spacing beside that over 400.
    np.testing.assert_allclose(found.individual, factors, rtol=2e-3)
    assert found.common == pytest.approx(k_2, rel=5e-3)
    np.testing.assert_allclose(found.factors, found.individual * found.common, rtol=1e-14)


@pytest.mark.parametrize(
    ("code", "least", "clause"),
    [
        ("asce7-10", 3, "ASCE/SEI 7-10, 16.1.3"),
        ("asce7-22", 11, "ASCE/SEI 7-22, 16.2.2"),
        ("ec8", 3, "3.2.3.1.2"),
        ("nzs1170.5", 3, "5.5.1"),
        ("tbdy2018", 11, "2.5"),
        ("bnbc2017", 3, "2.5.10.2"),
    ],
)
def test_every_code_has_its_least_number_of_motions(code: str, least: int, clause: str) -> None:
    with pytest.raises(sm.errors.InvalidMotion, match=rf"at least \w+ motions \(.*{clause}.*got {least - 1}"):
        scale_by_code(SINGLES[: least - 1], TARGET, T, code_id=code)
    assert len(scale_by_code(SINGLES[:least], TARGET, T, code_id=code, between=False).factors) == least


def test_pairs_and_singles_are_not_mixed_where_pairs_have_a_rule() -> None:
    with pytest.raises(sm.errors.InvalidMotion, match=r"pairs, all or none \(2\.5\.2\)"):
        scale_by_code([*PAIRS[:11], SINGLES[0]], TARGET, T, code_id="tbdy2018")
    with pytest.raises(sm.errors.InvalidOption, match="id of scaling must be one of asce7-10"):
        scale_by_code(SINGLES, TARGET, T, code_id="nbc")


def test_a_target_times_a_number() -> None:
    more = EC8.times(1.5)
    at = np.array([0.1, 0.5, 2.0])
    np.testing.assert_allclose(more(at), 1.5 * EC8(at), rtol=1e-15)
    assert more.label.startswith("1.5 times ")
    assert more != EC8 == more.times(1.0 / 1.5)
    assert more.tilted(0.3).times(2.0).parameters["factor"] == 3.0
