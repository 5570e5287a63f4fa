"""Options that several subcommands share, each with its reader: motions, target, springs, readings, code, answer."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal, cast, get_args

from seismass.base.errors import InvalidOption, RecordFormatError
from seismass.base.files import check_files
from seismass.base.units import ACCELERATION_UNITS
from seismass.base.values import printable
from seismass.commands.parser import tell
from seismass.motions.scaling import TARGET_HELP

if TYPE_CHECKING:
    from seismass.model.codes import CodeFraction
    from seismass.motions.records import Pairs, Suite
    from seismass.motions.records.builtin import BuiltinName, Reading
    from seismass.motions.spectra import TargetSpectrum

SPRING_OPTIONS: Final = {
    "overstrength": "second yield over the first",
    "second_slope": "slope after the first yield, an inference",
    "third_slope": "slope after the second yield, an inference",
}
"""What shapes the springs of a command's buildings, with its help."""
CODE_HELP: Final = "code whose share is compared, as `seismass building --codes` lists them"
FIGURE_SUFFIXES: Final = (".png", ".svg")
_LISTED_SINGLY: Final = 8


def add_motion_options(parser: argparse.ArgumentParser, period: float | None = 1.0, owner: str = "1 s") -> None:
    """Add --records, --suite, --target, --sds, --sd1, --tl and --period, by default `period`, in words `owner`."""
    motions = parser.add_argument_group("motions")
    add_records_options(motions)
    add_target_options(motions)
    add_period_option(motions, period, f"motions are scaled from 0.2 T to 1.5 T ({owner})")


def add_period_option(group: argparse._ActionsContainer, default: float | None, help: str) -> None:
    """Add --period, for which motions are scaled."""
    group.add_argument("--period", type=positive_option, default=default, metavar="T", help=help)


def add_target_options(group: argparse._ActionsContainer, *, stand_in: bool = True) -> None:
    """Add --target, --sds, --sd1 and --tl, which `read_target` reads; `stand_in`: with a spectrum by default."""
    sds, sd1, tl = (" (1.07)", " (0.61)", "; the three defaults stand in for the Port of Long Beach and are not its")
    group.add_argument("--target", metavar="TARGET", help=TARGET_HELP)
    group.add_argument("--sds", type=positive_option, metavar="G", help=f"S_DS of the ASCE 7 shape, g{sds * stand_in}")
    group.add_argument("--sd1", type=positive_option, metavar="G", help=f"S_D1, g{sd1 * stand_in}")
    group.add_argument(
        "--tl", type=positive_option, metavar="S", help=f"T_L, s (8){f'{tl} published spectrum' * stand_in}"
    )


def add_spring_options(group: argparse._ActionsContainer, names: Iterable[str] = SPRING_OPTIONS, of: str = "") -> None:
    """Add --overstrength, --second-slope and --third-slope, or those of them that are named; `of` precedes defaults."""
    from seismass.model.springs import SHAPE_FIELDS

    for name in names:
        field = SHAPE_FIELDS[name]
        group.add_argument(
            f"--{name.replace('_', '-')}",
            type=float,
            metavar=field.symbol.upper(),
            help=f"{SPRING_OPTIONS[name]} ({of}{field.default:g})",
        )


def add_reading_options(parser: argparse.ArgumentParser) -> None:
    """Add --dt, --unit, --format, --skip and --channel, which say of one file what it does not state."""
    parser.add_argument(
        "--dt", type=positive_option, metavar="S", help="time step of a record whose file does not state it, s"
    )
    parser.add_argument(
        "--unit",
        choices=tuple(ACCELERATION_UNITS),
        metavar="UNIT",
        help=f"unit of a record whose file states none: {', '.join(ACCELERATION_UNITS)}".replace("%", "%%"),
    )
    parser.add_argument(
        "--format", metavar="NAME", help="format of the file, such as columns, where its content shows another"
    )
    parser.add_argument(
        "--skip", type=int, metavar="N", help="rows of numbers before the data that are no samples, of text of columns"
    )
    parser.add_argument(
        "--channel", metavar="C", help="one channel of a file of several, by its number or its component"
    )


def reading(args: argparse.Namespace) -> Reading:
    """Return what `add_reading_options` read."""
    from seismass.motions.records.builtin import Reading

    return Reading(args.dt, args.unit, cast("Any", args.format), args.skip, args.channel)


