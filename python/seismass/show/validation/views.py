"""Validations as text and as figures."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Final

from seismass.media.result import named_figure
from seismass.media.text_table import text_line
from seismass.validation import Claim, Validation
from seismass.validation.three_storeys import Section4
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
    widths = (-12, 6, -20, -16, 22, 22)
    lines = [text_line(("component", "r2", "  program", "setting", "drift", "slip"), widths)]
    for row in section4.differences.rows(named=True):
        cells = []
        for name in ("drift", "slip"):
            size, share = row[f"{name}_mm"], row[f"{name}_percent"]
            text = "-" if size is None else f"{size:.2g} mm"
            cells.append(text if share is None else f"{text}, {share:.2g} %")
        run = (row["component"], f"{row['second_slope']:g}", f"  {row['program']}", row["setting"])
        lines.append(text_line((*run, *cells), widths))
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


def drawings(result: Validation) -> dict[str, Callable[[], Figure]]:
    """Return what draws each figure, by its name."""
    from seismass.show.validation.figures import platform_figure, section4_figure, sliding_figure

    compared, platform = result.section4, result.platform
    components = compared.runs["component"].unique(maintain_order=True)
    return {
        **{
            f"section4_{component}_r{slope:g}": partial(section4_figure, compared, component, slope)
            for component in components
            for slope in COMPARED_SLOPES
        },
        "section4_sliding": partial(sliding_figure, compared),
        **{
            f"platform_{name}": partial(platform_figure, platform, name)
            for name in platform.runs["component"].unique(maintain_order=True)
        },
    }


def figure_names(result: Validation) -> tuple[str, ...]:
    """Return the names of the figures."""
    return tuple(drawings(result))


def validation_figure(result: Validation, name: str | None = None) -> Figure:
    """Return a figure by its name."""
    return drawings(result)[named_figure(result, name)]()
