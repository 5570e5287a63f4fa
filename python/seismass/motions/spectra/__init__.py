"""Response spectra of ground motions, elastic and inelastic, and target spectra to scale them to."""

import lazy_loader

# Names are those of __init__.pyi, imported when they are used.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

del lazy_loader
