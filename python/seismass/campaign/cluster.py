"""Executors of dask.distributed: worker processes of this machine, or a scheduler that runs."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager
from typing import Any, Final

from seismass.base.errors import InvalidOption, MissingPackage
from seismass.base.values import as_count, brief, refusal

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
            said = (str(error).strip() or type(error).__name__).splitlines()[0]
            raise refusal(InvalidOption, "scheduler", "campaign", "one that answers", f"{address}: {said}") from error
        yield client.get_executor(retries=RETRIES)
