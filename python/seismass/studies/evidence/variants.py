"""One input of a committee's table changed at a time: what moves the share of an archetype."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final, get_args

import numpy as np

from seismass.motions.records import Pair, Record, Suite, builtin_pairs, builtin_suite
from seismass.motions.records.builtin import BuiltinName
from seismass.motions.records.synthetic.process import NearFaultPulse
from seismass.studies.evidence.archetypes import Archetype, Setting
from seismass.studies.evidence.definitions import Answer
from seismass.studies.evidence.runs import ALTERATIONS, COLUMNS, PLANE, Motions, first_components
from seismass.studies.fragility.limits import IntensityMeasure

CHANGES: Final[dict[str, tuple[dict[str, Any], dict[str, Any]]]] = {
    "as it is": ({}, {"seed": 2}),
    "friction of all goods 0.2 to 0.6": ({"friction": 0.2}, {"friction": 0.6}),
    "friction x 0.67 to 1.5": ({"friction_factor": 0.67}, {"friction_factor": 1.5}),
    "mean presence x 0.75 to 1.25": ({"presence_factor": 0.75}, {"presence_factor": 1.25}),
    "presence of all floors: mean; full": ({"scatter": False}, {"full": True}),
    "floors independent to alike": ({"correlation": 0.0}, {"correlation": 0.999}),
    "first yield 1.0 to 2.0 x design": ({"first_yield": 1.0}, {"first_yield": 2.0}),
    "second slope 0.02 to 0.2": ({"second_slope": 0.02}, {"second_slope": 0.2}),
    "ultimate 1.2 to 2.5 x yield": ({"overstrength": 1.2}, {"overstrength": 2.5}),
    "no P-Delta": ({"p_delta": False}, {}),
    "fraction in the design 0 to 1": ({"design_fraction": 0.0}, {"design_fraction": 1.0}),
    "drift limit of the rate 1 to 3 %": ({"limit": 0.01}, {"limit": 0.03}),
    "site S_DS 0.5 to 1.5 g": ({"sds": 0.5, "sd1": 0.3}, {"sds": 1.5, "sd1": 0.9}),
}
"""Inputs with what they are at their lower and at their upper end."""
SLOPES: Final = (1.5, 3.5)
"""Slopes of the hazard at the MCE."""
FEW: Final[dict[str, Any]] = {"samples": (1, 2), "shares": (0.0, 0.2, 0.4, 0.7, 1.5)}
MOST_PAIRS: Final = 12
"""Samples and motions of scenes that the general engines solve, some forty times dearer."""
STORAGE: Final = "heavy storage, sustained"
"""Survey of which the mean is that of all storage: as full as light storage is one of its variants."""


@dataclass(frozen=True)
class Variant:
    """An archetype with one input at one of its ends; `slope` is that of another hazard."""

    archetype: Archetype
    setting: Setting
    suite: Motions
    name: str
    end: str
    slope: float | None = None

    def row(self, answer: Answer) -> dict[str, Any]:
        """Return what the table has of it; null where a share is rare."""
        shares = {name: answer.shares[name] for name in ("a_mean", "d")}
        return {
            "archetype": self.archetype.name,
            "occupancy": self.archetype.occupancy.name,
            "class": self.archetype.kind,
            "input": self.name,
            "end": self.end,
            **{name: None if share.kind == "rare" else share.value for name, share in shares.items()},
            "collapsed": answer.shares["c"].sliding,
        }


def variants(setting: Setting, suites: Sequence[Suite], archetypes: Sequence[Archetype]) -> list[Variant]:
    """Return every archetype with every input at both ends, the archetype as it is first."""
    others = {each.name: each for each in (*suites[1:], *map(builtin_suite, get_args(BuiltinName)))}
    others.pop(suites[0].name, None)
    return [row for each in archetypes for row in _variants_of(each, setting, suites[0], others)]


def _variants_of(archetype: Archetype, setting: Setting, first: Suite, others: dict[str, Suite]) -> Iterator[Variant]:
    """Yield an archetype with every input at both ends."""
    as_it_is = Variant(archetype, setting, first, "", "low")

    def ends(name: str, *changes: dict[str, Any], base: Variant = as_it_is) -> Iterator[Variant]:
        for end, changed in zip(("low", "high"), changes, strict=True):
            yield replace(base, name=name, end=end, **changed)

    for name, both in CHANGES.items():
        yield from ends(name, *({"setting": replace(setting, **changes)} for changes in both))
    yield from ends(f"hazard slope {SLOPES[0]:g} to {SLOPES[1]:g}", *({"slope": slope} for slope in SLOPES))
    period = setting.designed(archetype).design.period
    yield from ends("motions: spectra flat, peaked at T", *({"suite": half} for half in _by_shape(first, period)))
    yield from ends("motions: with pulses of 2 T", {}, {"suite": _with_pulses(first, 2.0 * period)})
    for name, suite in others.items():
        yield from ends(f"motions: {name}", {}, {"suite": suite})
    occupancy = archetype.occupancy
    contacts = sorted(occupancy.contacts)
    alone = (replace(archetype, occupancy=replace(occupancy, contacts=(contacts[place],))) for place in (0, -1))
    yield from ends("contacts: the smoothest, the roughest alone", *({"archetype": each} for each in alone))
    if occupancy.survey.occupancy_id == STORAGE:
        fuller = replace(setting, presence_factor=occupancy.live_load / 6.0)  # kPa, light storage
        yield from ends("as full as light storage", {}, {"setting": fuller})
    pairs = _pairs(first)
    few = replace(as_it_is, setting=replace(setting, **FEW), suite=first_components(pairs))
    for name in ALTERATIONS if pairs else ():
        if archetype.storeys > 1 or name != COLUMNS:
            altered: dict[str, Any] = {"setting": replace(few.setting, altered=name)}
            altered |= {"suite": pairs} if name == PLANE else {}
            yield from ends(f"none; {name}", {}, altered, base=few)


def _by_shape(suite: Suite, period: float) -> list[Suite]:
    """The halves of a suite whose Sa at a period (s) is smallest and largest over the mean from 0.2 to 3 times it."""
    peak, mean = (IntensityMeasure(name, period).of(suite) for name in ("sa_t1", "sa_avg"))
    order, half = np.argsort(peak / mean), len(suite) // 2
    return [replace(suite, records=tuple(suite[int(i)] for i in part)) for part in (order[:half], order[-half:])]


def _with_pulses(suite: Suite, period: float) -> Suite:
    """The suite with a pulse of a period (s) in each motion, as fast as it, in its middle by Arias intensity."""
    records = []
    for record in suite:
        energy = np.cumsum(record.acceleration**2)
        middle = float(record.time[np.searchsorted(energy, 0.5 * energy[-1])])
        pulse = NearFaultPulse(period, record.pgv, max(middle, period))
        records.append(record.replace(acceleration=record.acceleration + pulse.acceleration(record.time)))
    return replace(suite, records=tuple(records))


def _pairs(suite: Suite) -> list[Pair]:
    """At most `MOST_PAIRS` pairs of components of one recording, evenly taken; of the built-in forty their own."""
    by_station: dict[tuple[str, str], list[Record]] = {}
    for record in suite:
        if record.station and not record.synthetic:
            by_station.setdefault((record.event, record.station), []).append(record)
    pairs = [Pair.from_records(*both, lengths="padded") for both in by_station.values() if len(both) == 2]
    names = {record.name for record in suite if record.synthetic}
    pairs += [pair for pair in builtin_pairs() if pair.first.name in names]
    return pairs[:: -(-len(pairs) // MOST_PAIRS) or 1]
