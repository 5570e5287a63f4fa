"""A response as plain values: what `to_dict`, `to_json` and `seismass run --json` give."""

from __future__ import annotations

import json
from typing import Any, Final

from seismass.media.result import finite_values
from seismass.model.places import goods_names

_LISTS: Final = (
    "peak_drift",
    "peak_drift_time",
    "peak_slip",
    "peak_slip_time",
    "peak_floor_acceleration",
    "peak_floor_acceleration_time",
    "peak_storey_shear",
    "peak_storey_shear_time",
    "residual_drift",
    "residual_slip",
    "slip_path",
)
"""Arrays that are given whole."""


class ResponseDocument:
    """What a response is as a document; everything else of it is in `Response`."""

    __slots__ = ()

    def to_dict(self) -> dict[str, Any]:
        """Return peaks, residuals, counts, events, energy and work in SI units, null for what is not finite.

        Events and energies are there where `simulate` was asked for them. Histories are left out. In scenes of the
        general engine `goods` says where each block stands, in the order of slips; racks have a list for each, of its
        levels; and events of stops have the velocity at the contact.
        """
        response: Any = self
        scene, building = response.scene, response.scene.building
        result: dict[str, Any] = {
            "name": scene.name,
            "status": response.status,
            "collapsed_storey": response.collapsed_storey,
            "end_time": response.end_time,
            "dt": response.motion.dt,
            "remarks": list(response.remarks),
            **{name: getattr(response, name).tolist() for name in _LISTS},
            "peak_base_shear": response.peak_base_shear,
        }
        if scene.engine == "general":
            result["goods"] = list(goods_names(scene))
            result |= response.rack_values() | response.base_values()
        for name in ("peak_drift_ratio", "residual_drift_ratio"):
            if getattr(response, name) is not None:
                result[name] = getattr(response, name).tolist()
        if building is not None:
            result["mass_stated"] = building.mass_is_stated
            result["peak_shear_over_weight"] = (response.peak_storey_shear / building.weight).tolist()
        result["counts"] = {kind: count for kind, count in response.counts.items() if count}
        if response.has_events:
            result["events"] = [
                {key: value for key, value in event.items() if value is not None}
                for event in response.events.iter_rows(named=True)
            ]
        if response.has_energy:
            result["energy"] = response.energy
        if building is not None:
            result["damping_matrix"] = building.damping_matrix.tolist()
        result["statistics"] = response.statistics
        finite: dict[str, Any] = finite_values(result)
        return finite

    def to_json(self) -> str:
        """Return `to_dict` as JSON."""
        return json.dumps(self.to_dict(), indent=2, allow_nan=False)
