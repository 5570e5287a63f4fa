"""The `seismass` command: finds the subcommand, runs it, and turns what goes wrong into one line and an exit code."""

from __future__ import annotations

import contextlib
import io
import os
import signal
import sys
import threading
from collections.abc import Sequence

from seismass.base.errors import SeismassError, SimulationError
from seismass.commands.parser import BAD_INPUT, DONE, FAILED, INTERRUPTED, parse, tell


def _make_output_safe() -> None:
    """Print escapes for what an encoding lacks, and nothing to a stream that the caller has closed."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, io.StringIO())
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _end_as_by_ctrl_c() -> None:
    """Take SIGTERM and SIGHUP as Ctrl-C, so that what is half written is removed. What is ignored stays so (nohup)."""
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        in_main = threading.current_thread() is threading.main_thread()
        if in_main and number and signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, signal.default_int_handler)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit code: 0 done, 1 a run failed, 2 bad input, 130 interrupted. Nothing else
    catches errors: a command returns a code of its own where it has one, or raises.
    """
    _make_output_safe()
    _end_as_by_ctrl_c()
    words = sys.argv[1:] if arguments is None else list(arguments)
    try:
        args = parse(words)
        code: int = args.run(args)
        sys.stdout.flush()
    except BrokenPipeError:
        # The reader has gone, as with `| head`; nothing more can be printed, not even by the interpreter at its end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except (SeismassError, OSError) as error:
        from seismass.base.values import printable  # numpy, which --help does not need

        failed = isinstance(error, SimulationError)
        kind = "run failed" if failed else "error"
        tell(f"{kind}: {printable(str(error), lines=True)}")
        return FAILED if failed else BAD_INPUT
    except KeyboardInterrupt:
        # On a terminal a progress bar, or the ^C itself, has begun the line.
        # One Ctrl-C may be heard twice, by a library and by Python.
        with contextlib.suppress(KeyboardInterrupt):
            print("\n" * sys.stderr.isatty() + "seismass: interrupted", file=sys.stderr)
        return INTERRUPTED
    return code


if __name__ == "__main__":
    sys.exit(main())
