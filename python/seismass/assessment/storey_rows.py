"""Rows of storey tables that are no storeys: totals, means, notes, and the ground level."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from typing import Final

from seismass.base.errors import InvalidBuildingFile
from seismass.base.values import refusal, short

# In English, German, Spanish, Portuguese, Italian, French and Turkish, without accents.
_SUMMARY: Final = frozenset(
    (
        *("total", "totals", "subtotal", "sum", "sums", "average", "averages", "avg", "mean", "max", "maximum", "min"),
        *("minimum", "note", "notes", "remark", "remarks", "summe", "summen", "gesamt", "gesamtsumme", "zwischensumme"),
        *("insgesamt", "mittelwert", "durchschnitt", "hinweis", "anmerkung", "bemerkung", "totales", "suma"),
        *("sumatoria", "promedio", "maximo", "minimo", "nota", "notas", "observacion", "observaciones", "totais"),
        *("soma", "somatorio", "observacao", "observacoes", "totale", "totali", "subtotale", "somma", "massimo"),
        *("totaux", "somme", "moyenne", "remarque", "remarques", "toplam", "toplami", "ortalama", "maksimum", "azami"),
        *("asgari", "notlar"),
    )
)
_SUMMARY_ALONE: Final = frozenset({"media", "medio", "mittel", "moyen", "not"})
"""Words that are those of a mean or of a note only where nothing else is in the cell: a storey may be for media."""
_NEED: Final = "that of a storey: remove it, or where it is a storey name it with its number, as Story 1"
_LIKE_SUM: Final = 1e-3
"""Masses of a table are rounded; a total of rounded masses is met within this part of itself."""


def _words(name: str) -> list[str]:
    """Words of a name, without case, accents, digits and punctuation."""
    letters = unicodedata.normalize("NFKD", name.casefold().replace("\u0131", "i"))
    return re.findall(r"[^\W\d_]+", "".join(each for each in letters if not unicodedata.combining(each)))


def is_base(name: str) -> bool:
    """Whether a row is the ground level by the name that ETABS gives it."""
    return _words(name) == ["base"] and not re.search(r"\d", name)


def refuse_summaries(names: Sequence[str], file: str) -> None:
    """Refuse rows whose names are those of totals, means, extremes and notes.

    Raises
    ------
    InvalidBuildingFile
        There is one.
    """
    for name in names:
        words = _words(name)
        if not _SUMMARY.isdisjoint(words) or (len(words) == 1 and words[0] in _SUMMARY_ALONE):
            raise refusal(InvalidBuildingFile, f"row {short(name)}", file, _NEED, "a total, a mean or a note")


def refuse_sums(names: Sequence[str], masses: Sequence[float], file: str) -> None:
    """Refuse a row without a number in its name whose mass (or weight) is the sum of all others.

    Raises
    ------
    InvalidBuildingFile
        There is one.
    """
    # With the base or without it.
    storeys = {name: mass for name, mass in zip(names, masses, strict=True) if not is_base(name)}
    whole, base = sum(storeys.values()), sum(masses) - sum(storeys.values())
    if len(storeys) < 3:  # two equal floors are each the sum of the others
        return
    for name, own in storeys.items():
        is_sum = any(abs(own - total) <= _LIKE_SUM * total for total in (whole - own, whole - own + base))
        if is_sum and len(re.findall(r"\d+", name)) != 1:
            raise refusal(InvalidBuildingFile, f"row {short(name)}", file, _NEED, "the sum of the other rows' masses")
