"""Storey springs fitted to pushover curves of another program, with the misfit and what was assumed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Final, Literal, TypeAlias, get_args

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption
from seismass.base.values import FieldValue, FloatArray, as_array, as_list, brief, frozen, is_list, refusal
from seismass.media.result import Result, finite_values

SpringShape: TypeAlias = Literal["bilinear", "trilinear", "capped"]
"""Two lines, three, or three whose last one falls."""
SPRING_SHAPES: Final[tuple[SpringShape, ...]] = get_args(SpringShape)
_CORNERS: Final = 40
"""Most samples that are tried as corners."""
_STARTS_SPRING_FIT: Final = 3
"""Trials from which corners are searched further."""
_STRAIGHT: Final = 1e-6
"""Change of slope at the first corner, over the first slope, below which a curve is straight."""
_LEAST_SLOPE: Final = 1e-6
"""Least second slope of a spring with a falling branch, which a plateau has in its place."""


@dataclass(frozen=True)
class FittedSpring:
    """A spring as `Building` takes it (N/m, N); with two lines the overstrength is 1 and both slopes are the second."""

    stiffness: float
    yield_shear: float
    overstrength: float
    second_slope: float
    third_slope: float

    @property
    def corners(self) -> tuple[float, ...]:
        """Drifts (m) at which the slope changes."""
        first = self.yield_shear / self.stiffness
        if self.overstrength == 1.0:
            return (first,)
        return first, first * (1.0 + (self.overstrength - 1.0) / self.second_slope)

    def force(self, drift: FloatArray) -> FloatArray:
        """Return the shear (N) at drifts (m)."""
        slopes = [1.0, self.third_slope] if len(self.corners) == 1 else [1.0, self.second_slope, self.third_slope]
        ends = [*self.corners, np.inf]
        starts = [0.0, *self.corners]
        drifts = np.zeros(len(drift))
        for slope, start, end in zip(slopes, starts, ends, strict=True):
            drifts += slope * np.clip(drift - start, 0.0, end - start)
        return self.stiffness * drifts


def sample_weights(drift: FloatArray) -> FloatArray:
    """Return the drift (m) that each sample stands for, so that the fit is of the curve and not of its samples."""
    ends = np.concatenate((drift[:1], 0.5 * (drift[1:] + drift[:-1]), drift[-1:]))
    return np.diff(ends)


def fitted_spring(drift: FloatArray, shear: FloatArray, shape: SpringShape) -> FittedSpring | None:
    """Return the least-squares spring of a curve from the origin, drifts in m and shears in N; None where it does not
    bend. For given corners, slopes by non-negative least squares (Lawson and Hanson 1974) never grow.
    """
    from scipy.optimize import least_squares, nnls

    root = np.sqrt(sample_weights(drift))
    scale = float(np.abs(shear).max())
    known = root * shear / scale
    count = 1 if shape == "bilinear" else 2

    def solved(corners: FloatArray) -> tuple[FloatArray, float]:
        solution, distance = nnls(root[:, None] * _basis(drift, np.sort(corners), shape), known)
        return solution, float(distance)

    inner = np.unique(drift[(drift > 0.0) & (drift < drift[-1])])
    if len(inner) > _CORNERS:
        inner = inner[np.linspace(0, len(inner) - 1, _CORNERS).astype(int)]
    if len(inner) < count:
        return None
    first = np.arange(len(inner))
    pairs = first[:, None] if count == 1 else np.column_stack(np.triu_indices(len(inner), 1))
    trials = sorted((solved(inner[pair])[1], tuple(inner[pair])) for pair in pairs)
    best = np.array(trials[0][1])
    least = trials[0][0]
    for _, start in trials[:_STARTS_SPRING_FIT]:

        def residual(corners: FloatArray) -> FloatArray:
            ordered = np.sort(corners)
            solution, _ = nnls(root[:, None] * _basis(drift, ordered, shape), known)
            misfit: FloatArray = root * (_basis(drift, ordered, shape) @ solution) - known
            return misfit

        near = least_squares(
            residual,
            start,
            bounds=(1e-9 * drift[-1], drift[-1]),
            x_scale=np.maximum(start, 1e-6 * drift[-1]),
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-15,
        )
        distance = solved(near.x)[1]
        if distance < least:
            best, least = np.sort(near.x), distance
    return _spring(best, scale * solved(best)[0], shape)


def _basis(drift: FloatArray, corners: FloatArray, shape: SpringShape) -> FloatArray:
    """Columns whose non-negative sums are the curves of a shape."""
    short = [np.minimum(drift, corner) for corner in corners]
    last = drift if shape != "capped" else short[-1] - drift
    return np.column_stack([*short, last])


def _spring(corners: FloatArray, solution: FloatArray, shape: SpringShape) -> FittedSpring | None:
    """The spring of corners (m) and coefficients (N/m)."""
    falls = shape == "capped"
    slopes = [solution[0] + solution[1], solution[1], -solution[2]] if falls else list(np.cumsum(solution[::-1])[::-1])
    stiffness = float(slopes[0])
    if len(corners) == 2 and slopes[0] - slopes[1] <= _STRAIGHT * stiffness:  # the first corner is none
        corners, slopes = corners[1:], [slopes[0], slopes[2]]
    if not stiffness > 0.0 or slopes[0] - slopes[1] <= _STRAIGHT * stiffness:
        return None
    ratios = [float(slope) / stiffness for slope in slopes]
    strength = stiffness * float(corners[0])
    if len(corners) == 2 and (falls or ratios[1] > 0.0):
        second = max(ratios[1], _LEAST_SLOPE) if falls else ratios[1]
        overstrength = 1.0 + second * (float(corners[1]) / float(corners[0]) - 1.0)
        return FittedSpring(stiffness, strength, overstrength, second, ratios[2])
    return FittedSpring(stiffness, strength, 1.0, max(ratios[-1], 0.0), ratios[-1])


_FLAT: Final = 1e-12
"""Slope over the first one that a plateau has, so that base shears have a displacement."""
_FAR: Final = 100.0
"""Force beyond the last corner, over that at it, up to which a curve is known."""
_MOST_OVERSTRENGTH: Final = 50.0
_STARTS: Final = (1.0, 0.8, 1.25)
"""Factors of the strength from which the search begins."""


def roof_shear(springs: list[FittedSpring], share: FloatArray, roof: FloatArray) -> FloatArray:
    """Return the base shear (N) at roof displacements (m) of storeys in series whose slopes do not fall; `share` is
    that of the base shear in each storey.
    """
    knots = []
    for spring, part in zip(springs, share, strict=True):
        slopes = [max(spring.second_slope, _FLAT)] if len(spring.corners) == 2 else []
        slopes.append(max(spring.third_slope, _FLAT))
        drifts, forces = [0.0, *spring.corners], [0.0, spring.yield_shear]
        if len(spring.corners) == 2:
            forces.append(spring.overstrength * spring.yield_shear)
        drifts.append(drifts[-1] + _FAR * forces[-1] / (slopes[-1] * spring.stiffness))
        knots.append((np.array([*forces, (1.0 + _FAR) * forces[-1]]) / part, np.array(drifts)))
    top = min(float(levels[-1]) for levels, _ in knots)
    shears = np.unique(np.concatenate([levels[levels <= top] for levels, _ in knots]))
    displacements = np.sum([np.interp(shears, levels, drifts) for levels, drifts in knots], axis=0)
    shear: FloatArray = np.interp(roof, displacements, shears)
    return shear


def fitted_storeys(
    roof: FloatArray,
    shear: FloatArray,
    share: FloatArray,
    stiffness: FloatArray,
    strength: FloatArray,
    shape: SpringShape,
) -> list[FittedSpring] | None:
    """Return the least-squares springs for a curve of roof displacement (m) and base shear (N); None where it does not
    bend. Slopes and overstrength are alike in all storeys; stiffness and strength are relative.
    """
    from scipy.optimize import least_squares

    whole = fitted_spring(roof, shear, shape)
    if whole is None:
        return None
    root, scale = np.sqrt(sample_weights(roof)), float(shear.max())
    stiffness_unit = whole.stiffness * float(np.sum(share / stiffness))
    strength_unit = whole.yield_shear * float(np.median(share / strength))
    lines = 1 if len(whole.corners) == 1 else 2

    def springs(x: FloatArray) -> list[FittedSpring]:
        k, v_y = stiffness_unit * x[0] * stiffness, strength_unit * x[1] * strength
        if lines == 1:
            return [
                FittedSpring(float(a), float(b), 1.0, float(x[2]), float(x[2])) for a, b in zip(k, v_y, strict=True)
            ]
        second = max(float(x[2]), _FLAT)
        third = float(x[4]) * second
        return [FittedSpring(float(a), float(b), 1.0 + float(x[3]), second, third) for a, b in zip(k, v_y, strict=True)]

    def residual(x: FloatArray) -> FloatArray:
        misfit: FloatArray = root * (roof_shear(springs(x), share, roof) - shear) / scale
        return misfit

    slopes = [whole.third_slope]
    low, high = [1e-3, 1e-3, 0.0], [1e3, 1e3, 1.0]
    if lines == 2:
        slopes = [whole.second_slope, whole.overstrength - 1.0, whole.third_slope / whole.second_slope]
        low, high = [*low, 1e-9, 0.0], [*high, _MOST_OVERSTRENGTH, 1.0]
    best = np.array([1.0, 1.0, *slopes])
    for factor in _STARTS:
        start = np.clip(np.array([1.0, factor, *slopes]), np.array(low), np.array(high))
        near = least_squares(residual, start, bounds=(low, high), xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=400)
        if np.linalg.norm(residual(near.x)) < np.linalg.norm(residual(best)):
            best = near.x
    return springs(best)


_OWNER: Final = "pushover fit"
_FEWEST: Final = 4
"""Fewest samples of a curve beside the origin."""
_AT_PEAK: Final = 1e-3
"""Shears that are so close to the largest, over it, are of one plateau with it."""


@dataclass(frozen=True, eq=False, repr=False)
class PushoverFit(FieldValue, Result):
    """Storey springs fitted to pushover curves.

    Attributes
    ----------
    stiffness, yield_shear, overstrength, second_slope, third_slope : ndarray, shape (storeys,)
        The springs (N/m, N, 1), storey 1 first, as `Building` takes them. Of two lines the overstrength is 1 and both
        slopes are the second one.
    shape : str
        "bilinear", "trilinear" or "capped".
    of_roof : bool
        One curve of base shear over roof displacement was fitted; else a curve per storey.
    drift, shear, fitted : tuple of ndarray
        Each curve as fitted, from the origin: drifts or roof displacements (m), shears (N), and those of the springs.
    largest_misfit, rms_misfit : ndarray, shape (curves,)
        Largest and root mean square difference of the shears, over the largest shear of the curve. In the mean samples
        count by the drift between them.
    assumptions : tuple of str
        What was assumed, sentence by sentence.
    """

    document: ClassVar[str] = "pushover_fit"

    stiffness: FloatArray
    yield_shear: FloatArray
    overstrength: FloatArray
    second_slope: FloatArray
    third_slope: FloatArray
    shape: SpringShape
    of_roof: bool
    drift: tuple[FloatArray, ...]
    shear: tuple[FloatArray, ...]
    fitted: tuple[FloatArray, ...]
    largest_misfit: FloatArray
    rms_misfit: FloatArray
    assumptions: tuple[str, ...]

    @property
    def springs(self) -> dict[str, FloatArray]:
        """Arguments of `Building`: stiffness, yield_shear, overstrength, second_slope, third_slope."""
        names = ("stiffness", "yield_shear", "overstrength", "second_slope", "third_slope")
        return {name: getattr(self, name) for name in names}

    @property
    def corner_drift(self) -> FloatArray:
        """Drift (m) at the first yield of each storey, shape (storeys,)."""
        return frozen(self.yield_shear / self.stiffness)

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name: springs, one row per storey; misfit, one per curve; curves, one per sample."""
        numbers = range(1, len(self.stiffness) + 1)
        springs = pl.DataFrame({"storey": pl.Series(numbers, dtype=pl.UInt32), **self.springs})
        curve = pl.Series("curve", range(1, len(self.drift) + 1), dtype=pl.UInt32)
        misfit = pl.DataFrame(
            {
                "curve": curve,
                "peak_shear": [float(shear.max()) for shear in self.shear],
                "largest_misfit": self.largest_misfit,
                "rms_misfit": self.rms_misfit,
            }
        )
        curves = pl.DataFrame(
            {
                "curve": pl.Series(np.repeat(curve.to_numpy(), [len(drift) for drift in self.drift])),
                "drift": np.concatenate(self.drift),
                "shear": np.concatenate(self.shear),
                "fitted": np.concatenate(self.fitted),
            }
        )
        return {"springs": springs, "misfit": misfit, "curves": curves}

    @property
    def figure_names(self) -> tuple[str, ...]:
        """pushover_fit: each curve and its springs."""
        return ("pushover_fit",)

    def to_dict(self) -> dict[str, Any]:
        """Return springs, misfit and assumptions as plain values in SI units."""
        tables = self.tables
        document = {
            "shape": self.shape,
            "of_roof": self.of_roof,
            "springs": tables["springs"].to_dicts(),
            "misfit": tables["misfit"].to_dicts(),
            "assumptions": list(self.assumptions),
        }
        return finite_values(document)


