"""Figures as SVG and as files."""

from __future__ import annotations

import hashlib
import io
import re
from collections.abc import Iterator, Mapping
from typing import Any, BinaryIO, Final, Literal
from xml.etree import ElementTree as ET

from markupsafe import Markup
from matplotlib.figure import Figure

from seismass.base.arguments import Progress, ProgressLike
from seismass.base.errors import InvalidOption
from seismass.base.files import Content
from seismass.base.values import as_one_of, brief, refusal
from seismass.media.roles import DARK, PAPER
from seismass.media.style import drawing, lay_out

FONTS: Final = "'DejaVu Sans', Verdana, sans-serif"
"""Fonts of inline figures. The second has the widths of the first, by which figures are laid out."""

DARK_CSS: Final = "".join(f"--figure-{name}:{dark};" for name, (_, dark) in DARK.items()) + "color-scheme:dark"
"""Declarations that make inline figures dark: `@media (prefers-color-scheme: dark) { :root { ... } }`."""

_SVG: Final = "{http://www.w3.org/2000/svg}"
_LINK: Final = "{http://www.w3.org/1999/xlink}href"
_NUMBER: Final = re.compile(r"-?\d+\.\d+")
_COLOUR: Final = re.compile(r"#[0-9a-f]{6}")
_URL: Final = re.compile(r"url\(#([^)]+)\)")
_NAME: Final = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_FONT: Final = re.compile(r" font-family: 'DejaVu Sans';?")
_COMMAND: Final = re.compile(r"\s*([A-Za-z])\s*")
_GEOMETRY: Final = ("x", "y", "x1", "x2", "y1", "y2", "width", "height", "points")
_VARIABLES: Final = {hue.lower(): f"var(--figure-{name},{hue.lower()})" for name, (hue, _) in DARK.items()}
"""CSS variables by which a page may change the colours of inline figures."""


@drawing()
def figure_svg(figure: Figure) -> str:
    """Return a figure as the text of an SVG file; equal figures give equal text.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        The figure. Text in it stays text.

    Returns
    -------
    str
        An XML document, without date and program.

    Raises
    ------
    InvalidOption
        It is not a figure.
    """
    if not isinstance(figure, Figure):
        raise refusal(InvalidOption, "figure", "SVG", "a matplotlib Figure", brief(figure))
    written = io.StringIO()
    lay_out(figure)
    figure.savefig(written, format="svg", metadata={"Date": None, "Creator": None}, facecolor=PAPER)
    return written.getvalue()


def figure_svgs(figures: Mapping[str, Figure], progress: ProgressLike = None) -> dict[str, str]:
    """Return the text of `figure_svg` of each figure, by its name; `progress` is called with (figures drawn, figures in
    all) before the first and after each.
    """
    whole = Progress(progress, len(figures), "figures")
    whole.tell(0)
    drawn: dict[str, str] = {}
    for name, figure in figures.items():
        drawn[name] = figure_svg(figure)
        whole.tell()
    return drawn


def inline_svg(figure: Figure | str, title: str, description: str = "", *, name: str | None = None) -> str:
    """Return a figure as an `<svg>` element for a page of HTML; it refers to nothing outside itself.

    It takes the width that it is given, up to its own. Its colours are CSS variables with defaults, so that a page may
    set others where it is dark: `DARK_CSS`. It has no script, and no style that reaches beyond it.

    Parameters
    ----------
    figure : Figure or str
        A figure, or the text that `figure_svg` gives.
    title, description : str, optional
        What it shows, in a few words and in sentences, for those who do not see it.
    name : str, optional
        What all ids of the element begin with. By default it is made of the content: two elements on one page then
        share ids only where they are equal throughout.

    Returns
    -------
    str
        The element on one line; equal arguments give equal text.

    Raises
    ------
    InvalidOption
        The title is empty, or the name is not letters, digits, hyphens and underscores, a letter first.
    """
    for parameter, words in (("title", title), ("description", description), ("name", "" if name is None else name)):
        as_one_of(words, str, parameter, "inline figure", InvalidOption)
    if not title.strip():
        raise refusal(InvalidOption, "title", "inline figure", "a text", brief(title))
    text = figure if isinstance(figure, str) else figure_svg(figure)
    if name is None:
        name = "f" + hashlib.sha256("\0".join((text, title, description)).encode()).hexdigest()[:10]
    elif not _NAME.fullmatch(name):
        raise refusal(InvalidOption, "name", "inline figure", "a letter, then letters, digits, - and _", brief(name))
    root = _element(text, name)
    labelled = f"{name}-title {name}-desc" if description else f"{name}-title"
    width = float(root.attrib.pop("width").removesuffix("pt"))
    del root.attrib["height"]
    root.attrib |= {
        "width": "100%",
        "role": "img",
        "aria-labelledby": labelled,
        "style": f"max-width:{width / 0.75:g}px;height:auto",
    }
    for place, (tag, words) in enumerate((("title", title), ("desc", description))):
        if words:
            child = ET.Element(tag, {"id": f"{name}-{tag}"})
            child.text = words
            root.insert(place, child)
    return ET.tostring(root, encoding="unicode")


