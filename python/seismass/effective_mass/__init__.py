"""The effective fraction of live load: the share of a building's goods that acts as mass in an earthquake."""

import lazy_loader

# Names are those of __init__.pyi, imported when they are used.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

del lazy_loader
