"""Racks and stops of the goods of a building file: the tables `on_racks` and `stops` of a kind, a floor or all."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.assessment.file_values import held
from seismass.assessment.racks import DEFAULT_FRAME, DEFAULT_LEVELS, GoodsRack, GoodsStops
from seismass.base.errors import SeismassError
from seismass.base.input_table import NOT_NEGATIVE, POSITIVE, SHARE, Table
from seismass.model.rack import DEFAULT_RACK_DAMPING
from seismass.model.rack_periods import rack_direction

SUPPORT: Final = ("on_racks", "stops")
"""Keys of how goods stand: tables, or false where a default does not hold."""
RACK_KEYS: Final = ("direction", "period_s", "levels", "frame", "damping", "yield_shear_over_weight")
STOP_KEYS: Final = ("clearance_m", "stiffness_kn_per_m")


def rack_of(tables: tuple[Table, ...]) -> GoodsRack | None:
    """Return the racks under goods; None where they stand on the floor. The first of `tables` that describes racks
    counts.
    """
    table = _stated(tables, "on_racks", RACK_KEYS)
    if table is None:
        return None
    table.needed("direction", "period_s")
    table.one_of("direction", "period_s")
    if "period_s" in table.values:
        period, how = table.number("period_s", need=POSITIVE), "as stated"
    else:
        try:
            found = rack_direction(table.text("direction"))
        except SeismassError as error:
            table.refuse_as("direction", error)
        period = found.period
        how = f"{found.name}, usually {found.low:g} to {found.high:g} s; {found.source}, {found.status}"
    strength = "yield_shear_over_weight" in table.values
    return GoodsRack(
        period,
        how,
        table.count("levels", least=1) if "levels" in table.values else DEFAULT_LEVELS,
        table.number("frame", DEFAULT_FRAME, POSITIVE),
        table.number("damping", DEFAULT_RACK_DAMPING, SHARE),
        table.number("yield_shear_over_weight", need=POSITIVE) if strength else None,
    )


def stops_of(tables: tuple[Table, ...]) -> GoodsStops | None:
    """Return the stops beside goods; None where there are none. The first of `tables` that describes stops counts."""
    table = _stated(tables, "stops", STOP_KEYS)
    if table is None:
        return None
    table.needed("clearance_m")
    stated = "stiffness_kn_per_m" in table.values
    stiffness = 1e3 * table.number("stiffness_kn_per_m", need=POSITIVE) if stated else None
    return GoodsStops(table.number("clearance_m", np.nan, NOT_NEGATIVE), stiffness)


def _stated(tables: tuple[Table, ...], key: str, known: tuple[str, ...]) -> Table | None:
    place = held(tables, (key,))
    if place is None:
        return None
    table, _ = place
    if table.values[key] is False:
        return None
    if not isinstance(table.values[key], dict):
        table.refuse(key, f"a table with {' or '.join(known[:2])}, or false", str(table.values[key]))
    found = table.table(key)
    found.known(known)
    return found
