"""Fixtures of all tests."""

from __future__ import annotations

import copy
import os
import re
import signal
from collections.abc import Callable, Iterator
from functools import partial
from html.parser import HTMLParser
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import settings
from jinja2 import Template
from matplotlib.axes import Axes
from matplotlib.axis import XTick, YTick
from matplotlib.collections import QuadMesh
from matplotlib.colors import to_hex, to_rgba_array
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.spines import Spine

import seismass as sm
from seismass.media.roles import BLOCK_COLOURS, DARK, MODELS

SLOW = Path(__file__).with_name("slow.txt")
"""Files and tests that `make test` leaves to `make test-all`, one a line: what the id of a test begins with."""
UNUSED = pytest.StashKey[list[str]]()


@pytest.fixture(autouse=True, scope="session")
def figures_have_colours_of_the_table() -> Iterator[None]:
    """Every figure that a test has written is drawn in the colours of the table of roles, and a line that is called as
    a role in its own. A map lies between them.
    """
    own = {role.name: role.colour.lower() for role in MODELS.values()}
    table = [*(hue for hue, _ in DARK.values()), *BLOCK_COLOURS, *(role.text for role in MODELS.values())]
    known = {hue.lower() for hue in table} | {"#000000", "#cccccc"}  # and Matplotlib's, of axes that a user gave
    write = Figure.savefig

    def checked(figure: Figure, *arguments: Any, **options: Any) -> None:
        write(figure, *arguments, **options)
        if not known.issuperset(colours_of(figure)):
            pytest.fail(f"colours that roles have not: {colours_of(figure) - known}")
        for line in figure.findobj(Line2D):
            if to_hex(line.get_color()) != own.get(label := str(line.get_label()), to_hex(line.get_color())):
                pytest.fail(f"{label} in {line.get_color()}")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", checked)
        yield


@pytest.fixture(autouse=True, scope="session")
def numbers_of_pages_have_one_sign() -> Iterator[None]:
    """Every page that a test renders has a true minus before numbers, but for code, and no signed zero."""
    render = Template.render

    def checked(template: Template, *arguments: Any, **given: Any) -> str:
        page = render(template, *arguments, **given)
        if page.lstrip().lower().startswith("<!doctype"):
            found = [text for text in Words(page).texts if HYPHEN.search(text) or SIGNED_ZERO.search(text)]
            if found:
                pytest.fail(f"signs of numbers: {found}")
        return page

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Template, "render", checked)
        yield


HYPHEN = re.compile(r"(?:^|[\s(\[,:;=+/])-\.?\d|\de-\d")
SIGNED_ZERO = re.compile(r"(?:^|[\s(\[,:;=/])[\N{MINUS SIGN}+-]0(?:\.0*)?(?![\d.]*\d)")


class Words(HTMLParser):
    """Texts of a page that people read as words, not as code."""

    def __init__(self, page: str) -> None:
        super().__init__(convert_charrefs=True)
        self.texts: list[str] = []
        self._code: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag in ("code", "pre", "script", "style", "textarea", "bdi"):
            self._code.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if self._code[-1:] == [tag]:
            self._code.pop()

    def handle_data(self, data: str) -> None:
        if not self._code:
            self.texts.append(data)


def colours_of(figure: Figure) -> set[str]:
    """Colours of all lines, areas and words that a figure shows."""
    found: set[str] = set()
    for artist in figure.findobj(lambda one: one.get_visible() and not isinstance(one, QuadMesh)):
        for part in ("color", "markerfacecolor", "markeredgecolor", "facecolor", "edgecolor"):
            value = getattr(artist, f"get_{part}", lambda: "none")()
            shown = value is not None and not isinstance(artist, Figure | Axes | Spine | XTick | YTick)
            rows = to_rgba_array(value) if shown else []
            found |= {to_hex(row[:3]) for row in rows if row[3] > 0.0}
    return found


