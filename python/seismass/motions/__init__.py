"""Ground motions: records, spectra, scaling to a target, matching, pulses. No building, no goods."""

import lazy_loader

# Names are those of __init__.pyi, imported when they are used.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

del lazy_loader
