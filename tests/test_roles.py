"""One table says how models are drawn and called: no figure has a colour or a name of its own for them."""

from __future__ import annotations

import ast
import itertools
import re
from pathlib import Path

import pytest
from matplotlib.figure import Figure

import seismass
from seismass.assessment import models
from seismass.media import roles
from seismass.media.page import templates
from seismass.media.roles import (
    ALPHA,
    BLOCK_COLOURS,
    CSS_NAMES,
    ETA,
    LAMBDA,
    MODELS,
    MU,
    Role,
    css,
    lettered,
    model_name,
)
from seismass.media.style import SERIES

PACKAGE = Path(seismass.__file__).parent
SHOWN = sorted((PACKAGE / "show").rglob("*.py"))
ROOT = Path(__file__).parents[1]
DRAWING = [
    *(file for file in sorted(PACKAGE.rglob("*.py")) if file.name != "roles.py"),
    *(file for part in ("benchmarks", "tools", "docs/gallery") for file in sorted((ROOT / part).rglob("*.py"))),
    ROOT / "docs/conf.py",
]
"""Files that may draw: the package but for the table, benchmarks, figures of the documentation, its gallery."""
HUES = {"BLUE", "VERMILION", "GREEN", "PURPLE", "ORANGE", "SKY", "DEEP_BLUE", "MAGENTA"}
LITERALS = {"show/animation/picture.py", "show/explore/page.py"}
"""Files with colours of their own: of paper, slabs, an empty bar, and pale ones that flash."""
COLOUR = re.compile(r"#[0-9a-fA-F]{6}\b|^(tab:\w+|white|black|\w*grey|\w*gray|red|green|blue|orange)$")


def name_of(path: Path) -> str:
    return path.relative_to(PACKAGE).as_posix()


@pytest.mark.parametrize("path", DRAWING, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_no_figure_has_a_colour_of_its_own(path: Path) -> None:
    """Each comes from a role, from the shades of blocks or the kinds that are no model, and has no name there."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module == "seismass.media.roles":
            assert not {alias.name for alias in node.names} & HUES, path
    if path.is_relative_to(PACKAGE) and name_of(path) in LITERALS:
        return
    documentation = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in documentation:
            assert not COLOUR.search(node.value), f"{path}: {node.lineno}: {node.value}"


def test_a_figure_in_a_colour_that_roles_have_not_is_seen(tmp_path: Path) -> None:
    """Every test that writes a figure asks it: `figures_have_colours_of_the_table`."""
    for look in ({"color": "#123456"}, {"color": roles.CODE.colour, "label": roles.ATTACHED.name}):
        figure = Figure()
        figure.subplots().plot([0.0, 1.0], **look)
        with pytest.raises(pytest.fail.Exception):
            figure.savefig(tmp_path / "figure.png")


def test_no_template_names_the_colour_of_a_model_by_itself() -> None:
    """Colours of the style sheets are those of paper, ink, lines, links and verdicts."""
    of_roles = {colour.lower() for role in MODELS.values() for colour in (role.colour, role.text, role.dark)}
    of_roles -= {roles.ADVISED.text, roles.ADVISED.dark, roles.BARE.text, roles.BARE.dark}  # those of ink and soft ink
    for path in itertools.chain(
        *((PACKAGE / part).rglob("*.*") for part in ("media/templates", "show/explore/templates"))
    ):
        found = {colour.lower() for colour in re.findall(r"#[0-9a-fA-F]{6}\b", path.read_text(encoding="utf-8"))}
        assert not found & of_roles, path


def test_no_figure_calls_a_simulation_real() -> None:
    said = re.compile(r"""["'][^"']*\breal (?:building|/|over|\()|/ real\b[^"']*["']|"real: """)
    for path in (*SHOWN, *sorted((PACKAGE / "show/explore/templates").iterdir())):
        for line in path.read_text(encoding="utf-8").splitlines():
            if not line.lstrip().startswith(('"""', "#", "//")):
                assert not said.search(line), f"{path}: {line}"


def test_roles_differ_in_more_than_colour() -> None:
    compared = [roles.SLIDE, roles.CODE, roles.ATTACHED, roles.BARE, roles.ADVISED, roles.SLIDE_LOW, roles.SLIDE_HIGH]
    for one, other in itertools.combinations(compared, 2):
        assert one.name != other.name
        assert one.colour != other.colour
        assert (one.line, one.marker) != (other.line, other.marker)


def luminance(colour: str) -> float:
    """WCAG 2.2, relative luminance."""
    parts = (int(colour[at : at + 2], 16) / 255.0 for at in (1, 3, 5))
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


@pytest.mark.parametrize("role", [*MODELS.values(), roles.YIELDS], ids=lambda role: role.name)
def test_words_in_the_colour_of_a_role_are_legible(role: Role) -> None:
    """WCAG 2.2, 1.4.3: contrast 4.5, on white and on the paper of dark mode, #191919."""
    assert 1.05 / (luminance(role.text) + 0.05) >= 4.5
    assert (luminance(role.dark) + 0.05) / (luminance("#191919") + 0.05) >= 4.5


def test_pages_animations_and_the_live_page_have_the_colours_of_the_roles() -> None:
    light, dark = css(dark=False), css(dark=True)
    for variable, role in CSS_NAMES.items():
        assert f"{variable}: {role.text};" in light
        assert f"{variable}: {role.dark};" in dark
    environment = templates()
    assert (environment.globals["role_colours"], environment.globals["role_colours_dark"]) == (light, dark)
    for path in ("media/templates/animation.css", "show/explore/templates/explore.css"):
        text = (PACKAGE / path).read_text(encoding="utf-8")
        assert "{{ role_colours }}" in text
        assert "{{ role_colours_dark }}" in text


def test_names_of_an_assessment_are_those_of_the_roles() -> None:
    assert {name: model_name(name) for name in models.NAMES} == models.NAMES
    assert models.NAMES["real"] == "goods slide"
    assert model_name("my own model") == "my own model"


def test_blocks_have_one_order_of_colours() -> None:
    assert tuple(look["color"] for look in SERIES) == BLOCK_COLOURS


def test_symbols_are_greek_letters_in_figures_and_words_are_left() -> None:
    said = lettered("eta = mu_k/C1, eta_h^p, lambda = 0.8 at alpha = 1, mu x 1.5; beta, metal, museum, lambdas")
    first = f"{ETA} = {MU}_k/C1, {ETA}_h^p, {LAMBDA} = 0.8 at {ALPHA} = 1, {MU} \N{MULTIPLICATION SIGN} 1.5"
    assert said == f"{first}; beta, metal, museum, lambdas"
    assert lettered("1.35 mu/C1 - 0.15, 8 x 8") == f"1.35 {MU}/C1 \N{MINUS SIGN} 0.15, 8 x 8"