def add_records_options(group: argparse._ArgumentGroup) -> None:
    """Add --records and --suite, which `read_motions` reads."""
    group.add_argument(
        "--records",
        type=Path,
        metavar="PATH",
        help="folder of record files, or a CSV with a column `file` (default: built-in synthetic motions)",
    )
    group.add_argument(
        "--suite",
        choices=("forty", "eleven", "seven"),
        help="built-in synthetic motions, where --records is left out: forty with the scatter of recordings (default "
        "of building, fragility, risk and slip), seven as ASCE 7-10 asks for, with published numbers (default "
        "of study, map, validate and scale), or eleven as ASCE 7-16 does (default of scaling by it)",
    )


def read_motions(args: argparse.Namespace, default: BuiltinName = "forty") -> Suite:
    """Return the suite that the options name; a built-in suite beside --records is refused."""
    from seismass.motions.records import builtin_suite, read_suite

    if args.records is None:
        return builtin_suite(args.suite or default)
    if args.suite is not None:
        raise InvalidOption(f"suite of motions must be left out where --records is given; got {args.suite}")
    return read_suite(args.records)


def read_pairs(args: argparse.Namespace) -> Pairs:
    """Return the pairs of the options: those of a folder, or the forty built-in ones."""
    from seismass.motions.records import builtin_pairs, find_pairs

    if args.records is None:
        if args.suite not in (None, "forty"):
            raise InvalidOption(f"suite of pairs must be forty, which has second components; got {args.suite}")
        return builtin_pairs()
    if args.suite is not None:
        raise InvalidOption(f"suite of motions must be left out where --records is given; got {args.suite}")
    pairs = find_pairs(args.records)
    if not len(pairs):
        raise RecordFormatError(f"pairs of {pairs.name} must be at least one; got {len(pairs.excluded)} files of none")
    return pairs


def warn_left_out(suite: Suite | Pairs) -> None:
    """Print on standard error what the suite left out, where standard output is for machines."""
    for line in left_out(suite):
        tell(line)


def warn_remarks(suite: Suite) -> None:
    """Print on standard error what the records say of themselves, where standard output has no place for it."""
    for number, record in enumerate(suite, start=1):
        for remark in record.remarks:
            tell(f"motion {number}, {record.name}: {remark}")


def left_out(suite: Suite | Pairs) -> list[str]:
    """Return a line for each file that the suite left out, with the reason, and for each of its remarks. More than a
    few files are counted by reason.
    """
    if len(suite.excluded) <= _LISTED_SINGLY:
        lines = [f"left out {printable(item.file.name)}: {item.reason}" for item in suite.excluded]
    else:
        grouped: dict[str, list[str]] = {}
        for item in suite.excluded:
            # Text after the colon is about a single file: with it, each file would be a group.
            reason = item.reason.partition(": ")[0] if item.reason.startswith("vertical") else item.reason
            grouped.setdefault(reason, []).append(printable(item.file.name))
        lines = [
            f"left out {len(names)} {'file' if len(names) == 1 else 'files'}, {names[0]}"
            f"{' and others' if len(names) > 1 else ''}: {reason}"
            for reason, names in grouped.items()
        ]
    return [*lines, *getattr(suite, "remarks", ())]


def add_opensees_option(parser: argparse.ArgumentParser, what: str) -> None:
    """Add --opensees, a folder for models of OpenSeesPy."""
    text = f"write OpenSeesPy models of {what}, with the exact peaks, to DIR"
    add_output_option(parser, "DIR", text, flag="--opensees")


def read_target(args: argparse.Namespace) -> TargetSpectrum:
    """Return the target spectrum that the options describe; --target excludes the numbers of the ASCE 7 shape."""
    from seismass.motions.scaling.suite import target_of
    from seismass.motions.spectra import DEFAULT_SD1_G, DEFAULT_SDS_G, DEFAULT_TL, TargetSpectrum

    parameters = {"sds": args.sds, "sd1": args.sd1, "tl": args.tl}
    if args.target is not None:
        for name, value in parameters.items():
            if value is not None:
                raise InvalidOption(
                    f"{name} of target spectrum must be left out where --target is given; got {value:g}"
                )
        return target_of(str(args.target))
    defaults = {"sds": DEFAULT_SDS_G, "sd1": DEFAULT_SD1_G, "tl": DEFAULT_TL}
    sds, sd1, tl = (defaults[name] if value is None else value for name, value in parameters.items())
    return TargetSpectrum.asce7(sds, sd1, tl)


