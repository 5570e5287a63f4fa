"""Pushover curves of another program: shears over storey drifts or over the displacement of the roof, in SI units."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

from seismass.assessment.table_file import MOST_RATIO, Sheet, one_case, read_sheets, system_of
from seismass.assessment.table_words import (
    COLUMNS,
    CURVES,
    Order,
    column_kind,
    is_base,
    is_roof,
    is_roof_first,
    refuse_summaries,
)
from seismass.base.errors import InvalidBuildingFile
from seismass.base.values import FloatArray, as_path, frozen, printable, refusal, short
from seismass.base.views import Card
from seismass.media.text_table import text_table

_RATIO: Final = {"": 1.0, "-": 1.0, "rad": 1.0, "%": 0.01}
"""Units of drifts that are ratios of a height."""
_SMALL: Final = 0.01
"""Drift and shear before the push, under gravity, over the largest of the curve."""


@dataclass(frozen=True, eq=False)
class PushoverCurves(Card):
    """Pushover curves of a file: names of the storeys (empty for a curve of the whole building), drifts (m, or ratios
    of the height), shears (N) and remarks.
    """

    source: str
    names: tuple[str, ...]
    drift: tuple[FloatArray, ...]
    shear: tuple[FloatArray, ...]
    ratio: bool
    remarks: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """What was read: samples, largest drift and largest shear of each curve."""
        scale, unit = (1e2, "%") if self.ratio else (1e3, "mm")
        rows = [["curve", "samples", f"largest drift {unit}", "largest shear kN"]]
        for name, drift, shear in zip(self.names or ("roof",), self.drift, self.shear, strict=True):
            rows.append([name, str(len(drift)), f"{scale * drift.max():.4g}", f"{1e-3 * shear.max():.6g}"])
        lines = [f"read from {printable(self.source)}", *text_table(rows)]
        return "\n".join([*lines, *(f"  {remark}" for remark in self.remarks)])

    def drift_in_metres(self, heights: FloatArray | None) -> tuple[FloatArray, ...]:
        """Return the drifts of each curve (m); ratios need `heights` (m), shape (storeys,)."""
        if not self.ratio:
            return self.drift
        if heights is None or (self.names and len(heights) != len(self.names)):
            got = "none" if heights is None else f"{len(heights)} for {len(self.names)} storeys"
            raise refusal(InvalidBuildingFile, "heights", self.source, "known, since drifts are ratios", got)
        lengths = heights if self.names else [float(np.sum(heights))]
        return tuple(frozen(height * drift) for height, drift in zip(lengths, self.drift, strict=True))


def read_pushover(
    source: str | os.PathLike[str],
    *,
    units: str | None = None,
    order: Order | None = None,
    direction: Literal["x", "y"] = "x",
    case: str | None = None,
    decimal: Literal["comma", "point"] | None = None,
) -> PushoverCurves:
    r"""Read pushover curves.

    Parameters
    ----------
    source : path-like
        Text (separated by commas, semicolons or tabs, in fixed columns, or s2k) or XLSX with a column of drifts (Roof
        Drift, Displacement, Monitored Displ, Story Drift) and one of shears (Base Shear, BaseForce, Story Shear). With
        a column of storeys there is a curve for each, its rows in the order of the push; without one the curve is of
        the whole building.
    units : str, optional
        Force and length of numbers whose column states no unit: "kN-m", "kip-in". A drift without either, or in %, is
        a ratio of the height.
    order : {"roof-first", "ground-first"}, optional
        Order of the storeys, where their names do not say it.
    direction : {"x", "y"}, default "x"
        Which of the columns "Story Drift X" and "Story Drift Y" is read.
    case : str, optional
        Load case; needed where the file has several.
    decimal : {"comma", "point"}, optional
        Decimal mark; needed where no number of the file shows it.

    Returns
    -------
    PushoverCurves
        The curves, storey 1 first. Drifts and shears are counted from the last sample before the push, under gravity;
        samples that do not drift further than all before them, as after unloading, are left out. Remarks say so.

    Raises
    ------
    InvalidBuildingFile
        The file cannot be read, has no such head, a cell that is no number, signs that change, or what has to be
        stated: a unit, an order, a load case, a decimal mark.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> from seismass.assessment import read_pushover
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "push.csv"
    ...     _ = file.write_text("Roof Drift (mm),Base Shear (kN)\n0,0\n20,400\n40,500\n80,520\n160,540\n")
    ...     curves = read_pushover(file)
    >>> curves.names, curves.drift[0].tolist(), curves.shear[0].tolist()
    ((), [0.0, 0.02, 0.04, 0.08, 0.16], [0.0, 400000.0, 500000.0, 520000.0, 540000.0])
    """
    path = as_path(source, "pushover file", InvalidBuildingFile)
    need = "a head with a column of drifts, such as Roof Drift or Story Drift, and one of shears, such as Base Shear"
    sheets, _ = read_sheets(path, CURVES, needed=("drift", "shear"), need=need, direction=direction, decimal=decimal)
    if len(sheets) > 1:
        got = " and ".join(sheet.label for sheet in sheets)
        raise refusal(InvalidBuildingFile, "curves", path.name, "in one table: remove the others", got)
    sheet = sheets[0]
    system = None if units is None else system_of(units, path.name)
    names, rows_left = _storeys(sheet, case)
    storey_order = list(dict.fromkeys(names[row] for row in rows_left))
    refuse_summaries(storey_order, path.name)
    base = [name for name in storey_order if is_base(name)]
    owners = [f"sample {number}" for number in range(1, len(sheet.body) + 1)]
    unit = sheet.units["drift"].strip().lower()
    heads = {kind: re.sub(r"[(\[].*", "", sheet.heads[kind]) for kind in ("drift", "shear")}
    is_drift, is_shear = (column_kind(head, direction, COLUMNS) == kind for kind, head in heads.items())
    if "storey" in sheet.columns and (is_roof(heads["drift"]) or not (is_drift and is_shear)):
        need = "called Story Drift and Story Shear, which displacements and forces of floors are not"
        got = f"{short(sheet.heads['drift'])} and {short(sheet.heads['shear'])}"
        raise refusal(InvalidBuildingFile, "columns", sheet.label, need, got)
    ratio = unit in _RATIO and is_drift and ((system is None and sheet.system is None) or unit != "")
    unused = set(range(len(sheet.body))) - set(rows_left)
    factor = _RATIO[unit] if ratio else sheet.factor("drift", "length", system)
    drift = sheet.numbers("drift", factor, owners, left_out=unused)
    if ratio and np.nanmax(np.abs([0.0, *drift])) > MOST_RATIO:
        need = "stated in its head: Drift (mm), or Drift (%) where it is that of the height"
        raise refusal(InvalidBuildingFile, "unit of the column drift", sheet.label, need, unit or "none")
    shear = sheet.numbers("shear", sheet.factor("shear", "force", system), owners, left_out=unused)
    if "storey" in sheet.columns and is_roof_first(storey_order, order, path.name):
        storey_order.reverse()
    storey_order = [name for name in storey_order if name not in base]
    drifts, shears = [], []
    remarks: dict[str, None] = {}
    for name in storey_order:
        rows = [row for row in rows_left if names[row] == name]
        curve_name = f"storey {short(name)} of {path.name}" if name else path.name
        curve = np.array([[drift[row] for row in rows], [shear[row] for row in rows]])
        for kind, values in zip(("drift", "shear"), curve, strict=True):
            if np.isnan(values).any():
                raise refusal(InvalidBuildingFile, kind, curve_name, "a number in every row", "nothing in one")
        (push_drift, force), sentences = _push(curve, curve_name)
        drifts.append(frozen(push_drift))
        shears.append(frozen(force))
        remarks |= dict.fromkeys(sentences)
    if not drifts:
        raise refusal(InvalidBuildingFile, "rows", path.name, "samples of a curve", "none")
    left_out = [f"row {short(name)} is the ground and no storey: left out" for name in base]
    return PushoverCurves(
        source=path.name,
        names=tuple(storey_order) if "storey" in sheet.columns else (),
        drift=tuple(drifts),
        shear=tuple(shears),
        ratio=ratio,
        remarks=(*left_out, *["drifts without a unit are ratios of the height"] * (ratio and unit == ""), *remarks),
    )


def _storeys(sheet: Sheet, case: str | None) -> tuple[list[str], list[int]]:
    """The storey of each row, which blank cells below a name have from there, and the rows of the load case."""
    columns = {kind: sheet.texts(kind) for kind in ("storey", "case") if kind in sheet.columns}
    full = [row for row in range(len(sheet.body)) if sheet.cell(row, "drift") != "" or sheet.cell(row, "shear") != ""]
    for texts in columns.values():
        for row in full:
            texts[row] = texts[row] or (texts[row - 1] if row else "")
    if "case" in columns and full:
        of_case = one_case([columns["case"][row] for row in full], case, sheet.label, "--pushover-case")
        full = [row for row in full if columns["case"][row] == of_case]
    elif case is not None:
        raise refusal(InvalidBuildingFile, "load case", sheet.label, "left out: there is no column of them", case)
    return columns.get("storey", [""] * len(sheet.body)), full


def _push(curve: FloatArray, owner: str) -> tuple[FloatArray, list[str]]:
    """The samples of a push in one direction, drifts over shears, and what was done to them: signs, steps of gravity
    before, unloading.
    """
    remarks = []
    largest = np.abs(curve).max(axis=1)
    signs = np.sign(curve[range(2), np.argmax(np.abs(curve), axis=1)])
    if (signs < 0.0).any():
        remarks.append("signs are turned, so that drifts and shears are positive")
        curve = curve * np.where(signs < 0.0, -1.0, 1.0)[:, None]
    gravity = 0
    # Without lateral force, or against the push; a curve may also begin at the first sample of the push.
    while gravity < curve.shape[1] and (curve[1, gravity] <= 0.0 or curve[0, gravity] < 0.0):
        gravity += 1
    start = curve[:, gravity - 1] if gravity else np.zeros(2)
    small = (np.abs(curve[:, :gravity]) <= _SMALL * largest[:, None]).all()
    if (gravity and not small) or gravity == curve.shape[1]:
        kind = 0 if (curve[0, : max(gravity, 1)] < -_SMALL * largest[0]).any() else 1
        got = f"{curve[kind].min():g} and {curve[kind].max():g}"
        raise refusal(InvalidBuildingFile, ("drift", "shear")[kind], owner, "of one sign: a push in one direction", got)
    if gravity > 1 or start.any():
        origin = f"a drift of {start[0]:.3g} and a shear of {start[1]:.3g} in SI units"
        remarks.append(f"drifts and shears are counted from the end of gravity, {origin}")
    curve = curve[:, max(gravity - 1, 0) :] - start[:, None]
    further = np.r_[True, curve[0, 1:] > np.maximum.accumulate(curve[0])[:-1]]
    if (curve[:, ~further] < -_SMALL * largest[:, None]).any():
        kind = int((curve[1] < -_SMALL * largest[1]).any())
        got = f"{curve[kind].min():g} and {curve[kind].max():g}"
        raise refusal(InvalidBuildingFile, ("drift", "shear")[kind], owner, "of one sign: a push in one direction", got)
    if not further.all():
        count = int((~further).sum())
        remarks.append(
            f"samples that do not drift further than those before, as after unloading, are left out: {count}"
        )
    return curve[:, further], remarks
