"""The sheet of a committee: the table, sentences that its numbers make, figures, and the sheet of archetypes."""

from __future__ import annotations

import os
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import matplotlib as mpl
import polars as pl
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seismass.base.errors import InvalidOption
from seismass.base.folders import write_folder
from seismass.base.values import as_path
from seismass.media.page import Section, bullets_html, page_html, table_html, text_html
from seismass.media.result import PAGE, named_figure, result_files
from seismass.media.roles import ADVISED, ATTACHED, CODE, GREY, INK, KINDS, SLIDE
from seismass.media.style import drawing
from seismass.media.svg import figure_html, figure_svgs
from seismass.media.text_table import number_text, text_table
from seismass.model.codes import CODE_NAMES
from seismass.studies.evidence.definitions import DEFINITIONS, MCE
from seismass.studies.evidence.table import BY_CLASS, NUMBERS, RIGHT, ROUND

if TYPE_CHECKING:
    from seismass.studies.evidence import Evidence

WIDTH: Final = 108
SYNTHETIC: Final = "EVIDENCE OF SYNTHETIC MOTIONS: recordings decide (--records)"
"""What stands above every result of the built-in motions."""
WORDS: Final = {"stiff": "stiff, R < 4", "ductile": "ductile, R >= 4.5"}
"""Names of the classes of systems."""
_UNSAFE, _OVERSAFE = 1.2, 1.5
"""Rates, real over model, beyond which the sentences name an occupancy as unsafe, and the inverse as over-safe."""
_MARKS: Final = {
    "a_mean": ("o", SLIDE.colour, "(a) mean drift"),
    "base_shear": ("s", KINDS[1], "base shear"),
    "e_d": ("^", KINDS[0], "(e) in the design"),
    "d": ("D", INK, "(d) rate, 90 % interval"),
}


def _cells(result: Evidence) -> list[list[str]]:
    """The table of the sheet: head, and a row for each occupancy and class."""
    code = result.metadata["codes"][0]
    numbers = [f"{number:g}" for number in NUMBERS]
    head = ["occupancy, system", "n", "present", "(a)", "(d) [archetypes] {stations}", "V", "F", "(e)", "round", code]
    rows = [[*head, *(f"rate {rule}" for rule in (code, *numbers, "round"))]]
    for row in result.table.iter_rows(named=True):
        text = {name: number_text(value) for name, value in row.items() if not isinstance(value, str)}
        share = f"{text['d']} [{text['d_least']}-{text['d_most']}] {{{text['d_low']}-{text['d_high']}}}"
        ends = f" [{text[f'rate_{code}_least']}-{text[f'rate_{code}_most']}]"
        cells = [f"{row['occupancy']} ({row['live_kpa']:g} kPa), {row['class']}", str(row["archetypes"])]
        cells += [text["present"], text["a_mean"], "-" if row["d"] is None else share]
        cells += [text[name] for name in ("base_shear", "floor_force", "e_d", "round", "code_fraction")]
        cells += [text[f"rate_{code}"] + (ends if row[f"rate_{code}"] is not None else "")]
        rows.append([*cells, *(text[f"rate_{number}"] for number in numbers), text["rate_round_numbers"]])
    return rows


def sentences(result: Evidence) -> list[str]:
    """Return four sentences that the numbers make: unsafe and over-safe rows of the code, sliding, full floors, and
    what is not known.
    """
    code = result.metadata["codes"][0]
    rates = result.table.drop_nulls(f"rate_{code}").rename({f"rate_{code}": "rate"})
    words = pl.format("{}, {} ({})", "occupancy", "class", pl.col("rate").round(2))
    unsafe, safe = (
        rates.filter(rows).select(words).to_series().to_list()
        for rows in (pl.col("rate") > _UNSAFE, pl.col("rate") < 1.0 / _OVERSAFE)
    )
    first = (
        f"With the fraction of {CODE_NAMES[code]} the annual rate of the drift limit is more than {_UNSAFE:g} times "
        f"that of the model in {_listed(unsafe)}, and less than 1/{_OVERSAFE:g} of it in {_listed(safe)}."
    )
    factors = []
    known = result.tables["shares"].filter(suite="first").drop_nulls("lambda")
    for kind, name in WORDS.items():
        for definition, what in (("d", "rate"), ("a_mean", "drift")):
            one = known.filter(pl.col("class") == kind, definition=definition)["lambda"].to_numpy()
            if len(one):
                factors.append(f"{one.mean():.2f} [{one.min():.2f}-{one.max():.2f}] in {name} ({what})")
    second = f"Sliding alone leaves of the share that the same goods would have if fixed: {', '.join(factors)}."
    full = [f"{row['d']:.2f} in {row['archetype']}" for row in result.tables["full"].iter_rows(named=True) if row["d"]]
    third = f"Floors that are always full need, for the rate: {_listed(full)}."
    of_mce = result.tables["fragility"].filter(suite="first", model="real", level=MCE)["collapsed"].to_numpy()
    fourth = (
        "Not known: weights of the contacts and the scatter of their friction are assumptions; surveys have one row "
        "for all storage; goods are rigid on floors (no racks), in one direction; archetypes have no columns that "
        f"continue and collapse under the MCE with a probability of {of_mce.min():.2f} to "
        f"{of_mce.max():.2f}, so that absolute rates are not to be quoted."
    )
    return [first, second, third, fourth]


