"""Processes that were forked: Polars' threads do not exist in them, and what needs those would wait for ever.

Only a process in which Polars had started its threads leaves its children in that state. The kernel's own threads are
started again.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

_TASKS = Path("/proc/self/task")
_OF_THE_POOL = re.compile(r"polars-\d")
_started_before_fork = False
_is_lost = False


def require_polars(owner: str, instead: str = "") -> None:
    """Raise at once where Polars would wait for threads that a fork has left behind; the message says what needs it
    (`owner`) and what to use `instead`.
    """
    if _is_lost:
        from seismass.base.errors import SimulationError
        from seismass.base.values import refusal  # needs NumPy, which a watch for forks does not

        alternative = f", or {instead} taken instead" if instead else ""
        raise refusal(
            SimulationError,
            "process",
            owner,
            f"started by spawn or forkserver, as Polars' threads do not survive a fork{alternative}",
            "a forked one",
        )


def _polars_has_threads() -> bool:
    """Whether Polars has started its threads; where that cannot be seen, it may have."""
    try:
        names = [(task / "comm").read_text(errors="replace") for task in _TASKS.iterdir()]
    except OSError:
        return True
    return any(_OF_THE_POOL.match(name) for name in names)


def _before_fork() -> None:
    global _started_before_fork
    _started_before_fork = _polars_has_threads()


def _after_in_child() -> None:
    global _is_lost
    _is_lost = _is_lost or _started_before_fork


if hasattr(os, "register_at_fork"):
    os.register_at_fork(before=_before_fork, after_in_child=_after_in_child)
