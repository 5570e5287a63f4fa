"""`seismass run SCENE`: one scene file, its response in short, or as JSON, or with its histories."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seismass.base.files import table_content, write_file
from seismass.commands.frame import Command, show
from seismass.commands.options import add_json_option, add_opensees_option, add_output_option
from seismass.runs.scene_file import SceneFile, example_scene, read_scene
from seismass.runs.scene_goods import KEYS

if TYPE_CHECKING:
    from seismass.runs.plane import PlaneResponse
    from seismass.runs.response import Response

_KEYS = "\n".join(f"  {table or 'file'}:  {', '.join(keys)}" for table, keys in KEYS.items())


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("scene", type=Path, nargs="?", metavar="SCENE", help="scene file, .toml or .json")
    what.add_argument("--example", action="store_true", help="print a scene file to start from, and stop")
    histories = "write time, drift of storeys and rack levels, slip of blocks and base, by sample (.parquet or .csv)"
    add_output_option(parser, "FILE", histories, suffixes=(".parquet", ".csv"))
    add_json_option(parser)
    add_opensees_option(parser, "the scene")


def run(args: argparse.Namespace) -> int:
    """Solve the scene and print it; return the exit code."""
    if args.example:
        print(example_scene().read_text(encoding="utf-8"), end="")
        return 0
    from seismass.runs.peak_digits import digits_remarks
    from seismass.runs.simulate import simulate
    from seismass.show.response_text import plane_run_text, run_text

    file = read_scene(args.scene)
    motion: Any = file.motion if file.other_motion is None else (file.motion, file.other_motion)
    if args.opensees is not None:
        from seismass.runs.opensees_export import write_opensees

        write_opensees(args.opensees, {"scene": file.scene}, [file.motion])
    response: Any = simulate(file.scene, motion, histories=args.out is not None, displacements_only=True, energy=True)
    if args.out is not None:
        _write_histories(response, args.out)
    if args.json:
        print(json.dumps(as_json(file, response), indent=2, allow_nan=False))
        return 0
    title, chaotic = file.name or file.path.stem, digits_remarks(response)
    if file.other_motion is not None:
        show("\n".join([plane_run_text(response, title=title, remarks=file.remarks), *chaotic]))
        return 0
    source = "".join(record.name for record in file.records[:1])
    remarks = (*(file.remarks or response.remarks), *chaotic)
    show(run_text(response, title=title, note=file.note, source=source, remarks=remarks))
    return 0


def _write_histories(response: Response | PlaneResponse, path: Path) -> None:
    import numpy as np
    import polars as pl

    from seismass.runs.response import Response

    columns: dict[str, Any] = {"time": response.time}
    if isinstance(response, Response):
        of_racks: Any = response.rack_drift
        if response.scene.base is not None:
            columns["base_slip"] = response.base_slip
    else:
        ends = np.cumsum([rack.levels for rack in response.scene.racks], dtype=int)
        of_racks = np.split(response.rack_drift, ends[:-1], axis=1)
    histories = {"drift": response.drift, "slip": response.slip}
    histories |= {f"rack_{number}_drift": drift for number, drift in enumerate(of_racks, start=1)}
    for name, history in histories.items():
        for number in range(1, history.shape[1] + 1):
            values = history[:, number - 1]
            axes = {"": values} if values.ndim == 1 else {"_x": values[:, 0], "_y": values[:, 1]}
            columns |= {f"{name}_{number}{axis}": column for axis, column in axes.items()}
    frame = pl.DataFrame(columns)
    write_file(path, table_content(frame, "csv" if path.suffix.lower() == ".csv" else "parquet"))


def as_json(file: SceneFile, response: Response | PlaneResponse) -> dict[str, Any]:
    """Return what `--json` prints: the response, under the name and with the remarks of the file."""
    from seismass.runs.peak_digits import digits

    return response.to_dict() | {"name": file.name, "remarks": list(file.remarks), "digits": digits(response)}


COMMAND = Command(
    description="Solve a scene file (TOML or JSON: building, blocks, motion) and print its peaks.",
    examples="""
run --example > scene.toml
run scene.toml
run scene.json --json > response.json
run scene.toml --out response.parquet
run scene.toml --opensees model
""",
    options=options,
    run=run,
    note=f"""
keys of a scene file, table by table (docs/scene_file.md explains them, with an example):
{_KEYS}
""",
    codes={0: "solved (a collapse is a result)", 1: "the run failed"},
)
