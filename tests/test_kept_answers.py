"""What whole commands print, write and draw is as it was: a change is seen, and looked at, before it is kept.

Other tests say what is right; these see that something changed. Each case is a command on inputs in which no two
quantities are alike. What it prints, the numbers and words of its files, and what each of its figures holds are
compared with tests/kept_answers. `KEEP_ANSWERS=1 pytest tests/test_kept_answers.py` writes them anew: read the diff
before it is committed, line by line.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterator
from functools import partial
from html.parser import HTMLParser
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from typing import Any
from zlib import crc32

import numpy as np
import polars as pl
import pytest
from matplotlib.artist import Artist
from matplotlib.figure import Figure

import seismass as sm
from seismass import cli
from seismass.commands.parser import COMMANDS

KEPT = Path(__file__).parent / "kept_answers"
DIGITS = 5
VERSIONS = " ".join(
    f"{name} {version(name).rpartition('.')[0]}" for name in ("matplotlib", "numpy", "polars", "rich", "scipy")
)
"""What else the words and figures depend on: with other versions the answers are not compared, which is said."""
MINUS = "\N{MINUS SIGN}"
NUMBER = re.compile(rf"(?<![\w.])[-{MINUS}]?\d+\.\d+(?:e[-+]?\d+)?(?![\w.])", re.IGNORECASE)
CHANGING = re.compile(
    r"(?<![\w.])(?=(?:\d*[a-f]){3})[0-9a-f]{12,64}\b|\d{4}-\d\d-\d\d(?:[T ]\d\d:\d\d(?::\d\d)?)?"
    r"|\b\d+(?:\.\d+)? (?:ms|s|min)(?= (?:of|in|for|on)\b)|0\.1\.0\S*|(?<=\")\d\.\d+\.\d+(?=\")"
    r"|^time .*$|(?<=, )\d+\.\d s$|(?<=instructions: )\w+|(?<=bits: )\w+|^(?:baseline|avx2|avx512)(?=;)",
    re.MULTILINE,
)
"""Digests, dates, times of runs, versions and instructions of the processor."""

RACKED = {"on_racks": {"period_s": 0.83, "frame": 0.07, "damping": 0.023}, "stops": {"clearance_m": 0.037}}
CASES: dict[str, tuple[str, ...]] = {
    "building": ("building", "u.json", "--suite", "seven", "--out", "out"),
    "building_us": ("building", "u.json", "--show", "us", "--no-figures"),
    "building_walls": ("building", "walls.json", "--no-figures"),
    "building_racks": ("building", "racks.json", "--no-figures"),
    "building_base": ("building", "base.json", "--no-figures"),
    "building_elastic": ("building", "elastic.json", "--no-figures", "--out", "out"),
    "building_tipping": ("building", "tipping.json", "--no-figures"),
    "slip": ("slip", "u.json", "--suite", "seven", "--out", "out"),
    "fragility": (
        *("fragility", "u.json", "--suite", "seven", "--limit", "drift=0.013", "--method", "stripes"),
        *("--intensity", "0.37,0.79,1.31", "--out", "out"),
    ),
    "risk": ("risk", "u.json", "--hazard", "h.csv", "--limit", "drift=0.013", "--out", "out"),
    "study": ("study", "--suite", "seven", "--mu", "0.23", "--out", "out"),
    "map": ("map", "--suite", "seven", "--mu", "0.13,0.37", "--R", "2.3,5.1", "--alpha", "1.3", "--out", "out"),
    "run": ("run", "s.json", "--out", "x.csv"),
    "records": ("records", "motions.csv"),
    "spectrum": ("spectrum", "burst2.csv", "--period", "0.31,0.77,1.9", "--damping", "0.03,0.07"),
    "inelastic": ("spectrum", "burst2.csv", "--period", "0.31,0.77", "--ductility", "2.3,4.1"),
    "target": ("target", "ec8:1:C:0.31", "--period", "0.07,0.31,0.77,2.9", "--out", "x.csv"),
    "scale": ("scale", "--suite", "seven", "--period", "0.63", "--sds", "1.13", "--sd1", "0.71", "--plot", "x.png"),
    "match": ("match", "motions.csv", "--sds", "1.13", "--sd1", "0.71", "--range", "0.3,1.1", "--plot", "x.png"),
    "pulse": ("pulse", "burst3.csv"),
    "campaign": ("campaign", "c.toml", "--out", "out"),
    "codes": ("building", "--codes"),
    "frictions": ("building", "--frictions"),
}


CAMPAIGN = """
name = "few runs"
[motions]
builtin = "seven"
scaling = "asce7-10"
target = "asce7:1.13:0.71"
period = 0.53
[grid]
storeys = [2, 3]
period = [0.37, 0.53]
roof = "bare"
mass_ratio = [0.57, 1.31]
occupancy = 0.71
mu = [0.17, 0.43]
R = [1.7, 4.1]
[grid.design]
target = "asce7:1.13:0.71"
share = 0.23
"""


def inputs(place: Path, file: dict[str, Any], motions: tuple[sm.Record, ...]) -> None:
    """Write the files that the commands read."""
    for number, motion in enumerate(motions, start=1):
        rows = (f"{index * motion.dt:.4f},{value:.6f}" for index, value in enumerate(motion.acceleration))
        (place / f"burst{number}.csv").write_text("\n".join(["time (s),acceleration (m/s2)", *rows]) + "\n")
    (place / "motions.csv").write_text("file\n" + "".join(f"burst{number}.csv\n" for number in (1, 2, 3)))
    (place / "h.csv").write_text("Sa (g),annual rate\n0.05,0.053\n0.31,0.0023\n1.07,0.00013\n4.1,0.0000011\n")
    storeys = file["storeys"]
    tall = {"name": "rolls", "share": 1.0, "occupied": 0.71, "mu_s": 0.349, "mu_k": 0.184}
    tall |= {"width_m": 0.71, "height_m": 2.9}
    loft = {key: value for key, value in storeys[1].items() if key not in ("occupied", "mu_s", "mu_k")}
    files = {
        "u": file,
        "walls": file | {"walls": {"flexural_rigidity_kn_m2": 1.7e6}},
        "racks": file | {"storeys": [storeys[0], storeys[1] | RACKED, storeys[2]]},
        "base": file | {"base": {"mass_kg": 91e3, "mu_s": 0.137, "mu_k": 0.113}},
        "elastic": file | {"storeys": [*storeys[:2], storeys[2] | {"yield_shear_kn": float("inf")}]},
        "tipping": file | {"storeys": [storeys[0], loft | {"goods": [tall]}, storeys[2]]},
    }
    for name, document in files.items():
        (place / f"{name}.json").write_text(json.dumps(document))
    scene = {
        "building": {
            "storeys": 2,
            "period": 0.47,
            "heights": [3.7, 3.1],
            "damping": 0.037,
            "geometric_stiffness": [1.31, 0.83],
            "yield_shear_over_weight": 0.23,
        },
        "blocks": [
            {"floor": 1, "mass_ratio": 0.41, "mu_s": 0.27, "mu_k": 0.19},
            {"floor": 2, "mass_ratio": 0.23, "mu": 0.31},
        ],
        "motion": {"file": "burst1.csv"},
    }
    (place / "s.json").write_text(json.dumps(scene))
    (place / "c.toml").write_text(CAMPAIGN)


class Words(HTMLParser):
    """The text of a page, without scripts, styles and pictures."""

    def __init__(self) -> None:
        super().__init__()
        self.hidden = 0
        self.words: list[str] = []

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.hidden += tag in ("script", "style", "svg")

    def handle_endtag(self, tag: str) -> None:
        self.hidden -= tag in ("script", "style", "svg")

    def handle_data(self, data: str) -> None:
        if not self.hidden and data.strip():
            self.words.append(" ".join(data.split()))


def steady(text: str) -> str:
    """Return a text with numbers of five digits, and without what changes from run to run."""
    text = CHANGING.sub("#", text)
    return NUMBER.sub(lambda found: f"{float(found[0].replace(MINUS, '-')):.{DIGITS}g}", text)


def table_lines(table: pl.DataFrame) -> Iterator[str]:
    """Yield a table by its columns: all of a short one, else sum, least and largest."""
    for name in table.columns:
        column = table[name]
        if table.height <= 12:
            yield f"{name}: {', '.join(map(_shown, column.to_list()))}"
        elif column.dtype.is_numeric():
            finite = column.cast(pl.Float64).filter(column.is_not_null())
            yield f"{name}: {table.height} rows, sum {finite.sum()}, from {finite.min()} to {finite.max()}"
        else:
            yield f"{name}: {table.height} rows, {column.n_unique()} values, {column[0]} to {column[-1]}"


def array_text(values: object) -> str:
    """Return numbers of a drawing: all of few, else their count, weighted sum, least and largest."""
    numbers = np.ma.filled(np.ma.asarray(values, dtype=float), np.nan).ravel()
    if numbers.size <= 8:
        return " ".join(f"{number:.4g}" for number in numbers)
    found = numbers[np.isfinite(numbers)]
    weight = np.arange(1, found.size + 1) @ found / max(found.size, 1)
    return f"{numbers.size}: {weight:.4g} {found.min(initial=np.inf):.4g} {found.max(initial=-np.inf):.4g}"


def artist_text(artist: Artist) -> str:
    """Return the words, places, colours and widths of a part of a figure."""
    kind, words = type(artist).__name__, getattr(artist, "get_text", str)()
    if kind in ("Spine", "XAxis", "YAxis") or (kind == "Text" and not words):
        return ""
    drawn = [kind, words, re.sub("^_child.*", "", str(artist.get_label()))]
    names = ["get_xydata", "get_position", "get_bbox", "get_color", "get_facecolor", "get_linewidth", "get_zorder"]
    names += ["get_segments" if kind == "LineCollection" else "get_offsets"]
    values = (getattr(artist, name)() for name in names if hasattr(artist, name))
    return " | ".join([*drawn, *(_shown(getattr(value, "extents", value)) for value in values)])


def figure_lines(figure: Figure) -> Iterator[str]:
    """Yield what a figure holds: scales, limits and words of its axes, lines, marks, areas, with colours and widths."""
    yield f"figure {figure.get_figwidth():.3g} x {figure.get_figheight():.3g}"
    for axes in figure.axes:
        for scale, limits in ((axes.get_xscale(), axes.get_xlim()), (axes.get_yscale(), axes.get_ylim())):
            yield f"axis {scale} {array_text(limits)}"
        drawn = [artist for artist in axes.get_children() if artist.get_visible() and artist is not axes.patch]
        found = [text for artist in drawn if (text := artist_text(artist))]
        yield from found[:15]
        yield f"{len(found)} artists, {crc32(chr(10).join(found).encode())}"
        yield f"words {axes.get_xlabel()} | {axes.get_ylabel()} | {axes.get_title(loc='left')} | {axes.get_title()}"


def _shown(value: object) -> str:
    """Return numbers of an array or a list as `array_text`, other values as they are."""
    try:
        return array_text(value) if isinstance(value, list | tuple | np.ndarray) else str(value)
    except (TypeError, ValueError):
        return str(value)


def document_lines(value: object, path: str = "") -> Iterator[str]:
    """Yield the leaves of a JSON document by their paths; many numbers as those of a drawing."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from document_lines(inner, f"{path}.{key}")
    elif isinstance(value, list) and all(isinstance(one, int | float) for one in value) and value:
        yield f"{path[1:]}: {array_text(value)}"
    elif isinstance(value, list):
        for number, inner in enumerate(value[:4]):
            yield from document_lines(inner, f"{path}[{number}]")
        yield f"{path[1:]}: {len(value)}"
    else:
        yield f"{path[1:]}: {value}"


