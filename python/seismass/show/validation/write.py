"""Validations as text, and as files: tables, figures and claims."""

from __future__ import annotations

import json
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import polars as pl

from seismass.media.folder import write_folder
from seismass.show.validation.tables import platform_tables, section4_tables
from seismass.validation import Claim, Platform, Section4, Validation, claims_table
from seismass.validation.three_storeys import COMPARED_SLOPES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_WIDTH: Final = 100


def validation_text(result: Validation) -> str:
    """Return the validations as lines to read: the motions, the comparison of programs, the claims."""
    about = result.metadata()
    lines = [
        f"study      {about['suite']}",
        f"section 4  {about['section4_motion']}",
        f"platform   {about['platform_motion']}",
        "",
        "Section 4: largest difference from the exact kernel",
        *differences_text(result.section4),
        "",
        "Claims of the paper",
    ]
    for claim in result.claims:
        lines += claim_text(claim)
    return "\n".join(lines)


def differences_text(section4: Section4) -> list[str]:
    """Return a line per run and program, with the differences of drift and slip."""
    lines = [f"  {'component':<12}{'r2':>6}  {'program':<18}{'setting':<16}{'drift':>22}{'slip':>22}"]
    for row in section4.differences.rows(named=True):
        cells = []
        for name in ("drift", "slip"):
            size, share = row[f"{name}_mm"], row[f"{name}_percent"]
            text = "-" if size is None else f"{size:.2g} mm"
            cells.append(text if share is None else f"{text}, {share:.2g} %")
        lines.append(
            f"  {row['component']:<12}{row['second_slope']:>6g}  {row['program']:<18}{row['setting']:<16}"
            f"{cells[0]:>22}{cells[1]:>22}"
        )
    return lines


def claim_text(claim: Claim) -> list[str]:
    """Return a claim as a few lines."""
    depends = [f"depends on: {claim.depends_on}"] if claim.depends_on else []
    text = textwrap.wrap(f"{claim.number:>2}  {claim.verdict}: {claim.claim}", _WIDTH, subsequent_indent="    ")
    for part in (f"({claim.source}) {claim.numbers}", *depends):
        text += textwrap.wrap(part, _WIDTH, initial_indent="    ", subsequent_indent="    ")
    return text


def claims_markdown(found: list[Claim]) -> str:
    """Return the claims as a table in Markdown."""
    rows = [
        f"| {claim.number} | {claim.claim} ({claim.source}) | **{claim.verdict}** | {claim.numbers} "
        f"| {claim.depends_on or '-'} |"
        for claim in found
    ]
    return "\n".join(["| | claim | verdict | our numbers | depends on |", "| --- | --- | --- | --- | --- |", *rows])


def validation_document(result: Validation) -> dict[str, Any]:
    """Return what validation.json holds: motions, claims and what is robust of the platform."""
    return {
        **result.metadata(),
        "claims": [vars(claim) for claim in result.claims],
        "platform": result.platform.robust,
        "differences": result.section4.differences.to_dicts(),
    }


def validation_tables(result: Validation) -> dict[str, pl.DataFrame]:
    """Return the tables by name, without lists in their cells."""
    return {
        "claims": claims_table(result.claims),
        **section4_tables(result.section4),
        **platform_tables(result.platform),
    }


def validation_figures(result: Validation) -> dict[str, Figure]:
    """Return the figures by name."""
    from seismass.show.validation.figures import platform_figure, section4_figure, sliding_figure

    components = result.section4.runs["component"].unique(maintain_order=True)
    figures = {
        f"section4_{component}_r{slope:g}": section4_figure(result.section4, component, slope)
        for component in components
        for slope in COMPARED_SLOPES
    }
    figures["section4_sliding"] = sliding_figure(result.section4)
    return figures | {
        f"platform_{name}": platform_figure(result.platform, name) for name in _components(result.platform)
    }


def _components(platform: Platform) -> list[str]:
    return platform.runs["component"].unique(maintain_order=True).to_list()


def write_validation(result: Validation, out: Path, *, figures: bool = True) -> list[Path]:
    """Write tables (Parquet and CSV), validation.json and figures (PNG and SVG) to a folder.

    Returns
    -------
    list of Path
        The files, in the order written.

    Raises
    ------
    OSError
        A file cannot be written; then none is changed.
    """
    document = json.dumps(validation_document(result), indent=2, allow_nan=False) + "\n"
    return write_folder(
        out,
        tables=validation_tables(result),
        documents={"validation.json": document},
        figures=validation_figures(result) if figures else None,
    )