def short_svg(figure: Figure | str) -> str:
    """Return a figure, or the text of `figure_svg`, as `<svg>` without a title, shortened as in `inline_svg`."""
    text = figure if isinstance(figure, str) else figure_svg(figure)
    return ET.tostring(_element(text, "f"), encoding="unicode")


def _element(text: str, name: str) -> ET.Element:
    """Return the SVG that matplotlib wrote as an element of HTML, its ids beginning with a name."""
    try:
        root = ET.fromstring(text)
    except ET.ParseError:
        raise refusal(InvalidOption, "figure", "inline figure", "a Figure, or SVG text", brief(text)) from None
    if not {"viewBox", "width", "height"} <= set(root.attrib):
        raise refusal(InvalidOption, "figure", "inline figure", "SVG with a viewBox, width and height", brief(text))
    used = {reference for element in root.iter() for reference in _references(element)}
    numbers = {old: f"{name}-{number}" for number, old in enumerate(sorted(used), start=1)}
    size = {key: root.attrib[key] for key in ("viewBox", "width", "height")}
    for element in list(root.iter()):
        _shortened(element, numbers)
    for unwanted in (root.find("metadata"), root.find("defs/style/..")):
        if unwanted is not None:
            root.remove(unwanted)
    root.attrib.clear()
    # What the style that was removed said of every element, and matplotlib of every text.
    root.attrib |= {**size, "font-family": FONTS, "stroke-linejoin": "round", "stroke-linecap": "butt"}
    return root


def _references(element: ET.Element) -> Iterator[str]:
    """Ids of other elements that an element refers to."""
    for key, value in element.attrib.items():
        if key == _LINK and value.startswith("#"):
            yield value[1:]
        elif "url(#" in value:
            yield from _URL.findall(value)


def _shortened(element: ET.Element, numbers: dict[str, str]) -> None:
    """Change an element in place: no namespace, ids of the page, colours by variables, numbers to 0.01 points."""
    element.tag = element.tag.removeprefix(_SVG)
    if element.tag != "tspan" and element.text is not None and not element.text.strip():
        element.text = None
    element.tail = None
    attributes = {}
    for key, value in element.attrib.items():
        if key == "id":
            if value in numbers:
                attributes["id"] = numbers[value]
        elif key == _LINK:
            attributes["href"] = f"#{numbers[value[1:]]}" if value.startswith("#") else "".join(value.split())
        elif key == "style":
            coloured = _COLOUR.sub(lambda match: _VARIABLES.get(match[0], match[0]), value)
            attributes["style"] = _placed(_FONT.sub("", coloured), numbers).replace(": ", ":").replace("; ", ";")
        elif key == "clip-path":
            attributes[key] = _placed(value, numbers)
        elif key == "d":
            attributes[key] = _COMMAND.sub(r"\1", _rounded(value)).strip()
        elif key in _GEOMETRY:
            attributes[key] = _rounded(value)
        elif key == "transform":
            if not value.startswith("rotate(-0 "):
                attributes[key] = _rounded(value, 4)
        else:
            attributes[key] = value
    element.attrib.clear()
    element.attrib.update(attributes)


def _placed(value: str, numbers: dict[str, str]) -> str:
    return _URL.sub(lambda match: f"url(#{numbers[match[1]]})", value)


def _rounded(value: str, digits: int = 2) -> str:
    return _NUMBER.sub(lambda match: f"{float(match[0]):.{digits}f}".rstrip("0").rstrip("."), value)


LEAST_SCALE: Final = 0.8
"""How far a figure shrinks before it is scrolled: letters of 9 points are then 9.6 pixels, of 7.5 points 8 pixels."""