def lines_of(place: Path, before: set[Path]) -> Iterator[str]:
    """Yield what new files hold. The live page has tests of its own; a CSV beside a Parquet file holds the same."""
    for file in sorted(set(place.rglob("*")) - before):
        yield f"== {file.relative_to(place)}"
        twin = file.suffix == ".csv" and file.with_suffix(".parquet").exists()
        if twin or file.name in ("explorer.html", "files.json", "animation.json"):
            continue
        if file.suffix in (".csv", ".parquet"):
            read = partial(pl.read_csv, comment_prefix="#") if file.suffix == ".csv" else pl.read_parquet
            yield from table_lines(read(file))
        elif file.suffix == ".json":
            yield from document_lines(json.loads(file.read_text("utf-8")))
        elif file.suffix == ".html":
            parser = Words()
            parser.feed(file.read_text("utf-8"))
            yield from parser.words


@pytest.mark.parametrize("name", CASES)
def test_a_command_answers_as_it_did(
    name: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    unequal_file: dict[str, Any],
    unequal_motions: tuple[sm.Record, ...],
    take_few: Callable[[pytest.MonkeyPatch], None],
    small_map: None,
) -> None:
    inputs(tmp_path, unequal_file, unequal_motions)
    before = set(tmp_path.rglob("*"))
    figures: list[str] = []
    save = Figure.savefig

    def saved(figure: Figure, *args: Any, **kwargs: Any) -> None:
        figures.extend(figure_lines(figure))
        save(figure, *args, **kwargs)

    monkeypatch.setattr(Figure, "savefig", saved)
    monkeypatch.chdir(tmp_path)
    take_few(monkeypatch)
    study = import_module("seismass.studies.study")
    monkeypatch.setattr(study, "StudyParameters", partial(study.StudyParameters, buildings=((2, 0.37), (3, 0.53))))
    code = cli.main(list(CASES[name]))
    printed = capsys.readouterr()
    assert code in (0, 1), printed.err
    written = [] if name.startswith("building_") else [*lines_of(tmp_path, before), *figures]
    lines = [f"code {code}", *printed.out.splitlines(), *printed.err.splitlines(), *written]
    text = steady("\n".join(lines).replace(str(tmp_path), "")) + "\n"
    compare(name, text)


def compare(name: str, text: str) -> None:
    """Hold a text against the one that is kept, or keep it."""
    kept, versions = KEPT / f"{name}.txt", KEPT / "versions"
    if os.environ.get("KEEP_ANSWERS"):
        KEPT.mkdir(exist_ok=True)
        versions.write_text(f"{VERSIONS}\n", encoding="utf-8")
        kept.write_text(text, encoding="utf-8")
    if versions.read_text("utf-8").strip() != VERSIONS:
        pytest.skip(f"kept with {versions.read_text('utf-8').strip()}; here are {VERSIONS}")
    assert text.splitlines() == kept.read_text("utf-8").splitlines()


def test_help_says_what_it_did(capsys: pytest.CaptureFixture[str]) -> None:
    for command in COMMANDS:
        with pytest.raises(SystemExit):
            cli.main([command, "--help"])
    compare("help", steady(capsys.readouterr().out))
