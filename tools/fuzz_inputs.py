"""Read mutated input files of every kind but records, which tools/fuzz_records.py mutates: a result or one error line.

Usage: tools/fuzz_inputs.py [--count 5000] [--seed 1] [--keep DIR]. Scene, building and campaign files (TOML and
JSON), target spectra, hazard curves, storey tables, pushover curves, workbooks, archives of records, links of the live
page (where node is on the path), and the folders of a campaign, an assessment and a study: each change must be seen by
their digests, and end as that of other files where it is read by force. Values are put in place of others, keys and
lines are moved, doubled or left out, and bytes are changed. A defect is an exception that is not the package's, or that
of the system for a file; more than 5 s of processor time; or 512 MB of memory. --keep saves the file of each defect.
`make fuzz` runs both programs, and a small run is part of the tests.
"""

from __future__ import annotations

import argparse
import atexit
import contextlib
import io
import json
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import seismass as sm
from seismass.assessment import read_pushover, read_storey_table
from seismass.assessment.building_file import example_file
from seismass.assessment.result import Assessment
from seismass.base.errors import InvalidOption
from seismass.runs.scene_file import example_scene
from seismass.studies.campaign.folder import example_description
from seismass.studies.study import StudyParameters, StudyResult, run_study

SECONDS_PER_FILE = 5.0
MEMORY_GROWTH_KB = 512 * 1024
LONGEST_MESSAGE = 6000
"""Letters; a path of 5000 stands whole in the errors of the system."""

VALUES: tuple[Any, ...] = (
    *(None, True, False, 0, -1, 1, 2, 1.5, 1e-300, 1e300, -1e300, 1e-9, 10**30, 2**53, float("nan"), float("inf")),
    *("", "a", "\x1b[2J", "\ud800", "../../etc/passwd", "/dev/zero", "x" * 5000, "ec8", "asce7-10", "mean:.", "nan"),
    *(
        [],
        {},
        [[]],
        [1.0],
        [1.0, "a"],
        {"a": 1},
        [None],
        [[1.0], [2.0, 3.0]],
        {"from": 0.1, "to": 0.5, "count": 10**12},
    ),
    {"distribution": "uniform", "low": 1, "high": 0},
)
"""What stands in place of a value."""


@dataclass
class Tally:
    """What became of the files, by kind, and the defects."""

    counts: Counter[tuple[str, str]] = field(default_factory=Counter)
    defects: list[tuple[str, str, bytes]] = field(default_factory=list)


@dataclass(frozen=True)
class Kind:
    """A kind of input: its name, the file that is mutated, and what reads it."""

    name: str
    file: str
    content: bytes
    read: Callable[[Path], Any]
    folder: Path | None = None
    """Folder in which the file stands, where it is not alone."""
    digests: bool = False
    """Whether every change must be seen."""


