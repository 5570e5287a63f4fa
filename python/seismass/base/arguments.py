"""Arguments that many functions have, checked: progress, threads, those of a bootstrap, and one of some words."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple, TypeAlias

from seismass import _kernel
from seismass.base.errors import InvalidOption, SeismassError, did_you_mean
from seismass.base.values import as_count, as_number, brief, refusal

ProgressLike: TypeAlias = Callable[[int, int], object] | None
"""What is called with (done, in all); None: nothing is."""


def as_progress(value: Any, owner: str) -> ProgressLike:
    """Return what is called with (done, in all), or None."""
    if value is not None and not callable(value):
        raise refusal(InvalidOption, "progress", owner, "a callable of two numbers", brief(value))
    checked: ProgressLike = value
    return checked


class Progress:
    """Progress of a whole, made of that of its parts, one after the other."""

    def __init__(self, call: ProgressLike, total: int, owner: str) -> None:
        self._call, self._total, self.done = as_progress(call, owner), total, 0

    def part(self, count: int) -> ProgressLike:
        """Return the progress of the next `count` of the whole."""
        first, self.done = self.done, self.done + count
        call, total = self._call, self._total
        return None if call is None else lambda done, _: call(min(first + done, total), total)

    def tell(self, count: int = 1) -> None:
        """Tell that the next `count` are done."""
        self.done += count
        if self._call is not None:
            self._call(self.done, self._total)


def as_threads(value: Any, owner: str) -> int | None:
    """Return a number of threads; None: all cores."""
    count = None if value is None else as_count(value, "threads", owner, InvalidOption, least=1)
    if count is not None and count > _kernel.MAX_THREADS:
        raise refusal(InvalidOption, "threads", owner, f"between 1 and {_kernel.MAX_THREADS}", str(count))
    return count


class Bootstrap(NamedTuple):
    """Probability of intervals, number of resamples and seed."""

    confidence: float
    resamples: int
    seed: int


def as_bootstrap(confidence: Any, resamples: Any, seed: Any, owner: str, *, least: int = 1) -> Bootstrap:
    """Return checked options of a bootstrap."""
    share = as_number(confidence, "confidence", owner, InvalidOption)
    if not 0.0 < share < 1.0:
        raise refusal(InvalidOption, "confidence", owner, "above 0 and below 1", f"{share:g}")
    count = as_count(resamples, "resamples", owner, InvalidOption, least=least)
    return Bootstrap(share, count, as_count(seed, "seed", owner, InvalidOption))


def as_share(value: Any, parameter: str, owner: str) -> float:
    """Return a number from 0 to 1."""
    share = as_number(value, parameter, owner, InvalidOption)
    if not 0.0 <= share <= 1.0:
        raise refusal(InvalidOption, parameter, owner, "between 0 and 1", f"{share:g}")
    return share


def is_one_of(value: Any, words: Iterable[str]) -> bool:
    """Return whether a value is one of these words; False for values that are not text, such as an array."""
    return isinstance(value, str) and value in words


def as_word(
    value: Any, words: Iterable[str], parameter: str, owner: str, kind: type[SeismassError] = InvalidOption
) -> Any:
    """Return one of some words; another value is refused, with the word that is like it as a hint."""
    if is_one_of(value, words):
        return value
    known = list(words)
    requirement = " or ".join(known) if len(known) == 2 else f"one of {', '.join(known)}"
    raise refusal(kind, parameter, owner, requirement + did_you_mean(value, known), brief(value))


def known_id(value: Any, known: Sequence[str], owner: str, *, hints: int = 1) -> str:
    """Return the id of a row of a table, in any case; an unknown one is refused, with the closest ids as hints."""
    wanted = str(value).strip().lower()
    if wanted not in known:
        hint = did_you_mean(wanted, known, hints, cutoff=0.5)
        raise refusal(InvalidOption, "id", owner, f"one of {', '.join(known)}{hint}", brief(value))
    return wanted
