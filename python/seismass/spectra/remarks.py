"""What is unlikely about a target spectrum, in plain sentences, never as an error."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.base.units import STANDARD_GRAVITY
from seismass.spectra.target import TargetSpectrum

MAX_ORDINATE: Final = 4.0
"""Ordinate of a target spectrum (g); no site has an S_DS above it, and 1 g stated in m/s2 is 9.81."""


PARAMETERS: Final[dict[str, dict[str, tuple[float, float, str, str]]]] = {
    "nzs1170": {
        "z": (0.1, 0.6, "", "the hazard factor Z is a fraction, 0.13 to 0.6 in the table of the standard"),
        "r": (0.2, 1.8, "", "the return period factor R is 0.2 to 1.8 in the table of the standard"),
    },
    "eurocode8": {
        "agr_g": (0.01, 0.6, " g", "a_gR is a fraction of g, and in Europe no larger than about 0.4"),
        "importance": (0.5, 2.0, "", "the importance factor is 0.8 to 1.4 as EN 1998-1 recommends"),
    },
}
"""Ranges of the parameters of codes by their shapes: least, most, unit, and what is doubted outside.

NZS 1170.5:2004, tables 3.3 and 3.5; EN 1998-1:2004, 4.2.5(5)P and the zone maps of national annexes. As the other
numbers of these shapes they are second-hand.
"""


def target_remarks(target: TargetSpectrum) -> tuple[str, ...]:
    """Return what is unlikely about a target spectrum: an ordinate that is too large, S_DS and S_D1 exchanged, and
    parameters of a code outside their ranges.
    """
    parameters = target.parameters
    if "sds_g" in parameters:
        ordinates = {"S_DS": parameters["sds_g"]}
    elif "sa_g" in parameters:
        ordinates = {"largest Sa": max(parameters["sa_g"])}
    else:
        periods = np.geomspace(max(target.shortest, 0.01), min(target.longest, 10.0), 100)
        ordinates = {"largest Sa": float(np.max(target(periods))) / STANDARD_GRAVITY}
    ranges = PARAMETERS.get(str(parameters.get("shape")), {})
    outside = tuple(
        f"{name} of the target spectrum is {parameters[name]:g}, outside {least:g} to {most:g}{unit}: {doubt}"
        for name, (least, most, unit, doubt) in ranges.items()
        if not least <= parameters[name] <= most
    )
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
    return (*found, *outside)
