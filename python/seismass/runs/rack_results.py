"""What a response has of racks and of stops: peaks, residuals and histories of levels, and contacts."""

from __future__ import annotations

from typing import Any

import numpy as np

from seismass.base.values import FloatArray, frozen
from seismass.model.scene import Scene


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
