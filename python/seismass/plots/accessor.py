"""What `response.plot` is: the functions of one run as methods."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, Concatenate, ParamSpec

from matplotlib.figure import Figure

from seismass.plots import growth, histories, hysteresis, profiles, timeline
from seismass.response import Response

P = ParamSpec("P")


def _method(function: Callable[Concatenate[Response, P], Figure]) -> Callable[Concatenate[Any, P], Figure]:
    @wraps(function)
    def method(self: ResponsePlots, /, *args: P.args, **kwargs: P.kwargs) -> Figure:
        return function(self._response, *args, **kwargs)

    return method


class ResponsePlots:
    """Figures of a response: each method is the function of `seismass.plots` with its name."""

    __slots__ = ("_response",)

    def __init__(self, response: Response) -> None:
        self._response = response

    drift = _method(histories.drift)
    slip = _method(histories.slip)
    acceleration = _method(histories.acceleration)
    loops = _method(hysteresis.loops)
    slip_path = _method(growth.slip_path)
    energy = _method(growth.energy)
    profile = _method(profiles.profile)
    floor_spectra = _method(profiles.floor_spectra)
    events = _method(timeline.events)

    def __repr__(self) -> str:
        return f"<figures of {self._response!r}>"
