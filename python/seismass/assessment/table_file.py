"""Tables in files of other programs: text with separators, in fixed columns or as KEY=value, and workbooks."""

from __future__ import annotations

import csv
import io
import itertools
import re
import unicodedata
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Final, Literal, TypeAlias

from seismass.assessment.table_words import TABLES, TEXTS, UNITS, Kinds, column_kind, plain
from seismass.assessment.workbook import Cell, Rows, sheets_of
from seismass.base.errors import InvalidBuildingFile
from seismass.base.files import decoded, read_file
from seismass.base.limits import LONGEST_CELL, MOST_COLUMNS, MOST_ROWS, MOST_TABLE
from seismass.base.units import FOOT, INCH, KIP, POUND, STANDARD_GRAVITY
from seismass.base.values import brief, printable, refusal, short

Quantity = Literal["length", "force", "mass", "stiffness"]
QUANTITIES: Final[dict[str, Quantity]] = {
    "elevation": "length",
    "height": "length",
    "mass": "mass",
    "weight": "force",
    "stiffness": "stiffness",
    "strength": "force",
    "shear": "force",
    "drift": "length",
}
"""What columns with numbers are of."""
Mark: TypeAlias = Literal[".", ","]
"""Decimal mark."""
DECIMAL: Final[dict[str, Mark]] = {"point": ".", "comma": ","}

MOST_RATIO: Final = 0.5
"""Largest drift ratio of an analysis; a larger number is a length."""


def _sizes(**sizes: float) -> dict[str, float]:
    """Sizes of units by all their names."""
    return sizes | {name: size for unit, size in sizes.items() for name in UNITS.get(unit, "").split()}


LENGTHS: Final = _sizes(m=1.0, cm=1e-2, mm=1e-3, ft=FOOT, **{"in": INCH})
"""Metres."""
FORCES: Final = _sizes(
    n=1.0, dan=10.0, kn=1e3, mn=1e6, kgf=STANDARD_GRAVITY, tonf=1e3 * STANDARD_GRAVITY, lb=1e-3 * KIP, kip=KIP
)
"""Newtons; tonf is the metric one, as these programs have it, and a kip 1000 lbf."""
MASSES: Final = _sizes(kg=1.0, t=1e3, lb=POUND, slug=1e-3 * KIP / FOOT)
"""Kilograms."""
_NO_UNIT: Final = ("", "text", "unitless", "-")
_MASS: Final = re.compile(r"([a-z]+?)s(?:ec)?2/([a-z]+)")
_STIFFNESS: Final = re.compile(r"([a-z]+)/([a-z]+)")
_TON: Final = re.compile(r"(?<![a-z])ton(?:s(?!(?:ec)?2))?(?=s|/|$)")


def _is_metric(unit: str) -> bool:
    """Whether a unit has a metric length."""
    return any(LENGTHS.get(word) in (1.0, 1e-2, 1e-3) for word in re.findall("[a-z]+", unit.lower()))


def _size(unit: str, quantity: Quantity, metric: bool) -> float | None:
    """Size of a unit in SI units; None where it is not of the quantity. Beside `metric` lengths a ton is metric."""
    text = re.sub(r"[\s()\[\]^*.\u00b7\u22c5_-]", "", unicodedata.normalize("NFKC", unit).lower().replace("per", "/"))
    text = _TON.sub("t", text) if metric else text
    plain_sizes = {"length": LENGTHS, "force": FORCES, "mass": MASSES}.get(quantity, {})
    pattern = {"mass": _MASS, "stiffness": _STIFFNESS}.get(quantity)
    matched = pattern.fullmatch(text) if pattern is not None else None
    if text in plain_sizes or matched is None:
        return plain_sizes.get(text)
    force, length = FORCES.get(matched[1]), LENGTHS.get(matched[2])
    return None if force is None or length is None else force / length


