"""What all commands of `seismass` share: exit codes, shared options, lists of numbers, help, progress, the terminal."""

from __future__ import annotations

import argparse
import ast
import importlib
import io
import os
import pty
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
import rich.progress

import seismass as sm
from seismass import cli, commands
from seismass.commands.frame import Command, progress, seconds_left
from seismass.commands.options import numbers_option
from seismass.commands.parser import BAD_INPUT, COMMANDS, FAILED, INTERRUPTED, joined_numbers, parse
from seismass.media.text_table import fit_text

FOLDER = Path(commands.__file__).parent


def command_of(name: str) -> Command:
    module, _ = COMMANDS[name]
    found: Command = importlib.import_module(f"seismass.commands.{module}").COMMAND
    return found


def actions_of(name: str) -> dict[str, argparse.Action]:
    """The options of a command by what is typed."""
    parser = argparse.ArgumentParser()
    command_of(name).options(parser)
    return {string: action for action in parser._actions for string in action.option_strings}


@pytest.mark.parametrize(
    ("error", "code", "said"),
    [
        (
            sm.errors.SimulationError("state is not finite at t = 1 s"),
            FAILED,
            "run failed: state is not finite at t = 1 s",
        ),
        (sm.errors.InvalidOption("mu must be positive"), BAD_INPUT, "error: mu must be positive"),
        (sm.errors.InvalidSceneFile("key is unknown"), BAD_INPUT, "error: key is unknown"),
        (sm.errors.MissingPackage("PyWavelets is needed"), BAD_INPUT, "error: PyWavelets is needed"),
        (PermissionError(13, "Permission denied", "out"), BAD_INPUT, "error: [Errno 13] Permission denied: 'out'"),
        (KeyboardInterrupt(), INTERRUPTED, "interrupted"),
    ],
    ids=["run failed", "option", "file", "package", "system", "Ctrl-C"],
)
def test_every_kind_of_error_is_one_line_and_one_code(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    error: BaseException,
    code: int,
    said: str,
) -> None:
    def raising(args: argparse.Namespace) -> int:
        raise error

    monkeypatch.setattr(cli, "parse", lambda words: argparse.Namespace(run=raising))
    assert cli.main([]) == code
    assert capsys.readouterr().err == f"seismass: {said}\n"


