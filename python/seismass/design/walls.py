"""Walls beside a frame: flexural cantilevers over all floors, as the stiffness matrix that a building takes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.values import FieldValue, FloatArray, as_number, as_positive, brief, frozen, refusal
from seismass.base.views import Card
from seismass.design.modes import checked_heights, positive, positive_of_length, vibration_modes
from seismass.model.building import Building

_FARTHEST = 1e9
"""How far EI is sought above and below k h H^2 of the frame, as a factor."""


@dataclass(frozen=True, eq=False)
class Wall(FieldValue, Card):
    """An elastic wall that bends: a cantilever, fixed at the ground, that has every floor's displacement.

    It has no shear deformation and no mass of its own. Walls side by side that have the same displacements count as one
    whose EI is the sum of theirs.

    Parameters
    ----------
    heights : array_like, shape (storeys,)
        Storey heights (m), storey 1 first.
    flexural_rigidity : array_like
        EI (N m2): one number, or one for each storey.

    Attributes
    ----------
    heights, flexural_rigidity : ndarray, shape (storeys,)
        As given, read-only.

    Raises
    ------
    InvalidScene
        A value is not positive, or the lists differ in length.

    Examples
    --------
    A load P at the head of a cantilever of length L moves it by P L^3/(3 EI):

    >>> import numpy as np
    >>> import seismass as sm
    >>> wall = sm.design.Wall([3.0, 3.0, 4.0], 6e9)
    >>> tip = np.linalg.solve(wall.stiffness_matrix, [0.0, 0.0, 1e5])[-1]
    >>> round(float(tip), 9), round(1e5 * 10.0**3 / (3.0 * 6e9), 9)
    (0.005555556, 0.005555556)

    Beside a frame of five storeys, by its alpha H:

    >>> frame = sm.Building([2e5] * 5, 1.5e8, heights=3.5)
    >>> wall = sm.design.Wall.of_alpha_h(frame, 2.0)
    >>> building = wall.beside(frame)
    >>> building.periods[0] < frame.periods[0]
    np.True_
    """

    heights: FloatArray
    flexural_rigidity: FloatArray

    def __init__(self, heights: ArrayLike, flexural_rigidity: ArrayLike) -> None:
        h = positive(heights, "heights")
        rigidity = positive_of_length(flexural_rigidity, "flexural_rigidity", len(h))
        object.__setattr__(self, "heights", frozen(h))
        object.__setattr__(self, "flexural_rigidity", frozen(rigidity))

    @classmethod
    def of_period(cls, mass: ArrayLike, heights: ArrayLike, period: float) -> Wall:
        """Return the wall of constant EI that alone, with the masses of the floors, has a first period.

        Parameters
        ----------
        mass, heights : array_like, shape (storeys,)
            Floor masses (kg) and storey heights (m), storey 1 first; one height stands for all storeys.
        period : float
            First period (s).

        Raises
        ------
        InvalidScene
            A value is not positive, or the lists differ in length.
        """
        m = positive(mass, "mass")
        wanted = as_positive(period, "period", "wall", InvalidScene)
        unit = cls(positive_of_length(heights, "heights", len(m)), 1.0)
        unit_period = vibration_modes(m, np.zeros(len(m)), stiffness_matrix=unit.stiffness_matrix).periods[0]
        return cls(unit.heights, float(unit_period / wanted) ** 2)

    @classmethod
    def of_alpha_h(cls, building: Building, alpha_h: float) -> Wall:
        """Return the wall of constant EI that has a value of alpha H with the storeys of a building.

        Parameters
        ----------
        building : Building
            The frame: its storey stiffnesses and heights.
        alpha_h : float
            alpha H: small where the wall governs, above about 4 where the frame does.

        Raises
        ------
        InvalidScene
            It is not positive, or the building has no heights or a storey without stiffness.

        Notes
        -----
        alpha = sqrt(GA/EI) with the racking rigidity GA of the frame (Stafford Smith and Coull, Tall Building
        Structures, 1991, chapter 11), the storey shear over the slope: k h in a storey. Over the height H it is taken
        as GA = H / sum(1/k), which moves the head by as much as the storeys do under a load there; where all storeys
        are equal that is k h.
        """
        wanted = as_positive(alpha_h, "alpha_h", "wall", InvalidScene)
        heights = checked_heights(building.heights, "wall")
        total = float(heights.sum())
        return cls(heights, _racking_rigidity(building, heights) * (total / wanted) ** 2)

    @classmethod
    def of_base_shear_share(cls, building: Building, share: float) -> Wall:
        """Return the wall of constant EI that takes a share of the base shear in the first mode, beside a building.

        Parameters
        ----------
        building : Building
            The frame: its masses, storey stiffnesses and heights.
        share : float
            Force of the wall on the ground over the base shear, both in the first mode of wall and frame together.

        Raises
        ------
        InvalidScene
            It is not between 0 and 1, no EI gives it, or the building has no heights or a storey without stiffness.
        """
        wanted = as_number(share, "share", "wall", InvalidScene)
        if not 0.0 < wanted < 1.0:
            raise refusal(InvalidScene, "share", "wall", "above 0 and below 1", f"{wanted:g}")
        heights = checked_heights(building.heights, "wall")
        largest = _racking_rigidity(building, heights) * float(heights.sum()) ** 2 * _FARTHEST
        unit = cls(heights, 1.0)

        def excess(logarithm: float) -> float:
            return _first_mode_share(building, np.exp(logarithm) * unit.stiffness_matrix) - wanted

        ends = float(np.log(largest / _FARTHEST**2)), float(np.log(largest))
        low, high = excess(ends[0]), excess(ends[1])
        if low > 0.0 or high < 0.0:
            requirement = f"between {low + wanted:.3g} and {high + wanted:.3g} for any EI of this building"
            raise refusal(InvalidScene, "share", "wall", requirement, f"{wanted:g}")
        from scipy.optimize import brentq  # slow to import

        return cls(heights, float(np.exp(brentq(excess, *ends, xtol=1e-14, rtol=1e-14))))

    @property
    def stiffness_matrix(self) -> FloatArray:
        """Stiffness over the displacements of the floors (N/m), rotations free, shape (storeys, storeys)."""
        n = len(self.heights)
        whole = np.zeros((2 * n + 2, 2 * n + 2))  # displacement and rotation of the ground, then of each floor
        for storey, (h, rigidity) in enumerate(zip(self.heights, self.flexural_rigidity, strict=True)):
            beam = np.array(
                [
                    [12.0, 6.0 * h, -12.0, 6.0 * h],
                    [6.0 * h, 4.0 * h**2, -6.0 * h, 2.0 * h**2],
                    [-12.0, -6.0 * h, 12.0, -6.0 * h],
                    [6.0 * h, 2.0 * h**2, -6.0 * h, 4.0 * h**2],
                ]
            )
            place = slice(2 * storey, 2 * storey + 4)
            whole[place, place] += rigidity / h**3 * beam
        floors, turns = slice(2, None, 2), slice(3, None, 2)
        condensed = whole[floors, floors] - whole[floors, turns] @ np.linalg.solve(
            whole[turns, turns], whole[turns, floors]
        )
        return frozen(0.5 * (condensed + condensed.T))

    def alpha_h(self, building: Building) -> float:
        """Return alpha H of this wall with the storeys of a building; see `of_alpha_h`.

        Parameters
        ----------
        building : Building
            The frame.

        Raises
        ------
        InvalidScene
            A storey has no stiffness, or the building has another number of storeys.

        Notes
        -----
        EI that differs from storey to storey counts with its mean over the height.
        """
        _same_storeys(self, building)
        total = float(self.heights.sum())
        rigidity = float(self.flexural_rigidity @ self.heights) / total
        return total * float(np.sqrt(_racking_rigidity(building, self.heights) / rigidity))

    def base_shear_share(self, building: Building) -> float:
        """Return the share of the base shear that the wall takes in the first mode; see `of_base_shear_share`.

        Parameters
        ----------
        building : Building
            The frame, without this wall.

        Raises
        ------
        InvalidScene
            The building has another number of storeys.
        """
        _same_storeys(self, building)
        return _first_mode_share(building, self.stiffness_matrix)

    def beside(self, building: Building) -> Building:
        """Return the building with this wall: its stiffness is added to the matrix that the building has, if any.

        Parameters
        ----------
        building : Building
            The frame. Its damping ratio then holds in the modes of wall and frame together.

        Raises
        ------
        InvalidScene
            The building has another number of storeys.
        """
        _same_storeys(self, building)
        present = 0.0 if building.stiffness_matrix is None else building.stiffness_matrix
        return building.replace(stiffness_matrix=present + self.stiffness_matrix)

    def __repr__(self) -> str:
        rigidity = self.flexural_rigidity
        same = bool((rigidity == rigidity[0]).all())
        listed = f"{rigidity[0]:.4g}" if same else f"{brief([float(f'{value:.4g}') for value in rigidity])}"
        return f"Wall({len(self.heights)} storeys, {self.heights.sum():g} m, EI = {listed} N m2)"


def _racking_rigidity(building: Building, heights: FloatArray) -> float:
    """GA of a frame (N)."""
    return float(heights.sum() / (1.0 / positive(building.stiffness, "stiffness")).sum())


def _first_mode_share(building: Building, matrix: FloatArray) -> float:
    """Force of a matrix on the ground over the base shear in the first mode; what the building has is the frame."""
    matrix_of_storeys = 0.0 if building.stiffness_matrix is None else building.stiffness_matrix
    modes = vibration_modes(building.mass, building.stiffness, stiffness_matrix=matrix_of_storeys + matrix)
    shape = modes.shapes[:, 0]
    whole = (2.0 * np.pi / modes.periods[0]) ** 2 * float(building.mass @ shape)
    return float((matrix @ shape).sum()) / float(whole)


def _same_storeys(wall: Wall, building: Building) -> None:
    if not isinstance(building, Building):
        raise refusal(InvalidOption, "building", "wall", "a Building", brief(building))
    if building.storeys != len(wall.heights):
        requirement = f"of {len(wall.heights)} storeys, as the wall has"
        raise refusal(InvalidScene, "building", "wall", requirement, f"{building.storeys}")
