"""Values of a building file: a storey's own, or else the default of all storeys; US units by the suffix of a key."""

from __future__ import annotations

from typing import Final, NamedTuple, NoReturn

from seismass.base.input_table import NOT_NEGATIVE, POSITIVE, Need, Table
from seismass.base.units import STANDARD_GRAVITY

STRONG: Final = Need("positive (inf: the storey stays elastic)", lambda number: number > 0.0)
"""What a strength must be."""
FOOT: Final = 0.3048
"""Foot (m), exact."""
KIP: Final = 4448.2216152605
"""Kip (N): 1000 lb of 0.45359237 kg, exact."""


class UsKey(NamedTuple):
    """A key in US units: the key that stands for it, its unit in that of the other, and what its number must be."""

    key: str
    factor: float
    need: Need


US_STOREY_KEYS: Final = {
    "height_ft": UsKey("height_m", FOOT, POSITIVE),
    "area_ft2": UsKey("area_m2", FOOT**2, POSITIVE),
    "dead_load_psf": UsKey("dead_load_kpa", 1e-6 * KIP / FOOT**2, POSITIVE),
    "weight_kip": UsKey("mass_kg", KIP / STANDARD_GRAVITY, POSITIVE),
    "gravity_load_kip": UsKey("gravity_load_kn", 1e-3 * KIP, POSITIVE),
    "stiffness_kip_per_in": UsKey("stiffness_kn_per_m", 1e-3 * KIP / (FOOT / 12.0), POSITIVE),
    "yield_shear_kip": UsKey("yield_shear_kn", 1e-3 * KIP, STRONG),
}
"""Keys in US units of a storey, or of all in [building]."""
US_GOODS_KEYS: Final = {
    "live_load_psf": UsKey("live_load_kpa", 1e-6 * KIP / FOOT**2, NOT_NEGATIVE),
    "live_load_kip": UsKey("live_load_kg", KIP / STANDARD_GRAVITY, NOT_NEGATIVE),
}
"""Keys in US units of the goods of a floor, or of all in [goods]."""


def to_si(table: Table) -> None:
    """Put the keys in SI units in the place of those in US units; both at once are refused."""
    for name, us in (US_STOREY_KEYS | US_GOODS_KEYS).items():
        if name in table.values:
            table.excluded(name, us.key)
            table.values[us.key] = us.factor * table.number(name, need=us.need)
            del table.values[name]


def held(storey: Table, default: Table, group: tuple[str, ...]) -> tuple[Table, str] | None:
    """Return where a storey's value stands: in its own table, or else in the defaults."""
    for table in (storey, default):
        for key in group:
            if key in table.values:
                return table, key
    return None


def key_of(storey: Table, default: Table, group: tuple[str, ...]) -> str:
    """Return by which key a storey's value stands; empty where there is none."""
    place = held(storey, default, group)
    return "" if place is None else place[1]


def number_of(place: tuple[Table, str], need: Need) -> float:
    """Return the number that stands at a place."""
    table, key = place
    return table.number(key, need=need)


def stated(storey: Table, default: Table, key: str, need: Need, value: float) -> float:
    """Return a number of a storey or of the defaults, or the value that stands for a missing one."""
    place = held(storey, default, (key,))
    return value if place is None else number_of(place, need)


def positive(storey: Table, default: Table, key: str, value: float | None = None) -> float:
    """Return a positive number of a storey or of the defaults; a missing one is refused where there is no value."""
    if value is not None:
        return stated(storey, default, key, POSITIVE, value)
    place = held(storey, default, (key,))
    if place is None:
        storey.refuse(key, f"given, or {default.key(key)} for all storeys", "nothing")
    return number_of(place, POSITIVE)


def missing(storey: Table, default: Table, group: tuple[str, ...]) -> NoReturn:
    """Refuse a quantity that is stated nowhere."""
    others = "".join(f", or {key}" for key in group[1:])
    storey.refuse(group[0], f"given{others}, here or in {default.place}", "nothing")
