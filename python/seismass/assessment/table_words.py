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
Kinds = Mapping[str, str]
"""What columns hold by their names, without blanks."""

_WORDS: Final = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
UNITS: Final[Mapping[str, str]] = _WORDS["units"]
"""Other names of units by the unit, between blanks."""
TEXTS: Final = ("storey", "case", "step", "step type", "location", "direction", "tower")
"""Kinds of columns that are no quantities."""
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


_COMPOUND: Final = re.compile(
    f"(?:{'|'.join(word for word in word_list('name', 'fillers') if len(word) > 3)})(?=[a-z])"
)
"""A filler before another word, as in Geschossmasse."""


def _pieces(head: str, direction: str) -> list[str]:
    """Words of the name of a column without fillers, ux for UY if that is asked for; none of the other direction."""
    other = "y" if direction == "x" else "x"
    pieces = re.sub(r"[^a-z0-9%]+", " ", plain(re.sub(r"(?<=[a-z])(?=[A-Z])", " ", head))).split()
    if any(re.fullmatch(f"[ukvf]?{other}", word) for word in pieces):
        return []
    pieces = [f"{word[0]}x" if re.fullmatch(f"[ukvf]{direction}", word) else word for word in pieces]
    if direction in pieces and len(pieces) > 1:
        pieces = [word for word in pieces if word != direction and word not in word_list("direction", "fillers")]
    fillers = word_list("name", "fillers")
    telling = [_COMPOUND.sub("", word) for word in pieces if word not in fillers]
    return telling if set(telling) - {"no", "nr", "number"} else pieces


def column_kind(head: str, direction: str, kinds: Kinds) -> str:
    """Return what a column holds by its name, which may have a symbol behind it, as in Height, h; an empty text where
    it is not known, or of the other direction.
    """
    pieces = _pieces(head, direction)
    kind = kinds.get("".join(pieces), kinds.get(re.sub("[^a-z0-9%]", "", plain(head)), "")) if pieces else ""
    for place in range(1, len(pieces)):
        first = kinds.get("".join(pieces[:place]), "")
        kind = kind or first * (first == kinds.get("".join(pieces[place:])))
    return kind


def _kinds(*groups: tuple[str, tuple[str, ...]]) -> Kinds:
    return {
        form: kind.replace("_", " ")
        for group, kinds in groups
        for kind in kinds or _WORDS[group]
        for name in _WORDS[group][kind].split("|")
        for form in ("".join(_pieces(name, "x")), name.replace(" ", ""))
    }


COLUMNS: Final = _kinds(("columns", ()))
CURVES: Final = _kinds(("columns", ("storey", "case", "step", "step_type", "drift", "shear")), ("curves", ()))
"""The same of pushover curves."""


def is_base(name: str) -> bool:
    """Return whether a row is the ground level by the name that ETABS gives it."""
    return words(name) == ["base"] and not re.search(r"\d", name)


def is_ground(name: str) -> bool:
    """Return whether a row that carries nothing is the ground level by its name."""
    parts = words(name)
    named = not word_list("ground").isdisjoint([*parts, "".join(parts)])  # G.L. as GL
    return not re.search("[1-9]", name) and ("0" in name or named)


def is_roof(name: str) -> bool:
    """Return whether a floor is a roof or a penthouse by its name."""
    return not word_list("roof").isdisjoint(words(name))


def is_basement(name: str) -> bool:
    """Return whether a floor is below ground by its name: B2 is, and so is -1."""
    parts = words(name)
    if parts in (["b"], ["ss"], []):
        return bool(re.fullmatch(r"\s*(-|[a-z]+\W*)\d+\W*", plain(name)))
    below = parts[0] in word_list("basement") and (len(parts) == 1 or parts[0] != "ug")
    return below or {"lower", "ground"} <= {*parts}


def is_mezzanine(name: str) -> bool:
    """Return whether a floor is a mezzanine by its name."""
    return not word_list("mezzanine").isdisjoint(words(name))


def refuse_summaries(names: Sequence[str], file: str) -> None:
    """Refuse rows whose names are those of totals, means, extremes and notes."""
    for name in names:
        parts = words(name)
        if not word_list("summary").isdisjoint(parts) or (len(parts) == 1 and parts[0] in word_list("summary_alone")):
            raise refusal(InvalidBuildingFile, f"row {short(name)}", file, NO_STOREY, "a total, a mean or a note")


def refuse_towers(names: Sequence[str], file: str) -> None:
    """Refuse floors whose names differ by what stands before one word and number, as Tower A L2 and Tower B L2."""
    parts = [re.findall(r"[^\W\d_]+|-?\d+", plain(name)) for name in names]
    ends = [tuple(each[-2:]) if len(each) > 2 and each[-1].lstrip("-").isdigit() else () for each in parts]
    alike = [name for name, end in zip(names, ends, strict=True) if end and ends.count(end) > 1]
    if alike:
        need = "of one tower: keep the rows of one, and write a file for each"
        raise refusal(InvalidBuildingFile, "rows", file, need, " and ".join(map(short, alike[:2])))


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
                int(digits[0]) * (-1 if name.strip().startswith("-") else 1)
            )
    for first_words, counts in numbers.items():
        if len(counts) > 1 and counts in (sorted(set(counts)), sorted(set(counts), reverse=True)):
            votes.add((counts[0] > counts[1]) != is_basement(" ".join(first_words)))
    if len(votes) != 1:
        need = "stated by --order, roof-first or ground-first, where names and elevations do not say it"
        raise refusal(InvalidBuildingFile, "order of the storeys", file, need, f"{short(first)} first")
    return votes.pop()
