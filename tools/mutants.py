"""Plants small faults in a copy of the tree, one at a time, and asks the tests which of them they see.

Usage: python tools/mutants.py [--python] [--rust] [--generated N] [--generated-rust N] [--full] [--write PAGE]
Faults are those of tests/mutants, and N drawn at random by the operators of tools/random_faults.py. Those of the Rust
crates are compiled at once, each behind a switch. It is an error where a test fails without a fault, or the text of a
fault does not occur once in its file, and none where no test sees a fault.
"""

from __future__ import annotations

import argparse
import json
import os
import queue
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Final
from xml.etree import ElementTree

import mutants_page
import random_faults
from planted_faults import (
    DRAWN,
    KERNEL,
    LISTED,
    PACKAGE,
    ROOT,
    Fault,
    generated_python,
    listed,
    python_faults,
    rust_faults,
)

EXTENSION: Final = "seismass-python"
WORKERS: Final = 2
TIERS: Final = ("chosen tests", "quick tier", "full tier")
SELECTED: Final = {
    "chosen tests": ["-m", "not slow"],
    "quick tier": ["-m", "not slow", "--ignore=tests/browser"],
    "full tier": [],
}
"""What pytest is asked in each tier, the first with files of its own."""
SCENES: Final = {"quick tier": {"SEISMASS_STRESS_SCENES": "300", "SEISMASS_JUDGE_SCENES": "20"}, "full tier": {}}
"""Random scenes of the Rust tests, as `make test` has them; the full tier has the tests' own number."""
RELEASE: Final = ("--release", "--workspace", "--exclude", "seismass-bench")
BUILT: Final = (
    ("test", "--no-run", *RELEASE, "--test", "*"),
    ("test", "--no-run", *RELEASE, "--exclude", "seismass", "--lib", "--bins"),
    ("test", "--no-run", "-p", "seismass", "--lib"),
)
"""The Rust tests of `make test`, which share their kernel with the extension module."""
OF_SOURCES: Final = ("test_mutants", "test_rust_example")
"""Tests that read the planted text itself, or compile Rust, and say nothing of a fault in the Python package."""
SWITCH: Final = """//! The switch of planted faults.
static FAULT: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
/// Whether fault `k` is on.
#[inline]
pub fn on(k: u32) -> bool {
    *FAULT.get_or_init(|| std::env::var("MUT").ok().and_then(|k| k.parse().ok()).unwrap_or(0)) == k
}
/// -1 with fault `k`, and 1 without.
#[inline]
pub fn sign(k: u32) -> f64 {
    if on(k) { -1.0 } else { 1.0 }
}
"""


def run(command: list[str], cwd: Path, seconds: float, **variables: str) -> tuple[int, str]:
    """Exit code and output of a program, which ends after so much CPU time, or twenty times that by the clock."""
    # Of all programs of the machine it is the first to end where memory does.
    limited = 'echo 1000 2>/dev/null >/proc/self/oom_score_adj; ulimit -t "$0" && exec "$@"'
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as output:
        process = subprocess.Popen(
            ["sh", "-c", limited, str(int(seconds)), *command],
            cwd=cwd,
            stdout=output,
            stderr=subprocess.STDOUT,
            env={**os.environ, **variables},
            start_new_session=True,
        )
        try:
            with suppress(subprocess.TimeoutExpired):
                process.wait(20 * seconds)
        finally:
            # Its number is its group's for as long as nobody has waited for it.
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
        output.seek(0)
        return process.returncode, output.read()


def copied(to: Path) -> Path:
    """A copy of the tree: what git knows or would, and what a build lays beside the sources."""
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
    built = (path for kind in ("_kernel*", "data/**/*", "show/explore/*.wasm") for path in (ROOT / PACKAGE).glob(kind))
    for path in {ROOT / name for name in names if name} | set(built):
        if path.is_file():
            target = to / path.relative_to(ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, target)
    return to


