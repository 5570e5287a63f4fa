"""Solving the missing parts: by the threads of this process, or as tasks of an executor."""

from __future__ import annotations

import io
import json
import math
import os
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np
import polars as pl

from seismass.base.errors import InvalidOption, MissingPackage, SeismassError, SimulationError
from seismass.base.files import PREFIX, Directory, remove_left_behind, write_file
from seismass.base.fork_check import require_polars
from seismass.base.stored_results import checked_content, damage, metadata_of, read_checked
from seismass.base.values import as_count, brief, printable, refusal
from seismass.base.views import Card
from seismass.studies.campaign.campaign import CampaignRuns
from seismass.studies.campaign.manifest import (
    AXES,
    MANIFEST,
    MOTIONS,
    PARTS,
    campaign_in,
    check_same,
    manifest_of,
    part_path,
    parts_present,
    read_manifest,
    write_inputs,
)

RETRIES: Final = 3
"""How often a part is given again after an error of a worker; a lost worker's parts are given again by dask itself."""


@contextmanager
def dask_executor(*, workers: int | None = None, scheduler: str | None = None) -> Iterator[Executor]:
    """Give an executor of dask.distributed, of so many single-thread `workers` on this machine or of the `scheduler` at
    an address, and end what was started for it.
    """
    count = None if workers is None else as_count(workers, "workers", "campaign", InvalidOption, least=1)
    if scheduler is not None and not isinstance(scheduler, str):
        raise refusal(InvalidOption, "scheduler", "campaign", "an address such as tcp://host:8786", brief(scheduler))
    try:
        from distributed import Client, LocalCluster
    except ImportError as error:
        raise MissingPackage(
            'package dask.distributed of campaign must be installed (pip install "seismass[cluster]"); got none'
        ) from error
    with ExitStack() as stack:
        address: Any = scheduler
        if count is not None:
            address = stack.enter_context(
                LocalCluster(n_workers=count, threads_per_worker=1, processes=True, dashboard_address=None)
            )
        try:
            client = stack.enter_context(Client(address))
        except (OSError, ValueError) as error:
            text = (str(error).strip() or type(error).__name__).splitlines()[0]
            raise refusal(InvalidOption, "scheduler", "campaign", "one that answers", f"{address}: {text}") from error
        yield client.get_executor(retries=RETRIES)


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


def part_metadata(sha256: str, part: int) -> dict[str, str]:
    """Return the metadata of a part: the digest of its inputs and its number."""
    return {"campaign": sha256, "part": str(part)}


def part_problem(folder: Path, sha256: str, part: int) -> str | None:
    """Return what is wrong with a part by its bytes and what they say of themselves; None where nothing is."""
    path = part_path(folder, part)
    problem = damage(path)
    if problem is not None:
        return problem
    stated = metadata_of(path)
    if stated.get("campaign") != sha256:
        return "is of other inputs"
    return None if stated.get("part") == str(part) else "is of other runs"


def check_parts(folder: Path, sha256: str, parts: Iterable[int]) -> None:
    """Refuse parts that are damaged, are not files, or belong to other inputs or other runs."""
    problems = [(part, problem) for part in parts if (problem := part_problem(folder, sha256, part)) is not None]
    if problems:
        part, problem = problems[0]
        more = f", and {len(problems) - 1} more that are not as they were written" if len(problems) > 1 else ""
        requirement = "whole and of this campaign (remove a part that is not, and the same call solves it again)"
        got = f"{part_path(folder, part).name}, which {problem}{more}"
        raise refusal(InvalidOption, f"parts of {folder}", "campaign", requirement, got)


def rows_and_problem(folder: Path, campaign: CampaignRuns, part: int) -> tuple[int | None, str | None]:
    """Return the number of rows of a part, and what is wrong with it."""
    problem = part_problem(folder, campaign.sha256, part)
    if problem is not None:
        return None, problem
    try:
        frame = read_checked(part_path(folder, part))
    except (pl.exceptions.PolarsError, OSError) as error:
        return None, f"cannot be read: {error}"
    runs = campaign.runs_of(part)
    if frame.height != len(runs) or frame.columns != list(campaign.columns):
        return frame.height, f"has not the {len(runs)} rows of its runs"
    numbers = np.arange(runs.start - 1, runs.stop - 1)
    scene, motion = campaign.grid._scene_and_motion(numbers, len(campaign.motions))
    same = (frame["scene"].to_numpy() == scene + 1).all() and (frame["motion"].to_numpy() == motion + 1).all()
    return frame.height, None if same else "is of other runs"


