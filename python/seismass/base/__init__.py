"""What any program needs: errors, units, checks of arguments, files, forks. It knows nothing of buildings."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

del lazy_loader
