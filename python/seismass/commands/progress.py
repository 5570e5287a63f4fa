"""How far a long command is, and how long the rest will take: a bar on standard error, where that is a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from rich.progress import Task

Progress: TypeAlias = Callable[[int, int], None]
"""Called with how much is done and how much there is."""


@contextmanager
def progress(unit: str = "runs") -> Iterator[Progress | None]:
    """Give the callback that shows progress in `unit`, or None where standard error is no terminal. The bar is removed
    at the end, also after an error or Ctrl-C.
    """
    if not sys.stderr.isatty():
        yield None
        return
    from rich import progress as rich_progress
    from rich.console import Console

    columns: list[Any] = [
        rich_progress.BarColumn(),
        f"{{task.completed:.0f}} of {{task.total:.0f}} {unit}",
        _time_left_column(),
    ]
    # Standard output stays what it is, since it may be a file.
    bar = rich_progress.Progress(
        *columns, console=Console(stderr=True), transient=True, redirect_stdout=False, redirect_stderr=False
    )
    with bar:
        stage = _Stage(bar)
        yield stage.tell


class _Stage:
    """The bar of what is counted now: one function may count several things, one after another."""

    def __init__(self, bar: Any) -> None:
        self._bar = bar
        self._task: Any = None
        self._done = self._total = 0

    def tell(self, done: int, total: int) -> None:
        """Draw so much of so much; how much there is may turn out to be more on the way."""
        ended = self._done == self._total != total
        if self._task is None or ended or done < self._done:
            if self._task is not None:
                self._bar.remove_task(self._task)
            self._task = self._bar.add_task("", total=total, completed=done, first=done, told=0.0)
        self._done, self._total = done, total
        (task,) = self._bar.tasks
        self._bar.update(self._task, completed=done, total=total, told=task.elapsed or 0.0)


def _time_left_column() -> Any:
    from rich.progress import ProgressColumn
    from rich.text import Text

    from seismass.campaign.progress import duration_text

    class TimeLeft(ProgressColumn):
        """The time left, at the rate so far."""

        def render(self, task: Task) -> Text:
            left = seconds_left(
                int(task.completed),
                int(task.total or 0),
                task.fields["first"],
                task.fields["told"],
                task.elapsed or 0.0,
            )
            return Text("" if left is None else f"{duration_text(left)} left")

    return TimeLeft()


def seconds_left(done: int, total: int, first: int, told: float, now: float) -> float | None:
    """Return the time left (s) at the rate so far; None before there is one. `first` runs were done when the work
    began; `told` is the time (s) of the last progress and `now` the present, from then.
    """
    if done <= first or told <= 0.0:
        return None
    return max(told * (total - first) / (done - first) - now, 0.0)
