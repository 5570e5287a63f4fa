"""Storey tables as other programs export them: names, heights, masses, stiffnesses and strengths, in SI units.

Columns are recognised by their names, as in tables of ETABS and SAP2000; units stand in the head, in a row below it, or
are stated for the whole table. Tables of several files and sheets are joined by the names of storeys.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import Final, Literal, NoReturn

import numpy as np

from seismass.assessment.table_file import (
    MOST_RATIO,
    QUANTITIES,
    Sheet,
    few_names,
    one_case,
    read_sheets,
    readings,
    system_of,
)
from seismass.assessment.table_words import (
    COLUMNS,
    NO_STOREY,
    TEXTS,
    Order,
    is_base,
    is_basement,
    is_ground,
    is_mezzanine,
    is_roof,
    is_roof_first,
    plain,
    refuse_summaries,
    refuse_sums,
    refuse_towers,
)
from seismass.base.errors import InvalidBuildingFile
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_path, printable, refusal, short
from seismass.base.views import Card
from seismass.media.text_table import text_table

_OF_A_CASE: Final = ("stiffness", "shear", "drift", "drift ratio")
"""Quantities that differ from one load case to another."""
_SAME: Final = 0.01
"""Part by which one quantity of a storey may differ between two tables, which are rounded."""
_TALL: Final = 1.5
"""Height of the lowest storey over that of the tallest other one above which elevations may start elsewhere."""
_TALLEST: Final = 10.0
"""The same of a single storey (m)."""
_LOW: Final = 6.0
"""Height of a lowest storey (m) at which elevations still start at the ground."""
_GROWS: Final = 1.5
"""Highest over lowest of heights that grow from storey to storey from which they may be counted from the ground."""


@dataclass(frozen=True)
class StoreyTable(Card):
    """Storeys of another program's model in SI units, storey 1 first: heights (m), floor masses (kg), stiffnesses (N/m)
    and yield shears (N), None where the table has none; `remarks` tell what was inferred and what was left out. Masses
    with `live_mass` are those of a program, which may include a share of the live load.
    """

    source: str
    names: tuple[str, ...]
    heights: FloatArray | None
    mass: FloatArray | None
    stiffness: FloatArray | None
    strength: FloatArray | None
    remarks: tuple[str, ...] = field(default=())
    live_mass: bool = False

    @property
    def text(self) -> str:
        """What was read, as a table with the roof at its top."""
        columns = {
            "height m": (self.heights, 1.0),
            "mass t": (self.mass, 1e-3),
            "weight kN": (self.mass, 1e-3 * STANDARD_GRAVITY),
            "stiffness kN/m": (self.stiffness, 1e-3),
            "yield shear kN": (self.strength, 1e-3),
        }
        shown = {name: (values, unit) for name, (values, unit) in columns.items() if values is not None}
        rows = [["storey", "name", *shown]]
        for i in reversed(range(len(self.names))):
            cells = [f"{unit * float(values[i]):.6g}" for values, unit in shown.values()]
            rows.append([str(i + 1), self.names[i], *cells])
        lines = [f"read from {printable(self.source)}", *text_table(rows, left=2)]
        return "\n".join([*lines, *(f"  {remark}" for remark in self.remarks)])


def read_storey_table(
    source: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    *,
    units: str | None = None,
    order: Order | None = None,
    direction: Literal["x", "y"] = "x",
    case: str | None = None,
    decimal: Literal["comma", "point"] | None = None,
    base_level: float | str | None = None,
) -> StoreyTable:
    r"""Read storey tables.

    Parameters
    ----------
    source : path-like, or several
        Text (separated by commas, semicolons or tabs, in fixed columns, or s2k and e2k) or XLSX with all its sheets.
        The head of a table is the first row with a column of storeys and another known one. Tables of several files
        and sheets are joined by the names of storeys.
    units : str, optional
        Force and length of numbers whose column states no unit, as these programs have them: "kN-m", "kip-in", "kgf-m".
        Masses are then in force times s2 over length.
    order : {"roof-first", "ground-first"}, optional
        Order of the rows, where neither elevations nor names say it.
    direction : {"x", "y"}, default "x"
        Which of the columns "Stiffness X" and "Stiffness Y" is read; the same of masses, shears and drifts.
    case : str, optional
        Load case of stiffnesses, shears and drifts; needed where the tables have several.
    decimal : {"comma", "point"}, optional
        Decimal mark; needed where no number of a file shows it, as in 1,204.
    base_level : float or str, optional
        Elevation (m) at which the building is held, or the name of the floor there: lower floors are left out.
        "lowest" keeps all of them. Needed with basements, or elevations above the sea, where no row Base says it.

    Returns
    -------
    StoreyTable
        The storeys, in SI units.

    Raises
    ------
    InvalidBuildingFile
        A file cannot be read, has no head that is known, a cell that is no number, a storey twice, a row of totals,
        means or notes, or what has to be stated: a unit, an order, a load case, a decimal mark, the base level.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> from seismass.assessment import read_storey_table
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "storeys.csv"
    ...     _ = file.write_text("Story,Height (m),Mass (t),Stiffness X (kN/m)\nRoof,3.5,120,2e5\nStory1,4,150,3e5\n")
    ...     table = read_storey_table(file)
    >>> table.names, table.mass.tolist(), table.stiffness.tolist()
    (('Story1', 'Roof'), [150000.0, 120000.0], [300000000.0, 200000000.0])
    """
    sources = [source] if isinstance(source, str | os.PathLike) else source
    paths = [as_path(each, "storey table", InvalidBuildingFile) for each in sources]
    need = "a head with a column story and others such as elevation, height, mass, weight, stiffness"
    joined = _Joined(", ".join(path.name for path in paths), case)
    system = None if units is None else system_of(units, joined.source)
    tables: list[_Rows] = []
    for path in paths:
        sheets, others = read_sheets(path, COLUMNS, needed=("storey",), need=need, direction=direction, decimal=decimal)
        joined.remarks += [f"tables of {printable(path.name)} that are not read: {few_names(others)}"] * bool(others)
        tables += (_Rows(sheet, direction) for sheet in sheets)
    joined.add(tables, system)
    return _ordered(joined, order, base_level, direction)


class _Rows:
    """Rows of a sheet with the names of their storeys; of rows of several directions and places those that are asked
    for.
    """

    def __init__(self, sheet: Sheet, direction: str) -> None:
        self.sheet = sheet
        texts = {kind: sheet.texts(kind) for kind in sheet.columns if kind in TEXTS}
        self.kinds = [kind for kind in sheet.columns if kind not in TEXTS]
        full = [row for row in range(len(sheet.body)) if any(sheet.cell(row, kind) != "" for kind in self.kinds)]
        for kind in {"storey", "case", "tower"} & set(texts):
            self._fill(texts[kind], full, refused=kind == "storey" and not {"case", "direction"} & set(texts))
        rows = [row for row, name in enumerate(texts["storey"]) if name]
        if "direction" in texts:
            rows = [row for row in rows if plain(texts["direction"][row]).strip() in (direction, f"dir {direction}")]
            if not rows:
                raise refusal(InvalidBuildingFile, "rows", sheet.label, f"some of the direction {direction}", "none")
        places = [plain(place)[:3] for place in texts.get("location", [])]
        if {"top", "bot"} <= {places[row] for row in rows if places}:
            rows = [row for row in rows if places[row] == "bot"]
        self.rows = rows
        self.names = [texts["storey"][row] for row in rows]
        refuse_summaries(self.names, sheet.path.name)
        refuse_towers(list(dict.fromkeys(self.names)), sheet.path.name)
        self.cases = [texts["case"][row] for row in rows] if "case" in texts else []
        towers = sorted({tower for tower in texts.get("tower", []) if tower})
        if len(towers) > 1:
            need = "of one tower: keep the rows of one, and write a file for each"
            raise refusal(InvalidBuildingFile, "rows", sheet.label, need, few_names(towers))
        keys = [tuple(_key(texts[kind][row]) for kind in texts) for row in rows]
        twice = next((name for name, key in zip(self.names, keys, strict=True) if keys.count(key) > 1), None)
        if twice is not None:
            count = sum(name == twice for name in self.names)
            got = f"{short(twice)} in {count} rows: keep one load case and one diaphragm, and name storeys differently"
            raise refusal(InvalidBuildingFile, "rows", sheet.label, "one for each storey", got)

    def _fill(self, column: list[str], full: list[int], *, refused: bool) -> None:
        """Write names into the blank cells below them, as merged cells have it; a table of one row for each storey has
        none.
        """
        for row in full:
            above = column[row - 1] if row else ""
            if refused and not column[row]:
                need = "the name of a storey in each: remove what is no storey, or name it"
                got = f"none below {short(above)}" if above else "none"
                raise refusal(InvalidBuildingFile, "rows with numbers", self.sheet.label, need, got)
            column[row] = column[row] or above

    def values(self, kind: str, case: str | None, system: tuple[float, float] | None) -> dict[str, float]:
        """Return the numbers of a quantity in SI units by storey, in the rows of a load case; NaN: none."""
        sheet = self.sheet
        unit = sheet.units[kind].strip()
        if kind == "drift" and is_roof(sheet.heads[kind]):
            need = "those of storeys, called Story Drift"
            raise refusal(InvalidBuildingFile, "column of drifts", sheet.label, need, short(sheet.heads[kind]))
        ratio = kind == "drift" and unit in ("", "%", "rad")
        factor = (0.01 if unit == "%" else 1.0) if ratio else sheet.factor(kind, QUANTITIES[kind], system)
        owners = [f"row {row + 1}" for row in range(len(sheet.body))]
        for row, name in zip(self.rows, self.names, strict=True):
            owners[row] = f"storey {short(name)}"
        rows_left = [i for i in range(len(self.rows)) if case is None or not self.cases or self.cases[i] == case]
        left_out = set(range(len(sheet.body))) - {self.rows[i] for i in rows_left if not is_base(self.names[i])}
        numbers = sheet.numbers(kind, factor, owners, left_out=left_out)
        named = bool({"ratio", "drifts"} & set(plain(f"{sheet.heads[kind]} {sheet.title}").split()))
        if ratio and (not (named or sheet.states_units) or (np.abs(numbers) > MOST_RATIO).any()):
            need = "stated in its head: Drift (mm), or Drift Ratio where it is that of the height"
            raise refusal(InvalidBuildingFile, "unit of the column drift", sheet.label, need, unit or "none")
        result: dict[str, float] = {}
        for i in rows_left:
            name, number = self.names[i], numbers[self.rows[i]]
            number = abs(number) if kind in ("shear", "drift") else number
            known = result.get(name, np.nan)
            if not np.isnan(known) and not np.isnan(number) and known != number:
                need = "one number: keep one load case, one step and one diaphragm"
                raise refusal(InvalidBuildingFile, f"{kind} of storey {short(name)}", sheet.label, need, "several")
            result[name] = known if np.isnan(number) else number
        return result


class _Joined:
    """Quantities of storeys from several tables, by the names of storeys."""

    def __init__(self, source: str, case: str | None) -> None:
        self.source, self.case = source, case
        self.names: dict[str, str] = {}  # as they are joined, and as the first table has them
        self.values: dict[str, dict[str, float]] = {}
        self.remarks: list[str] = []
        self.carried: dict[str, list[str]] = {}
        self.live_mass = self.case_used = False
        self.of_other: list[str] = []
        self._owners: dict[str, str] = {}

    def add(self, tables: list[_Rows], system: tuple[float, float] | None) -> None:
        """Add the tables of a file; quantities that another one replaces are left out."""
        whole_kinds = {kind for rows in tables for kind in rows.kinds if "center" not in plain(rows.sheet.title)}
        order = sorted(tables, key=lambda rows: not {"height", "elevation"} & set(rows.kinds))
        for rows in order:
            for name in rows.names:
                self.names.setdefault(_key(name), name)
            for kind in rows.kinds:
                if kind == "mass" and "center" in plain(rows.sheet.title) and "mass" in whole_kinds:
                    self.remarks.append(f"masses of {rows.sheet.label} are left out: a summary of masses is there")
                elif not (kind in ("shear", "drift") and "stiffness" in whole_kinds):
                    self._join(rows, kind, system)
            unread = few_names(rows.sheet.unread)
            self.remarks += [f"columns of {rows.sheet.label} that are not read: {unread}"] * bool(unread)
            self.of_other += rows.sheet.of_other

    def _join(self, rows: _Rows, kind: str, system: tuple[float, float] | None) -> None:
        sheet = rows.sheet
        case = None
        if kind in _OF_A_CASE and rows.cases:
            case = one_case(rows.cases, self.case, sheet.label, "--case")
            sentence = f"stiffnesses, or shears and drifts, are of the load case {short(case)}"
            self.remarks += [sentence] * (not self.case_used)
            self.case_used = True
        result = rows.values(kind, case, system)
        if kind in ("mass", "weight"):
            refuse_sums(list(result), list(result.values()), sheet.path.name)
            self.live_mass |= bool(sheet.title and "mass summary" in plain(sheet.title))
            self.live_mass |= re.sub(r"\W|[(\[].*", "", plain(sheet.heads[kind])) in _PROGRAM
            self.live_mass |= any(word in plain(sheet.heads[kind]) for word in ("seism", "sismi"))
        if kind == "drift" and sheet.units[kind].strip() in ("", "%"):
            kind = "drift ratio"
        table = self.values.setdefault(kind, {})
        for name, number in result.items():
            key = _key(name)
            known = table.get(key, np.nan)
            if not np.isnan(known) and not np.isnan(number) and abs(known - number) > _SAME * abs(known):
                what = f"{kind} of storey {short(name)}"
                need = f"that of {self._owners[kind]}: leave one of the tables out"
                raise refusal(InvalidBuildingFile, what, sheet.label, need, f"{number:.6g} beside {known:.6g}")
            table[key] = number if np.isnan(known) else known
        self._owners.setdefault(kind, sheet.label)
        column = sheet.columns[kind if kind in sheet.columns else "drift"]
        for row, name in zip(rows.rows, rows.names, strict=True):
            cell = sheet.body[row][column] if column < len(sheet.body[row]) else ""
            text = printable(f"{cell:.10g}" if isinstance(cell, float) else cell.strip())
            if kind != "elevation" and text.strip("0.,-"):
                sentence = f"{kind} {short(text)} {printable(sheet.units.get(kind, ''))}".rstrip()
                self.carried.setdefault(_key(name), []).append(sentence)


_PROGRAM: Final = ("ux", "uy", "massx", "massy", "massux", "massuy")
"""Names of columns of masses as programs have them, whose mass source may hold a share of the live load."""


def _key(name: str) -> str:
    """A name as tables are joined by it."""
    return "".join(name.casefold().split())


def _ordered(
    joined: _Joined, order: Order | None, base_level: float | str | None, direction: Literal["x", "y"]
) -> StoreyTable:
    """Storeys from the ground up, without the row of the base and what is below the base level."""
    file, values, remarks = joined.source, joined.values, joined.remarks
    if joined.case is not None and not joined.case_used:
        raise refusal(
            InvalidBuildingFile, "load case", file, "left out: no quantity of a load case is read", joined.case
        )
    keys = list(joined.names)
    for key in keys:
        if (
            not is_base(key)
            and not is_ground(joined.names[key])
            and all(np.isnan(rows_of.get(key, np.nan)) for rows_of in values.values())
        ):
            raise refusal(InvalidBuildingFile, f"row {short(joined.names[key])}", file, NO_STOREY, "no number in it")
    elevation = values.get("elevation", {})
    bare = [key for key in keys if np.isnan(elevation.get(key, np.nan)) and not is_base(key)]
    if bare and len(bare) < len([key for key in keys if not is_base(key)]):
        what = f"elevation of storey {short(joined.names[bare[0]])}"
        raise refusal(InvalidBuildingFile, what, file, "a number", "nothing")
    has_elevations = bool(elevation) and not bare
    if has_elevations:
        keys.sort(key=lambda key: -np.inf if np.isnan(elevation.get(key, np.nan)) else elevation[key])
    elif is_roof_first(list(joined.names.values()), order, file):
        keys.reverse()
    loads = [values[kind] for kind in ("mass", "weight", "stiffness", "height") if kind in values]
    ground = [key for key in keys if is_base(key)]
    if not ground and keys and all(not each.get(keys[0], 0.0) > 0.0 for each in loads):
        ground = [key for key in keys[:1] if is_ground(joined.names[key])]
    base = None
    for key in ground:
        keys.remove(key)
        if not np.isnan(elevation.get(key, np.nan)):
            base = float(elevation[key])
        sentence = joined.carried.get(key, [])
        carried = f", with {', '.join(sentence)}" if sentence else ""
        remarks.append(f"row {short(joined.names[key])} is the ground and no storey: left out{carried}")
    if not keys:
        raise refusal(InvalidBuildingFile, "rows", file, "a storey at least", "none")

    def column(kind: str) -> FloatArray | None:
        return np.array([values[kind].get(key, np.nan) for key in keys]) if kind in values else None

    names = [joined.names[key] for key in keys]
    levels = np.array([elevation[key] for key in keys]) if has_elevations else None
    heights, lowest = _heights(file, names, column("height"), levels, base, bool(ground), base_level, remarks)
    columns = {kind: whole[lowest:] for kind in values if (whole := column(kind)) is not None}
    names = names[lowest:]
    mass, weight = columns.get("mass"), columns.get("weight")
    if mass is not None and weight is not None and not np.allclose(mass * STANDARD_GRAVITY, weight, rtol=0.02):
        raise refusal(InvalidBuildingFile, "masses", file, "the weights over g: remove one of the columns", "others")
    if mass is None and weight is not None:
        mass = weight / STANDARD_GRAVITY
        remarks.append("masses are weights over g")
    other = "y" if direction == "x" else "x"
    if joined.of_other:
        listed = few_names(tuple(dict.fromkeys(joined.of_other)))
        remarks.append(f"direction {direction} is read, and not {listed}: --direction {other} reads {other}")
    result = {
        "height": heights,
        "mass": mass,
        "stiffness": _stiffness(columns, heights, file, remarks),
        "strength": columns.get("strength"),
    }
    for kind, numbers in result.items():
        for i, number in enumerate(() if numbers is None else numbers):
            if not 0.0 < number < np.inf:
                got = "nothing" if np.isnan(number) else f"{number:g}"
                what = f"{kind} of storey {short(names[i])}"
                need = "a positive number" + f", or --direction {other} be given" * bool(joined.of_other)
                raise refusal(InvalidBuildingFile, what, file, need, got)
    remarks += [
        f"{short(name)} is taken as a whole floor: where it covers a part, add its mass and height to the floor above"
        for name in names
        if is_mezzanine(name)
    ]
    return StoreyTable(
        source=file,
        names=tuple(names),
        heights=heights,
        mass=mass,
        stiffness=result["stiffness"],
        strength=result["strength"],
        remarks=tuple(remarks),
        live_mass=joined.live_mass and mass is not None,
    )


def _stiffness(
    columns: dict[str, FloatArray], heights: FloatArray | None, file: str, remarks: list[str]
) -> FloatArray | None:
    """Stiffnesses as they stand, or shears over drifts."""
    shear, drift, ratio = (columns.get(kind) for kind in ("shear", "drift", "drift ratio"))
    if "stiffness" in columns:
        return columns["stiffness"]
    if shear is None or (drift is None and ratio is None):
        if len({"shear", "drift", "drift ratio"} & set(columns)):
            alone = "drifts without shears" if shear is None else "shears without drifts"
            remarks.append(f"{alone} give no stiffness: they are not used")
        return None
    of_heights = ""
    if drift is None:
        if heights is None:
            raise refusal(InvalidBuildingFile, "height", file, "given with drift ratios", "none")
        drift, of_heights = np.asarray(ratio) * heights, ", which are ratios of the heights"
    remarks.append(f"stiffnesses are shears over drifts{of_heights}")
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.abs(shear) / np.abs(drift))


def _ask_level(file: str, got: str) -> NoReturn:
    need = (
        "stated by --base-level: the elevation (m) at which the building is held, the name of the floor there, or "
        "lowest, where all rows are its storeys"
    )
    raise refusal(InvalidBuildingFile, "base level", file, need, got)


def _heights(
    file: str,
    names: list[str],
    heights: FloatArray | None,
    levels: FloatArray | None,
    base: float | None,
    has_base: bool,
    base_level: float | str | None,
    remarks: list[str],
) -> tuple[FloatArray | None, int]:
    """Heights of the storeys above the base level, and the number of floors that are left out at it and below."""
    if levels is not None:
        base = _checked_levels(file, names, heights, levels, base, remarks)
    lowest, level = 0, base
    level_key = _key(str(base_level))
    keys = [_key(name) for name in names]
    if base_level is None:
        under = () if levels is None or base is None or base > -1e-6 else levels < 1e-6
        below = [name for name, is_under in zip_longest(names, under) if is_under or is_basement(name)]
        if levels is not None and base is None:
            tallest = max(float(np.diff(levels).max()) * _TALL, _LOW) if len(levels) > 1 else _TALLEST
            if not 0.0 < levels[0] <= tallest:
                _ask_level(file, f"{short(names[0])} at {levels[0]:g} m as the lowest floor, and no row Base")
        if below and not has_base:
            _ask_level(file, f"{few_names(below)} below ground, or at it, and no row Base")
        sentence = "below ground, or at it: storeys, too, unless --base-level leaves them out"
        remarks += [f"{few_names(below)} {sentence}"] * bool(below)
    elif level_key in keys:
        lowest = keys.index(level_key) + 1
        level = None if levels is None else float(levels[lowest - 1])
    elif level_key != "lowest":
        result = readings(level_key)
        if levels is None or len(set(result.values())) != 1:
            _ask_level(file, f"{short(level_key)}{', but the tables have no elevations' * (levels is None)}")
        level = next(iter(result.values()))
        lowest = int(np.searchsorted(levels, level + 1e-6))
        if base is not None and level < base - 1e-3:
            _ask_level(file, f"{level:g} m, below the base at {base:g} m")
    elif base is None and levels is not None:
        _ask_level(file, "lowest, without heights and without the elevation of a row Base")
    if lowest >= len(names):
        _ask_level(file, f"{base_level}, above all floors")
    remarks += [f"{few_names(names[:lowest])}: at the base level or below, left out"] * bool(lowest)
    if levels is None:
        counted = heights is not None and len(heights) > 1 and bool((np.diff(heights) > 0.0).all())
        if heights is not None and counted and heights[-1] >= _GROWS * heights[0]:
            need = "each from floor to floor: where they count from the ground call the column Elevation, else add one"
            raise refusal(InvalidBuildingFile, "heights", file, need, f"{few_names([f'{h:g}' for h in heights])} m")
        return (None if heights is None else heights[lowest:]), lowest
    if heights is None or lowest or level != base:
        remarks.append(f"heights are differences of elevations, over a base at {level or 0.0:g} m")
        return np.diff(levels[lowest:], prepend=level or 0.0), lowest
    return heights, lowest


def _checked_levels(
    file: str,
    names: list[str],
    heights: FloatArray | None,
    levels: FloatArray,
    base: float | None,
    remarks: list[str],
) -> float | None:
    """The elevation of the base where it is known; two floors at one elevation are refused."""
    steps = np.diff(levels)
    if (steps < 1e-6).any():
        i = int(np.argmax(steps < 1e-6))
        need = "each at an elevation of its own: make one row of parts of a floor, or of two roofs, with all mass"
        got = f"{short(names[i])} and {short(names[i + 1])} at {levels[i]:g} m"
        raise refusal(InvalidBuildingFile, "floors", file, need, got)
    if heights is None:
        return base
    if not np.allclose(heights[1:], steps, rtol=0.01, atol=0.02):
        i = int(np.argmax(np.abs(heights[1:] - steps)))
        others = f"{heights[i + 1]:g} m of {short(names[i + 1])} over {steps[i]:g} m"
        remarks.append(f"heights are not the differences of elevations ({others}): is a storey missing?")
    return float(levels[0] - heights[0]) if base is None else base
