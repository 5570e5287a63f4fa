"""Doubts about an input: valid, but so unlikely that a wrong unit or order is the usual cause.

They stand in the headline. The limits are far outside what buildings, sites and records have; they judge no design.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import polars as pl

from seismass.assessment.building import OwnBuilding, level_factor
from seismass.assessment.models import NAMES
from seismass.assessment.structure import damping_doubts
from seismass.base.units import STANDARD_GRAVITY, UNITS, Units
from seismass.base.values import FloatArray
from seismass.design import drift_limit
from seismass.design.rules import CATEGORIES, rule_of
from seismass.effective_mass import EffectiveMass
from seismass.model.plausibility import usage_remarks
from seismass.model.scene import Scene
from seismass.motions.spectra import TargetSpectrum
from seismass.motions.spectra.target import target_remarks

MOST_GOODS: Final = 5.0
"""Weight of the goods present over that of the building."""
MAX_LIVE_LOAD: Final = 25.0
"""Design live load of a floor (kPa): heavy storage has 12, compact stacks as much; 50 psf are 2.4."""
MAX_LIVE_LOAD_OF_PIERS: Final = 60.0
"""The same of piers and wharves, whose decks carry stacked containers: 1000 psf are 48."""
PIER_CODES: Final = ("asce61-14",)
"""Codes of piers and wharves."""
MAX_DEAD_LOAD: Final = 20.0
"""Dead load of a floor (kPa), where it is stated as such: a solid slab of 0.8 m."""
FLOOR_WEIGHT_RANGE: Final = (0.5, 30.0)
"""Weight of a floor without goods over its area (kPa)."""
MAX_DRIFT_LIMIT: Final = 0.1
"""Limit of the drift ratio."""
MAX_COLLAPSE_RATIO: Final = 0.2
"""Drift ratio at which a storey counts as collapsed."""
MAX_THETA_LIMIT: Final = 1.0
"""Limit of the stability coefficient; at 1 gravity has taken the whole stiffness."""
MIN_STRENGTH: Final = 0.03
"""Stated yield shear of the first storey over the weight of the building without goods; with weights typed as masses it
is a tenth of what was meant."""
MAX_DRIFT: Final = 0.1
"""Mean peak drift ratio that a model can be believed at."""
MAX_PGV: Final = 2.5
"""PGV of a scaled motion (m/s); the far-field recordings, scaled to S_DS = 1.0 g at 0.6 s, have at most 1.9."""
MAX_FACTOR: Final = 4.0
"""Factor of a scaled motion."""
MAX_CHANGE: Final = 0.1
"""Change of the share by one motion."""
MAX_GOODS_HEIGHT: Final = 12.0
"""Height of goods (m) on a floor without a storey of known height above it."""
SAME_RATIO: Final = 0.01
"""Relative difference of mu and b/h up to which one seems to be typed for the other."""
ROOFS: Final = ("roof", "dach", "toit", "techo", "tetto")
"""Words in the name of a floor that is the uppermost."""


def doubts_of(
    building: OwnBuilding,
    sliding_scene: Scene,
    motions: list[Any],
    target: TargetSpectrum | None,
    storeys: pl.DataFrame,
) -> tuple[str, ...]:
    """Return what makes the input of an assessment doubtful, each sentence once. `real` is the building with its goods,
    `motions` are scaled.
    """
    directions = [(sliding_scene, motions)]
    if sliding_scene.other_direction is not False:
        x, y = sliding_scene._directions()
        directions = [(x, [pair.first for pair in motions]), (y, [pair.second for pair in motions])]
    doubts = [
        *building_doubts(building, sliding_scene, target),
        *usage_remarks((), [motion for _, records in directions for motion in records]),
        *_drift_doubts(storeys),
    ]
    if building.walls is None:
        doubts += [doubt for scene, records in directions for doubt in damping_doubts(scene, records)]
    return tuple(dict.fromkeys(doubts))


def building_doubts(building: OwnBuilding, sliding_scene: Scene, target: TargetSpectrum | None) -> tuple[str, ...]:
    """Return what makes a building file and its site doubtful, without any run."""
    doubts = [
        *sliding_scene.remarks,
        *_load_doubts(building),
        *_order_doubts(building),
        *_strength_doubts(building),
        *_limit_doubts(building),
        *_size_doubts(building),
        *(() if target is None else target_remarks(target)),
    ]
    return tuple(dict.fromkeys(doubts))


def motion_doubts(
    left_out: pl.DataFrame, effective: dict[str, EffectiveMass], units: Units = UNITS["si"]
) -> tuple[str, ...]:
    """Return doubts about scaled motions that are like few recordings, and about a share that one motion decides."""

    def listed(table: pl.DataFrame) -> str:
        rows = [
            f"motion {row['motion']}, {row['record']} (PGV {units.text('velocity', row['pgv'])}, PGD "
            f"{units.text('displacement', row['pgd'])}, factor {row['factor']:.2f})"
            for row in table.head(3).to_dicts()
        ]
        return "; ".join(rows) + "; ..." * (table.height > 3)

    far = left_out.filter((pl.col("pgv") > MAX_PGV) | (pl.col("factor") > MAX_FACTOR)).sort("pgv", descending=True)
    has = "has" if far.height == 1 else "have"
    limits = f"{has} a PGV above {units.text('velocity', MAX_PGV, '.3g')} or a factor above {MAX_FACTOR:g}"
    doubts = [f"{far.height} of {left_out.height} scaled motions {limits}: {listed(far)}"] * (far.height > 0)
    value = max((one.value for one in effective.values()), default=0.0)
    change = (pl.col("fraction") - value).abs()
    most = left_out.filter(change > MAX_CHANGE).sort(change).tail(1)
    doubts += [f"the share is {share:.2f} without {listed(most)}, not {value:.2f}" for share in most["fraction"]]
    return tuple(doubts)


def _load_doubts(building: OwnBuilding) -> list[str]:
    """Loads over their areas, and goods over the building."""
    heaviest = MAX_LIVE_LOAD_OF_PIERS if building.code.code_id in PIER_CODES else MAX_LIVE_LOAD
    low, high = FLOOR_WEIGHT_RANGE
    frame = building.mass - building.bolted
    live, floor = (1e-3 * STANDARD_GRAVITY * mass / building.area for mass in (building.live_load, frame))
    dead = np.where(building.dead_load_stated, floor, np.nan)
    units = building.shown
    psf = f"are loads in {units.unit('load')} (1 psf is 0.0479 kPa)?"
    most, dead_most, low_text, high_text = (
        units.text("load", 1e3 * value) for value in (heaviest, MAX_DEAD_LOAD, *FLOOR_WEIGHT_RANGE)
    )
    doubts = [
        *_outside(building, "design live load", live, 0.0, heaviest, f"above {most}{{others}}: {psf}"),
        *_outside(building, "dead load", dead, 0.0, MAX_DEAD_LOAD, f"above {dead_most}{{others}}: {psf}"),
    ]
    if not any(text.startswith("dead load") for text in doubts):
        asked = (
            f"outside {low_text} to {high_text}{{others}}: are area and mass or load in the units of their keys, and "
            "is the mass no weight?"
        )
        doubts += _outside(building, "weight over the area", floor, low, high, asked)
    heavy = float(building.goods_mass.sum() / building.mass.sum())
    if heavy > MOST_GOODS:
        doubts.append(
            f"the goods present weigh {heavy:.3g} times the building: are both loads in the units of their keys?"
        )
    return doubts


def _outside(building: OwnBuilding, what: str, values: FloatArray, low: float, high: float, sentence: str) -> list[str]:
    """A sentence about the first floor with a value (kPa) outside a range; NaN is not known."""
    places = np.flatnonzero((values < low) | (values > high))
    if not len(places):
        return []
    floor = int(places[0]) + 1
    name = building.storey_names[floor - 1]
    called = f"floor {floor}, {name}," if name else f"floor {floor}"
    others = f" (and {len(places) - 1} more)" if len(places) > 1 else ""
    value = building.shown.text("load", 1e3 * values[floor - 1], ".4g")
    return [f"{what} of {called} is {value}, {sentence.format(others=others)}"]


def _order_doubts(building: OwnBuilding) -> list[str]:
    """Storeys listed roof first: a lower floor is named roof, or is the only one without goods."""
    asked = "storeys are listed from the ground up; is the list from the roof down?"
    if building.storeys == 1:
        return []
    for floor, name in enumerate(building.storey_names[:-1], start=1):
        if any(word in name.lower().split() for word in ROOFS):
            return [f"floor {floor} of {building.storeys} is named {name}: {asked}"]
    if building.storeys > 2 and building.goods_mass[0] == 0.0 and (building.goods_mass[1:] > 0.0).all():
        return [f"floor 1 is the only one without goods, the uppermost has some: {asked}"]
    return []


def _strength_doubts(building: OwnBuilding) -> list[str]:
    """A stated strength that no building has: weights typed as masses make the rest ten times as heavy."""
    if building.yield_shear is None or building.yield_shear[0] >= MIN_STRENGTH * building.weight:
        return []
    ratio = float(building.yield_shear[0]) / building.weight
    return [
        f"the yield shear of storey 1 is {ratio:.3g} of the weight of the building, below {MIN_STRENGTH:g}: are masses "
        "in kg and not weights in N, and strengths in their units?"
    ]


def _limit_doubts(building: OwnBuilding) -> list[str]:
    """Limits in per cent."""
    limits = (
        ("drift limit", building.drift_limit, MAX_DRIFT_LIMIT, " of the height"),
        ("collapse drift ratio", building.collapse_drift_ratio, MAX_COLLAPSE_RATIO, " of the height"),
        ("limit of the stability coefficient", building.theta_limit, MAX_THETA_LIMIT, ""),
    )
    below = f"the drift cap, {building.drift_cap:g}, is not above the drift limit: the check of drifts cannot fail"
    doubts = [
        f"the {name} is {value:g}{source}: limits are ratios, not per cent"
        for name, value, largest, source in limits
        if value is not None and value > largest
    ]
    return [*doubts, *[below] * (building.drift_cap <= building.drift_limit), *_level_doubts(building)]


def _level_doubts(building: OwnBuilding) -> list[str]:
    """A stated drift limit of the design level under motions of the MCE, where the code's own limit is larger."""
    factor, level = level_factor(building.scaling_code, building.scaling_code), rule_of(building.scaling_code, "level")
    if building.drift_limit_rule is not None or factor is None or level is None:
        return []
    category = building.risk_category if building.risk_category in CATEGORIES else "II"
    row = drift_limit(building.scaling_code, category)
    if building.drift_limit > row.ratio:
        return []
    return [
        f"the drift limit, {building.drift_limit:g}, is one of the design level, and motions are at {level.number:g} "
        f"times the design spectrum, where {row.code} takes {factor.number:g} times the ratio of its table "
        f"({factor.clause}, {factor.status}): is {factor.number * building.drift_limit:g} meant?"
    ]


