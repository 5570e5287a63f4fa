"""Solving the missing parts: by the threads of this process, or as tasks of an executor."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ThreadPoolExecutor, wait
from contextlib import AbstractContextManager, nullcontext
from itertools import islice
from pathlib import Path
from typing import Any, Final

from seismass.base.errors import InvalidOption, SeismassError, SimulationError
from seismass.base.temporary import remove_left_behind
from seismass.base.values import as_count, brief, refusal
from seismass.campaign.campaign import CampaignRuns
from seismass.campaign.cluster import dask_executor
from seismass.campaign.places import PARTS, parts_present
from seismass.campaign.progress import CampaignProgress, Report
from seismass.campaign.verify import check_parts
from seismass.campaign.work import Done, solve_part, write_part

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
    given = {"executor": executor, "workers": workers, "scheduler": scheduler}
    chosen = [name for name, value in given.items() if value is not None]
    if len(chosen) > 1:
        raise refusal(InvalidOption, chosen[1], "campaign", f"left out where {chosen[0]} is given", "both")
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
    if chosen:
        given_one: AbstractContextManager[Executor] = (
            nullcontext(executor) if executor is not None else dask_executor(workers=workers, scheduler=scheduler)
        )
        with given_one as found:
            _by_executor(campaign, folder, missing, found, 1 if threads is None else threads, clock)
    else:
        _by_threads(campaign, folder, missing, threads, clock)
    remove_left_behind(folder / PARTS)


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
    except BrokenExecutor as error:
        raise _lost(folder, error) from error
    except Exception as error:
        raise _lost(folder, error) from error
    finally:
        for future in running:
            future.cancel()


def _lost(folder: Path, error: Exception) -> SimulationError:
    said = str(error).strip().splitlines()
    reason = f"{type(error).__name__}{': ' + said[0] if said else ''}"
    requirement = f"able to keep its workers (the parts in {folder} stay, and the same call goes on)"
    failure = refusal(SimulationError, "executor", "campaign", requirement, reason)
    assert isinstance(failure, SimulationError)
    return failure
