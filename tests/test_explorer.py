"""The kernel of the live page in Node: bits of the native baseline, numbers of the package; the page, its command."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.base.statistics import bootstrap_counts
from seismass.cli import main
from seismass.design import response_spectrum_analysis
from seismass.effective_mass.rule import by_hand
from seismass.media.page import page_html
from seismass.motions.spectra import mean_spectrum
from seismass.show.explore import explorer_html
from seismass.show.explore import page as compiled
from seismass.show.explore.page import BINS, CASES, RESAMPLES

ROOT = Path(__file__).parents[1]
HERE = Path(__file__).parent / "explorer"
TEMPLATES = ROOT / "python" / "seismass" / "show" / "explore" / "templates"
SUITE = sm.builtin_suite("seven")
FACTORS = sm.scaling.scale_asce7_10(SUITE, sm.TargetSpectrum.asce7(), between=False).factors
MOTIONS = [record.scaled(factor) for record, factor in zip(SUITE, FACTORS, strict=True)]

Asked = dict[str, list[Any]]


@pytest.fixture(scope="module")
def kernel() -> Path:
    """The compiled kernel; where there is none, what needs it is skipped."""
    path = Path(compiled.__file__).parent / compiled.NAME
    if not path.is_file():
        pytest.skip("the kernel is not compiled to WebAssembly (make explorer): the live page is not tested")
    return path


@pytest.fixture(scope="module")
def in_node(kernel: Path) -> Any:
    """Return what solves in Node what is asked for."""
    node = shutil.which("node") or shutil.which("nodejs")
    if node is None:
        pytest.skip("no Node on the path (Debian, Ubuntu: apt-get install nodejs): its kernel is not run")

    def solve(**asked: Any) -> dict[str, Any]:
        command = [node, str(HERE / "solve.js"), str(kernel), str(TEMPLATES)]
        done = subprocess.run(command, input=json.dumps(asked), capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        answers: dict[str, Any] = json.loads(done.stdout)
        return answers

    return solve


def in_baseline(asked: dict[str, Any]) -> Any:
    """The runs by the native kernel with the instructions that every machine has."""
    command = [sys.executable, str(HERE / "native.py")]
    environment = os.environ | {"SEISMASS_INSTRUCTIONS": "baseline"}
    done = subprocess.run(
        command, input=json.dumps(asked), env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def motion(record: Any) -> dict[str, Any]:
    return {"dt": record.dt, "samples": np.asarray(record.acceleration).tolist()}


def case(storeys: int, period: float, strength: list[float], ratios: list[float], mu: float) -> dict[str, Any]:
    return {
        "storeys": storeys,
        "period": period,
        "damping": 0.05,
        "pDelta": 0,
        **{name: [1.0] * storeys for name in ("floorMass", "stiffness", "height")},
        "overstrength": [2.0] * storeys,
        "secondSlope": [0.05] * storeys,
        "thirdSlope": [0.0] * storeys,
        "strength": [str(value).replace("inf", "Infinity") for value in strength],
        "massRatio": ratios,
        "muS": [mu] * storeys,
        "muK": [mu] * storeys,
    }


def random_case(draw: np.random.Generator) -> dict[str, Any]:
    storeys = int(draw.integers(1, 5))
    elastic = draw.random() < 0.2
    strength = [float("inf")] * storeys if elastic else draw.uniform(0.03, 0.6, storeys).tolist()
    chosen = case(storeys, draw.uniform(0.1, 1.6), strength, [1.0] * storeys, 0.2)
    mu_s = draw.uniform(0.0, 0.6, storeys)
    return chosen | {
        "damping": draw.choice([0.0, 0.02, 0.05]),
        "overstrength": draw.uniform(1.0, 3.0, storeys).tolist(),
        "secondSlope": draw.uniform(0.0, 0.2, storeys).tolist(),
        "massRatio": (draw.uniform(0.1, 2.0, storeys) * (draw.random(storeys) < 0.7)).tolist(),
        "muS": mu_s.tolist(),
        "muK": (mu_s * draw.choice([0.5, 0.75, 1.0], storeys)).tolist(),
    }


def test_kernel_names_no_path_of_the_machine(kernel: Path) -> None:
    code = kernel.read_bytes()
    assert b"crates/seismass/src/" in code
    for folder in (ROOT, Path.home(), Path("/usr/lib")):
        assert bytes(folder) + b"/" not in code, folder


def test_a_hundred_runs_have_the_bits_of_the_native_baseline(in_node: Any) -> None:
    """Peaks, their times, residuals, events and histories: every bit of 100 cases of all kinds."""
    draw = np.random.default_rng(34)
    runs = []
    for number in range(100):
        chosen = random_case(draw)
        loaded = any(chosen["massRatio"])
        share = float(draw.choice([0.0, 0.25, 0.6, 1.0])) if loaded and number % 4 == 3 else None
        runs.append({"scene": chosen, "share": share, "every": int(draw.integers(1, 6)), "motion": number % 3})
    asked = {"motions": [motion(one) for one in (MOTIONS[0], MOTIONS[3], MOTIONS[6].scaled(2.0))], "runs": runs}
    found = in_node(**asked)["runs"]
    expected = in_baseline(asked)
    assert found == expected
    assert sum(one["events"] for one in expected) > 5000  # there was something to agree about


def test_designs_are_those_of_the_study(in_node: Any) -> None:
    designs, expected = [], []
    for storeys, period, counted in ((1, 0.3, 0.25), (2, 0.38, 0.0), (3, 0.47, 0.25), (4, 0.57, 0.6), (4, 1.4, 1.0)):
        ratios = np.append(np.full(storeys - 1, 1.0), 0.3)
        chosen = case(storeys, period, [1.0] * storeys, ratios.tolist(), 0.2)
        designs.append({"scene": chosen, "counted": counted, "suite": list(range(7))})
        bare = sm.Building.uniform(storeys, period, mass=1.0)
        shear = response_spectrum_analysis(
            bare.mass + counted * ratios, bare.stiffness, lambda periods: mean_spectrum(SUITE, FACTORS, periods)
        ).storey_shear
        expected.append((shear / bare.weight).tolist())
    found = in_node(motions=[motion(one) for one in MOTIONS], designs=designs)["designs"]
    for one, other in zip(found, expected, strict=True):
        # Spectra agree to rounding times the sharpness of an oscillator, some 1e-13; eigenvalues to 1e-15.
        assert one == pytest.approx(other, rel=1e-11)


# Strengths of the design of the study with 25 % of the goods, and values that test_effective_mass.py pins for them.
REFERENCE = [
    ((3, 0.47, 1.0, 4.0, 0.2), "root", 0.664895716),
    ((3, 0.47, 1.0, 2.0, 0.3), "root", 0.48928519),
    ((3, 0.47, 1.0, 4.0, 0.4), "one", 1.0),
    ((4, 0.57, 1.5, 6.0, 0.15), "root", 0.86275896),
    ((3, 0.47, 1.0, 4.0, 50.0), "stuck", 1.0),
    ((3, 0.47, 1.0, 4.0, 0.0), "zero", 0.0),
]


@pytest.mark.parametrize(("arguments", "kind", "value"), REFERENCE)
def test_effective_fraction_is_that_of_the_package(
    in_node: Any, arguments: tuple[int, float, float, float, float], kind: str, value: float
) -> None:
    storeys, period, alpha, reduction, mu = arguments
    goods = np.append(np.full(storeys - 1, alpha), 0.0)
    bare = sm.Building.uniform(storeys, period, mass=1.0)
    shear = response_spectrum_analysis(
        bare.mass + 0.25 * goods, bare.stiffness, lambda periods: mean_spectrum(SUITE, FACTORS, periods)
    ).storey_shear
    strength = (shear / reduction / bare.weight).tolist()
    counts = bootstrap_counts(np.arange(7), RESAMPLES, seed=0)
    found = in_node(
        motions=[motion(one) for one in MOTIONS],
        effective=[
            {
                "scene": case(storeys, period, strength, goods.tolist(), mu),
                "suite": list(range(7)),
                "resamples": counts.ravel().tolist(),
            }
        ],
    )["effective"][0]
    scene = sm.Scene(bare.replace(yield_shear_over_weight=strength), sm.blocks_on_floors(goods, mu))
    expected = sm.effective_mass(scene, MOTIONS)
    assert expected.kind == kind
    assert expected.value == pytest.approx(value, abs=1e-7)
    assert found["kind"] == kind
    assert found["value"] == pytest.approx(expected.value, abs=1e-9)
    assert found["roots"] == pytest.approx(expected.roots, abs=1e-9)
    # Runs agree to rounding, which slopes of the curve may enlarge a thousand times.
    assert (found["low"], found["high"]) == pytest.approx(expected.interval, abs=1e-9)
    for name, other in (
        ("realMean", expected.real),
        ("modelMean", expected.model),
        ("coefficient", expected.base_shear_coefficient),
        ("eta", expected.eta),
        ("realByStorey", expected.storeys["real"].to_list()),
        ("modelByStorey", expected.storeys["model"].to_list()),
        ("bareByStorey", expected.storeys["model_at_0"].to_list()),
        ("fullByStorey", expected.storeys["model_at_1"].to_list()),
        ("realDrift", expected.records["real_drift"].to_list()),
    ):
        assert found[name] == pytest.approx(other, rel=1e-9), name
    curve = expected.curve.filter(expected.curve["storey"] == 0)
    for name, column in (("model", "model_drift"), ("ratioLow", "ratio_low"), ("ratioHigh", "ratio_high")):
        assert found[name] == pytest.approx(curve[column].to_list(), rel=1e-9), name
    for name, column in (("firstRoot", "first_root"), ("lastRoot", "last_root")):
        own = ["NaN" if root is None else pytest.approx(root, abs=1e-9) for root in expected.records[column]]
        assert found[name] == own, name


def test_what_the_page_cannot_solve_is_refused_in_words(in_node: Any) -> None:
    wrong = [
        case(5, 0.5, [0.2] * 5, [1.0] * 5, 0.2),
        case(2, -0.5, [0.2] * 2, [1.0] * 2, 0.2),
        case(2, 0.5, [0.2] * 2, [1.0] * 2, 0.2) | {"muK": [0.3, 0.2]},
    ]
    runs = [{"scene": scene, "share": None, "every": 1, "motion": 0} for scene in wrong]
    found = in_node(motions=[motion(MOTIONS[0])], runs=runs)["runs"]
    assert [one["error"] for one in found] == [
        "storeys of building must be at most 4; got 5",
        "period of building must be a positive number; got -0.5",
        "mu_k of block 1 must be at most mu_s = 0.2; got 0.3",
    ]


def test_records_are_read_to_the_bit(in_node: Any, tmp_path: Path) -> None:
    """The built-in files, and text as `read_record` takes it: the same samples, step and unit."""
    times = [f"{0.005 * i:.3f} {np.sin(0.1 * i) * 9.0e-3:.6E}" for i in range(400)]
    texts = [
        *(record.source.read_text() for record in SUITE if record.source is not None),
        "# acceleration in g\n" + "\n".join(times),
        "Units: cm/s2, dt = 0.02\n" + "\n".join(f"{np.cos(0.1 * i):.5f}" for i in range(300)),
        "PEER\nEvent, station\nACCELERATION TIME SERIES IN UNITS OF G\n 4   0.0050 NPTS, DT\n"
        " -.24E-03-.23E-03 .1E-02\n 0.5",
    ]
    found = in_node(records=[{"text": text} for text in texts])["records"]
    for number, (text, one) in enumerate(zip(texts, found, strict=True)):
        file = tmp_path / f"record-{number}.txt"
        file.write_text(text)
        record = sm.read_record(file)
        samples = np.ascontiguousarray(record.acceleration, dtype="<f8")
        assert one == {
            "dt": record.dt,
            "unit": record.file_unit,
            "samples": hashlib.sha256(samples.tobytes()).hexdigest(),
        }, number


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0.1\n0.2\n0.3\n", "unit of file must be given"),
        ("in (g)\n0.1\n0.2\n0.3\n", "step of file must be given"),
        ("in (g)\n0.0 0.1\n0.1 0.2\n0.15 0.3\n0.2 0.1\n", "times of file must be uniform"),
        ("in (g), dt = 0.01\n0.1\n0.2x\n0.3\n", 'line 3 of file must be numbers; got "0.2x"'),
        ("in (g), dt = 0.01\n0.0\n0.0\n0.0\n", "acceleration of file must be other than zero somewhere"),
        ("a\nb\nVELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 3, DT= .01 SEC\n1 2 3\n", "quantity of file must be"),
        ("a\nb\nACCELERATION IN UNITS OF G\nNPTS= 4, DT= .01 SEC\n1 2 3\n", "points of file must be 4"),
        ("hello\n", "content of file must be lines of one or two numbers"),
    ],
)
def test_records_that_cannot_be_read_are_refused(in_node: Any, tmp_path: Path, text: str, message: str) -> None:
    (found,) = in_node(records=[{"text": text}])["records"]
    assert message in found["error"]
    file = tmp_path / "file"
    file.write_text(text)
    if "other than zero" not in message:  # which the package leaves to the motion
        with pytest.raises(sm.errors.RecordFormatError):
            sm.read_record(file)


def test_addresses_are_read_as_they_are_written(in_node: Any) -> None:
    address = (
        "v=1&m=synthetic-3&d=full&by=hand&n=2&T=0.5&z=0.02&O=1.5,2&r2=0.1&h=4&R=3&V=0.3,0.1&a=1.5,0&s=0.4,0.2&k=0.3,0.2"
        "&x=1.25&c=0.6&r3=0.01&M=1.1,0.9&K=1,0.8&P=1&o=0.8&y=2&g=1.1,0.7&F=0.498,0.14,0.77,7&W=kinds"
    )
    wrong = "#n=9&T=abc&a=1,2,3,4,5&k=0.9&s=0.3&by=magic&z=&m=%&g=1,0&F=2,x&P=0.5"
    found = in_node(addresses=[address, "", wrong])["addresses"]
    assert found[0]["again"] == address
    assert found[0]["remarks"] == found[1]["remarks"] == []
    assert found[0]["state"]["muK"][:2] == [0.3, 0.2]
    assert found[2]["remarks"] == [
        "storeys in the address must be from 1 to 4; got 9",
        "first period in the address must be from 0.05 to 5; got abc",
        "damping ratio in the address must be from 0 to 0.5; got ",
        "goods over floor mass in the address must be from 0 to 10; got 1,2,3,4,5",
        "P-Delta in the address must be from 0 to 1; got 0.5",
        "the record in the address cannot be read: %",
        "factors of the motions in the address must be above 0 and at most 1000; got 1,0",
        "the answer of a building file in the address must be three shares and a number of motions; got 2,x",
    ]
    # What is said wrong keeps its default; kinetic friction is at most static friction.
    assert found[2]["state"]["storeys"] == 3
    assert found[2]["state"]["muK"] == [0.3] * 4  # one number of friction stands for all floors
    assert found[2]["state"]["by"] == "design"


def count_of(sentence: str) -> int:
    """Under how many of the three motions a sentence has goods slide."""
    found = re.match(r"Goods slide under (?:all (\d) motions|(\d) of the 3 motions), and ", sentence)
    return 0 if found is None else int(found[1] or found[2])


def percent_of(sentence: str, pattern: str) -> int:
    """How many per cent more (positive) or less a sentence says, behind a text."""
    found = re.search(pattern + r" (?:(\d+) % (more|less) than|as much as)", sentence)
    assert found is not None, sentence
    return 0 if found[1] is None else int(found[1]) * (1 if found[2] == "more" else -1)


def test_sentences_say_what_the_result_has(in_node: Any) -> None:
    """Every kind of sentence for 300 random cases, against the numbers of their results."""
    draw = np.random.default_rng(7)
    short = [record.with_duration(6.0).scaled(2.0) for record in MOTIONS[:3]]
    asked: list[dict[str, Any]] = []
    while len(asked) < 300:
        chosen = random_case(draw)
        counted = float(draw.choice([0.0, 0.25, 0.3125, 0.6, 1.0]))
        told = {"storeys": chosen["storeys"], "counted": counted, "intensity": 1.0, "muS": chosen["muS"]}
        if any(chosen["massRatio"]):
            asked.append({"scene": chosen, "suite": [0, 1, 2], "resamples": [1, 1, 1], "told": told})
    found = in_node(motions=[motion(one) for one in short], effective=asked)["effective"]
    kinds = set()
    for one, state in zip(found, (each["told"] for each in asked), strict=True):
        words, share = one["told"], one["value"]
        slid = int(sum(one["slides"]))
        kinds.add((min(slid, 1), one["kind"]))
        # What slides, and how much acts as mass.
        assert ("No goods slide under any of the 3 motions" in words["slides"]) == (slid == 0)
        assert count_of(words["slides"]) == slid
        if slid:
            assert int(re.search(r"and (\d+) % of them act", words["slides"])[1]) == pytest.approx(
                100 * share, abs=0.501
            )
        # The model of the code, read between the shares that were solved.
        model = np.interp(state["counted"], one["shares"], one["model"])
        apart = percent_of(words["code"], "its model drifts")
        assert apart == pytest.approx(100 * (model / one["realMean"] - 1), abs=0.502)
        assert f"the code counts {100 * state['counted']:.0f} %" in words["code"] or state["counted"] == 0.3125
        # The highest storey.
        real, both = one["realByStorey"][-1], max(one["modelByStorey"][-1], one["bareByStorey"][-1])
        ratios = re.search(r"Storey (\d), the highest, drifts ([\d.]+) times .*goods, ([\d.]+) times", words["roof"])
        assert int(ratios[1]) == state["storeys"]
        assert float(ratios[2]) == pytest.approx(real / one["modelByStorey"][-1], abs=0.00502)
        assert float(ratios[3]) == pytest.approx(real / both, abs=0.00502)
    assert {(0, "stuck"), (1, "root"), (1, "one")} <= kinds  # what sentences may confuse is among them


def test_the_remark_on_a_building_file_compares_what_is_shown(in_node: Any) -> None:
    file = {"share": 0.498, "low": 0.141, "high": 0.768, "motions": 7, "differs": ["kinds"]}
    there = "The page of the building file says 50 % (14 % to 77 %, other suites too) under 7 motions."
    words = {"kinds": "kinds are one"}
    cases = [
        (0.503, "Here it is the same"),
        (0.47, "Here it is 47 %, 3 points less"),
        (0.51, "Here it is 51 %, 1 point more"),
    ]
    asked = [[file, {"value": value}, True, words] for value, _ in cases]
    found = in_node(files=[*asked, [file, None, True, words], [file, {"value": 0.1}, False, words]])["files"]
    assert found[:3] == [f"{there} {said}. What is different here: kinds are one." for _, said in cases]
    assert found[3:] == [there, f"{there} The case was changed since."]


def test_chart_of_other_buildings_is_that_of_the_documentation() -> None:
    text = (ROOT / "docs" / "effective_mass.md").read_text(encoding="utf-8")
    block = re.search(r"<!-- builtin -->\n(.*?)<!-- end of builtin -->", text, re.DOTALL)
    assert block is not None
    assert f"{CASES} cases" in block[1]
    rows = re.findall(
        r"^([\d.]+) +(?:to ([\d.]+)|and more) +\d+ +([\d.]+) +([\d.]+) +([\d.]+)$", block[1], re.MULTILINE
    )
    assert [(*map(float, row[:1]), float(row[1]) if row[1] else None, *map(float, row[2:])) for row in rows] == [
        dataclasses.astuple(one) for one in BINS
    ]


def test_page_is_one_file_and_its_policy_allows_no_request(kernel: Path) -> None:
    html = explorer_html()
    assert html == explorer_html(kernel)  # the same bytes again
    assert len(html.encode()) < 1_200_000
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', html)
    assert policy is not None
    assert policy[1].startswith("default-src 'none'; ")
    assert "'wasm-unsafe-eval'; worker-src blob:; img-src data:" in policy[1]
    assert not re.findall(r'(?:src|href)="(?!#|data:)', html)
    assert "wasm" not in page_html("Another", [])


def test_command_writes_the_page(kernel: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "page.html"
    assert main(["explore", "--out", str(out)]) == 0
    assert out.read_text(encoding="utf-8") == explorer_html(kernel)
    assert capsys.readouterr().out.startswith(f"{out}: ")


def test_command_says_how_to_get_the_kernel(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(compiled, "NAME", "missing.wasm")
    out = tmp_path / "page.html"
    assert main(["explore", "--out", str(out)]) == 2
    assert "make explorer" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.skipif(shutil.which("node") is None, reason="no Node on the path")
@pytest.mark.parametrize(
    ("strength", "shape"),
    [
        ([0.3, 0.2, 0.1], {}),
        ([np.inf] * 3, {}),
        ([0.3, 0.2, 0.1], {"overstrength": 1.2}),
        ([0.3, 0.2, 0.1], {"second_slope": 0.2}),
    ],
)
def test_the_rule_of_the_page_is_that_of_the_package(strength: list[float], shape: dict[str, float]) -> None:
    """Its constants are given to the page; without the kernel, S_a of the target stands for that of the suite."""
    target = sm.TargetSpectrum.asce7()
    bare = sm.Building.uniform(3, 0.5, yield_shear_over_weight=strength, **shape)
    blocks = [sm.Block(floor, mass_ratio=ratio, mu_s=0.25, mu_k=0.2) for floor, ratio in ((1, 1.0), (2, 0.5))]
    expected = by_hand(sm.Scene(bare, blocks), None, target)
    scene = {"storeys": 3, "massRatio": [1.0, 0.5, 0.0], "muS": [0.25] * 3, "muK": [0.2] * 3}
    scene |= {"overstrength": bare.overstrength.tolist(), "secondSlope": bare.second_slope.tolist()}
    scene["floorMass"] = [1.0] * 3
    given = [scene, expected.spectral_acceleration_g, compiled._page_data()["rule"]]
    views = (TEMPLATES / "views.js").read_text(encoding="utf-8")
    rule = views[views.index("function ruleBy(") : views.index("function fractionWords(")]
    first = "Infinity" if np.isinf(strength[0]) else f"{strength[0]}"
    code = f"const fixed = (value, digits) => value.toFixed(digits);\n{rule}\nconst given = {json.dumps(given)};\n"
    code += f"given[0].strength = [{first}];\nconst found = ruleBy(...given);\n"
    code += "console.log(JSON.stringify([found.coefficient, found.estimate, found.words]));"
    done = subprocess.run(["node", "-e", code], capture_output=True, text=True, check=True)
    coefficient, estimate, words = json.loads(done.stdout)
    assert coefficient == pytest.approx(expected.coefficient, rel=1e-12)
    assert estimate == pytest.approx(expected.estimate, rel=1e-12)
    formula = expected.formula.replace(" - ", " \N{MINUS SIGN} ")
    assert words.startswith(f"{formula} = {expected.estimate:.3f}; C1")
