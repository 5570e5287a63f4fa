"""The house in order: one version, stored data where a package finds it, a README whose code runs."""

import re
import shlex
import subprocess
import sys
import tomllib
from importlib import metadata
from pathlib import Path

import pytest

import seismass
from seismass.cli import COMMANDS, build_parser, main
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
    assert stored == sorted(["seven.csv", "suite.csv", *(f"synthetic-{i}.AT2" for i in range(1, 12))])


def test_every_error_is_a_seismass_error_and_the_builtin_one() -> None:
    for name in ("InvalidScene", "InvalidMotion", "InvalidOption", "RecordFormatError", "InvalidSceneFile"):
        error = getattr(seismass, name)
        assert issubclass(error, seismass.SeismassError)
        assert issubclass(error, ValueError)
    assert issubclass(seismass.SimulationError, seismass.SeismassError)
    assert issubclass(seismass.SimulationError, RuntimeError)


def test_import_leaves_what_is_slow_to_import_for_when_it_is_used() -> None:
    """`import seismass` in a fresh process brings NumPy and Polars, and no SciPy, Matplotlib or PyWavelets."""
    program = "import sys, seismass; print(*sorted({name.partition('.')[0] for name in sys.modules}))"
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout.split()
    assert {"numpy", "polars"} <= set(found)
    assert not {"scipy", "matplotlib", "pywt"} & set(found)


def test_readme_code_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The Python blocks of the README, in order, as one program in an empty folder."""
    monkeypatch.chdir(tmp_path)
    blocks = code_blocks("python")
    assert blocks
    exec(compile("\n".join(blocks), "README.md", "exec"), {"__name__": "readme"})


@pytest.mark.parametrize("page", ["grid.md", "campaign.md"])
def test_code_of_pages_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, page: str) -> None:
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    assert blocks
    exec(compile("\n".join(blocks), page, "exec"), {"__name__": "page"})


def code_blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", README, re.MULTILINE | re.DOTALL)


def test_readme_names_make_targets_that_exist() -> None:
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    named = set(re.findall(r"^make ([a-z-]+)", "\n".join(code_blocks("sh")), re.MULTILINE))
    assert named
    assert named <= targets


EPILOGS = {f"{command.__name__} --help": command._EPILOG for command in COMMANDS}


@pytest.mark.parametrize("place", ["README", *EPILOGS])
def test_commands_are_ones_that_the_parser_takes(place: str) -> None:
    """Every line of the README's shell blocks, and of the examples that --help prints."""
    text = EPILOGS.get(place) or "\n".join(code_blocks("sh"))
    lines = re.findall(r"^ *seismass (.*)$", text, re.MULTILINE)
    assert lines
    for line in lines:
        words = shlex.split(line.partition(">")[0], comments=True)
        try:
            build_parser().parse_args(words)
        except SystemExit:
            pytest.fail(f"{place} has a command that is refused: seismass {line}")


def test_readme_scene_file_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The scene file of the README under the first command beside it: storeys yield, the block slides."""
    monkeypatch.chdir(tmp_path)
    (scene,) = code_blocks("toml")
    Path("scene.toml").write_text(scene)
    (command,) = re.findall(r"^seismass (run .*)$", "\n".join(code_blocks("sh")), re.MULTILINE)
    assert main(shlex.split(command)) == 0
    assert Path("out.parquet").is_file()
    file = seismass.read_scene("scene.toml")
    counts = seismass.simulate(file.scene, file.motion).counts
    assert counts["yield"] > 0
    assert counts["slip"] > 0
