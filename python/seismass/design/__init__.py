"""Design of shear buildings and walls: modes, spectrum analysis, lateral forces, weights, limits of codes, pushover.

Numbers of codes have their clause and say how they were checked, in the words of `seismass.codes.code_table`.
"""

import lazy_loader

# Names are those of __init__.pyi, imported when they are used.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

del lazy_loader
