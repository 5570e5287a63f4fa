"""Motions scaled to the site of a building: one way for `assess` and for every command that takes a building file."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from seismass.assessment.own_building import OwnBuilding
from seismass.base.errors import InvalidOption
from seismass.base.values import as_number
from seismass.scaling import ScalingResult, scale_asce7_10
from seismass.spectra import TargetSpectrum


def scaled_to_site(
    building: OwnBuilding,
    motions: Iterable[Any],
    target: TargetSpectrum | None = None,
    period: float | None = None,
    *,
    threads: int | None = None,
) -> ScalingResult:
    """Return the factors of `scale_asce7_10` for the period T (s) that is given, else stated in the building file.

    Without either T is the first period with the goods present attached; in two directions motions are then scaled from
    0.2 of the shorter to 1.5 of the longer one. `target` stands in place of the building's site.
    """
    stated = building.scaling_period
    if period is not None:
        stated = as_number(period, "scaling_period", "assessment", InvalidOption)
    directions = [each for each in (building, building.other) if each is not None]
    periods = [each.period(building.goods) for each in directions] if stated is None else [stated]
    shorter, longer = min(periods), max(periods)
    within = (0.2 * (shorter / longer), 1.5)
    spectrum = building.site_spectrum(target)
    return scale_asce7_10(motions, spectrum, longer, period_range=within, between=False, threads=threads)
