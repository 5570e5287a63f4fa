"""The kernel asked: one run, batches, grids of scenes, and the scenes that a file holds."""

import lazy_loader

# Names are those of __init__.pyi, imported when they are used: one run needs no Polars.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

del lazy_loader