def fit_pushover(
    drift: ArrayLike | Sequence[ArrayLike],
    shear: ArrayLike | Sequence[ArrayLike],
    *,
    shape: SpringShape = "bilinear",
    forces: ArrayLike | None = None,
    relative_stiffness: ArrayLike | None = None,
    relative_strength: ArrayLike | None = None,
    p_over_h: ArrayLike | None = None,
) -> PushoverFit:
    """Fit storey springs to pushover curves: one per storey, or one of the whole building.

    Parameters
    ----------
    drift, shear : array_like, or lists of them
        Drifts (m) that do not go back, and shears (N), of one curve; or a list of curves, storey 1 first. The origin
        may be left out.
    shape : {"bilinear", "trilinear", "capped"}, default "bilinear"
        Two lines, three, or three of which the last falls, for peak-oriented springs. Of the first two what comes after
        the largest shear is left out, and said.
    forces : array_like, shape (floors,), optional
        Lateral forces of any scale, floor 1 first: the curve is of base shear over roof displacement. Without them a
        single curve is that of a building of one storey.
    relative_stiffness, relative_strength : array_like, shape (storeys,), optional
        Stiffnesses and strengths of the storeys over one another, as a design has them, with `forces`. By default as
        the storey shears under the forces: all storeys then drift alike, and yield at once.
    p_over_h : array_like, optional
        Gravity load over height (N/m) of each storey, of curves of storeys from an analysis with P-Delta: P/h times the
        drift, which the spring carries besides, is added to the shear. By default the analysis had none.

    Returns
    -------
    PushoverFit
        Springs, curves, misfit, and what was assumed.

    Raises
    ------
    InvalidOption
        A curve has fewer than four samples, goes back, has a shear that is not positive, or does not bend; lists have
        different lengths; or arguments do not belong together.

    Notes
    -----
    The sum of squared differences of the shears is least, each sample with the drift that it stands for
    (`scipy.optimize`: non-negative least squares for the slopes, so that they never grow, a search for the corners).

    Examples
    --------
    >>> import seismass as sm
    >>> drift = [0.002, 0.005, 0.010, 0.015, 0.020, 0.040]
    >>> shear = [200e3, 500e3, 1000e3, 1025e3, 1050e3, 1150e3]
    >>> fit = sm.design.fit_pushover(drift, shear)
    >>> fit.stiffness.round(), fit.yield_shear.round(), fit.third_slope.round(4)
    (array([1.e+08]), array([1000000.]), array([0.05]))
    >>> building = sm.Building(mass=1e5, **fit.springs)
    """
    as_word(shape, SPRING_SHAPES, "shape", _OWNER)
    curves, left_out = _curves(drift, shear, shape)
    if forces is None:
        for name, value in (("relative_stiffness", relative_stiffness), ("relative_strength", relative_strength)):
            if value is not None:
                raise refusal(InvalidOption, name, _OWNER, "given with forces alone", "no forces")
        curves, note = _with_p_delta(curves, p_over_h)
        fits = [fitted_spring(*curve, shape) for curve in curves]
        springs = [_bent(spring, number, len(fits)) for number, spring in enumerate(fits, start=1)]
        fitted = tuple(frozen(spring.force(curve[0])) for spring, curve in zip(springs, curves, strict=True))
        assumptions: tuple[str, ...] = (
            "Each storey is fitted by itself: its shear over its own drift is taken as the force of its spring.",
            note,
        )
    else:
        if len(curves) != 1:
            raise refusal(InvalidOption, "forces", _OWNER, "given with one curve", f"{len(curves)} curves")
        if p_over_h is not None:
            raise refusal(InvalidOption, "p_over_h", _OWNER, "left out with a curve of the roof", brief(p_over_h))
        if shape == "capped":
            need = "bilinear or trilinear with a curve of the roof: which storey falls is not seen in it"
            raise refusal(InvalidOption, "shape", _OWNER, need, brief(shape))
        share = _shares(forces)
        stiffness = share if relative_stiffness is None else _relative(relative_stiffness, "stiffness", len(share))
        strength = share if relative_strength is None else _relative(relative_strength, "strength", len(share))
        of_storeys = fitted_storeys(*curves[0], share, stiffness, strength, shape)
        springs = [_bent(None, 1, 1)] if of_storeys is None else of_storeys
        fitted = (frozen(roof_shear(springs, share, curves[0][0])),)
        assumptions = _roof_remarks(share, relative_stiffness is None, relative_strength is None)
    misfits = [np.abs(fit - curve[1]) / curve[1].max() for fit, curve in zip(fitted, curves, strict=True)]
    weights = [sample_weights(curve[0]) for curve in curves]
    rms = [np.sqrt(np.average(misfit**2, weights=weight)) for misfit, weight in zip(misfits, weights, strict=True)]
    return PushoverFit(
        **{name: frozen([getattr(spring, name) for spring in springs]) for name in FittedSpring.__annotations__},
        shape=shape,
        of_roof=forces is not None,
        drift=tuple(frozen(curve[0]) for curve in curves),
        shear=tuple(frozen(curve[1]) for curve in curves),
        fitted=fitted,
        largest_misfit=frozen([misfit.max() for misfit in misfits]),
        rms_misfit=frozen(rms),
        assumptions=(*assumptions, *left_out),
    )


