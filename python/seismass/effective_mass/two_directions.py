"""What the study of docs/two_directions.md found: the rule for two directions, and what one direction misses of slip.

Numbers are those of its 18 far-field pairs; a test compares them with the stored cases.
"""

from __future__ import annotations

from typing import Final

from seismass.model.scene import Scene

REDUCED_FRICTION: Final = 0.8
"""Factor of mu_k in the rule for two directions, between 1/sqrt(2), which two equal directions share, and 1."""
SLIP_IN_EACH: Final = (1.2, 1.0, 1.5)
"""Peak slip in a direction over that of the direction alone: mean of the cases, the smallest and the largest."""
SLIP_LENGTH: Final = 1.6
"""Mean of the length of the peak slip over the peak slip of one direction."""


def friction_factor(scene: Scene) -> float:
    """Return the factor of mu_k in the rule for a scene: 1 in one direction."""
    return 1.0 if scene.other_direction is False else REDUCED_FRICTION


def one_direction_of_slip() -> str:
    """Return the sentence on slip that stands where there is one direction."""
    mean, low, high = SLIP_IN_EACH
    return (
        f"one direction underestimates slip: with the second component of recorded pairs peak slips in each direction "
        f"are {mean:g} times those of one ({low:g} to {high:g} in the cases of docs/two_directions.md), and their "
        f"length {SLIP_LENGTH:g} times; give two directions and pairs where there are"
    )
