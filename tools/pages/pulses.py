"""The pulses of the paper's records and of the FEMA P-695 far-field pairs, as NGA-West2 has them."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Final

import numpy as np
from scipy.signal import butter, sosfiltfilt

import seismass as sm
from pages.parts import Page, table
from seismass.base.values import FloatArray
from seismass.motions.pulses import OrientationScan, PulseResult, baker2007, baker2007_orientations, shahi_baker2014
from seismass.motions.records import Pair, catalogue, find_pairs

ORIENTATIONS: Final = 36
SCALES: Final = (0.5, 0.8, 1.0, 1.25, 2.0)
# An independent implementation of both methods on the same files: period of the pair (2014), orientations (2007).
NONE: Final = (None, 0)
INDEPENDENT: Final = {1: NONE, 2: (2.64, 23), 3: (4.40, 23), 4: NONE, 5: (2.66, 36), 6: NONE, 7: NONE}
SYNTHETIC_DT: Final = 0.01
SYNTHETIC_SAMPLES: Final = 6000
SYNTHETIC_PERIODS: Final = (0.8, 1.5, 2.5, 4.0, 6.0, 8.0)
SEEDS: Final = 10
RSN_OF: Final = {1: "RSN1787", 2: "RSN767", 3: "RSN161", 4: "RSN1612", 5: "RSN821", 6: "RSN6", 7: "RSN1111"}
STRIKES: Final = {1: "1787", 2: "767", 3: "161"}


def fill(page: Page) -> None:
    """Put in the tables and what is said of them."""
    pairs = {pair.name.partition("_")[0]: pair for pair in find_pairs(page.records)}
    paper = catalogue().to_dicts()
    results, scans = {}, {}
    for number, name in RSN_OF.items():
        results[number] = shahi_baker2014(pairs[name])
        scans[number] = baker2007_orientations(pairs[name], orientations=ORIENTATIONS)
    names = {row["number"]: f"{row['event']}, {row['station']}" for row in paper}
    kobe = baker2007(sm.read_record(page.records / "07_Kobe_1995_substitutes" / "RSN1106_KOBE_KJM000.AT2"))
    page.words("30 % of the peak in both directions; {} seeds for each period.", SEEDS)
    of_far_field, pulses, count = far_field(
        pairs, {RSN_OF[number]: (results[number], scans[number]) for number in scans}
    )
    page.tables(
        synthetic_table(),
        seven_table(paper, pairs, results, scans, kobe),
        orientation_table(names, scans),
        size_table(names, pairs, results),
        of_far_field,
    )
    differences(page, pairs, results, scans, kobe)
    found = {number: result for number, result in results.items() if result.is_pulse}
    closest = min(found, key=lambda number: found[number].indicator)
    others = ", ".join(f"{result.indicator:.1f}" for number, result in found.items() if number != closest)
    said = "to the limit.** {} is a pulse by an indicator of {}, where the limit is zero; the other pulses have {}."
    page.words(f"{said} Another", names[closest], f"{found[closest].indicator:.2f}", others)
    page.words("more from the fault. {} of its {} pairs at hand are pulse-like", pulses, count)
    page.figure("pulse_orientations", scans[2].plot)


def noise(seed: int, pgv: float) -> FloatArray:
    """Return a velocity (m/s) of strong shaking between 3 and 20 s, from 0.5 to 15 Hz, without a pulse."""
    time = np.arange(SYNTHETIC_SAMPLES) * SYNTHETIC_DT
    envelope = np.interp(time, [0.0, 3.0, 11.5, 20.0, time[-1]], [0.0, 1.0, 1.0, 0.3, 0.02])
    band = butter(4, (0.5, 15.0), btype="band", fs=1.0 / SYNTHETIC_DT, output="sos")
    white = np.random.default_rng(seed).standard_normal(SYNTHETIC_SAMPLES)
    velocity = sosfiltfilt(band, np.cumsum(sosfiltfilt(band, white * envelope)) * SYNTHETIC_DT)
    return np.asarray(velocity * (pgv / np.abs(velocity).max()))


def synthetic_pair(period: float | None, seed: int, pgv: float) -> Pair:
    """Return noise in two directions, with a pulse of 60 cm/s at 30 degrees where a period is given."""
    along, across = noise(seed, pgv), noise(1000 + seed, pgv)
    if period is not None:
        x = (np.arange(SYNTHETIC_SAMPLES) * SYNTHETIC_DT - 4.0 - 2.0 * period) / period
        bell = np.where(np.abs(x) < 1.0, 0.5 * (1.0 + np.cos(np.pi * x)), 0.0)
        along = along + 0.6 * bell * np.cos(2.0 * np.pi * x)
    cosine, sine = np.cos(np.pi / 6.0), np.sin(np.pi / 6.0)
    components = (along * cosine - across * sine, along * sine + across * cosine)
    records = [sm.Record(np.gradient(velocity, SYNTHETIC_DT), SYNTHETIC_DT) for velocity in components]
    return Pair.from_records(records[0].replace(azimuth=0.0), records[1].replace(azimuth=90.0))


def synthetic_table() -> str:
    """Return what is found of pulses of known period in noise, and in noise alone."""
    rows = []
    for period in SYNTHETIC_PERIODS:
        results = [shahi_baker2014(synthetic_pair(period, seed, 0.18)) for seed in range(SEEDS)]
        ratio = np.array([one.primary.period / period for one in results])
        off = max(abs(one.angle - 30.0) for one in results)
        spread = ", ".join(f"{value:.2f}" for value in (ratio.min(), np.median(ratio), ratio.max()))
        rows.append((f"{period:g}", f"{sum(one.is_pulse for one in results)} of {SEEDS}", spread, f"{off:.1f}°"))
    for pgv in (0.3, 0.6, 1.2):
        results = [shahi_baker2014(synthetic_pair(None, seed, pgv)) for seed in range(2 * SEEDS)]
        found = f"{sum(one.is_pulse for one in results)} of {2 * SEEDS}"
        largest = max(one.indicator for result in results for one in result.candidates if one.early)
        rows.append((f"noise alone, {100.0 * pgv:g} cm/s", found, f"largest indicator {largest:.1f}", ""))
    heads = "period (s) | pulse-like, of seeds | T_p over period: smallest, median, largest | direction off by at most"
    return table(heads, rows).replace("  |", " |")


def strikes(records: Path) -> dict[int, float]:
    """Return the strike (degrees) of the events of the table's records, where the flatfile at hand has them."""
    with (records / "reference" / "nga_w2_selected.csv").open(encoding="utf-8") as file:
        by_number = {row["Record Sequence Number"]: float(row["Strike (deg)"]) for row in csv.DictReader(file)}
    return {number: by_number[rsn] for number, rsn in STRIKES.items()}


