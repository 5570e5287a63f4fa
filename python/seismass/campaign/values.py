"""Values of an axis in a campaign file: a number, a list, a range, or the distribution of a sample."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from seismass.base.distributions import beta, lognormal
from seismass.base.errors import InvalidCampaignFile, InvalidOption
from seismass.base.input_table import Table
from seismass.base.values import as_number, brief

MOST_VALUES: Final = 2**24
"""Most values of a range, which are in memory."""
_RANGE: Final = ("from", "to", "count", "spacing")


def axis_values(table: Table, key: str, *, sampled: bool) -> Any:
    """Return what a key of the table `grid` says: numbers, those of a range, or, where `sampled`, a distribution."""
    value = table.values[key]
    if isinstance(value, dict):
        return _of_table(table.table(key), sampled)
    if isinstance(value, list) and any(isinstance(item, dict) for item in value):
        return [_of_table(item, sampled) for item in table.tables(key)]
    return value


def _of_table(table: Table, sampled: bool) -> Any:
    if "distribution" not in table.values:
        return _range(table)
    if not sampled:
        table.refuse("distribution", "left out where there is no table `sample`", brief(table.values["distribution"]))
    return _distribution(table)


def _range(table: Table) -> Any:
    """Numbers from one to another, both included."""
    table.known(_RANGE)
    for key in _RANGE[:3]:
        table.needed(key)
    first, last = (table.number(key, 0.0) for key in _RANGE[:2])
    count = table.count("count", least=1)
    if count > MOST_VALUES:
        table.refuse("count", f"at most {MOST_VALUES}", str(count))
    spacing = table.choice("spacing", ("linear", "log"), "linear", requirement="linear or log")
    if spacing == "linear":
        return np.linspace(first, last, count)
    for key, end in (("from", first), ("to", last)):
        if not end > 0.0:
            table.refuse(key, "positive where the spacing is log", f"{end:g}")
    return np.geomspace(first, last, count)


def _distribution(table: Table) -> Any:
    """A frozen distribution, by the parameters that people state or by those of scipy.stats."""
    from scipy import stats  # slow to import

    name = table.text("distribution")
    numbers = {key: table.number(key, 0.0) for key in table.values if key != "distribution"}
    stated: dict[str, tuple[str, str]] = {
        "lognormal": ("median", "sigma"),
        "normal": ("mean", "deviation"),
        "beta": ("mean", "deviation"),
        "uniform": ("low", "high"),
    }
    if name in stated and set(numbers) == set(stated[name]):
        first, second = (numbers[key] for key in stated[name])
        try:
            if name == "lognormal":
                return lognormal(first, second)
            if name == "beta":
                return beta(first, second)
        except InvalidOption as error:
            table.refuse("distribution", "one that exists", str(error))
        if name == "normal":
            _positive(table, "deviation", second)
            return stats.norm(loc=first, scale=second)
        _positive(table, "high - low", second - first)
        return stats.uniform(loc=first, scale=second - first)
    found = getattr(stats, name, None)
    if not isinstance(found, stats.rv_continuous):
        words = ", ".join(f"{known} ({', '.join(keys)})" for known, keys in stated.items())
        table.refuse("distribution", f"{words}, or a continuous one of scipy.stats by its own parameters", brief(name))
    try:
        frozen = found(**numbers)
        usable = bool(np.isfinite(frozen.ppf(0.5)))
    except TypeError as error:
        table.refuse("distribution", f"given with the parameters of scipy.stats.{name}", str(error))
    if not usable:
        table.refuse("distribution", f"given with parameters that scipy.stats.{name} allows", brief(numbers))
    return frozen


def _positive(table: Table, what: str, value: float) -> None:
    if not value > 0.0:
        table.refuse(what, "positive", f"{as_number(value, what, table.file, InvalidCampaignFile):g}")
