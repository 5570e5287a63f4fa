"""How far a campaign is, and how long the rest will take."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from seismass.base.views import Card


@dataclass(frozen=True)
class CampaignProgress(Card):
    """How far a campaign is.

    Attributes
    ----------
    parts_done, parts : int
        Parts in the folder, and those of this call: all, or those of a shard.
    runs_done, runs : int
        Runs solved, those of a part in hand included where they are known, and those of this call.
    runs_before : int
        Runs that were in the folder when the call began.
    seconds : float
        Time since the call began.
    """

    parts_done: int
    parts: int
    runs_done: int
    runs: int
    runs_before: int
    seconds: float

    @property
    def runs_per_second(self) -> float | None:
        """Runs solved by this call per second; None before there are any."""
        solved = self.runs_done - self.runs_before
        return solved / self.seconds if solved > 0 and self.seconds > 0.0 else None

    @property
    def seconds_left(self) -> float | None:
        """Estimate of the time left (s), at the rate so far; None before there is one."""
        rate = self.runs_per_second
        return None if rate is None else (self.runs - self.runs_done) / rate

    @property
    def text(self) -> str:
        """One line: parts, runs, rate, time left."""
        line = f"{self.parts_done} of {self.parts} parts, {self.runs_done} of {self.runs} runs"
        rate, left = self.runs_per_second, self.seconds_left
        if rate is None or left is None:
            return line
        return f"{line}, {rate:.0f} runs/s, {duration_text(left)} left"


Report: TypeAlias = Callable[[CampaignProgress], object]
"""Called with the progress of a campaign."""


def duration_text(seconds: float) -> str:
    """Return a time in the two largest of its units: 5 s, 3 min 20 s, 2 h 5 min, 12 d 4 h."""
    whole = max(round(seconds), 0)
    for size, unit, smaller_size, smaller in ((86400, "d", 3600, "h"), (3600, "h", 60, "min"), (60, "min", 1, "s")):
        if whole >= size:
            return f"{whole // size} {unit} {whole % size // smaller_size} {smaller}"
    return f"{whole} s"