_lock = threading.Lock()
_last: tuple[str, str, CampaignRuns] | None = None


class Done(NamedTuple):
    """What a task gives back: the number of its part and its runs."""

    part: int
    runs: int


def solve_part(folder: str, sha256: str, part: int, threads: int | None) -> Done:
    """Solve a part (from 1) and write it, as a task. A worker whose version, instruction set or folder does not agree
    with the digest `sha256` of the inputs is refused.
    """
    require_polars("campaign")
    campaign = _campaign(folder, sha256)
    frame = campaign.solve(part, threads=threads)
    write_part(frame, Path(folder), sha256, part)
    return Done(part, frame.height)


def write_part(frame: pl.DataFrame, folder: Path, sha256: str, part: int) -> None:
    """Write the rows of a part under its name, whole and on the disk, without listing the folder of many parts."""
    path = part_path(folder, part)
    with Directory(path.parent) as parts:
        write_file(path.name, checked_content(frame, part_metadata(sha256, part)), durable=True, folder=parts)


def _campaign(folder: str, sha256: str) -> CampaignRuns:
    """The campaign of a folder, read by this process once."""
    global _last
    with _lock:
        if _last is None or _last[:2] != (folder, sha256):
            campaign = campaign_in(Path(folder), CampaignRuns)
            if campaign.sha256 != sha256:
                requirement = "that of the one who gives the work, under the same name on each machine"
                raise refusal(InvalidOption, f"folder {folder}", "worker", requirement, "one of other inputs")
            _last = (folder, sha256, campaign)
        return _last[2]


IN_FLIGHT: Final = 1024
"""Most tasks that an executor is given at once: enough for as many workers, and few to take back."""
SECONDS_BETWEEN_REPORTS: Final = 0.2
"""Least time between two calls of a report (s)."""


def run_campaign(
    campaign: CampaignRuns,
    folder: Path,
    *,
    executor: Any = None,
    workers: int | None = None,
    scheduler: str | None = None,
    shard: Any = None,
    threads: int | None = None,
    progress: Any = None,
) -> None:
    """Solve what is missing in the folder of a campaign; see `Campaign.run`. Parts that are there are checked first;
    files of killed workers are removed at the end, or when the folder is next prepared.
    """
    options = {"executor": executor, "workers": workers, "scheduler": scheduler}
    names = [name for name, value in options.items() if value is not None]
    if len(names) > 1:
        raise refusal(InvalidOption, names[1], "campaign", f"left out where {names[0]} is given", "both")
    if executor is not None and not isinstance(executor, Executor):
        raise refusal(InvalidOption, "executor", "campaign", "a concurrent.futures.Executor", brief(executor))
    if progress is not None and not callable(progress):
        raise refusal(InvalidOption, "progress", "campaign", "a callable of a CampaignProgress", brief(progress))
    first, step = _shard(shard)
    parts = range(first, campaign.parts + 1, step)
    there = parts_present(folder, campaign.parts)
    check_parts(folder, campaign.sha256, sorted(part for part in there.files | there.others if part in parts))
    present = there.files
    clock = _Clock(campaign, parts, present, progress)
    missing = (part for part in parts if part not in present)
    if clock.done == len(parts):
        clock.report(force=True)
        return
    if names:
        pool_context: AbstractContextManager[Executor] = (
            nullcontext(executor) if executor is not None else dask_executor(workers=workers, scheduler=scheduler)
        )
        with pool_context as pool:
            _by_executor(campaign, folder, missing, pool, 1 if threads is None else threads, clock)
    else:
        _by_threads(campaign, folder, missing, threads, clock)
    with Directory(folder / PARTS) as place:
        remove_left_behind(place)