def period(value: float | None) -> str:
    """Return a pulse period as the tables write it."""
    return "none" if value is None else f"{value:.2f} s"


def class_2014(result: PulseResult) -> str:
    """Return class, period and indicator."""
    found = period(result.period)
    late = "" if result.early or result.indicator <= 0.0 else ", late"
    return f"{found} (indicator {result.indicator:.2f}{late})"


def class_2007(result: PulseResult) -> str:
    """Return class and indicator of one component."""
    one = result.primary
    found = f"{one.period:.2f} s" if one.is_pulse else one.kind
    return f"{found} ({one.indicator:.2f})"


def seven_table(
    paper: list[dict[str, object]],
    pairs: dict[str, Pair],
    results: dict[int, PulseResult],
    scans: dict[int, OrientationScan],
    kobe: PulseResult,
) -> str:
    """Return the rows of the paper's records beside its Table 1."""
    rows: list[list[object]] = []
    for row in paper:
        number = int(str(row["number"]))
        said = "none" if row["pulse_period"] is None else f"{row['pulse_period']} s"
        start = [number, f"{row['event']}, {row['station']}", said]
        if number == 7:
            rows.append([*start, "not at hand", *[""] * 4])
            of_kobe = f"{kobe.names[0].partition('KJM')[2]}: {class_2007(kobe)}"
            rows.append(["7, substitute", "KJMA (one horizontal at hand)", *[""] * 3, of_kobe, "", ""])
            start = ["7, substitute", "Nishi-Akashi", ""]
        pair, result, (period_of, count) = pairs[RSN_OF[number]], results[number], INDEPENDENT[number]
        components = "; ".join(f"{one.component}: {class_2007(baker2007(one))}" for one in (pair.first, pair.second))
        own = (
            class_2014(result),
            f"{result.primary.azimuth:.0f}°",
            components,
            f"{scans[number].pulses} of {ORIENTATIONS}",
        )
        rows.append([*start, *own, f"{period(period_of)}, {count} of {ORIENTATIONS}"])
    heads = "no. | record | paper | pair (2014) | direction | components (2007) | orientations (2007) | independent"
    return table(heads, rows).replace("  |", " |")


