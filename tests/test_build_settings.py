"""Cargo's profiles: no setting under which the kernel is slow without a word. What environments need is listed."""

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parent.parent
UNITS = {"dev": 256, "test": 256, "release": 16, "bench": 16}
"""Cargo's defaults of `codegen-units` (The Cargo Book, Profiles)."""
PARENTS = {"test": "dev", "bench": "release"}


def resolved(profiles: dict[str, dict[str, Any]], name: str) -> dict[str, Any]:
    """Settings of a profile over those that it inherits, down to Cargo's default of units."""
    own = profiles.get(name, {})
    parent = own.get("inherits", PARENTS.get(name))
    below = resolved(profiles, parent) if parent else {"codegen-units": UNITS[name]}
    return below | own


def uninlined(profiles: dict[str, dict[str, Any]]) -> list[str]:
    """Return the profiles in which no function is inlined from one codegen unit into another."""
    found = []
    for name in sorted(UNITS.keys() | profiles.keys()):
        settings = resolved(profiles, name)
        if settings.get("lto") == "off" and settings["codegen-units"] != 1:
            found.append(name)
    return found


@pytest.mark.parametrize(
    ("profiles", "expected"),
    [
        ({}, []),
        ({"release": {"lto": "thin", "codegen-units": 1}}, []),
        ({"release": {"lto": "off", "codegen-units": 1}}, []),
        ({"release": {"lto": "off"}}, ["bench", "release"]),
        ({"release": {"lto": "off"}, "dist": {"inherits": "release", "lto": "thin"}}, ["bench", "release"]),
        ({"release": {"lto": "off"}, "dist": {"inherits": "release"}}, ["bench", "dist", "release"]),
        ({"release": {"codegen-units": 1}, "dist": {"inherits": "release", "lto": "off"}}, []),
        ({"test": {"lto": "off"}}, ["test"]),
    ],
)
def test_profiles_without_inlining_across_units_are_found(
    profiles: dict[str, dict[str, Any]], expected: list[str]
) -> None:
    assert uninlined(profiles) == expected


def test_every_profile_inlines_across_units() -> None:
    for file in ("Cargo.toml", ".cargo/config.toml", ".cargo/config"):
        path = ROOT / file
        if path.is_file():
            assert uninlined(tomllib.loads(path.read_text()).get("profile", {})) == [], file


def test_wheels_that_are_given_away_are_built_by_the_profile_dist() -> None:
    manifest = tomllib.loads((ROOT / "Cargo.toml").read_text())
    assert resolved(manifest["profile"], "dist")["strip"] is True
    assert "--profile dist" in (ROOT / "tools" / "make-wheels").read_text()


def test_the_environment_of_the_benchmarks_has_what_the_package_needs() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    needed = {re.split(r"[<>=]", text)[0].lower() for text in project["dependencies"]}
    listed = (ROOT / "benchmarks" / "requirements.txt").read_text(encoding="utf-8").splitlines()
    found = {re.split(r"[<>=;]", line)[0].strip().lower() for line in listed if not line.lstrip().startswith("#")}
    assert needed <= found


def test_crates_have_no_dependency_that_they_do_not_name() -> None:
    """What benchmarks alone need stays out of the dependencies of tests."""
    for manifest in ROOT.glob("crates/*/Cargo.toml"):
        crate = tomllib.loads(manifest.read_text(encoding="utf-8"))
        parts = {
            "dependencies": ("src",),
            "build-dependencies": ("build.rs",),
            "dev-dependencies": ("src", "tests", "benches", "examples"),
        }
        for kind, places in parts.items():
            files = [
                path
                for place in places
                for path in (manifest.parent / place, *manifest.parent.glob(f"{place}/**/*.rs"))
            ]
            text = "\n".join(path.read_text(encoding="utf-8") for path in files if path.is_file())
            unnamed = [name for name in crate.get(kind, {}) if not re.search(rf"\b{name.replace('-', '_')}\b", text)]
            assert not unnamed, f"{kind} of {manifest.parent.name}"


def test_benchmarks_are_built_when_asked_for_alone() -> None:
    workspace = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]
    assert "crates/seismass-bench" in set(workspace["members"]) - set(workspace["default-members"])
    tests = [line for line in (ROOT / "Makefile").read_text(encoding="utf-8").splitlines() if "cargo test" in line]
    assert tests and all("--exclude seismass-bench" in line for line in tests if "--workspace" in line)