def _shard(shard: Any) -> tuple[int, int]:
    """The first part and the step of a shard (i, n)."""
    if shard is None:
        return 1, 1
    requirement = "(i, n): job i of n, counted from 1"
    if not isinstance(shard, tuple | list) or len(shard) != 2:
        raise refusal(InvalidOption, "shard", "campaign", requirement, brief(shard))
    first, step = (as_count(value, "shard", "campaign", InvalidOption, least=1) for value in shard)
    if first > step:
        raise refusal(InvalidOption, "shard", "campaign", requirement, brief(shard))
    return first, step


class _Clock:
    """Counts parts and runs, and reports them now and then."""

    def __init__(self, campaign: CampaignRuns, parts: range, present: set[int], report: Report | None) -> None:
        here = [part for part in parts if part in present]
        self._campaign, self._parts, self._report = campaign, parts, report
        self.done = len(here)
        self._before = self._runs(here)
        self._solved = self._before
        self._total = self._all_runs()
        self._started = time.monotonic()
        self._last = -math.inf

    def _runs(self, parts: list[int]) -> int:
        return sum(len(self._campaign.runs_of(part)) for part in parts)

    def _all_runs(self) -> int:
        """Runs of all parts: only the last part of a campaign may be smaller."""
        if not self._parts:
            return 0
        return (len(self._parts) - 1) * self._campaign.part_runs + len(self._campaign.runs_of(self._parts[-1]))

    def add(self, part: int) -> None:
        """Count a part that is in the folder now."""
        self.done += 1
        self._solved += len(self._campaign.runs_of(part))
        self.report(force=self.done == len(self._parts))

    def report(self, *, of_part: int = 0, force: bool = False) -> None:
        """Report, `of_part` runs of the part in hand included."""
        now = time.monotonic() - self._started
        if self._report is None or (not force and now - self._last < SECONDS_BETWEEN_REPORTS):
            return
        self._last = now
        runs = min(self._solved + of_part, self._total)
        self._report(CampaignProgress(self.done, len(self._parts), runs, self._total, self._before, now))


def _by_threads(
    campaign: CampaignRuns, folder: Path, missing: Iterator[int], threads: int | None, clock: _Clock
) -> None:
    """Solve part after part; a part is written while the next one is solved."""
    writing: tuple[int, Future[None]] | None = None
    with ThreadPoolExecutor(1) as writer:
        try:
            for part in missing:
                held = 0 if writing is None else len(campaign.runs_of(writing[0]))
                frame = campaign.solve(part, threads=threads, progress=_of_part(clock, held))
                if writing is not None:
                    writing[1].result()
                    clock.add(writing[0])
                writing = part, writer.submit(write_part, frame, folder, campaign.sha256, part)
        finally:
            # Also after Ctrl-C: what is solved is written.
            if writing is not None:
                writing[1].result()
                clock.add(writing[0])


def _of_part(clock: _Clock, held: int) -> Any:
    def progress(done: int, _: int) -> None:
        clock.report(of_part=held + done)

    return progress


def _by_executor(
    campaign: CampaignRuns, folder: Path, missing: Iterator[int], executor: Executor, threads: int, clock: _Clock
) -> None:
    """Give parts to an executor, a limited number at once; results come back as numbers alone."""
    place = str(folder.absolute())
    running: set[Future[Done]] = set()
    try:
        while True:
            for part in islice(missing, IN_FLIGHT - len(running)):
                running.add(executor.submit(solve_part, place, campaign.sha256, part, threads))
            if not running:
                return
            done, running = wait(running, timeout=1.0, return_when=FIRST_COMPLETED)
            for future in done:
                clock.add(future.result().part)
            clock.report()
    except (SeismassError, OSError):
        raise
    except Exception as error:
        raise _lost(folder, error) from error
    finally:
        for future in running:
            future.cancel()


