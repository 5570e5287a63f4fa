"""The command line as such: a subcommand, what a terminal shows, progress, and how a command gives its answer."""

from __future__ import annotations

import argparse
import os
import re
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeAlias

from seismass.base.files import write_file
from seismass.commands.options import check_outputs, left_out, warn_left_out
from seismass.commands.parser import ANY_COMMAND, HelpText, columns
from seismass.media.text_table import fitted_blocks, is_row

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.progress import Task

    from seismass.motions.records import Pairs, Suite


@dataclass(frozen=True, kw_only=True)
class Command:
    """One subcommand: what it answers, examples without the name of the program, a function that adds its options, one
    that runs and returns an exit code, and exit codes of its own beside `ANY_COMMAND`.
    """

    description: str
    examples: str
    options: Callable[[argparse.ArgumentParser], None]
    run: Callable[[argparse.Namespace], int]
    note: str = ""
    codes: Mapping[int, str] = field(default_factory=dict)

    @property
    def epilog(self) -> str:
        """Examples, note and exit codes."""
        examples = "\n".join(f"  seismass {line}" for line in self.examples.strip().splitlines())
        codes = ", ".join(f"{code} {meaning}" for code, meaning in sorted({**ANY_COMMAND, **self.codes}.items()))
        parts = (f"examples:\n{examples}", self.note.strip("\n"), f"exit codes: {codes}")
        return "\n\n".join(part for part in parts if part)

    def add(self, subparsers: Any, name: str, help: str) -> None:
        """Add the parser to those of the `seismass` command, with the line that lists it."""
        parser = subparsers.add_parser(
            name, help=help, description=self.description, epilog=self.epilog, formatter_class=HelpText
        )
        parser.register("type", Path, _path)
        self.options(parser)

        def timed(args: argparse.Namespace) -> int:
            """Run with outputs checked and the clock started, which `seconds` reads."""
            check_outputs(args, parser._actions, name)
            args.started = time.perf_counter()
            return self.run(args)

        parser.set_defaults(run=timed)


def _path(text: str) -> Path:
    """Read an argument of type Path; Path("") would be the current folder."""
    if not text:
        raise argparse.ArgumentTypeError("must be a path; got ''")
    return Path(text)


def seconds(args: argparse.Namespace) -> str:
    """Return how long the command has taken, as it is printed."""
    return f"{time.perf_counter() - args.started:.1f} s"


def shows_bold() -> bool:
    """Whether standard output is a terminal that shows bold letters, and they are wanted (https://no-color.org)."""
    wanted = not os.environ.get("NO_COLOR") and os.environ.get("TERM") not in ("dumb", "unknown")
    return sys.stdout.isatty() and wanted


def show(text: str, answer: str = "") -> None:
    """Print lines; those whose beginning matches the pattern `answer` are the answer and stand out."""
    width = columns()
    if width is None:
        print(text)
        return
    pattern = re.compile(answer) if answer and shows_bold() else None
    for block, lines in fitted_blocks(text, width):
        whole = pattern is not None and not is_row(block[0]) and pattern.match(block[0])
        for line in lines:
            bold = whole or (pattern is not None and pattern.match(line))
            if bold:
                _print_bold(line)
            else:
                print(line)


def _print_bold(line: str) -> None:
    from rich.console import Console
    from rich.text import Text

    Console(markup=False, highlight=False, emoji=False).print(Text(line, "bold"), soft_wrap=True)


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

    from seismass.studies.campaign.engine import duration_text

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


def seconds_left(done: int, total: int, first: int, last_time: float, now: float) -> float | None:
    """Return the time left (s) at the rate so far; None before there is one. `first` runs were done when the work
    began; `told` is the time (s) of the last progress and `now` the present, from then.
    """
    if done <= first or last_time <= 0.0:
        return None
    return max(last_time * (total - first) / (done - first) - now, 0.0)


class Answer(Protocol):
    """A result as commands print and write it; every `Result` is one."""

    @property
    def text(self) -> str:
        """What is printed."""

    def to_json(self) -> str:
        """Return what is printed for another program."""

    def write(self, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
        """Write tables, and figures if asked for, and return the files."""


def give_answer(
    args: argparse.Namespace, result: Answer, suite: Suite | Pairs, *, head: str = "", indent: int = 0, answer: str = ""
) -> None:
    """Write the files of an answer and print it below `head`. What its motions leave out is printed below the text,
    indented by `indent`, or on standard error beside JSON.
    """
    print_answer(args, result, suite, write_answer(args, result), head=head, indent=indent, answer=answer)


def write_answer(args: argparse.Namespace, result: Answer) -> list[Path]:
    """Write the files of an answer where the options ask for them, and return them."""
    return [] if args.out is None else result.write(args.out, figures=not args.no_figures)


def print_answer(
    args: argparse.Namespace,
    result: Answer,
    suite: Suite | Pairs,
    files: Sequence[Path],
    *,
    head: str = "",
    indent: int = 0,
    answer: str = "",
) -> None:
    """Print an answer whose files are written; see `give_answer`."""
    from seismass.media.result import PAGE

    if args.json:
        warn_left_out(suite)
        print(result.to_json())
        return
    show(f"{head}{result.text}", answer)
    for line in left_out(suite):
        show(" " * indent + line)
    page = f", the page is {args.out / PAGE}" if any(file.name == PAGE for file in files) else ""
    written = f"{len(files)} files in {args.out}{page}, " if files else ""
    show(f"\n{written}{seconds(args)}")


def write_figure(figure: Figure, path: Path) -> None:
    """Write one figure, PNG or SVG by the suffix of its file."""
    from seismass.media.svg import figure_content

    kind: Literal["png", "svg"] = "svg" if path.suffix.lower() == ".svg" else "png"
    write_file(path, figure_content(figure, kind))
