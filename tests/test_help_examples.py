"""An example that each command prints in its help runs as it stands, in a folder with files of the names it uses."""

from __future__ import annotations

import argparse
import importlib
import json
import re
import shlex
import shutil
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seismass.cli import main
from seismass.commands.parser import COMMANDS
from seismass.motions.matching.result import write_record
from seismass.motions.records.builtin import builtin_record, data_directory
from seismass.show.explore import page as compiled

ROOT = Path(__file__).parents[1]
RUN = [
    "new own.toml --from storeys.csv --area 1200 --sds 1.0 --sd1 0.6 --live-load 7.2 --friction 0.3",
    "new shed.toml --from storeys.csv --pushover push.csv --area 1200 --sds 1 --sd1 0.6 --live-load 7.2 --friction 0.3",
    "building --example > warehouse.toml",
    "building warehouse.toml",
    "explore",
    "map --mu 0.2,0.4,0.6 --R 2,4,6 --alpha 1 --factor 0.5,1,1.5,2",
    "evidence --example > archetypes.toml",
    "fragility warehouse.toml",
    "fragility scene.toml --method cloud --measure pga --limit drift=0.05 --json",
    "slip scene.toml --clearance 0.3 --size 1.0x1.2",
    "risk scene.toml --hazard hazard.csv --hazard-period 0.5 --limit drift_ratio=0.02 --records recordings/",
    "study --records suite.csv --second-slope 0.1 --no-figures --json > study.json",
    "campaign --example > campaign.toml",
    "run --example > scene.toml",
    "run scene.toml",
    "run scene.json --json > response.json",
    "animate --example",
    "records records/ --json",
    "spectrum record.AT2 --damping 0.02,0.05",
    "target ec8:1:C:0.3",
    "scale --records suite.csv --sds 1.0 --sd1 0.6 --period 0.6",
    "match record.AT2 --out matched.AT2 --plot matched.png",
    "pulse RSN1106_KOBE_KJM000.AT2 --json",
    "validate",
    "report warehouse",
    "completion bash > ~/.local/share/bash-completion/completions/seismass",
]
"""Lines of the help, each of them quick; every command is there."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, take_few: Callable[[pytest.MonkeyPatch], None]) -> Path:
    """Files of the names that the examples use, and the folder of an assessment."""
    made, data = tmp_path_factory.mktemp("examples"), data_directory()
    whole = [builtin_record(f"synthetic-{number}") for number in (1, 2, 3)]
    motions = [motion.with_duration(15.0) for motion in whole]
    for name in ("records", "recordings"):
        (made / name).mkdir()
        for motion in motions:
            write_record(motion, made / name / f"{motion.name}.AT2")
    for name in ("record.AT2", "RSN1106_KOBE_KJM000.AT2"):
        write_record(whole[0], made / name)
    shutil.copy(data / "examples" / "warehouse.toml", made)
    shutil.copy(data / "examples" / "storage.toml", made / "scene.toml")
    scene = tomllib.loads((made / "scene.toml").read_text(encoding="utf-8"))
    (made / "scene.json").write_text(json.dumps(scene), encoding="utf-8")
    (made / "suite.csv").write_text("file\n" + "".join(f"records/{motion.name}.AT2\n" for motion in motions))
    intensity = np.array([0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 8.0])
    rows = [f"{level:g},{rate:.6g}" for level, rate in zip(intensity, 0.01 * (intensity / 0.1) ** -2.5, strict=True)]
    storeys = "Story,Height (m),Mass (t),Stiffness (kN/m)\nRoof,4,600,5e5\nStory1,4.5,700,7e5\n"
    (made / "storeys.csv").write_text(storeys)
    curves = [
        f"{name},{drift},{part * min(drift, 20 + 0.1 * drift)}"
        for name, part in (("L1", 100), ("Roof", 60))
        for drift in range(61)
    ]
    (made / "push.csv").write_text("\n".join(["Story,Drift (mm),Shear (kN)", *curves, ""]))
    (made / "hazard.csv").write_text("\n".join(["Sa,rate", *rows, ""]))
    with pytest.MonkeyPatch.context() as patch:
        take_few(patch)
        assert main(["building", str(made / "warehouse.toml"), "--out", str(made / "warehouse"), "--no-figures"]) == 0
    return made


def test_every_command_is_among_them_and_every_line_in_the_help() -> None:
    assert {line.split()[0] for line in RUN} == set(COMMANDS)
    for line in RUN:
        module, _ = COMMANDS[line.split()[0]]
        text = importlib.import_module(f"seismass.commands.{module}").COMMAND.epilog
        assert f"\n  seismass {line}\n" in text, line


@pytest.mark.usefixtures("few_motions", "small_map")
@pytest.mark.parametrize("line", RUN, ids=RUN)
def test_example_runs(
    line: str, folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    if line == "explore" and not (Path(compiled.__file__).parent / compiled.NAME).is_file():
        pytest.skip("the kernel is not compiled to WebAssembly (make explorer)")
    monkeypatch.chdir(folder)
    assert main(shlex.split(line.partition(" > ")[0])) == 0
    printed = capsys.readouterr()
    assert not re.search(r"Traceback|error", printed.err)
    assert printed.out
    if line.endswith(("--json", ".json")):
        json.loads(printed.out)
    if "--example >" in line:
        tomllib.loads(printed.out)


def lists_of(command: Any) -> Iterator[str]:
    """Options of a command that take several numbers."""
    parser = argparse.ArgumentParser()
    command.options(parser)
    for action in parser._actions:
        if getattr(action.type, "__qualname__", "").startswith("numbers_option"):
            yield from action.option_strings


def test_numbers_are_typed_in_help_and_documentation_as_their_placeholder_says() -> None:
    """With commas between, as in LOW,HIGH; spaces are read too."""
    commands = [importlib.import_module(f"seismass.commands.{module}").COMMAND for module, _ in COMMANDS.values()]
    options = {option for command in commands for option in lists_of(command)}
    assert {"--mu-factors", "--range", "--ductility"} <= options
    pages = (page.read_text("utf-8") for page in (ROOT / "README.md", *(ROOT / "docs").glob("*.md")))
    for text in (*(command.epilog for command in commands), *pages):
        assert not re.search(rf"seismass [^\n]*(?:{'|'.join(options)}) -?[\d.]+ -?[\d.]+", text), text
