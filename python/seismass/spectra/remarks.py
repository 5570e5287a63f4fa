"""What is unlikely about a target spectrum, in plain sentences, never as an error."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.base.units import STANDARD_GRAVITY
from seismass.spectra.target import TargetSpectrum

MAX_ORDINATE: Final = 10.0
"""Ordinate of a target spectrum (g)."""


def target_remarks(target: TargetSpectrum) -> tuple[str, ...]:
    """Return what is unlikely about a target spectrum.

    Parameters
    ----------
    target : TargetSpectrum
        The spectrum.

    Returns
    -------
    tuple of str
        At most one sentence.

    Examples
    --------
    >>> import seismass as sm
    >>> target_remarks(sm.TargetSpectrum.asce7(sds_g=107.0, sd1_g=61.0))
    ('S_DS of the target spectrum is 107 g, above 10 g: spectral accelerations are in g, not per cent',)
    """
    parameters = target.parameters
    if "sds_g" in parameters:
        ordinates = {"S_DS": parameters["sds_g"]}
    elif "sa_g" in parameters:
        ordinates = {"largest Sa": max(parameters["sa_g"])}
    else:
        periods = np.geomspace(max(target.shortest, 0.01), min(target.longest, 10.0), 100)
        ordinates = {"largest Sa": float(np.max(target(periods))) / STANDARD_GRAVITY}
    return tuple(
        f"{name} of the target spectrum is {value:.4g} g, above {MAX_ORDINATE:g} g: "
        "spectral accelerations are in g, not per cent"
        for name, value in ordinates.items()
        if value > MAX_ORDINATE
    )
