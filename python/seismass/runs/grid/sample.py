"""Random samples for a grid: quasi-random or random points, and the values of each axis at them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.distributions import Distribution
from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.values import FloatArray, as_count, brief, is_one_of, refusal
from seismass.model.springs import SHAPE_FIELDS

SampleMethod: TypeAlias = Literal["sobol", "latin_hypercube", "random"]
"""Scrambled points of Sobol's sequence, a Latin hypercube, or independent points."""
METHODS: Final = get_args(SampleMethod)
PER_BLOCK: Final = ("mass_ratio", "mu", "mu_s", "mu_k")
"""Axes that may have a distribution of its own for each block."""
MOST_SAMPLES: Final = 2**26
"""Most samples, each with a value per axis in memory: half a gigabyte an axis."""

SAMPLED: Final = (
    "storeys",
    "period",
    "strength",
    "R",
    "yield_shear_over_weight",
    *SHAPE_FIELDS,
    "mass_ratio",
    "occupancy",
    "attached",
    "sliding",
    "mu",
    "mu_s",
    "mu_k",
    "scale",
)
"""Arguments of a grid that a sample may draw, beside its buildings and motions."""
_SMALLEST: Final = 2.0**-53
"""Distance of coordinates from 0 and 1, where distributions without bounds are infinite."""


def points(samples: int, dimensions: int, method: Any, seed: Any) -> FloatArray:
    """Return points of the unit cube, shape (samples, dimensions), the same for the same seed. Sobol's points are the
    first of the next power of two, so that powers of two are balanced.
    """
    if not is_one_of(method, METHODS):
        raise refusal(InvalidOption, "method", "sample", f"one of {', '.join(METHODS)}", brief(method))
    rng = np.random.default_rng(as_count(seed, "seed", "sample", InvalidOption))
    if dimensions == 0:
        return np.empty((samples, 0))
    if method == "random":
        return rng.random((samples, dimensions))
    from scipy.stats import qmc  # slow to import

    if method == "latin_hypercube":
        found: FloatArray = qmc.LatinHypercube(dimensions, rng=rng).random(samples)
        return found
    exponent = (samples - 1).bit_length()
    first: FloatArray = qmc.Sobol(dimensions, rng=rng).random_base2(exponent)[:samples]
    return first


@dataclass(frozen=True)
class _Drawn:
    """Values of an axis at coordinates of the unit cube, of which it takes some."""

    dimensions: int
    at: Callable[[FloatArray], Any]


def drawn_columns(
    axes: dict[str, Any], samples: Any, method: Any, seed: Any, motions: Any
) -> tuple[int, dict[str, Any]]:
    """Return the number of samples and the values of each axis at them, as the arguments of a `Grid`; `axes` has
    constants, distributions and lists of values by the name of the argument.
    """
    number = as_count(samples, "samples", "sample", InvalidOption, least=1)
    if number > MOST_SAMPLES:
        raise refusal(InvalidOption, "samples", "sample", f"at most {MOST_SAMPLES}", str(number))
    drawn = {name: _axis(name, value) for name, value in axes.items()}
    if _length(axes.get("storeys")) > 1 and _length(axes.get("period")) == _length(axes.get("storeys")):
        both = [np.asarray(axes[name]) for name in ("storeys", "period")]
        del drawn["period"]
        drawn["storeys"] = _Drawn(1, lambda u: tuple(values[_chosen(u, len(values))] for values in both))
    if motions is not None:
        count = as_count(motions, "motions", "sample", InvalidOption, least=1)
        drawn["motion"] = _Drawn(1, lambda u: _chosen(u, count) + 1)
    at = points(number, sum(item.dimensions for item in drawn.values()), method, seed)
    columns: dict[str, Any] = {}
    first = 0
    for name, item in drawn.items():
        columns[name] = item.at(at[:, first : first + item.dimensions])
        first += item.dimensions
    if isinstance(columns.get("storeys"), tuple):
        columns["storeys"], columns["period"] = columns["storeys"]
    return number, columns


def _length(value: Any) -> int:
    """Number of values of a list of numbers, 0 of anything else."""
    return len(value) if isinstance(value, Sequence | np.ndarray) and np.ndim(value) == 1 else 0