def _curves(drift: Any, shear: Any, shape: SpringShape) -> tuple[list[tuple[FloatArray, FloatArray]], tuple[str, ...]]:
    """The curves from their origin, and what of them is left out."""
    nested = is_list(drift) and len(drift) > 0 and is_list(drift[0])
    drifts, shears = [drift], [shear]
    if nested:
        drifts, shears = list(drift), as_list(shear, "shear", _OWNER, InvalidOption, f"a list of {len(drift)} curves")
    if len(drifts) != len(shears):
        raise refusal(InvalidOption, "shear", _OWNER, f"a list of {len(drifts)} curves", f"{len(shears)}")
    curves, notes = [], []
    for number, (d, v) in enumerate(zip(drifts, shears, strict=True), start=1):
        name = f"curve {number}" if len(drifts) > 1 else "curve"
        x = as_array(d, "drift", f"{name} of {_OWNER}", InvalidOption)
        y = as_array(v, "shear", f"{name} of {_OWNER}", InvalidOption)
        if len(x) != len(y):
            raise refusal(InvalidOption, "shear", f"{name} of {_OWNER}", f"a list of {len(x)} numbers", f"{len(y)}")
        if not (np.isfinite(x).all() and np.isfinite(y).all()):
            raise refusal(InvalidOption, "samples", f"{name} of {_OWNER}", "finite numbers", "one that is not")
        if (np.diff(x) < 0.0).any() or (x < 0.0).any():
            index = int(np.argmax(np.diff(x, prepend=0.0) < 0.0))
            need = "positive, and not below that before"
            raise refusal(InvalidOption, "drift", f"{name} of {_OWNER}", need, f"{x[index]:g} m as sample {index + 1}")
        x, y = x[x > 0.0], y[x > 0.0]
        if not (y > 0.0).all():
            raise refusal(InvalidOption, "shear", f"{name} of {_OWNER}", "positive", f"{y.min():g} N")
        if shape != "capped" and len(y):
            last = int(np.flatnonzero(y >= (1.0 - _AT_PEAK) * y.max())[-1]) + 1
            if last < len(y):
                notes.append(
                    f"Left out of {name}: {len(y) - last} samples after the largest shear, from {1e3 * x[last]:.4g} mm "
                    "on; the springs keep their strength there."
                )
            x, y = x[:last], y[:last]
        if len(x) < _FEWEST:
            need = f"at least {_FEWEST} samples beside the origin, up to the largest shear"
            raise refusal(InvalidOption, "samples", f"{name} of {_OWNER}", need, f"{len(x)}")
        curves.append((np.append(0.0, x), np.append(0.0, y)))
    return curves, tuple(notes)


