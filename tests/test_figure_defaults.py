"""Figures are drawn under Matplotlib's own defaults, whatever the working folder, style sheets and programs say."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import matplotlib as mpl
import matplotlib.style
import pytest

import seismass as sm
from seismass.media.style import STYLE, drawing
from seismass.media.svg import figure_svg

SETTINGS = {
    "text.usetex": True,
    "text.latex.preamble": r"\input{/etc/hostname}",
    "font.family": "serif",
    "axes.grid": True,
    "axes.facecolor": "yellow",
    "lines.linewidth": 9.0,
    "figure.dpi": 33.0,
    "savefig.bbox": "tight",
    "savefig.transparent": True,
    "path.sketch": (3.0, 100.0, 2.0),
    "image.cmap": "jet",
    "axes.spines.top": False,
    "axes.formatter.use_locale": True,
    "agg.path.chunksize": 7,
}
PROGRAM = """
import hashlib, io
import seismass as sm
from seismass.media.svg import figure_content
record = sm.builtin_suite("seven")[0]
scene = sm.Scene(sm.Building.uniform(2, 0.4), [sm.Block(1, mass_ratio=0.5, mu=0.2)])
response = sm.simulate(scene, record, histories=True)
for figure in (record.plot(), response.plot.drift(), response.plot.profile(), response.plot.loops()):
    for kind in ("svg", "png"):
        file = io.BytesIO()
        figure_content(figure, kind)(file)
        print(hashlib.sha256(file.getvalue()).hexdigest())
"""


def digests(folder: Path, **environment: str) -> list[str]:
    """Digests of figures that are drawn in a folder."""
    every = {**os.environ, **environment}
    command = [sys.executable, "-W", "ignore", "-c", PROGRAM]
    child = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder, env=every)
    assert child.returncode == 0, child.stderr
    return child.stdout.split()


def as_rc(settings: dict[str, object]) -> str:
    values = {name: ", ".join(map(str, each)) if isinstance(each, tuple) else each for name, each in settings.items()}
    return "".join(f"{name}: {value}\n" for name, value in values.items())


def test_matplotlibrc_of_the_working_folder_changes_no_byte_of_a_figure(tmp_path: Path) -> None:
    """Nor that of the environment; LaTeX, which would run what the file says, is not started."""
    plain, other, empty = tmp_path / "plain", tmp_path / "other", tmp_path / "bin"
    for folder in (plain, other, empty):
        folder.mkdir()
    (other / "matplotlibrc").write_text(as_rc(SETTINGS) + "backend: module://mine\n")
    (other / "mine.py").write_text("raise SystemExit('run')")
    expected = digests(plain)
    assert len(set(expected)) == 8
    assert digests(other, PATH=str(empty)) == expected
    assert digests(plain, MATPLOTLIBRC=str(other), PATH=str(empty)) == expected


def test_style_sheets_and_settings_of_a_program_change_no_byte() -> None:
    record = sm.builtin_suite("seven")[0]
    expected = hashlib.sha256(figure_svg(record.plot()).encode()).digest()
    for sheet in (SETTINGS, "dark_background", "ggplot", "bmh"):
        with mpl.style.context(sheet):
            before = dict(mpl.rcParams)
            drawn = hashlib.sha256(figure_svg(record.plot()).encode()).digest()
            assert dict(mpl.rcParams) == before
        assert drawn == expected


@pytest.mark.parametrize("name", sorted(set(mpl.rcParamsDefault) & set(SETTINGS)))
def test_every_setting_is_the_own_one_while_figures_are_drawn(name: str) -> None:
    with mpl.rc_context({name: SETTINGS[name]}), drawing():
        assert mpl.rcParams[name] == STYLE.get(name, mpl.rcParamsDefault[name]) or name == "font.family"
