"""Limits of everything that is read are met before the memory is used; one table has them."""

from __future__ import annotations

import argparse
import ast
import json
import re
import runpy
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

import seismass as sm
from seismass.base import limits
from seismass.base.arguments import as_threads
from seismass.commands.options import threads_option
from seismass.motions.motion import check_size
from seismass.motions.records.counts import NotRead
from seismass.studies.evidence import example_file, read_archetypes

ROOT = Path(__file__).parents[1]
PROGRAM: dict[str, Any] = runpy.run_path(str(ROOT / "tools" / "hostile_files.py"))


@pytest.mark.parametrize("name", PROGRAM["FILES"])
def test_a_file_that_asks_for_memory_is_refused_in_one_line(name: str, tmp_path: Path) -> None:
    """Within a gigabyte and half a minute, or read within them."""
    _, _, _, outcome = PROGRAM["tried"](name, tmp_path)
    assert not outcome.startswith("defect"), outcome
    assert re.search("must be|larger than", outcome) or name in ("record, 2 000 000 rows", READ), outcome
    assert list(tmp_path.glob("*.zip")) == []


READ = "record, 24 MB of rows of a hundred"


def test_the_page_has_the_table_of_limits() -> None:
    text = (ROOT / "docs" / "reliability.md").read_text(encoding="utf-8")
    for row in limits.LIMITS:
        assert f"| {' | '.join(row)} |" in text


def test_limits_of_what_is_read_stand_in_their_module_alone() -> None:
    """Sizes in bytes elsewhere are of what is written, or of pieces."""
    package = Path(sm.__file__).parent
    found = []
    for path in sorted(package.rglob("*.py")):
        place = path.relative_to(package).as_posix()
        if place.startswith("data/") or place == "base/limits.py":
            continue
        for node in ast.parse(path.read_text("utf-8")).body:
            target = node.target if isinstance(node, ast.AnnAssign) else None
            if isinstance(target, ast.Name) and re.search(
                "MOST.*BYTES|LARGEST.*BYTES|UNPACKED|MOST_MEMBERS", target.id
            ):
                found.append(f"{place}: {target.id}")
    assert found == ["base/stored_results.py: _MOST_BYTES", "motions/records/catalogue_search.py: _LARGEST_BYTES"]


BUILDING = sm.Building.uniform(1, 0.3)
BLOCKS = sm.blocks_on_floors([0.5], mu=0.2)
SCENE = sm.Scene(BUILDING, BLOCKS)
(RECORD, *_) = sm.builtin_suite("seven")
RECORD = RECORD.replace(acceleration=RECORD.acceleration[:300], component="000", azimuth=0.0)
PAIR = sm.Pair(RECORD, RECORD.replace(component="090", azimuth=90.0))
FILM = sm.animation.animate_plane(sm.Scene(BUILDING, BLOCKS, other_direction=True), (RECORD, RECORD), end=0.3)
SCENES = sm.Grid.product(BUILDING, mass_ratio=0.5, mu=[0.2, 0.3])
NAMED: str = PROGRAM["SCENE"] % 2
STOREYS = NAMED.replace("storeys = 1\nperiod = 0.3", "storeys = %d\nmass = 1.0\nstiffness = 9.0")
COLUMN = "acceleration (m/s2), dt = 0.01 s"


def lines(head: str, row: str, count: int) -> str:
    """A file of so many lines, empty ones after rows of numbers."""
    return "\n".join([head, *(row.format((-1) ** n * n, n) for n in range(1, 9))]) + "\n" * (count - 8)


def storeys(rows: int, columns: int) -> list[list[str]]:
    """So many rows and columns of a storey table."""
    head = ["Story", "Height (m)", "Stiffness (kN/m)", "Mass (t)"]
    table = [head, *([f"S{number}", "3", "8e3", "71"] for number in range(rows - 1, 0, -1))]
    return [row + [f"c{number}" for number in range(5, columns + 1)] for row in table]