def unit_factor(unit: str, quantity: Quantity, what: str, owner: str, *, metric: bool = False) -> float:
    """Return the factor towards SI units of a unit such as "kN/m" or "kip-s2/in" for a length, force, mass or
    stiffness; a ton is the metric one with its own lengths, or where others are `metric`.
    """
    size = _size(unit, quantity, metric or _is_metric(unit))
    if size is not None:
        return size
    known = {
        "length": "m, cm, mm, ft, in",
        "force": "N, kN, kgf, tonf, lb, kip",
        "mass": "kg, t, lb, or force-s2/length such as kip-s2/in"
        + ", or the column called Weight" * (_size(unit, "force", metric) is not None),
        "stiffness": "force/length such as kN/m or kip/in",
    }[quantity]
    raise refusal(InvalidBuildingFile, what, owner, f"one of {known}", brief(unit))


def system_of(units: str, owner: str) -> tuple[float, float]:
    """Return the units of force (N) and of length (m) of a system such as "kN-m" or "kip-in"."""
    force, _, length = units.strip().lower().replace(" ", "").replace(",", "-").partition("-")
    length = length.partition("-")[0]  # a third word is that of temperatures
    if force == "ton" and _is_metric(length):
        force = "tonf"
    if force not in FORCES or length not in LENGTHS:
        need = "a force and a length such as kN-m, N-mm, kip-in, kip-ft, lb-in, kgf-m or tonf-m"
        raise refusal(InvalidBuildingFile, "units", owner, need, brief(units))
    return FORCES[force], LENGTHS[length]


_DIGITS: Final = r"[1-9]\d{0,2}"
_READINGS: Final[dict[Mark, re.Pattern[str]]] = {
    ".": re.compile(rf"[+-]?(?:{_DIGITS}([, '])\d{{3}}(?:\1\d{{3}})*|[1-9]\d?(?:,\d\d)+,\d{{3}}|\d*)(?:\.\d*)?"),
    ",": re.compile(rf"[+-]?(?:{_DIGITS}([. '])\d{{3}}(?:\1\d{{3}})*|\d*)(?:,\d*)?"),
}
_POWER: Final = re.compile(r"([+-]?\d*[.,]?\d*)([eEdD][+-]?\d+)")


def readings(text: str) -> dict[Mark, float]:
    """Return what a text is as a number with a decimal point and with a decimal comma; nothing where it is none. Groups
    of three digits may have the other mark, a space or an apostrophe between them.
    """
    text = re.sub("[\u00a0\u2009\u202f]", " ", text.strip()).replace("\u2019", "'").replace("\u2212", "-")
    power = _POWER.fullmatch(text)
    digits, exponent = (power[1], power[2].lower().replace("d", "e")) if power else (text, "")
    result: dict[Mark, float] = {}
    for mark, pattern in _READINGS.items():
        matched = pattern.fullmatch(digits)
        if matched and any(each.isdigit() for each in digits) and not (exponent and "," in digits and mark == "."):
            if exponent and "." in digits and mark == ",":
                continue
            result[mark] = float(re.sub(rf"[^\d+\-{mark}]", "", digits).replace(",", ".") + exponent)
    return result


def few_names(names: Sequence[str]) -> str:
    """Return the first few of some names."""
    more = [f"and {len(names) - 8} more"] if len(names) > 8 else []
    return ", ".join([*(short(name) for name in names[:8]), *more])


def one_case(cases: Sequence[str], name: str | None, label: str, option: str) -> str:
    """Return the load case of a table that is name for, as it is written there, or its only one."""
    names = list(dict.fromkeys(cases))
    matches = [case for case in names if name is None or case.casefold().split() == name.casefold().split()]
    if len(matches) != 1:
        need = f"one: state it by {option}" if name is None else f"one of {few_names(names)}"
        raise refusal(InvalidBuildingFile, "load case", label, need, short(name) if name else few_names(names))
    return matches[0]


