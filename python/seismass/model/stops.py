"""Stops as users meet them: what limits the slip of a block."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from seismass.base.errors import InvalidScene
from seismass.base.values import Value, as_number, brief, refusal


class Stops(Value):
    """Stops on either side of a block, fixed to what carries it: rails, walls of a bay, edges of a pallet place.

    Parameters
    ----------
    clearance : float or pair of float
        Slip (m) at which a stop touches, from the block's first place: one number for both sides, or towards minus and
        towards plus; infinite: no stop on that side.
    stiffness : float
        Stiffness k of the contact (N/m).
    damping : float, default 0.0
        Viscous damper c of the contact (N s/m).

    Raises
    ------
    InvalidScene
        A value is not a number. Ranges are judged with the scene.

    Notes
    -----
    The contact force is k e + c e' for a penetration e > 0 while that is not negative: a contact does not pull. Touch
    and leave are events (`touch_stop`, `leave_stop`).

    Examples
    --------
    >>> import seismass as sm
    >>> sm.Block(2, mass_ratio=0.5, mu=0.1, stops=sm.Stops(0.05, stiffness=2e6))
    Block(floor=2, mass_ratio=0.5, mu=0.1, stops=Stops(clearance=0.05, stiffness=2e+06))
    """

    __slots__ = ("clearance", "damping", "stiffness")
    clearance: tuple[float, float]
    stiffness: float
    damping: float

    def __init__(self, clearance: float | Sequence[float], stiffness: float, damping: float = 0.0) -> None:
        sides: Any = clearance
        if not isinstance(sides, Sequence | np.ndarray) or isinstance(sides, str):
            sides = (clearance, clearance)
        if len(sides) != 2:
            requirement = "one number, or two: towards minus and towards plus"
            raise refusal(InvalidScene, "clearance", "stops", requirement, brief(clearance))
        minus, plus = (as_number(side, "clearance", "stops", InvalidScene) for side in sides)
        self._set(
            clearance=(minus, plus),
            stiffness=as_number(stiffness, "stiffness", "stops", InvalidScene),
            damping=as_number(damping, "damping", "stops", InvalidScene),
        )

    @property
    def numbers(self) -> tuple[float, float, float, float]:
        """What the kernel takes: clearances towards minus and plus (m), stiffness (N/m), damper (N s/m)."""
        return (*self.clearance, self.stiffness, self.damping)

    def _arguments(self) -> dict[str, Any]:
        return {"clearance": self.clearance, "stiffness": self.stiffness, "damping": self.damping}

    def __repr__(self) -> str:
        minus, plus = self.clearance
        clearance = f"{plus:g}" if minus == plus else f"({minus:g}, {plus:g})"
        damping = f", damping={self.damping:g}" if self.damping else ""
        return f"Stops(clearance={clearance}, stiffness={self.stiffness:g}{damping})"
