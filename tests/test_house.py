"""The house in order: one version, stored data where a package finds it, pages whose code runs."""

import importlib
import re
import shlex
import subprocess
import sys
import tomllib
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path

import pytest

import seismass
from seismass.cli import main
from seismass.commands.parser import COMMANDS, GROUPS, parse
from seismass.motions.records.builtin import data_directory

ROOT = Path(__file__).parents[1]


def test_one_version() -> None:
    version = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]["package"]["version"]
    assert seismass.__version__ == version
    assert metadata.version("seismass") == version
    assert f"version: {version}\n" in (ROOT / "CITATION.cff").read_text()
    assert f"## {version}" in (ROOT / "CHANGELOG.md").read_text()


def test_package_is_typed_and_finds_its_data() -> None:
    assert (Path(seismass.__file__).parent / "py.typed").is_file()
    stored = sorted(file.name for file in (data_directory() / "synthetic").iterdir())
    assert stored == sorted(
        [
            "forty.parquet",
            "forty_second.parquet",
            "seven.csv",
            "suite.csv",
            *(f"synthetic-{i}.AT2" for i in range(1, 12)),
        ]
    )


def test_every_error_is_a_seismass_error_and_the_builtin_one() -> None:
    for name in ("InvalidScene", "InvalidMotion", "InvalidOption", "RecordFormatError", "InvalidSceneFile"):
        error = getattr(seismass.errors, name)
        assert issubclass(error, seismass.SeismassError)
        assert issubclass(error, ValueError)
    assert issubclass(seismass.errors.SimulationError, seismass.SeismassError)
    assert issubclass(seismass.errors.SimulationError, RuntimeError)


def test_import_leaves_what_is_slow_to_import_for_when_it_is_used() -> None:
    """Names of batches and studies bring NumPy and Polars, and no SciPy, Matplotlib or PyWavelets."""
    names = (
        "seismass.simulate_many, seismass.campaign.Campaign, seismass.effective_mass, "
        "seismass.fragility, seismass.assess"
    )
    program = f"import sys, seismass; {names}; print(*sorted({{name.partition('.')[0] for name in sys.modules}}))"
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout.split()
    assert {"numpy", "polars"} <= set(found)
    assert not {"scipy", "matplotlib", "pywt"} & set(found)


HEAVY = ("polars", "scipy", "matplotlib", "PIL", "jinja2", "pywt", "rich")
CHAIN = "sm.Building.uniform(2, 0.6, yield_shear_over_weight=[0.24, 0.20]), sm.blocks_on_floors([1, 0], mu=0.2)"
SHAKEN = "sm.Motion([2.0, 2.0, -3.0, 0.0], dt=0.1)"
RACKED = "racks=[sm.Rack(1, 1, level_mass_ratio=[0.1], period=0.5, blocks=[sm.RackBlock(1, mass_ratio=0.2, mu=0.2)])]"
PROGRAMS = {
    "a chain": f"sm.simulate(sm.Scene({CHAIN}), {SHAKEN}, histories=True, energy=True).drift",
    "a built-in record": f"sm.simulate(sm.Scene({CHAIN}), sm.builtin_record('synthetic-1').scaled(1.5)).peak_drift",
    "a record of its own": f"sm.simulate(sm.Scene({CHAIN}), sm.Record([1.0, 2.0], 0.1)).counts",
    "a rack": f"sm.simulate(sm.Scene({CHAIN}, {RACKED}), {SHAKEN}).event_log",
    "goods on the ground": f"sm.simulate(sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)]), {SHAKEN}).peak_slip",
    "two directions": f"sm.simulate(sm.Scene({CHAIN}, other_direction=True), ({SHAKEN}, {SHAKEN})).counts",
    "a scene file": (
        "from seismass.runs.scene_file import example_scene; file = sm.read_scene(example_scene()); "
        "sm.simulate(file.scene, file.motion)"
    ),
    "periods": "sm.design.vibration_modes([1.0, 2.0], [3.0, 4.0]).periods",
    "a code": "sm.codes.code_fraction('asce7-10', 'storage').fraction",
    "parsers": "[parser.build_parser(name) for name in parser.COMMANDS]",
}


@pytest.mark.parametrize("program", PROGRAMS.values(), ids=PROGRAMS)
def test_what_makes_no_table_and_no_figure_imports_nothing_for_them(program: str) -> None:
    """One run, its peaks and histories, a scene file, and the parser of any command."""
    assert imported(f"import seismass as sm; from seismass.commands import parser; {program}", HEAVY) == []


