"""Tables that `seismass building` prints and stops: codes, contacts, and goods present by surveys."""

from __future__ import annotations

from seismass.commands.parser import columns
from seismass.media.text_table import text_table
from seismass.model.codes import MARK, NOT_CHECKED, code_legend, code_table
from seismass.model.friction import friction_table
from seismass.model.occupancy import SURVEYED, occupancy_table, on_surveyed_goods, surveyed_load


def _listed(rows: list[list[str]], long: tuple[int, ...]) -> list[str]:
    """A table; on a terminal that has no room for it the long columns stand below each row."""
    table = text_table(rows, left=len(rows[0]), indent=0)
    room = columns()
    if room is None or max(map(len, table)) <= room:
        return table
    short = [[cell for place, cell in enumerate(row) if place not in long] for row in rows]
    lines = []
    for row, line in zip(rows, text_table(short, left=len(short[0]), indent=0), strict=True):
        lines += [line, f"    {'; '.join(row[place] for place in long if row[place])}"]
    return lines


def fraction_text(low: float, high: float) -> str:
    """Return a fraction, or the range that a code has."""
    return f"{low:g} to {high:g}" if low < high else f"{high:g}"


def codes_listing() -> str:
    """Return the fractions of codes: of the design live load, and over the goods that surveys find."""
    rows = [["id", "use", "floors full", "as surveyed", "clause", "status", "code"]]
    for row in code_table().iter_rows(named=True):
        known, surveyed = row["fraction"] is not None, row["use"] in SURVEYED
        fraction = fraction_text(row["low"], row["high"]) if known else ""
        rows.append(
            [
                row["code_id"],
                row["use"],
                fraction,
                f"{on_surveyed_goods(row['fraction'], row['use']):.2f}" if known and surveyed else "",
                row["clause"],
                row["status"],
                f"{row['code']}{MARK * (not row['checked'])} {row['edition']}".rstrip(),
            ]
        )
    shares = ", ".join(f"{surveyed_load(name).share:.2f} ({name})" for name in SURVEYED.values())
    legend = (
        "floors full: fraction of the design live load. as surveyed: the same mass over the goods that surveys find,\n"
        f"for the upper end of a range; shares of the design live load: {shares}.\n"
        "Above 1 the code counts more than is there. The second compares with lambda of the goods present."
    )
    return "\n".join([*_listed(rows, (4, 6)), "", legend, "", code_legend()]) + "\n"


def frictions_listing() -> str:
    """Return the contacts with their friction."""
    rows = [["id", "mu_s", "mu_k", "contact", "source"]]
    for row in friction_table().iter_rows(named=True):
        source = f"{row['source']} ({row['kind']})"
        rows.append([row["pair_id"], f"{row['mu_s']:g}", f"{row['mu_k']:.4g}", row["contact"], source])
    return "\n".join(_listed(rows, (3, 4))) + "\n"


def occupancies_listing() -> str:
    """Return what surveys find on floors, over the design live load of ASCE 7."""
    rows = [["id", "mean kPa", "floors +/-", "design kPa", "share", "renewed every", "design live load"]]
    for row in occupancy_table().iter_rows(named=True):
        numbers = [f"{row[name]:g}" for name in ("mean", "floor_deviation", "design_load")]
        design = row["design_source"].partition(": ")[2] + MARK
        rows.append([row["occupancy_id"], *numbers, f"{row['share']:.2f}", row["renewed"], design])
    first = occupancy_table().row(0, named=True)
    legend = (
        f"Surveys: {first['source']} ({first['status']}); floors +/- is the standard deviation of large floors.\n"
        f"{MARK} {NOT_CHECKED}: design live loads of ASCE 7 are from memory"
    )
    return "\n".join([*_listed(rows, (5, 6)), "", legend]) + "\n"
