"""Words of storey tables: heads, roofs, basements, totals and notes, in English and six other languages."""

from __future__ import annotations

import re
import tomllib
import unicodedata
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final, Literal

from seismass.base.errors import InvalidBuildingFile
from seismass.base.values import refusal, short

Order = Literal["roof-first", "ground-first"]
Names = Mapping[str, str]
"""Names of columns by what they hold, without accents, between bars; x stands for the direction that is asked for."""

_WORDS: Final = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
COLUMNS: Final[Names] = {kind.replace("_", " "): names for kind, names in _WORDS["columns"].items()}
TEXTS: Final = ("storey", "case", "step", "step type", "location", "direction", "tower")
"""Kinds of columns that are no quantities."""
CURVES: Final[Names] = {
    **{kind: COLUMNS[kind] for kind in ("storey", "case", "step", "step type")},
    **{kind: f"{COLUMNS[kind]}|{_WORDS['curves'][kind]}" for kind in ("drift", "shear")},
}
"""The same of pushover curves."""
TABLES: Final = re.compile(
    "story (data|definitions|stiffness|forces|shears|drifts)|mass summary by story|centers? of mass and rigidity"
)
"""Tables of ETABS that are read where a file has others beside them."""
NO_STOREY: Final = "that of a storey: remove it, or where it is a storey name it with its number, as Story 1"
_LIKE_SUM: Final = 1e-3
"""Masses of a table are rounded; a total of rounded masses is met within this part of itself."""


def word_list(kind: str, group: str = "rows") -> frozenset[str]:
    """Return the words of a list of table_words.toml."""
    return frozenset(_WORDS[group][kind].split())


def plain(text: str) -> str:
    """Return a text in small letters without accents; the Turkish dotless i is an i."""
    letters = unicodedata.normalize("NFKD", text.replace("\u0131", "i").replace("\u0130", "I").casefold())
    return "".join(each for each in letters if not unicodedata.combining(each))


def words(name: str) -> list[str]:
    """Return the words of a name, without case, accents, digits and punctuation."""
    return re.findall(r"[^\W\d_]+", plain(name))


def column_name(head: str, direction: str) -> str:
    """Return the name of a column without its unit, in plain letters alone; one of the other direction has none."""
    parts = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", head)
    pieces = re.sub(r"[^a-z0-9%]+", " ", plain(parts)).split()
    other = "y" if direction == "x" else "x"
    if pieces and pieces[-1] in (other, f"u{other}", f"k{other}", f"v{other}"):
        return ""
    pieces = [{f"u{direction}": "ux", f"k{direction}": "kx", f"v{direction}": "vx"}.get(word, word) for word in pieces]
    return "".join([*pieces[:-1], "x"] if pieces and pieces[-1] == direction else pieces)


def is_base(name: str) -> bool:
    """Return whether a row is the ground level by the name that ETABS gives it."""
    return words(name) == ["base"] and not re.search(r"\d", name)


def is_ground(name: str) -> bool:
    """Return whether a row that carries nothing is the ground level by its name."""
    return name.strip() == "0" or (
        len(words(name)) == 1 and words(name)[0] in word_list("ground") and not re.search(r"\d", name)
    )


def is_roof(name: str) -> bool:
    """Return whether a floor is a roof or a penthouse by its name."""
    return not word_list("roof").isdisjoint(words(name))


def is_basement(name: str) -> bool:
    """Return whether a floor is below ground by its name: B2 is, and so is -1."""
    parts = words(name)
    if parts in (["b"], ["ss"], []):
        return bool(re.fullmatch(r"\s*(-|[a-z]+\W*)\d+\W*", plain(name)))
    return parts[0] in word_list("basement") and (len(parts) == 1 or parts[0] != "ug")


def is_mezzanine(name: str) -> bool:
    """Return whether a floor is a mezzanine by its name."""
    return not word_list("mezzanine").isdisjoint(words(name))


def refuse_summaries(names: Sequence[str], file: str) -> None:
    """Refuse rows whose names are those of totals, means, extremes and notes."""
    for name in names:
        parts = words(name)
        if not word_list("summary").isdisjoint(parts) or (len(parts) == 1 and parts[0] in word_list("summary_alone")):
            raise refusal(InvalidBuildingFile, f"row {short(name)}", file, NO_STOREY, "a total, a mean or a note")


def refuse_sums(names: Sequence[str], masses: Sequence[float], file: str) -> None:
    """Refuse a row without a number in its name whose mass (or weight) is the sum of all others."""
    # With the base or without it.
    storeys = {name: mass for name, mass in zip(names, masses, strict=True) if not is_base(name)}
    whole, base = sum(storeys.values()), sum(masses) - sum(storeys.values())
    if len(storeys) < 3:  # two equal floors are each the sum of the others
        return
    for name, mass in storeys.items():
        is_sum = any(abs(mass - total) <= _LIKE_SUM * total for total in (whole - mass, whole - mass + base))
        if is_sum and len(re.findall(r"\d+", name)) != 1:
            raise refusal(
                InvalidBuildingFile, f"row {short(name)}", file, NO_STOREY, "the sum of the other rows' masses"
            )


def is_roof_first(names: Sequence[str], order: Order | None, file: str) -> bool:
    """Return whether the first row is the highest storey: by what is stated, else by roof, base and numbers."""
    if order is not None:
        return order == "roof-first"
    if len(names) < 2:
        return False
    first, last = names[0], names[-1]
    votes = {True} if is_roof(first) or is_ground(last) else set()
    votes |= {False} if is_roof(last) or is_ground(first) else set()
    numbers: dict[tuple[str, ...], list[int]] = {}
    for name in names:
        digits = re.findall(r"\d+", name)
        if len(digits) == 1:
            numbers.setdefault(tuple(word for word in words(name) if word not in word_list("ordinals")), []).append(
                int(digits[0])
            )
    for first_words, counts in numbers.items():
        if len(counts) > 1 and counts in (sorted(set(counts)), sorted(set(counts), reverse=True)):
            votes.add((counts[0] > counts[1]) != is_basement(" ".join(first_words)))
    if len(votes) != 1:
        need = "stated by --order, roof-first or ground-first, where names and elevations do not say it"
        raise refusal(InvalidBuildingFile, "order of the storeys", file, need, f"{short(first)} first")
    return votes.pop()
