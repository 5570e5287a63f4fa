"""What stands on each floor, how much of it is known to be there, and what a code counts of it as mass."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from seismass.assessment.racks import GoodsRack, GoodsStops
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.design import effective_seismic_weight
from seismass.model.codes import CODE_IDS, CodeFraction, code_fraction

BY_RULE: Final = "exempt: "
"""How the exception of a rule of a code begins."""


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
    code: CodeFraction, floors: tuple[FloorCode, ...], mass: FloatArray, live_load: FloatArray
) -> tuple[CountedFraction, ...]:
    """Return what counts of the design live load of each floor. ASCE 7, 12.7.2: storage that adds at most 5 % to the
    weight of its level is exempt, as in `seismass.design.effective_seismic_weight`.
    """
    found = []
    for index, one in enumerate(floors):
        use = one.use or code.use
        if one.exempt:
            found.append(CountedFraction(0.0, "exempt as stated"))
        elif not np.isnan(one.fraction):
            found.append(CountedFraction(one.fraction, "as stated"))
        elif code.code_id not in CODE_IDS:
            found.append(CountedFraction(code.fraction, ""))
        else:
            fraction = code_fraction(code.code_id, use).fraction  # type: ignore[arg-type]
            dead, live = ([STANDARD_GRAVITY * float(of[index])] for of in (mass, live_load))
            weight = effective_seismic_weight(dead, live, code_id=code.code_id, use=use, roof=False)  # type: ignore[arg-type]
            exception = "" if one.exempt is False else str(weight.table["exception"][0])
            found.append(CountedFraction(0.0 if exception else fraction, exception and BY_RULE + exception))
    return tuple(found)


def by_floor(kinds: tuple[FloorGoods, ...], values: list[float], storeys: int) -> FloatArray:
    """Return the sum of one value per kind of goods on each floor, shape (storeys,)."""
    found = np.zeros(storeys)
    for kind, value in zip(kinds, values, strict=True):
        found[kind.floor - 1] += value
    return found
