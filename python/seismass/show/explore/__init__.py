"""The live page: the exact kernel, compiled to WebAssembly, solves a building with sliding goods while a slider moves.

`explorer_html` makes one file that needs no other file: no network, no installation. It needs the compiled kernel,
which a wheel of a release carries and `make explorer` builds.
"""

from __future__ import annotations

from seismass.show.explore.page import explorer_html, kernel_file

__all__ = ["explorer_html", "kernel_file"]

__dir__ = __all__.copy  # for completion
