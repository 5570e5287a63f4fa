"""The spring of a storey driven slowly along a list of drifts: its hysteresis loop, for figures and comparisons."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption
from seismass.base.forks import require_polars
from seismass.base.values import FloatArray, as_array, as_count, brief, content_hash, refusal, same_content, short_repr
from seismass.base.views import Card
from seismass.model.building import Building
from seismass.runs.response import EVENT_KINDS


@dataclass(frozen=True, eq=False)
class SpringPath(Card):
    """What a spring did along a list of drifts.

    Attributes
    ----------
    drift : ndarray, shape (drifts,)
        The drifts (m), as given.
    force : ndarray, shape (drifts,)
        Force of the spring at each of them, without damping and P-Delta (N).
    dissipated : ndarray, shape (drifts,)
        Energy dissipated up to each of them (J).
    stored : ndarray, shape (drifts,)
        Energy stored at each of them (J).
    events : polars.DataFrame
        Events on the way, in order: `drift_number` of the drift towards which it happened, from 1; `drift` (m) and
        `force` (N) then; `kind`, `sign` and `element` as in `Response.events`.
    """

    drift: FloatArray
    force: FloatArray
    dissipated: FloatArray
    stored: FloatArray
    events: pl.DataFrame

    __repr__ = short_repr
    __eq__ = same_content
    __hash__ = content_hash


def spring_forces(building: Building, storey: int, drifts: ArrayLike) -> SpringPath:
    """Drive the spring of a storey from one drift to the next and return its forces.

    The spring is virgin at first, at drift 0. It moves slowly, without damping, P-Delta and collapse.

    Parameters
    ----------
    building : Building
        The building.
    storey : int
        Number of the storey, from 1.
    drifts : array_like, shape (drifts,)
        Drifts (m), reached one after the other, each by a straight way from the one before.

    Returns
    -------
    SpringPath
        Forces, energies and events.

    Raises
    ------
    InvalidOption
        There is no such storey, or a drift is not a finite number.
    SimulationError
        The process was forked from one in which Polars had been used.

    Examples
    --------
    An elastoplastic storey that yields at 0.01 m, pushed to 0.03 m and back:

    >>> import seismass as sm
    >>> building = sm.Building(1e3, 1e6, yield_shear=1e4, overstrength=1.0, second_slope=0.0)
    >>> path = sm.runs.spring_forces(building, 1, [0.005, 0.03, 0.0])
    >>> path.force.tolist()
    [5000.0, 10000.0, -10000.0]
    >>> path.events["kind"].to_list()
    ['yield', 'unload', 'yield']
    """
    if not isinstance(building, Building):
        raise refusal(InvalidOption, "building", "spring path", "a Building", brief(building))
    require_polars("spring_forces")
    number = as_count(storey, "storey", "spring path", InvalidOption, least=1)
    if number > building.storeys:
        requirement = f"the number of a storey, counted from 1 to {building.storeys}"
        raise refusal(InvalidOption, "storey", "spring path", requirement, str(number))
    path = as_array(drifts, "drifts", "spring path", InvalidOption)
    run = building._kernel.spring_path(number - 1, path)
    events = pl.DataFrame(
        {
            "drift_number": pl.Series(run.event_leg + 1, dtype=pl.UInt32),
            "drift": pl.Series(run.event_drift, dtype=pl.Float64),
            "force": pl.Series(run.event_force, dtype=pl.Float64),
            "kind": pl.Series(np.array(EVENT_KINDS)[run.event_kind].tolist(), dtype=pl.String),
            "sign": pl.Series(run.event_sign, dtype=pl.Int8),
            "element": pl.Series(run.event_element, dtype=pl.UInt8).replace(0, None),
        }
    )
    return SpringPath(path, run.force, run.dissipated, run.stored, events)
