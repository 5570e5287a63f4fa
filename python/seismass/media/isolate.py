"""Names of the user's in sentences of a page: those in scripts that run from right to left do not tear their line."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable

from markupsafe import Markup, escape

from seismass.media.roles import lettered


def runs_leftwards(character: str) -> bool:
    """Whether a character belongs to a script that is written from right to left."""
    return unicodedata.bidirectional(character) in ("R", "AL")


def isolated(text: str) -> Markup:
    """Return a name as HTML, isolated where it runs from right to left."""
    return Markup("<bdi>{}</bdi>").format(text) if any(map(runs_leftwards, text)) else escape(text)


def apart(text: str) -> str:
    """Return a name for a line of text, isolated by characters where it runs from right to left."""
    return f"\N{FIRST STRONG ISOLATE}{text}\N{POP DIRECTIONAL ISOLATE}" if any(map(runs_leftwards, text)) else text


def sentence_html(text: str, names: Iterable[str] = ()) -> Markup:
    """Return a sentence of the package as HTML: symbols as Greek letters, the user's `names` in it unchanged."""
    special = {name for name in names if name and (lettered(name) != name or any(map(runs_leftwards, name)))}
    if not special:
        return escape(lettered(text))
    pattern = "|".join(re.escape(name) for name in sorted(special, key=len, reverse=True))
    parts = re.split(f"({pattern})", text)
    return Markup("").join(isolated(part) if place % 2 else escape(lettered(part)) for place, part in enumerate(parts))
