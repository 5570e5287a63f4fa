"""A building file from a few answers, a storey table or pushover curves: commented, to be edited further."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal, TypeAlias

import numpy as np

from seismass.assessment.file_keys import KEYS
from seismass.assessment.pushover_file import PushoverCurves
from seismass.assessment.storey_table import StoreyTable
from seismass.assessment.table_words import is_roof, plain, word_list
from seismass.base.errors import InvalidBuildingFile, InvalidOption
from seismass.base.input_table import POSITIVE, SHARE, Need
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, brief, refusal, short
from seismass.design import PushoverFit, fit_pushover
from seismass.design.pushover_fit import SpringShape
from seismass.model.friction import friction_table
from seismass.model.tipping import BlockSize, parse_size

FloorForces: TypeAlias = Literal["triangular", "uniform"]
"""Lateral forces as mass times height above ground, or as mass."""
_SLOPES: Final = (
    "overstrength = 2.0           # second yield over the first: an assumption",
    "second_slope = 0.05          # stiffness after the first yield over the initial one: an assumption",
)


def _text(text: str) -> str:
    return text.strip()


def _count(text: str) -> int:
    number = int(text)
    if not 1 <= number <= 200:
        raise ValueError
    return number


def _number(need: Need) -> Callable[[str], float]:
    """Return what reads a number that fits; another one is a ValueError."""

    def read(text: str) -> float:
        number = float(text)
        if not need.fits(number):
            raise ValueError
        return number

    return read


_positive, _share = _number(POSITIVE), _number(SHARE)


def _friction(text: str) -> str | float:
    return text.strip() if text.strip() in _contacts() else _positive(text)


def _contacts() -> list[str]:
    names: list[str] = friction_table()["pair_id"].to_list()
    return names


def _like_contacts(text: str) -> str:
    """Contacts that share a word with a text."""
    words = set(re.findall("[a-z]+", text.casefold())) - {"on"}
    near = [name for name in _contacts() if words & set(name.split("-"))]
    return f"; {', '.join(near)} are like it" if near else ""


def live_share(stated: str) -> float:
    """Return the share of the live load in a mass source: a number, or its words, such as 1.0 D + 0.25 L."""
    if re.fullmatch(r"\s*[\d.eE+-]+\s*", stated):
        return _share(stated)
    live, dead = word_list("live", "loads"), word_list("dead", "loads")
    total, pieces = 0.0, re.split(r"\s*[+;]\s*|,\s+", plain(stated).strip())
    for piece in pieces:
        matched = re.fullmatch(r"([\d.]*)[\s*]*([a-z][a-z _-]*)[\s*:=]*([\d.]*)", piece)
        name = re.sub(r"[ _-]", "", matched[2]) if matched else ""
        if matched is None or name not in live | dead or (matched[1] and matched[3]):
            raise ValueError
        total += (float(matched[1] or matched[3] or 1.0)) * (name in live)
    return _share(str(total))


def _size(text: str) -> BlockSize | None:
    """Width and height; None where nothing is stated."""
    if not text.strip():
        return None
    try:
        size = parse_size(text)
    except InvalidOption:
        raise ValueError from None
    if size.centre is not None:
        raise ValueError
    return size


@dataclass(frozen=True)
class Question:
    """What has to be known of a building: its name as an option, the question, and how an answer is read; what is said
    of one that cannot be, and whether it may be left out.
    """

    name: str
    words: str
    must: str
    read: Callable[[str], Any]
    default: str = ""
    hint: Callable[[str], str] | None = None
    optional: bool = False

    def answer(self, value: Any) -> Any:
        """Read an answer, or refuse it."""
        try:
            return self.read(str(value))
        except ValueError:
            hint = "" if self.hint is None else self.hint(str(value))
            raise refusal(InvalidOption, self.option, "new building", self.must + hint, brief(value)) from None

    @property
    def option(self) -> str:
        """Its option of the command."""
        return f"--{self.name.replace('_', '-')}"


def _of_key(name: str, table: str, key: str, words: str, default: str = "", need: Need | None = None) -> Question:
    """A question for the number of a key of building files: its unit, and its range where `need` is no narrower one."""
    row = KEYS[table][key]
    fits = need or row.need or POSITIVE
    unit = "" if row.unit == "1" else f" ({row.unit})"
    return Question(name, f"{words}{unit}?", fits.requirement, _number(fits), default)


MASS_INCLUDES: Final = Question(
    "mass_includes",
    "Which share of the live load is in the masses of the table, by the mass source of the program (0: none)?",
    "a number from 0 to 1, or the mass source in words such as 1.0 D + 0.25 L",
    live_share,
)
"""Asked where the masses of a table are those of a program."""
QUESTIONS: Final = (
    Question("name", "What is the building called?", "text", _text, "my building"),
    Question("storeys", "How many storeys?", "a whole number from 1 to 200", _count),
    _of_key("height", "building", "height_m", "How high is a storey"),
    _of_key("area", "building", "area_m2", "How large is a floor"),
    _of_key("dead_load", "building", "dead_load_kpa", "What does a floor weigh with its share of walls and frame"),
    MASS_INCLUDES,
    _of_key("period", "building", "period_s", "What is the first period without goods"),
    _of_key("sds", "site", "sds_g", "What is S_DS of the site"),
    _of_key("sd1", "site", "sd1_g", "What is S_D1 of the site"),
    _of_key("reduction", "building", "R", "By which R are strengths designed", "3"),
    _of_key("live_load", "goods", "live_load_kpa", "What is the design live load of the loaded floors", need=POSITIVE),
    _of_key("occupied", "storeys", "occupied", "Which share of it is present (0 to 1)", "1"),
    Question(
        "friction",
        "Which friction do the goods have: a number, or a contact of `seismass building --frictions`?",
        "a positive number, or a contact of `seismass building --frictions`",
        _friction,
        hint=_like_contacts,
    ),
    Question(
        "goods_size",
        "How wide and high is one of the goods (m, as 1.0x1.2; nothing: not known, they slide)?",
        "nothing, or WIDTHxHEIGHT (m)",
        _size,
        optional=True,
    ),
)
"""What is asked, in order. The roof carries no goods."""
NEVER_IN_TABLES: Final = ("area", "sds", "sd1", "live_load", "friction")
_ABOVE_ROOF: Final = 3
"""Most floors above a roof that count as penthouses; a roof below more of them is that of a podium."""


def questions_for(table: StoreyTable | None, curves: PushoverCurves | None = None) -> tuple[Question, ...]:
    """Return what has still to be asked where a storey table or pushover curves are given."""
    known = set() if table is not None and table.live_mass else {"mass_includes"}
    if table is not None:
        values = table.heights, table.mass, table.stiffness, table.strength
        names = zip(("height", "dead_load", "period", "reduction"), values, strict=True)
        known |= {"storeys", *(name for name, value in names if value is not None)}
    if curves is not None:
        known |= {"period", "reduction", *(["storeys"] if curves.names else [])}
    return tuple(question for question in QUESTIONS if question.name not in known)


def fit_of_curves(
    curves: PushoverCurves,
    answers: Mapping[str, Any],
    table: StoreyTable | None = None,
    *,
    shape: SpringShape = "bilinear",
    pattern: FloorForces = "triangular",
) -> PushoverFit:
    """Return springs fitted to pushover curves. Of a curve of the whole building, `table` gives the relative
    stiffnesses and yield shears and `pattern` the forces: mass times height, or mass.
    """
    _need(answers, questions_for(table, curves))
    storeys = len(table.names) if table is not None else len(curves.names) or int(answers["storeys"])
    if curves.names and len(curves.names) != storeys:
        got = f"{len(curves.names)} for {storeys} storeys"
        raise refusal(InvalidBuildingFile, "curves", curves.source, "one for each storey of the table", got)
    heights = None if table is None else table.heights
    if heights is None and "height" in answers:
        heights = np.full(storeys, float(answers["height"]))
    drift = curves.drift_in_metres(heights)
    if curves.names:
        return fit_pushover(drift, curves.shear, shape=shape)
    if heights is None:
        raise refusal(InvalidBuildingFile, "heights", curves.source, "known with a curve of the whole building", "none")
    mass = np.ones(storeys) if table is None or table.mass is None else table.mass
    return fit_pushover(
        drift[0],
        curves.shear[0],
        shape=shape,
        forces=mass * np.cumsum(heights) if pattern == "triangular" else mass,
        relative_stiffness=None if table is None else table.stiffness,
        relative_strength=None if table is None else table.strength,
    )


def _need(answers: Mapping[str, Any], questions: Sequence[Question]) -> None:
    """Refuse answers that lack one."""
    missing = [each for each in questions if each.name not in answers and not each.optional]
    if missing:
        need = f"given, by {', '.join(each.option for each in missing)}, where they are not asked for"
        raise refusal(InvalidOption, missing[0].name, "new building", need, "nothing")


def building_text(
    answers: Mapping[str, Any],
    table: StoreyTable | None = None,
    curves: PushoverCurves | None = None,
    fit: PushoverFit | None = None,
    loaded: Sequence[str] = (),
) -> str:
    """Return a building file as TOML with comments, from an answer to each of `questions_for`. Springs of `fit` replace
    those of `table`; roofs and penthouses named in `loaded` carry goods.
    """
    _need(answers, questions_for(table, curves))
    friction = answers["friction"]
    has_design = fit is None and (table is None or table.strength is None)
    notes = [] if table is None else [f"storeys from {table.source}"]
    notes += [] if curves is None else [f"springs fitted to {curves.source}"]
    included = answers.get("mass_includes", 0.0)
    notes += [f"masses without the {included:g} of the live load that they include there"] * (included > 0.0)
    lines = [
        "# A building file of seismass: change it, and run `seismass building` on it.",
        "# docs/building_file.md explains every key; `seismass building --example` prints a file with all of them.",
        "",
        f"name = {_quoted(answers['name'])}",
        *([f"note = {_quoted(', '.join(notes))}"] if notes else []),
        "",
        "[site]",
        f"sds_g = {answers['sds']!r}                # S_DS, g",
        f"sd1_g = {answers['sd1']!r}                # S_D1, g",
        "",
        "[code]                       # fraction of the live load, strengths, drift limit, scaling of motions",
        'id = "asce7-10"',
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
        *(_SLOPES if fit is None else [f"# springs: {_misfit(fit)}"]),
        "# drift_limit = 0.020        # of the height, in place of that of the code",
        "",
        "[goods]",
        'use = "storage"              # or "archive", "assembly", "shop", "ordinary"; by floor in [[storeys]]',
        f"live_load_kpa = {answers['live_load']!r}          # design live load",
        f"occupied = {answers['occupied']!r}               # share of it that is present",
        f"{'friction' if isinstance(friction, str) else 'mu'} = "
        f"{_quoted(friction) if isinstance(friction, str) else repr(friction)}",
        *_size_lines(answers.get("goods_size")),
        "",
    ]
    return "\n".join([*lines, *_storeys(answers, table, curves, fit, loaded)])


def _size_lines(size: BlockSize | None) -> list[str]:
    """Size of goods, as it is stated or could be."""
    if size is None:
        return [
            "# width_m = 1.0              # of one of them, with height_m: with b/h below mu they tip before they slide"
        ]
    return [
        f"width_m = {size.width!r}                # of one of them: with b/h below mu they tip first",
        f"height_m = {size.height!r}",
    ]


def _misfit(fit: PushoverFit) -> str:
    """How well springs fit, in a line."""
    largest, rms = 100.0 * float(fit.largest_misfit.max()), 100.0 * float(fit.rms_misfit.max())
    return f"the shear is met within {largest:.2g} % of its peak, {rms:.2g} % in the root mean square"


def bare_floors(names: Sequence[str], loaded: Sequence[str] = ()) -> list[bool]:
    """Return which floors carry no goods, floor 1 first: the highest of several, roofs and penthouses by name, and the
    few floors above one; not those that `loaded` names.
    """
    unknown = [name for name in loaded if name not in names]
    if unknown:
        raise refusal(
            InvalidOption, "loaded", "new building", f"one of {', '.join(map(short, names))}", short(unknown[0])
        )
    count = len(names)
    roofs = [i for i, name in enumerate(names) if is_roof(name)]
    lowest = next((i for i in roofs if count - 1 - i <= _ABOVE_ROOF), count - 1)
    return [count > 1 and (i >= lowest or i in roofs) and names[i] not in loaded for i in range(count)]


def bare_mass(table: StoreyTable, answers: Mapping[str, Any], bare: Sequence[bool]) -> FloatArray | None:
    """Return floor masses without the share of the live load that a table includes on loaded floors."""
    included = 1e3 * answers.get("mass_includes", 0.0) * answers["live_load"] * answers["area"] / STANDARD_GRAVITY
    if table.mass is None or included == 0.0:
        return table.mass
    mass: FloatArray = table.mass - included * ~np.array(bare)
    if not (mass > 0.0).all():
        floor = int(np.argmin(mass))
        need = f"more than the {1e-3 * included:.4g} t of live load that it includes by --mass-includes"
        got = f"{1e-3 * table.mass[floor]:.4g} t"
        raise refusal(InvalidBuildingFile, f"mass of storey {short(table.names[floor])}", table.source, need, got)
    return mass


def _storeys(
    answers: Mapping[str, Any],
    table: StoreyTable | None,
    curves: PushoverCurves | None,
    fit: PushoverFit | None,
    loaded: Sequence[str],
) -> list[str]:
    """Tables of the storeys, storey 1 first; roofs carry no goods."""
    names = () if curves is None else curves.names
    names = names if table is None else table.names
    count = len(names) or int(answers["storeys"])
    bare = bare_floors(names or ("",) * count, loaded)
    heights, mass = (None, None) if table is None else (table.heights, bare_mass(table, answers, bare))
    stiffness, strength = (None, None) if table is None else (table.stiffness, table.strength)
    slopes: tuple[FloatArray | None, ...] = (None, None, None)
    if fit is not None:
        stiffness, strength = fit.stiffness, fit.yield_shear
        slopes = (fit.overstrength, fit.second_slope, fit.third_slope)
    columns = (
        ("height_m", heights, 1.0),
        ("mass_kg", mass, 1.0),
        ("stiffness_kn_per_m", stiffness, 1e-3),
        ("yield_shear_kn", strength, 1e-3),
        ("overstrength", slopes[0], 1.0),
        ("second_slope", slopes[1], 1.0),
        ("third_slope", slopes[2], 1.0),
    )
    lines = []
    for i in range(count):
        lines.append("[[storeys]]" + ("                  # storey 1; its floor is the one above" if i == 0 else ""))
        if names:
            lines.append(f"name = {_quoted(names[i])}")
        elif i == count - 1 and count > 1:
            lines.append('name = "roof"')
        for key, values, unit in columns:
            if values is not None:
                lines.append(f"{key} = {float(f'{unit * float(values[i]):.10g}')!r}")
        if bare[i]:
            lines.append("live_load_kpa = 0.0          # a bare roof: without this line it carries goods")
        lines.append("")
    return lines


def _quoted(text: str) -> str:
    """Text as TOML has it, whose basic strings have JSON's escapes."""
    return json.dumps(text, ensure_ascii=False)
