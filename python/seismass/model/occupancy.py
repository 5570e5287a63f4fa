"""Goods that are present on floors, as surveys find them, beside the design live load of such floors.

A code's fraction is of the design live load; surveys say how much of that load is there on an average day.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Final

import polars as pl

from seismass.base.arguments import as_word, known_id
from seismass.base.distributions import Distribution, gamma
from seismass.base.errors import InvalidOption
from seismass.base.files import stored_rows
from seismass.base.values import as_number, brief, refusal
from seismass.model.codes import Use

__all__ = [
    "OCCUPANCY_IDS",
    "STORAGE",
    "SURVEYED",
    "USUAL",
    "SurveyedLoad",
    "occupancy_table",
    "on_surveyed_goods",
    "surveyed_load",
]

__dir__ = __all__.copy  # for completion


@dataclass(frozen=True)
class SurveyedLoad:
    """The sustained part of the live load of floors of one use, as surveys find it: what is there at a time.

    Attributes
    ----------
    occupancy_id : str
        Short name, as building files take it: "storage, sustained".
    use : {"storage", "ordinary", "archive", "shop"}
        What such a floor is for a code.
    mean : float
        Mean of the sustained load (kPa).
    floor_deviation : float
        Standard deviation from floor to floor (kPa).
    point_deviation, reference_area : float
        Standard deviation within a floor (kPa) of areas of this size (m2), which a floor averages out.
    renewed : str
        Time between changes of the sustained load.
    design_load : float
        Least design live load of ASCE 7 for such floors (kPa).
    source, status : str
        Of mean and deviations: where they were read, and how they were checked.
    design_source, design_status : str
        The same of the design live load.
    """

    occupancy_id: str
    use: Use
    mean: float
    floor_deviation: float
    point_deviation: float
    reference_area: float
    renewed: str
    design_load: float
    source: str
    status: str
    design_source: str
    design_status: str

    @property
    def share(self) -> float:
        """Mean of what is there over the design live load of ASCE 7."""
        return self.mean / self.design_load

    def deviation(self, area: float = math.inf) -> float:
        """Return the standard deviation of the mean load of a floor (kPa).

        Parameters
        ----------
        area : float, default infinite
            Area of the floor (m2).

        Raises
        ------
        InvalidOption
            The area is not positive.

        Notes
        -----
        JCSS Probabilistic Model Code, part 2.2: Var[q] = sigma_V^2 + sigma_U^2 (A_0/A) kappa, A_0/A at most 1, with
        kappa = 1 for the mean of a floor.
        """
        size = as_number(area, "area", "surveyed load", InvalidOption)
        if not size > 0.0:
            raise refusal(InvalidOption, "area", "surveyed load", "positive (m2)", brief(area))
        averaged = min(1.0, self.reference_area / size)
        return math.sqrt(self.floor_deviation**2 + self.point_deviation**2 * averaged)

    def distribution(self, area: float = math.inf, factor: float = 1.0) -> Distribution:
        """Return the distribution of the mean load of a floor (kPa): a gamma distribution, as JCSS has it.

        Parameters
        ----------
        area, factor : float, optional
            Area of the floor (m2); factor of all loads: one over a design live load (kPa) gives shares of it.
        """
        times = as_number(factor, "factor", "surveyed load", InvalidOption)
        return gamma(times * self.mean, times * self.deviation(area))


_LOADS: Final = ("mean", "floor_deviation", "point_deviation", "reference_area", "design_load")
_ROWS: Final = tuple(
    SurveyedLoad(**{name: float(text) if name in _LOADS else text for name, text in row.items()})  # type: ignore[arg-type]
    for row in stored_rows("occupancy")
)
OCCUPANCY_IDS: Final[tuple[str, ...]] = tuple(row.occupancy_id for row in _ROWS)
"""Ids of the table, as building files take them."""
STORAGE: Final = "storage, sustained"
"""Occupancy with which fractions of codes for storage are compared on floors as surveyed."""
USUAL: Final = "office, sustained"
"""Occupancy of a floor of ordinary use where nothing is said."""
SURVEYED: Final[dict[str, str]] = {
    "storage": STORAGE,
    "ordinary": USUAL,
    "archive": "library, sustained",
    "shop": "retail, sustained",
}
"""Occupancy with which fractions of codes are compared, by use; car parks were not surveyed."""


def surveyed_load(occupancy_id: str) -> SurveyedLoad:
    """Return what surveys find on floors of one use.

    Parameters
    ----------
    occupancy_id : str
        One of `OCCUPANCY_IDS`, in any case.

    Raises
    ------
    InvalidOption
        The occupancy is not in the table.

    Examples
    --------
    >>> import seismass as sm
    >>> found = sm.occupancy.surveyed_load("storage, sustained")
    >>> found.mean, round(found.share, 2), round(found.deviation(1200.0), 1)
    (3.5, 0.58, 3.2)
    """
    wanted = known_id(occupancy_id, OCCUPANCY_IDS, "occupancy")
    return next(row for row in _ROWS if row.occupancy_id == wanted)


def on_surveyed_goods(fraction: float, use: Use = "storage") -> float:
    """Return a code's fraction of the design live load over the goods that surveys find there.

    It is what compares with the effective fraction of the goods present. Above 1 the code counts more than is there.

    Parameters
    ----------
    fraction : float
        Fraction of the design live load.
    use : {"storage", "ordinary", "archive", "shop"}, default "storage"
        Use of the floor, whose goods are those of `SURVEYED`.

    Raises
    ------
    InvalidOption
        The fraction is not from 0 to 1, or the use is another.

    Examples
    --------
    The 25 % of ASCE 7:

    >>> import seismass as sm
    >>> round(sm.occupancy.on_surveyed_goods(0.25), 2)
    0.43
    """
    counted = as_number(fraction, "fraction", "code", InvalidOption)
    if not 0.0 <= counted <= 1.0:
        raise refusal(InvalidOption, "fraction", "code", "from 0 to 1", f"{counted:g}")
    as_word(use, SURVEYED, "use", "code")
    return counted / surveyed_load(SURVEYED[use]).share


def occupancy_table() -> pl.DataFrame:
    """Return one row per occupancy.

    Returns
    -------
    polars.DataFrame
        The attributes of `SurveyedLoad`, and `share`.
    """
    return pl.DataFrame([asdict(row) | {"share": row.share} for row in _ROWS])
