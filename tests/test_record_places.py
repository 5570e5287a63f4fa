"""Places of sensors in headers: how they are written, and which of them are of the ground; any other is left out."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

from seismass.motions.records import Record, find_pairs, read_records, read_suite
from seismass.motions.records.read import off_ground

MADE = runpy.run_path(str(Path(__file__).parents[1] / "tools" / "record_files.py"))

GROUND = (
    "Free Field",
    "Free-field",
    "FREEFIELD NE OF BRIDGE",
    "Free field, 30 m from bridge deck",
    "Bridge Free Field",
    "Building: free-field",
    "Ground",
    "Ground level",
    "Ground Surface",
    "At grade",
    "NE Ground",
    "Geotechnical array: ground surface",
    "Surface",
    "Instrument Shelter",
    "Grnd Surface",
)
ELSEWHERE = (
    "Roof",
    "Roof: North Wall",
    "3rd Floor, East Wall",
    "4th",
    "1st floor: ground level",
    "Ground Floor",
    "Grnd Fl",
    "Ground story",
    "Lobby",
    "Bsmnt",
    "Basement",
    "Attic",
    "Elevator core",
    "Steel Box",
    "Center of Bridge",
    "Bent 4, Top of Column",
    "Deck, mid-span",
    "Pier 3",
    "Crest",
    "Left abutment",
    "Penthouse NW",
    "Base",
    "Tower 2",
    "Underground vault",
    "Mezzanine",
    "Foundation",
    "Azotea",
    "Dach",
)
BELOW = ("borehole", "Downhole, 30 m", "Free field, depth 30 m", "Ground, 12 m deep", "Geotechnical array, depth 30 m")
NOTHING = ("", "?", "--", "unknown", "Other", "(see comment)", "n/a")
WRITTEN = (
    "CHAN  1:  90 DEG                  {}",
    "CHAN  1:  90 DEG   Location: {}",
    "Chan  1:  90 Deg  (Sta Chn: 12)     Location: {}",
    "Chan  1:  90 Deg (Sta Chn:  1)   Location:{}            ",
    "CHAN  1:  90 DEG  (STA CHN:  7)             {}",
    "Chan  1: 90 Deg Location: {}",
)
"""How the line of a CSMIP channel has its place: with its word or further right, with or without another number."""


def test_which_places_are_of_the_ground() -> None:
    for places, off in ((GROUND, False), (NOTHING, False), (ELSEWHERE, True), (BELOW, True)):
        wrong = [one for one in places if (off_ground(Record([0.0, 1.0], 0.01, place=one)) is not None) is not off]
        assert wrong == []


def channel(folder: Path, line: str) -> Record:
    """Write a CSMIP file whose channel has this line, and read it."""
    file = folder / "a.V2"
    file.write_text(MADE["csmip"](channels=1).replace("CHAN  1:  90 DEG", line), encoding="utf-8")
    (record,) = read_records(file)
    return record


@pytest.mark.parametrize("form", WRITTEN)
def test_the_place_of_a_channel_is_read_however_it_is_written(tmp_path: Path, form: str) -> None:
    for place in (GROUND[0], *ELSEWHERE[:12:5]):
        record = channel(tmp_path, form.format(place))
        assert (record.component.upper(), record.azimuth, record.place) == ("90 DEG", 90.0, place)


def test_every_place_in_every_form(tmp_path: Path) -> None:
    cases = [(form, place) for form in WRITTEN for place in (*GROUND, *ELSEWHERE, *BELOW)]
    assert len(cases) > 250
    wrong = [
        (form, place, record.place)
        for form, place in cases
        if (record := channel(tmp_path, form.format(place))).place != place or record.azimuth != 90.0
    ]
    assert wrong == []


def test_only_the_ground_enters_suites_and_pairs(tmp_path: Path) -> None:
    text = MADE["csmip"](channels=3)
    for number, place in enumerate(("Free Field", "Lobby", "Steel Box")):
        form = f"(Sta Chn: 4)     Location: {place}"
        lines = [f"{line}   {form}" if line.startswith("CHAN ") else line for line in text.splitlines()]
        (tmp_path / f"station{number}.V2").write_text("\n".join(lines) + "\n", encoding="utf-8")
    suite = read_suite(tmp_path)
    assert {record.place for record in suite} == {"Free Field"}
    assert sum("by its header: Lobby" in one.reason for one in suite.excluded) >= 1
    pairs = find_pairs(tmp_path)
    assert [pair.first.place for pair in pairs] == ["Free Field"] * len(pairs)
    assert any("by its header: Steel Box" in one.reason for one in pairs.excluded)
