"""Workflows of releases have valid keys, and what a wheel links has its licence beside it."""

from __future__ import annotations

import re
import runpy
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
    assert len(WORKFLOWS) == 3


def test_every_action_is_pinned_by_its_digest() -> None:
    """A tag can be moved to other code; the version that a digest has stands behind it."""
    uses = [line.strip() for file in WORKFLOWS for line in file.read_text("utf-8").splitlines() if "uses:" in line]
    assert len(uses) > 10
    assert [line for line in uses if not re.search(r"uses: [\w.-]+/[\w./-]+@[0-9a-f]{40} # v\d", line)] == []


def test_actionlint_finds_nothing() -> None:
    """Where it is on the path: its binary is not in a package of its own project that pip could install."""
    program = shutil.which("actionlint")
    if program is None:
        pytest.skip("no actionlint on the path: workflows are checked by their schema alone")
    checked = subprocess.run([program, *map(str, WORKFLOWS)], cwd=ROOT, capture_output=True, text=True, timeout=120)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_every_linked_crate_has_its_licence_in_the_file() -> None:
    text = (ROOT / "THIRD-PARTY-LICENCES.txt").read_text(encoding="utf-8")
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert "THIRD-PARTY-LICENCES.txt" in project["license-files"]
    if shutil.which("cargo") is None or subprocess.run(["cargo", "--version"], capture_output=True).returncode:
        pytest.skip("no cargo on the path, or none that runs: the crates that are linked are not listed")
    command = ["cargo", "tree", "--locked", "--target", "all", "--edges", "normal", "--prefix", "none"]
    command += ["-p", "seismass-python", "-p", "seismass-web"]
    tree = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True, timeout=300).stdout
    linked = {tuple(match) for match in re.findall(r"^(\S+) v(\S+)", tree, re.MULTILINE)}
    linked = {(name, version) for name, version in linked if not name.startswith("seismass")}
    assert len(linked) > 20
    for name, version in sorted(linked):
        assert f"\n{name} {version}: " in text, "run tools/third_party_licences.py"
        assert re.search(rf"^{re.escape(name)} {re.escape(version)} \(", text, re.MULTILINE), (name, version)


def test_audit_allows_the_licences_that_are_linked_and_the_index_alone() -> None:
    """Linked crates are in the file of texts; where cargo-deny is, it judges the whole lock file."""
    deny = tomllib.loads((ROOT / "deny.toml").read_text(encoding="utf-8"))
    assert deny["sources"] == {"unknown-registry": "deny", "unknown-git": "deny"}
    assert deny["advisories"]["ignore"] == []
    names, _, _ = (ROOT / "THIRD-PARTY-LICENCES.txt").read_text(encoding="utf-8").partition("\nBoth contain code")
    stated = re.findall(r"^\S+ \d\S*: (.*)$", names, re.MULTILINE)
    assert len(stated) > 20
    allowed = {name.partition(" WITH ")[0] for name in deny["licenses"]["allow"]}
    for expression in stated:
        needed = re.sub(r" WITH \S+", "", expression.replace("/", " OR ")).replace("(", "").replace(")", "")
        for part in needed.split(" AND "):
            assert allowed & set(part.split(" OR ")), expression
    if shutil.which("cargo-deny") is None:
        pytest.skip("no cargo-deny on the path: the configuration is held against the licences of linked crates alone")
    command = ["cargo-deny", "--locked", "--offline", "check", "bans", "licenses", "sources"]
    checked = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_workflow_of_the_audit_does_what_make_audit_does() -> None:
    workflow = (ROOT / ".github" / "workflows" / "audit.yml").read_text(encoding="utf-8")
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    assert "make audit-packages" in workflow
    assert "cargo deny --locked check" in makefile
    assert re.search(r"command: check\n\s+arguments: --locked", workflow)
    groups = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["dependency-groups"]
    assert [name.partition("==")[0] for name in groups["audit"]] == ["pip-audit"]


def test_rusts_standard_library_has_its_licences_in_the_file() -> None:
    text = (ROOT / "THIRD-PARTY-LICENCES.txt").read_text(encoding="utf-8")
    names, _, texts = text.partition("=" * 80)
    for name in ("Rust's standard library", "hashbrown", "rustc-demangle", "windows_x86_64_msvc"):
        assert re.search(rf"^{name}.*: .*(MIT|Apache-2.0)", names, re.MULTILINE), name
    for owner in ("Rust's standard library (MIT.txt)", "Rust's standard library (Unicode-3.0.txt)", "hashbrown"):
        assert re.search(rf"^{re.escape(owner)}", texts, re.MULTILINE), owner


def test_address_of_the_repository_is_stated_everywhere_or_nowhere(tmp_path: Path) -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "state_repository.py"))
    address = "https://example.org/owner/seismass"
    for name in tool["additions"](address):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    before = {name: (tmp_path / name).read_text(encoding="utf-8") for name in tool["additions"](address)}
    with pytest.raises(SystemExit, match="must be like"):
        tool["state"](tmp_path, f"{address}/")
    tool["state"](tmp_path, address)
    urls = tomllib.loads((tmp_path / "pyproject.toml").read_text(encoding="utf-8"))["project"]["urls"]
    assert urls["Repository"] == address
    assert set(urls) == {"Repository", "Issues", "Documentation", "Changelog"}
    workspace = tomllib.loads((tmp_path / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]
    assert workspace["package"]["repository"] == address
    crate = tomllib.loads((tmp_path / "crates" / "seismass" / "Cargo.toml").read_text(encoding="utf-8"))["package"]
    assert crate["repository"] == {"workspace": True}
    for name, text in before.items():
        stated = (tmp_path / name).read_text(encoding="utf-8")
        assert stated != text
        kept = iter(stated.splitlines())
        assert all(line in kept for line in text.splitlines()), name  # lines were added, and none changed
    with pytest.raises(SystemExit, match="states an address already"):
        tool["state"](tmp_path, address)


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