@dataclass(frozen=True)
class Sheet:
    """Rows below a head that is known: the place of each column, its name there, its unit as stated in the head or in a
    row below (empty: none), the rows, names of columns that are not known, the decimal mark, and units of the file.
    """

    path: Path
    title: str
    columns: dict[str, int]
    heads: dict[str, str]
    units: dict[str, str]
    body: Rows
    width: int
    states_units: bool
    unread: tuple[str, ...] = ()
    of_other: tuple[str, ...] = ()
    mark: Mark | None = None
    system: tuple[float, float] | None = None

    @property
    def label(self) -> str:
        """The file, and the table in it."""
        return f"{printable(self.path.name)}, {short(self.title)}" if self.title else printable(self.path.name)

    def cell(self, row: int, kind: str) -> Cell:
        """Return a cell of a column; empty where the row ends before."""
        place = self.columns[kind]
        return self.body[row][place] if place < len(self.body[row]) else ""

    def texts(self, kind: str) -> list[str]:
        """Return the cells of a column, with what cannot be printed as escapes."""
        cells = (self.cell(row, kind) for row in range(len(self.body)))
        return [printable(f"{cell:.15g}" if isinstance(cell, float) else cell.strip()) for cell in cells]

    def numbers(
        self, kind: str, factor: float, owners: Sequence[str], *, left_out: Collection[int] = ()
    ) -> list[float]:
        """Return a column of numbers times a factor, NaN where a cell is empty; `owners` name its rows in errors. A
        cell without a number is an error but in rows of `left_out`.
        """
        values = []
        for row, owner in enumerate(owners):
            try:
                values.append(factor * self._number(self.cell(row, kind), f"{kind} of {owner}"))
            except InvalidBuildingFile:
                if row not in left_out:
                    raise
                values.append(float("nan"))
        return values

    def _number(self, cell: Cell, what: str) -> float:
        if isinstance(cell, float):
            return cell
        if not cell.strip():
            return float("nan")
        result = readings(cell[:LONGEST_CELL])
        if len(set(result.values())) == 2:
            if self.mark is None:
                point, comma = result["."], result[","]
                need = "known: state it by --decimal, comma or point, since no number of the file shows it"
                got = f"{brief(cell)}, {point:.15g} or {comma:.15g}"
                raise refusal(InvalidBuildingFile, "decimal mark", self.label, need, got)
            return result[self.mark]
        mark = self.mark if re.search("[.,]", cell) else None
        if not result or (mark is not None and mark not in result):
            need = "a number" if not result else f"a number with a decimal {'point' if mark == '.' else 'comma'}"
            raise refusal(InvalidBuildingFile, what, self.path.name, need, brief(cell))
        return next(iter(result.values()))

    def factor(self, kind: str, quantity: Quantity, system: tuple[float, float] | None) -> float:
        """Return the factor of a column towards SI units, by its own unit or else by a system (N, m)."""
        unit = self.units[kind]
        if unit:
            metric = any(map(_is_metric, self.units.values()))
            return unit_factor(unit, quantity, f"unit of the column {kind}", self.path.name, metric=metric)
        system = system or self.system
        if system is None:
            need = "stated: in its head, as in Mass (kg), in a row below, or for the table by --units, such as kN-m"
            raise refusal(InvalidBuildingFile, f"unit of the column {kind}", self.path.name, need, "none")
        force, length = system
        return {"length": length, "force": force, "stiffness": force / length, "mass": force / length}[quantity]


def read_sheets(
    path: Path,
    names: Kinds,
    *,
    needed: tuple[str, ...],
    need: str,
    direction: str = "x",
    decimal: str | None = None,
) -> tuple[list[Sheet], list[str]]:
    """Read the tables of a file whose columns are known by `names`, and the titles of the others. The columns `needed`
    must be there beside a quantity; `need` is what errors say of the head.
    """
    first = "no rows"
    for tables, separator in _layouts(path):
        is_head = partial(_is_head, kinds=names, needed=needed, direction=direction)
        blocks = [block for title, rows in tables for block in _blocks(title, rows, is_head)]
        sheets = {
            place: _sheet(path, title, rows, names, needed, direction) for place, (title, rows) in enumerate(blocks)
        }
        result = [sheet for sheet in sheets.values() if sheet is not None]
        unread = [blocks[place][0] for place, sheet in sheets.items() if sheet is None]
        if result:
            if len(result) > 1 and any(TABLES.search(plain(sheet.title)) for sheet in result):
                unread += [sheet.title for sheet in result if not TABLES.search(plain(sheet.title))]
                result = [sheet for sheet in result if TABLES.search(plain(sheet.title))]
            _refuse_overlong(result, separator)
            mark = _mark(result, decimal)
            system = _system(row for _, rows in tables for row in rows)
            unread = [title for title in unread if title]
            return [replace(sheet, mark=mark, system=system) for sheet in result], unread
        lines = (", ".join(str(cell) for cell in row if cell != "") for _, rows in tables for row in rows)
        first = first if first != "no rows" else next((line for line in lines if line), first)
    raise refusal(InvalidBuildingFile, "rows", path.name, f"below {need}", short(first))