def advice(result: Evidence) -> str:
    """Return what a committee may print, and how often it is right, in one sentence."""
    rules = result.tables["rules"].filter(quantity="rate")
    codes = result.tables["codes"].filter(suite="first", code_id=BY_CLASS, quantity="rate")
    joined = codes.join(result.tables["archetypes"].select("archetype", "present"), on="archetype")
    factors = joined.group_by("class").agg((pl.col("fraction") / pl.col("present")).mean())
    words = [f"{factor:.2f} in {WORDS[kind]}" for kind, factor in sorted(factors.iter_rows())]

    def right(rule: str) -> str:
        parts = rules.filter(code_id=rule)["right"].to_list()
        return "/".join(f"{100.0 * part:.0f}" for part in parts) + " %"

    code = result.metadata["codes"][0]
    if not words or not all(map(right, (BY_CLASS, ROUND, code))):
        return "No rate of the drift limit is known, so that no fraction follows: see the definitions below."
    return (
        f"In an analysis: the load present on average times {' and '.join(words)}, or the round numbers of the table. "
        f"The rate of the drift limit is then within {RIGHT[0]:g} to {RIGHT[1]:g} times that of goods that slide in "
        f"{right(BY_CLASS)} of the archetypes by these factors, {right(ROUND)} by round numbers and {right(code)} with "
        f"{CODE_NAMES[code]}, on {' and '.join(result.metadata['suites'])}. Where one weight also sets the strength, "
        "column (e) is that fraction; floors that are always full need what stands for them below."
    )


def _listed(items: list[str]) -> str:
    return "; ".join(items) if items else "none"


def rule_lines(result: Evidence) -> list[str]:
    """Return how round numbers, present times a factor, and codes do for the rate, on every suite."""
    lines = []
    for row in result.tables["rules"].filter(quantity="rate").iter_rows(named=True):
        suite = result.metadata["suites"][0 if row["suite"] == "first" else 1]
        lines.append(
            f"{row['code_id']}, on {suite}: {row['mean']:.2f} [{row['least']:.2f}-{row['most']:.2f}], within "
            f"[{RIGHT[0]:g}, {RIGHT[1]:g}] in {100.0 * row['right']:.0f} % of {row['archetypes']}"
        )
    return lines


def assumptions(result: Evidence) -> list[str]:
    """Return what is assumed, line by line."""
    setting, metadata = result.metadata["setting"], result.metadata
    hazard = metadata["hazard"]["label"] or "as given"
    definitions = "; ".join(f"({name}) {DEFINITIONS[key]}" for name, key in (("a", "a_mean"), ("d", "d"), ("e", "e_d")))
    return [
        f"Site: S_DS {setting['sds']:g} g, S_D1 {setting['sd1']:g} g; design by {CODE_NAMES[setting['code']]}, lateral "
        "forces, period C_u T_a, I = 1.",
        f"Shares of the design live load: {definitions}; V base shear, F force of loaded floors "
        f"on their diaphragms, at the design level; drift limit "
        f"{100.0 * setting['limit']:g} %, drifts capped at that of the collapse; round: the mean of (a) and "
        f"(d), to the next 0.05. A dash: too rare for {metadata['runs']} runs.",
        f"Springs: first yield {setting['first_yield']:g} V_y (sigma {setting['first_yield_sigma']:g}), second slope "
        f"{setting['second_slope']:g} (sigma {setting['second_slope_sigma']:g}), ultimate {setting['overstrength']:g} "
        f"times, then flat; P-Delta{'' if setting['p_delta'] else ' left out'}.",
        f"Presence: JCSS surveys, floors of {setting['area']:g} m2, correlated by {setting['correlation']:g}, at most "
        f"{setting['most_present']:g} of the design live load.",
        f"Friction: contacts with weights (assumed), sigma {setting['friction_sigma']:g}, mu_k = "
        f"{setting['kinetic']:g} mu_s, one for a building.",
        f"Motions: {metadata['motions'][0]} of {metadata['stations'][0]} stations ({metadata['suites'][0]}), each at "
        f"{', '.join(f'{level:g}' for level in setting['levels'])} of the design spectrum at T.",
        f"Hazard over the design level: {hazard}; 1.5 is the MCE.",
        f"Samples: {setting['samples'][0]} buildings a motion, {setting['samples'][1]} loads and frictions a building, "
        f"seed {setting['seed']}; models have the strengths of their building and the weight of the mean load.",
    ]


