"""Storey tables as other programs export them: names, heights, masses, stiffnesses and strengths, in SI units.

Columns are recognised by their names, as in tables of ETABS and SAP2000; units stand in the head, in a row below it, or
are stated for the whole table.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, Literal

import numpy as np

from seismass.assessment.sheet import Sheet, read_sheet
from seismass.assessment.storey_rows import is_base, refuse_summaries, refuse_sums
from seismass.assessment.storey_units import Quantity, system_of
from seismass.base.errors import InvalidBuildingFile
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_path, printable, refusal, short
from seismass.base.views import Card
from seismass.media.text_table import text_table

Order = Literal["roof-first", "ground-first"]

COLUMNS: Final[dict[str, tuple[str, ...]]] = {
    "storey": ("story", "storey", "level", "floor", "name", "story name", "storey name", "floor level"),
    "elevation": ("elevation", "elev", "story elevation", "storey elevation", "z"),
    "height": ("height", "story height", "storey height", "h"),
    "mass": ("mass", "mass x", "ux", "mass ux", "floor mass", "story mass", "storey mass", "m"),
    "weight": ("weight", "floor weight", "story weight", "storey weight", "seismic weight", "w"),
    "stiffness": ("stiffness", "stiffness x", "stiff x", "kx", "k", "story stiffness", "storey stiffness"),
    "strength": ("yield shear", "yield strength", "shear strength", "strength", "vy", "yield shear x"),
    "shear": ("shear", "shear x", "vx", "v", "story shear", "storey shear", "base shear"),
    "drift": ("drift", "drift x", "story drift", "storey drift", "drift ratio"),
}
"""Names of columns, in small letters; x stands for the direction that is asked for."""
_QUANTITIES: Final[dict[str, Quantity]] = {
    "elevation": "length",
    "height": "length",
    "mass": "mass",
    "weight": "force",
    "stiffness": "stiffness",
    "strength": "force",
    "shear": "force",
    "drift": "length",
}
_BASE: Final = re.compile(r"base|ground|foundation|0", re.IGNORECASE)
_ROOF: Final = re.compile(r"roof|top", re.IGNORECASE)


@dataclass(frozen=True)
class StoreyTable(Card):
    """Storeys of another program's model in SI units, storey 1 first: heights (m), floor masses (kg), stiffnesses (N/m)
    and yield shears (N), None where the table has none; `remarks` tell what was inferred.
    """

    source: str
    names: tuple[str, ...]
    heights: FloatArray | None
    mass: FloatArray | None
    stiffness: FloatArray | None
    strength: FloatArray | None
    remarks: tuple[str, ...] = field(default=())

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
    source: str | os.PathLike[str],
    *,
    units: str | None = None,
    order: Order | None = None,
    direction: Literal["x", "y"] = "x",
) -> StoreyTable:
    r"""Read a storey table.

    Parameters
    ----------
    source : path-like
        CSV (comma, semicolon or tab) or XLSX. The head is the first row with a column of storeys and another known one.
    units : str, optional
        Force and length of numbers whose column states no unit, as these programs have them: "kN-m", "kip-in", "kgf-m".
        Masses are then in force times s2 over length.
    order : {"roof-first", "ground-first"}, optional
        Order of the rows, where neither elevations nor names say it.
    direction : {"x", "y"}
        Which of the columns "Stiffness X" and "Stiffness Y" is read; the same of masses, shears and drifts.

    Returns
    -------
    StoreyTable
        The storeys, in SI units.

    Raises
    ------
    InvalidBuildingFile
        The file cannot be read, has no head that is known, a cell that is no number, a storey twice, a row of totals,
        means or notes, or a unit or an order that has to be stated.
    MissingPackage
        openpyxl is needed for XLSX.

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
    path = as_path(source, "storey table", InvalidBuildingFile)
    need = "a head with a column story and others such as elevation, height, mass, weight, stiffness"
    sheet = read_sheet(path, COLUMNS, needed=("storey",), need=need, direction=direction)
    names = sheet.texts("storey")
    refuse_summaries(names, path.name)
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated:
        got = f"{short(repeated[0])} in {names.count(repeated[0])} rows: keep one load case and one diaphragm"
        raise refusal(InvalidBuildingFile, "rows", path.name, "one for each storey", got)
    system = None if units is None else system_of(units, path.name)
    owners = [f"storey {short(name)}" for name in names]
    base_rows = [i for i, name in enumerate(names) if is_base(name)]
    ratio = "drift" in sheet.columns and not sheet.units["drift"]
    values: dict[str, list[float]] = {}
    for kind in sheet.columns:
        if kind != "storey":
            factor = 1.0 if kind == "drift" and ratio else sheet.factor(kind, _QUANTITIES[kind], system)
            values[kind] = sheet.numbers(kind, factor, owners, left_out=base_rows)
    for kind in ("mass", "weight"):
        if kind in values:
            refuse_sums(names, values[kind], path.name)
    return _ordered(sheet, names, values, order, ratio=ratio)