_SEPARATORS: Final = "\t;,|"
_TITLE: Final = re.compile(r"\s*TABLE:\s*(.*)", re.IGNORECASE)
_PAIR: Final = re.compile(r'([^\s="]+)=("[^"]*"|\S+)')
_TOKEN: Final = re.compile(r'"[^"]*"|\S+')
_UNITS: Final = re.compile(r'(?:curr\s*)?units\b\W*([a-z]+)[-,\s"]+([a-z]+)\b', re.IGNORECASE)


def _layouts(path: Path) -> Iterator[tuple[list[tuple[str, Rows]], str]]:
    """Tables of a file with their titles, by every way in which it may be laid out, with the separator."""
    try:
        content = read_file(path, MOST_TABLE)
    except OSError as error:
        raise InvalidBuildingFile(
            f"table must be a file that can be read; got {path} ({error.strerror or error})"
        ) from error
    if content.startswith(b"PK"):
        yield list(sheets_of(content, path.name).items()), ""
        return
    if content.startswith(b"\xd0\xcf\x11\xe0"):
        got = "an older workbook (.xls), or one with a password"
        raise refusal(InvalidBuildingFile, "content", path.name, "text or XLSX: save it as such", got)
    try:
        text = decoded(content)
    except UnicodeDecodeError:
        need = "UTF-8, UTF-16 or Windows-1252"
        raise refusal(InvalidBuildingFile, "text", path.name, need, "damaged text") from None
    if keyed := _keyed(text):
        yield keyed, "="
    for separator in _SEPARATORS:
        if separator in text:
            yield [("", _separated(text, separator, path.name))], separator
    yield [("", _fixed(text))], " "
    words = (list[Cell](line.split()) for line in text.split("\n")[:MOST_ROWS] if _WORD.search(line))
    yield [("", [row for row in words if len(row) <= MOST_COLUMNS])], " "


_WORD: Final = re.compile(r"[^\W_]")


def _separated(text: str, separator: str, name: str) -> Rows:
    """Rows of text with a separator, without empty cells at their ends."""
    rows: Rows = []
    try:
        for row in csv.reader(io.StringIO(text), delimiter=separator):
            while row and not row[-1].strip():
                row.pop()
            if len(row) > MOST_COLUMNS:
                raise refusal(InvalidBuildingFile, "columns", name, f"at most {MOST_COLUMNS}", str(len(row)))
            if any(map(_WORD.search, row)):
                rows.append(list(row))
            if len(rows) > MOST_ROWS:
                raise refusal(InvalidBuildingFile, "rows", name, f"at most {MOST_ROWS}", "more")
    except csv.Error as error:
        raise refusal(InvalidBuildingFile, "text", name, "a table", str(error)) from None
    return rows


def _keyed(text: str) -> list[tuple[str, Rows]]:
    """Tables of KEY=value lines (s2k), and the storeys of an e2k file; none where the text has no such lines."""
    tables: list[tuple[str, list[dict[str, str]]]] = []
    for line in re.sub(r" _\n", " ", text).split("\n")[: 10 * MOST_ROWS]:
        title = _TITLE.match(line) or re.match(r"\s*\$\s*(.*)", line)
        pairs = _PAIR.findall(line[:LONGEST_CELL]) if "=" in line else []
        if title:
            tables.append((title[1].strip(' "'), []))
        elif tables and pairs:
            tables[-1][1].append({key: value.strip('"') for key, value in pairs})
        elif tables and tables[-1][0].upper().startswith("STORIES"):
            tokens = [token.strip('"') for token in _TOKEN.findall(line)]
            if tokens[:1] == ["STORY"]:
                tables[-1][1].append(dict(zip(tokens[::2], tokens[1::2], strict=False)))
        elif tables and re.match(r"\s*UNITS\s", line):
            tables[-1][1].append({"UNITS": " ".join(_TOKEN.findall(line)[1:])})
    result: list[tuple[str, Rows]] = []
    for name, rows in tables:
        keys = list(dict.fromkeys(key for row in rows for key in row))[:MOST_COLUMNS]
        if rows:
            cells: Rows = [list(keys)]
            cells += ([row.get(key, "") for key in keys] for row in rows[:MOST_ROWS])
            result.append((name, cells))
    return result


