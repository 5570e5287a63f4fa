"""The exit codes of the `seismass` command."""

from __future__ import annotations

from typing import Final

DONE: Final = 0
FAILED: Final = 1
BAD_INPUT: Final = 2
INTERRUPTED: Final = 130
"""After Ctrl-C, as shells give it: 128 + SIGINT."""
ANY_COMMAND: Final = {DONE: "done", BAD_INPUT: "bad input", INTERRUPTED: "interrupted"}
"""How every command may end."""
RUNS: Final = {FAILED: "a run failed"}
"""How a command that solves runs may end besides."""
