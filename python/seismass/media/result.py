"""What every result of a study answers to: text, tables, figures, a document, files, and a card in a notebook."""

from __future__ import annotations

import json
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from seismass.base.errors import InvalidOption
from seismass.base.values import as_path, brief, refusal
from seismass.base.views import view
from seismass.media.folder import write_folder

if TYPE_CHECKING:
    import polars as pl
    from matplotlib.figure import Figure


class Result:
    """The result of a study. A subclass has `text`, `tables`, `to_dict`, `figure_names` and `plot`."""

    __slots__ = ()

    document: ClassVar[str]
    """Stem of the file that `to_json` is written to; with spaces, what messages call the result."""

    @property
    def text(self) -> str:
        """The result as lines to read, the answer first."""
        raise NotImplementedError

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name."""
        raise NotImplementedError

    @property
    def figure_names(self) -> tuple[str, ...]:
        """Names of the figures that `plot` draws of this result; the first is drawn where none is named."""
        raise NotImplementedError

    def plot(self, name: str | None = None) -> Figure:
        """Return a figure by its name, one of `figure_names`; by default the first."""
        raise NotImplementedError

    def figures(self) -> dict[str, Figure]:
        """Return all figures by name."""
        return {name: self.plot(name) for name in self.figure_names}

    def to_dict(self) -> dict[str, Any]:
        """Return the answer as plain values, null for what is not finite; long tables are left to `tables`."""
        raise NotImplementedError

    def to_json(self) -> str:
        """Return `to_dict` as JSON."""
        return json.dumps(self.to_dict(), indent=2, allow_nan=False)

    def write(self, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
        """Write tables (Parquet and CSV), the document (JSON) and figures (PNG and SVG) to a folder.

        Returns
        -------
        list of Path
            The files, in the order written.

        Raises
        ------
        InvalidOption
            The folder is not a path.
        OSError
            A file cannot be written; then none is changed.
        """
        about = self._table_metadata()
        tables = self.tables
        return write_folder(
            as_path(folder, self.document.replace("_", " "), InvalidOption),
            tables=tables,
            metadata=dict.fromkeys(tables, about) if about else None,
            documents={f"{self.document}.json": self.to_json() + "\n"},
            figures=self.figures() if figures else None,
        )

    def _table_metadata(self) -> dict[str, str]:
        """Key-value metadata of the Parquet files of the tables."""
        return {}

    @view
    def _repr_html_(self) -> str:
        raise NotImplementedError


def named_figure(result: Result, name: str | None) -> str:
    """Return the name of the figure that is asked for."""
    known = result.figure_names
    if name is None:
        return known[0]
    if name not in known:
        raise refusal(InvalidOption, "name", f"figure of {result.document}", f"one of {', '.join(known)}", brief(name))
    return name


def finite_values(value: Any) -> Any:
    """Return nested values with null in place of infinities and NaN, which JSON does not have."""
    if isinstance(value, dict):
        return {key: finite_values(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [finite_values(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
