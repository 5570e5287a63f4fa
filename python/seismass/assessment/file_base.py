"""A sliding base of a building file: the table `base`."""

from __future__ import annotations

from typing import Any, Final

from seismass.base.input_table import NOT_NEGATIVE, POSITIVE, Table
from seismass.model.sliding_base import SlidingBase

BASE_KEYS: Final = ("mu", "mu_s", "mu_k", "radius_m", "mass_kg", "mass_ratio")


def base_of(table: Table) -> SlidingBase | None:
    """Return the sliding base of a building file from its table `base`, which is empty where the file has none: then
    None.
    """
    if not table.values:
        return None
    table.known(BASE_KEYS)
    table.needed("mu", "mu_s")
    table.excluded("mu", "mu_s", "mu_k")
    table.one_of("mass_kg", "mass_ratio")
    friction = {key: table.number(key, need=NOT_NEGATIVE) for key in ("mu", "mu_s", "mu_k") if key in table.values}
    others = {"radius_m": "radius", "mass_kg": "mass", "mass_ratio": "mass_ratio"}
    given: dict[str, Any] = {
        name: table.number(key, need=POSITIVE) for key, name in others.items() if key in table.values
    }
    static = friction.get("mu_s", friction.get("mu"))
    if "mu_k" in friction and static is not None and friction["mu_k"] > static:
        table.refuse("mu_k", f"at most {table.key('mu_s')}", f"{friction['mu_k']:g}")
    return SlidingBase(**friction, **given)
