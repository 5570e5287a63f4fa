"""What the study of docs/two_directions.md found: the rule for two directions, and what one direction misses of slip.

Numbers are those of its 18 far-field pairs; a test compares them with the stored cases.
"""

from __future__ import annotations

from typing import Final

from seismass.model.scene import Scene

REDUCED_FRICTION: Final = 0.8
"""Factor of mu_k in the rule for two directions, between 1/sqrt(2), which two equal directions share, and 1."""
SLIP_IN_EACH: Final = (1.25, 1.1, 3.0)
"""Peak slip in a direction over that of the direction alone: of all cases in sum, the smallest and the largest case."""
SLIP_LENGTH: Final = 1.8
"""The same in sum of the length of the peak slip."""


def friction_factor(scene: Scene) -> float:
    """Return the factor of mu_k in the rule for a scene: 1 in one direction."""
    return 1.0 if scene.other_direction is False else REDUCED_FRICTION


def one_direction_of_slip() -> str:
    """Return the sentence on slip that stands where there is one direction."""
    total, low, high = SLIP_IN_EACH
    return (
        "one direction underestimates slip: with the second component of recorded pairs peak slips in each direction "
        f"are {total:g} times those of one in sum ({low:g} to {high:g} by case, most where goods hardly slide; "
        f"docs/two_directions.md), their length {SLIP_LENGTH:g} times; give two directions and pairs where there are"
    )
