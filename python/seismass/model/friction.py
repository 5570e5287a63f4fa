"""Friction coefficients of goods on floors, each with its source, and the bounds to compute with.

Transport rules give low design values, safe against slip. For the mass of goods the unsafe side is high friction.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Final

import polars as pl

from seismass.base.arguments import known_id
from seismass.base.errors import InvalidOption
from seismass.base.files import stored_rows
from seismass.base.values import as_number, brief, refusal

__all__ = [
    "BOUNDS_SOURCE",
    "BOUND_FACTORS",
    "FRICTION_IDS",
    "FrictionPair",
    "friction_pair",
    "friction_table",
]

__dir__ = __all__.copy  # for completion

BOUND_FACTORS: Final = (0.67, 1.5)
"""Factors of mu for its lower and upper bound, as EN 16681 has them by second-hand text: slip, and drift of racks."""
BOUNDS_SOURCE: Final = "EN 16681, second-hand"


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


_ROWS: Final = tuple(
    FrictionPair(row["id"], row["contact"], float(row["mu_s"]), float(row["mu_k"]), row["source"], row["kind"])
    for row in stored_rows("friction")
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
