"""Parts of a response: racks, a sliding base, and the document of all numbers."""

from __future__ import annotations

import json
from typing import Any, Final

import numpy as np

from seismass.base.errors import InvalidScene
from seismass.base.values import FloatArray, frozen, refusal
from seismass.model.scene import Scene, goods_names


class RackResults:
    """Results of racks and stops; a scene of the chain engine has none."""

    __slots__ = ()
    scene: Scene

    def _get(self, name: str) -> Any:
        raise NotImplementedError

    def _array(self, name: str) -> FloatArray:
        raise NotImplementedError

    def _history(self, name: str) -> FloatArray:
        raise NotImplementedError

    @property
    def peak_rack_drift(self) -> tuple[FloatArray, ...]:
        """Largest absolute drift of the levels of each rack (m), relative to the level below or to its floor."""
        return self._of_racks("peak_rack_drift")

    @property
    def peak_rack_drift_time(self) -> tuple[FloatArray, ...]:
        """When it was first reached (s), for the levels of each rack."""
        return self._of_racks("peak_rack_drift_time")

    @property
    def peak_rack_acceleration(self) -> tuple[FloatArray, ...]:
        """Largest absolute acceleration of the levels of each rack (m/s2)."""
        return self._of_racks("peak_rack_acceleration")

    @property
    def peak_rack_shear(self) -> tuple[FloatArray, ...]:
        """Largest absolute spring force of the levels of each rack, without damping (N)."""
        return self._of_racks("peak_rack_shear")

    @property
    def residual_rack_drift(self) -> tuple[FloatArray, ...]:
        """Drift of the levels of each rack at the end (m)."""
        return self._of_racks("residual_rack_drift")

    @property
    def rack_drift(self) -> tuple[FloatArray, ...]:
        """Histories of the drifts of each rack (m), each of shape (rows, levels)."""
        return self._histories_of_racks("rack_drift")

    @property
    def rack_velocity(self) -> tuple[FloatArray, ...]:
        """Histories of the velocities of each rack's levels relative to the ground (m/s), each (rows, levels)."""
        return self._histories_of_racks("rack_velocity")

    @property
    def rack_acceleration(self) -> tuple[FloatArray, ...]:
        """Histories of the absolute accelerations of each rack's levels (m/s2), each of shape (rows, levels)."""
        return self._histories_of_racks("rack_acceleration")

    @property
    def rack_force(self) -> tuple[FloatArray, ...]:
        """Histories of the spring forces of each rack (N), each of shape (rows, levels)."""
        return self._histories_of_racks("rack_force")

    @property
    def peak_contact_force(self) -> FloatArray:
        """Largest force of each block on its stop (N), zero without stops, shape (blocks,)."""
        return self._of_stops("peak_contact_force")

    @property
    def peak_contact_velocity(self) -> FloatArray:
        """Largest relative velocity at which each block comes to its stop (m/s), shape (blocks,)."""
        return self._of_stops("peak_contact_velocity")

    def rack_values(self) -> dict[str, Any]:
        """Return the peaks and residuals of racks, and the peaks of contacts, by name as plain lists."""
        of_racks = ("drift", "drift_time", "acceleration", "shear")
        of_stops = ("peak_contact_force", "peak_contact_velocity")
        return {
            **{f"peak_rack_{name}": _listed(getattr(self, f"peak_rack_{name}")) for name in of_racks},
            "residual_rack_drift": _listed(self.residual_rack_drift),
            **{name: getattr(self, name).tolist() for name in of_stops},
        }

    def _of_racks(self, name: str) -> tuple[FloatArray, ...]:
        """Values of all levels, one array for each rack; none without racks."""
        if self.scene.engine != "general":
            return ()
        ends = np.cumsum(self._get("rack_levels"))[:-1]
        return tuple(frozen(part) for part in np.split(self._array(name), ends)) if self.scene.racks else ()

    def _histories_of_racks(self, name: str) -> tuple[FloatArray, ...]:
        if self.scene.engine != "general":
            return ()
        ends = np.cumsum(self._get("rack_levels"))[:-1]
        history = self._history(name)
        return tuple(frozen(part) for part in np.split(history, ends, axis=1)) if self.scene.racks else ()

    def _of_stops(self, name: str) -> FloatArray:
        if self.scene.engine != "general":
            return frozen(np.zeros(len(self._array("peak_slip"))))
        return self._array(name)


def _listed(racks: tuple[FloatArray, ...]) -> list[list[float]]:
    return [levels.tolist() for levels in racks]


BASE_NUMBERS: Final = (
    "peak_base_slip",
    "peak_base_slip_time",
    "residual_base_slip",
    "base_slip_path",
    "peak_base_acceleration",
)
"""Results of a sliding base that are one number each."""


class BaseResults:
    """Results of a sliding base; without one they are refused."""

    __slots__ = ()
    scene: Scene

    def _get(self, name: str) -> Any:
        raise NotImplementedError

    def _history(self, name: str) -> FloatArray:
        raise NotImplementedError

    @property
    def peak_base_slip(self) -> float:
        """Largest absolute slip of the slab on the ground (m)."""
        return self._of_base("peak_base_slip")

    @property
    def peak_base_slip_time(self) -> float:
        """When it was first reached (s)."""
        return self._of_base("peak_base_slip_time")

    @property
    def residual_base_slip(self) -> float:
        """Slip of the slab at the end (m), where it may still slide."""
        return self._of_base("residual_base_slip")

    @property
    def base_slip_path(self) -> float:
        """Path slipped by the slab in contact with the ground (m)."""
        return self._of_base("base_slip_path")

    @property
    def peak_base_acceleration(self) -> float:
        """Largest absolute acceleration of the slab (m/s2); where it jumps both one-sided limits count."""
        return self._of_base("peak_base_acceleration")

    @property
    def base_slip(self) -> FloatArray:
        """History of the slip of the slab (m), shape (rows,)."""
        self._needed("base_slip")
        return self._history("base_slip")

    def base_values(self) -> dict[str, float]:
        """Return the numbers of the base by name; none without a sliding base."""
        return {} if self.scene.base is None else {name: getattr(self, name) for name in BASE_NUMBERS}

    def _needed(self, name: str) -> None:
        if self.scene.base is None:
            raise refusal(InvalidScene, "base", "scene", f"given, if {name} is wanted", "none")

    def _of_base(self, name: str) -> float:
        self._needed(name)
        return float(self._get(name))


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
        """Return peaks, residuals, counts, events, energy and work in SI units, null for non-finite values.

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
        from seismass.media.result import finite_values

        finite: dict[str, Any] = finite_values(result)
        return finite

    def to_json(self) -> str:
        """Return `to_dict` as JSON."""
        return json.dumps(self.to_dict(), indent=2, allow_nan=False)
