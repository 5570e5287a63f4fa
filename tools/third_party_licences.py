"""Writes THIRD-PARTY-LICENCES.txt: the licence texts of what is linked into the wheel and the live page.

Usage: python tools/third_party_licences.py [--check]. Crates are those of `cargo metadata` that the extension module
and the kernel of the page need to run or to be compiled; their texts are in the sources that cargo has downloaded.
Those of Rust's standard library are in the notices that a toolchain of rustup has beside it.
"""

from __future__ import annotations

import html
import json
import re
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


def told_by_rustc(*options: str) -> str:
    """Return what rustc prints."""
    return subprocess.run(["rustc", *options], cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()


def standard_library() -> tuple[list[str], list[tuple[str, str]]]:
    """Return what the notices of Rust's standard library name, a line each, and the texts: owner and text.

    Raises
    ------
    SystemExit
        The toolchain has no notices.
    """
    share = Path(told_by_rustc("--print", "sysroot")) / "share" / "doc" / "rust"
    notices = share / "COPYRIGHT-library.html"
    if not notices.is_file():
        sys.exit(f"{notices} is missing: take a toolchain of rustup with the component rust-docs or its notices")
    files, _, crates = notices.read_text(encoding="utf-8").partition('id="out-of-tree-dependencies"')
    release = told_by_rustc("--version").split()[1]
    names, found = [], []
    for block in files.split("<b>File/Directory:</b>")[1:]:
        name, licence = re.findall(r"<code>(.*?)</code>", block)[0], re.findall(r"License:</b> (.*?)</p>", block)[0]
        holders = "; ".join(re.findall(r"Copyright:</b> (.*?)</p>", block))
        where = "" if name == "." else f", {name}"
        names.append(html.unescape(f"Rust's standard library {release}{where}: {licence} ({holders})"))
    for block in crates.split("<h3>")[1:]:
        name, version = re.findall(r"(\S+?)-(\d\S*)</h3>", block)[0]
        licence = re.findall(r"License:</b> (.*?)</p>", block)[0]
        names.append(html.unescape(f"{name} {version}, for Rust's standard library: {licence}"))
        for file, text in re.findall(r"<code>([^<]*)</code></summary>\s*<pre>(.*?)</pre>", block, re.DOTALL):
            found.append((f"{name} {version} ({file})", html.unescape(text).strip()))
    # The texts of the licences themselves are files of their own, by the names that the notices use.
    words = sorted({word for name in names for word in re.split(r"[^\w.-]+", name.split(": ")[1])})
    for word in words:
        file = share / "licenses" / f"{word}.txt"
        if file.is_file():
            found.append((f"Rust's standard library ({file.name})", file.read_text(encoding="utf-8").strip()))
    return names, found


def page() -> str:
    """Return the file: what is linked, then each text once, with the crates that have it."""
    packages = linked()
    of_rust, texts_of_rust = standard_library()
    lines = [
        "seismass is MIT OR Apache-2.0. Wheel and live page contain code of these crates, or were made with them.",
        "",
        *(f"{each['name']} {each['version']}: {each['license']}" for each in packages),
        "",
        "Both contain code of Rust's standard library, and of crates for it, not all of them on every platform.",
        "",
        *of_rust,
    ]
    of_text: dict[str, list[str]] = {}
    for package in packages:
        for name, text in texts(package).items():
            of_text.setdefault(text, []).append(f"{package['name']} {package['version']} ({name})")
    for owner, text in texts_of_rust:
        of_text.setdefault(text, []).append(owner)
    for text, owners in of_text.items():
        lines += ["", "=" * 80, *owners, "-" * 80, text]
    return "\n".join(line.rstrip() for line in "\n".join(lines).splitlines()) + "\n"


if __name__ == "__main__":
    text = page()
    if "--check" in sys.argv[1:]:
        sys.exit(PAGE.read_text(encoding="utf-8") != text and f"{PAGE.name} is not current: run {Path(__file__).name}")
    PAGE.write_text(text, encoding="utf-8")