def pytest(tree: Path, options: list[str], seconds: float, **variables: str) -> tuple[int, str]:
    """Exit code and output of the tests of a tree."""
    for kept in tree.glob(".hypothesis"):
        shutil.rmtree(kept)
    left = [f"--deselect=tests/{name}.py" for name in OF_SOURCES]
    own = ["-q", "-p", "no:cacheprovider", "--hypothesis-seed=0", *left]
    # Files of the same size that change within a second must not be mistaken for those that were compiled.
    where = {"PYTHONPATH": str(tree / "python"), "PYTHONDONTWRITEBYTECODE": "1", "MPLBACKEND": "Agg"}
    return run([sys.executable, "-m", "pytest", *own, *options], tree, seconds, **where, **variables)


def pytest_alone(tree: Path, tier: str, files: set[str]) -> dict[str, float]:
    """Seconds of each test file of a tier without a fault; a test that fails ends the program."""
    chosen = [f"tests/{name}.py" for name in sorted(files)] if tier == TIERS[0] else []
    options = [f"--junitxml={tree}/seconds.xml", f"--numprocesses={WORKERS}", "--dist=loadfile"]
    code, output = pytest(tree, [*options, *SELECTED[tier], *chosen], 7200, MUT="0")
    if code not in (0, 5):
        print(output[-5000:], file=sys.stderr)
        sys.exit(f"the {tier} must pass without a fault; got exit code {code}")
    seconds: dict[str, float] = defaultdict(float)
    for case in ElementTree.parse(tree / "seconds.xml").iter("testcase"):
        seconds[case.get("classname", "").removeprefix("tests.").partition(".")[0]] += float(case.get("time", 0.0))
    return seconds


def ask_pytest(faults: list[Fault], tier: str, trees: list[Path]) -> None:
    """Ask a tier about each fault, in as many trees at a time as there are."""
    faults = [fault for fault in faults if not fault.caught and not fault.reason and (tier != TIERS[0] or fault.tests)]
    if not faults:
        return
    seconds = pytest_alone(trees[0], tier, {test for fault in faults for test in fault.tests})
    free: queue.Queue[Path] = queue.Queue()
    for tree in trees:
        free.put(tree)

    def ask(fault: Fault) -> None:
        tree = free.get()
        whole = (tree / fault.path).read_text(encoding="utf-8")
        if fault.text:
            (tree / fault.path).write_text(fault.text, encoding="utf-8")
        files = sorted(fault.tests, key=lambda name: seconds[name]) if tier == TIERS[0] else []
        most = 60 + 5 * sum(seconds[name] for name in files or seconds)
        options = ["-x", *SELECTED[tier], *(f"tests/{name}.py" for name in files)]
        code, output = pytest(tree, options, most, MUT=str(fault.number))
        (tree / fault.path).write_text(whole, encoding="utf-8")
        free.put(tree)
        # 5: none was selected.
        if code not in (0, 5):
            fault.caught = tier
            fault.killer = next(iter(re.findall(r"^(?:FAILED|ERROR) (\S+)", output, re.M)), f"ended with {code}")
        told(fault, tier)

    with ThreadPoolExecutor(len(trees)) as pool:
        list(pool.map(ask, faults))


def told(fault: Fault, tier: str) -> None:
    """Say what became of a fault."""
    seen = f"{tier}, {fault.killer}" if fault.caught else f"not seen by the {tier}"
    print(f"{fault.group} {fault.number}: {seen}: {fault.what}", flush=True)


def cargo(tree: Path, target: Path, *command: str) -> tuple[int, list[dict]]:
    """Exit code and messages of cargo."""
    where = {"CARGO_TARGET_DIR": str(target), "PYO3_BUILD_EXTENSION_MODULE": "1", "PYO3_PYTHON": sys.executable}
    code, output = run(["cargo", *command, "--locked", "--message-format=json"], tree, 7200, **where)
    return code, [json.loads(line) for line in output.splitlines() if line.startswith("{")]


def places(span: dict) -> set[tuple[str, int]]:
    """Files and lines of a place in the compiler's message, and of the macros that it is in."""
    outer = places(span["expansion"]["span"]) if span["expansion"] else set()
    return {(span["file_name"], span["line_start"])} | outer


