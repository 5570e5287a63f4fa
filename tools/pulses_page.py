"""Writes docs/pulses.md and its figure: the pulses of the paper's records and of the FEMA P-695 far-field pairs.

Usage: SEISMASS_SHARED=... python tools/pulses_page.py
The recordings are not part of this project: SEISMASS_SHARED names the folder that holds them.
"""

from __future__ import annotations

import csv
import os
import re
import sys
import textwrap
from collections.abc import Iterable
from pathlib import Path
from typing import Final

import numpy as np
from scipy.signal import butter, sosfiltfilt

import seismass as sm
from seismass.base.values import FloatArray
from seismass.media.figure_file import save_figure
from seismass.pulses import OrientationScan, PulseResult, baker2007, baker2007_orientations, shahi_baker2014
from seismass.records import Pair, catalogue, find_pairs

ROOT: Final = Path(__file__).parents[1]
PAGE: Final = ROOT / "docs" / "pulses.md"
FIGURE: Final = ROOT / "docs" / "figures" / "pulse_orientations.png"
ORIENTATIONS: Final = 36
SCALES: Final = (0.5, 0.8, 1.25, 2.0)
# An independent implementation of both methods on the same files: period of the pair (2014), orientations (2007).
INDEPENDENT: Final = {1: (None, 0), 2: (2.64, 23), 3: (4.40, 23), 4: (None, 0), 5: (2.66, 36), 6: (None, 0)}
INDEPENDENT_NISHI_AKASHI: Final = (None, 0)
SYNTHETIC_DT: Final = 0.01
SYNTHETIC_SAMPLES: Final = 6000
SYNTHETIC_PERIODS: Final = (0.8, 1.5, 2.5, 4.0, 6.0, 8.0)
SEEDS: Final = 10
RSN_OF: Final = {1: "RSN1787", 2: "RSN767", 3: "RSN161", 4: "RSN1612", 5: "RSN821", 6: "RSN6", 7: "RSN1111"}
STRIKES: Final = {1: "1787", 2: "767", 3: "161"}

TEXT: Final = """# Velocity pulses

Near a fault that ruptures towards the site, much of the motion may arrive as a velocity pulse. `seismass.pulses`
detects such pulses by two published methods, with the db4 wavelet of PyWavelets (`pip install PyWavelets`):

```sh
seismass pulse RSN767_LOMAP_G03000.AT2 RSN767_LOMAP_G03090.AT2 --plot pulse.png
seismass pulse RSN767_LOMAP_G03000.AT2 RSN767_LOMAP_G03090.AT2 --orientations 36
```

Written by `tools/pulses_page.py` from the recordings as NGA-West2 has them.

## The two methods

Both select the wavelet with the largest coefficient of the velocity. The pulse is the sum of ten wavelets of its scale,
each within 0.4 scales of the first. T_p is the period at which the Fourier amplitude of the wavelet is largest,
1.4 scale dt, between 0.25 and 15 s.

| | Baker (2007), `baker2007` | Shahi and Baker (2014), `shahi_baker2014` |
| --- | --- | --- |
| judges | one component | two, in the direction in which the wavelet is largest; five candidates |
| indicator | 1 / (1 + exp(-23.3 + 14.6 r_PGV + 20.5 r_E)) | quadratic in 0.63 r_PGV + 0.777 r_E and in PGV |
| pulse | above 0.85; below 0.15 none; between them ambiguous | positive |
| r_PGV | peak velocity of the residual over that of the record | the same |
| r_E | the same ratio of integrals of squared velocity | of squared db4 approximation coefficients of one level |
| early: squared velocity that has come | below 20 % where the pulse has 10 % of its own | below 17 % at 5 % |
| size | PGV above 30 cm/s | in the indicator |

The constants of 2014 are those of the authors' code (MIT), whose transform is reproduced to the sample. Those of 2007
were not verified in the paper, which may also place the further nine wavelets less strictly. Components of different
length are cut to the shorter one; the authors' code omits pairs that differ by more than 20 samples (here Erzincan and
El Centro).

Sign, exchange and rotation of the components change neither class nor period. Scaling does not change the extracted
pulse. A pulse that arrives after the shaking is rejected.

## Pulses of known period

Pulses of Mavroeidis and Papageorgiou (2003), a cosine under a cosine bell of two periods, with a peak of 60 cm/s, 30
degrees from the first component, in noise from 0.5 to 15 Hz with 30 % of the peak in both directions; {seeds} seeds for
each period. T_p is the period of the wavelet, not of the shape: without noise it is 1.115 times the period of this
shape at every period, 1.14 times that of a bell of three periods, 0.99 times that of a sine under a bell of one and a
half, and that of a db4 wavelet itself within one sample of its scale.

{synthetic}

## The seven records beside the paper's Table 1

As recorded, neither scaled nor matched. "Paper" is the pulse period of Table 1; "independent" is another implementation
of both methods on the same files: period of the pair (2014), orientations of 36 with a pulse (2007). Directions are
degrees from north.

{seven}

{differences}

## Sensitivity of the classification

**Orientation.** By Baker (2007) one component may have a pulse and the perpendicular one none. T_p is given over the
orientations with a pulse.

{orientations}

![Indicator, peak velocity and period by orientation, Gilroy 3](figures/pulse_orientations.png)

**Scaling.** The indicator of 2014 contains the peak velocity, and the method of 2007 requires a minimum: scaling a
record may change its class although its shape is the same. Classify records as recorded, before they are scaled. The
table gives the pulse period and the indicator of 2014 of the pairs multiplied by a factor.

{sizes}

**Closeness to the limit.** {closest}

## The FEMA P-695 far-field pairs

{far_field_head}

{far_field}
"""


