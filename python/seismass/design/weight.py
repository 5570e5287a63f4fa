"""Effective seismic weight by code: dead load, the code's share of the live load, what counts besides, exceptions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias, get_args

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import as_word, is_one_of, known_id
from seismass.base.errors import InvalidOption
from seismass.base.files import stored_rows
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FieldValue, FloatArray, as_array, as_number, frozen, refusal
from seismass.base.views import Card
from seismass.design.rules import not_negative, weakest
from seismass.model.codes import CODE_IDS, FROM_MEMORY, SECOND_HAND, VERIFIED, Use, code_fraction

FloorUse: TypeAlias = Use
"""Use of a floor."""

PARTITION_MINIMUM: Final = 480.0
"""Least weight of partitions (Pa) where the floor load provides for them: ASCE/SEI 7-10, 12.7.2, item 2 (verified)."""
SMALL_SHARE: Final = 0.05
"""Storage that adds at most so much to the weight of its level is exempt: ASCE/SEI 7-10, 12.7.2, item 1a (verified)."""

_ASCE: Final = {"asce7-10": VERIFIED, "asce7-16": FROM_MEMORY, "asce7-22": SECOND_HAND}
_ITEM_1A: Final = "storage that adds at most 5 % to the weight of its level is exempt: 12.7.2, exception a"
_TOGETHER: Final = "storage, equipment and landscaping that add at most 5 % together are exempt: 12.7.2, exception a"
# Share of the snow load, and the load (Pa) above which it counts: 30 psf and 45 psf in ASCE 7.
_SNOW: Final = {
    "asce7-10": (0.20, 1440.0, "12.7.2, item 4", VERIFIED),
    "asce7-16": (0.20, 1440.0, "12.7.2, item 4", FROM_MEMORY),
    "asce7-22": (0.15, 2160.0, "12.7.2, item 4", SECOND_HAND),
    "nbc": (0.25, 0.0, "4.1.8.2", SECOND_HAND),
    "gb50011": (0.5, 0.0, "5.1.3", FROM_MEMORY),
}
_ROOF: Final = {row["id"]: row for row in stored_rows("fractions") if row["use"] == "roof"}
"""Rows of roofs; of IS 1893 for any use, of other codes for ordinary roofs."""
_ANY_ROOF: Final = ("is1893",)
INTENSITY: Final = {"bnbc2017": (3000.0, "2.5.7.3", VERIFIED), "is1893": (3000.0, "table 10", FROM_MEMORY)}
"""Live load (Pa) above which a floor has the fraction of storage, where that decides and not the use."""


@dataclass(frozen=True, eq=False, repr=False)
class SeismicWeight(FieldValue, Card):
    """Effective seismic weight of a building by a code.

    Attributes
    ----------
    code_id : str
        The code.
    weight : ndarray, shape (floors,)
        Effective seismic weight of each floor (N).
    table : polars.DataFrame
        One row per floor: floor, from 1; use; dead, live (N); fraction of the live load; live_counted, partitions,
        equipment, landscaping, snow (N), as counted; weight (N); exception, in words, or an empty text.
    rules : polars.DataFrame
        One row per rule that took part: rule, clause, status (as in `code_table`).
    status : {"verified", "second-hand", "from memory, unverified"}
        The weakest of the rules.
    """

    code_id: str
    weight: FloatArray
    table: pl.DataFrame
    rules: pl.DataFrame
    status: str

    @property
    def total(self) -> float:
        """W (N)."""
        return float(self.weight.sum())

    @property
    def mass(self) -> FloatArray:
        """Seismic mass of each floor (kg)."""
        return self.weight / STANDARD_GRAVITY


def effective_seismic_weight(
    dead: ArrayLike,
    live: ArrayLike,
    *,
    code_id: str = "asce7-10",
    use: FloorUse | Sequence[FloorUse] | None = None,
    area: ArrayLike | None = None,
    partitions: ArrayLike | None = None,
    equipment: ArrayLike | None = None,
    landscaping: ArrayLike | None = None,
    snow: float | None = None,
    roof: bool = True,
) -> SeismicWeight:
    """Return the effective seismic weight of each floor by a code.

    Parameters
    ----------
    dead, live : array_like, shape (floors,)
        Dead load and design live load of each floor (N), floor 1 first. Dead load is without what follows.
    code_id : str, default "asce7-10"
        One of `seismass.model.codes.CODE_IDS`, in any case.
    use : str or list of str, optional
        Use of all floors, or of each, as `code_fraction` takes it. By default "storage"; for codes that decide by the
        live load per area (BNBC 2017, IS 1893), that decides where areas are given.
    area : array_like, shape (floors,), optional
        Areas of the floors (m2); for that, for partitions and for snow.
    partitions : array_like, shape (floors,), optional
        Actual weight of partitions (N), on floors whose live load provides for them. In ASCE 7 at least 0.48 kPa of the
        area counts there; areas are needed. NaN: no provision on this floor.
    equipment, landscaping : array_like, shape (floors,), optional
        Operating weight of permanent equipment; landscaping and materials at roof gardens (N).
    snow : float, optional
        Snow load of the roof (Pa), on the area of the last floor.
    roof : bool, default True
        The last floor is a roof, whose live load some codes count differently.

    Raises
    ------
    InvalidOption
        An argument is out of its range, the code says nothing of a use, or has no rule for snow or garages here.

    Notes
    -----
    Fractions are those of `code_fraction`, with the upper end of a range. The exceptions of ASCE/SEI 7-10, 12.7.2, are
    applied: storage that adds at most 5 % to the weight of its level without it, and garages. In 7-22 the 5 % are of
    storage, equipment and landscaping together.

    Examples
    --------
    A warehouse with a live load of 12 kPa on two floors, and of 1 kPa of stored things on the roof:

    >>> import seismass as sm
    >>> found = sm.design.effective_seismic_weight([5e6, 5e6, 4e6], [1.2e7, 1.2e7, 7e5])
    >>> found.table["live_counted"].to_list()
    [3000000.0, 3000000.0, 0.0]
    >>> found.total, found.status
    (20000000.0, 'verified')
    """
    code = known_id(code_id, CODE_IDS, "code")
    d, q = _loads(dead, "dead", None), _loads(live, "live", None)
    floors = len(d)
    if len(q) != floors or floors == 0:
        requirement = f"{max(floors, 1)} values, one per floor"
        raise refusal(InvalidOption, "live", "seismic weight", requirement, f"{len(q)} values")
    areas = None if area is None else _loads(area, "area", floors)
    rules = _Rules(code)
    uses = _uses(use, code, q, areas, rules)
    part = _partitions(partitions, code, areas, floors, rules)
    tools, plants = (
        np.zeros(floors) if values is None else _loads(values, name, floors)
        for values, name in ((equipment, "equipment"), (landscaping, "landscaping"))
    )
    snow_weight = _snow(snow, code, areas, floors, rules)
    rows: list[dict[str, Any]] = []
    for i in range(floors):
        fraction, exception = _fraction(code, uses[i], roof and i == floors - 1, rules)
        counted = {"live_counted": fraction * q[i], "equipment": float(tools[i]), "landscaping": float(plants[i])}
        base = float(d[i] + part[i] + snow_weight[i])
        if code in _ASCE and uses[i] in ("storage", "archive"):
            together = code == "asce7-22"
            small = sum(counted.values()) if together else counted["live_counted"]
            rest = base if together else base + counted["equipment"] + counted["landscaping"]
            if 0.0 < small <= SMALL_SHARE * rest:
                exception = "at most 5 % of the weight of the level"
                rules.add(_TOGETHER if together else _ITEM_1A, "12.7.2, item 1a", _ASCE[code])
                counted |= dict.fromkeys(counted if together else ("live_counted",), 0.0)
        rows.append(
            {
                "floor": i + 1,
                "use": uses[i],
                "dead": float(d[i]),
                "live": float(q[i]),
                "fraction": fraction,
                "live_counted": counted["live_counted"],
                "partitions": float(part[i]),
                "equipment": counted["equipment"],
                "landscaping": counted["landscaping"],
                "snow": float(snow_weight[i]),
                "weight": base + sum(counted.values()),
                "exception": exception,
            }
        )
    table = pl.DataFrame(rows, schema_overrides={"floor": pl.UInt32})
    return SeismicWeight(code, frozen(table["weight"].to_numpy()), table, rules.table(), rules.status)


class _Rules:
    """Rules that took part."""

    def __init__(self, code: str) -> None:
        self.code = code
        self._rows: dict[str, tuple[str, str]] = {}

    def add(self, rule: str, clause: str, status: str) -> None:
        """Add a rule once."""
        self._rows[rule] = (clause, status)

    @property
    def status(self) -> str:
        """The weakest of all."""
        return weakest([status for _, status in self._rows.values()])

    def table(self) -> pl.DataFrame:
        """One row per rule."""
        rows = [(rule, *entries) for rule, entries in self._rows.items()]
        return pl.DataFrame(rows, schema=dict.fromkeys(("rule", "clause", "status"), pl.String), orient="row")


def _fraction(code: str, use: FloorUse, is_roof: bool, rules: _Rules) -> tuple[float, str]:
    """Fraction of the live load of a floor, and an exception in words."""
    row = code_fraction(code, use)
    if is_roof and code in _ROOF and (use == "ordinary" or code in _ANY_ROOF):
        roof = code_fraction(code, "roof")
        rules.add(f"{roof.fraction:g} of the live load of the roof ({use})", roof.clause, roof.status)
        return roof.fraction, "roof"
    rules.add(f"{row.fraction:g} of the live load ({use})", row.clause, row.status)
    return row.fraction, "garage" if use == "garage" and row.fraction == 0.0 else ""


def _uses(
    use: FloorUse | Sequence[FloorUse] | None, code: str, live: FloatArray, areas: FloatArray | None, rules: _Rules
) -> list[FloorUse]:
    """Use of each floor."""
    if use is None and code in INTENSITY and areas is not None:
        limit, clause, status = INTENSITY[code]
        rules.add(f"the live load per area decides on the fraction, above or up to {limit / 1e3:g} kPa", clause, status)
        # Rounding must not lift a live load of exactly the limit above it.
        return ["storage" if q > limit * a * (1.0 + 1e-12) else "ordinary" for q, a in zip(live, areas, strict=True)]
    uses: list[Any] = [use or "storage"] * len(live) if use is None or isinstance(use, str) else list(use)
    if len(uses) != len(live):
        requirement = f"one use or a list of {len(live)}, one per floor"
        raise refusal(InvalidOption, "use", "seismic weight", requirement, f"{len(uses)} of them")
    for one in uses:
        as_word(one, get_args(FloorUse), "use", "seismic weight")
    return uses


def _partitions(
    partitions: ArrayLike | None, code: str, areas: FloatArray | None, floors: int, rules: _Rules
) -> FloatArray:
    """Weight of partitions that counts on each floor (N)."""
    if partitions is None:
        return np.zeros(floors)
    loads = as_array(partitions, "partitions", "seismic weight", InvalidOption)
    stated = _loads(np.nan_to_num(loads, nan=0.0), "partitions", floors)
    if not is_one_of(code, _ASCE):
        return stated
    if areas is None:
        raise refusal(InvalidOption, "area", "seismic weight", "given where partitions are", "none")
    rules.add("partitions, at least 0.48 kPa where the floor load provides for them", "12.7.2, item 2", _ASCE[code])
    return np.where(np.isnan(loads), 0.0, np.maximum(stated, PARTITION_MINIMUM * areas))


def _snow(snow: float | None, code: str, areas: FloatArray | None, floors: int, rules: _Rules) -> FloatArray:
    """Weight of snow that counts on each floor (N)."""
    weight = np.zeros(floors)
    if snow is None:
        return weight
    load = as_number(snow, "snow", "seismic weight", InvalidOption)
    if not 0.0 <= load < np.inf:
        raise refusal(InvalidOption, "snow", "seismic weight", "a load of at least 0 (Pa)", f"{load:g}")
    if not is_one_of(code, _SNOW):
        raise refusal(
            InvalidOption, "snow", f"code {code}", "left out: its rule for snow is not known here", f"{load:g}"
        )
    if areas is None:
        raise refusal(InvalidOption, "area", "seismic weight", "given where snow is", "none")
    share, least, clause, status = _SNOW[code]
    above = f" where it is above {least / 1e3:g} kPa" if least > 0.0 else ""
    rules.add(f"{share:g} of the snow load{above}", clause, status)
    if load > least:
        weight[-1] = share * load * areas[-1]
    return weight


def _loads(values: ArrayLike, name: str, floors: int | None) -> FloatArray:
    array = as_array(values, name, "seismic weight", InvalidOption)
    if floors is not None and len(array) != floors:
        raise refusal(InvalidOption, name, "seismic weight", f"{floors} values, one per floor", f"{len(array)} values")
    return not_negative(array, name, "seismic weight")
