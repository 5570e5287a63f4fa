"""Pushover curves of another program: shears over storey drifts or over the displacement of the roof, in SI units."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

from seismass.assessment.storey_table import (
    COLUMNS,
    Names,
    Order,
    is_base,
    is_roof_first,
    read_sheet,
    refuse_summaries,
    system_of,
)
from seismass.base.errors import InvalidBuildingFile
from seismass.base.values import FloatArray, as_path, frozen, printable, refusal, short
from seismass.base.views import Card
from seismass.media.text_table import text_table

_DISPLACEMENTS: Final = (
    "roof displacement",
    "roof drift",
    "displacement",
    "displ",
    "monitored displacement",
    "monitored displ",
    "monitored displ x",
    "roof drift ratio",
)
_CURVES: Final[Names] = {
    "storey": COLUMNS["storey"],
    "drift": (*COLUMNS["drift"], *_DISPLACEMENTS),
    "shear": (*COLUMNS["shear"], "base force", "base reaction", "base fx", "force", "fx", "base shear x"),
}
_RATIO: Final = {"": 1.0, "-": 1.0, "rad": 1.0, "%": 0.01}
"""Units of drifts that are ratios of a height."""


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
) -> PushoverCurves:
    r"""Read pushover curves.

    Parameters
    ----------
    source : path-like
        CSV (comma, semicolon or tab) or XLSX with a column of drifts (Roof Drift, Displacement, Monitored Displ, Story
        Drift) and one of shears (Base Shear, Base Force, Story Shear). With a column of storeys there is a curve for
        each, its rows in the order of the push; without one the curve is of the whole building.
    units : str, optional
        Force and length of numbers whose column states no unit: "kN-m", "kip-in". A drift without either, or in %, is
        a ratio of the height.
    order : {"roof-first", "ground-first"}, optional
        Order of the storeys, where their names do not say it.
    direction : {"x", "y"}, default "x"
        Which of the columns "Story Drift X" and "Story Drift Y" is read.

    Returns
    -------
    PushoverCurves
        The curves, storey 1 first.

    Raises
    ------
    InvalidBuildingFile
        The file cannot be read, has no such head, a cell that is no number, signs that change, or a unit or an order
        that has to be stated.
    MissingPackage
        openpyxl is needed for XLSX.

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
    sheet = read_sheet(path, _CURVES, needed=("drift", "shear"), need=need, direction=direction)
    system = None if units is None else system_of(units, path.name)
    owners = [f"sample {number}" for number in range(1, len(sheet.body) + 1)]
    unit = sheet.units["drift"].strip().lower()
    ratio = unit in _RATIO and (system is None or unit != "")
    drift = sheet.numbers("drift", _RATIO[unit] if ratio else sheet.factor("drift", "length", system), owners)
    shear = sheet.numbers("shear", sheet.factor("shear", "force", system), owners)
    names = sheet.texts("storey") if "storey" in sheet.columns else [""] * len(drift)
    order_of_file = list(dict.fromkeys(names))
    refuse_summaries(order_of_file, path.name)
    if "storey" in sheet.columns and is_roof_first(order_of_file, order, path):
        order_of_file.reverse()
    base = [name for name in order_of_file if is_base(name)]
    order_of_file = [name for name in order_of_file if name not in base]
    drifts, shears, turned = [], [], False
    for name in order_of_file:
        rows = [i for i, other in enumerate(names) if other == name]
        curve_name = f"storey {short(name)} of {path.name}" if name else path.name
        columns = []
        for kind, values in (("drift", drift), ("shear", shear)):
            signed = np.array([values[i] for i in rows])
            if np.isnan(signed).any():
                raise refusal(InvalidBuildingFile, kind, curve_name, "a number in every row", "nothing in one")
            if (signed < 0.0).any() and (signed > 0.0).any():
                got = f"{signed.min():g} and {signed.max():g}"
                raise refusal(InvalidBuildingFile, kind, curve_name, "of one sign: a push in one direction", got)
            turned |= bool((signed < 0.0).any())
            columns.append(frozen(np.abs(signed)))
        drifts.append(columns[0])
        shears.append(columns[1])
    if not drifts:
        raise refusal(InvalidBuildingFile, "rows", path.name, "samples of a curve", "none")
    remarks = [f"row {short(name)} is the ground and no storey: left out" for name in base]
    remarks += ["drifts without a unit are ratios of the height"] * (ratio and unit == "")
    remarks += ["signs are turned, so that drifts and shears are positive"] * turned
    return PushoverCurves(
        source=path.name,
        names=tuple(order_of_file) if "storey" in sheet.columns else (),
        drift=tuple(drifts),
        shear=tuple(shears),
        ratio=ratio,
        remarks=tuple(remarks),
    )
