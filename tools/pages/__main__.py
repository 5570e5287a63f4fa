"""Writes the numbers, tables and figures of pages of docs, or says which pages are not current.

Usage: python tools/pages [--check] [NAME[.PART] ...], a module of this folder each, by default all. Parts that take
minutes are left as they are unless they are named, as in `effective_mass.far_field`; the runner says which.
Recordings are not part of this project: SEISMASS_SHARED names their folder; pages that need them are left out where it
is not set.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).parents[1])

from pages.parts import NoRecordings, made, names  # noqa: E402


def main(arguments: list[str]) -> int:
    """Write or check; 1 where a page is not current, 2 where a name or recordings are missing."""
    check, asked = "--check" in arguments, [one for one in arguments if one != "--check"] or names()
    code, parts = 0, {}
    for name, _, part in (one.partition(".") for one in asked):
        parts.setdefault(name, []).extend([part] if part else [])
    if unknown := parts.keys() - set(names()):
        print(f"no page {', '.join(sorted(unknown))}; there are {', '.join(names())}", file=sys.stderr)
        return 2
    for name, wanted in parts.items():
        try:
            page, _ = made(name, *wanted)
        except NoRecordings as error:
            print(f"{name}: {error}", file=sys.stderr)
            code = 2
            continue
        if check:
            faults = page.faults()
            code = max(code, bool(faults))
            said = [f"not current: {', '.join(faults)}" if faults else "current"]
        else:
            page.write()
            said = ["written"]
        if kept := [part for part in page.parts if part not in page.asked]:
            said.append(f"not made: {', '.join(kept)}")
        print(f"{name}: {'; '.join(said)}")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