def _size_doubts(building: OwnBuilding) -> list[str]:
    """Sizes that no goods have, and friction that is the width over the height."""
    doubts = []
    for kind in building.loose:
        if kind.size is None or kind.live_load == 0.0:
            continue
        units, size, goods = building.shown, kind.size, f"{kind.name or 'goods'} on floor {kind.floor}"
        clear = MAX_GOODS_HEIGHT
        if building.heights is not None and kind.floor < building.storeys:
            clear = float(building.heights[kind.floor])
        if max(size.width, size.height) > max(clear, MAX_GOODS_HEIGHT) or size.height > clear:
            doubts.append(
                f"the {goods} are {units.number('height', size.width)} x {units.text('height', size.height)}, more "
                f"than the {units.text('height', clear, '.3g')} that they have: is "
                "that the size of one of them, in the unit of its key?"
            )
        if np.isclose(kind.mu_s, size.uplift_g, rtol=SAME_RATIO, atol=0.0):
            doubts.append(
                f"mu of the {goods} is b/h = {size.uplift_g:.3g}: sliding with mu = b/h does not stand for goods that "
                "tip and gives too small a share; state the friction of their contact"
            )
    return list(dict.fromkeys(doubts))


def _drift_doubts(storeys: pl.DataFrame) -> list[str]:
    """Drifts that no building stands."""
    # The capped mean is never above the cap.
    worst = storeys.filter(unit="ratio").drop_nulls("mean_by_code").sort("mean_by_code", descending=True)
    if not worst.height or worst["mean_by_code"][0] <= MAX_DRIFT:
        return []
    row = worst.row(0, named=True)
    return [
        f"the mean drift of storey {row['storey']} is {100.0 * row['mean_by_code']:.3g} % of its height "
        f"({NAMES[row['model']]}), above {100.0 * MAX_DRIFT:g} %: no building stands this; are site, strengths and "
        "heights in their units?"
    ]
