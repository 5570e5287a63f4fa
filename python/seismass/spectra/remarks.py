"""What is unlikely about a target spectrum, in plain sentences, never as an error."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.base.units import STANDARD_GRAVITY
from seismass.spectra.target import TargetSpectrum

MAX_ORDINATE: Final = 4.0
"""Ordinate of a target spectrum (g); no site has an S_DS above it, and 1 g stated in m/s2 is 9.81."""


def target_remarks(target: TargetSpectrum) -> tuple[str, ...]:
    """Return what is unlikely about a target spectrum.

    Parameters
    ----------
    target : TargetSpectrum
        The spectrum.

    Returns
    -------
    tuple of str
        A sentence about the largest ordinate, and one about the order of S_DS and S_D1, where they are unlikely.

    Examples
    --------
    >>> import seismass as sm
    >>> target_remarks(sm.TargetSpectrum.asce7(sds_g=107.0, sd1_g=61.0))
    ('S_DS of the target spectrum is 107 g, above 4 g: spectral accelerations are in g, not m/s2 or per cent',)
    """
    parameters = target.parameters
    if "sds_g" in parameters:
        ordinates = {"S_DS": parameters["sds_g"]}
    elif "sa_g" in parameters:
        ordinates = {"largest Sa": max(parameters["sa_g"])}
    else:
        periods = np.geomspace(max(target.shortest, 0.01), min(target.longest, 10.0), 100)
        ordinates = {"largest Sa": float(np.max(target(periods))) / STANDARD_GRAVITY}
    found = [
        f"{name} of the target spectrum is {value:.4g} g, above {MAX_ORDINATE:g} g: "
        "spectral accelerations are in g, not m/s2 or per cent"
        for name, value in ordinates.items()
        if value > MAX_ORDINATE
    ]
    if "sd1_g" in parameters and parameters["sd1_g"] > parameters["sds_g"]:
        found.append(
            f"S_D1 of the target spectrum is {parameters['sd1_g']:.4g} g, above S_DS = {parameters['sds_g']:.4g} g: "
            "are they exchanged?"
        )
    return tuple(found)