def csv(table: list[list[str]]) -> str:
    """A table as text."""
    return "\n".join(",".join(row) for row in table)


def sheet(table: list[list[str]]) -> bytes:
    """A workbook of one sheet."""
    cells = ("".join(f"<c t='inlineStr'><is><t>{cell}</t></is></c>" for cell in row) for row in table)
    rows = "".join(f"<row>{row}</row>" for row in cells)
    content: bytes = PROGRAM["workbook"](f"<worksheet><sheetData>{rows}</sheetData></worksheet>".encode())
    return content


def packed(sizes: list[int]) -> bytes:
    """An archive of records of so many bytes."""
    content: bytes = PROGRAM["archive"]({f"{number}.txt": record(size) for number, size in enumerate(sizes)})
    return content


def record(size: int) -> bytes:
    """A record of so many bytes, the last ones empty lines."""
    return (COLUMN + "\n0.2\n-0.3\n0.1\n-0.1").encode().ljust(size, b"\n")


def read(place: Path, kind: str, name: str, content: str | bytes) -> object:
    """Read a file as what it is."""
    path = place / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return PROGRAM["reader"](kind)(path)


def counts(place: Path, size: int) -> None:
    """A file of so many bytes, which is none of counts."""
    (place / "c.sac").write_bytes(bytes(size))
    with suppress(NotRead):
        sm.records.read_counts(place / "c.sac", factor=1.0)


def archetypes(place: Path, storeys: int) -> object:
    """The archetypes of the example, one of so many storeys."""
    text = example_file().read_text(encoding="utf-8")
    (place / "a.toml").write_text(text.replace("[[1, ", f"[[{storeys}, ", 1), encoding="utf-8")
    return read_archetypes(place / "a.toml")


def campaign(place: Path, count: int) -> object:
    """A campaign with an axis of so many values."""
    document = {"motions": {"builtin": "seven"}, "grid": {"storeys": 1, "period": 0.3, "mass_ratio": 1.0}}
    document["grid"]["mu"] = {"from": 0.1, "to": 0.5, "count": count}
    return read(place, "campaign", "c.json", json.dumps(document))