def evidence_text(result: Evidence) -> str:
    """Return `Evidence.text`."""
    lines = [SYNTHETIC, ""] if result.metadata["synthetic"] else []
    counted = f"{result.table['archetypes'].sum()} archetypes, {_motions(result)}"
    lines += [f"Share of the design live load that acts as mass: {counted}", *text_table(_cells(result)), ""]
    lines += [
        *_bullets([advice(result), *sentences(result)]),
        "",
        "Annual rate of the drift limit, goods that slide over model, by rule",
    ]
    lines += [*(f"  {line}" for line in rule_lines(result)), ""]
    lines += ["Samples: rms change of a share over the archetypes, part of the sample against all of it"]
    changes = result.tables["convergence"].filter(pl.col("definition").is_in(["a_mean", "d", "base_shear"]))
    for rows in changes.partition_by("sample", maintain_order=True):
        cells = zip(rows["definition"], rows["rms_change"], strict=True)
        words = ", ".join(f"{key} {number_text(value, '.3f')}" for key, value in cells)
        lines.append(f"  {rows['sample'][0]}: {words}")
    return "\n".join([*lines, "", "Assumptions", *_bullets(assumptions(result))])


def _bullets(paragraphs: list[str]) -> list[str]:
    wrap = textwrap.TextWrapper(WIDTH, initial_indent="- ", subsequent_indent="  ")
    return [line for paragraph in paragraphs for line in wrap.wrap(paragraph)]


def evidence_figure(result: Evidence, name: str | None = None) -> Figure:
    """Return `Evidence.plot`."""
    if named_figure(result, name) == "tornado":
        return _tornado(result)
    archetypes = result.tables["archetypes"].with_row_index("place")
    small: Any = {"font.size": 7.5, "axes.labelsize": 7.0, "ytick.labelsize": 6.5, "xtick.labelsize": 7.0}
    with drawing(), mpl.rc_context(small):
        height = 1.5 + 0.12 * (archetypes.height + archetypes["occupancy"].n_unique())
        figure = Figure(figsize=(8.27, height))
        left, right = figure.subplots(1, 2, sharey=True, width_ratios=(1.35, 1.0))
        places, ticks = _places(archetypes)
        _draw_shares(left, result, archetypes, places)
        _draw_rates(right, result, places)
        left.set_yticks(list(places.values()), ticks)
        left.set_ylim(max(places.values()) + 0.7, -1.4)
        for axes in (left, right):
            axes.grid(axis="x", color=GREY, alpha=0.3, linewidth=0.4)
            axes.tick_params(axis="y", length=0)
            axes.spines[["top", "right"]].set_visible(False)
            below = (0.0, -0.4 / (height - 1.27))
            columns = 3 if axes is left else 2
            axes.legend(loc="upper left", bbox_to_anchor=below, ncols=columns, frameon=False, fontsize=6.5)
        title = f"Share of the design live load that acts as mass, {archetypes.height} archetypes"
        figure.suptitle(f"{SYNTHETIC}\n{title}" if result.metadata["synthetic"] else title, fontsize=8.5, y=0.99)
        figure.subplots_adjust(left=0.21, right=0.98, top=1.0 - 0.42 / height, bottom=0.85 / height, wspace=0.05)
    return figure