def _fixed(text: str) -> Rows:
    """Rows of columns with spaces between them: two or more, or as many words as the head has."""
    lines = [line.expandtabs() for line in text.split("\n")[:MOST_ROWS] if _WORD.search(line)]
    rows: Rows = []
    spans: list[tuple[int, int]] = []
    for line in lines:
        pieces = [(each.start(), each.end(), each[0]) for each in re.finditer(r"\S+(?: \S+)*", line)]
        words = line.split()
        if len(pieces) != len(spans) and len(words) == len(spans):
            rows.append(list(words))
            continue
        if len(pieces) >= len(spans) or len(pieces) < 2:
            if not any(readings(piece) for _, _, piece in pieces):
                spans = [(start, end) for start, end, _ in pieces]
            rows.append([piece for _, _, piece in pieces])
            continue
        row = [""] * len(spans)
        for start, end, piece in pieces:
            below = [place for place, (left, right) in enumerate(spans) if start < right and end > left]
            if len(below) == 1 and not row[below[0]]:
                row[below[0]] = piece
        rows.append(list(row) if sum(map(bool, row)) == len(pieces) else [piece for _, _, piece in pieces])
    return rows


def _blocks(title: str, rows: Rows, is_head: Callable[[list[Cell]], bool]) -> Iterator[tuple[str, Rows]]:
    """Tables of a sheet, each below a row that begins with TABLE, or with a head of its own."""
    block: Rows = []
    has_head, left = False, _MOST_ABOVE
    for row in rows:
        match = _TITLE.match(_text(next((cell for cell in row if cell != ""), "")))
        is_text = left > 0 and not _has_number(row)
        left -= is_text
        begins = is_text and is_head(row)
        if match or (begins and has_head):
            rest = len(block)  # lines above a head belong to it
            while rest and not match and not _has_number(block[rest - 1]):
                rest -= 1
            if block[:rest]:
                yield title, block[:rest]
            title, block = match[1].strip(' "') if match else title, block[rest:]
        has_head = begins or (has_head and not match)
        if not match:
            block.append(row)
    if block:
        yield title, block


def _has_number(row: list[Cell]) -> bool:
    return any(isinstance(cell, float) or readings(cell[:LONGEST_CELL]) for cell in row)


def _text(cell: Cell) -> str:
    return cell.strip()[:LONGEST_CELL] if isinstance(cell, str) else ""


_UNIT_IN_BRACKETS: Final = re.compile(r"(.*?)[\s,;:/=_-]*[(\[]\s*([^()\[\]]*(?:\([^()]*\)[^()\[\]]*)?)[)\]]\s*")
_LONGEST_HEAD: Final = 100
_MOST_ABOVE: Final = 60
"""Rows without numbers among which heads are looked for."""
_BEFORE_UNIT: Final = re.compile(r"[\s,_/-]+(?:in[\s_]+)?")


