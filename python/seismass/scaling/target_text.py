"""The target spectrum as an option names it: a CSV, or a code with its numbers between colons."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from seismass.base.errors import InvalidOption
from seismass.base.values import counted

if TYPE_CHECKING:
    from seismass.spectra import TargetSpectrum

FORMS: Final = {
    "asce7": "asce7:SDS:SD1[:TL]",
    "asce7-22": "asce7-22:CSV",
    "ec8": "ec8:TYPE:GROUND:AGR[:IMPORTANCE[:DAMPING]]",
    "nzs1170": "nzs1170:CLASS:Z[:R[:KM]]",
    "mean": "mean:RECORDS",
}
"""What may stand in place of a CSV, by name."""

TARGET_HELP: Final = (
    "target spectrum: a CSV of period (s) and Sa (g), or one of " + ", ".join(FORMS.values()) + "; accelerations in g"
)


ALIASES: Final = {"nzs": "nzs1170", "asce": "asce7"}
"""Other names of the forms."""


def target_of(text: str, folder: Path = Path()) -> TargetSpectrum:
    """Return the target spectrum of a file, relative to `folder`, or of one of `FORMS`, with its numbers."""
    from seismass.spectra import TargetSpectrum
    from seismass.spectra.tables import read_table

    name, colon, rest = text.partition(":")
    name = ALIASES.get(name.lower(), name.lower())
    if name not in FORMS or not colon:
        if (colon or not Path(text).suffix) and not (folder / text).exists():
            forms = ", ".join(FORMS.values())
            raise InvalidOption(f"--target of command must be a CSV that is there or one of {forms}; got {text}")
        return TargetSpectrum.from_csv(folder / text)
    if not rest:
        raise _refused(name, text)
    if name == "asce7-22":
        return TargetSpectrum.asce7_multi_period(*read_table(folder / rest, zero=True))
    if name == "mean":
        from seismass.records.named import records_named

        suite = records_named(folder / rest)
        return TargetSpectrum.mean_of(suite, label=f"mean spectrum of {suite.name}, {counted(len(suite), 'motion')}")
    words = rest.split(":")
    least = {"asce7": 2, "ec8": 3, "nzs1170": 2}[name]
    most = {"asce7": 3, "ec8": 5, "nzs1170": 4}[name]
    if not least <= len(words) <= most or not all(words):
        raise _refused(name, text)
    if name == "asce7":
        return TargetSpectrum.asce7(*(_number(word, name, text) for word in words))
    if name == "ec8":
        kind, ground, *numbers = words
        keys = ("agr_g", "importance", "damping")
        given: dict[str, Any] = dict(zip(keys, (_number(word, name, text) for word in numbers), strict=False))
        return TargetSpectrum.eurocode8(int(kind) if kind.isdecimal() else 0, ground.upper(), **given)
    site_class, *numbers = words
    keys = ("z", "r", "fault_distance_km")
    given = dict(zip(keys, (_number(word, name, text) for word in numbers), strict=False))
    return TargetSpectrum.nzs1170(site_class.upper(), **given)


def _number(word: str, name: str, text: str) -> float:
    try:
        return float(word)
    except ValueError:
        raise _refused(name, text) from None


def _refused(name: str, text: str) -> InvalidOption:
    return InvalidOption(f"--target of command must be {FORMS[name]}; got {text}")