@pytest.mark.parametrize(
    ("name", "arguments"),
    [("map", ["--mu", "0.4", "--R", "4", "--alpha", "1"]), ("validate", []), ("study", []), ("slip", ["scene.toml"])],
)
def test_a_run_that_fails_ends_with_1_in_every_command(
    name: str,
    arguments: list[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("scene.toml").write_text("[[blocks]]\nfloor = 0\nmass = 1\nmu = 0.1\n")
    module, function = {
        "map": ("seismass.effective_mass", "effective_mass_map"),
        "validate": ("seismass.studies.validation", "validate"),
        "study": ("seismass.studies.study", "run_study"),
        "slip": ("seismass.studies.slip", "slip_demand"),
    }[name]

    def failing(*args: object, **options: object) -> None:
        raise sm.errors.SimulationError("run 3 must end; got a state that is not finite at t = 1 s")

    monkeypatch.setattr(importlib.import_module(module), function, failing)
    assert cli.main([name, *arguments]) == 1
    assert capsys.readouterr().err.startswith("seismass: run failed: run 3 must end")
    assert [path.name for path in tmp_path.iterdir()] == ["scene.toml"]


def test_no_command_catches_what_main_turns_into_a_code() -> None:
    caught = {"SeismassError", "SimulationError", "OSError", "KeyboardInterrupt", "Exception", "BaseException"}
    for file in FOLDER.glob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ExceptHandler):
                assert node.type is not None, file
                names = {part.id for part in ast.walk(node.type) if isinstance(part, ast.Name)}
                assert not names & caught, f"{file.name}, line {node.lineno}"


@pytest.mark.parametrize("option", ["--jobs", "--json", "--no-figures", "--seed", "--out", "--code-share", "--plot"])
def test_one_option_has_one_kind_of_value_in_all_commands(option: str) -> None:
    found = [actions_of(name)[option] for name in COMMANDS if option in actions_of(name)]
    assert len(found) > 1
    assert len({(action.dest, action.type, type(action), action.nargs) for action in found}) == 1


@pytest.mark.parametrize("name", COMMANDS)
def test_an_empty_path_and_a_folder_for_a_file_are_errors(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """An empty text is no path: it would be the current folder, as where a variable of the shell is not set."""
    monkeypatch.chdir(tmp_path)
    parser = argparse.ArgumentParser()
    command_of(name).options(parser)
    paths = [action for action in parser._actions if action.type is Path]
    before: list[str] = []
    for action in paths:
        words = [*action.option_strings[:1], ""] if action.option_strings else [*before, ""]
        with pytest.raises(SystemExit) as stopped:
            cli.main([name, *words])
        assert stopped.value.code == BAD_INPUT
        error = capsys.readouterr().err.splitlines()[-1]
        assert re.fullmatch(rf"seismass {name}: error: argument .*: must be a path; got ''", error)
        before += [] if action.option_strings else ["."]
    if before:
        needed = [
            word
            for action in paths
            if action.required and action.option_strings
            for word in (action.option_strings[0], ".")
        ]
        assert cli.main([name, *before, *needed]) == BAD_INPUT
        assert re.fullmatch(r"seismass: error: .*\n", capsys.readouterr().err)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        ("spectrum a.AT2 --periods 1 2", "unrecognized arguments: --periods 1,2 (did you mean --period?)"),
        ("buildng a.toml", "invalid choice: 'buildng' (did you mean building?); commands are building, new,"),
        ("building a.toml --recodrs x", "unrecognized arguments: --recodrs x (did you mean --records?)"),
        ("new a.toml --livel-oad 7", "unrecognized arguments: --livel-oad 7 (did you mean --live-load?)"),
        ("scale --zzzz", "unrecognized arguments: --zzzz\n"),
        ("target ec8:1:C:0.3 surplus", "unrecognized arguments: surplus\n"),
    ],
)
def test_an_unknown_option_is_refused_with_the_one_that_it_resembles(
    words: str, hint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as raised:
        cli.main(words.split())
    assert raised.value.code == 2
    assert hint in capsys.readouterr().err


def test_scale_without_options_shows_its_help(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as raised:
        cli.main(["scale"])
    assert raised.value.code == 2
    assert "usage: seismass scale" in capsys.readouterr().out


@pytest.mark.parametrize("words", ["scale --records", "scale --pairs --method asce7-16 --records"])
def test_a_folder_that_is_not_there_is_named_as_such(words: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*words.split(), "nosuch"]) == 2
    assert "got nosuch, which does not exist" in capsys.readouterr().err


def test_names_that_have_gone_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    for words in (["ida", "scene.toml"], ["spectrum", "a.AT2", "--periods", "1"], ["scale", "--csv", "a.csv"]):
        with pytest.raises(SystemExit) as stopped:
            cli.main(words)
        assert stopped.value.code == BAD_INPUT
    capsys.readouterr()


@pytest.mark.parametrize(
    ("typed", "read"),
    [
        ("--mu 0.2 0.4 --R 2", "--mu 0.2,0.4 --R 2"),
        ("--mu 0.2, 0.4 scene.toml", "--mu 0.2,,0.4 scene.toml"),
        ("--mu=0.2 0.4 scene.toml", "--mu=0.2,0.4 scene.toml"),
        ("scene.toml --at -0.5 1e-1", "scene.toml --at -0.5,1e-1"),
        ("--records 1 --json scene.toml 2", "--records 1 --json scene.toml 2"),
        ("--clearance ,0.1 --size 1x2", "--clearance ,0.1 --size 1x2"),
    ],
)
def test_numbers_in_a_row_are_one_list(typed: str, read: str) -> None:
    assert list(joined_numbers(typed.split())) == read.split()


@pytest.mark.parametrize(
    ("command", "option", "name"),
    [
        ("study", "--mu", "mu"),
        ("map", "--R", "R"),
        ("map", "--factor", "factor"),
        ("spectrum record.AT2", "--period", "period"),
        ("spectrum record.AT2", "--ductility", "ductility"),
        ("match record.AT2", "--range", "range"),
        ("match record.AT2", "--pad", "pad"),
        ("building a.toml", "--mu-factors", "mu_factors"),
        ("fragility a.toml", "--at", "at"),
        ("fragility a.toml", "--intensity", "intensity"),
        ("risk a.toml --hazard h.csv", "--share", "share"),
        ("risk a.toml --hazard h.csv", "--other-limit", "other_limit"),
    ],
)
def test_lists_are_taken_by_commas_and_by_spaces(command: str, option: str, name: str) -> None:
    for typed in ("0.5,2", "0.5 2", "0.5, 2"):
        assert getattr(parse([*command.split(), option, *typed.split()]), name) == (0.5, 2.0)
    # A file behind the list is no part of it.
    words = command.split()
    assert getattr(parse([words[0], option, "0.5", "2", *words[1:]]), name) == (0.5, 2.0)


@pytest.mark.parametrize(
    ("read", "text", "message"),
    [
        (numbers_option(), "0.2,x", "must be numbers, with commas or spaces between; got '0.2,x'"),
        (numbers_option(), ",", "must be numbers, with commas or spaces between; got ','"),
        (numbers_option(2, above=0.0), "1", "must be 2 positive numbers, with commas or spaces between; got '1'"),
        (numbers_option(2, above=0.0), "1,0", "must be 2 positive numbers, with commas or spaces between; got '1,0'"),
        (numbers_option(2, least=0.0), "0,nan", "must be 2 numbers of at least 0, with commas or spaces between; got"),
    ],
)
def test_lists_that_cannot_be_read(read: Callable[[str], object], text: str, message: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError, match=re.escape(message)):
        read(text)


@pytest.mark.parametrize("name", ["", *COMMANDS])
def test_help_has_the_width_of_the_terminal(
    name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    heights = []
    for columns in (80, 130):
        monkeypatch.setenv("COLUMNS", str(columns))
        with pytest.raises(SystemExit) as stopped:
            cli.main([name, "--help"] if name else ["--help"])
        assert stopped.value.code == 0
        lines = capsys.readouterr().out.splitlines()
        assert all(len(line) <= columns for line in lines)
        heights.append(len(lines))
        text = " ".join(" ".join(lines).split())
        assert "exit codes: 0 " in text
        assert "2 bad input" in text
        assert "130 interrupted" in text
    assert heights[0] >= heights[1]


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize("no_color", [False, True])
def test_progress_is_drawn_on_a_terminal_alone(monkeypatch: pytest.MonkeyPatch, no_color: bool) -> None:
    drawn = Terminal()
    monkeypatch.delenv("NO_COLOR", raising=False)
    if no_color:
        monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setattr(sys, "stderr", drawn)
    bars: list[rich.progress.Progress] = []
    start = rich.progress.Progress.start
    monkeypatch.setattr(rich.progress.Progress, "start", lambda bar: (bars.append(bar), start(bar)))
    with progress("records") as tell:
        assert tell is not None
        tell(0, 7)
        tell(3, 7)
        assert [(task.completed, task.total) for task in bars[0].tasks] == [(3, 7)]
        tell(4, 9)
        assert [(task.completed, task.total, task.fields["first"]) for task in bars[0].tasks] == [(4, 9, 0)]
        tell(9, 9)
        tell(0, 5)
        assert [(task.completed, task.total) for task in bars[0].tasks] == [(0, 5)]
    assert "of 7 records" in drawn.getvalue()
    assert bool(re.search(r"\x1b\[[0-9;]*[39][0-7]m", drawn.getvalue())) is not no_color
    # The line is erased at the end, and the cursor is there again.
    assert drawn.getvalue().rstrip().endswith(("\x1b[2K", "\x1b[?25h"))
    with pytest.raises(KeyboardInterrupt), progress() as tell:
        raise KeyboardInterrupt
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    with progress() as tell:
        assert tell is None
    program = (
        "import sys; from seismass.cli import main; main(['scale', '--period', '1']); print('rich' in sys.modules)"
    )
    said = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    assert said.endswith("False\n")


@pytest.mark.parametrize(
    ("done", "first", "told", "now", "left"),
    [
        (0, 0, 0.0, 5.0, None),
        (5, 0, 10.0, 10.0, 10.0),  # half of 10 in 10 s
        (5, 0, 10.0, 14.0, 6.0),  # it goes on while the next is solved
        (8, 6, 4.0, 4.0, 4.0),  # 6 were there before: 2 in 4 s, 2 are left
        (9, 0, 9.0, 30.0, 0.0),
    ],
)
def test_time_left_is_by_the_rate_so_far(done: int, first: int, told: float, now: float, left: float | None) -> None:
    assert seconds_left(done, 10, first, told, now) == left


def test_lines_are_folded_below_their_label() -> None:
    line = "remark    the scatter is that of the motions alone: friction is as given"
    assert fit_text(line, 40).split("\n") == [
        "remark    the scatter is that of the",
        "          motions alone: friction is as",
        "          given",
    ]
    assert fit_text(line, 80) == line


@pytest.mark.skipif(os.name != "posix", reason="no pseudo-terminals on this system")
@pytest.mark.parametrize("wish", [{}, {"NO_COLOR": "1"}, {"TERM": "dumb"}])
def test_answer_on_a_terminal_and_in_a_file(wish: dict[str, str]) -> None:
    """Bold on a terminal (https://no-color.org: any effect is left out where NO_COLOR is set); plain elsewhere."""
    program = "from seismass.commands.frame import show; show('head\\nANSWER  use 0.9\\nrow [1, 2]', 'ANSWER')"
    environment = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "FORCE_COLOR")}
    environment |= {"TERM": "xterm-256color"} | wish
    command = [sys.executable, "-c", program]
    assert subprocess.run(command, env=environment, capture_output=True, check=True).stdout == (
        b"head\nANSWER  use 0.9\nrow [1, 2]\n"
    )
    ours, theirs = pty.openpty()
    with subprocess.Popen(command, env=environment, stdout=theirs, close_fds=True) as process:
        os.close(theirs)
        printed = b""
        while True:
            try:
                piece = os.read(ours, 4096)
            except OSError:
                break
            if not piece:
                break
            printed += piece
        assert process.wait() == 0
    os.close(ours)
    answer = b"ANSWER  use 0.9" if wish else b"\x1b[1mANSWER  use 0.9\x1b[0m"
    assert printed.replace(b"\r\n", b"\n") == b"head\n" + answer + b"\nrow [1, 2]\n"


def test_paths_that_are_written_are_checked_by_the_frame() -> None:
    """Those of `campaign` and `match` are not: what they may be depends on files that are read first."""
    unchecked = {
        name
        for name in COMMANDS
        for option in ("--out", "--plot", "--opensees", "--mass-source")
        if option in actions_of(name) and not hasattr(actions_of(name)[option], "output")
    }
    assert unchecked == {"campaign", "match"}
