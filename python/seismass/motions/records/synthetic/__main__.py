"""`python -m seismass.motions.records.synthetic DIRECTORY` writes the files of the built-in suite again."""

from __future__ import annotations

import sys
from pathlib import Path

from seismass.motions.records.synthetic.eleven import write_suite

if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write_suite(Path(sys.argv[1]))
