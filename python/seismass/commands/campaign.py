"""`seismass campaign`: studies of any size in a folder, on this machine, on workers, or as jobs of an array."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seismass.commands.command import Command, seconds
from seismass.commands.options import add_jobs_option, add_json_option, add_out_option, threads_option
from seismass.commands.progress import progress

if TYPE_CHECKING:
    from seismass.campaign import CampaignFolder


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("source", type=Path, nargs="?", metavar="FILE", help="campaign file, or folder of a campaign")
    what.add_argument("--example", action="store_true", help="print a campaign file to start from, and stop")
    add_out_option(parser, "DIR", "folder to write to, where FILE is a campaign file")
    engine = parser.add_argument_group("where runs are solved").add_mutually_exclusive_group()
    engine.add_argument("--workers", type=threads_option, metavar="N", help="N worker processes here, by dask")
    engine.add_argument("--scheduler", metavar="ADDRESS", help="running dask scheduler, as tcp://host:8786")
    engine.add_argument("--shard", type=shard_option, metavar="I/N", help="parts I, I + N, ... alone: job I of N")
    add_jobs_option(parser, "threads of the process, or of each task (all cores, or one)")
    look = parser.add_argument_group("looking at a folder").add_mutually_exclusive_group()
    look.add_argument("--status", action="store_true", help="print what is there and what is missing, and stop")
    look.add_argument("--verify", action="store_true", help="read every part and compare it with its runs, and stop")
    add_json_option(parser)


def run(args: argparse.Namespace) -> int:
    """Run the campaign, or say how far it is; return the exit code."""
    from seismass.base.errors import InvalidOption
    from seismass.base.values import refusal
    from seismass.campaign import CampaignFolder, example_description, read_campaign

    if args.example:
        print(example_description().read_text(encoding="utf-8"), end="")
        return 0
    if not args.source.exists():
        raise refusal(InvalidOption, "FILE", "command", "a campaign file or the folder of a campaign", str(args.source))
    looks = args.status or args.verify
    if args.source.is_dir():
        if args.out is not None and args.out.resolve() != args.source.resolve():
            raise refusal(InvalidOption, "--out", "command", "left out where a folder goes on", str(args.out))
        folder = CampaignFolder(args.source)
        campaign, place = (None, folder.path) if looks else (folder.campaign, folder.path)
    else:
        if args.out is None:
            raise refusal(InvalidOption, "--out", "command", "given with a campaign file", "none")
        campaign, place = (None, args.out) if looks else (read_campaign(args.source), args.out)
    if campaign is not None:
        if not args.json:
            print(f"{campaign.total} runs in {campaign.parts} parts of {campaign.part_runs}", flush=True)
        with progress() as tell:
            campaign.run(
                place,
                workers=args.workers,
                scheduler=args.scheduler,
                shard=args.shard,
                threads=args.jobs,
                progress=None if tell is None else lambda state: tell(state.runs_done, state.runs),
            )
    folder = CampaignFolder(place)
    problems = _problems(folder) if args.verify else []
    state = _state(folder, problems if args.verify else None)
    if args.json:
        print(json.dumps(state, indent=2))
    else:
        print(_text(folder, state))
        if campaign is not None:
            print(f"time     {seconds(args)}")
        for part, problem in problems:
            print(f"part {part}: {problem}")
    return 1 if state["failed"] or problems else 0


def _state(folder: CampaignFolder, problems: list[tuple[int, str]] | None) -> dict[str, Any]:
    """How far a folder is, for JSON."""
    present, runs = len(folder.present()), folder.runs_present
    failed = _failed(folder, {part for part, _ in problems or ()})
    state = {
        "folder": str(folder.path),
        "name": folder.manifest["name"],
        "inputs_sha256": folder.manifest["inputs_sha256"],
        "runs": folder.manifest["runs"],
        "runs_present": runs,
        "parts": folder.parts,
        "parts_present": present,
        "bytes": folder.bytes,
        "failed": failed,
        "complete": present == folder.parts,
    }
    return state if problems is None else {**state, "problems": dict(problems)}


def _failed(folder: CampaignFolder, damaged: set[int]) -> int:
    """Number of runs that failed, in the parts that can be read."""
    import polars as pl

    from seismass.base.errors import InvalidOption
    from seismass.base.values import refusal
    from seismass.campaign.folder import part_path

    paths = [part_path(folder.path, part) for part in sorted(folder.present() - damaged)]
    if not paths:
        return 0
    try:
        status = pl.scan_parquet(paths, glob=False).select((pl.col("status") == "failed").sum())
        return int(status.collect().item())
    except pl.exceptions.PolarsError as error:
        requirement = "whole (--verify names those that are not)"
        raise refusal(InvalidOption, f"parts of {folder.path}", "campaign", requirement, str(error)) from error


def _text(folder: CampaignFolder, state: dict[str, Any]) -> str:
    runs, missing = state["runs_present"], state["parts"] - state["parts_present"]
    lines = [
        f"folder   {folder.path}",
        f"runs     {runs} of {state['runs']}, {state['failed']} failed",
        f"parts    {state['parts_present']} of {state['parts']}" + (f", {missing} missing" if missing else ""),
        f"size     {state['bytes'] / 1e6:.1f} MB" + (f", {state['bytes'] / runs:.1f} bytes a run" if runs else ""),
    ]
    return "\n".join(lines)


def _problems(folder: CampaignFolder) -> list[tuple[int, str]]:
    import polars as pl

    rows = folder.verify().filter(pl.col("problem").is_not_null())
    return [(row["part"], row["problem"]) for row in rows.iter_rows(named=True)]


def shard_option(text: str) -> tuple[int, int]:
    """Return job i of n."""
    first, slash, jobs = text.partition("/")
    if not slash or not first.isdecimal() or not jobs.isdecimal() or not 1 <= int(first) <= int(jobs):
        raise argparse.ArgumentTypeError(f"must be I/N with I from 1 to N; got {text!r}")
    return int(first), int(jobs)


COMMAND = Command(
    description=(
        "Solve the runs that a campaign file (TOML or JSON) describes, into a folder of Parquet files. The "
        "same command goes on where it was stopped, and ends in the same bytes."
    ),
    examples="""
campaign --example > campaign.toml
campaign campaign.toml --out results
campaign results
campaign results --status
campaign campaign.toml --out results --workers 4
campaign campaign.toml --out /shared/results --scheduler tcp://head:8786
campaign campaign.toml --out /shared/results --shard 3/20
""",
    options=options,
    run=run,
    note="""
The third line goes on after an interruption. Results are read by
seismass.campaign.CampaignFolder("results").scan() or by any reader of Parquet.
docs/campaign.md explains every key of a campaign file.
""",
    codes={1: "a run failed (its rows say why) or a part is damaged"},
)
