"""Friction coefficients of goods on floors, each with its source, and the bounds to compute with.

Transport rules give low design values, safe against slip. For the mass of goods the unsafe side is high friction.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Final

import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.values import as_number, brief, known_id, refusal

__all__ = [
    "BOUNDS_SOURCE",
    "BOUND_FACTORS",
    "FRICTION_IDS",
    "FrictionPair",
    "friction_pair",
    "friction_table",
]


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return list(__all__)


BOUND_FACTORS: Final = (0.67, 1.5)
"""Factors of mu for its lower and upper bound, as EN 16681 has them by second-hand text: slip, and drift of racks."""
BOUNDS_SOURCE: Final = "EN 16681, second-hand"

_UNECE: Final = "UNECE CTU Code, appendix 2; kinetic 75 % of static as it says"
_TESTS: Final = "pull tests"
_TRANSPORT: Final = "transport rule: low design value"
_HANDBOOK: Final = "handbook value: its tests are not stated"


@dataclass(frozen=True)
class FrictionPair:
    """Friction of one contact.

    Attributes
    ----------
    pair_id : str
        Short name, as options and files take it: "timber-on-steel".
    contact : str
        What lies on what.
    mu_s, mu_k : float
        Static and kinetic coefficient; equal where the source does not tell them apart.
    source : str
        Where they were read.
    kind : str
        What the numbers are: of tests, low design values of a transport rule, of a handbook, or an assumption.
    """

    pair_id: str
    contact: str
    mu_s: float
    mu_k: float
    source: str
    kind: str

    def bounds(self, factors: tuple[float, float] = BOUND_FACTORS) -> tuple[float, float]:
        """Return lower and upper bound of the static coefficient.

        Parameters
        ----------
        factors : tuple of float, optional
            Of the lower and the upper bound, the first from 0 to 1, the second at least 1.

        Raises
        ------
        InvalidOption
            The factors are not two such numbers.
        """
        low, high = bound_factors(factors, "friction pair")
        return low * self.mu_s, high * self.mu_s


def _unece(pair_id: str, contact: str, mu_s: float) -> FrictionPair:
    return FrictionPair(pair_id, contact, mu_s, round(0.75 * mu_s, 12), _UNECE, _TRANSPORT)


_ROWS: Final = (
    FrictionPair(
        "pallet-on-wire-deck",
        "wooden pallet on the wire deck of a rack",
        0.41,
        0.41,
        "Sideris, Filiatrault et al. 2010: 0.37 to 0.45, type not split; the middle",
        _TESTS,
    ),
    FrictionPair(
        "pallet-on-steel-beam",
        "wooden pallet on a steel rack beam",
        0.37,
        0.37,
        "a public design program for racks, second-hand",
        "design value",
    ),
    _unece("timber-on-plywood", "sawn timber or pallet on plywood", 0.45),
    _unece("timber-on-aluminium", "sawn timber or pallet on grooved aluminium", 0.40),
    _unece("timber-on-stainless", "sawn timber or pallet on stainless sheet", 0.30),
    _unece("timber-on-shrink-film", "sawn timber or pallet on shrink film", 0.30),
    FrictionPair(
        "timber-on-steel",
        "sawn timber on steel",
        0.40,
        0.30,
        "EU guideline on cargo securing",
        _TRANSPORT,
    ),
    FrictionPair(
        "timber-on-steel-beam",
        "timber on a steel beam",
        0.30,
        0.30,
        "Containerhandbuch; kinetic not stated",
        _TRANSPORT,
    ),
    _unece("plastic-pallet-on-plywood", "plastic pallet on plywood", 0.20),
    _unece("plastic-pallet-on-aluminium", "plastic pallet on aluminium", 0.15),
    _unece("plastic-pallet-on-stainless", "plastic pallet on stainless sheet", 0.15),
    _unece("cardboard-on-cardboard", "cardboard on cardboard", 0.50),
    _unece("cardboard-on-pallet", "cardboard on a wooden pallet", 0.50),
    _unece("big-bag-on-pallet", "big bag on a pallet", 0.40),
    _unece("steel-crate-on-plywood", "steel crate on plywood", 0.45),
    _unece("steel-crate-on-aluminium", "steel crate on aluminium", 0.30),
    _unece("steel-crate-on-stainless", "steel crate on stainless sheet", 0.20),
    _unece("metal-on-metal-rough", "metal on metal, rough and bare", 0.40),
    _unece("metal-on-metal-painted", "metal on metal, rough and painted", 0.30),
    _unece("metal-on-metal-smooth", "metal on metal, smooth", 0.20),
    _unece("concrete-on-timber", "rough concrete on sawn wood, also a pallet on rough concrete", 0.70),
    FrictionPair(
        "coil-on-skid",
        "coil on a wooden skid",
        0.40,
        0.40,
        "Containerhandbuch; kinetic not stated",
        _TRANSPORT,
    ),
    FrictionPair(
        "container-validation",
        "container on a deck, as the 16WCEE paper takes it for its validation",
        0.30,
        0.30,
        "16WCEE paper, section 4; no measurement of this contact was found",
        "assumption",
    ),
    FrictionPair(
        "container-study",
        "container on a deck, as the 16WCEE paper takes it for its study",
        0.40,
        0.40,
        "16WCEE paper, section 5; no measurement of this contact was found",
        "assumption",
    ),
    FrictionPair(
        "book-on-metal-shelf",
        "books on a painted steel shelf",
        0.35,
        0.35,
        "no measurement of this contact was found; between smooth metal on metal (0.2) and cardboard on wood (0.5)",
        "assumption",
    ),
    FrictionPair(
        "steel-on-concrete",
        "steel plate on concrete that was cast against it, dry",
        0.57,
        0.57,
        "Rabbat and Russell 1985, J. Struct. Eng. 111(3), abstract: 0.57 to 0.70, advised 0.57 dry, 0.65 wet; "
        "kinetic not stated",
        "push-off tests",
    ),
    FrictionPair(
        "ptfe-slider-on-steel",
        "PTFE pad or slider on polished steel, dry and slow",
        0.05,
        0.05,
        "TRL report LR491, abstract: 0.03 to 0.07 in the long term; the middle; it grows with speed (Campbell 1990, "
        "Transportation Research Record 1275, abstract)",
        "tests of bridge bearings",
    ),
    FrictionPair(
        "felt-pad-on-metal",
        "felt pad on steel or cast iron, dry",
        0.22,
        0.22,
        "roymech.org, table of clutch linings; kinetic not stated; felt on floors was not found",
        _HANDBOOK,
    ),
    FrictionPair(
        "wheel-on-rail",
        "steel wheels that turn freely on steel rails, along the rails",
        0.002,
        0.002,
        "engineeringarchives.com: 0.002 to 0.003; Engineering Toolbox, second-hand: 0.001 to 0.002; bearings besides",
        _HANDBOOK,
    ),
)

FRICTION_IDS: Final = tuple(row.pair_id for row in _ROWS)
"""Short names of all contacts."""


def friction_pair(pair_id: str) -> FrictionPair:
    """Return the friction of a contact.

    Parameters
    ----------
    pair_id : str
        One of `FRICTION_IDS`, in any case: "timber-on-steel", "pallet-on-wire-deck", ...

    Raises
    ------
    InvalidOption
        The contact is not in the table; the message names the closest ones.

    Examples
    --------
    >>> import seismass as sm
    >>> pair = sm.friction.friction_pair("timber-on-steel")
    >>> pair.mu_s, pair.mu_k
    (0.4, 0.3)
    """
    return _ROWS[FRICTION_IDS.index(known_id(pair_id, FRICTION_IDS, "friction pair", hints=3))]


def friction_table(factors: tuple[float, float] = BOUND_FACTORS) -> pl.DataFrame:
    """Return one row per contact.

    Parameters
    ----------
    factors : tuple of float, optional
        Of the lower and the upper bound; by default those of EN 16681, second-hand.

    Returns
    -------
    polars.DataFrame
        Columns `pair_id`, `contact`, `mu_s`, `mu_k`, `mu_low`, `mu_high` (bounds of the static coefficient),
        `source`, `kind`.

    Raises
    ------
    InvalidOption
        The factors are not two numbers around 1.
    """
    low, high = bound_factors(factors, "friction pair")
    return pl.DataFrame([asdict(pair) for pair in _ROWS]).select(
        "pair_id",
        "contact",
        "mu_s",
        "mu_k",
        (low * pl.col("mu_s")).alias("mu_low"),
        (high * pl.col("mu_s")).alias("mu_high"),
        "source",
        "kind",
    )


def bound_factors(factors: Any, owner: str) -> tuple[float, float]:
    """Return factors of the lower and the upper bound of friction, judged."""
    requirement = "two factors, the first above 0 and at most 1, the second at least 1 and finite"
    if not isinstance(factors, tuple | list) or len(factors) != 2:
        raise refusal(InvalidOption, "mu_factors", owner, requirement, brief(factors))
    low, high = (as_number(value, "mu_factors", owner, InvalidOption) for value in factors)
    if not 0.0 < low <= 1.0 <= high < float("inf"):
        raise refusal(InvalidOption, "mu_factors", owner, requirement, brief(factors))
    return low, high
