"""Where each quantity of a building comes from: which key of the file states it, or that it is the default."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

from seismass.assessment.file_goods import FRICTION, LIVE_LOAD, PRESENT
from seismass.assessment.file_units import PLAIN_GOODS_KEYS, PLAIN_STOREY_KEYS, US_GOODS_KEYS, US_STOREY_KEYS

DEFAULT: Final = "default"
"""Source of a quantity that the file does not state."""
_STRENGTH: Final = ("yield_shear_kn", "yield_shear_n", "yield_shear_over_weight")
_OF_STOREYS: Final = {
    "height": ("height_m",),
    "area": ("area_m2",),
    "dead_load": ("dead_load_kpa", "mass_kg"),
    "gravity_load": ("gravity_load_kn",),
    "stiffness": ("stiffness_kn_per_m", "stiffness_n_per_m", "relative_stiffness"),
    "strength": _STRENGTH,
    "overstrength": ("overstrength",),
    "second_slope": ("second_slope",),
    "third_slope": ("third_slope",),
}
_OF_GOODS: Final = {"live_load": LIVE_LOAD, "present": PRESENT, "friction": FRICTION}
_OF_BUILDING: Final = {
    "period": ("period_s", "system"),
    "damping": ("damping",),
    "p_delta": ("p_delta",),
    "design": ("design",),
    "reduction": ("R",),
    "design_fraction": ("design_fraction",),
    "combination": ("combination",),
    "drift_limit": ("drift_limit", "risk_category"),
    "theta_limit": ("theta_limit",),
    "collapse": ("collapse_drift_ratio",),
    "scaling_period": ("scaling_period_s",),
}


def sources_of(file: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    """Return each quantity with the keys that state it, as the file has them, or `DEFAULT`."""
    building, goods = file.get("building") or {}, file.get("goods") or {}
    storeys: Sequence[Mapping[str, Any]] = file.get("storeys") or []
    found = {}
    for name, keys in _OF_STOREYS.items():
        found[name] = _stated(keys, ("building", building), storeys)
    for name, keys in _OF_GOODS.items():
        found[name] = _stated(keys, ("goods", goods), storeys)
    for name, keys in _OF_BUILDING.items():
        found[name] = ", ".join(f"building.{key}" for key in keys if building.get(key) is not None) or DEFAULT
    found["mu_factors"] = "goods.mu_factors" if goods.get("mu_factors") is not None else DEFAULT
    for name in ("site", "code"):
        given = file.get(name) or {}
        found[name] = ", ".join(f"{name}.{key}" for key in given if given[key] is not None) or DEFAULT
    return tuple(found.items())


def _stated(keys: Sequence[str], default: tuple[str, Mapping[str, Any]], storeys: Sequence[Mapping[str, Any]]) -> str:
    """Keys of the defaults and of storeys that state a quantity, in whichever unit."""
    known = {*keys, *_in_other_units(keys)}
    place, table = default
    parts = [f"{place}.{key}" for key in table if key in known and table[key] is not None]
    own: dict[str, list[str]] = {}
    for number, storey in enumerate(storeys, start=1):
        for key in storey:
            if key in known and storey[key] is not None:
                own.setdefault(key, []).append(str(number))
        for kind in storey.get("goods") or []:
            for key in kind:
                if key in known and kind[key] is not None and str(number) not in own.setdefault(f"goods.{key}", []):
                    own[f"goods.{key}"].append(str(number))
    parts += [f"storeys[{', '.join(numbers)}].{key}" for key, numbers in own.items()]
    return "; ".join(parts) or DEFAULT


def _in_other_units(keys: Sequence[str]) -> set[str]:
    """Keys in US units, and those without a unit, that stand in the place of keys."""
    us = {**US_STOREY_KEYS, **US_GOODS_KEYS}
    found = {other for other, one in us.items() if one.key in keys}
    for key, of in (PLAIN_STOREY_KEYS | PLAIN_GOODS_KEYS).items():
        if any(one in keys or one in found for one in of.values()):
            found.add(key)
    return found
