"""Headers of networks whose files are words and then numbers: RESORCE, CSMNC, JMA, NIED's CSV, CWA, AFAD.

Sources: the headers of the formats themselves as their networks describe them: RESORCE (Akkar et al. 2014, Bull.
Earthquake Eng. 12:311), CSMNC (China Strong Motion Network Centre, uncorrected acceleration), JMA (strong-motion CSV:
NS, EW, UD at 100 Hz in gal), NIED (CSV of the K-NET site), CWA (TSMIP text: time, U, N, E as 4F10.3), AFAD
(text of three columns N-S, E-W, U-D in gal).
"""

from __future__ import annotations

import re
from typing import Final

from seismass.records.formats.common import Format
from seismass.records.formats.headed import Header, headed_format

_NUMBER: Final = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][+-]?\d+)?"


def _find(pattern: str) -> re.Pattern[str]:
    return re.compile(pattern, re.IGNORECASE | re.MULTILINE)


RESORCE: Final = headed_format(
    "resorce",
    "RESORCE",
    Header(
        known=_find(r"\s*Event Date & Time\s*:(?s:.{0,1500}?)Time Increment"),
        step=_find(rf"^Time Increment \(s\)\s*:\s*({_NUMBER})"),
        points=_find(r"^Number of Data\s*:\s*(\d+)"),
        unit=_find(r"^Acc?el[ae]ration time series in\s+(\S.*)"),
        component=_find(r"^Orientation\s*:\s*(.*)"),
        station=_find(r"^Station Code / Name\s*:\s*(.*)"),
        event=_find(r"^Event Date & Time\s*:\s*(.*)"),
        network=_find(r"^Network\s*:\s*(.*)"),
        peaks=_find(rf"^PGA \([^)]*\)\s*:\s*(?P<value>{_NUMBER})"),
    ),
)

CSMNC: Final = headed_format(
    "csmnc",
    "CSMNC",
    Header(
        known=_find(r"(?s:.{0,1200}?)^COMP\.\s(?s:.{0,300}?)EQUALLY SPACED INTERVALS OF"),
        step=_find(rf"EQUALLY SPACED INTERVALS OF\s*:\s*({_NUMBER})\s*SEC"),
        points=_find(r"NO\. OF POINTS\s*:\s*(\d+)"),
        unit=_find(r"\bUNIT\s*:\s*(\S+)"),
        component=_find(r"^COMP\.\s*(.*)"),
        station=_find(r"^STATION\s*:\s*(\S+)"),
        event=_find(r"^\d+\s+(\d{4}-\d\d-\d\d.*)"),
        network="CSMNC",
        peaks=_find(rf"^PEAK VALUE\s*:\s*(?P<value>{_NUMBER})\s*AT\s*(?P<time>{_NUMBER})"),
        remark=_find(r"^(UNCORRECTED ACCELERATION)"),
    ),
)

JMA: Final = headed_format(
    "jma",
    "JMA CSV",
    Header(
        known=_find(r"\s*SITE CODE\s*=(?s:.{0,400}?)SAMPLING RATE\s*="),
        rate=_find(rf"SAMPLING RATE\s*=\s*({_NUMBER})\s*Hz"),
        unit=_find(r"UNIT\s*=\s*([^,(\n]+)"),
        columns=("NS", "EW", "UD"),
        station=_find(r"SITE CODE\s*=\s*([^,\n]+)"),
        event=_find(r"INITIAL TIME\s*=\s*([^,\n]+)"),
        network="JMA",
    ),
)

NIED: Final = headed_format(
    "nied_csv",
    "NIED CSV",
    Header(
        known=_find(r"\s*OriginTime,(?s:.{0,800}?)RelativeTime\s*\(s\)\s*,\s*NS\b"),
        unit=_find(r",NS\s*\(([^)]*)\)"),
        columns=("", "NS", "EW", "UD"),
        station=_find(r"^Code,\s*([^,\n]+)"),
        event=_find(r"^OriginTime,\s*([^,\n]+)"),
        network="NIED",
        remark=_find(r"^(Offset,(?!\s*[-+]?0\.?0*\s*,\s*[-+]?0\.?0*\s*,\s*[-+]?0\.?0*\s*$).*)"),
        first_cells=1,
    ),
)

CWA: Final = headed_format(
    "cwa",
    "CWA",
    Header(
        known=_find(r"#\s*Earthquake Information|#?\s*StationCode\s*:(?s:.{0,800}?)AmplitudeUnit"),
        rate=_find(rf"^#?\s*SampleRate[^:\n]*:\s*({_NUMBER})"),
        length=_find(rf"^#?\s*RecordLength[^:\n]*:\s*({_NUMBER})"),
        unit=_find(r"^#?\s*AmplitudeUnit\s*:\s*(\S+)"),
        columns=("", "U", "N", "E"),
        station=_find(r"^#?\s*StationCode\s*:\s*(.*)"),
        event=_find(r"^#?\s*Origin Time[^:\n]*:\s*(.*)"),
        network="CWA",
        peaks=_find(rf"^#?\s*AmplitudeMAX\.\s*[UNE]\s*:\s*(?P<value>{_NUMBER})\s*~\s*(?P<least>{_NUMBER})"),
    ),
)

AFAD: Final = headed_format(
    "afad",
    "AFAD text",
    Header(
        known=_find(r"\s*STRONG GROUND MOTION RECORDS OF TURKIYE"),
        step=_find(rf"^SAMPLING INTERVAL[^:\n]*:\s*({_NUMBER})"),
        points=_find(r"^NUMBER OF DATA\s*:\s*(\d+)"),
        unit="cm/s2",
        columns=("N-S", "E-W", "U-D"),
        station=_find(r"^STATION ID\s*:\s*(.*)"),
        event=_find(r"^EARTHQUAKE DATE[^:\n]*:\s*(.*)"),
        network="AFAD",
        peaks=_find(rf"\([NEU]-[SWD]\)\s*(?P<value>{_NUMBER})"),
    ),
)

HEADED: Final[tuple[Format, ...]] = (RESORCE, CSMNC, JMA, NIED, CWA, AFAD)
