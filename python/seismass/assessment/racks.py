"""Racks under goods of a building file, and stops beside them, as models take them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from seismass.model.rack import Rack, RackBlock
from seismass.model.stops import Stops

DEFAULT_LEVELS: Final = 3
"""Levels of racks where none are stated, the goods evenly on them."""
DEFAULT_FRAME: Final = 0.05
"""Mass of the frames of racks over that of the goods present, where none is stated."""
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
        share : float
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

    def under(self, floor: int, mass: float, mu: tuple[float, float], stops: GoodsStops | None) -> Rack:
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
        """
        part = mass / self.levels
        beside = None if stops is None else stops.beside(part, 1.0 / self.levels)
        goods = [
            RackBlock(level, mass=part, mu_s=mu[0], mu_k=mu[1], stops=beside) for level in range(1, self.levels + 1)
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