def read_site(args: argparse.Namespace, command: str) -> TargetSpectrum | None:
    """Return the site spectrum that the options describe, in place of a file's; None where they describe none."""
    if args.target is None:
        if args.sds is args.sd1 is args.tl is None:
            return None
        if args.sds is None or args.sd1 is None:
            parameters = (
                "--sds" if args.sd1 is None and args.sds is not None else "--sd1" if args.sd1 is not None else "--tl"
            )
            raise InvalidOption(
                f"site spectrum of {command} must be given by --sds and --sd1 together; got {parameters} alone"
            )
    return read_target(args)


def add_code_options(group: argparse._ActionsContainer) -> None:
    """Add --code and --use, which `read_code` reads."""
    from seismass.model.codes import Use

    group.add_argument("--code", metavar="ID", help=CODE_HELP)
    uses = get_args(Use)
    group.add_argument("--use", choices=uses, metavar="USE", help=f"for --code (storage): {', '.join(uses)}")


def add_drift_cap_option(group: argparse._ActionsContainer) -> None:
    """Add --drift-cap, above which a drift counts as it in means."""
    text = "drift over height above which a drift counts as it in means over the motions (0.1); no run ends at it"
    group.add_argument("--drift-cap", type=positive_option, metavar="RATIO", help=text)


def add_code_share_option(group: argparse._ActionsContainer, help: str) -> None:
    """Add --code-share, the share of the goods that the code's model has attached."""
    group.add_argument("--code-share", type=float, metavar="L", help=help)


def read_code(args: argparse.Namespace, command: str) -> CodeFraction | None:
    """Return the code that the options name, or None where they name none."""
    from seismass.model.codes import code_fraction

    if args.code is None:
        refuse_options(args, ("use",), command, "where --code is not given")
        return None
    return code_fraction(args.code, args.use or "storage")


def add_answer_options(
    parser: argparse.ArgumentParser,
    folder: str = "none",
    default: str | Callable[[argparse.Namespace], Path | None] | None = None,
    *,
    seed: bool = False,
) -> argparse._ArgumentGroup:
    """Add --out, --jobs, --json and --no-figures, which `give_answer` reads, and --seed where something is drawn;
    return their group. `folder` says what `default` is; without one files are written only where --out says so.
    """
    output = parser.add_argument_group("running and output")
    add_output_option(output, "DIR", f"folder to write tables and figures to ({folder})", default)
    if seed:
        output.add_argument("--seed", type=int, default=0, metavar="N", help="seed of the bootstrap (0)")
    add_jobs_option(output)
    add_json_option(output)
    output.add_argument("--no-figures", action="store_true", help="write tables alone, no figures and no page")
    return output


@dataclass(frozen=True)
class Output:
    """What the frame checks of a path that is written, before the command runs: a file of some suffixes, or a folder;
    `default` is the path where none is given.
    """

    is_folder: bool
    suffixes: Sequence[str] = ()
    default: Callable[[argparse.Namespace], Path | None] = lambda _: None

    def checked(self, stated: Path | None, flag: str, command: str, args: argparse.Namespace) -> Path | None:
        """Return the path; one that cannot be written is refused."""
        path = self.default(args) if stated is None else stated
        if stated is not None and self.suffixes and stated.suffix.lower() not in self.suffixes:
            suffixes = " or ".join(self.suffixes)
            raise InvalidOption(f"{flag} of {command} must be a file with the suffix {suffixes}; got {stated}")
        if path is not None and self.is_folder:
            from seismass.base.folders import check_out

            check_out(path, command)
        elif path is not None:
            check_files(path)
        return path


def check_outputs(args: argparse.Namespace, actions: Iterable[argparse.Action], command: str) -> None:
    """Refuse what the options of `add_output_option` name and cannot be written."""
    for action in actions:
        output = getattr(action, "output", None)
        if output is not None:
            flag = action.option_strings[0]
            path = output.checked(getattr(args, action.dest), flag, command, args)
            setattr(args, action.dest, path)