def _places(archetypes: pl.DataFrame) -> tuple[dict[str, float], list[str]]:
    """Height of each archetype, with room above each occupancy, and what stands beside it."""
    places: dict[str, float] = {}
    ticks, height, last = [], 0.0, None
    for row in archetypes.sort("place").iter_rows(named=True):
        height += 1.9 if last is not None and row["occupancy"] != last else 1.0 if last is not None else 0.0
        last = row["occupancy"]
        places[row["archetype"]] = height
        ticks.append(f"{row['archetype'].partition(', ')[2]}, {row['T_design_s']:.2f} s")
    return places, ticks


def _draw_shares(axes: Axes, result: Evidence, archetypes: pl.DataFrame, places: dict[str, float]) -> None:
    """Shares by definition, with what is present and what the code has."""
    shares = result.tables["shares"].filter(pl.col("suite") == "first").drop_nulls("share")
    for definition, (marker, colour, label) in _MARKS.items():
        rows = shares.filter(definition=definition)
        heights = [places[name] for name in rows["archetype"]]
        if definition == "d":
            axes.hlines(heights, rows["low"], rows["high"], color=GREY, linewidth=2.4, alpha=0.7, zorder=1)
        face = colour if definition == "d" else "none"
        axes.plot(rows["share"], heights, marker, color=colour, markersize=3.4, markerfacecolor=face, label=label)
    full = result.tables["full"].drop_nulls("d")
    heights = [places[name] for name in full["archetype"]]
    axes.plot(full["d"], heights, "x", color=GREY, markersize=4.0, label="(d), full floors")
    labels: dict[str, str | None] = {"present": "present, mean", "code": result.metadata["codes"][0]}
    for occupancy, rows in archetypes.group_by("occupancy", maintain_order=True):
        ends = [places[name] for name in rows["archetype"]]
        span = [min(ends) - 0.5, max(ends) + 0.5]
        marks = (("present", "present", INK, "--"), ("code", "design_fraction", CODE.colour, "-"))
        for key, column, colour, line in marks:
            axes.plot(
                [rows[column][0]] * 2, span, color=colour, linestyle=line, linewidth=1.0, label=labels.pop(key, None)
            )
        axes.text(1.02, min(ends) - 0.55, str(occupancy[0]), ha="right", va="bottom", weight="bold", fontsize=7.0)
    axes.set_xlim(-0.02, 1.04)
    axes.set_xlabel("share of the design live load that acts as mass")


def _draw_rates(axes: Axes, result: Evidence, places: dict[str, float]) -> None:
    """Annual rate, real over model, with fractions of codes."""
    code = result.metadata["codes"][0]
    rates = result.tables["codes"].filter(suite="first", quantity="rate").drop_nulls("real_over_model")
    looks = {
        code: ("D", CODE.colour),
        "0.6 everywhere": ("|", KINDS[1]),
        "1 everywhere": ("|", ATTACHED.colour),
        ROUND: ("o", INK),
    }
    axes.axvspan(*RIGHT, color=ADVISED.colour, alpha=0.08, linewidth=0.0)
    axes.axvline(1.0, color=INK, linewidth=0.7)
    for rule, (marker, colour) in looks.items():
        rows = rates.filter(code_id=rule)
        heights = [places[name] for name in rows["archetype"]]
        axes.plot(
            rows["real_over_model"], heights, marker, color=colour, markersize=4.0, markerfacecolor="none", label=rule
        )
    axes.set_xscale("log")
    axes.set_xticks([0.1, 0.2, 0.5, 1.0, 2.0], ["0.1", "0.2", "0.5", "1", "2"])
    axes.set_xlim(right=3.0)
    axes.minorticks_off()
    limit = f"{100.0 * result.metadata['setting']['limit']:g} %"
    axes.set_xlabel(f"rate of {limit} drift, sliding over model (above 1: unsafe)")


