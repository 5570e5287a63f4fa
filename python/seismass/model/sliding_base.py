"""A sliding base as users meet it: a slab between the ground and all that stands in a scene."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from seismass.base.errors import InvalidScene
from seismass.base.values import Value, as_number, brief, refusal
from seismass.base.views import Card
from seismass.model.building import Building

DEFAULT_SLAB_MASS_RATIO: Final = 1.0
"""Mass of the slab over that of floor 1, where neither `mass` nor `mass_ratio` is given: a mat like a floor."""


class SlidingBase(Value, Card):
    """A slab that carries the whole scene and slides on the ground: a mat, a flat slider, a friction pendulum.

    Parameters
    ----------
    mu : float, optional
        Friction coefficient between slab and ground, static and kinetic. Either it or `mu_s` is needed.
    mu_s, mu_k : float, optional
        Static and kinetic friction coefficient; `mu_k` defaults to `mu_s`.
    radius : float, optional
        Effective radius R of a friction pendulum (m): W/R is the restoring stiffness, 2 pi sqrt(R/g) the period. None:
        a flat slider.
    mass : float, optional
        Mass of the slab (kg).
    mass_ratio : float, optional
        The same over the mass of floor 1. Default 1, where there is a building.

    Raises
    ------
    InvalidScene
        What is given contradicts itself or is not a number. Ranges are judged with the scene.

    Notes
    -----
    The contact force N is the weight of slab, building, racks and goods, times 1 + a_v/g with a vertical motion; the
    restoring force is N u/R for a slip u. While the slab sticks it is the ground, exactly: no spring stands for stick.
    Floor
    0 of the scene is the slab: goods and racks on it slide and stand there. Damping is that of the structure fixed at
    its base.

    Examples
    --------
    >>> import seismass as sm
    >>> base = sm.SlidingBase(mu=0.06, radius=2.0)
    >>> sm.Scene(sm.Building.uniform(2, 0.4), base=base)
    Scene(2 storeys, T1 = 0.4 s, no block, sliding base)
    """

    __slots__ = ("mass", "mass_ratio", "mu_k", "mu_s", "radius")
    mass: float | None
    mass_ratio: float | None
    mu_s: float
    mu_k: float
    radius: float | None

    def __init__(
        self,
        mu: float | None = None,
        *,
        mu_s: float | None = None,
        mu_k: float | None = None,
        radius: float | None = None,
        mass: float | None = None,
        mass_ratio: float | None = None,
    ) -> None:
        def number(name: str, value: float) -> float:
            return as_number(value, name, "base", InvalidScene)

        if mass is not None and mass_ratio is not None:
            raise refusal(InvalidScene, "mass", "base", "given either as mass or as mass_ratio", "both")
        if mu is not None and (mu_s is not None or mu_k is not None):
            raise refusal(InvalidScene, "mu", "base", "left out where mu_s or mu_k is given", brief(mu))
        static = mu if mu_s is None else mu_s
        if static is None:
            raise refusal(InvalidScene, "mu", "base", "given, or mu_s", "neither")
        self._set(
            mass=None if mass is None else number("mass", mass),
            mass_ratio=None if mass_ratio is None else number("mass_ratio", mass_ratio),
            mu_s=number("mu" if mu_s is None else "mu_s", static),
            mu_k=number("mu_k", static if mu_k is None else mu_k),
            radius=None if radius is None else number("radius", radius),
        )

    def slab_mass(self, building: Building | None) -> float:
        """Return the mass of the slab below a building (kg).

        Raises
        ------
        InvalidScene
            It is a ratio without a building, or in kg where the mass of the building is not stated.
        """
        if self.mass is not None:
            if building is not None and not building.mass_is_stated:
                requirement = "given as mass_ratio where the mass of the building is not stated"
                raise refusal(InvalidScene, "mass", "base", requirement, f"{self.mass:g} kg")
            return self.mass
        if building is None:
            got = "neither" if self.mass_ratio is None else f"mass_ratio {self.mass_ratio:g}"
            raise refusal(InvalidScene, "mass", "base", "given in kg where there is no building", got)
        ratio = DEFAULT_SLAB_MASS_RATIO if self.mass_ratio is None else self.mass_ratio
        return ratio * float(building.mass[0])

    def of_kernel(self, building: Building | None) -> tuple[float, float, float, float]:
        """Return what the kernel takes: mass of the slab (kg), mu_s, mu_k, radius (m, infinite: flat)."""
        radius = np.inf if self.radius is None else self.radius
        return self.slab_mass(building), self.mu_s, self.mu_k, radius

    def _arguments(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in self.__slots__}

    def __repr__(self) -> str:
        equal = self.mu_s == self.mu_k
        given = [f"mu={self.mu_s:g}"] if equal else [f"mu_s={self.mu_s:g}", f"mu_k={self.mu_k:g}"]
        others = (("radius", self.radius), ("mass", self.mass), ("mass_ratio", self.mass_ratio))
        given += [f"{name}={value:g}" for name, value in others if value is not None]
        return f"SlidingBase({', '.join(given)})"
