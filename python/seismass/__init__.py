"""How much of a building's live load acts as mass in an earthquake: exact sliding-block shear-building simulation.

At the top stands what a first hour needs. The rest is in modules: `records`, `spectra`, `scaling`, `matching`,
`pulses`, `design`, `runs`, `fragility`, `slip`, `risk`, `campaign`, `study`, `validation`, `plots`, `explore`, `codes`,
`friction`, `occupancy`, `distributions` and `errors`.
"""

import lazy_loader

from seismass import _kernel
from seismass.base import fork_check, views

# Names are those of __init__.pyi. NumPy, Polars and matplotlib are imported when a name needs them: a command that
# prints its help does not wait for them.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
__all__ += ["__version__"]
__version__ = _kernel.VERSION

# Values are declared below what shows them; this is where the declarations find it.
views.made_in("seismass.show")

del fork_check, lazy_loader, views  # `fork_check` watches for fork_check from here on
