"""Samples of distributions and designs of a grid."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.arguments import as_share, as_word
from seismass.base.distributions import Distribution
from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.values import FloatArray, as_array, as_count, brief, refusal
from seismass.design.modes import Combination, checked_combination, response_spectrum_analysis
from seismass.model.building import DEFAULT_DAMPING, Building
from seismass.model.springs import SHAPE_FIELDS
from seismass.motions.spectra import TargetSpectrum
from seismass.motions.spectra.target import target_of_parameters

SampleMethod: TypeAlias = Literal["sobol", "latin_hypercube", "random"]
"""Scrambled points of Sobol's sequence, a Latin hypercube, or independent points."""
METHODS: Final = get_args(SampleMethod)
PER_BLOCK: Final = ("mass_ratio", "occupancy", "mu", "mu_s", "mu_k")
"""Axes that may have a distribution of its own for each block."""
OF_GOODS: Final = (*PER_BLOCK, "attached", "sliding", "mu_k_over_mu_s")
"""Axes that a nested sample draws for each building several times."""
MOST_SAMPLES: Final = 2**26
"""Most samples, each with a value per axis in memory: half a gigabyte an axis."""

CHANGING: Final = ("period", "strength", "R", "yield_shear_over_weight", *SHAPE_FIELDS)
"""Columns that change a building as it is given, beside the live load that is attached to it."""
LOADS: Final = ("mass_ratio", "occupancy", "attached", "sliding")
"""Columns of the live load, and of its shares."""
SAMPLED: Final = ("storeys", *CHANGING, *LOADS, "mu", "mu_s", "mu_k", "scale")
"""Arguments of a grid that a sample may draw, beside its buildings and motions."""
_SMALLEST: Final = 2.0**-53
"""Distance of coordinates from 0 and 1, where distributions without bounds are infinite."""


def points(samples: int, dimensions: int, method: Any, seed: Any) -> FloatArray:
    """Return points of the unit cube, shape (samples, dimensions), the same for the same seed. Sobol's points are the
    first of the next power of two, so that powers of two are balanced.
    """
    as_word(method, METHODS, "method", "sample")
    stream = seed if isinstance(seed, tuple) else as_count(seed, "seed", "sample", InvalidOption)
    rng = np.random.default_rng(stream)
    if dimensions == 0:
        return np.empty((samples, 0))
    if method == "random":
        return rng.random((samples, dimensions))
    from scipy.stats import qmc  # slow to import

    if method == "latin_hypercube":
        values: FloatArray = qmc.LatinHypercube(dimensions, rng=rng).random(samples)
        return values
    exponent = (samples - 1).bit_length()
    first: FloatArray = qmc.Sobol(dimensions, rng=rng).random_base2(exponent)[:samples]
    return first


@dataclass(frozen=True)
class _Drawn:
    """Values of an axis at coordinates of the unit cube, of which it takes some."""

    dimensions: int
    values_at: Callable[[FloatArray], Any]


def drawn_columns(
    axes: dict[str, Any], samples: Any, method: Any, seed: Any, motions: Any, correlation: Any = 0.0
) -> tuple[int, dict[str, Any]]:
    """Return the number of samples and the values of each axis at them, as the arguments of a `Grid`; `axes` has
    constants, distributions and lists of values by the name of the argument.
    """
    rho = as_share(correlation, "correlation", "sample")
    drawn = {name: _axis(name, value, rho) for name, value in axes.items()}
    if _length(axes.get("storeys")) > 1 and _length(axes.get("period")) == _length(axes.get("storeys")):
        both = [np.asarray(axes[name]) for name in ("storeys", "period")]
        del drawn["period"]
        drawn["storeys"] = _Drawn(1, lambda u: tuple(values[_index_of(u, len(values))] for values in both))
    if isinstance(samples, tuple):
        return _nested(drawn, samples, method, seed, motions)
    number = _number_of_samples(samples)
    if motions is not None:
        count = as_count(motions, "motions", "sample", InvalidOption, least=1)
        drawn["motion"] = _Drawn(1, lambda u: _index_of(u, count) + 1)
    columns = _columns(drawn, number, method, seed)
    if isinstance(columns.get("storeys"), tuple):
        columns["storeys"], columns["period"] = columns["storeys"]
    return number, columns


def _number_of_samples(samples: Any) -> int:
    number = as_count(samples, "samples", "sample", InvalidOption, least=1)
    if number > MOST_SAMPLES:
        raise refusal(InvalidOption, "samples", "sample", f"at most {MOST_SAMPLES}", str(number))
    return number


def _columns(
    drawn: dict[str, _Drawn], number: int, method: Any, seed: Any, groups: Sequence[int] = ()
) -> dict[str, Any]:
    """Values of axes at points; within each group of so many in turn the points are shuffled."""
    cube = points(number, sum(item.dimensions for item in drawn.values()), method, seed)
    for size in groups if cube.shape[1] else ():
        cube = _shuffled(cube, size, seed)
    columns: dict[str, Any] = {}
    first = 0
    for name, item in drawn.items():
        columns[name] = item.values_at(cube[:, first : first + item.dimensions])
        first += item.dimensions
    return columns