def _tornado(result: Evidence) -> Figure:
    """What moves share (d) of one archetype of each occupancy and class."""
    table = result.tables["vary"]
    groups = table.partition_by("occupancy", "class", maintain_order=True)
    with drawing(), mpl.rc_context({"font.size": 7.0, "ytick.labelsize": 6.0, "xtick.labelsize": 6.5}):
        figure = Figure(figsize=(8.27, 2.4 * -(-len(groups) // 2)), layout="constrained")
        panels = figure.subplots(-(-len(groups) // 2), 2, squeeze=False).ravel()
        for axes, rows in zip(panels, groups, strict=False):
            bars = _bars(rows)[:8]
            for height, (name, low, high) in enumerate(bars):
                axes.plot([low, high], [height, height], color=SLIDE.colour, linewidth=5.0, solid_capstyle="butt")
                axes.plot(low, height, "|", color=INK, markersize=7.0)
                axes.text(
                    -0.02, height, name, ha="right", va="center", fontsize=6.0, transform=axes.get_yaxis_transform()
                )
            axes.set_ylim(len(bars) - 0.4, -0.6)
            axes.set_yticks([])
            axes.set_title(rows["archetype"][0], fontsize=7.0)
            axes.set_xlim(0.0, 1.0)
        for axes in panels[len(groups) :]:
            axes.set_visible(False)
        figure.supxlabel("share (d); the tick is the lower end; inputs with none are of a small sample", fontsize=7.0)
    return figure


def _bars(rows: pl.DataFrame) -> list[tuple[str, float, float]]:
    """Inputs with the shares at both ends, the widest first."""
    ends: dict[str, dict[str, float]] = {}
    for row in rows.drop_nulls("d").iter_rows(named=True):
        ends.setdefault(row["input"], {})[row["end"]] = row["d"]
    bars = [(name, both["low"], both["high"]) for name, both in ends.items() if len(both) == 2]
    return sorted(bars, key=lambda bar: -abs(bar[1] - bar[2]))


def _page(result: Evidence, drawings: dict[str, str]) -> str:
    """The sheets: the table, the figure and the sentences on one side of A4; archetypes and rules behind it."""
    head, *rows = _cells(result)
    metadata, site = result.metadata, result.metadata["setting"]
    warning = [Markup('<p class="edited"><strong>{}</strong></p>').format(SYNTHETIC)] if metadata["synthetic"] else []
    caption = (
        "Shares of the design live load, mean over the archetypes of a row; [ ] range over archetypes, { } 90 % over "
        "stations; then the annual rate of the drift limit, goods that slide over model, with fractions in the model."
    )
    alt = "For every archetype shares by four definitions, and rates with four fractions."
    sheet = [
        *warning,
        Markup('<p class="answer">{}</p>').format(advice(result)),
        table_html(pl.DataFrame(rows, schema=head, orient="row"), caption, folds=True),
        figure_html(drawings["evidence"], "Shares and rates of every archetype.", alt),
        bullets_html(sentences(result)),
        text_html(" ".join(assumptions(result))),
    ]
    designs = result.tables["archetypes"].drop("occupancy", "class")
    sections = [
        Section("Archetypes", [_table(designs, "Numbers of the designs, for a check by hand.")]),
        Section("Rules", [bullets_html(rule_lines(result))]),
        Section("Full floors", [_table(result.tables["full"], "Every floor has its design live load.")]),
    ]
    if "tornado" in drawings:
        alt = "Bars: the share of an archetype at both ends of each input."
        sections.append(
            Section("What moves the share", [figure_html(drawings["tornado"], "One input at a time.", alt)])
        )
    subtitle = f"S_DS {site['sds']:g} g, S_D1 {site['sd1']:g} g; {_motions(result)}"
    lead = [Markup('<div class="sheet">{}</div>').format(Markup("\n").join(sheet))]
    return page_html("How much of the design live load acts as mass", sections, subtitle=subtitle, lead=lead)


def _table(table: pl.DataFrame, caption: str) -> Markup:
    return table_html(table, caption, formats=dict.fromkeys(table.select(pl.col(pl.Float64)).columns, ".3g"))


def _motions(result: Evidence) -> str:
    return f"{result.metadata['motions'][0]} motions of {result.metadata['suites'][0]}"


def write_evidence(result: Evidence, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
    """Return the files of `Evidence.write`."""
    documents = {"evidence.txt": result.text + "\n", "evidence.json": result.to_json() + "\n"}
    drawn = result.figures() if figures else {}
    if figures:
        drawings = figure_svgs(drawn)
        documents |= {f"{name}.svg": drawing for name, drawing in drawings.items()} | {PAGE: _page(result, drawings)}
    ours = {PAGE, *(f"{name}.{kind}" for name in ("evidence", "tornado") for kind in ("png", "svg"))}
    ours |= {f"vary.{kind}" for kind in ("parquet", "csv")}
    files = result_files(tables=result.tables, documents=documents, figures=drawn, kinds=("png",))
    return write_folder(as_path(folder, "evidence", InvalidOption), files, earlier=ours.__contains__, owner="evidence")
