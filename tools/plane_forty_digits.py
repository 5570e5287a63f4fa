"""Solves small plane scenes with forty digits and keeps them with their results in tests/data/plane_forty_digits.json.

Usage: python tools/plane_forty_digits.py [--check] [SEED ...]. Without seeds it solves all scenes that are kept and
writes the file, in some two minutes. With --check it writes nothing: it solves them again with fifty-four digits and
series of higher order, and prints how far the numbers that are kept differ from that.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from decimal import Decimal
from pathlib import Path
from typing import Any, Final

ROOT: Final = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tools"))

from forty_digits.model import Precision  # noqa: E402
from forty_digits.run import solve  # noqa: E402
from forty_digits.scenes import scene  # noqa: E402

KEPT: Final = ROOT / "tests" / "data" / "plane_forty_digits.json"
SEEDS: Final = (3, 9, 13, 30, 34, 44, 46, 48, 51, 54, 57, 63, 77, 81, 87, 92, 95, 99, 103, 172)
"""Seeds whose scenes have a stop, a near miss, and starts of both kinds: with mu_s > mu_k, and with equal ones."""
FINER: Final = Precision(54, 54, Decimal("1e-37"), Decimal("1e-34"), Decimal("1e-42"))


def entry(seed: int) -> dict[str, Any]:
    """Return a scene with its result."""
    made = scene(seed)
    return {"seed": seed, "scene": made, "result": solve(made)}


def numbers(result: Any) -> Iterator[Decimal]:
    """Yield the numbers of a result, which are texts."""
    for value in result.values() if isinstance(result, dict) else result:
        if isinstance(value, (dict, list)):
            yield from numbers(value)
        elif isinstance(value, str) and value[-1:].isdigit():
            yield Decimal(value)


def difference(kept: dict[str, Any]) -> Decimal:
    """Return the largest difference from a run with more digits, relative to the largest number of its kind."""
    finer = solve(kept["scene"], FINER)
    worst = Decimal(0)
    for key, values in kept["result"].items():
        if isinstance(values, list):
            pairs = list(zip(numbers(values), numbers(finer[key]), strict=True))
            largest = max(abs(value) for value, _ in pairs)
            worst = max(worst, max(abs(one - other) for one, other in pairs) / largest)
    return worst


def main() -> int:
    """Solve, and write or check."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare what is kept with runs of more digits")
    parser.add_argument("seeds", type=int, nargs="*", metavar="SEED", help="only these scenes, which are printed")
    given = parser.parse_args()
    with ProcessPoolExecutor() as workers:
        if given.check:
            kept = [one for one in json.loads(KEPT.read_text()) if not given.seeds or one["seed"] in given.seeds]
            for one, worst in zip(kept, workers.map(difference, kept), strict=True):
                print(f"{one['seed']:4d} {worst:.1e}", flush=True)
            return 0
        entries = list(workers.map(entry, given.seeds or SEEDS))
    if given.seeds:
        print(json.dumps(entries, indent=1))
    else:
        KEPT.write_text("[\n" + ",\n".join(map(json.dumps, entries)) + "\n]\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