def kinds(place: Path) -> list[Kind]:
    """Return one of each kind of input; folders are made in `place`."""
    readers: list[tuple[str, Path, Callable[[Path], Any]]] = [
        ("scene", example_scene(), sm.runs.read_scene),
        ("building", example_file(), sm.read_building),
        ("campaign", example_description(), sm.campaign.read_campaign),
    ]
    found = []
    for name, path, read in readers:
        content = path.read_bytes()
        found.append(Kind(f"{name}, TOML", f"{name}.toml", content, read))
        document = json.dumps(tomllib.loads(content.decode()), indent=1).encode()
        found.append(Kind(f"{name}, JSON", f"{name}.json", document, read))
    spectrum = b"period (s),Sa (g)\n0.1,0.4\n0.5,0.9\n1.0,0.5\n4.0,0.1\n"
    hazard = b"Sa (g),annual rate\n0.1,0.01\n0.3,0.002\n1.0,0.0001\n"
    found.append(Kind("target spectrum", "target.csv", spectrum, sm.spectra.TargetSpectrum.from_csv))
    found.append(Kind("hazard curve", "hazard.csv", hazard, sm.risk.HazardCurve.from_csv))
    storeys = b"Story,Case,Elevation (m),UX (t),Stiff X (kN/m)\nRoof,EQX,7.5,90.5,1e5\nL1,EQX,4,120,2e5\nBase,,0,9,\n"
    curve = (
        b"LoadCase\tStep\tDisplacement\tBaseForce\nText\tUnitless\tm\tKN\nP\t0\t-0.01\t0\nP\t1\t2.5\t400\nP\t2\t4\t9\n"
    )
    keyed = b'TABLE:  "A"\n  CurrUnits="KN, m, C"\n\nTABLE:  "STORY DATA"\n  Story=L2  Height=3\n  Story=L1  Height=4\n'
    found.append(Kind("storey table", "storeys.csv", storeys, read_storey_table))
    found.append(Kind("storey table, s2k", "storeys.s2k", keyed, read_storey_table))
    found.append(Kind("pushover curve", "push.txt", curve, read_pushover))
    found.append(Kind("sheet of a workbook", "sheet.xml", _SHEET, _in_workbook))
    grid = sm.runs.Grid.product(sm.Building.uniform(1, 0.3), mass_ratio=1.0, mu=[0.1, 0.2, 0.3])
    campaign = sm.campaign.Campaign(grid, sm.Motion([1.0, -1.0, 0.0], 0.1), part_runs=2).run(place / "campaign").path
    for file in ("manifest.json", "axes.parquet", "motions.parquet", "parts/part-0000001.parquet"):
        content = (campaign / file).read_bytes()
        found.append(Kind(f"campaign's {Path(file).name}", file, content, _verified, campaign, digests=True))
    assessed = place / "assessment"
    sm.assess(example_file(), mu_factors=(1.0, 1.0), resamples=2).write(assessed, figures=False)
    for file in ("assessment.json", "storeys.parquet"):
        content = (assessed / file).read_bytes()
        found.append(Kind(f"assessment's {file}", file, content, _assessment, assessed, digests=True))
        found.append(Kind(f"assessment's {file}, by force", file, content, _forced_assessment, assessed))
    studied = place / "study"
    small = StudyParameters(buildings=((2, 0.38),), response_modification=(4.0,), mass_ratios=(1.0,))
    run_study(sm.builtin_suite("seven"), sm.TargetSpectrum.asce7(), small).write(studied, figures=False)
    for path in sorted(studied.iterdir()):
        if path.suffix in (".parquet", ".json"):
            content = path.read_bytes()
            if path.name in StudyResult.files_read():
                found.append(Kind(f"study's {path.name}", path.name, content, _study, studied, digests=True))
                found.append(Kind(f"study's {path.name}, by force", path.name, content, _forced_study, studied))
    found.append(Kind("workbook", "book.xlsx", _workbook(_SHEET), read_storey_table))
    record = b"a\nb\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 4, DT= .01 SEC\n 0.1 0.2 -0.1 0.0\n"
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for number in (1, 2):
            archive.writestr(f"RSN{number}_A_B00{number}.AT2", record.replace(b"0.2", b"0.%d" % number))
    found.append(Kind("archive of records", "records.zip", packed.getvalue(), sm.read_suite))
    if shutil.which("node"):
        link = b"v=1&by=design&m=synthetic-1&d=code&n=3&T=0.47&z=0.05&O=2&r2=0.05&h=3.5&R=4&V=0.34,0.27,0.13&a=1,1,0"
        of_file = b"&r3=0&M=1.1,1.1,0.8&K=1,1,0.7&P=1&o=0.8&y=1&g=1,1,1,1,1,1,2&F=0.5,0.1,0.8,7&W=kinds"
        text = link + b"&s=0.2,0.2,0.2&k=0.2,0.2,0.2&x=1&c=0.25" + of_file
        found.append(Kind("link of the live page", "link.txt", text, Links()))
    return found


_SHEET = (
    b'<worksheet><sheetData><row r="1"><c r="A1" t="s"><v>0</v></c>'
    b'<c r="B1" t="inlineStr"><is><t>Height (m)</t></is></c></row>'
    b'<row r="2"><c r="A2" t="inlineStr"><is><t>L1</t></is></c><c r="B2"><v>4</v></c></row></sheetData></worksheet>'
)


def _in_workbook(path: Path) -> None:
    """Read a workbook whose sheet is the file."""
    book = path.with_suffix(".xlsx")
    book.write_bytes(_workbook(path.read_bytes()))
    read_storey_table(book)


