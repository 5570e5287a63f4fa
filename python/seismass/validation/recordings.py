"""Recordings of the paper's validations: found by station among the user's, a built-in motion in their place."""

from __future__ import annotations

from typing import Final, Literal, TypeAlias

from seismass.records import Record, Suite, builtin_record, read_suite

Station: TypeAlias = Literal["Brawley Airport", "Erzincan"]
"""Stations of records 3 and 5 of the paper's Table 1."""

STAND_INS: Final[dict[Station, str]] = {"Brawley Airport": "synthetic-3", "Erzincan": "synthetic-5"}
"""Built-in motion that is used where there is no recording of a station."""


def components(station: Station, suite: Suite | None = None) -> tuple[Record, ...]:
    """Return the horizontal components of a station, or its stand-in.

    Parameters
    ----------
    station : {"Brawley Airport", "Erzincan"}
        The station.
    suite : Suite, optional
        Recordings. Where one is of the station, other components of it in the same folder are read too.

    Returns
    -------
    tuple of Record
        In the order of their names. The stand-in alone, which is synthetic, where the suite has no such recording.

    Raises
    ------
    RecordFormatError
        As for `read_suite`.
    """
    found: dict[str, Record] = {}
    for record in suite or ():
        if record.station != station or record.synthetic:
            continue
        found[record.name] = record
        if record.source is not None:
            beside = read_suite(record.source.parent)
            found |= {other.name: other for other in beside if other.station == station}
    if not found:
        return (builtin_record(STAND_INS[station]),)
    return tuple(found[name] for name in sorted(found))


def label(record: Record) -> str:
    """Return what tables call a component: its direction, or the name of a built-in motion."""
    return record.name if record.synthetic else record.component or record.name