def _kind_and_unit(head: str, kinds: Kinds, direction: str) -> tuple[str, str]:
    """What a column holds, and its unit: in brackets, or as the last words of the head."""
    if len(head) > _LONGEST_HEAD:
        return "", ""
    bracket = _UNIT_IN_BRACKETS.fullmatch(head)
    bracket = None if bracket and re.match(r"[xy]\b", plain(bracket[2])) else bracket
    # "Drift/" of ETABS holds one over the drift.
    kind = "" if head.endswith("/") else column_kind(bracket[1] if bracket else head, direction, kinds)
    unit = bracket[2].strip() if bracket else ""
    for match in () if bracket else _BEFORE_UNIT.finditer(head):
        of_name, last = column_kind(head[: match.start()], direction, kinds), head[match.end() :]
        if of_name and (last in ("%", "rad") or _size(last, QUANTITIES.get(of_name, "length"), metric=True)):
            kind, unit = of_name, last
            break
    if kind in TEXTS and unit.lower() not in _NO_UNIT:
        is_level = kind == "storey" and "elevation" in kinds.values() and _size(unit, "length", metric=True)
        kind = "elevation" if is_level else ""
    return kind, unit


def _is_head(row: list[Cell], kinds: Kinds, needed: tuple[str, ...], direction: str) -> bool:
    """Whether a row names the columns of a table."""
    names = {_kind_and_unit(_text(cell), kinds, direction)[0] for cell in row} - {""}
    return {*needed} <= names and not names <= {*TEXTS}


def _sheet(path: Path, title: str, rows: Rows, kinds: Kinds, needed: tuple[str, ...], direction: str) -> Sheet | None:
    """The first rows of a table that are a head, and what is below; None where there is no head."""
    other = "y" if direction == "x" else "x"
    for number, row in enumerate(rows[:_MOST_ABOVE]):
        for head, below in _heads(rows, number, row):
            named = (_without_symbol(cell, head, kinds, direction) for cell in head)
            held, units_of = map(list, zip(*(_kind_and_unit(cell, kinds, direction) for cell in named), strict=True))
            body = rows[below:]
            if body and _is_unit_row(body[0], [place for place, kind in enumerate(held) if kind == "storey"]):
                for place, cell in enumerate(body[0][: len(head)]):
                    if unit := _text(cell).strip("()[]") * (not units_of[place]):
                        held[place], units_of[place] = _kind_and_unit(f"{head[place]} ({unit})", kinds, direction)
                body = body[1:]
            full = [place for place in range(len(head)) if any(place < len(row) and row[place] != "" for row in body)]
            columns = {}
            for kind in dict.fromkeys(kinds.values()):
                places = [place for place, each in enumerate(held) if each == kind]
                if kind not in (*needed, *TEXTS) or len(places) > 1:
                    places = [place for place in places if place in full] or places[: kind in needed]
                if kind == "elevation" and "x" in map(plain, head):
                    places = [place for place in places if not re.match(r"z\b", plain(head[place]))]  # of a point
                if places:
                    _refuse_two(
                        path, kind, [head[place] for place in places], [[_at(row, p) for row in body] for p in places]
                    )
                    columns[kind] = places[0]
            if all(kind in columns for kind in needed) and any(kind not in TEXTS for kind in columns):
                if needed == ("storey",) and direction == "x" and "shear" not in columns:
                    _refuse_vy(path, head)
                units = {k: "" if units_of[p].lower() in _NO_UNIT else units_of[p] for k, p in columns.items()}
                further = [place for place in full if place not in columns.values()]
                in_other = [p for p in further if not held[p] and _kind_and_unit(head[p], kinds, other)[0]]
                unread, others = (
                    tuple(head[place] for place in further if (place in in_other) == known_there)
                    for known_there in (False, True)
                )
                heads = {kind: head[place] for kind, place in columns.items()}
                return Sheet(path, title, columns, heads, units, body, len(head), any(units_of), unread, others)
    return None


def _heads(rows: Rows, number: int, row: list[Cell]) -> Iterator[tuple[list[str], int]]:
    """A row as a head; joined with the row below where that has X and Y below merged cells."""
    head = [_text(cell) for cell in row]
    below = [_text(cell) for cell in rows[number + 1]] if number + 1 < len(rows) else []
    axes = [match[0] if (match := re.match(r"[xy]\b", plain(cell))) else "" for cell in below]
    if {"x", "y"} <= set(axes) and not _has_number(rows[number + 1]):
        width, joined, last = max(len(head), len(below)), [], ""
        for place in range(width):
            above = head[place] if place < len(head) else ""
            last = above or last
            match = _UNIT_IN_BRACKETS.fullmatch(last)
            unit = f" ({match[2]})" if match else ""
            under = below[place] if place < len(below) else ""
            joined.append(f"{match[1] if match else last} {under}{unit * ('(' not in under)}" if under else above)
        yield joined, number + 2
    yield head, number + 1