@pytest.fixture
def unused_lines(request: pytest.FixtureRequest) -> list[str]:
    """Lines of tests/slow.txt that name no test."""
    return request.config.stash[UNUSED]


# The processes of pytest-xdist have a width, and a user's shell may: what is printed into a pipe would be folded to it.
os.environ.pop("COLUMNS", None)

# nohup and shells that put tests into the background have these signals ignored, and so would the commands under test.
for _number, _default in ((signal.SIGINT, signal.default_int_handler), (signal.SIGHUP, signal.SIG_DFL)):
    if signal.getsignal(_number) is signal.SIG_IGN:
        signal.signal(_number, _default)

# A shared machine may be slow; a failure prints what reproduces it.
settings.register_profile("seismass", deadline=None, print_blob=True)
settings.load_profile("seismass")

# A building file in which no two numbers of a kind are equal or in the ratio of small whole numbers, so that a test of
# it sees one taken in place of another: tests/test_unequal.py.
_FILE: dict[str, Any] = {
    "name": "three unequal storeys",
    "site": {"sds_g": 1.13, "sd1_g": 0.71, "tl_s": 6.7},
    "building": {"damping": 0.037, "drift_limit": 0.017, "theta_limit": 0.23},
    "goods": {"mu_factors": [0.71, 1.37]},
    "storeys": [
        {
            "name": "hall",
            "height_m": 4.3,
            "area_m2": 530.0,
            "dead_load_kpa": 5.3,
            "gravity_load_kn": 3070.0,
            "stiffness_kn_per_m": 1.93e5,
            "yield_shear_kn": 1870.0,
            "overstrength": 1.87,
            "second_slope": 0.067,
            "third_slope": 0.013,
            "live_load_kpa": 6.1,
            "goods": [
                {"name": "pallets", "share": 0.59, "occupied": 0.88, "mu_s": 0.298, "mu_k": 0.214},
                {"name": "drums", "share": 0.41, "occupied": 0.55, "mu_s": 0.253, "mu_k": 0.154},
            ],
        },
        {
            "name": "loft",
            "height_m": 3.7,
            "area_m2": 470.0,
            "dead_load_kpa": 4.7,
            "gravity_load_kn": 2390.0,
            "stiffness_kn_per_m": 1.57e5,
            "yield_shear_kn": 1510.0,
            "overstrength": 2.11,
            "second_slope": 0.053,
            "third_slope": 0.0103,
            "live_load_kpa": 4.3,
            "occupied": 0.71,
            "mu_s": 0.349,
            "mu_k": 0.184,
        },
        {
            "name": "roof",
            "height_m": 3.1,
            "area_m2": 410.0,
            "dead_load_kpa": 3.7,
            "gravity_load_kn": 1640.0,
            "stiffness_kn_per_m": 1.13e5,
            "yield_shear_kn": 830.0,
            "overstrength": 1.61,
            "second_slope": 0.043,
            "third_slope": 0.0083,
            "live_load_kpa": 1.9,
            "occupied": 0.43,
            "mu_s": 0.291,
            "mu_k": 0.24,
        },
    ],
}


@pytest.fixture
def unequal_file() -> dict[str, Any]:
    """Tables of a building file of three storeys and four kinds of goods, two of them on floor 1; a copy per test."""
    return copy.deepcopy(_FILE)


@pytest.fixture(scope="session")
def unequal_building() -> sm.assessment.OwnBuilding:
    """The building of that file."""
    return sm.read_building(_FILE)


