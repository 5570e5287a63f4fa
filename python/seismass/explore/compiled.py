"""The kernel of the live page, compiled to WebAssembly: a product of the build, beside this file where there is one."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from seismass.base.errors import MissingPackage

NAME: Final = "seismass_web.wasm"
"""Name of the compiled kernel, as `tools/make-web-kernel` writes it."""


def kernel_file() -> Path:
    """Return the compiled kernel of the live page.

    Raises
    ------
    MissingPackage
        This installation has none.
    """
    path = Path(__file__).parent / NAME
    if not path.is_file():
        raise MissingPackage(
            "kernel of the live page must be compiled to WebAssembly: `make explorer` in a clone of the project does "
            f"that, and wheels of releases carry it; got no {path}"
        )
    return path
