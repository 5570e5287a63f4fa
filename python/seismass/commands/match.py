"""`seismass match`: records adjusted in the time domain to a target spectrum."""

from __future__ import annotations

import argparse
import json
import math
import re
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Final

from seismass.base.errors import InvalidOption
from seismass.base.files import Content, check_files, table_content
from seismass.commands.frame import Command, progress, show, write_figure
from seismass.commands.options import (
    add_json_option,
    add_plot_option,
    add_reading_options,
    add_target_options,
    numbers_option,
    positive_option,
    read_target,
    reading,
    warn_left_out,
    warn_remarks,
)

if TYPE_CHECKING:
    from seismass.motions.matching import MatchedSuite
    from seismass.motions.records import Record, Suite

_LIST: Final = "suite.csv"


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    parser.add_argument(
        "records",
        type=Path,
        metavar="PATH",
        help="a record, a folder of records, or a CSV with a column `file`",
    )
    add_reading_options(parser)
    add_target_options(parser)
    parser.add_argument(
        "--range",
        type=numbers_option(2, above=0.0),
        default=(0.2, 1.5),
        metavar="T1,T2",
        help="periods that are matched, s (0.2,1.5)",
    )
    parser.add_argument("--damping", type=positive_option, default=0.05, metavar="Z", help="ratio of damping (0.05)")
    parser.add_argument(
        "--tolerance", type=positive_option, default=0.03, metavar="E", help="largest misfit at any period (0.03)"
    )
    parser.add_argument("--iterations", type=int, default=40, metavar="N", help="most passes (40)")
    parser.add_argument(
        "--scale",
        type=_scale_option,
        default="least_squares",
        metavar="HOW",
        help="how a record is scaled first: least_squares, none, or a factor (least_squares)",
    )
    parser.add_argument(
        "--pad",
        type=numbers_option(2, least=0.0),
        default=(0.0, 0.0),
        metavar="HEAD,TAIL",
        help="zeros added before and behind each record, s (0,0)",
    )
    where = "file or folder for the matched records"  # which of them, the records say
    parser.add_argument("--out", type=Path, metavar="PATH", help=where)
    add_plot_option(parser, "; numbered for several records")
    add_json_option(parser)


def run(args: argparse.Namespace) -> int:
    """Match, print and write; return the exit code."""
    from seismass.motions.matching import match_suite
    from seismass.motions.records.builtin import records_named

    target = read_target(args)
    suite = records_named(args.records, reading(args))
    _check_out(args.out, args.records, suite)
    with progress("records") as tell:
        matched = match_suite(
            suite,
            target,
            periods=args.range,
            damping=args.damping,
            tolerance=args.tolerance,
            max_iterations=args.iterations,
            scale=args.scale,
            padding=args.pad,
            progress=tell,
        )
    warn_left_out(suite)
    warn_remarks(suite)
    if args.out is not None:
        _write(matched, args.out)
    if args.plot is not None:
        for number, one in enumerate(matched, start=1):
            name = f"{args.plot.stem}_{number:03d}{args.plot.suffix}"
            write_figure(one.plot(), args.plot if len(matched) == 1 else args.plot.with_name(name))
    if args.json:
        rows = [
            {**row, "remarks": list(one.remarks), "history": list(one.record.history)}
            for row, one in zip(matched.table().to_dicts(), matched, strict=True)
        ]
        document = {
            "suite": suite.name,
            "target": target.label,
            "range": list(args.range),
            "damping": args.damping,
            "tolerance": args.tolerance,
            "converged": matched.converged,
            "remarks": list(matched.suite.remarks),
            "motions": rows,
        }
        print(json.dumps(document, indent=2))
    else:
        show("\n".join(one.text for one in matched).removesuffix("\n"))
        if len(matched) > 1:
            show(f"\nremark  {matched.suite.remarks[-1]}")
    return 0 if matched.converged else 1


def _check_out(out: Path | None, path: Path, suite: Suite) -> None:
    """Refuse what --out cannot be for these records, before they are matched: a file for several records, or one that
    would replace a record or stand among them.
    """
    from seismass.base.folders import check_out
    from seismass.motions.matching.result import SUFFIXES

    if out is None:
        return
    written = [out]
    if out.suffix.lower() not in SUFFIXES:
        if len(suite) == 1 and out.suffix and not out.is_dir():
            raise InvalidOption(f"--out of match must be a file of .AT2 or .csv, or a folder; got {out}")
        if path.is_dir() and out.is_dir() and out.samefile(path):
            raise InvalidOption(f"--out of match must be another folder than that of the records; got {out}")
        check_out(out, "match")
        written = [out / name for name in (_LIST, *_file_names(suite))]
    elif len(suite) > 1:
        raise InvalidOption(f"--out of match must be a folder for {len(suite)} records; got {out}")
    else:
        check_files(out)
    read = [path, *(record.source for record in suite if record.source is not None)]
    for file in written:
        if file.exists() and any(source.exists() and file.samefile(source) for source in read):
            raise InvalidOption(f"--out of match must not replace what is read; got {out}, which would replace {file}")


def _file_names(records: Iterable[Record]) -> list[str]:
    """Names of the files of a folder: number and name of the record, without what a file name cannot hold."""
    names = (re.sub(r"[^\w.+-]+", "_", record.name) or "record" for record in records)
    return [f"{number:03d}_{name}.AT2" for number, name in enumerate(names, start=1)]


def _write(matched: MatchedSuite, out: Path) -> None:
    """One record to the file that is named, or all to a folder with a list."""
    import polars as pl

    from seismass.base.folders import write_folder
    from seismass.motions.matching.result import SUFFIXES, at2_text

    if out.suffix.lower() in SUFFIXES:
        matched[0].write(out)
        return
    rows, files = [], dict[str, Content]()
    names = _file_names(one.record for one in matched)
    for number, (one, file) in enumerate(zip(matched, names, strict=True), start=1):
        files[file] = at2_text(one.record)
        note = "; ".join(one.record.history)
        labels = {"event": one.record.event, "station": one.record.station, "component": one.record.component}
        rows.append({"number": number, "file": file, "name": one.record.name, **labels, "note": note})
    write_folder(out, {**files, _LIST: table_content(pl.DataFrame(rows), "csv")}, owner="match")


def _scale_option(text: str) -> str | float:
    if text in ("least_squares", "none"):
        return text
    try:
        number = float(text)
    except ValueError:
        number = 0.0
    if not (math.isfinite(number) and number != 0.0):
        raise argparse.ArgumentTypeError(f"must be least_squares, none or a factor other than 0; got {text!r}")
    return number


COMMAND = Command(
    description=(
        "Records adjusted by wavelets in the time domain until their spectra are the target, without drift "
        "of velocity or displacement."
    ),
    examples="""
match record.AT2 --out matched.AT2 --plot matched.png
match record.AT2 --target uniform_hazard.csv --range 0.1,3.0
match suite.csv --target ec8:1:C:0.3 --out matched/ --json
""",
    options=options,
    run=run,
    note="""
--out names a file of .AT2 or .csv for one record, else a folder: a file per record and a list suite.csv, which
--records of other commands takes. A record that is not matched within the tolerance is written too, and said.
""",
    codes={1: "a record is not matched within the tolerance"},
)
