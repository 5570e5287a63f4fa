"""Strengths of the buildings of a grid by a response modification factor: elastic demand of a spectrum over R."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_number, brief, refusal
from seismass.design.modes import Combination, checked_combination
from seismass.design.spectrum_analysis import response_spectrum_analysis
from seismass.model.building import Building
from seismass.model.damping import DEFAULT_DAMPING
from seismass.spectra import TargetSpectrum
from seismass.spectra.stored import target_of_parameters


@dataclass(frozen=True)
class StrengthDesign:
    """How V_y of a building follows from R: V_y = V_e / R.

    V_e is the combined elastic storey shear of a response spectrum analysis of the building to which a share of its
    design live load is attached as mass, as in the study of the paper.

    Parameters
    ----------
    target : TargetSpectrum
        Design spectrum.
    share : float, default 0.25
        Share of the design live load that the design counts as mass, from 0 to 1; what is present does not matter.
    elastic_at_one : bool, default True
        R = 1 leaves a building elastic, as the paper has it; False: it yields at V_e.
    combination : {"srss", "cqc"}, default "srss"
        Combination of the modes.

    Raises
    ------
    InvalidOption
        An argument is not what it must be.

    Examples
    --------
    >>> import seismass as sm
    >>> design = sm.runs.StrengthDesign(sm.TargetSpectrum.asce7(1.0, 0.6))
    >>> design.yield_shear(sm.Building.uniform(2, 0.3), [1.0, 0.0], 4.0).round(3).tolist()
    [5.266, 2.952]
    """

    target: TargetSpectrum
    share: float = 0.25
    elastic_at_one: bool = True
    combination: Combination = "srss"

    def __post_init__(self) -> None:
        if not isinstance(self.target, TargetSpectrum):
            raise refusal(InvalidOption, "target", "strength design", "a TargetSpectrum", brief(self.target))
        share = as_number(self.share, "share", "strength design", InvalidOption)
        if not 0.0 <= share <= 1.0:
            raise refusal(InvalidOption, "share", "strength design", "between 0 and 1", f"{share:g}")
        if not isinstance(self.elastic_at_one, bool):
            got = brief(self.elastic_at_one)
            raise refusal(InvalidOption, "elastic_at_one", "strength design", "true or false", got)
        checked_combination(self.combination, DEFAULT_DAMPING, "strength design")
        object.__setattr__(self, "share", share)

    def elastic_shear(self, building: Building, live_load: Any) -> FloatArray:
        """Return V_e of each storey (N).

        Parameters
        ----------
        building : Building
            The building without live load.
        live_load : array_like, shape (storeys,)
            Design live load of each floor over its mass.

        Raises
        ------
        InvalidOption
            A period of a mode is outside the range of the spectrum.
        """
        damping = building.damping if isinstance(building.damping, float) else DEFAULT_DAMPING
        return response_spectrum_analysis(
            building.mass * (1.0 + self.share * np.asarray(live_load, dtype=np.float64)),
            building.stiffness,
            self.target,
            combination=self.combination,
            damping=damping,
        ).storey_shear

    def yield_shear(self, building: Building, live_load: Any, reduction: float) -> FloatArray:
        """Return V_y of each storey (N) by the factor R; infinite where the building stays elastic.

        Parameters
        ----------
        building, live_load
            As for `elastic_shear`.
        reduction : float
            R, positive.
        """
        if reduction == 1.0 and self.elastic_at_one:
            return np.full(building.storeys, np.inf)
        return self.elastic_shear(building, live_load) / reduction

    def content(self) -> dict[str, Any]:
        """Return what it is made of, for JSON; `of_content` makes it again."""
        return {
            "target": self.target.parameters,
            "share": self.share,
            "elastic_at_one": self.elastic_at_one,
            "combination": self.combination,
        }

    @classmethod
    def of_content(cls, content: dict[str, Any]) -> StrengthDesign:
        """Return the design of what `content` returned.

        Raises
        ------
        InvalidOption
            The spectrum is the mean of motions, which the content does not hold.
        """
        return cls(
            target_of_parameters(content["target"]),
            content["share"],
            content["elastic_at_one"],
            content["combination"],
        )