@pytest.fixture(scope="session")
def unequal_scene() -> sm.Scene:
    """Three storeys and four blocks, two of them on floor 1, with P-Delta; no two quantities of a kind alike."""
    building = sm.Building(
        [44.1e3, 35.7e3, 22.4e3],
        [29.3e6, 23.1e6, 16.1e6],
        yield_shear=[283e3, 227e3, 139e3],
        overstrength=[1.87, 2.11, 1.61],
        second_slope=[0.067, 0.053, 0.043],
        third_slope=[0.013, 0.0103, 0.0083],
        damping=0.037,
        heights=[4.3, 3.7, 3.1],
        gravity_load=[461e3, 367e3, 251e3],
    )
    blocks = [
        sm.Block(1, mass=18.9e3, mu_s=0.298, mu_k=0.214),
        sm.Block(1, mass=11.5e3, mu_s=0.253, mu_k=0.154),
        sm.Block(2, mass=13.7e3, mu_s=0.349, mu_k=0.184),
        sm.Block(3, mass=7.8e3, mu_s=0.291, mu_k=0.24),
    ]
    return sm.Scene(building, blocks, name="three unequal storeys")


@pytest.fixture(scope="session")
def unequal_motions() -> tuple[sm.Record, ...]:
    """Three bursts of waves with time steps, lengths, periods and peaks of their own; the goods slide under each."""
    bursts = []
    for number, (dt, seconds, period, peak) in enumerate(
        [(0.005, 5.3, 0.53, 5.9), (0.007, 6.3, 1.13, 4.7), (0.011, 8.3, 0.67, 7.3)], start=1
    ):
        time = dt * np.arange(round(seconds / dt))
        wave = peak * np.sin(2.0 * np.pi * time / period) * np.sin(np.pi * time / seconds) ** 2
        bursts.append(sm.Record(wave, dt, name=f"burst {number}"))
    return tuple(bursts)


@pytest.fixture(scope="session")
def take_few() -> Callable[[pytest.MonkeyPatch], None]:
    """What makes three of the built-in forty, for whole commands of which no number is tested."""
    from seismass.motions.records import builtin

    stored = builtin._stored
    return lambda patch: patch.setattr(builtin, "_stored", lambda *of: stored(*of)[:3])


@pytest.fixture
def few_motions(take_few: Callable[[pytest.MonkeyPatch], None], monkeypatch: pytest.MonkeyPatch) -> None:
    """The built-in forty are three in this test."""
    take_few(monkeypatch)


@pytest.fixture
def small_map(monkeypatch: pytest.MonkeyPatch) -> None:
    """The command of the map has two buildings, and models of eleven shares."""
    package = import_module("seismass.effective_mass")  # as an attribute of seismass it is the function
    buildings = ((1, 0.4, "loaded"), (2, 0.38, "bare"))
    small = partial(package.EffectiveMassParameters, buildings=buildings, shares=11)
    monkeypatch.setattr(package, "EffectiveMassParameters", small)


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of reference results and recordings that are not part of the project."""
    folder = os.environ.get("SEISMASS_SHARED")
    if not folder:
        pytest.skip("SEISMASS_SHARED is not set: no reference results, no recordings")
    path = Path(folder)
    if not path.is_dir():
        pytest.fail(f"SEISMASS_SHARED must be a directory; got {folder}")
    return path


@pytest.fixture
def reference(request: pytest.FixtureRequest) -> Callable[[str], Path]:
    """Finds a file of the reference scenes: in the repository, else in the folder that is not part of the project."""

    def find(name: str) -> Path:
        path = Path(__file__).parents[1] / "crates/seismass/tests/data/reference" / name
        return path if path.exists() else request.getfixturevalue("shared") / "reference" / name

    return find


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark the tests that take seconds, and note the lines that no test begins with where all are collected."""
    lines = [line.partition("  #")[0].rstrip() for line in SLOW.read_text(encoding="utf-8").splitlines()]
    slow = [line for line in lines if line and not line.startswith("#")]
    used, whole = set(), not config.args or config.args == ["tests"]
    for item in items:
        own = item.nodeid.removeprefix("tests/")
        found = [line for line in slow if own.startswith(line)]
        used.update(found)
        if found:
            item.add_marker(pytest.mark.slow)
    unused = [line for line in slow if line not in used]
    config.stash[UNUSED] = unused if whole else []