def test_an_assessment_without_figures_imports_nothing_for_them(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(run_python("-m", "seismass", "building", "--example"), encoding="utf-8")
    words = [str(tmp_path / "own.toml"), "--suite", "seven", "--no-figures", "--out", str(tmp_path / "own")]
    program = f"from seismass.cli import main; assert main(['building', *{words!r}]) == 0"
    assert imported(program, HEAVY) == ["polars"]
    assert (tmp_path / "own" / "storeys.csv").is_file()


def imported(program: str, packages: Sequence[str]) -> list[str]:
    """Those of some packages that a program imports in a process of its own."""
    said = run_python("-c", f"import sys; {program}\nprint('', *{packages!r} & sys.modules.keys())")
    return said.splitlines()[-1].split()


@pytest.mark.parametrize("page", ["usage.md", "question.md", "grid.md", "campaign.md"])
def test_code_of_pages_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, page: str) -> None:
    monkeypatch.chdir(tmp_path)
    blocks = code_blocks("python", (ROOT / "docs" / page).read_text(encoding="utf-8"))
    assert blocks
    exec(compile("\n".join(blocks), page, "exec"), {"__name__": "page"})


def code_blocks(language: str, page: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", page, re.MULTILINE | re.DOTALL)


EPILOGS = {
    f"{name} --help": importlib.import_module(f"seismass.commands.{module}").COMMAND.epilog
    for name, (module, _) in COMMANDS.items()
}
PAGES = {
    page.name: blocks
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
    if (blocks := re.findall(r"^ *seismass .*$", "\n".join(code_blocks("sh", page.read_text(encoding="utf-8"))), re.M))
}


@pytest.mark.parametrize("place", [*PAGES, *EPILOGS])
def test_commands_are_ones_that_the_parser_takes(place: str) -> None:
    """Every line of the shell blocks of the README and of pages, and of the examples that --help prints."""
    text = EPILOGS[place] if place in EPILOGS else "\n".join(PAGES[place])
    lines = re.findall(r"^ *seismass (.*)$", text, re.MULTILINE)
    assert lines
    for line in lines:
        words = shlex.split(re.split(r" [>|] ", line)[0], comments=True)
        try:
            parse(words)
        except SystemExit:
            pytest.fail(f"{place} has a command that is refused: seismass {line}")


def run_python(*arguments: str) -> str:
    command = [sys.executable, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout


def test_help_starts_with_what_to_type_and_needs_no_numpy() -> None:
    program = "import sys; from seismass.cli import main\ntry: main(['--help'])\nfinally: print(sorted(sys.modules))"
    text = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60).stdout
    first = "\n".join(text.splitlines()[:8])
    assert "the number for your building:" in first
    assert "seismass building warehouse.toml" in first
    place = 0
    for group, names in GROUPS.items():
        for line in (f"\n  {group}:", *(f"\n    {name} " for name in names)):
            place = text.index(line, place)
    assert sorted(name for names in GROUPS.values() for name in names) == sorted(COMMANDS)
    imported = text.splitlines()[-1]
    for heavy in ("numpy", "polars", "matplotlib", "scipy", "rich", "dataclasses"):
        assert f"'{heavy}'" not in imported


def test_the_package_and_its_command_line_can_be_run_as_modules() -> None:
    version = f"seismass {seismass.__version__}\n"
    assert run_python("-m", "seismass", "--version") == run_python("-m", "seismass.cli", "--version") == version


def test_names_are_imported_when_they_are_first_used() -> None:
    program = (
        "import sys, seismass\nassert 'numpy' not in sys.modules\nseismass.Building\nassert 'numpy' in sys.modules\n"
        "import seismass.runs.batch, seismass.effective_mass.answer\n"
        "print(callable(seismass.simulate), callable(seismass.effective_mass), callable(seismass.long_table))"
    )
    assert run_python("-c", program) == "True True True\n"
    for name in seismass.__all__:
        assert getattr(seismass, name) is not None


@pytest.mark.parametrize("shell", ["bash", "zsh"])
def test_shells_complete_every_command(shell: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["completion", shell]) == 0
    script = capsys.readouterr().out
    for name in COMMANDS:
        assert name in script
    assert "--mu-factors" in script


def test_scene_file_of_the_page_of_usage_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Under the first command beside it: storeys yield, the block slides."""
    monkeypatch.chdir(tmp_path)
    page = (ROOT / "docs" / "usage.md").read_text(encoding="utf-8")
    (scene,) = code_blocks("toml", page)
    Path("scene.toml").write_text(scene)
    (command,) = re.findall(r"^seismass (run scene.*)$", "\n".join(code_blocks("sh", page)), re.MULTILINE)
    assert main(shlex.split(command)) == 0
    assert Path("out.parquet").is_file()
    file = seismass.read_scene("scene.toml")
    counts = seismass.simulate(file.scene, file.motion).counts
    assert counts["yield"] > 0
    assert counts["slip"] > 0
