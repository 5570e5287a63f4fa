"""Directions in the plan: azimuths that component labels state, and components of two recorded ones at any angle."""

from __future__ import annotations

import re
from typing import Final

import numpy as np

from seismass._values import FloatArray

_COMPASS: Final = {
    "N": 0.0,
    "E": 90.0,
    "S": 180.0,
    "W": 270.0,
    "NORTH": 0.0,
    "EAST": 90.0,
    "SOUTH": 180.0,
    "WEST": 270.0,
}
_ALONG: Final = {"NS": 0.0, "EW": 90.0}
"""Lines whose positive end networks agree on: north and east (K-NET, PEER)."""
_DEGREES = re.compile(r"(?:^|[^\w.])(\d{1,3}(?:\.\d*)?)\s*(?:DEG(?:REES?)?\b|\N{DEGREE SIGN})", re.IGNORECASE)
_NUMBER = re.compile(r"\d{1,3}(?:\.\d*)?$")
_BEARING = re.compile(r"([NS])\s*(\d{1,2}(?:\.\d*)?)\s*([EW])$")
_CHANNEL = re.compile(r"[BCEFHSV][NLGH]([NEZ])$")
"""SEED channel: band, instrument (accelerometer or other) and orientation."""


def component_azimuth(text: str) -> float | None:
    """Return the direction (degrees clockwise from north, 0 to below 360) that a component label states, or None.

    Parameters
    ----------
    text : str
        A label such as "225", "N", "EW", "N30E", "90 DEG" or "HNE", or a title that ends in one after a comma. Labels
        that give no direction to the compass (L, T, LN, TR, H1, HN1), vertical ones and doubtful ones give None.

    Examples
    --------
    >>> [component_azimuth(text) for text in ("225", "EW", "S45W", "HECTOR, 10/16/99, HECTOR, 000", "TR", "UP")]
    [225.0, 90.0, 225.0, 0.0, None, None]
    """
    label = text.rpartition(",")[2].strip().upper()
    stated = _DEGREES.search(label)
    if stated or _NUMBER.match(label):
        degrees = float(stated[1] if stated else label)
        return degrees % 360.0 if degrees <= 360.0 else None
    bearing = _BEARING.match(label)
    if bearing:
        off, north, east = float(bearing[2]), bearing[1] == "N", bearing[3] == "E"
        if off > 90.0:
            return None
        return ((0.0 if north else 180.0) + (off if north == east else -off)) % 360.0
    channel = _CHANNEL.match(label)
    if channel:
        return _COMPASS.get(channel[1])
    word = re.sub(r"[-\s]", "", label)
    return _COMPASS.get(word, _ALONG.get(word))


def between(first: float, second: float) -> float:
    """Return the angle (degrees) from one azimuth to another, from -180 to below 180, clockwise positive."""
    return (second - first + 180.0) % 360.0 - 180.0


def at_angles(first: FloatArray, second: FloatArray, degrees: FloatArray, apart: float = 90.0) -> FloatArray:
    """Return components of a plane motion at angles from its first recorded one towards its second.

    Parameters
    ----------
    first, second : ndarray, shape (samples,)
        Two recorded components.
    degrees : ndarray, shape (angles,)
        Angles from the first towards the second.
    apart : float
        Angle between the two recorded components (degrees). At 90 the component at an angle is first * cos(angle) +
        second * sin(angle), exactly the recorded ones at 0 and 90; otherwise the motion in the plane is solved for.

    Returns
    -------
    ndarray, shape (angles, samples)
    """
    from scipy.special import cosdg, sindg  # exact at quarter turns; slow to import

    across = second if apart == 90.0 else (second - cosdg(apart) * first) / sindg(apart)
    rotated: FloatArray = np.multiply.outer(cosdg(degrees), first)
    rotated += np.multiply.outer(sindg(degrees), across)
    return rotated
