"""Pushover of a building under a pattern of lateral forces, as an exact polygon."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Literal, TypeAlias, get_args

import numpy as np
import polars as pl
from numpy.typing import ArrayLike, NDArray

from seismass.base.errors import InvalidOption
from seismass.base.values import FieldValue, FloatArray, as_array, brief, frozen, refusal
from seismass.base.views import Card, view
from seismass.design.lateral_force import exponent_k
from seismass.design.modes import positive_of_length, vibration_modes
from seismass.design.storey_springs import StoreySpring, storey_spring
from seismass.model.building import Building

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_TIE: Final = 1e-12
"""Relative difference of base shears up to which storeys reach a corner together."""
_FLAT: Final = 1e-13
"""Tangent over the initial stiffness up to which it counts as zero: rounding of a difference of two tangents."""
_MOST_TURNS: Final = 20
"""Turns of directions, per storey, after which they are taken not to be found."""


class Path:
    """The path while it is found: its storeys move to the next corner of a spring, again and again."""

    def __init__(self, building: Building, share: FloatArray, limits: FloatArray, p_delta: FloatArray) -> None:
        self.springs: list[StoreySpring] = [storey_spring(building, i) for i in range(building.storeys)]
        self.elastic = building.stiffness
        self.share, self.limits, self.p_delta = share, limits, p_delta
        self.base_shear = 0.0
        self.mechanism: int | None = None
        self.end = ""
        self.base_shears, self.drifts, self.forces = [0.0], [np.zeros(len(share))], [np.zeros(len(share))]
        self.events: list[tuple[int, int, str]] = []
        self._limited = False  # the base shear does not grow

    def run(self) -> None:
        """Find points until the path ends."""
        raise NotImplementedError

    def wall_shear(self, drift: FloatArray) -> FloatArray:
        """Return the shear (N) of the walls in each storey, shape of `drift`."""
        return np.zeros_like(drift)

    def _capacity(self, storey: int) -> None:
        """Note that a storey, from 0, lets the base shear grow no further."""
        if not self._limited:
            self._limited = True
            self.mechanism = self.mechanism or storey + 1
            self.events.append((len(self.base_shears) - 1, storey + 1, "capacity"))

    def _tangents(self, sign: int) -> FloatArray:
        stiffness = np.array([spring.tangent(sign) for spring in self.springs]) - self.p_delta
        return np.where(np.abs(stiffness) <= _FLAT * self.elastic, 0.0, stiffness)

    def _step(self, rates: FloatArray, slope: float) -> None:
        """Move by the rates of drift, with the base shear at a slope, up to the next corner."""
        signs = np.where(rates < 0.0, -1, 1)
        moving = rates != 0.0
        rooms, left = np.full(len(rates), np.inf), np.full(len(rates), np.inf)
        for i in np.flatnonzero(moving):
            rooms[i] = self.springs[i].room(int(signs[i])) / abs(rates[i])
            if signs[i] > 0:
                left[i] = max(self.limits[i] - self.springs[i].drift, 0.0) / rates[i]
        empty = self.base_shear / -slope if slope < 0.0 else np.inf
        length = min(float(rooms.min()), float(left.min()), empty)
        point = len(self.base_shears)
        for i in np.flatnonzero(moving):
            reaches = rooms[i] - length <= _TIE * (length + abs(self.springs[i].drift / rates[i]))
            whole = self.springs[i].room(int(signs[i])) if reaches else float(abs(rates[i]) * length)
            kind = self.springs[i].move(int(signs[i]), whole)
            if kind is not None:
                self.events.append((point, int(i) + 1, kind))
        self.base_shear = 0.0 if empty <= length else self.base_shear + slope * length
        self.base_shears.append(self.base_shear)
        self.drifts.append(np.array([spring.drift for spring in self.springs]))
        self.forces.append(np.array([spring.force for spring in self.springs]))
        if empty <= length:
            self._finish(int(np.argmax(rates)), "no strength left")
        elif left.min() <= length:
            self._finish(int(np.argmin(left)), "drift limit")

    def _finish(self, storey: int, kind: str) -> None:
        self.events.append((len(self.base_shears) - 1, storey + 1, kind))
        self.end = kind

    def event_table(self) -> pl.DataFrame:
        """Return the events, in order."""
        times = [event[0] for event in self.events]
        return pl.DataFrame(
            {
                "point": pl.Series(times, dtype=pl.UInt32),
                "base_shear": [self.base_shears[point] for point in times],
                "roof_displacement": [float(self.drifts[point].sum()) for point in times],
                "storey": pl.Series([event[1] for event in self.events], dtype=pl.UInt32),
                "kind": [event[2] for event in self.events],
            }
        )


class SeriesPath(Path):
    """That of a shear building: all storeys in series."""

    def run(self) -> None:
        """Find points until the path ends."""
        while not self.end:
            up = self._tangents(1)
            if (up > 0.0).all():
                self._limited = False
                self._step(self.share / up, 1.0)
                continue
            limiting = np.flatnonzero(up <= 0.0)
            # Flat storeys of one plateau share the drift only where none of them softens.
            order = np.argsort(up[limiting] / self.share[limiting], kind="stable")
            active = int(limiting[order[0]])
            self._capacity(active)
            rates = np.zeros(len(up))
            if up[active] == 0.0:
                rates[limiting] = self.share[limiting] / self.elastic[limiting]
                self._step(rates, 0.0)
                continue
            down = self._tangents(-1)
            others = np.arange(len(up)) != active
            if (down[others] <= 0.0).any():
                self._finish(int(np.flatnonzero(others & (down <= 0.0))[0]), "unstable unloading")
                return
            slope = up[active] / self.share[active]
            rates[others] = self.share[others] * slope / down[others]
            rates[active] = 1.0
            self._step(rates, slope)


class WallPath(Path):
    """That of a building with a stiffness matrix: the drifts of all storeys at once."""

    def __init__(self, building: Building, share: FloatArray, limits: FloatArray, p_delta: FloatArray) -> None:
        super().__init__(building, share, limits, p_delta)
        floors = np.tri(building.storeys)  # displacements of the floors by the drifts
        self._walls: FloatArray = floors.T @ (0.0 if building.stiffness_matrix is None else building.stiffness_matrix)
        self._walls = self._walls @ floors
        self._before = share  # rates of the drifts up to the last point

    def wall_shear(self, drift: FloatArray) -> FloatArray:
        """Return the shear (N) of the walls in each storey, shape of `drift`."""
        return drift @ self._walls

    def run(self) -> None:
        """Find points until the path ends."""
        while not self.end:
            up, down = self._tangents(1), self._tangents(-1)
            signs = np.where(self._before < 0.0, -1.0, 1.0)
            values, vectors = np.linalg.eigh(self._walls + np.diag(np.where(signs > 0.0, up, down)))
            flat = abs(values[0]) <= _FLAT * values[-1]
            if values[0] > 0.0 and not flat:
                rates = self._rates(signs, (up, down), 1.0)
                if rates is not None:
                    self._limited = False
                    self._follow(rates, 1.0)
                    continue
            limiting = int(np.argmin(up / self.share))
            self._capacity(limiting)
            rates, slope = vectors[:, 0] * np.sign(vectors[:, 0] @ self._before), 0.0
            if not flat or len(self._wrong(rates, signs, (up, down))):
                rates, slope = self._rates(signs, (up, down), -1.0), -1.0
            if rates is None or rates @ self._before <= 0.0:
                self._finish(limiting, "unstable unloading")
                return
            self._follow(rates, slope)

    def _follow(self, rates: FloatArray, slope: float) -> None:
        self._before = rates
        largest = float(np.abs(rates).max())
        self._step(rates / largest, slope / largest)

    def _rates(self, start: FloatArray, tangents: tuple[FloatArray, FloatArray], slope: float) -> FloatArray | None:
        """Drifts for a base shear of plus or minus 1, each by the tangent of its direction; None where not found.
        Lowest first, directions are turned (Murty 1974, Linear Algebra Appl. 9:1); ends if positive definite in all.
        """
        signs = start.copy()
        for _ in range(_MOST_TURNS * len(signs)):
            stiffness = self._walls + np.diag(np.where(signs > 0.0, *tangents))
            try:
                rates: FloatArray = np.linalg.solve(stiffness, slope * self.share)
            except np.linalg.LinAlgError:
                return None
            wrong = self._wrong(rates, signs, tangents)
            if not len(wrong):
                return rates
            signs[wrong[0]] *= -1.0
        return None

    def _wrong(self, rates: FloatArray, signs: FloatArray, tangents: tuple[FloatArray, FloatArray]) -> NDArray[np.intp]:
        """Storeys that do not move in the direction whose tangent was taken for them."""
        least = _TIE * float(np.abs(rates).max())
        return np.flatnonzero((rates * signs < -least) & (tangents[0] != tangents[1]))


Pattern: TypeAlias = Literal["modal", "uniform", "code"]
"""Forces as m phi_1, as m, or as m h^k with k of ASCE 7."""
DEFAULT_DRIFT_RATIO: Final = 0.05
"""Drift over the storey height up to which a building is pushed."""


@dataclass(frozen=True, eq=False, repr=False)
class Pushover(FieldValue, Card):
    """Equilibrium path of a building under growing lateral forces: points with straight lines between.

    Attributes
    ----------
    base_shear : ndarray, shape (points,)
        Sum of the lateral forces (N), from 0.
    roof_displacement : ndarray, shape (points,)
        Displacement of the roof (m); it may go back where a storey softens and the others unload (snap-back).
    drift : ndarray, shape (points, storeys)
        Storey drifts (m).
    spring_force : ndarray, shape (points, storeys)
        Forces of the storey springs (N): the storey shear of the lateral forces, and P-Delta besides, without walls.
    wall_shear : ndarray, shape (points, storeys)
        Shear of the walls in each storey (N); zero without a stiffness matrix.
    force : ndarray, shape (floors,)
        Lateral forces for a base shear of 1.
    events : polars.DataFrame
        What happens at the points: point, from 0; base_shear (N); roof_displacement (m); storey, from 1; kind: "yield"
        (a corner of the backbone; backwards while the storey unloads), "close" and "open" (a stop), "capacity" (this
        storey lets the base shear grow no further), "drift limit", "no strength left", "unstable unloading".
    mechanism : int or None
        Number of the storey that first limited the base shear; None where none did.
    end : str
        Kind of the last event, which ended the path.
    weight : float
        Weight of the building (N).
    heights : ndarray, shape (storeys,), or None
        Storey heights (m).
    """

    base_shear: FloatArray
    roof_displacement: FloatArray
    drift: FloatArray
    spring_force: FloatArray
    wall_shear: FloatArray
    force: FloatArray
    events: pl.DataFrame
    mechanism: int | None
    end: str
    weight: float
    heights: FloatArray | None

    @property
    def capacity(self) -> float:
        """Largest base shear (N)."""
        return float(self.base_shear.max())

    @property
    def stiffness(self) -> float:
        """Initial slope of base shear over roof displacement (N/m)."""
        return float(self.base_shear[1] / self.roof_displacement[1])

    def base_shear_at(self, roof_displacement: ArrayLike) -> FloatArray:
        """Return the base shear (N) where the roof first reaches displacements (m); NaN where it does not.

        Parameters
        ----------
        roof_displacement : array_like, shape (n,)
            Displacements of the roof (m).

        Raises
        ------
        InvalidOption
            They are not a list of numbers.
        """
        wanted = as_array(roof_displacement, "roof_displacement", "pushover", InvalidOption)
        reached = np.maximum.accumulate(self.roof_displacement)
        first = np.searchsorted(reached, wanted)
        shear = np.full(len(wanted), np.nan)
        for i, (displacement, point) in enumerate(zip(wanted, first, strict=True)):
            if point == 0 and displacement == reached[0]:
                shear[i] = self.base_shear[0]
            elif 0 < point < len(reached):
                # The point before may lie behind the farthest one so far, but the line to this one crosses `at`.
                ends = slice(point - 1, point + 1)
                shear[i] = np.interp(displacement, self.roof_displacement[ends], self.base_shear[ends])
        return shear

    def table(self) -> pl.DataFrame:
        """Return one row per point.

        Returns
        -------
        polars.DataFrame
            point, from 0; base_shear (N); base_shear_over_weight; roof_displacement (m); drift_1, drift_2, ... (m) and,
            where heights are known, drift_ratio_1, drift_ratio_2, ...
        """
        columns: dict[str, FloatArray | range] = {
            "point": range(len(self.base_shear)),
            "base_shear": self.base_shear,
            "base_shear_over_weight": self.base_shear / self.weight,
            "roof_displacement": self.roof_displacement,
        }
        columns |= {f"drift_{i}": drift for i, drift in enumerate(self.drift.T, start=1)}
        if self.heights is not None:
            columns |= {f"drift_ratio_{i}": ratio for i, ratio in enumerate((self.drift / self.heights).T, start=1)}
        return pl.DataFrame(columns, schema_overrides={"point": pl.UInt32})

    @view
    def plot(self, *, labels: bool = True, ax: Axes | None = None) -> Figure:
        """Return a figure of base shear over roof displacement; see `seismass.show.plots.hysteresis`."""
        raise NotImplementedError


def pushover(
    building: Building,
    pattern: Pattern | ArrayLike = "modal",
    *,
    drift_limit: ArrayLike | None = None,
    added_load: ArrayLike | None = None,
) -> Pushover:
    """Push a building slowly and return its equilibrium path.

    Parameters
    ----------
    building : Building
        The building, with its springs of any law, P-Delta where it has that, and its stiffness matrix.
    pattern : {"modal", "uniform", "code"} or array_like, shape (floors,), default "modal"
        Lateral forces in proportion to m phi_1, to m, or to m h^k with k of ASCE 7 for the first period (heights are
        needed); or forces of any scale. Every storey must have a positive shear.
    drift_limit : array_like, optional
        Storey drift (m) at which the path ends; one number stands for all storeys. By default 5 % of the heights;
        needed where the building has none.
    added_load : array_like, shape (floors,), optional
        Gravity load of goods on each floor (N), which adds to P-Delta of a building with `gravity_load`.

    Returns
    -------
    Pushover
        Points, events, and the storey that limits the base shear.

    Raises
    ------
    InvalidOption, InvalidScene
        An argument is out of its range, or P/h reaches a stiffness.

    Notes
    -----
    With V_i = S_i V_b, S_i the share of the base shear V_b in storey i, equilibrium of the storey is F_i(d_i) -
    (P_i/h_i) d_i = S_i V_b. The storeys are in series: each finds its own drift. While all tangents of the left side
    are positive the base shear grows. Where one is not, its storey drifts on along its own curve, and the others
    unload. Storeys that reach a plateau together share the drift as S_i/k_i, the limit of a small common slope; where
    they soften together, the drift goes to the one with the steepest fall over S_i, the lowest where they are equal.
    The path ends at a drift limit, without strength, or where a storey would have to unload along a falling line.
    There are no steps to choose: every point is a corner of a spring's curve. An `energy_capacity` has no effect, since
    no storey completes a half cycle.

    With a stiffness matrix K, which stays elastic, the storeys are not in series: F_i(d_i) - (P_i/h_i) d_i +
    (L^T K L d)_i = S_i V_b, where L d are the displacements of the floors. From point to point the drifts follow the
    tangents, those of unloading in storeys that go back. While the tangent stiffness is positive definite the base
    shear grows, and where it no longer is the shear falls.

    Examples
    --------
    Two elastoplastic storeys; the second has 60 % of the strength and, with equal forces, half of the shear:

    >>> import seismass as sm
    >>> building = sm.Building([1e3, 1e3], 1e6, yield_shear=[1e4, 6e3], overstrength=1.0)
    >>> path = sm.design.pushover(building, "uniform", drift_limit=0.05)
    >>> path.capacity, path.mechanism, path.end
    (10000.0, 1, 'drift limit')
    >>> path.roof_displacement.round(6).tolist()
    [0.0, 0.015, 0.055]
    """
    if not isinstance(building, Building):
        raise refusal(InvalidOption, "building", "pushover", "a Building", brief(building))
    force = _forces(building, pattern)
    share = np.cumsum(force[::-1])[::-1]
    limits = _limits(building, drift_limit)
    kind = SeriesPath if building.stiffness_matrix is None else WallPath
    path = kind(building, share, limits, _p_delta(building, added_load))
    path.run()
    drift = frozen(path.drifts)
    return Pushover(
        base_shear=frozen(path.base_shears),
        roof_displacement=frozen(drift.sum(axis=1)),
        drift=drift,
        spring_force=frozen(path.forces),
        wall_shear=frozen(path.wall_shear(drift)),
        force=frozen(force),
        events=path.event_table(),
        mechanism=path.mechanism,
        end=path.end,
        weight=building.weight,
        heights=building.heights,
    )


def _forces(building: Building, pattern: Pattern | ArrayLike) -> FloatArray:
    """Lateral forces for a base shear of 1."""
    if not isinstance(pattern, str):
        force = as_array(pattern, "pattern", "pushover", InvalidOption)
        if len(force) != building.storeys:
            requirement = f"a list of {building.storeys} forces, one per floor"
            raise refusal(InvalidOption, "pattern", "pushover", requirement, f"{len(force)} values")
    elif pattern == "modal":
        matrix = building.stiffness_matrix
        modes = vibration_modes(building.mass, building.stiffness, stiffness_matrix=matrix)
        force = building.mass * modes.shapes[:, 0]
    elif pattern == "uniform":
        force = building.mass
    elif pattern == "code":
        if building.heights is None:
            raise refusal(InvalidOption, "pattern", "pushover", "modal or uniform where no heights are known", "'code'")
        force = building.mass * np.cumsum(building.heights) ** exponent_k(float(building.periods[0]))
    else:
        requirement = f"{', '.join(get_args(Pattern))} or a list of forces"
        raise refusal(InvalidOption, "pattern", "pushover", requirement, brief(pattern))
    shear = np.cumsum(force[::-1])[::-1]
    if not (np.isfinite(force).all() and (shear > 0.0).all()):
        raise refusal(
            InvalidOption, "pattern", "pushover", "forces with a positive shear in every storey", brief(force)
        )
    return np.asarray(force / shear[0])


def _limits(building: Building, drift_limit: ArrayLike | None) -> FloatArray:
    if drift_limit is not None:
        return positive_of_length(drift_limit, "drift_limit", building.storeys)
    if building.heights is None:
        raise refusal(InvalidOption, "drift_limit", "pushover", "given where no heights are known", "none")
    return DEFAULT_DRIFT_RATIO * building.heights


def _p_delta(building: Building, added_load: ArrayLike | None) -> FloatArray:
    """P/h of each storey (N/m)."""
    if added_load is not None:
        if building.gravity_load is None:
            raise refusal(InvalidOption, "added_load", "pushover", "left out without gravity_load", brief(added_load))
        added = as_array(added_load, "added_load", "pushover", InvalidOption)
        if len(added) != building.storeys or not (np.isfinite(added) & (added >= 0.0)).all():
            requirement = f"{building.storeys} loads of at least 0, one per floor"
            raise refusal(InvalidOption, "added_load", "pushover", requirement, brief(added.tolist()))
        building = building.replace(gravity_load=building.gravity_load + added)  # refuses what reaches a stiffness
    if building.geometric_stiffness is not None:
        return building.geometric_stiffness
    if building.gravity_load is None or building.heights is None:
        return np.zeros(building.storeys)
    return np.asarray(np.cumsum(building.gravity_load[::-1])[::-1] / building.heights)
