"""Readers of record formats, one file each; a format is known by the content of a file, never by its suffix alone."""

from __future__ import annotations

from typing import Final

from seismass.motions.records.formats.at2 import AT2
from seismass.motions.records.formats.columns import COLUMNS, known_binary, known_text
from seismass.motions.records.formats.common import Arguments, Channel, Format, NotRead
from seismass.motions.records.formats.cosmos import COSMOS
from seismass.motions.records.formats.csmip import CSMIP
from seismass.motions.records.formats.esm_bhrc_unam import BHRC, ESM, UNAM
from seismass.motions.records.formats.headed import HEADED
from seismass.motions.records.formats.knet_geonet import GEONET, KNET
from seismass.motions.records.formats.smc import SMC

FORMATS: Final = (KNET, ESM, GEONET, UNAM, BHRC, COSMOS, CSMIP, *HEADED, SMC, AT2, COLUMNS)
"""In order of certainty: what a head has that no other format has comes first, and text of columns last."""

BY_NAME: Final = {one.name: one for one in FORMATS}

__all__ = [
    "BY_NAME",
    "COLUMNS",
    "FORMATS",
    "Arguments",
    "Channel",
    "Format",
    "NotRead",
    "known_binary",
    "known_text",
    "recognise",
]


def recognise(head: str) -> Format | tuple[str, str] | None:
    """Return the format of a text by its first lines, name and advice of a format that is not read, or None: text of
    columns, if it is a record at all.
    """
    known = known_text(head)
    if known is not None:
        return known
    return next((one for one in FORMATS[:-1] if one.recognises(head)), None)
