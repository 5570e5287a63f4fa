"""What stands on each floor, how much of it is known to be there, and what a code counts of it as mass."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import Final, NamedTuple, cast

import numpy as np

from seismass.assessment.racks import GoodsRack, GoodsStops
from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.design import effective_seismic_weight
from seismass.design.weight import INTENSITY
from seismass.model.codes import CODE_IDS, CodeFraction, Use, code_fraction
from seismass.model.occupancy import surveyed_load

BY_RULE: Final = "exempt: "
"""How the exception of a rule of a code begins."""
LARGER: Final = "counted as "
"""How the exception of a floor begins whose goods or load have a larger fraction than the use that is stated."""

NOTHING_STATED: Final = "since nothing is stated"
"""How the text on the presence of goods ends where the file does not state it."""


@dataclass(frozen=True)
class FloorGoods:
    """Goods of one kind on a floor.

    Attributes
    ----------
    floor : int
        The floor, from 1.
    name : str
        What they are; empty where the floor has one kind.
    live_load : float
        Design live load that they are part of, as a mass (kg).
    occupied : float
        Share of it that is present.
    presence : str
        How that is known, in words that follow the share.
    attached : bool
        They are bolted to the floor: part of its mass in every model.
    contact : str
        Contact of the table of frictions; empty where friction is stated as numbers, and for bolted goods.
    mu_s, mu_k : float
        Static and kinetic friction; 0 where nothing is present, and for bolted goods.
    rack : GoodsRack or None
        Racks that they stand on; None: on the floor.
    stops : GoodsStops or None
        Stops beside them.
    occupancy : str
        Surveyed occupancy that the file states; empty: none.
    """

    floor: int
    name: str
    live_load: float
    occupied: float
    presence: str
    attached: bool
    contact: str
    mu_s: float
    mu_k: float
    rack: GoodsRack | None = None
    stops: GoodsStops | None = None
    occupancy: str = ""

    @property
    def mass(self) -> float:
        """Mass that is present (kg)."""
        return self.occupied * self.live_load


class FloorCode(NamedTuple):
    """What a building file says of a floor for the code.

    Attributes
    ----------
    fraction : float
        Fraction of the design live load; NaN: that of the code.
    use : str
        Use of the floor; empty: that of the file.
    exempt : bool or None
        Whether nothing counts; None: by the rule of the code.
    """

    fraction: float
    use: str
    exempt: bool | None


class CountedFraction(NamedTuple):
    """What counts of the design live load of a floor, and why it is not the code's fraction of its use."""

    fraction: float
    exception: str


def counted_fractions(
    code: CodeFraction,
    floors: tuple[FloorCode, ...],
    mass: FloatArray,
    kinds: tuple[FloorGoods, ...],
    area: FloatArray,
) -> tuple[CountedFraction, ...]:
    """Return what counts of the design live load of each floor. ASCE 7, 12.7.2: storage that adds at most 5 % to the
    weight of its level is exempt, as in `seismass.design.effective_seismic_weight`. A floor whose goods or whose live
    load per area are of a use with a larger fraction has that fraction.
    """
    found = []
    for index, one in enumerate(floors):
        goods = [kind for kind in kinds if kind.floor == index + 1]
        if one.exempt:
            found.append(CountedFraction(0.0, "exempt as stated"))
        elif not np.isnan(one.fraction):
            found.append(CountedFraction(one.fraction, "as stated"))
        elif code.code_id not in CODE_IDS:
            found.append(CountedFraction(code.fraction, ""))
        else:
            fraction, use, why = _largest(code.code_id, one.use or code.use, goods, float(area[index]))
            dead = [STANDARD_GRAVITY * float(mass[index])]
            live = [STANDARD_GRAVITY * sum(kind.live_load for kind in goods if not kind.attached)]
            weight = effective_seismic_weight(dead, live, code_id=code.code_id, use=use, roof=False)
            exception = "" if one.exempt is False or fraction == 0.0 else str(weight.table["exception"][0])
            found.append(CountedFraction(0.0, BY_RULE + exception) if exception else CountedFraction(fraction, why))
    return tuple(found)


def _largest(code_id: str, stated: str, goods: list[FloorGoods], area: float) -> tuple[float, Use, str]:
    """Largest fraction of the use that is stated and of those that goods and load have; its use, and why that."""
    why = {stated: ""}
    for kind in goods:
        if kind.occupancy and not kind.attached and kind.live_load > 0.0:
            why.setdefault(surveyed_load(kind.occupancy).use, kind.occupancy)
    limit = INTENSITY.get(code_id, (np.inf,))[0]
    load = STANDARD_GRAVITY * sum(kind.live_load for kind in goods)
    if load > limit * area * (1.0 + 1e-12):  # as in the seismic weight; false where the area is not known
        why.setdefault("storage", f"a live load above {limit / 1e3:g} kPa")
    found = []
    for use in cast(dict[Use, str], why):
        with suppress(InvalidOption):  # a code for storage alone says nothing of other goods
            found.append((code_fraction(code_id, use).fraction, use))
    fraction, use = max(found, key=lambda each: each[0])
    return fraction, use, why[use] and f"{LARGER}{use}, by {why[use]}"


def by_floor(kinds: tuple[FloorGoods, ...], values: list[float], storeys: int) -> FloatArray:
    """Return the sum of one value per kind of goods on each floor, shape (storeys,)."""
    found = np.zeros(storeys)
    for kind, value in zip(kinds, values, strict=True):
        found[kind.floor - 1] += value
    return found
