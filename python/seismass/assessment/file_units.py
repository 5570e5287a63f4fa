"""Units of a building file: by the suffix of a key, or by a line that says which system keys without one have."""

from __future__ import annotations

from typing import Final, NamedTuple

from seismass.assessment.file_values import STRONG
from seismass.base.input_table import NOT_NEGATIVE, POSITIVE, Need, Table
from seismass.base.units import FOOT, KIP, STANDARD_GRAVITY

SI: Final = "si"
US: Final = "us"
SYSTEMS: Final = (SI, US)
"""What `units` of a file may be."""


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
PLAIN_STOREY_KEYS: Final = {
    "height": {SI: "height_m", US: "height_ft"},
    "area": {SI: "area_m2", US: "area_ft2"},
    "dead_load": {SI: "dead_load_kpa", US: "dead_load_psf"},
    "mass": {SI: "mass_kg"},
    "weight": {US: "weight_kip"},
    "gravity_load": {SI: "gravity_load_kn", US: "gravity_load_kip"},
    "stiffness": {SI: "stiffness_kn_per_m", US: "stiffness_kip_per_in"},
    "yield_shear": {SI: "yield_shear_kn", US: "yield_shear_kip"},
}
"""Keys without a unit of a storey, by the system that the file states, as the keys that they stand for."""
PLAIN_GOODS_KEYS: Final = {"live_load": {SI: "live_load_kpa", US: "live_load_psf"}}
"""The same of the goods of a floor."""


def plain_keys(keys: dict[str, dict[str, str]], units: str) -> tuple[str, ...]:
    """Return the keys without a unit that a file may have; none where it does not state its system."""
    return tuple(key for key, of in keys.items() if units in of)


def to_si(table: Table, units: str) -> None:
    """Convert the table in place to SI units: keys without a unit are in the `units` of the file ("", "si" or "us"). A
    key stated in two units is refused.
    """
    for name, of in (PLAIN_STOREY_KEYS | PLAIN_GOODS_KEYS).items():
        if name in table.values and units in of:
            table.excluded(name, of[units])
            table.values[of[units]] = table.values.pop(name)
    for name, us in (US_STOREY_KEYS | US_GOODS_KEYS).items():
        if name in table.values:
            table.excluded(name, us.key)
            table.values[us.key] = us.factor * table.number(name, need=us.need)
            del table.values[name]