_ROOT: Final = re.compile(r"<svg\b([^>]*)>")
_LENGTH: Final = re.compile(r"\b(width|height)\s*=\s*[\"']([\d.]+)(pt|px)?[\"']")
_METADATA: Final = re.compile(r"<metadata>.*?</metadata>\s*", re.DOTALL)
_ID: Final = re.compile(r"\sid=\"([^\"]*)\"")
_REFERENCE: Final = re.compile(r"(url\(#|href=\"#)([^)\"]+)")


def figure_html(figure: Figure | str, caption: str, alt: str, *, narrow: Figure | str | None = None) -> Markup:
    """Return a figure as inline SVG, at most as wide as it was made, scrolled on narrow screens unless `narrow`
    replaces it. In dark mode light and dark are exchanged, or `currentColor` is that of the text.
    """
    if not alt.strip():
        raise refusal(InvalidOption, "alt", "figure", "a description", brief(alt))
    wide = _Drawing(figure)
    drawings = [wide.html(caption, alt, "" if narrow is None else " on-wide")]
    if narrow is not None:
        drawings.append(_Drawing(narrow).html(caption, alt, " on-narrow"))
    return Markup('<figure style="--own:{}">{}<figcaption>{}</figcaption></figure>').format(
        wide.width or "100%", Markup("").join(drawings), caption
    )


class _Drawing:
    """An SVG: its attributes, its content, and how wide it was made; empty where it does not say."""

    def __init__(self, figure: Figure | str) -> None:
        self._svg = short_svg(figure) if isinstance(figure, Figure) else figure
        root = _ROOT.search(self._svg)
        if root is None or "viewBox=" not in root[1] or "</svg>" not in self._svg:
            raise refusal(InvalidOption, "figure", "page", "an SVG with a viewBox", brief(self._svg[:60]))
        self._attributes = root[1]
        self._content = _METADATA.sub("", self._svg[root.end() :])
        lengths = {name: (float(value), unit or "px") for name, value, unit in _LENGTH.findall(root[1])}
        self._value, self._unit = lengths.get("width", (0.0, ""))

    @property
    def width(self) -> str:
        """Width as CSS has it."""
        return f"{self._value:g}{self._unit}" if self._unit else ""

    def html(self, caption: str, alt: str, kind: str) -> Markup:
        """Return the drawing in its frame, which scrolls where it is too narrow."""
        body = _with_own_ids(self._content[: self._content.rindex("</svg>")], f"{self._content}{caption}{alt}")
        least = f"{0.0 if 'on-narrow' in kind else LEAST_SCALE * self._value:g}{self._unit}"
        attrs = re.sub(r"\b(id|style|role|version)\s*=\s*(\"[^\"]*\"|'[^']*')", "", _LENGTH.sub("", self._attributes))
        return Markup(
            '<div class="scroll{kind}" tabindex="0" role="group" aria-label="figure"><svg{attributes} class="{looks}" '
            'role="img" style="{style}"><title>{alt}</title>{body}</svg></div>'
        ).format(
            kind=kind,
            attributes=Markup(" ".join(["", *attrs.split()])),
            looks="adapts" if "currentColor" in self._svg else "inverts",
            style=f"max-width:{self.width};min-width:{least}" if self._unit else "",
            alt=alt,
            body=Markup(body),
        )


def _with_own_ids(body: str, unique: str) -> str:
    """Drop identifiers that nothing refers to, and begin the others with a digest of what no other figure has."""
    digest = hashlib.sha256(unique.encode()).hexdigest()[:8]
    used = {match[2] for match in _REFERENCE.finditer(body)}
    body = _ID.sub(lambda match: f' id="f{digest}-{match[1]}"' if match[1] in used else "", body)
    return _REFERENCE.sub(rf"\g<1>f{digest}-\g<2>", body)


CAPTION_CHARACTERS: Final = 15
"""Characters of a caption per inch of a figure's width, in 7.5 points."""


def figure_content(figure: Figure, kind: Literal["png", "svg"]) -> Content:
    """Return what writes a figure as PNG or SVG, without a date, so that equal figures are equal files."""

    @drawing()
    def write(file: BinaryIO) -> None:
        if kind == "svg":
            file.write(figure_svg(figure).encode())
            return
        lay_out(figure)
        options: Any = {"compress_level": 3}  # a third less time, 3 % more bytes
        figure.savefig(file, format="png", dpi=160, metadata={"Software": None}, facecolor=PAPER, pil_kwargs=options)

    return write