def _at(row: list[Cell], place: int) -> Cell:
    return row[place] if place < len(row) else ""


def _refuse_two(path: Path, kind: str, heads: list[str], columns: list[list[Cell]]) -> None:
    """Refuse two columns of one quantity that differ."""
    if kind not in TEXTS and any(column != columns[0] for column in columns[1:]):
        got = " and ".join(short(head) for head in heads)
        raise refusal(InvalidBuildingFile, f"columns of {kind}", path.name, "one: remove the others", got)


def _without_symbol(name: str, head: list[str], kinds: Kinds, direction: str) -> str:
    """A name without V_x or V_y behind that of a yield shear. V_y is no direction where no column is of x."""
    of_x = any(re.search(r"(?<![a-z])[ukvf]?_?x(?![a-z])", plain(cell)) for cell in head)
    shorter = re.sub(rf"(?<=\w)[\s,;(\[]+V_?[{direction}{'' if of_x else 'y'}]\b[)\]]?", "", name, flags=re.IGNORECASE)
    is_yield_shear = shorter != name and _kind_and_unit(shorter, kinds, direction)[0] == "strength"
    return shorter if is_yield_shear else name


def _refuse_vy(path: Path, head: list[str]) -> None:
    """Refuse VY without VX: a yield shear, or the shear in the direction y."""
    vy = next((cell for cell in head if re.fullmatch(r"vy\b.*", cell, re.IGNORECASE)), None)
    if vy is not None:
        need = "called Yield Shear, or Shear Y where it is the shear in the direction y"
        raise refusal(InvalidBuildingFile, f"column {short(vy)}", path.name, need, "VY without VX")


def _is_unit_row(row: list[Cell], storeys: list[int]) -> bool:
    """Whether a row below the head, with nothing in one of the columns of storeys, states units."""
    if storeys and all(plain(_text(_at(row, place))).strip("()[] ") not in _NO_UNIT for place in storeys):
        return False
    return any(map(_text, row)) and not _has_number(row)


def _refuse_overlong(sheets: list[Sheet], separator: str) -> None:
    """Refuse rows of text with commas that have more cells than the head."""
    for sheet in sheets:
        for row in sheet.body:
            if separator == "," and len(row) > sheet.width:
                need = "as many as its head has: is the comma decimal, too? Save the table with semicolons"
                got = short(",".join(map(str, row)))
                raise refusal(InvalidBuildingFile, "cells of a row", sheet.path.name, need, got)


def _mark(sheets: list[Sheet], decimal: str | None) -> Mark | None:
    """Decimal mark of a file: as stated, else that of all numbers that can be read in only one way."""
    if decimal is not None:
        return DECIMAL[decimal]
    marks: set[Mark] = set()
    for sheet in sheets:
        for kind in set(sheet.columns) - set(TEXTS):
            cells = [sheet.cell(row, kind) for row in range(len(sheet.body))]
            result = [readings(cell[:LONGEST_CELL]) for cell in cells if isinstance(cell, str)]
            marks |= {mark for each in result if len(each) == 1 for mark in each}
    return marks.pop() if len(marks) == 1 else None


def _system(rows: Iterator[list[Cell]]) -> tuple[float, float] | None:
    """Units of force and length that a file states for all numbers, as "Curr Units" with "kN, m, C" below it."""
    previous: list[Cell] = []
    for row in itertools.islice(rows, 10 * MOST_ROWS):
        for place, cell in enumerate(row):
            head = _text(_at(previous, place))
            text = ", ".join(map(_text, row[place : place + 2]))
            text = f"units: {_text(cell)}" if plain(head).replace(" ", "") in ("currunits", "units") else text
            match = _UNITS.search(text) if "units" in text.lower() else None
            if match:
                try:
                    return system_of(f"{match[1]}-{match[2]}", "file")
                except InvalidBuildingFile:
                    continue
        previous = row
    return None
