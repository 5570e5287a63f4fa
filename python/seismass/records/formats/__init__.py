"""Readers of record formats, one file each; a format is known by the content of a file, never by its suffix alone."""

from __future__ import annotations

from typing import Final

from seismass.records.formats.at2 import AT2
from seismass.records.formats.bhrc import BHRC
from seismass.records.formats.columns import COLUMNS
from seismass.records.formats.common import Arguments, Channel, Format, NotRead
from seismass.records.formats.cosmos import COSMOS
from seismass.records.formats.csmip import CSMIP
from seismass.records.formats.esm import ESM
from seismass.records.formats.foreign import known_binary, known_text
from seismass.records.formats.geonet import GEONET
from seismass.records.formats.headed_kinds import HEADED
from seismass.records.formats.knet import KNET
from seismass.records.formats.smc import SMC
from seismass.records.formats.unam import UNAM

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
