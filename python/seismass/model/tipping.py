"""Goods that tip: the size of a block, whether it slides or rocks, and the model that stands for goods that rock.

The kernel's blocks slide and do not rock. A split of their mass stands for goods that rock and do not fall: a part
moves with the floor, the rest slides with mu = b/h.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Final, Literal, NamedTuple, TypeAlias

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.files import stored_rows
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_list, as_number, as_one_of, as_positive, brief, refusal

OWNER: Final = "block size"


@dataclass(frozen=True)
class BlockSize:
    """Size of a block in the vertical plane of the motion.

    Attributes
    ----------
    width : float
        Full width b of the base in the direction of the motion (m).
    height : float
        Full height h (m).
    centre : float or None
        Height of the centre of gravity above the floor (m); by default h/2, as in a uniform block.

    Raises
    ------
    InvalidOption
        A length is not positive, or the centre is above the top.

    Notes
    -----
    Floor acceleration a and vertical acceleration a_v (up positive) act on a block of mass m that moves with its
    floor: the force m a at the height h_c of its centre and its weight m (g + a_v), which is centred over the base.

    - It slides where m abs(a) > mu_s m (g + a_v), so where abs(a) > mu_s (g + a_v).
    - It lifts off one edge where m abs(a) h_c > m (g + a_v) b/2, so where abs(a) > (g + a_v) b/(2 h_c).

    Both limits have the factor g + a_v, so that vertical motion does not change which of them is reached first: the
    block rocks before it slides if mu_s > b/(2 h_c), which is mu_s > b/h for a uniform block (Shenton 1996, J. Eng.
    Mech. 122:690-693, for the limits of sliding and rocking from rest). A block with mu_s below that limit never
    rocks, however strong the motion: while it slides its acceleration is mu_k (g + a_v), and mu_k <= mu_s.

    Uplift is not overturning. Whether a rocking block falls depends on the motion and on its size; the kernel does
    not compute it.

    Examples
    --------
    >>> from seismass.studies.slip import BlockSize
    >>> pallet = BlockSize(1.0, 1.2)
    >>> round(pallet.uplift_g, 3), pallet.rocks_first(0.5), pallet.rocks_first(0.9)
    (0.833, False, True)
    """

    width: float
    height: float
    centre: float | None = None

    def __post_init__(self) -> None:
        width = as_positive(self.width, "width", OWNER, InvalidOption)
        height = as_positive(self.height, "height", OWNER, InvalidOption)
        object.__setattr__(self, "width", width)
        object.__setattr__(self, "height", height)
        if self.centre is not None:
            centre = as_positive(self.centre, "centre", OWNER, InvalidOption)
            if centre > height:
                raise refusal(InvalidOption, "centre", OWNER, f"at most the height, {height:g} m", f"{centre:g}")
            object.__setattr__(self, "centre", centre)

    @property
    def centre_height(self) -> float:
        """Height of the centre of gravity (m)."""
        return 0.5 * self.height if self.centre is None else self.centre

    @property
    def uplift_g(self) -> float:
        """Floor acceleration that lifts one edge without vertical motion, over g: b/(2 h_c), b/h if uniform."""
        return 0.5 * self.width / self.centre_height

    def uplift_acceleration(self, vertical: float = 0.0) -> float:
        """Return the floor acceleration (m/s2) that lifts one edge, under a vertical acceleration (m/s2, up positive).

        Zero where g + a_v is negative: the block has no contact.
        """
        return max(STANDARD_GRAVITY + float(vertical), 0.0) * self.uplift_g

    def rocks_first(self, mu_s: float) -> bool:
        """Whether the block rocks before it slides: mu_s > b/(2 h_c)."""
        return as_number(mu_s, "mu_s", "block size", InvalidOption) > self.uplift_g

    @property
    def overturning_velocity(self) -> float | None:
        """Peak floor velocity (m/s) below which a uniform block is not expected to overturn; None for others.

        Ishiyama (1982), Earthquake Eng. Struct. Dyn. 10:635-650, gives as lower limits of overturning a peak
        acceleration of g B/H together with a peak velocity of 10 B/sqrt(H) (cm and s), which is B/sqrt(H) in m and s.
        The form is from memory and was not checked in a source. It is 2 % below 0.4 times the velocity by which an
        impulse overturns a slender uniform block, sqrt(8 g R (1 - cos a)/(3 cos^2 a)) with tan a = B/H and
        2 R = sqrt(B^2 + H^2). Both limits must be exceeded, on a rigid floor; it is not a sufficient condition.
        """
        return None if self.centre is not None else float(self.width / np.sqrt(self.height))


def parse_size(text: str) -> BlockSize:
    """Return a size from its text: ``1.0x1.2``, width by height (m), or ``1.0x1.2@0.4`` with the height of its centre.

    Raises
    ------
    InvalidOption
        It cannot be read.

    Examples
    --------
    >>> from seismass.studies.slip import parse_size
    >>> parse_size("1.0x1.2@0.4")
    BlockSize(width=1.0, height=1.2, centre=0.4)
    """
    words = as_one_of(text, str, "text", "size", InvalidOption)
    parts = re.fullmatch(r"([^x@]+)x([^x@]+)(?:@([^x@]+))?", words.strip().lower())
    try:
        if parts is None:
            raise ValueError
        width, height, centre = (None if part is None else float(part) for part in parts.groups())
    except ValueError:
        raise refusal(InvalidOption, "size", "block", "WIDTHxHEIGHT or WIDTHxHEIGHT@CENTRE (m)", brief(text)) from None
    assert width is not None
    assert height is not None
    return BlockSize(width, height, centre)


def as_sizes(sizes: Any, blocks: int) -> tuple[BlockSize | None, ...]:
    """Return one size per block: one for all, or a list with None where a size is not known."""
    if sizes is None or isinstance(sizes, BlockSize):
        return (sizes,) * blocks
    requirement = f"a BlockSize, or a list of {blocks}, one per block or None"
    listed = as_list(sizes, "sizes", "slip demand", InvalidOption, requirement)
    if len(listed) != blocks or not all(size is None or isinstance(size, BlockSize) for size in listed):
        raise refusal(InvalidOption, "sizes", "slip demand", requirement, brief(sizes))
    return tuple(listed)


Tipping: TypeAlias = Literal["slide", "split", "attached"]
"""What stands for the goods of one kind: they slide; they rock, and a part of them stays with the floor; all of them
stay with the floor."""
FALLS_BELOW: Final = 0.3
"""b/h below which goods that rock may fall at the design level: of blocks 1 to 2 m high that lift off 82 % fall at 0.2
and 42 % at 0.3, of those 4 to 6 m high 32 % and 3 %. An assumption, which `rocking` of a building file replaces."""
ROCKING_PART: Final = 0.75
"""Part of the mass of a slender block that does not follow its floor while it rocks."""


def staying_part(ratio: float) -> float:
    """Return the part of a rocking block of b/h = `ratio` that moves with the floor, 1 - 0.75/(1 + (b/h)^2): m times
    1 - 0.75 cos^2 phi does, with tan phi = b/h as it lifts off (docs/rocking.md).
    """
    return 1.0 - ROCKING_PART / (1.0 + ratio * ratio)


class Falls(NamedTuple):
    """How many of single blocks of a size that lift off fall: b/h, height in words, share, and its range over single
    buildings.
    """

    ratio: float
    height: str
    highest: float
    share: float
    low: float
    high: float


FALLS: Final = tuple(
    Falls(float(row["ratio"]), row["height"], *(float(row[name]) for name in ("highest", "share", "low", "high")))
    for row in stored_rows("falls")
)
"""Falls at a design level of S_DS = 1 g, by b/h and height; made by benchmarks/rocking.py, see docs/rocking.md."""


def falls_of(ratio: float, height: float) -> Falls | None:
    """Return the row of `FALLS` with the next smaller b/h and the height (m) of a block; None where there is none."""
    rows = [row for row in FALLS if row.ratio <= ratio * (1.0 + 1e-9) and height <= row.highest]
    return max(rows, key=lambda row: (-row.highest, row.ratio), default=None)


def tipping_of(size: BlockSize | None, mu_s: float) -> Tipping:
    """Return what stands for goods of a size: "slide" where it is not known or they slide first, "split" where they
    rock, "attached" where they may fall.
    """
    if size is None or not size.rocks_first(mu_s):
        return "slide"
    return "attached" if size.uplift_g < FALLS_BELOW else "split"


def demand_in_g(acceleration: FloatArray, vertical: FloatArray | None) -> float:
    """Return the largest abs(a)/(g + a_v) of a history (m/s2, up positive, NaN after a collapse), by which friction and
    uplift are limited. Samples at which g + a_v is not positive have no contact and are left out.
    """
    weight = STANDARD_GRAVITY + (np.zeros(1) if vertical is None else vertical)
    ratio = np.where(weight > 0.0, np.abs(acceleration) / np.where(weight > 0.0, weight, 1.0), 0.0)
    return float(np.nanmax(ratio, initial=0.0))
