"""States the address of the repository in the metadata of the packages: wheel, crates, conda recipe and citation.

Usage: python tools/state_repository.py https://HOST/OWNER/NAME. Done once, when the repository has an
address; the changes are then committed.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).parents[1]
BRANCH: Final = "main"


def additions(address: str) -> dict[str, tuple[str, str]]:
    """Return for each file the line before the new lines, and the new lines."""
    files = f"{address}/blob/{BRANCH}"
    return {
        "pyproject.toml": (
            "[project.optional-dependencies]",
            f'[project.urls]\nRepository = "{address}"\nIssues = "{address}/issues"\n'
            f'Documentation = "{files}/docs/index.md"\nChangelog = "{files}/CHANGELOG.md"\n\n',
        ),
        "Cargo.toml": ('license = "MIT OR Apache-2.0"', f'repository = "{address}"\n'),
        "crates/seismass/Cargo.toml": ('readme = "README.md"', "repository.workspace = true\n"),
        "CITATION.cff": ("keywords:", f"repository-code: {address}\n"),
        "packaging/conda/recipe.yaml": (
            "  license: MIT OR Apache-2.0",
            f"  homepage: {address}\n  repository: {address}\n",
        ),
        "packaging/README.md": (
            "MIT or Apache 2.0, at your choice.",
            f"[Documentation]({files}/docs/index.md), [source and issues]({address}).\n\n"
            f"![The page of a building]({address}/raw/{BRANCH}/docs/figures/building_page.png)\n\n",
        ),
        "README.md": ("## Your own building", f"Issues: <{address}/issues>.\n\n"),
        "crates/seismass/README.md": ("## Licence", f"[Documentation and source of the project]({address}).\n\n"),
    }


def state(root: Path, address: str) -> None:
    """Write the address into the files below `root`.

    Raises
    ------
    SystemExit
        It is no address, or one is stated already, or a file has not the line that the address is put before.
    """
    if not re.fullmatch(r"https://[\w.-]+(/[\w.-]+)+[\w-]", address):
        raise SystemExit(f"address must be like https://HOST/OWNER/NAME, without a slash at its end; got {address}")
    changed = {}
    for name, (line, added) in additions(address).items():
        text = (root / name).read_text(encoding="utf-8")
        before, found, after = text.partition(f"\n{line}\n")
        if not found:
            raise SystemExit(f"{name} has no line {line!r}")
        if re.search(r"^ *(repository|repository-code|\[project\.urls\])", text, re.MULTILINE):
            raise SystemExit(f"{name} states an address already")
        changed[name] = f"{before}\n{added}{line}\n{after}"
    for name, text in changed.items():
        (root / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    state(ROOT, sys.argv[1])
