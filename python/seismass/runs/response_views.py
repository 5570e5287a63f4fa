"""What `response.plot` is, and what `response.animate` gives: declared here, made where figures and animations are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final, Protocol

from numpy.typing import ArrayLike

from seismass.base.views import Views, view

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DEFAULT_POINTS: Final = 200
"""Number of times at which a run is solved again for figures of what grows along it."""


class ResponsePlots(Views):
    """Figures of a response: each method is the function of `seismass.plots` with its name."""

    __slots__ = ()

    @view
    def drift(
        self,
        *,
        storeys: int | Sequence[int] | None = None,
        events: bool | Sequence[str] = True,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw the drift of storeys over time, with their peaks in continuous time and their events."""
        raise NotImplementedError

    @view
    def slip(
        self,
        *,
        blocks: int | Sequence[int] | None = None,
        events: bool | Sequence[str] = True,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw the slip of blocks over time, with their peaks in continuous time, their events and their stops."""
        raise NotImplementedError

    @view
    def rack_drift(
        self,
        *,
        racks: int | Sequence[int] | None = None,
        events: bool | Sequence[str] = True,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw the drift of the levels of racks over time, with their peaks in continuous time and their events."""
        raise NotImplementedError

    @view
    def rack_profile(self, *, racks: int | Sequence[int] | None = None, ax: Sequence[Axes] | None = None) -> Figure:
        """Draw the peaks of racks over their levels: drift, acceleration, spring force, and slip of their goods."""
        raise NotImplementedError

    @view
    def contacts(self, *, blocks: int | Sequence[int] | None = None, ax: Axes | Sequence[Axes] | None = None) -> Figure:
        """Draw the velocity with which blocks come to their stops, up where the stop is on the side of plus."""
        raise NotImplementedError

    @view
    def acceleration(
        self,
        *,
        floors: int | Sequence[int] | None = None,
        events: bool | Sequence[str] = True,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw the absolute acceleration of floors over time, with their peaks and the yielding of the storey below."""
        raise NotImplementedError

    @view
    def loops(
        self,
        *,
        storeys: int | Sequence[int] | None = None,
        events: bool | Sequence[str] = False,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw spring force against drift of storeys, over the backbone of each."""
        raise NotImplementedError

    @view
    def slip_path(
        self, *, blocks: int | Sequence[int] | None = None, points: int = DEFAULT_POINTS, ax: Axes | None = None
    ) -> Figure:
        """Draw the path that blocks have slipped over time, which only grows."""
        raise NotImplementedError

    @view
    def energy(self, *, points: int = DEFAULT_POINTS, ax: Axes | None = None) -> Figure:
        """Draw the energies of a run over time, relative to the moving ground, stacked; their sum is what came in."""
        raise NotImplementedError

    @view
    def profile(
        self,
        *,
        quantities: Sequence[str] = ("drift", "acceleration", "shear", "slip"),
        limits: Mapping[str, float] | None = None,
        ax: Axes | Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw the peaks of a run over the height of the building, in continuous time, with limits."""
        raise NotImplementedError

    @view
    def floor_spectra(
        self,
        *,
        floors: int | Sequence[int] | None = None,
        periods: ArrayLike | None = None,
        damping: float = 0.05,
        ax: Axes | None = None,
    ) -> Figure:
        """Draw the pseudo-acceleration spectrum of the ground and of floors, for what stands on them."""
        raise NotImplementedError

    @view
    def events(self, *, ax: Axes | None = None) -> Figure:
        """Draw when each storey, level of a rack and block had its events: a row for each, a marker for each kind."""
        raise NotImplementedError


class ResponseAnimation(Protocol):
    """The animation of a run: `seismass.Animation`."""

    def html(self) -> str:
        """Return a page that needs nothing but itself."""

    def write(self, path: str | Path, *, frames_per_second: float | None = None, speed: float = 1.0) -> None:
        """Write a page (.html), a GIF (.gif) or a film (.mp4)."""
