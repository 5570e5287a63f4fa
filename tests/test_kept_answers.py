"""What whole commands print, write and draw is as it was: a change is seen, and looked at, before it is kept.

Other tests say what is right; these see that something changed. Each case is a command on inputs in which no two
quantities are alike. What it prints, the numbers and words of its files, and what each of its figures holds are
compared with tests/kept_answers. `KEEP_ANSWERS=1 pytest tests/test_kept_answers.py` writes them anew: read the diff
before it is committed, line by line.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from matplotlib.figure import Figure

import seismass as sm
from answer_texts import compare, figure_lines, lines_of, steady
from seismass import cli
from seismass.commands.parser import COMMANDS

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
    explorer = import_module("seismass.show.explore.page")
    if not Path(explorer.__file__).with_name(explorer.NAME).is_file():  # make test does not compile it
        (stand_in := tmp_path / explorer.NAME).write_bytes(b"")
        monkeypatch.setattr(explorer, "NAME", str(stand_in))
        before.add(stand_in)
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


def test_help_says_what_it_did(capsys: pytest.CaptureFixture[str]) -> None:
    for command in COMMANDS:
        with pytest.raises(SystemExit):
            cli.main([command, "--help"])
    compare("help", steady(capsys.readouterr().out))
