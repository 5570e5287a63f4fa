"""What stands on each floor, how much of it is known to be there, and what a code counts of it as mass."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import Final, NamedTuple, cast

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.design import effective_seismic_weight
from seismass.design.weight import INTENSITY
from seismass.model.block import Stops
from seismass.model.codes import CODE_IDS, STORED, CodeFraction, Use, code_fraction
from seismass.model.occupancy import surveyed_load
from seismass.model.rack import Rack, RackBlock
from seismass.model.tipping import BlockSize, Tipping, staying_part, tipping_of

CONTACT_PERIOD: Final = 0.1
"""Period of goods on their stop (s), where no stiffness is stated: stiff beside the building."""


@dataclass(frozen=True)
class GoodsStops:
    """Stops on either side of the goods of one kind.

    Attributes
    ----------
    clearance : float
        Slip at which one is touched, on either side (m).
    stiffness : float or None
        Stiffness of the contact of all goods of the kind together (N/m); None: that of `CONTACT_PERIOD`.
    """

    clearance: float
    stiffness: float | None

    def beside(self, mass: float, share: float = 1.0) -> Stops:
        """Return the stops of a part of the goods.

        Parameters
        ----------
        mass : float
            Mass of that part (kg).
        share : float, default 1.0
            That part of all goods of the kind, which has as much of their stiffness.
        """
        if self.stiffness is None:
            return Stops(self.clearance, mass * (2.0 * np.pi / CONTACT_PERIOD) ** 2)
        return Stops(self.clearance, share * self.stiffness)


@dataclass(frozen=True)
class GoodsRack:
    """Racks under the goods of one kind on a floor, as one rack with all their goods, evenly on its levels.

    Attributes
    ----------
    period : float
        First period with frame and goods (s).
    how : str
        How that is known, in words.
    levels : int
        Number of levels.
    frame : float
        Mass of the frame over that of the goods present.
    damping : float
        Damping ratio.
    strength : float or None
        V_y over the weight of frame and goods; None: elastic.
    """

    period: float
    how: str
    levels: int
    frame: float
    damping: float
    strength: float | None

    def under(
        self, floor: int, mass: float, mu: tuple[float, float], stops: GoodsStops | None, staying: float = 0.0
    ) -> Rack:
        """Return the rack with goods.

        Parameters
        ----------
        floor : int
            Floor on which it stands.
        mass : float
            Mass of the goods present (kg).
        mu : tuple of float
            Static and kinetic friction of the goods on their level.
        stops : GoodsStops or None
            Stops beside the goods of each level.
        staying : float, default 0.0
            Part of the goods that moves with the level.
        """
        part = mass / self.levels
        sliding, levels = (1.0 - staying) * part, range(1, self.levels + 1)
        part_stops = None if stops is None else stops.beside(sliding, 1.0 / self.levels)
        goods = [RackBlock(level, mass=staying * part, fixed=True) for level in levels if staying > 0.0]
        goods += [
            RackBlock(level, mass=sliding, mu_s=mu[0], mu_k=mu[1], stops=part_stops)
            for level in levels
            if staying < 1.0
        ]
        return Rack(
            floor,
            levels=self.levels,
            level_mass=self.frame * part,
            period=self.period,
            yield_shear_over_weight=self.strength,
            damping=self.damping,
            blocks=goods,
        )


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
    use : str
        What they are for the code, as `CodeFraction` names uses; empty for bolted goods.
    size : BlockSize or None
        Size of one of them; None where it is not stated, and they then slide.
    tipping : str
        What stands for them as the file states it; empty: by size and friction.
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
    use: str = ""
    size: BlockSize | None = None
    tipping: str = ""

    def tips_first(self, mu_factor: float = 1.0) -> bool:
        """Whether they tip before they slide, with this factor of friction."""
        return self.size is not None and self.size.rocks_first(mu_factor * self.mu_s)

    def model(self, mu_factor: float = 1.0) -> Tipping:
        """Return what stands for them with this factor of friction; where they slide first they slide."""
        if not self.tips_first(mu_factor):
            return "slide"
        return cast(Tipping, self.tipping) or tipping_of(self.size, mu_factor * self.mu_s)

    def staying(self, mu_factor: float = 1.0) -> float:
        """Return the part of their mass that moves with the floor while the rest slides."""
        parts = {"slide": 0.0, "attached": 1.0}
        model = self.model(mu_factor)
        return parts[model] if self.size is None or model in parts else staying_part(self.size.uplift_g)

    def contact_at(self, mu_factor: float) -> tuple[float, float]:
        """Return static and kinetic friction of the part that slides: of goods that rock b/h for both."""
        if self.size is not None and self.model(mu_factor) == "split":
            return self.size.uplift_g, self.size.uplift_g
        return mu_factor * self.mu_s, mu_factor * self.mu_k

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
    """Return what counts of the design live load of each floor. Storage that adds at most 5 % to the weight of its
    level is exempt (ASCE 7, 12.7.2); goods or a live load of a use with a larger fraction take that fraction.
    """
    fractions = []
    for index, one in enumerate(floors):
        kinds_of_floor = [kind for kind in kinds if kind.floor == index + 1]
        if one.exempt:
            fractions.append(CountedFraction(0.0, "exempt as stated"))
        elif not np.isnan(one.fraction):
            fractions.append(CountedFraction(one.fraction, "as stated"))
        elif code.code_id not in CODE_IDS:
            fractions.append(CountedFraction(code.fraction, ""))
        else:
            fractions.append(_by_use(code, one, kinds_of_floor, float(mass[index]), float(area[index])))
    return tuple(fractions)


def _by_use(code: CodeFraction, one: FloorCode, goods: list[FloorGoods], mass: float, area: float) -> CountedFraction:
    """What counts of a floor by the uses of its goods: of several uses the mean by their live loads."""
    loads = {one.use or code.use: 0.0}
    for kind in goods:
        if not kind.attached and kind.live_load > 0.0:
            loads[kind.use or code.use] = loads.get(kind.use or code.use, 0.0) + kind.live_load
    loads = {use: load for use, load in loads.items() if load > 0.0} or loads
    parts = {}
    for stated, load in loads.items():
        fraction, use, why = _largest(code.code_id, stated, goods, area)
        stored = sum(other for name, other in loads.items() if name in STORED) if use in STORED else 0.0
        live = [STANDARD_GRAVITY * max(stored, load)]
        weight = effective_seismic_weight([STANDARD_GRAVITY * mass], live, code_id=code.code_id, use=use, roof=False)
        exception = "" if one.exempt is False or fraction == 0.0 else str(weight.table["exception"][0])
        parts[stated] = CountedFraction(0.0, BY_RULE + exception) if exception else CountedFraction(fraction, why)
    if len(parts) == 1:
        return next(iter(parts.values()))
    total = sum(loads.values())
    words = [
        f"{use} {part.fraction:g}{f' ({part.exception})' * bool(part.exception)} of {loads[use] / total:.2g}"
        for use, part in parts.items()
    ]
    return CountedFraction(sum(part.fraction * loads[use] for use, part in parts.items()) / total, ", ".join(words))


def _largest(code_id: str, stated: str, kinds_of_floor: list[FloorGoods], area: float) -> tuple[float, Use, str]:
    """Largest fraction of a stated use and of those that its goods and the load have; its use, and why that."""
    why = {stated: ""}
    for kind in kinds_of_floor:
        if kind.occupancy and not kind.attached and kind.live_load > 0.0 and kind.use in ("", stated):
            why.setdefault(surveyed_load(kind.occupancy).use, kind.occupancy)
    limit = INTENSITY.get(code_id, (np.inf,))[0]
    load = STANDARD_GRAVITY * sum(kind.live_load for kind in kinds_of_floor)
    if load > limit * area * (1.0 + 1e-12):  # as in the seismic weight; false where the area is not known
        why.setdefault("storage", f"a live load above {limit / 1e3:g} kPa")
    fractions = []
    for use in cast(dict[Use, str], why):
        with suppress(InvalidOption):  # a code for storage alone says nothing of other goods
            fractions.append((code_fraction(code_id, use).fraction, use))
    fraction, use = max(fractions, key=lambda each: each[0])
    return fraction, use, why[use] and f"{LARGER}{use}, by {why[use]}"


def by_floor(kinds: tuple[FloorGoods, ...], values: list[float], storeys: int) -> FloatArray:
    """Return the sum of one value per kind of goods on each floor, shape (storeys,)."""
    total = np.zeros(storeys)
    for kind, value in zip(kinds, values, strict=True):
        total[kind.floor - 1] += value
    return total