def wrapped(text: str) -> str:
    """Return the page with its paragraphs and lists filled to 120 characters."""
    blocks = []
    for block in text.strip().split("\n\n"):
        if block.startswith(("|", "```", "#", "!")):
            blocks.append(block)
        elif block.startswith("* "):
            items = re.split(r"\n(?=\* )", block)
            blocks.append("\n".join(fill(item, subsequent_indent="  ") for item in items))
        else:
            blocks.append(fill(block))
    return "\n\n".join(blocks) + "\n"


def fill(text: str, **options: str) -> str:
    """Return a paragraph in lines of 120 characters."""
    return textwrap.fill(" ".join(text.split()), 120, break_long_words=False, break_on_hyphens=False, **options)


def pairs_of(shared: Path) -> dict[str, Pair]:
    """Return every pair of the recordings by record sequence number."""
    return {pair.name.partition("_")[0]: pair for pair in find_pairs(shared / "records")}


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
    lines = [
        "| period (s) | pulse-like, of seeds | T_p over period: smallest, median, largest | direction off by at most |",
        "| --- | --- | --- | --- |",
    ]
    for period in SYNTHETIC_PERIODS:
        results = [shahi_baker2014(synthetic_pair(period, seed, 0.18)) for seed in range(SEEDS)]
        ratio = np.array([one.chosen.period / period for one in results])
        off = max(abs(one.angle - 30.0) for one in results)
        lines.append(
            f"| {period:g} | {sum(one.is_pulse for one in results)} of {SEEDS} | {ratio.min():.2f}, "
            f"{np.median(ratio):.2f}, {ratio.max():.2f} | {off:.1f}° |"
        )
    for pgv in (0.3, 0.6, 1.2):
        results = [shahi_baker2014(synthetic_pair(None, seed, pgv)) for seed in range(2 * SEEDS)]
        found = sum(one.is_pulse for one in results)
        largest = max(one.indicator for result in results for one in result.candidates if one.early)
        lines.append(
            f"| noise alone, {100.0 * pgv:g} cm/s | {found} of {2 * SEEDS} | largest indicator {largest:.1f} | |"
        )
    return rows(lines)


def strikes(shared: Path) -> dict[int, float]:
    """Return the strike (degrees) of the events of the table's records, where the flatfile at hand has them."""
    with (shared / "records" / "reference" / "nga_w2_selected.csv").open(encoding="utf-8") as file:
        by_number = {row["Record Sequence Number"]: float(row["Strike (deg)"]) for row in csv.DictReader(file)}
    return {number: by_number[rsn] for number, rsn in STRIKES.items()}


def period(value: float | None) -> str:
    """Return a pulse period as the tables write it."""
    return "none" if value is None else f"{value:.2f} s"


def rows(lines: Iterable[str]) -> str:
    """Return the lines of a table."""
    return "\n".join(lines)


def class_2014(result: PulseResult) -> str:
    """Return class, period and indicator."""
    found = period(result.period)
    late = "" if result.early or result.indicator <= 0.0 else ", late"
    return f"{found} (indicator {result.indicator:.2f}{late})"


def class_2007(result: PulseResult) -> str:
    """Return class and indicator of one component."""
    one = result.chosen
    found = f"{one.period:.2f} s" if one.is_pulse else one.kind
    return f"{found} ({one.indicator:.2f})"


