"""Animation of one run: the building sways, its goods slide, and beside it the model of a code, under the same motion.

`animate` (or `Response.animate`) gives an `Animation`: a page or a part of one (HTML with its script, no network and no
library), a GIF or an MP4.
"""

from __future__ import annotations

from seismass.animation.animation import Animation, animate

__all__ = ["Animation", "animate"]
