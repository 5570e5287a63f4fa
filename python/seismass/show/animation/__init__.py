"""Animation of one run: the building sways, its goods slide, and beside it the model of a code, under the same motion.

`animate` (or `Response.animate`) gives an `Animation`: a page or a part of one (HTML with its script, no network and no
library), a GIF or an MP4. `animate_plane` shows a run in two directions.
"""

from __future__ import annotations

from seismass.show.animation.animation import Animation, PlaneAnimation, animate, animate_plane

__all__ = ["Animation", "PlaneAnimation", "animate", "animate_plane"]

__dir__ = __all__.copy  # for completion
