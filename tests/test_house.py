"""The house in order: one version, stored data where a package finds it, a README whose code runs."""

import re
import tomllib
from importlib import metadata
from pathlib import Path

import pytest

import seismass
from seismass.records.builtin import data_directory

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_one_version() -> None:
    version = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]["package"]["version"]
    assert seismass.__version__ == version
    assert metadata.version("seismass") == version
    assert f"version: {version}\n" in (ROOT / "CITATION.cff").read_text()
    assert f"## {version}" in (ROOT / "CHANGELOG.md").read_text()


def test_package_is_typed_and_finds_its_data() -> None:
    assert (Path(seismass.__file__).parent / "py.typed").is_file()
    stored = sorted(file.name for file in (data_directory() / "synthetic").iterdir())
    assert stored == ["suite.csv", *(f"synthetic-{i}.AT2" for i in range(1, 8))]


def test_every_error_is_a_seismass_error_and_the_builtin_one() -> None:
    for name in ("InvalidScene", "InvalidMotion", "InvalidOption", "RecordFormatError", "InvalidSceneFile"):
        error = getattr(seismass, name)
        assert issubclass(error, seismass.SeismassError)
        assert issubclass(error, ValueError)
    assert issubclass(seismass.SimulationError, seismass.SeismassError)
    assert issubclass(seismass.SimulationError, RuntimeError)


def test_readme_code_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The Python blocks of the README, in order, as one program in an empty folder."""
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```", README, re.MULTILINE | re.DOTALL)
    assert blocks
    exec(compile("\n".join(blocks), "README.md", "exec"), {"__name__": "readme"})


def test_readme_names_make_targets_and_commands_that_exist() -> None:
    shell = "\n".join(re.findall(r"^```sh\n(.*?)^```", README, re.MULTILINE | re.DOTALL))
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    assert set(re.findall(r"^make ([a-z-]+)", shell, re.MULTILINE)) <= targets
    commands = {file.stem.replace("_", "-") for file in (ROOT / "python/seismass/commands").glob("[a-z]*.py")}
    assert set(re.findall(r"^seismass ([a-z-]+)", shell, re.MULTILINE)) <= commands
