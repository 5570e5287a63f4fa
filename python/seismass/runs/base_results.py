"""What a response has of a sliding base: its slip, its acceleration, and its events."""

from __future__ import annotations

from typing import Any, Final

from seismass.base.errors import InvalidScene
from seismass.base.values import FloatArray, refusal
from seismass.model.scene import Scene

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
