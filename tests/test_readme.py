"""The README: short, with code and commands that run, pictures that are there; links of it and of pages that lead."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from PIL import Image

from pages.questions import command
from seismass import animate, read_scene
from seismass.runs.scene_file import example_scene
from seismass.show.explore import page as compiled

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
KERNEL = Path(compiled.__file__).with_name(compiled.NAME)
SET_UP = ("make study", "make test", "make explorer", "pip install .")
"""Lines of shell blocks that need a network or minutes: run by hand and by the checks of each part."""


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", README, re.MULTILINE | re.DOTALL)


def test_it_is_short_and_in_its_order() -> None:
    assert len(README.splitlines()) <= 200
    assert re.findall(r"^## (.+)$", README, re.MULTILINE) == [
        "Installation",
        "Your own building",
        "The live page",
        "Method and proof",
        "Links",
        "Licence",
    ]


def test_every_command_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Line by line in one empty folder; the live page where its kernel was compiled."""
    monkeypatch.chdir(tmp_path)
    lines = [line.partition("#")[0].strip() for line in "\n".join(blocks("sh")).splitlines()]
    asked = [line for line in lines if line and line not in SET_UP]
    assert asked == [
        "seismass building --example > warehouse.toml",
        "seismass building warehouse.toml",
        "seismass explore",
    ]
    for line in asked if KERNEL.is_file() else asked[:-1]:
        command(line)
    assert Path("warehouse", "report.html").is_file()
    assert Path("explorer.html").is_file() == KERNEL.is_file()


def test_set_up_commands_are_targets_of_make() -> None:
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    named = re.findall(r"^make ([a-z-]+)", "\n".join(blocks("sh")), re.MULTILINE)
    assert named == ["study", "test", "explorer"]
    assert set(named) <= targets


def test_code_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The Python blocks, in order, as one program in an empty folder."""
    monkeypatch.chdir(tmp_path)
    assert blocks("python")
    exec(compile("\n".join(blocks("python")), "README.md", "exec"), {"__name__": "readme"})


def test_every_block_is_one_that_is_run_or_written() -> None:
    """Shell and Python run above; the one block of text is that of tools/pages/readme.py (test_pages)."""
    opened = re.findall(r"^```(.+)$", README, re.MULTILINE)
    assert set(opened) == {"sh", "python", "text"}
    assert opened.count("text") == 1


@pytest.mark.parametrize(
    "page",
    ["README.md", *(f"docs/{name}.md" for name in ("index", "guide", "checks", "question", "questions", "usage"))],
)
def test_links_and_pictures_lead_to_files_and_sections(page: str) -> None:
    """Of pages that lead; what only the built site has (api, examples) is asked there."""
    file = ROOT / page
    targets = re.findall(r"\]\(([^)]+)\)", file.read_text(encoding="utf-8"))
    assert targets
    for target in targets:
        if target.startswith(("https://", "api/", "examples/")):
            continue
        name, _, anchor = target.partition("#")
        aimed = file.parent / name if name else file
        assert aimed.is_file(), target
        if anchor:
            titles = re.findall(r"^#+ (.+)$", aimed.read_text(encoding="utf-8"), re.MULTILINE)
            assert anchor in [re.sub(r"[^\w -]", "", title).lower().replace(" ", "-") for title in titles], target


def test_film_is_eight_seconds_below_a_megabyte() -> None:
    file = ROOT / "docs" / "figures" / "film.webp"
    assert file.stat().st_size < 1e6
    with Image.open(file) as film:
        length = 0.0
        for number in range(film.n_frames):
            film.seek(number)
            film.load()
            length += film.info["duration"] / 1e3
    assert length == pytest.approx(8.0)
    shown = read_scene(example_scene())
    assert f"displacements are enlarged {animate(shown.scene, shown.motion).shown.factor:g} times" in README
