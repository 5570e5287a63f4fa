"""What a spectrum needs of ground motions, and how it takes them: a list, in order, as the kernel holds them."""

from __future__ import annotations

from typing import Any, Protocol

from seismass import _kernel
from seismass.base.errors import InvalidMotion
from seismass.base.values import FloatArray, as_array, as_number, brief, refusal


class GroundMotion(Protocol):
    """What a spectrum needs of a motion: a `Record` and a `Motion` both have it."""

    @property
    def acceleration(self) -> FloatArray:
        """Horizontal samples (m/s2)."""
        ...

    @property
    def dt(self) -> float:
        """Time step (s)."""
        ...


def as_motions(motions: Any, owner: str) -> list[GroundMotion]:
    """Return motions as a list; one motion is a list of one."""
    try:
        given = [motions] if hasattr(motions, "acceleration") else list(motions)
    except TypeError:
        raise refusal(InvalidMotion, "motions", owner, "Records or Motions", brief(motions)) from None
    if not given:
        raise refusal(InvalidMotion, "motions", owner, "at least one Record or Motion", "none")
    for number, motion in enumerate(given, start=1):
        if not (hasattr(motion, "acceleration") and hasattr(motion, "dt")):
            raise refusal(InvalidMotion, f"motion {number}", owner, "a Record or Motion", brief(motion))
    return given


def held(motion: GroundMotion, number: int) -> _kernel.Motion:
    """Return a motion as the kernel takes it, from samples of any kind; `number` names it in errors."""
    owner = f"motion {number} of spectrum"
    samples = as_array(motion.acceleration, "acceleration", owner, InvalidMotion)
    return _kernel.Motion(samples, as_number(motion.dt, "dt", owner, InvalidMotion))


def check_not_zero(spectra: FloatArray) -> None:
    """Refuse motions without any acceleration, by their spectra: motions x periods."""
    for number, row in enumerate(spectra, start=1):
        if not (row > 0.0).all():
            raise refusal(
                InvalidMotion, "acceleration", f"motion {number}", "other than zero somewhere", "zero throughout"
            )
