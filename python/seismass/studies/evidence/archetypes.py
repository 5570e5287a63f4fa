"""What a committee's table is made of: occupancies, systems, archetypes, and what varies at random."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from seismass.base.distributions import Distribution, bounded, lognormal, mixture
from seismass.base.errors import InvalidOption
from seismass.base.files import data_directory
from seismass.base.input_table import NOT_NEGATIVE, POSITIVE, SHARE, Need, Table, load_table
from seismass.base.values import as_path
from seismass.design import DesignedBuilding, code_period, designed_building
from seismass.model.codes import code_fraction
from seismass.model.friction import friction_pair
from seismass.model.occupancy import SurveyedLoad, surveyed_load
from seismass.motions.spectra import TargetSpectrum

STIFF_BELOW: Final = 4.0
"""R below which an archetype is of the class "stiff", else "ductile"."""
_RANDOM: Final = {
    **dict.fromkeys(("first_yield", "first_yield_sigma", "second_slope", "second_slope_sigma"), POSITIVE),
    "overstrength": Need("a number from 1", lambda number: 1.0 <= number < np.inf),
    "friction_sigma": POSITIVE,
    "kinetic": SHARE,
    "correlation": SHARE,
    "most_present": POSITIVE,
}


@dataclass(frozen=True)
class Occupancy:
    """Loads and goods of floors of one use: kPa, m, probabilities of friction coefficients mu_s."""

    name: str
    survey: SurveyedLoad
    dead_load: float
    live_load: float
    height: float
    contacts: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class System:
    """A structural system: R, C_d, the system of its periods, and the drift ratio of a collapse."""

    name: str
    R: float
    C_d: float
    period: str
    collapse: float


@dataclass(frozen=True)
class Archetype:
    """A building that a code designs: an occupancy, a number of storeys, a system. Roofs of two and more are bare."""

    occupancy: Occupancy
    storeys: int
    system: System

    @property
    def name(self) -> str:
        """Such as "light storage, 2 storeys, R 8 frame"."""
        return f"{self.occupancy.name}, {self.storeys} storey{'s' * (self.storeys > 1)}, {self.system.name}"

    @property
    def kind(self) -> str:
        """Class of the system: "stiff" (R below 4) or "ductile"."""
        return "stiff" if self.system.R < STIFF_BELOW else "ductile"


@dataclass(frozen=True)
class Setting:
    """Site, code and what varies at random, as the comments of `example_file` say, and what may be changed beside.

    Attributes
    ----------
    friction_factor, presence_factor, friction : float
        Of all friction coefficients, and of all loads present; one coefficient for all goods, in place of contacts.
    scatter, full, p_delta : bool
        Loads scatter, or are the mean of the surveys; every floor has its design live load; second-order effects.
    design_fraction : float or None
        Fraction of the live load in all designs, in place of the code's.
    altered : str or None
        A change of the scenes, of `runs.ALTERATIONS`.
    samples : tuple of int
        Buildings of each motion, and loads of each building.
    levels, shares : tuple of float
        Intensities over that of the design, 1 and 1.5 (MCE) among them; shares of the models.
    limit, seed
        Drift ratio whose rate is asked for; seed of the samples.
    """

    sds: float
    sd1: float
    code: str
    drift_limit: float
    area: float
    roof_dead_load: float
    first_yield: float
    first_yield_sigma: float
    second_slope: float
    second_slope_sigma: float
    overstrength: float
    friction_sigma: float
    kinetic: float
    correlation: float
    most_present: float
    friction_factor: float = 1.0
    presence_factor: float = 1.0
    friction: float | None = None
    scatter: bool = True
    full: bool = False
    p_delta: bool = True
    design_fraction: float | None = None
    altered: str | None = None
    samples: tuple[int, int] = (8, 8)
    levels: tuple[float, ...] = (0.3, 0.5, 0.75, 1.0, 1.5, 2.25, 3.3)
    shares: tuple[float, ...] = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.65, 1.0, 1.5)
    limit: float = 0.02
    seed: int = 1

    @property
    def target(self) -> TargetSpectrum:
        """Design spectrum of the site."""
        return TargetSpectrum.asce7(self.sds, self.sd1)

    def fraction(self, occupancy: Occupancy) -> float:
        """Fraction of the design live load that the code has in the weight."""
        stated = self.design_fraction
        return code_fraction(self.code, occupancy.survey.use).fraction if stated is None else stated

    def designed(self, archetype: Archetype, fraction: float | None = None) -> DesignedBuilding:
        """Return the building that the code designs, with its own fraction or another one."""
        occupancy, system, storeys = archetype.occupancy, archetype.system, archetype.storeys
        dead, live = (np.full(storeys, 1e3 * load) for load in (occupancy.dead_load, occupancy.live_load))
        if storeys > 1:
            dead[-1], live[-1] = 1e3 * self.roof_dead_load, 0.0
        how: dict[str, Any] = {"fraction": self.fraction(occupancy) if fraction is None else fraction}
        how |= {"heights": occupancy.height, "area": self.area, "code_id": self.code, "drift_limit": self.drift_limit}
        how |= {"system": system.period, "deflection": system.C_d, "overstrength": self.overstrength}
        how |= {} if self.p_delta else {"gravity_load": None}
        return designed_building(dead, live, self.target, system.R, **how)

    def presence(self, occupancy: Occupancy) -> Distribution | float:
        """Share of the design live load that is on a floor."""
        if self.full:
            return 1.0
        mean = self.presence_factor * occupancy.survey.mean / occupancy.live_load
        if not self.scatter:
            return min(mean, self.most_present)
        scale = self.presence_factor / occupancy.live_load
        return bounded(occupancy.survey.distribution(self.area, scale), self.most_present)

    def friction_of(self, occupancy: Occupancy) -> Distribution | float:
        """Static friction of the goods of a building."""
        if self.friction is not None:
            return self.friction
        parts = [lognormal(self.friction_factor * mu, self.friction_sigma) for mu, _ in occupancy.contacts]
        return mixture(parts, [probability for _, probability in occupancy.contacts])


def example_file() -> Path:
    """Return the file of the archetypes that ship with the package."""
    return data_directory() / "examples" / "archetypes.toml"


def read_archetypes(path: str | os.PathLike[str] | None = None) -> tuple[tuple[Archetype, ...], Setting]:
    """Read archetypes, and the site and what varies at random, from a file (TOML or JSON; default `example_file`).

    Raises
    ------
    InvalidOption
        The file cannot be read, lacks a key or has an unknown one.

    Examples
    --------
    >>> import seismass as sm
    >>> archetypes, setting = sm.evidence.read_archetypes()
    >>> len(archetypes), archetypes[3].name, setting.code
    (29, 'light storage, 2 storeys, R 8 frame', 'asce7-10')
    """
    top = load_table(
        example_file() if path is None else as_path(path, "archetypes", InvalidOption), "archetypes", InvalidOption
    )
    top.known(("site", "design", "random", "systems", "occupancies"))
    tables = {name: _table(top, name) for name in ("site", "design", "random", "systems", "occupancies")}
    site = _positive(tables["site"], "sds_g", "sd1_g")
    design = _positive(tables["design"], "drift_limit", "area_m2", "roof_dead_load_kpa", also=("code",))
    code = tables["design"].text("code") or "asce7-10"
    random: dict[str, Any] = dict(zip(_RANDOM, _numbers(tables["random"], _RANDOM), strict=True))
    setting = Setting(site[0], site[1], code, design[0], design[1], design[2], **random)
    systems = {name: _system(tables["systems"].table(name), name, code) for name in tables["systems"].values}
    archetypes = []
    for name in tables["occupancies"].values:
        table = tables["occupancies"].table(name)
        occupancy = _occupancy(table, name)
        for entry in _buildings(table):
            if entry[1] not in systems:
                table.refuse("buildings", f"of the systems {', '.join(systems)}", str(entry[1]))
            archetypes.append(Archetype(occupancy, entry[0], systems[entry[1]]))
    if not archetypes:
        top.refuse("occupancies", "those of at least one building", "none")
    return tuple(archetypes), setting


def _table(top: Table, name: str) -> Table:
    top.needed(name)
    return top.table(name)


def _positive(table: Table, *keys: str, also: tuple[str, ...] = ()) -> list[float]:
    return _numbers(table, dict.fromkeys(keys, POSITIVE), also)


def _numbers(table: Table, needs: dict[str, Need], also: tuple[str, ...] = ()) -> list[float]:
    table.known((*needs, *also))
    return [table.number(key, need=need) for key, need in needs.items()]


def _system(table: Table, name: str, code: str) -> System:
    numbers = _positive(table, "R", "C_d", "collapse", also=("period",))
    period = table.text("period") or "other"
    code_period(code, period, height=10.0, storeys=3, s_d1=0.6)  # refuses a system that is not known
    return System(name, numbers[0], numbers[1], period, numbers[2])


def _occupancy(table: Table, name: str) -> Occupancy:
    also = ("survey", "contacts", "buildings")
    loads = _positive(table, "dead_load_kpa", "live_load_kpa", "height_m", also=also)
    contacts = _table(table, "contacts")
    parts = []
    for key in contacts.values:
        number = key.replace(".", "", 1).isdigit()
        parts.append((float(key) if number else friction_pair(key).mu_s, contacts.number(key, need=NOT_NEGATIVE)))
    return Occupancy(name, surveyed_load(table.text("survey")), loads[0], loads[1], loads[2], tuple(parts))


MOST_STOREYS: Final = 50
"""Most storeys of an archetype."""


def _buildings(table: Table) -> list[tuple[int, str]]:
    table.needed("buildings")
    rows: list[Any] = table.values["buildings"]
    for row in rows:
        if not (isinstance(row, list) and len(row) == 2 and isinstance(row[0], int) and 1 <= row[0] <= MOST_STOREYS):
            table.refuse("buildings", f'a list of [storeys, "system"], at most {MOST_STOREYS} storeys', str(row))
    return [(row[0], str(row[1])) for row in rows]
