"""`python -m seismass`, which is the command `seismass`."""

import sys

from seismass.cli import main

sys.exit(main())