def _lost(folder: Path, error: Exception) -> SimulationError:
    text = str(error).strip().splitlines()
    reason = f"{type(error).__name__}{': ' + text[0] if text else ''}"
    requirement = f"able to keep its workers (the parts in {folder} stay, and the same call goes on)"
    failure = refusal(SimulationError, "executor", "campaign", requirement, reason)
    assert isinstance(failure, SimulationError)
    return failure


_OURS: Final = (MANIFEST, AXES, MOTIONS, PARTS)


def prepare(campaign: CampaignRuns, folder: Path) -> None:
    """Make the folder of a campaign ready for its parts and remove what killed processes left in it. A folder of other
    inputs, another version or another instruction set, or with other files, is refused.
    """
    absolute = str(folder.absolute())
    if printable(absolute) != absolute:
        raise refusal(InvalidOption, "folder", "campaign", "in UTF-8, as Polars reads no other", brief(absolute))
    if folder.exists() and not folder.is_dir():
        raise refusal(InvalidOption, "folder", "campaign", "a folder", f"the file {folder}")
    wanted = manifest_of(campaign)
    if not (folder / MANIFEST).is_file():
        _make(campaign, folder, wanted)
    # Read again, as another process may have made the folder at the same time.
    check_same(read_manifest(folder), wanted, folder)
    write_inputs(campaign, folder)
    _make_parts(folder)
    for path in (folder, folder / PARTS):
        if not os.access(path, os.W_OK | os.X_OK):  # the system's error comes before anything is solved
            raise PermissionError(13, os.strerror(13), str(path))
        with Directory(path) as place:
            remove_left_behind(place)


def _make(campaign: CampaignRuns, folder: Path, manifest: dict[str, object]) -> None:
    if folder.is_dir():
        others = [entry.name for entry in folder.iterdir() if entry.name not in _OURS and PREFIX not in entry.name]
        if others:
            requirement = "a new or empty one, or one of a campaign"
            got = f"{folder} with {printable(sorted(others)[0])} in it"
            raise refusal(InvalidOption, "folder", "campaign", requirement, got)
        there = parts_present(folder)
        # The manifest is looked for after the parts, as another process may begin the same campaign now.
        if (there.files or there.others) and not (folder / MANIFEST).is_file():
            requirement = f"one whose parts have a {MANIFEST} (remove the parts, or bring it back)"
            got = f"{folder} with {len(there.files) + len(there.others)} parts of unknown inputs"
            raise refusal(InvalidOption, "folder", "campaign", requirement, got)
    folder.mkdir(parents=True, exist_ok=True)
    _make_parts(folder)
    write_inputs(campaign, folder)
    text = json.dumps(manifest, indent=1, allow_nan=False) + "\n"
    write_file(folder / MANIFEST, text, durable=True)


def _make_parts(folder: Path) -> None:
    """Make the folder of parts; a link in its place would lead the parts elsewhere."""
    parts = folder / PARTS
    if parts.is_symlink() or (parts.exists() and not parts.is_dir()):
        got = f"{parts}, {'a link' if parts.is_symlink() else 'a file'}"
        raise refusal(InvalidOption, PARTS, "campaign", "a folder", got)
    parts.mkdir(exist_ok=True)


SAMPLE: Final = 256
"""Runs solved at the beginning, in the middle and at the end of the campaign."""


class Estimate(NamedTuple):
    """Estimate for all runs: seconds by the threads of this process, and bytes of the compressed parts."""

    seconds: float
    bytes: float


def estimated(campaign: CampaignRuns, *, threads: int | None = None) -> Estimate:
    """Return the estimate for all runs of a campaign, from three stretches of it."""
    size = min(SAMPLE, campaign.part_runs)
    solved, spent, written = 0, 0.0, 0
    for part in sorted({1, (campaign.parts + 1) // 2, campaign.parts}):
        runs = campaign.runs_of(part)[:size]
        began = time.perf_counter()
        frame = campaign.solve_runs(runs, threads=threads)
        spent += time.perf_counter() - began
        solved += len(runs)
        buffer = io.BytesIO()
        frame.write_parquet(buffer, compression="zstd")
        written += buffer.tell()
    return Estimate(campaign.total * spent / solved, campaign.total * written / solved)
