"""How much of a building's live load acts as mass in an earthquake: exact sliding-block shear-building simulation."""

import lazy_loader

from seismass import _kernel, forks

# Names are those of __init__.pyi. NumPy, Polars and matplotlib are imported when a name needs them: a command that
# prints its help does not wait for them.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__all__ += ["__version__"]
__version__ = _kernel.VERSION

del forks, lazy_loader  # `forks` watches for forks from here on
