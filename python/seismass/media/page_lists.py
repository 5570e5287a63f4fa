"""Lists and long texts of a page."""

from __future__ import annotations

from collections.abc import Iterable

from markupsafe import Markup

from seismass.media.isolate import isolated


def bullets_html(lines: Iterable[str]) -> Markup:
    """Return sentences as a list; Markup is taken as it is."""
    return Markup("<ul>{}</ul>").format(Markup("").join(Markup("<li>{}</li>").format(line) for line in lines))


def whole_html(names: Iterable[str]) -> Markup:
    """Return names with commas between, none of which is broken at a hyphen."""
    return Markup(", ").join(Markup('<span class="whole">{}</span>').format(name) for name in names)


def long_html(text: str) -> Markup:
    """Return a text that keeps some width in a table, on a narrow screen too."""
    return Markup('<span class="long">{}</span>').format(isolated(text))
