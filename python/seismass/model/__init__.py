"""Things of the field as values: building, goods, springs, damping, ground motion, live load fractions of codes."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

del lazy_loader
