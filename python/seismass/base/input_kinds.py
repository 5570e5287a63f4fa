"""What an input file describes, by the tables that only its kind has; a file of another kind is named as such."""

from __future__ import annotations

from typing import Any, Final

from seismass.base.input_table import Table

BUILDING_FILE: Final = "building file"
SCENE_FILE: Final = "scene file"
CAMPAIGN_FILE: Final = "campaign file"
TABLES: Final = {
    BUILDING_FILE: ("site", "goods", "storeys", "code"),
    CAMPAIGN_FILE: ("grid", "sample", "motions"),
    SCENE_FILE: ("blocks", "racks", "motion", "vertical_motion", "initial"),
}
"""Tables of each kind that files of the other kinds do not have."""
COMMANDS: Final = {
    BUILDING_FILE: "`seismass building`, `animate`, `slip`, `fragility` and `risk`",
    CAMPAIGN_FILE: "`seismass campaign`",
    SCENE_FILE: "`seismass run`, `animate`, `slip`, `fragility` and `risk`",
}
"""Commands that take a file of each kind."""


def kind_of(values: dict[str, Any]) -> str:
    """Return which kind of file has these tables; empty where none or several kinds have them."""
    found = [kind for kind, names in TABLES.items() if any(name in values for name in names)]
    return found[0] if len(found) == 1 else ""


def refuse_other_kind(top: Table, kind: str) -> None:
    """Refuse a file whose tables are those of another kind than `kind`, and name the commands that take it."""
    found = kind_of(top.values)
    if found and found != kind:
        top.refuse("kind", f"a {kind}", f"a {found}, which {COMMANDS[found]} take{'s' * (found == CAMPAIGN_FILE)}")