def _workbook(sheet: bytes) -> bytes:
    """A workbook of one sheet."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        archive.writestr("xl/_rels/workbook.xml.rels", '<R><L Id="r" Target="worksheets/a.xml"/></R>')
        archive.writestr("xl/workbook.xml", '<w xmlns:r="q"><sheets><sheet name="A" r:id="r"/></sheets></w>')
        archive.writestr("xl/sharedStrings.xml", "<s><si><t>Story</t></si></s>")
        archive.writestr("xl/worksheets/a.xml", sheet)
    return content.getvalue()


def _verified(path: Path) -> None:
    folder = sm.campaign.CampaignFolder(path)
    damaged = folder.verify()["problem"].drop_nulls()
    if len(damaged):
        raise InvalidOption(damaged[0])
    folder.scan().collect()


def _assessment(folder: Path, *, force: bool = False) -> None:
    Assessment.read(folder, force=force)


def _study(folder: Path, *, force: bool = False) -> None:
    StudyResult.read(folder, force=force)


def _forced_assessment(folder: Path) -> None:
    _assessment(folder, force=True)


def _forced_study(folder: Path) -> None:
    _study(folder, force=True)


class Links:
    """Opens links of the live page by its own program, and reads the scene file that it gives of each."""

    PROGRAM = """
        const vm = require("vm"), fs = require("fs");
        const names = "{ caseOf, sceneOf, sceneFile, strengthsOf, addressOf, LIMITS, LISTS }";
        const sources = process.argv.slice(1).map((file) => fs.readFileSync(file, "utf8")).join("");
        vm.runInThisContext(sources + ";globalThis.page = " + names);
        const record = { name: "a", dt: 0.01, unit: "g", values: [0.1, -0.1] };
        require("readline").createInterface({ input: process.stdin }).on("line", (line) => {
          let said;
          try {
            const { state, remarks } = page.caseOf(JSON.parse(line));
            for (const [key, [low, high]] of Object.entries(page.LIMITS))
              for (const each of page.LISTS.includes(key) ? state[key] : [state[key]])
                if (!(each >= low && each <= high)) throw new Error(`${key} is ${each}`);
            const again = page.caseOf(page.addressOf(state));
            if (again.remarks.length) throw new Error(again.remarks[0]);
            const scene = page.sceneOf(state, page.strengthsOf(state, [1, 1, 1, 1].slice(0, state.storeys)));
            const stiffness = scene.stiffness.map((shape) => 100 * shape);
            const words = { stiffness, record, scale: state.intensity, note: "" };
            said = { file: page.sceneFile(scene, words), remarks };
          } catch (error) {
            said = { error: String(error) };
          }
          console.log(JSON.stringify(said));
        });
    """

    def __init__(self) -> None:
        templates = Path(sm.__file__).parent / "show" / "explore" / "templates"
        command = ["node", "-e", self.PROGRAM, *(str(templates / name) for name in ("record.js", "case.js"))]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        atexit.register(self.process.kill)

    def __call__(self, path: Path) -> None:
        """Raise an error of the package where the link has remarks."""
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.write(json.dumps(path.read_bytes().decode("utf-8", "replace")) + "\n")
        self.process.stdin.flush()
        said = json.loads(self.process.stdout.readline())
        if "error" in said:
            raise RuntimeError(said["error"])
        scene = path.with_suffix(".toml")
        scene.write_text(said["file"], encoding="utf-8")
        sm.runs.read_scene(scene)
        if said["remarks"]:
            raise InvalidOption(said["remarks"][0])


def mutated(rng: random.Random, kind: Kind) -> bytes:
    """Return the content with one to three changes."""
    content = kind.content
    for _ in range(rng.randint(1, 3)):
        change = rng.choice(
            (_value, _value, _key, _line, _bytes, _cut)
            if kind.file.endswith(".json")
            else (_line, _bytes, _cut, _number)
        )
        content = change(rng, content)
    return content


def _places(document: Any) -> Iterator[tuple[Any, Any]]:
    """Containers of a JSON document, each with a key or index of it."""
    items = (
        document.items() if isinstance(document, dict) else enumerate(document) if isinstance(document, list) else ()
    )
    for key, value in list(items):
        yield document, key
        yield from _places(value)


def _document(content: bytes) -> Any:
    with contextlib.suppress(ValueError, RecursionError):
        return json.loads(content)
    return None


def _value(rng: random.Random, content: bytes) -> bytes:
    document = _document(content)
    places = list(_places(document))
    if not places:
        return content
    holder, key = rng.choice(places)
    holder[key] = rng.choice(VALUES)
    return json.dumps(document).encode("utf-8", "surrogatepass")


def _key(rng: random.Random, content: bytes) -> bytes:
    document = _document(content)
    places = [(holder, key) for holder, key in _places(document) if isinstance(holder, dict)]
    if not places:
        return content
    holder, key = rng.choice(places)
    value = holder.pop(key)
    if rng.random() < 0.5:
        rng.choice(places)[0][rng.choice((key, key + "x", "a\x1b", ""))] = value
    return json.dumps(document).encode("utf-8", "surrogatepass")


def _line(rng: random.Random, content: bytes) -> bytes:
    lines = content.split(b"\n")
    one, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    choice = rng.randrange(3)
    if choice == 0:
        del lines[one]
    elif choice == 1:
        lines.insert(other, lines[one])
    else:
        lines[one], lines[other] = lines[other], lines[one]
    return b"\n".join(lines)


def _number(rng: random.Random, content: bytes) -> bytes:
    """Another value in place of what stands behind = or a comma of a line."""
    lines = content.split(b"\n")
    number = rng.randrange(len(lines))
    for sign in (b"=", b","):
        head, found, _ = lines[number].partition(sign)
        if found:
            value = rng.choice(VALUES)
            shown = json.dumps(value) if not isinstance(value, float) else repr(value)
            lines[number] = head + found + b" " + shown.encode("utf-8", "surrogatepass")
            break
    return b"\n".join(lines)


def _bytes(rng: random.Random, content: bytes) -> bytes:
    changed = bytearray(content or b"\0")
    for _ in range(rng.randint(1, 4)):
        changed[rng.randrange(len(changed))] = rng.randrange(256)
    return bytes(changed)


def _cut(rng: random.Random, content: bytes) -> bytes:
    start, end = sorted(rng.randrange(len(content) + 1) for _ in range(2))
    return content[:start] if rng.random() < 0.3 else content[:start] + content[end:]


def outcome_of(kind: Kind, content: bytes, place: Path) -> str:
    """Return what becomes of a content: read, refused, or a defect."""
    folder = kind.folder or place
    path = folder / kind.file
    path.write_bytes(content)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    began = time.process_time()
    try:
        kind.read(path if kind.folder is None else folder)
        # A campaign knows its files by their digests; the order of keys is no change.
        seen = not kind.digests or (kind.read is _verified and _same(content, kind.content)) or content == kind.content
        outcome = "read" if seen else "defect: a change that is not seen"
    except (sm.SeismassError, OSError) as error:
        outcome = "refused" if len(str(error)) < LONGEST_MESSAGE else "defect: a message without end"
    except Exception as error:
        outcome = f"defect: {type(error).__name__}: {error}"[:200]
    finally:
        path.write_bytes(kind.content)
    if time.process_time() - began > SECONDS_PER_FILE:
        return "defect: slow"
    if resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before > MEMORY_GROWTH_KB:
        return "defect: memory"
    return outcome


def _same(one: bytes, other: bytes) -> bool:
    return one == other or (_document(one) is not None and _document(one) == _document(other))


def fuzz(count: int, seed: int) -> Tally:
    """Read `count` mutated files; the same seed gives the same."""
    rng = random.Random(seed)
    tally = Tally()
    place = Path(tempfile.mkdtemp())
    try:
        listed = kinds(place)
        for number in range(count):
            kind = listed[number % len(listed)]
            content = mutated(rng, kind)
            outcome = outcome_of(kind, content, place)
            tally.counts[kind.name, outcome.partition(":")[0]] += 1
            if outcome.startswith("defect"):
                tally.defects.append((kind.file, outcome, content))
    finally:
        shutil.rmtree(place)
    return tally


def main() -> int:
    """Mutate, print the outcome, and return 1 where there is a defect."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path)
    args = parser.parse_args()
    tally = fuzz(args.count, args.seed)
    for name in dict.fromkeys(name for name, _ in tally.counts):
        found = {outcome: tally.counts[name, outcome] for outcome in ("read", "refused", "defect")}
        print(f"{name:40}" + ", ".join(f"{outcome} {number}" for outcome, number in found.items()))
    for number, (file, outcome, content) in enumerate(tally.defects, start=1):
        print(f"{file}: {outcome}")
        if args.keep is not None:
            args.keep.mkdir(parents=True, exist_ok=True)
            (args.keep / f"{number}-{Path(file).name}").write_bytes(content)
    return 1 if tally.defects else 0


if __name__ == "__main__":
    sys.exit(main())