def _ordered(
    sheet: Sheet, names: list[str], values: dict[str, list[float]], order: Order | None, *, ratio: bool
) -> StoreyTable:
    """Storeys from the ground up, without the row of the base."""
    path = sheet.path
    remarks: list[str] = []
    rows = list(range(len(names)))
    elevation = values.get("elevation")
    if elevation is not None:
        for name, number in zip(names, elevation, strict=True):
            if np.isnan(number) and not is_base(name):
                what = f"elevation of storey {short(name)}"
                raise refusal(InvalidBuildingFile, what, path.name, "a number", "nothing")
        rows.sort(key=lambda i: -np.inf if np.isnan(elevation[i]) else elevation[i])
    elif is_roof_first(names, order, path):
        rows.reverse()
    base = 0.0
    loads = [values[kind] for kind in ("mass", "weight", "stiffness", "height") if kind in values]
    ground = [i for i in rows if is_base(names[i])]
    if not ground and rows and _BASE.fullmatch(names[rows[0]]) and all(not each[rows[0]] > 0.0 for each in loads):
        ground = rows[:1]
    for row in ground:
        rows.remove(row)
        base = 0.0 if elevation is None else float(np.nan_to_num(elevation[row]))
        remarks.append(f"row {short(names[row])} is the ground and no storey: left out{_carried(sheet, row)}")
    if not rows:
        raise refusal(InvalidBuildingFile, "rows", path.name, "a storey at least", "none")

    def column(kind: str) -> FloatArray | None:
        return np.array([values[kind][i] for i in rows]) if kind in values else None

    heights = column("height")
    if heights is None and elevation is not None:
        heights = np.diff([elevation[i] for i in rows], prepend=base)
        remarks.append(f"heights are differences of elevations, over a base at {base:g} m")
    mass, weight = column("mass"), column("weight")
    if mass is None and weight is not None:
        mass = weight / STANDARD_GRAVITY
        remarks.append("masses are weights over g")
    stiffness, shear, drift = column("stiffness"), column("shear"), column("drift")
    if stiffness is None and shear is not None and drift is not None:
        if ratio and heights is None:
            raise refusal(InvalidBuildingFile, "height", path.name, "given with drift ratios", "none")
        length = drift * heights if ratio and heights is not None else drift
        stiffness = np.abs(shear) / np.abs(length)
        remarks.append(f"stiffnesses are shears over drifts{', which are ratios of the heights' if ratio else ''}")
    found = {"height": heights, "mass": mass, "stiffness": stiffness, "strength": column("strength")}
    for kind, numbers in found.items():
        if numbers is None:
            continue
        for i, number in enumerate(numbers):
            if not 0.0 < number < np.inf:
                got = "nothing" if np.isnan(number) else f"{number:g}"
                what = f"{kind} of storey {short(names[rows[i]])}"
                raise refusal(InvalidBuildingFile, what, path.name, "a positive number", got)
    return StoreyTable(
        source=path.name,
        names=tuple(names[i] for i in rows),
        heights=heights,
        mass=mass,
        stiffness=stiffness,
        strength=found["strength"],
        remarks=tuple(remarks),
    )


def _carried(sheet: Sheet, row: int) -> str:
    """What a row that is left out has in the columns that are read, as the table has it."""
    cells = {kind: sheet.body[row][place].strip() for kind, place in sheet.columns.items()}
    told = [
        f"{kind} {short(printable(cell))} {printable(sheet.units[kind])}".rstrip()
        for kind, cell in cells.items()
        if kind not in ("storey", "elevation") and cell.strip("0.,-")
    ]
    return f", with {', '.join(told)}" if told else ""


def is_roof_first(names: list[str], order: Order | None, path: Path) -> bool:
    """Whether the first row is the highest storey: by what is stated, else by names."""
    if order is not None:
        return order == "roof-first"
    if len(names) < 2:
        return False
    first, last = names[0], names[-1]
    if _ROOF.search(first) or _BASE.fullmatch(last):
        return True
    if _ROOF.search(last) or _BASE.fullmatch(first):
        return False
    numbers = [re.findall(r"\d+", name) for name in names]
    if all(len(found) == 1 for found in numbers):
        counted = [int(found[0]) for found in numbers]
        if counted == sorted(counted, reverse=True):
            return True
        if counted == sorted(counted):
            return False
    need = "stated by --order, roof-first or ground-first, where names and elevations do not say it"
    raise refusal(InvalidBuildingFile, "order of the storeys", path.name, need, f"{short(first)} first")