def planted(tree: Path, target: Path, files: dict[Path, str], count: int, seed: int) -> tuple[list[Fault], list[dict]]:
    """Plant all faults with so many drawn ones that compile, build the tests, and give the drawn and the messages."""
    lib = KERNEL / "lib.rs"
    text = files.get(lib, (tree / lib).read_text(encoding="utf-8"))
    files = {**files, lib: text.replace("\nmod ", "\npub mod mutant;\nmod ", 1)}
    sites, sources = defaultdict(list), {}
    for path in sorted((tree / KERNEL).rglob("*.rs")):
        own = path.relative_to(tree)
        sources[own] = files.get(own, path.read_text(encoding="utf-8")).split("\n")
        for operator, what, i, line in random_faults.rust_faults("\n".join(sources[own])):
            sites[operator].append((own, what, i, line))
    # Twice as many are tried, as some do not compile; a line has one.
    tried = {}
    for own, what, i, line in random_faults.drawn(sites, 2 * count, seed):
        number = 10_000 + len(tried)
        tried.setdefault((str(own), i + 1), (own, what, i, line.replace("MUT", str(number)), number))
    (tree / KERNEL / "mutant.rs").write_text(SWITCH, encoding="utf-8")
    while True:
        texts = {own: list(lines) for own, lines in sources.items()}
        for own, _, i, line, _ in tried.values():
            texts[own][i] = line
        for own, text in {**files, **{own: "\n".join(lines) for own, lines in texts.items()}}.items():
            if (tree / own).read_text(encoding="utf-8") != text:
                (tree / own).write_text(text, encoding="utf-8")
        code, messages = 0, []
        for command in BUILT:
            if code == 0:
                code, said = cargo(tree, target, *command)
                messages += said
        if code == 0:
            break
        found = [m["message"] for m in messages if m.get("message", {}).get("level") == "error"]
        wrong = {place for error in found for span in error["spans"] for place in places(span)} & tried.keys()
        if not wrong:
            sys.exit("the planted tree must compile; got\n" + "\n".join(error["rendered"] for error in found))
        print(f"{len(wrong)} of {len(tried)} drawn faults do not compile and are left out", flush=True)
        tried = {place: fault for place, fault in tried.items() if place not in wrong}
    reasons = listed("rust", "REASONS")
    drawn = []
    for own, what, _, _, number in list(tried.values())[:count]:
        what = f"{own.relative_to(KERNEL)}: {what}"
        drawn.append(Fault(DRAWN[1], number, what, own, reason=reasons.get(what, "")))
    return drawn, messages


def ask_binaries(faults: list[Fault], tier: str, binaries: list[tuple[str, str, Path]], tree: Path) -> None:
    """Ask the test programs about each fault, those that end soon first; all must pass without a fault."""
    faults = [fault for fault in faults if not fault.caught and not fault.reason and EXTENSION not in fault.path.parts]
    # Random cases are the same in every run, and those that failed with one fault are not kept for the next.
    own = {"PROPTEST_RNG_SEED": "0", "PROPTEST_MAX_SHRINK_ITERS": "0", **SCENES[tier]}
    kept = [path.relative_to(ROOT) for path in ROOT.glob("crates/*/tests/*.proptest-regressions")]
    timed = []
    for name, program, folder in binaries if faults else []:
        begin = time.perf_counter()
        code, output = run([program, "-q"], folder, 7200, MUT="0", **own)
        if code != 0:
            sys.exit(f"{name} must pass without a fault; got exit code {code}\n{output[-5000:]}")
        timed.append((time.perf_counter() - begin, name, program, folder))

    def ask(fault: Fault) -> None:
        for seconds, name, program, folder in sorted(timed):
            code, output = run([program, "-q"], folder, 60 + 10 * seconds, MUT=str(fault.number), **own)
            for path in kept:
                shutil.copy2(ROOT / path, tree / path)
            if code != 0:
                failed = next(iter(re.findall(r"^    ([\w:]+)$", output, re.M)), f"ended with {code}")
                fault.caught, fault.killer = tier, f"{name}: {failed}"
                break
        told(fault, tier)

    with ThreadPoolExecutor(WORKERS) as pool:
        list(pool.map(ask, faults))