def page(shared: Path) -> str:
    """Return the page."""
    pairs = pairs_of(shared)
    table = catalogue()
    names = {row["number"]: (f"RSN{row['rsn']}", f"{row['event']}, {row['station']}") for row in table.to_dicts()}
    results: dict[int, PulseResult] = {}
    scans: dict[int, OrientationScan] = {}
    for number in range(1, 7):
        pair = pairs[names[number][0]]
        results[number], scans[number] = shahi_baker2014(pair), baker2007_orientations(pair, orientations=ORIENTATIONS)
    nishi = pairs["RSN1111"]
    results[7], scans[7] = shahi_baker2014(nishi), baker2007_orientations(nishi, orientations=ORIENTATIONS)
    kobe = sm.read_record(shared / "records" / "07_Kobe_1995_substitutes" / "RSN1106_KOBE_KJM000.AT2")
    text = TEXT.format(
        seeds=SEEDS,
        synthetic=synthetic_table(),
        seven=seven_table(table.to_dicts(), pairs, results, scans, baker2007(kobe)),
        differences=differences(pairs, results, scans, strikes(shared), baker2007(kobe)),
        orientations=orientation_table(names, scans),
        sizes=size_table(names, pairs, results),
        closest=closest(names, results),
        **far_field(pairs, {RSN_OF[number]: (results[number], scans[number]) for number in results}),
    )
    return wrapped(text)