def _with_p_delta(
    curves: list[tuple[FloatArray, FloatArray]], p_over_h: ArrayLike | None
) -> tuple[list[tuple[FloatArray, FloatArray]], str]:
    """The forces of the springs, and how they were found."""
    if p_over_h is None:
        return curves, "The analysis of the curves is taken to be without P-Delta."
    ratios = as_array(p_over_h, "p_over_h", _OWNER, InvalidOption, or_number=True)
    slopes = np.broadcast_to(ratios, (len(curves),)) if ratios.ndim == 0 or len(ratios) == 1 else ratios
    if len(slopes) != len(curves) or not ((slopes >= 0.0) & np.isfinite(slopes)).all():
        need = f"one number or {len(curves)}, none of them negative"
        raise refusal(InvalidOption, "p_over_h", _OWNER, need, brief(p_over_h))
    corrected = [(x, y + slope * x) for (x, y), slope in zip(curves, slopes, strict=True)]
    return corrected, "The analysis of the curves had P-Delta: P/h times the drift is added to the shear."


def _bent(spring: FittedSpring | None, number: int, count: int) -> FittedSpring:
    if spring is None:
        name = f"curve {number} of {_OWNER}" if count > 1 else _OWNER
        raise refusal(
            InvalidOption, "samples", name, "a curve that bends, with samples on both sides", "a straight line"
        )
    return spring


