"""A target spectrum made again from its parameters, as a file of JSON holds them."""

from __future__ import annotations

from typing import Any

from seismass.base.errors import InvalidOption
from seismass.base.values import brief, frozen, refusal
from seismass.spectra.tables import CsvTable
from seismass.spectra.target import TargetSpectrum


def target_of_parameters(parameters: dict[str, Any]) -> TargetSpectrum:
    """Return the target spectrum whose `TargetSpectrum.parameters` these are; refused is the mean of motions, whose
    samples they do not hold.
    """
    given = dict(parameters)
    tilt = given.pop("tilt", 0.0)
    match given.get("shape"):
        case "asce7":
            target = TargetSpectrum.asce7(given["sds_g"], given["sd1_g"], given["tl"])
        case "asce7_multi_period":
            target = TargetSpectrum.asce7_multi_period(given["period"], given["sa_g"])
        case "eurocode8":
            target = TargetSpectrum.eurocode8(
                given["type"],
                given["ground"],
                agr_g=given["agr_g"],
                importance=given["importance"],
                damping=given["damping"],
            )
        case "nzs1170":
            distance = given["fault_distance_km"]
            target = TargetSpectrum.nzs1170(given["site_class"], z=given["z"], r=given["r"], fault_distance_km=distance)
        case "csv":
            label = given["file"].rpartition(".")[0] or given["file"]
            target = TargetSpectrum(CsvTable(frozen(given["period"]), frozen(given["sa_g"]), label, given["file"]))
        case "suite_mean":
            requirement = "made of numbers (TargetSpectrum.from_csv reads a table of a mean spectrum)"
            raise refusal(InvalidOption, "target", "stored spectrum", requirement, "the mean of motions")
        case other:
            raise refusal(InvalidOption, "target", "stored spectrum", "of a kind that is known", brief(other))
    return target.tilted(tilt) if tilt else target
