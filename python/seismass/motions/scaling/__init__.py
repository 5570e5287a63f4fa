"""Factors of motions by a target alone: mean squares, one period, selection by shape."""

from typing import Final

FORMS: Final = {
    "asce7": "asce7:SDS:SD1[:TL]",
    "asce7-22": "asce7-22:CSV",
    "ec8": "ec8:TYPE:GROUND:AGR[:IMPORTANCE[:DAMPING]]",
    "nzs1170": "nzs1170:CLASS:Z[:R[:KM]]",
    "mean": "mean:RECORDS",
}
"""What may stand in place of a CSV, by name."""

TARGET_HELP: Final = (
    "target spectrum: a table of period (s) and Sa, FILE, FILE:UNIT or FILE:COLUMN where it does not say, or one of "
    + ", ".join(FORMS.values())
    + "; accelerations in g"
)
