"""One input of a committee's table changed at a time: what moves the share of an archetype."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

from seismass.motions.records import Suite
from seismass.studies.evidence.archetypes import Archetype, Setting
from seismass.studies.evidence.definitions import Answer

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
STORAGE: Final = "heavy storage, sustained"
"""Survey of which the mean is that of all storage: as full as light storage is one of its variants."""


@dataclass(frozen=True)
class Variant:
    """An archetype with one input at one of its ends; `slope` is that of another hazard."""

    archetype: Archetype
    setting: Setting
    suite: Suite
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
        }


def variants(setting: Setting, suites: Sequence[Suite], archetypes: Sequence[Archetype]) -> list[Variant]:
    """Return every archetype with every input at both ends, the archetype as it is first."""
    first, middle = suites[0], len(suites[0]) // 2
    halves = [replace(first, records=part) for part in (first.records[:middle], first.records[middle:])]
    rows = []
    for each in archetypes:
        for name, ends in CHANGES.items():
            for end, changes in zip(("low", "high"), ends, strict=True):
                rows.append(Variant(each, replace(setting, **changes), first, name, end))
        for end, slope in zip(("low", "high"), SLOPES, strict=True):
            rows.append(Variant(each, setting, first, f"hazard slope {SLOPES[0]:g} to {SLOPES[1]:g}", end, slope))
        for end, half in zip(("low", "high"), halves, strict=True):
            rows.append(Variant(each, setting, half, "motions: first half, second half", end))
        if len(suites) > 1:
            ends_of_suites = zip(("low", "high"), suites[:2], strict=True)
            rows += [Variant(each, setting, suite, "motions: the other suite", end) for end, suite in ends_of_suites]
        contacts = sorted(each.occupancy.contacts)
        for end, contact in (("low", contacts[0]), ("high", contacts[-1])):
            alone = replace(each, occupancy=replace(each.occupancy, contacts=(contact,)))
            rows.append(Variant(alone, setting, first, "contacts: the smoothest, the roughest alone", end))
        if each.occupancy.survey.occupancy_id == STORAGE:
            factor = each.occupancy.live_load / 6.0  # kPa, light storage
            fuller = replace(setting, presence_factor=factor)
            rows.append(Variant(each, setting, first, "as full as light storage", "low"))
            rows.append(Variant(each, fuller, first, "as full as light storage", "high"))
    return rows