def differences(
    page: Page,
    pairs: dict[str, Pair],
    results: dict[int, PulseResult],
    scans: dict[int, OrientationScan],
    kobe: PulseResult,
) -> None:
    """Put in what differs from Table 1 and from the independent implementation."""
    strike = strikes(page.records)
    normal = {
        number: baker2007(pairs[RSN_OF[number]].fault_normal_parallel(degrees).first)
        for number, degrees in strike.items()
    }
    equal = all(
        (None if results[n].period is None else round(results[n].period or 0.0, 2), scans[n].pulses) == found
        for n, found in INDEPENDENT.items()
    )
    agreement = "Every class, period and count" if equal else "NOT every class, period and count"
    page.words("\n\n{} of the independent implementation is met to its last digit.", agreement)
    found = scans[6].strongest.indicator, scans[5].pulses, results[5].period
    said = (
        "El Centro has no pulse in any of {} orientations (largest indicator {}). Erzincan has one in {}, and {} s as"
    )
    page.words(f"{said} a pair.", ORIENTATIONS, f"{found[0]:.2f}", found[1], f"{found[2]:.2f}")
    brawley = f"{normal[3].primary.period:.2f}", f"{strike[3]:g}", f"{results[3].period:.2f}"
    said = "component: {} s by Baker (2007), turned by the strike of the flatfile, {} degrees. The pair has {} s."
    page.words(said, *brawley)
    gilroy = f"{results[2].period:.2f}", f"{baker2007(pairs['RSN767'].second).primary.period:.2f}"
    page.words("2.6 s is that of the pair, {} s, and of component 090, {} s.", *gilroy)
    of = f"{strike[2]:g}", normal[2].primary.kind, f"{normal[2].indicator:.2f}", f"{normal[2].primary.period:.2f}"
    page.words("The fault-normal component (strike {} degrees) is {}: indicator {}, wavelet of {} s.", *of)
    page.words("fault-normal component has an indicator of {}. Lamont", f"{normal[1].indicator:.2f}")
    page.words("at a peak velocity of {} cm/s, too small", f"{100.0 * results[4].pgv:.0f}")
    of = kobe.primary.kind, f"{kobe.indicator:.2f}", f"{100.0 * kobe.pgv:.0f}"
    page.words("was at hand, is {} in it: indicator {}, peak velocity {} cm/s.", *of)


def orientation_table(names: dict[int, str], scans: dict[int, OrientationScan]) -> str:
    """Return classes and the spread of periods by orientation."""
    rows = []
    for number, scan in scans.items():
        name = "Nishi-Akashi (substitute)" if number == 7 else names[number]
        periods = [one.period for one in scan.results if one.period is not None]
        spread = f"{min(periods):.2f}, {np.median(periods):.2f}, {max(periods):.2f} s" if periods else "no orientation"
        most = max(one.indicator for one in scan.results)
        rows.append((name, scan.pulses, scan.ambiguous, spread, f"{most:.2f}"))
    heads = f"record | pulse in, of {ORIENTATIONS} | ambiguous in | T_p, smallest, median, largest | largest indicator"
    return table(heads, rows)


def size_table(names: dict[int, str], pairs: dict[str, Pair], recorded: dict[int, PulseResult]) -> str:
    """Return the class of 2014 of scaled pairs."""
    rows = []
    for number in range(1, 7):
        pair = pairs[RSN_OF[number]]
        found = [recorded[number] if scale == 1.0 else shahi_baker2014(pair.scaled(scale)) for scale in SCALES]
        rows.append([names[number], *(f"{period(result.period)} ({result.indicator:.2f})" for result in found)])
    return table(["record", *(f"times {scale:g}" for scale in SCALES)], rows)


def far_field(pairs: dict[str, Pair], known: dict[str, tuple[PulseResult, OrientationScan]]) -> tuple[str, int, int]:
    """Return the table of the far-field pairs, how many are pulse-like, and how many there are."""
    chosen = [
        name
        for name, pair in pairs.items()
        if (pair.first.source is not None and pair.first.source.parent.name == "fema_p695_far_field")
        or name in ("RSN1787", "RSN767", "RSN1111")
    ]
    rows, pulses = [], 0
    for name in sorted(chosen, key=lambda one: int(one[3:])):
        pair = pairs[name]
        scanned = known.get(name) or (shahi_baker2014(pair), baker2007_orientations(pair, orientations=ORIENTATIONS))
        result, scan = scanned
        pulses += result.is_pulse
        early = "yes" if result.early else "no"
        counts = f"{scan.pulses} of {ORIENTATIONS}, {scan.ambiguous} ambiguous"
        place = f"{pair.event}, {pair.station}"
        rows.append((name, place, class_2014(result), f"{100.0 * result.pgv:.0f}", early, counts))
    heads = "record | event, station | pair (2014) | PGV (cm/s) | early | orientations (2007)"
    return table(heads, rows), pulses, len(chosen)
