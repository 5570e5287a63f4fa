"""The rule for two directions, and what one direction misses, as docs/two_directions.md has them."""

from __future__ import annotations

from typing import Final

REDUCED_FRICTION: Final = 0.8
"""Factor of mu_k in the rule for two directions, between 1/sqrt(2), which two equal directions share, and 1."""