def ask_rust(faults: list[Fault], files: dict[Path, str], args: argparse.Namespace, folder: Path) -> list[Fault]:
    """Build the planted tree once and ask its tests about every fault, the kernel's first and then those of Python."""
    tree = copied(folder / "rust")
    target = Path(os.environ.get("CARGO_TARGET_DIR", folder / "target"))
    drawn, messages = planted(tree, target, files, args.generated_rust, args.seed)
    faults = [*faults, *drawn]
    programs = [m for m in messages if m["reason"] == "compiler-artifact" and m["executable"] and m["profile"]["test"]]
    binaries = []
    for message in programs:
        crate, name = Path(message["manifest_path"]).parent, message["target"]["name"]
        # It reads the sources, which are planted, and not what they do.
        if name != "layers":
            binaries.append((f"{crate.name} {name}", message["executable"], crate))
    for tier in args.tiers[1:]:
        ask_binaries(faults, tier, binaries, tree)
        # In the full tier Python's tests are asked about the kernel too.
        left = [fault for fault in faults if not fault.caught and not fault.reason]
        left = [fault for fault in left if tier == TIERS[2] or EXTENSION in fault.path.parts]
        if left:
            code, messages = cargo(tree, target, "build", *RELEASE, "--lib")
            if code != 0:
                sys.exit(f"the planted extension module must compile; got exit code {code}")
            built = next(m["filenames"][0] for m in messages if m.get("target", {}).get("name") == "_kernel")
            for module in (tree / PACKAGE).glob("_kernel*.*"):
                if module.suffix in (".so", ".pyd"):
                    shutil.copy2(built, module)
            ask_pytest(left, tier, [tree])
    return faults


def main() -> None:
    """Ask, print what was seen, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--python", action="store_true", help="faults of the Python package alone")
    parser.add_argument("--rust", action="store_true", help="faults of the Rust crates alone")
    parser.add_argument("--only", type=int, nargs="+", metavar="NUMBER", help="these faults of the lists alone")
    parser.add_argument("--generated", type=int, default=0, metavar="N", help="faults drawn at random in Python")
    parser.add_argument("--generated-rust", type=int, default=0, metavar="N", help="and in the kernel")
    parser.add_argument("--seed", type=int, default=1, help="draws others")
    parser.add_argument("--chosen", action="store_true", help="ask the chosen tests alone")
    parser.add_argument("--full", action="store_true", help="ask every test about what the quick tier does not see")
    parser.add_argument("--write", type=Path, metavar="PAGE", help="the page that says what was seen")
    args = parser.parse_args()
    args.tiers = TIERS[: 1 if args.chosen else 3 if args.full else 2]
    faults, wrong = python_faults()
    rust, files, wrong_rust = rust_faults()
    if wrong or wrong_rust:
        print(*wrong, *wrong_rust, sep="\n", file=sys.stderr)
        sys.exit(2)
    faults, rust = ([f for f in some if not args.only or f.number in args.only] for some in (faults, rust))
    faults += generated_python(args.generated, args.seed)
    # Of faults that were drawn in Python the chosen tests alone are asked, unless all tests are.
    asked = {LISTED[0]: args.tiers, DRAWN[0]: args.tiers if args.full else args.tiers[:1]}
    asked |= dict.fromkeys((LISTED[1], DRAWN[1]), args.tiers[1:])
    done = []
    with tempfile.TemporaryDirectory(prefix="mutants-") as name:
        folder = Path(name)
        if args.python or not args.rust:
            trees = [copied(folder / str(i)) for i in range(WORKERS)]
            for tier in args.tiers:
                ask_pytest([fault for fault in faults if tier in asked[fault.group]], tier, trees)
            done += faults
        if args.rust or not args.python:
            done += ask_rust(rust, files, args, folder)
    page = mutants_page.page(done, asked)
    print(page)
    if args.write:
        args.write.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