def _shares(forces: ArrayLike) -> FloatArray:
    """Share of the base shear in each storey."""
    array = as_array(forces, "forces", _OWNER, InvalidOption)
    share = np.cumsum(array[::-1])[::-1]
    if not len(share) or not np.isfinite(share).all() or not (share > 0.0).all():
        raise refusal(InvalidOption, "forces", _OWNER, "such that every storey has a positive shear", brief(forces))
    relative: FloatArray = share / share[0]
    return relative


def _relative(values: ArrayLike, what: str, storeys: int) -> FloatArray:
    array = as_array(values, f"relative_{what}", _OWNER, InvalidOption)
    if len(array) != storeys or not ((array > 0.0) & np.isfinite(array)).all():
        raise refusal(InvalidOption, f"relative_{what}", _OWNER, f"{storeys} positive numbers", brief(values))
    return array


def _roof_remarks(share: FloatArray, stiffness: bool, strength: bool) -> tuple[str, ...]:
    """What is assumed where one curve stands for all storeys."""
    listed = ", ".join(f"{part:.3g}" for part in share)
    return (
        f"One curve of the whole building: the lateral forces give the storeys {listed} of the base shear.",
        "Stiffnesses of the storeys are in proportion to these shears, so that all drift alike."
        if stiffness
        else "Stiffnesses of the storeys are in the given proportion.",
        "Strengths of the storeys are in proportion to these shears, so that all yield at once."
        if strength
        else "Strengths of the storeys are in the given proportion.",
        "Slopes after yielding over the first one are alike in all storeys.",
        "The displacement of the roof is taken as that of storey springs alone: bending of walls and rotation of the "
        "base count as drift of the storeys.",
        "The analysis of the curve is taken to be without P-Delta.",
    )