def _axis(name: str, value: Any) -> _Drawn:
    if isinstance(value, Distribution):
        return _Drawn(1, lambda u: _quantiles(value, u[:, 0], name))
    if isinstance(value, Sequence) and any(isinstance(item, Distribution) for item in value):
        return _per_block(name, value)
    try:
        values = np.asarray(value)
    except (TypeError, ValueError):
        values = np.empty(0, dtype=object)
    if values.dtype.kind not in "iuf" or values.ndim > 2 or not values.size:
        raise refusal(InvalidScene, name, "sample", "a number, a distribution or a list of values", brief(value))
    if values.ndim == 0 or len(values) == 1:
        return _Drawn(0, lambda _: value)
    return _Drawn(1, lambda u: values[_chosen(u, len(values))])


def _per_block(name: str, value: Sequence[Any]) -> _Drawn:
    """One column per block, each drawn independently; numbers stay as they are."""
    if name not in PER_BLOCK:
        requirement = "one distribution (lists of them are for what blocks have)"
        raise refusal(InvalidScene, name, "sample", requirement, brief(value))
    items = [_axis(name, item) for item in value]

    def at(u: FloatArray) -> FloatArray:
        columns, first = [], 0
        for item in items:
            columns.append(np.broadcast_to(item.at(u[:, first : first + item.dimensions]), len(u)))
            first += item.dimensions
        return np.stack(columns, axis=1)

    return _Drawn(sum(item.dimensions for item in items), at)


def _chosen(u: FloatArray, values: int) -> Any:
    """Index of the value at a coordinate, each equally likely."""
    return np.minimum((u[:, 0] * values).astype(np.int64), values - 1)


def _quantiles(distribution: Distribution, u: FloatArray, name: str) -> FloatArray:
    values = np.asarray(distribution.ppf(np.clip(u, _SMALLEST, 1.0 - _SMALLEST)), dtype=np.float64)
    if values.shape != u.shape:
        raise refusal(InvalidScene, name, "sample", "a distribution of one number", brief(distribution))
    return values


def sampled_arguments(
    building: Any, axes: dict[str, Any], mu_k_over_mu_s: Any, *, samples: Any, method: Any, seed: Any, motions: Any
) -> dict[str, Any]:
    """Return the arguments of a `Grid` of so many scenes from those of `Grid.sample`."""
    for name in axes:
        if name not in SAMPLED:
            raise TypeError(f"Grid.sample() got an unexpected keyword argument {name!r}")
    drawn = {name: value for name, value in axes.items() if value is not None}
    if isinstance(building, Sequence) and len(building) > 1:
        drawn["building_index"] = np.arange(1, len(building) + 1)
    if mu_k_over_mu_s is not None:
        if "mu_k" in drawn:
            raise refusal(InvalidScene, "mu_k_over_mu_s", "sample", "left out where mu_k is given", "both")
        drawn["mu_k_over_mu_s"] = mu_k_over_mu_s
    number, columns = drawn_columns(drawn, samples, method, seed, motions)
    ratio = columns.pop("mu_k_over_mu_s", None)
    if ratio is not None:
        static = "mu_s" if "mu_s" in columns else "mu"
        columns["mu_s"] = columns.pop(static, None)
        if columns["mu_s"] is None:
            raise refusal(InvalidScene, "mu", "grid", "given, or mu_s", "neither")
        columns["mu_k"] = _times(ratio, columns["mu_s"])
    if all(np.ndim(values) == 0 or len(values) != number for values in columns.values()):
        # Nothing was drawn: as many equal scenes as there are samples.
        columns["scale"] = np.full(number, columns.get("scale", 1.0))
    return columns


def _times(ratio: Any, static: Any) -> FloatArray:
    """The product of two columns, of which one may have a value per block."""
    left, right = np.asarray(ratio, dtype=np.float64), np.asarray(static, dtype=np.float64)
    if left.ndim > 1:
        requirement = "a number, a distribution or a list of values"
        raise refusal(InvalidScene, "mu_k_over_mu_s", "sample", requirement, f"an array of shape {left.shape}")
    if left.ndim == 1 and right.ndim == 2:
        left = left[:, None]
    product: FloatArray = left * right
    return product
