"""Lists of planted faults fit the tree, and faults that are drawn are those that the operators say."""

import ast
import re
import runpy
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def tools() -> dict[str, dict[str, Any]]:
    """Names of the programs, which import each other as programs do."""
    sys.path.append(str(ROOT / "tools"))
    try:
        names = ("planted_faults", "random_faults", "mutants_page")
        return {name: runpy.run_path(str(ROOT / "tools" / f"{name}.py")) for name in names}
    finally:
        sys.path.remove(str(ROOT / "tools"))


def test_faults_of_the_lists_can_be_planted(tools: dict[str, dict[str, Any]]) -> None:
    """Each text occurs once, and with the fault the file is another and still Python; the tests are there."""
    faults, wrong = tools["planted_faults"]["python_faults"]()
    rust, files, wrong_rust = tools["planted_faults"]["rust_faults"]()
    assert [*wrong, *wrong_rust] == []
    for some in (faults, rust):
        numbers = [fault.number for fault in some]
        assert sorted(set(numbers)) == sorted(numbers)
    for fault in faults:
        assert fault.text != (ROOT / fault.path).read_text(encoding="utf-8"), fault.number
        ast.parse(fault.text)
        assert fault.tests and all((ROOT / "tests" / f"{name}.py").is_file() for name in fault.tests), fault.number
    # The switch of each fault of the crates stands in its file, and no other does; 0 is the program without a fault.
    switches = {(path, int(n)) for path, text in files.items() for n in re.findall(r"\bmutant::on\((\d+)\)", text)}
    assert switches == {(fault.path, fault.number) for fault in rust}
    assert all(0 < fault.number < 10_000 for fault in rust)


PYTHON = """def f(a: int = 2, *b) -> "1 + 1":
    if a and g(b, a):
        a += f"{a + 1}é"
    return [min(x, b) * c <= 1.0, isinstance(a, b), "é" + a, h(a, a)]
"""


def test_operators_of_python_change_one_place(tools: dict[str, dict[str, Any]]) -> None:
    """By hand; types, f-strings, texts and equal arguments are left alone, and letters of two bytes move nothing."""
    found = sorted((what, text) for _, what, text in tools["random_faults"]["python_faults"](PYTHON))
    changes = {
        "`a and g(b, a)` becomes `a or g(b, a)`": ("a and g(b, a)", "(a or g(b, a))"),
        "`g(b, a)` becomes `g(a, b)`": ("g(b, a)", "(g(a, b))"),
        "`min(x, b) * c` becomes `min(x, b) / c`": ("min(x, b) * c", "(min(x, b) / c)"),
        "`min(x, b) * c <= 1.0` becomes `min(x, b) * c < 1.0`": (
            "min(x, b) * c <= 1.0",
            "(min(x, b) * c < 1.0)",
        ),
        "`min(x, b)` becomes `max(x, b)`": ("min(x, b)", "(max(x, b))"),
        "`1.0` becomes `0.0`": ("1.0", "(0.0)"),
    }
    assert [what.partition(" in ")[0] for what, _ in found] == sorted(changes)
    for what, text in found:
        assert text == PYTHON.replace(*changes[what.partition(" in ")[0]])


@pytest.mark.parametrize(
    ("line", "changed"),
    [
        ("    let a = b * c - d as f64;", {"sign": "    let a = b * c - crate::mutant::sign(1) * d as f64;"}),
        ("    a[i + 1]", {"off by one": "    a[i + usize::from(!crate::mutant::on(1))]"}),
        ("    0.5 * x", {"factor": "    (if crate::mutant::on(1) { 1.0 } else { 0.5 }) * x"}),
        (
            "    } else if a <= b {",
            {
                "comparison": "    } else if (if crate::mutant::on(1) { a < b } else { a <= b }) {",
                "condition": "    } else if (a <= b) != crate::mutant::on(1) {",
            },
        ),
        (
            "if a && !b {",
            {
                "and, or": "if (if crate::mutant::on(1) { a || !b } else { a && !b }) {",
                "condition": "if (a && !b) != crate::mutant::on(1) {",
            },
        ),
        ("    if let Some(a) = b && a < c {", {}),
        ("    // a + b", {}),
        ("#[cfg(test)] a + b", {}),
    ],
)
def test_operators_of_rust_have_a_switch(tools: dict[str, dict[str, Any]], line: str, changed: dict[str, str]) -> None:
    """By hand; with the switch off, a line has the value that it had."""
    found = {name: text.replace("MUT", "1") for name, _, _, text in tools["random_faults"]["rust_faults"](line)}
    assert found == changed


def test_a_drawn_fault_asks_the_tests_of_its_module(tools: dict[str, dict[str, Any]]) -> None:
    """Those that name it in code, and those with a word of its path in their names; else those that draw."""
    asked = tools["planted_faults"]["tests_of"]
    module = Path("python/seismass/studies/slip/clearance.py")
    tests = {
        "test_a": "from seismass.studies.slip import clearance, demand",
        "test_b": "sm.rocks(1)",
        "test_c": '"""A block rocks or slides."""',
        "test_d": "from seismass.studies.slip import (\n    rocks,\n)\n",
        "test_e": "response.plot()",
        "test_slip_f": "rocks_not",
    }
    rocks = "def rocks():\n    pass\n"
    assert asked(module, rocks, tests) == ("test_a", "test_b", "test_d", "test_slip_f")
    assert asked(module, "def _rocks():\n    pass\n", {**tests, "test_a": ""}) == ("test_slip_f",)
    many = {f"test_slip_{number}": "" for number in range(13)}
    assert asked(module, rocks, {**many, "test_a": "clearance.rocks"}) == ("test_a",)
    assert asked(Path("python/seismass/show/cards.py"), rocks, {"test_c": "rocks", "test_e": "plot()"}) == ("test_e",)


def test_page_counts_faults_that_are_faults(tools: dict[str, dict[str, Any]]) -> None:
    """Wilson's interval of 1 of 2 at 95 %: 0.5 ± z sqrt(2 + z²) / (2 (2 + z²)) with z = 1.96, 9 to 91 %."""
    fault, (listed, _), (drawn, _) = (tools["planted_faults"][name] for name in ("Fault", "LISTED", "DRAWN"))
    faults = [
        fault(listed, 1, "one", Path("python/seismass/studies/slip/a.py"), caught="chosen tests"),
        fault(listed, 2, "two", Path("python/seismass/studies/slip/b.py")),
        fault(listed, 3, "three", Path("python/seismass/studies/slip/b.py"), reason="both are 0"),
        fault(drawn, 1, "four", Path("python/seismass/cli.py"), caught="quick tier"),
        fault(drawn, 2, "five", Path("python/seismass/studies/risk/c.py")),
    ]
    page = tools["mutants_page"]["page"](faults, {listed: ("chosen tests",), drawn: ("chosen tests", "quick tier")})
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in page.splitlines() if line.startswith("|")]
    assert rows[2:] == [
        ["**Python, listed**", "2", "1", "50 %", "1", ""],
        ["studies", "2", "1", "50 %", "1", ""],
        ["**Python, drawn at random**", "2", "1", "50 % (9 to 91 %)", "0", "1"],
        ["cli", "1", "1", "100 %", "0", "1"],
        ["studies", "1", "0", "0 %", "0", "0"],
    ]
    unseen, none = page.partition("## What no test sees")[2].split("## What is no fault")
    assert "- 2. two\n" in unseen and "- five\n" in unseen and "one" not in unseen
    assert "- 3. three: both are 0\n" in none
