"""`seismass campaign`: studies of any size in a folder, on this machine, on workers, or as jobs of an array."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from seismass.base.errors import InvalidOption
from seismass.base.values import refusal
from seismass.commands.frame import Command, progress, seconds, show
from seismass.commands.options import add_jobs_option, add_json_option, threads_option

if TYPE_CHECKING:
    from seismass.studies.campaign import Campaign, CampaignFolder

_MANY_RUNS: Final = 1_000_000
"""Runs from which on their time is estimated before they begin."""
_LONG: Final = 86400.0
"""Time (s) beyond which a campaign must be asked for."""


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("source", type=Path, nargs="?", metavar="FILE", help="campaign file, or folder of a campaign")
    what.add_argument("--example", action="store_true", help="print a campaign file to start from, and stop")
    where = "folder to write to, where FILE is a campaign file"
    parser.add_argument("--out", type=Path, metavar="DIR", help=where)
    engine = parser.add_argument_group("where runs are solved").add_mutually_exclusive_group()
    engine.add_argument("--workers", type=threads_option, metavar="N", help="N worker processes here, by dask")
    engine.add_argument("--scheduler", metavar="ADDRESS", help="running dask scheduler, as tcp://host:8786")
    engine.add_argument("--shard", type=shard_option, metavar="I/N", help="parts I, I + N, ... alone: job I of N")
    add_jobs_option(parser, "threads of the process, or of each task (all cores, or one)")
    parser.add_argument("--long", action="store_true", help="begin also what takes this machine more than a day")
    look = parser.add_argument_group("looking at a folder").add_mutually_exclusive_group()
    look.add_argument("--status", action="store_true", help="print what is there and what is missing, and stop")
    look.add_argument("--verify", action="store_true", help="compare every part with its digest and its runs, and stop")
    add_json_option(parser)


def run(args: argparse.Namespace) -> int:
    """Run the campaign, or say how far it is; return the exit code."""
    from seismass.studies.campaign import CampaignFolder, example_description, read_campaign

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
        _announce(campaign, place, args)
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
    problems = folder.verify().drop_nulls("problem").select("part", "problem").rows() if args.verify else []
    state = _state(folder, problems if args.verify else None)
    if args.json:
        print(json.dumps(state, indent=2))
    else:
        show(_text(folder, state))
        if campaign is not None:
            print(f"time     {seconds(args)}")
        for part, problem in problems:
            print(f"part {part}: {problem}")
    return 1 if state["failed"] or state["unreadable"] or problems else 0


def _announce(campaign: Campaign, place: Path, args: argparse.Namespace) -> None:
    """Print what is about to be solved, and what it takes where that is much; refuse more than a day without --long."""
    from seismass.studies.campaign import CampaignFolder
    from seismass.studies.campaign.engine import duration_text, estimated
    from seismass.studies.campaign.manifest import MANIFEST

    line = f"{campaign.total} runs in {campaign.parts} parts of {campaign.part_runs}"
    there = CampaignFolder(place).runs_present if (place / MANIFEST).is_file() else 0
    share = max(1.0 - there / campaign.total, 0.0) / (1 if args.shard is None else args.shard[1])
    if campaign.total * share >= _MANY_RUNS:
        estimate = estimated(campaign, threads=args.jobs)
        size = f"{estimate.bytes * share / 1e9:.3g} GB"
        line += f", about {duration_text(estimate.seconds * share)} by the threads of this machine, and {size}"
        if estimate.seconds * share > _LONG and not args.long:
            got = f"about {duration_text(estimate.seconds * share)} and {size} for {campaign.total * share:.3g} runs"
            raise refusal(InvalidOption, "time", "campaign", "at most a day unless --long is given", got)
    if not args.json:
        print(line, flush=True)


def _state(folder: CampaignFolder, problems: list[tuple[int, str]] | None) -> dict[str, Any]:
    """How far a folder is, for JSON."""
    present, strange = folder.present(), folder.strange()
    failed, unreadable = _failed(folder, sorted(present - {part for part, _ in problems or ()}))
    state = {
        "folder": str(folder.path),
        "name": folder.manifest["name"],
        "inputs_sha256": folder.manifest["inputs_sha256"],
        "runs": folder.manifest["runs"],
        "runs_present": folder.runs_present,
        "parts": folder.parts,
        "parts_present": len(present),
        "unreadable": sorted(strange | unreadable),
        "bytes": folder.bytes,
        "failed": failed,
        "complete": len(present) == folder.parts,
    }
    return state if problems is None else {**state, "problems": dict(problems)}


def _failed(folder: CampaignFolder, parts: list[int]) -> tuple[int, set[int]]:
    """Number of runs that failed in parts, and the parts that cannot be read."""
    import polars as pl

    from seismass.studies.campaign.manifest import part_path

    def count(parts: list[int]) -> int:
        paths = [part_path(folder.path, part) for part in parts]
        rows = pl.scan_parquet(paths, glob=False).select((pl.col("status") == "failed").sum())
        return int(rows.collect().item())

    if not parts:
        return 0, set()
    try:
        return count(parts), set()
    except pl.exceptions.PolarsError:
        failed, unreadable = 0, set()
    for part in parts:
        try:
            failed += count([part])
        except pl.exceptions.PolarsError:
            unreadable.add(part)
    return failed, unreadable


def _text(folder: CampaignFolder, state: dict[str, Any]) -> str:
    runs, missing = state["runs_present"], state["parts"] - state["parts_present"]
    lines = [
        f"folder   {folder.path}",
        f"runs     {runs} of {state['runs']}, {state['failed']} failed",
        f"parts    {state['parts_present']} of {state['parts']}" + (f", {missing} missing" if missing else ""),
        f"size     {state['bytes'] / 1e6:.1f} MB" + (f", {state['bytes'] / runs:.1f} bytes a run" if runs else ""),
    ]
    if state["unreadable"]:
        damaged = f"damaged  parts {_listed(state['unreadable'])}; remove them, and the same command solves them again"
        lines.append(damaged)
    return "\n".join(lines)


def _listed(parts: list[int], most: int = 10) -> str:
    more = f" and {len(parts) - most} more" if len(parts) > most else ""
    return ", ".join(map(str, parts[:most])) + more


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
seismass.studies.campaign.CampaignFolder("results").scan() or by any reader of Parquet.
docs/campaign.md explains every key of a campaign file.
""",
    codes={1: "a run failed (its rows say why) or a part is damaged"},
)
