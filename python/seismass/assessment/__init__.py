"""Assessment of your own building: how much of its live load to count as mass, and what its drifts and slips are."""

import lazy_loader

# Names are those of __init__.pyi, imported when they are used.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

del lazy_loader
