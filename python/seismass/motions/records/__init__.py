"""Ground motion records: reading them, gathering them to suites and pairs, and the built-in synthetic suite."""

import lazy_loader

# Names are those of __init__.pyi, imported when they are used: one motion needs no reader.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

del lazy_loader
