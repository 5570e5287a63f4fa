"""A building file from a few answers, or from a storey table and a few answers: commented, to be edited further."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

from seismass.assessment.file_values import REDUCTION
from seismass.assessment.storey_table import StoreyTable
from seismass.base.errors import InvalidOption
from seismass.base.input_table import POSITIVE, SHARE, Need
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import brief, refusal
from seismass.model.friction import friction_table


def _text(given: str) -> str:
    return given.strip()


def _count(given: str) -> int:
    number = int(given)
    if not 1 <= number <= 200:
        raise ValueError
    return number


def _number(need: Need) -> Callable[[str], float]:
    """Return what reads a number that fits; another one is a ValueError."""

    def read(given: str) -> float:
        number = float(given)
        if not need.fits(number):
            raise ValueError
        return number

    return read


_positive, _share = _number(POSITIVE), _number(SHARE)


def _friction(given: str) -> str | float:
    known = friction_table()["pair_id"].to_list()
    if given.strip() in known:
        return given.strip()
    return _positive(given)


@dataclass(frozen=True)
class Question:
    """What has to be known of a building: its name as an option, the question, and how an answer is read."""

    name: str
    words: str
    must: str
    read: Callable[[str], Any]
    default: str = ""

    def answer(self, given: Any) -> Any:
        """Read an answer.

        Raises
        ------
        InvalidOption
            It is not what it must be.
        """
        try:
            return self.read(str(given))
        except ValueError:
            raise refusal(InvalidOption, self.name, "new building", self.must, brief(given)) from None


QUESTIONS: Final = (
    Question("name", "What is the building called?", "text", _text, "my building"),
    Question("storeys", "How many storeys?", "a whole number from 1 to 200", _count),
    Question("height", "How high is a storey (m)?", "a positive number", _positive),
    Question("area", "How large is a floor (m2)?", "a positive number", _positive),
    Question(
        "dead_load", "What does a floor weigh with its share of walls and frame (kPa)?", "a positive number", _positive
    ),
    Question("period", "What is the first period without goods (s)?", "a positive number", _positive),
    Question("sds", "What is S_DS of the site (g)?", "a positive number", _positive),
    Question("sd1", "What is S_D1 of the site (g)?", "a positive number", _positive),
    Question("reduction", "By which R are strengths designed?", "a number from 1", _number(REDUCTION), "3"),
    Question("live_load", "What is the design live load of the loaded floors (kPa)?", "a positive number", _positive),
    Question("occupied", "Which share of it is present (0 to 1)?", "a number from 0 to 1", _share, "1"),
    Question(
        "friction",
        "Which friction do the goods have: a number, or a contact of `seismass building --frictions`?",
        "a positive number, or a contact of `seismass building --frictions`",
        _friction,
    ),
)
"""What is asked, in order. The roof carries no goods."""


def questions_for(table: StoreyTable | None) -> tuple[Question, ...]:
    """Return what has still to be asked where a storey table is given."""
    if table is None:
        return QUESTIONS
    known = {"storeys"}
    for name, values in (
        ("height", table.heights),
        ("dead_load", table.mass),
        ("period", table.stiffness),
        ("reduction", table.strength),
    ):
        if values is not None:
            known.add(name)
    return tuple(question for question in QUESTIONS if question.name not in known)


def building_text(answers: Mapping[str, Any], table: StoreyTable | None = None) -> str:
    """Return a building file as text.

    Parameters
    ----------
    answers : mapping of str to object
        An answer, as its `Question` reads it, to each of `questions_for(table)`.
    table : StoreyTable, optional
        What is known storey by storey.

    Returns
    -------
    str
        TOML with comments.

    Raises
    ------
    InvalidOption
        An answer is missing.
    """
    for question in questions_for(table):
        if question.name not in answers:
            need = f"given, by --{question.name.replace('_', '-')}, where it is not asked for"
            raise refusal(InvalidOption, question.name, "new building", need, "nothing")
    friction = answers["friction"]
    has_design = table is None or table.strength is None
    lines = [
        "# A building file of seismass: change it, and run `seismass building` on it.",
        "# docs/building_file.md explains every key; `seismass building --example` prints a file with all of them.",
        "",
        f"name = {_quoted(answers['name'])}",
        *([] if table is None else [f"note = {_quoted(f'storeys from {table.source}')}"]),
        "",
        "[site]",
        f"sds_g = {answers['sds']!r}                # S_DS, g",
        f"sd1_g = {answers['sd1']!r}                # S_D1, g",
        "",
        "[code]                       # whose fraction of the live load is compared",
        'id = "asce7-10"',
        'use = "storage"              # or "ordinary"',
        "",
        "[building]",
        *([f"period_s = {answers['period']!r}               # without goods"] if "period" in answers else []),
        *([f"height_m = {answers['height']!r}"] if "height" in answers else []),
        f"area_m2 = {answers['area']!r}",
        *([f"dead_load_kpa = {answers['dead_load']!r}          # of a floor"] if "dead_load" in answers else []),
        *(
            [
                "design = true                # strengths by response spectrum analysis, divided by R",
                f"R = {answers['reduction']!r}",
            ]
            if has_design
            else []
        ),
        "overstrength = 2.0           # second yield over the first: an assumption",
        "second_slope = 0.05          # stiffness after the first yield over the initial one: an assumption",
        "drift_limit = 0.020          # of the height",
        "",
        "[goods]",
        f"live_load_kpa = {answers['live_load']!r}          # design live load",
        f"occupied = {answers['occupied']!r}               # share of it that is present",
        f"{'friction' if isinstance(friction, str) else 'mu'} = "
        f"{_quoted(friction) if isinstance(friction, str) else repr(friction)}",
        "",
    ]
    return "\n".join([*lines, *_storeys(answers, table)])


def _storeys(answers: Mapping[str, Any], table: StoreyTable | None) -> list[str]:
    """Tables of the storeys, storey 1 first; the highest carries no goods."""
    count = int(answers["storeys"]) if table is None else len(table.names)
    lines = []
    for i in range(count):
        lines.append("[[storeys]]" + ("                  # storey 1; its floor is the one above" if i == 0 else ""))
        if table is not None:
            lines.append(f"name = {_quoted(table.names[i])}")
            for key, values, unit in (
                ("height_m", table.heights, 1.0),
                ("mass_kg", table.mass, 1.0),
                ("stiffness_kn_per_m", table.stiffness, 1e-3),
                ("yield_shear_kn", table.strength, 1e-3),
            ):
                if values is not None:
                    lines.append(f"{key} = {float(f'{unit * float(values[i]):.10g}')!r}")
        elif i == count - 1 and count > 1:
            lines.append('name = "roof"')
        if i == count - 1 and count > 1:
            lines.append("live_load_kpa = 0.0          # a bare roof")
        lines.append("")
    return lines


def weight_per_area(table: StoreyTable, area: float) -> list[float] | None:
    """Return the weight of each floor over its area (kPa), to be looked at; None without masses."""
    if table.mass is None:
        return None
    return [1e-3 * STANDARD_GRAVITY * float(mass) / area for mass in table.mass]


def _quoted(text: str) -> str:
    """Text as TOML has it, whose basic strings have JSON's escapes."""
    return json.dumps(text, ensure_ascii=False)