LIMITED: dict[str, tuple[int, Callable[[Path, int], object]]] = {
    "assessment.table_file.MOST_COLUMNS": (7, lambda at, n: read(at, "storey table", "t.csv", csv(storeys(3, n)))),
    "assessment.table_file.MOST_ROWS": (7, lambda at, n: read(at, "storey table", "t.csv", csv(storeys(n, 4)))),
    "assessment.workbook.MOST_COLUMNS": (7, lambda at, n: read(at, "storey table", "t.xlsx", sheet(storeys(3, n)))),
    "assessment.workbook.MOST_ROWS": (7, lambda at, n: read(at, "storey table", "t.xlsx", sheet(storeys(n, 4)))),
    "base.input_table.MOST_LETTERS": (70, lambda at, n: read(at, "scene", "s.toml", f'name = "{"n" * n}"{NAMED}')),
    "base.limits.MOST_ROWS": (
        20,
        lambda at, n: read(at, "hazard curve", "h.csv", lines("Sa (g),annual rate", "0.{1},1e-{1}", n)),
    ),
    "base.arguments._kernel.MAX_THREADS": (3, lambda _, n: as_threads(n, "a batch")),
    "model.rack.MOST_LEVELS": (3, lambda _, n: sm.Rack(1, levels=n, level_mass=1.0, period=0.5)),
    "motions.motion.MOST_SAMPLES": (70, lambda _, n: check_size(n, 0.01, "a record")),
    "motions.motion.MOST_SECONDS": (70, lambda _, n: check_size(n + 1, 1.0, "a record")),
    "motions.pulses.baker2007.MOST_ORIENTATIONS": (
        3,
        lambda _, n: sm.pulses.baker2007_orientations(PAIR, orientations=n),
    ),
    "motions.records.processing.HIGHEST_ORDER": (3, lambda _, n: RECORD.baseline_corrected(n)),
    "motions.records.counts.MOST_RECORD": (300, counts),
    "motions.records.read.MOST_LINES": (20, lambda at, n: read(at, "record", "r.txt", lines(COLUMN, "{0}", n))),
    "motions.records.read.MOST_MEMBERS": (3, lambda at, n: read(at, "archive", "a.zip", packed([300] * n))),
    "motions.records.read.MOST_RECORD": (300, lambda at, n: read(at, "record", "r.txt", record(n))),
    "motions.records.read.MOST_UNPACKED": (600, lambda at, n: read(at, "archive", "a.zip", packed([n - 300, 300]))),
    "runs.batch.MAX_THREADS": (3, lambda _, n: threads_option(str(n))),
    "runs.batch.MAX_ROWS": (3, lambda _, n: sm.simulate_many([SCENE] * n, RECORD)),
    "runs.batch.MAX_RUNS": (3, lambda _, n: sm.simulate_many([SCENE] * n, RECORD)),
    "runs.grid.grid.MAX_SCENES": (3, lambda _, n: sm.Grid.product(BUILDING, mass_ratio=0.5, mu=[0.2] * n)),
    "runs.grid.sample.MOST_SAMPLES": (3, lambda _, n: sm.Grid.sample(BUILDING, samples=n, mass_ratio=0.5, mu=0.2)),
    "runs.scene_product.MOST_SCENES": (3, lambda _, n: sm.runs.SceneProduct(lambda mu: SCENE, mu=[0.2] * n)),
    "runs.scene_file._kernel.MAX_STOREYS": (3, lambda at, n: read(at, "scene", "s.toml", STOREYS % n)),
    "show.animation.plane_picture.MOST_FRAMES": (3, lambda at, n: FILM.write(at / "a.gif", frames_per_second=n)),
    "studies.campaign.campaign.MOST_PART_RUNS": (3, lambda _, n: sm.campaign.Campaign(SCENES, [RECORD], part_runs=n)),
    "studies.campaign.campaign.MOST_VALUES": (3, campaign),
    "studies.evidence.archetypes.MOST_STOREYS": (50, archetypes),
}
"""Limits by module and name, a small one in place of each, and what asks for so many."""
REFUSED = re.compile(
    r"\bif [^\n]*?(?<![\w.])((?:_kernel\.)?(?:MOST|MAX|HIGHEST)_\w+)[^\n]*:\n"
    r"(?:[^\n]* = [^\n]*\n)?[^\n]*(?:raise|refuse)"
)
IMPORTED = {"commands.options.MAX_THREADS": "runs.batch.MAX_THREADS"}
NO_COUNTS = {
    "assessment.pushover_file.MOST_RATIO",
    "assessment.storey_table.MOST_RATIO",
    "base.stored_results.MOST_FOOTER",
    "motions.records.formats.columns.MOST_TWICE",
}


def test_every_limit_that_refuses_is_reached_here() -> None:
    package, found = Path(sm.__file__).parent, set()
    for path in package.rglob("*.py"):
        place = path.relative_to(package).with_suffix("").as_posix().replace("/", ".")
        found |= {f"{place}.{one[1]}" for one in REFUSED.finditer(path.read_text("utf-8"))}
    assert {IMPORTED.get(name, name) for name in found - NO_COUNTS} == set(LIMITED)


@pytest.mark.parametrize("name", LIMITED)
def test_a_limit_may_be_reached_and_not_exceeded(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    limit, make = LIMITED[name]
    place, _, constant = name.rpartition(".")
    monkeypatch.setattr(import_module("seismass." + re.sub(r".*(?=_kernel)", "", place)), constant, limit)
    said = []
    for count in (limit - 1, limit, limit + 1):
        try:
            make(tmp_path, count)
            said.append("")
        except (sm.SeismassError, argparse.ArgumentTypeError) as error:
            said.append(str(error))
    assert said[:2] == ["", ""]
    assert re.search(rf"\b{limit}\b", said[2])
