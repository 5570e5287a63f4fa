"""Amplitude scaling of ground motions to a target spectrum, and selection of those whose shape is closest to it."""

import lazy_loader

# Names are those of __init__.pyi, imported when they are used: an option's help needs none of them.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

del lazy_loader