def seven_table(
    paper: list[dict[str, object]],
    pairs: dict[str, Pair],
    results: dict[int, PulseResult],
    scans: dict[int, OrientationScan],
    kobe: PulseResult,
) -> str:
    """Return the rows of the paper's records beside its Table 1."""
    lines = [
        "| no. | record | paper | pair (2014) | direction | components (2007) | orientations (2007) | independent |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for row in paper:
        number = int(str(row["number"]))
        said = "none" if row["pulse_period"] is None else f"{row['pulse_period']} s"
        start = f"| {number} | {row['event']}, {row['station']} | {said} |"
        if number == 7:
            lines.append(f"{start} not at hand | | | | |")
            lines.append(
                f"| 7, substitute | KJMA (one horizontal at hand) | | | | {kobe.names[0].partition('KJM')[2]}: "
                f"{class_2007(kobe)} | | |"
            )
            start, pair, independent = "| 7, substitute | Nishi-Akashi | |", pairs["RSN1111"], INDEPENDENT_NISHI_AKASHI
        else:
            pair, independent = pairs[f"RSN{row['rsn']}"], INDEPENDENT[number]
        result, scan = results[number], scans[number]
        azimuth = result.chosen.azimuth
        components = "; ".join(f"{one.component}: {class_2007(baker2007(one))}" for one in (pair.first, pair.second))
        lines.append(
            f"{start} {class_2014(result)} | {azimuth:.0f}° | {components} | {scan.pulses} of {ORIENTATIONS} | "
            f"{period(independent[0])}, {independent[1]} of {ORIENTATIONS} |"
        )
    return rows(lines)


def differences(
    pairs: dict[str, Pair],
    results: dict[int, PulseResult],
    scans: dict[int, OrientationScan],
    strike: dict[int, float],
    kobe: PulseResult,
) -> str:
    """Return what differs from Table 1 and from the independent implementation, in words."""
    normal = {
        number: baker2007(pairs[f"RSN{STRIKES[number]}"].fault_normal_parallel(degrees).first)
        for number, degrees in strike.items()
    }
    equal = all(
        (None if results[n].period is None else round(results[n].period or 0.0, 2), scans[n].pulses) == found
        for n, found in {**INDEPENDENT, 7: INDEPENDENT_NISHI_AKASHI}.items()
    )
    agreement = "Every class, period and count" if equal else "NOT every class, period and count"
    gilroy = baker2007(pairs["RSN767"].second)
    return f"""{agreement} of the independent implementation is met to its last digit.

Beside Table 1:

* **El Centro and Erzincan.** The table gives El Centro 2.6 s and Erzincan none. The recordings say the reverse. El
Centro
has no pulse in any of {ORIENTATIONS} orientations (largest indicator {scans[6].strongest.indicator:.2f}). Erzincan has
one in {scans[5].pulses}, and {results[5].period:.2f} s as a pair. The table's last 2.6 s fits if it belongs one row up.
* **Brawley.** The table's 4.2 s is the period of the fault-normal component: {normal[3].chosen.period:.2f} s by Baker
(2007), turned by the strike of the flatfile, {strike[3]:g} degrees. The pair has {results[3].period:.2f} s.
* **Gilroy 3.** The table's 2.6 s is that of the pair, {results[2].period:.2f} s, and of component 090,
{gilroy.chosen.period:.2f} s. The fault-normal component (strike {strike[2]:g} degrees) is {normal[2].chosen.kind}:
indicator
{normal[2].indicator:.2f}, wavelet of {normal[2].chosen.period:.2f} s.
* **Hector Mine and Lamont 1059** have no pulse, as in the table. Hector Mine's fault-normal component has an
indicator of
{normal[1].indicator:.2f}. Lamont 1059 has the shape of a pulse (table below) at a peak velocity of
{100.0 * results[4].pgv:.0f} cm/s, too small for both methods.
* **Kobe University** was not at hand. Of the substitutes Nishi-Akashi has no pulse. KJMA, of which only component
000 was
at hand, is {kobe.chosen.kind} in it: indicator {kobe.indicator:.2f}, peak velocity {100.0 * kobe.pgv:.0f} cm/s. Its
other
component, and so the pair, could not be judged.
* The paper's records "were modified to match" its spectrum, which may move pulses; these are as recorded. All pulse
periods
of the table are above four times the periods of its buildings (at most 0.57 s), to whichever record they belong."""


def orientation_table(names: dict[int, tuple[str, str]], scans: dict[int, OrientationScan]) -> str:
    """Return classes and the spread of periods by orientation."""
    lines = [
        f"| record | pulse in, of {ORIENTATIONS} | ambiguous in | T_p, smallest, median, largest | largest indicator |",
        "| --- | --- | --- | --- | --- |",
    ]
    for number, scan in scans.items():
        name = "Nishi-Akashi (substitute)" if number == 7 else names[number][1]
        periods = [one.period for one in scan.results if one.period is not None]
        spread = f"{min(periods):.2f}, {np.median(periods):.2f}, {max(periods):.2f} s" if periods else "no orientation"
        most = max(one.indicator for one in scan.results)
        lines.append(f"| {name} | {scan.pulses} | {scan.ambiguous} | {spread} | {most:.2f} |")
    return rows(lines)


def size_table(names: dict[int, tuple[str, str]], pairs: dict[str, Pair], recorded: dict[int, PulseResult]) -> str:
    """Return the class of 2014 of scaled pairs."""
    lines = [
        f"| record | {' | '.join(f'times {scale:g}' for scale in (*SCALES[:2], 1.0, *SCALES[2:]))} |",
        f"| --- | {' | '.join('---' for _ in range(len(SCALES) + 1))} |",
    ]
    for number in range(1, 7):
        pair = pairs[names[number][0]]
        found = []
        for scale in (*SCALES[:2], 1.0, *SCALES[2:]):
            result = recorded[number] if scale == 1.0 else shahi_baker2014(pair.scaled(scale))
            found.append(f"{period(result.period)} ({result.indicator:.2f})")
        lines.append(f"| {names[number][1]} | {' | '.join(found)} |")
    return rows(lines)


def closest(names: dict[int, tuple[str, str]], results: dict[int, PulseResult]) -> str:
    """Return a sentence on the pulse-like pair nearest to the limit."""
    pulses = {number: result for number, result in results.items() if result.is_pulse}
    number = min(pulses, key=lambda one: pulses[one].indicator)
    others = ", ".join(f"{result.indicator:.1f}" for one, result in pulses.items() if one != number)
    return (
        f"{names[number][1]} is a pulse by an indicator of {pulses[number].indicator:.2f}, where the limit is zero; "
        f"the other pulses have {others}. Another filter of that recording may give it the other class."
    )


def far_field(pairs: dict[str, Pair], known: dict[str, tuple[PulseResult, OrientationScan]]) -> dict[str, str]:
    """Return the rows of the far-field pairs, and a sentence on them."""
    lines = [
        "| record | event, station | pair (2014) | PGV (cm/s) | early | orientations (2007) |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    chosen = {
        name: pair
        for name, pair in pairs.items()
        if (pair.first.source is not None and pair.first.source.parent.name == "fema_p695_far_field")
        or name in ("RSN1787", "RSN767", "RSN1111")
    }
    pulses = 0
    for name in sorted(chosen, key=lambda one: int(one[3:])):
        pair = chosen[name]
        result, scan = known.get(name) or (
            shahi_baker2014(pair),
            baker2007_orientations(pair, orientations=ORIENTATIONS),
        )
        pulses += result.is_pulse
        lines.append(
            f"| {name} | {pair.event}, {pair.station} | {class_2014(result)} | {100.0 * result.pgv:.0f} | "
            f"{'yes' if result.early else 'no'} | {scan.pulses} of {ORIENTATIONS}, {scan.ambiguous} ambiguous |"
        )
    head = (
        f"The far-field set was chosen by distance, 10 km and more from the fault. {pulses} of its {len(chosen)} pairs "
        "at hand are pulse-like by Shahi and Baker (2014). The methods look at the motion alone: basins and surface "
        "waves make such motions too."
    )
    return {"far_field_head": head, "far_field": rows(lines)}


if __name__ == "__main__":
    if "SEISMASS_SHARED" not in os.environ:
        sys.exit(__doc__)
    folder = Path(os.environ["SEISMASS_SHARED"])
    PAGE.write_text(page(folder), encoding="utf-8")
    save_figure(baker2007_orientations(pairs_of(folder)["RSN767"], orientations=ORIENTATIONS).plot(), "png", FIGURE)