def add_output_option(
    group: argparse._ActionsContainer,
    metavar: Literal["DIR", "FILE"],
    help: str,
    default: str | Callable[[argparse.Namespace], Path | None] | None = None,
    *,
    flag: str = "--out",
    suffixes: Sequence[str] = (),
) -> None:
    """Add a path of what is written, which the frame checks: a folder, or a file of some suffixes."""
    action: Any = group.add_argument(flag, type=Path, metavar=metavar, help=help)
    how = {"default": default} if callable(default) else {"default": lambda _: Path(default)} if default else {}
    action.output = Output(metavar == "DIR", suffixes, **how)


def arguments(args: argparse.Namespace, *names: str, **renamed: str) -> dict[str, Any]:
    """Return values of options by the names that a function has for them (`renamed`: its name, that of the option);
    what is left out keeps its default there.
    """
    options = {name: name for name in names} | renamed
    return {name: value for name, option in options.items() if (value := getattr(args, option)) is not None}


def add_measure_options(
    group: argparse._ActionsContainer, measure: str, period: str, *, scale: bool = True, default: str | None = "sa_t1"
) -> None:
    """Add --measure and --measure-period, with the help of both; `scale`: the factor may be the measure."""
    choices = ("scale",) * scale + ("pga", "sa_t1", "sa_avg")
    group.add_argument("--measure", choices=choices, default=default, help=measure)
    group.add_argument("--measure-period", type=positive_option, metavar="T", help=period)


def add_jobs_option(group: argparse._ActionsContainer, help: str = "threads (all cores); changes no digit") -> None:
    """Add --jobs, the number of threads."""
    group.add_argument("--jobs", type=threads_option, metavar="N", help=help)


def add_json_option(group: argparse._ActionsContainer) -> None:
    """Add --json, for another program that reads the answer."""
    group.add_argument("--json", action="store_true", help="print the answer as JSON")


def add_plot_option(group: argparse._ActionsContainer, of_several: str = "") -> None:
    """Add --plot, the file of one figure; `of_several` says how figures of several things are named."""
    text = f"write a figure, .png or .svg{of_several}"
    add_output_option(group, "FILE", text, flag="--plot", suffixes=FIGURE_SUFFIXES)


def refuse_options(args: argparse.Namespace, names: Iterable[str], command: str, when: str) -> None:
    """Refuse options that are not used, by the names of their values."""
    for name in names:
        value = getattr(args, name)
        if value is not None:
            numbers = value if isinstance(value, tuple) else (value,)
            got = ", ".join(f"{one:g}" if isinstance(one, float) else str(one) for one in numbers)
            raise InvalidOption(f"--{name.replace('_', '-')} of {command} must be left out {when}; got {got}")


def numbers_option(
    count: int | None = None, *, above: float = -math.inf, least: float = -math.inf
) -> Callable[[str], tuple[float, ...]]:
    """Return a parser of a list of `count` numbers (default any), separated by commas or spaces, each above `above` and
    not less than `least`.
    """
    kind = "positive " if above == 0.0 else ""
    bound = f" of at least {least:g}" if least > -math.inf else ""
    what = f"must be {'' if count is None else f'{count} '}{kind}numbers{bound}, with commas or spaces between"

    def read(text: str) -> tuple[float, ...]:
        try:
            numbers = tuple(float(piece) for piece in text.replace(",", " ").split())
        except ValueError:
            numbers = ()
        bounded = above > -math.inf or least > -math.inf
        inside = all(above < number < math.inf and number >= least for number in numbers) if bounded else True
        if not numbers or len(numbers) != (count or len(numbers)) or not inside:
            raise argparse.ArgumentTypeError(f"{what}; got {text!r}")
        return numbers

    return read


def positive_option(text: str) -> float:
    """Return a positive number."""
    try:
        number = float(text)
    except ValueError:
        number = 0.0
    if not 0.0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"must be a positive number; got {text!r}")
    return number


def positive_count(text: str) -> int:
    """Return a whole number above zero."""
    number = int(text) if text.isdecimal() else 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"must be a whole number above zero; got {text!r}")
    return number


def threads_option(text: str) -> int:
    """Return a number of threads."""
    from seismass.runs.batch import MAX_THREADS

    number = int(text) if text.isdecimal() else 0
    if not 1 <= number <= MAX_THREADS:
        raise argparse.ArgumentTypeError(f"must be a whole number from 1 to {MAX_THREADS}; got {text!r}")
    return number
