"""The subcommands of `seismass`, one module each: `add_parser(subparsers)` and `run(args)`, an exit code."""
