"""Writes THIRD-PARTY-LICENCES.txt: the licence texts of the crates that are linked into the wheel and the live page.

Usage: python tools/third_party_licences.py [--check]. Crates are those of `cargo metadata` that the extension module
and the kernel of the page need to run or to be compiled; their texts are in the sources that cargo has downloaded.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any, Final

ROOT: Final = Path(__file__).parents[1]
PAGE: Final = ROOT / "THIRD-PARTY-LICENCES.txt"
ROOTS: Final = ("seismass-python", "seismass-web")
NAMES: Final = ("LICENSE*", "LICENCE*", "COPYING*", "COPYRIGHT*", "NOTICE*", "UNLICENSE*")


def linked() -> list[dict[str, Any]]:
    """Return the packages that are linked, sorted by name and version, without those of this workspace."""
    command = ["cargo", "metadata", "--format-version", "1", "--locked"]
    told = json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout)
    packages = {package["id"]: package for package in told["packages"]}
    nodes = {node["id"]: node for node in told["resolve"]["nodes"]}
    left = [key for key, package in packages.items() if package["name"] in ROOTS]
    seen: set[str] = set()
    while left:
        key = left.pop()
        if key in seen:
            continue
        seen.add(key)
        left += [
            needed["pkg"]
            for needed in nodes[key]["deps"]
            if any(kind["kind"] in (None, "build") for kind in needed["dep_kinds"])
        ]
    found = [packages[key] for key in seen if packages[key]["source"] is not None]
    return sorted(found, key=lambda package: (package["name"], package["version"]))


def texts(package: dict[str, Any]) -> dict[str, str]:
    """Return the licence texts of a package by file name.

    Raises
    ------
    SystemExit
        It has none.
    """
    folder = Path(package["manifest_path"]).parent
    files = sorted({file for name in NAMES for file in folder.glob(name) if file.is_file()})
    if not files:
        sys.exit(f"{package['name']} {package['version']} ({package['license']}) has no licence text")
    return {file.name: file.read_text(encoding="utf-8").strip().replace("\r\n", "\n") for file in files}


def page() -> str:
    """Return the file: what is linked, then each text once, with the crates that have it."""
    packages = linked()
    lines = [
        "seismass is MIT OR Apache-2.0. Wheel and live page contain code of these crates, or were made with them.",
        "",
        *(f"{each['name']} {each['version']}: {each['license']}" for each in packages),
    ]
    of_text: dict[str, list[str]] = {}
    for package in packages:
        for name, text in texts(package).items():
            of_text.setdefault(text, []).append(f"{package['name']} {package['version']} ({name})")
    for text, owners in of_text.items():
        lines += ["", "=" * 80, *owners, "-" * 80, text]
    return "\n".join(line.rstrip() for line in "\n".join(lines).splitlines()) + "\n"


if __name__ == "__main__":
    text = page()
    if "--check" in sys.argv[1:]:
        sys.exit(PAGE.read_text(encoding="utf-8") != text and f"{PAGE.name} is not current: run {Path(__file__).name}")
    PAGE.write_text(text, encoding="utf-8")
