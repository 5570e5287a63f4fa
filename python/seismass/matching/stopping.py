"""How the threads of a suite end before they are done: each looks at one event between small pieces of its work."""

from __future__ import annotations

from contextvars import ContextVar
from threading import Event
from typing import Final


class Stopped(Exception):
    """The suite that a motion belongs to is given up."""


STOP: Final[ContextVar[Event | None]] = ContextVar("STOP", default=None)
"""Set where the threads of a suite are to end, as on Ctrl-C; none in a thread that matches one motion alone."""


def end_if_stopped() -> None:
    """Raise `Stopped` where the event of this thread is set."""
    stop = STOP.get()
    if stop is not None and stop.is_set():
        raise Stopped