def _shuffled(cube: FloatArray, size: int, seed: Any) -> FloatArray:
    """Points whose order within groups of so many is random: places in a group are no strata of Sobol's points."""
    rng = np.random.default_rng((*(seed if isinstance(seed, tuple) else (seed, 0)), size))
    order = np.argsort(rng.random((len(cube) // size, size)), axis=1)
    return np.take_along_axis(cube.reshape(-1, size, cube.shape[1]), order[..., None], axis=1).reshape(cube.shape)


def _nested(
    drawn: dict[str, _Drawn], samples: tuple[Any, ...], method: Any, seed: Any, motions: Any
) -> tuple[int, dict[str, Any]]:
    """Columns of a nested sample: those of buildings from one stream of points, those of goods from another."""
    if len(samples) != 3:
        requirement = "a number, or three: of motions, of buildings of each and of goods of each"
        raise refusal(InvalidOption, "samples", "sample", requirement, brief(samples))
    if motions is not None:
        raise refusal(InvalidOption, "motions", "sample", "left out where samples are nested", brief(motions))
    of_motions, buildings, goods = (as_count(each, "samples", "sample", InvalidOption, least=1) for each in samples)
    number = _number_of_samples(of_motions * buildings * goods)
    start = as_count(seed, "seed", "sample", InvalidOption)
    outer = {name: item for name, item in drawn.items() if name not in OF_GOODS}
    columns = _columns(outer, of_motions * buildings, method, start, (buildings,))
    if isinstance(columns.get("storeys"), tuple):
        columns["storeys"], columns["period"] = columns["storeys"]
        outer["period"] = outer["storeys"]
    columns = {
        name: np.repeat(values, goods, axis=0) if outer[name].dimensions else values for name, values in columns.items()
    }
    inner = {name: item for name, item in drawn.items() if name in OF_GOODS}
    columns |= _columns(inner, number, method, (start, 1), (goods,))
    return number, columns | {"motion": np.repeat(np.arange(of_motions), buildings * goods) + 1}


def _length(value: Any) -> int:
    """Number of values of a list of numbers, 0 of anything else."""
    return len(value) if isinstance(value, Sequence | np.ndarray) and np.ndim(value) == 1 else 0


def _axis(name: str, value: Any, correlation: float = 0.0) -> _Drawn:
    if isinstance(value, Distribution):
        return _Drawn(1, lambda u: _quantiles(value, u[:, 0], name))
    if isinstance(value, Sequence) and any(isinstance(item, Distribution) for item in value):
        return _per_block(name, value, correlation)
    try:
        values = np.asarray(value)
    except (TypeError, ValueError):
        values = np.empty(0, dtype=object)
    if values.dtype.kind not in "iuf" or values.ndim > 2 or not values.size:
        raise refusal(InvalidScene, name, "sample", "a number, a distribution or a list of values", brief(value))
    if values.ndim == 0 or len(values) == 1:
        return _Drawn(0, lambda _: value)
    return _Drawn(1, lambda u: values[_index_of(u, len(values))])


def _per_block(name: str, value: Sequence[Any], correlation: float) -> _Drawn:
    """One column per block, whose normal scores have a correlation (a Gaussian copula); numbers stay as they are."""
    if name not in PER_BLOCK:
        requirement = "one distribution (lists of them are for what blocks have)"
        raise refusal(InvalidScene, name, "sample", requirement, brief(value))
    items = [_axis(name, item) for item in value]
    alone = sum(item.dimensions for item in items)
    shared = int(correlation > 0.0 and alone > 0)

    def at(u: FloatArray) -> FloatArray:
        coordinates = _correlated(u, correlation) if shared else u
        columns, first = [], 0
        for item in items:
            columns.append(np.broadcast_to(item.values_at(coordinates[:, first : first + item.dimensions]), len(u)))
            first += item.dimensions
        return np.stack(columns, axis=1)

    return _Drawn(alone + shared, at)


def _correlated(u: FloatArray, correlation: float) -> FloatArray:
    """Coordinates of which each has this correlation of normal scores with the others; the last one is shared."""
    from scipy.special import ndtr, ndtri  # slow to import

    scores = ndtri(np.clip(u, _SMALLEST, 1.0 - _SMALLEST))
    mixed = np.sqrt(1.0 - correlation) * scores[:, :-1] + np.sqrt(correlation) * scores[:, -1:]
    return np.asarray(ndtr(mixed))


def _index_of(u: FloatArray, values: int) -> Any:
    """Index of the value at a coordinate, each equally likely."""
    return np.minimum((u[:, 0] * values).astype(np.int64), values - 1)


def _quantiles(distribution: Distribution, u: FloatArray, name: str) -> FloatArray:
    values = np.asarray(distribution.ppf(np.clip(u, _SMALLEST, 1.0 - _SMALLEST)), dtype=np.float64)
    if values.shape != u.shape:
        raise refusal(InvalidScene, name, "sample", "a distribution of one number", brief(distribution))
    return values


def sampled_arguments(
    building: Any,
    axes: dict[str, Any],
    mu_k_over_mu_s: Any,
    *,
    samples: Any,
    method: Any,
    seed: Any,
    motions: Any,
    correlation: Any,
    crossed: Any,
) -> dict[str, Any]:
    """Return the arguments of a `Grid` of so many scenes from those of `Grid.sample`."""
    if not isinstance(crossed, Mapping) or not crossed.keys() <= set(SAMPLED):
        raise refusal(InvalidScene, "crossed", "sample", "values by the names of other arguments", brief(crossed))
    for name in crossed:
        if name in axes:
            raise refusal(InvalidScene, name, "sample", "left out where it is crossed", brief(axes[name]))
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
    number, columns = drawn_columns(drawn, samples, method, seed, motions, correlation)
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
    return _crossed(columns, number, crossed) if crossed else columns


def _crossed(columns: dict[str, Any], number: int, crossed: Mapping[str, Any]) -> dict[str, Any]:
    """Columns of every sample with every combination of values."""
    values = [np.atleast_1d(as_array(v, k, "sample", InvalidScene, or_number=True)) for k, v in crossed.items()]
    mesh = np.meshgrid(*values, indexing="ij")
    size = mesh[0].size
    columns = {
        name: each if np.ndim(each) == 0 or len(each) != number else np.repeat(each, size, axis=0)
        for name, each in columns.items()
    }
    return columns | {name: np.tile(each.reshape(-1), number) for name, each in zip(crossed, mesh, strict=True)}


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


@dataclass(frozen=True)
class StrengthDesign:
    """How V_y of a building follows from R: V_y = V_e / R.

    V_e is the combined elastic storey shear of a response spectrum analysis of the building to which a share of its
    design live load is attached as mass, as in the study of the paper.

    Parameters
    ----------
    target : TargetSpectrum
        Design spectrum.
    share : float, default 0.25
        Share of the design live load that the design counts as mass, from 0 to 1; what is present does not matter.
    elastic_at_one : bool, default True
        R = 1 leaves a building elastic, as the paper has it; False: it yields at V_e.
    combination : {"srss", "cqc"}, default "srss"
        Combination of the modes.

    Raises
    ------
    InvalidOption
        An argument is not what it must be.

    Examples
    --------
    >>> import seismass as sm
    >>> design = sm.runs.StrengthDesign(sm.TargetSpectrum.asce7(1.0, 0.6))
    >>> design.yield_shear(sm.Building.uniform(2, 0.3), [1.0, 0.0], 4.0).round(3).tolist()
    [5.266, 2.952]
    """

    target: TargetSpectrum
    share: float = 0.25
    elastic_at_one: bool = True
    combination: Combination = "srss"

    def __post_init__(self) -> None:
        if not isinstance(self.target, TargetSpectrum):
            raise refusal(InvalidOption, "target", "strength design", "a TargetSpectrum", brief(self.target))
        share = as_share(self.share, "share", "strength design")
        if not isinstance(self.elastic_at_one, bool):
            got = brief(self.elastic_at_one)
            raise refusal(InvalidOption, "elastic_at_one", "strength design", "true or false", got)
        checked_combination(self.combination, DEFAULT_DAMPING, "strength design")
        object.__setattr__(self, "share", share)

    def elastic_shear(self, building: Building, live_load: Any) -> FloatArray:
        """Return V_e of each storey (N).

        Parameters
        ----------
        building : Building
            The building without live load.
        live_load : array_like, shape (storeys,)
            Design live load of each floor over its mass.

        Raises
        ------
        InvalidOption
            A period of a mode is outside the range of the spectrum.
        """
        damping = building.damping if isinstance(building.damping, float) else DEFAULT_DAMPING
        return response_spectrum_analysis(
            building.mass * (1.0 + self.share * np.asarray(live_load, dtype=np.float64)),
            building.stiffness,
            self.target,
            combination=self.combination,
            damping=damping,
        ).storey_shear

    def yield_shear(self, building: Building, live_load: Any, reduction: float) -> FloatArray:
        """Return V_y of each storey (N) by the factor R; infinite where the building stays elastic.

        Parameters
        ----------
        building, live_load
            As for `elastic_shear`.
        reduction : float
            R, positive.
        """
        if reduction == 1.0 and self.elastic_at_one:
            return np.full(building.storeys, np.inf)
        return self.elastic_shear(building, live_load) / reduction

    def content(self) -> dict[str, Any]:
        """Return what it is made of, for JSON; `of_content` makes it again."""
        return {
            "target": self.target.parameters,
            "share": self.share,
            "elastic_at_one": self.elastic_at_one,
            "combination": self.combination,
        }

    @classmethod
    def of_content(cls, content: dict[str, Any]) -> StrengthDesign:
        """Return the design of what `content` returned.

        Raises
        ------
        InvalidOption
            The spectrum is the mean of motions, which the content does not hold.
        """
        return cls(
            target_of_parameters(content["target"]),
            content["share"],
            content["elastic_at_one"],
            content["combination"],
        )
