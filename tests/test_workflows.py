"""Workflows of releases have valid keys, and what a wheel links has its licence beside it."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))


def test_workflows_are_valid() -> None:
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", "vendor.github-workflows"]
    checked = subprocess.run([*command, *map(str, WORKFLOWS)], capture_output=True, text=True, timeout=120)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert len(WORKFLOWS) == 2


def test_every_linked_crate_has_its_licence_in_the_file() -> None:
    text = (ROOT / "THIRD-PARTY-LICENCES.txt").read_text(encoding="utf-8")
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert "THIRD-PARTY-LICENCES.txt" in project["license-files"]
    if shutil.which("cargo") is None:
        pytest.skip("no cargo")
    command = ["cargo", "tree", "--locked", "--target", "all", "--edges", "normal", "--prefix", "none"]
    command += ["-p", "seismass-python", "-p", "seismass-web"]
    tree = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True, timeout=300).stdout
    linked = {tuple(match) for match in re.findall(r"^(\S+) v(\S+)", tree, re.MULTILINE)}
    linked = {(name, version) for name, version in linked if not name.startswith("seismass")}
    assert len(linked) > 20
    for name, version in sorted(linked):
        assert f"\n{name} {version}: " in text, "run tools/third_party_licences.py"
        assert re.search(rf"^{re.escape(name)} {re.escape(version)} \(", text, re.MULTILINE), (name, version)


def test_what_an_index_shows_has_no_relative_links() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    crate = tomllib.loads((ROOT / "crates" / "seismass" / "Cargo.toml").read_text(encoding="utf-8"))["package"]
    for shown in (ROOT / project["readme"], ROOT / "crates" / "seismass" / crate["readme"]):
        targets = re.findall(r"\]\(([^)]*)\)", shown.read_text(encoding="utf-8"))
        assert not [target for target in targets if not target.startswith("https://")], shown


def test_the_recipe_needs_what_the_package_needs() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    recipe = (ROOT / "packaging" / "conda" / "recipe.yaml").read_text(encoding="utf-8")
    for needed in project["dependencies"]:
        name, bounds = re.fullmatch(r"([A-Za-z0-9_]+)(>.*)", needed).groups()  # type: ignore[union-attr]
        own = {"lazy_loader": "lazy-loader", "matplotlib": "matplotlib-base"}.get(name, name)
        assert f"- {own} {bounds}" in recipe, own
    version = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]["version"]
    assert f'version: "{version}"' in recipe
