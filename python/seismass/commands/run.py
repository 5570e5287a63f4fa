"""`seismass run SCENE`: one scene file, its response in short, or as JSON, or with its histories."""

from __future__ import annotations

import argparse
import json
import math
import sys
import textwrap
from pathlib import Path
from typing import Any

import polars as pl

from seismass.base.errors import InvalidOption, SimulationError
from seismass.base.files import write_table, written_whole
from seismass.base.units import STANDARD_GRAVITY
from seismass.model.block import Block
from seismass.model.building import Building
from seismass.model.damping import Rayleigh
from seismass.model.scene import Scene
from seismass.runs.response import Response
from seismass.runs.scene_file import KEYS, SceneFile, example_scene, read_scene
from seismass.runs.simulate import simulate

_HISTORY_SUFFIXES = (".parquet", ".csv")
_KEYS = "\n".join(
    textwrap.fill(f"{table or 'file'}: {', '.join(keys)}", 100, initial_indent="  ", subsequent_indent="    ")
    for table, keys in KEYS.items()
)
_EPILOG = f"""examples:
  seismass run --example > scene.toml
  seismass run scene.toml
  seismass run scene.json --json > response.json
  seismass run scene.toml --histories response.parquet

keys of a scene file, table by table (docs/scene_file.md explains them, with an example):
{_KEYS}

exit codes: 0 solved (a collapse is a result), 1 the run failed, 2 bad input"""


def add_parser(subparsers: Any, help: str) -> None:
    """Add the subcommand to those of the `seismass` command, with the line that lists it."""
    parser = subparsers.add_parser(
        "run",
        help=help,
        description="Solve a scene file (TOML or JSON: building, blocks, motion) and print its peaks.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("scene", type=Path, nargs="?", metavar="SCENE", help="scene file, .toml or .json")
    what.add_argument("--example", action="store_true", help="print a scene file to start from, and stop")
    parser.add_argument("--json", action="store_true", help="print peaks, residuals, counts, events and energy as JSON")
    parser.add_argument(
        "--histories",
        type=Path,
        metavar="FILE",
        help="write time, drift of every storey and slip of every block at every sample (.parquet or .csv)",
    )
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Solve the scene and print it; return the exit code: 1 if the run failed. Bad input is raised."""
    if args.histories is not None and args.histories.suffix.lower() not in _HISTORY_SUFFIXES:
        suffixes = " or ".join(_HISTORY_SUFFIXES)
        raise InvalidOption(f"suffix of --histories must be {suffixes}; got {args.histories.suffix!r}")
    if args.histories is not None and not args.histories.absolute().parent.is_dir():
        raise InvalidOption(f"folder of --histories must exist; got {args.histories.absolute().parent}")
    if args.example:
        print(example_scene().read_text(encoding="utf-8"), end="")
        return 0
    file = read_scene(args.scene)
    try:
        response = simulate(
            file.scene, file.motion, histories=args.histories is not None, displacements_only=True, energy=True
        )
    except SimulationError as error:
        print(f"seismass: run failed: {error}", file=sys.stderr)
        return 1
    if args.histories is not None:
        _write_histories(response, args.histories)
    print(json.dumps(as_json(file, response), indent=2, allow_nan=False) if args.json else summary(file, response))
    return 0


def _write_histories(response: Response, path: Path) -> None:
    columns: dict[str, Any] = {"time": response.time}
    for name, history in (("drift", response.drift), ("slip", response.slip)):
        columns |= {f"{name}_{number}": history[:, number - 1] for number in range(1, history.shape[1] + 1)}
    frame = pl.DataFrame(columns)
    with written_whole(path) as temporary:
        write_table(frame, "csv" if path.suffix.lower() == ".csv" else "parquet", temporary)


def as_json(file: SceneFile, response: Response) -> dict[str, Any]:
    """Return what `--json` prints: SI units, null for what is not a finite number."""
    lists = (
        "peak_drift",
        "peak_drift_time",
        "peak_slip",
        "peak_slip_time",
        "peak_floor_acceleration",
        "peak_floor_acceleration_time",
        "peak_storey_shear",
        "peak_storey_shear_time",
        "residual_drift",
        "residual_slip",
        "slip_path",
    )
    result: dict[str, Any] = {
        "name": file.name,
        "status": response.status,
        "collapsed_storey": response.collapsed_storey,
        "end_time": response.end_time,
        "dt": file.motion.dt,
        "remarks": list(file.remarks),
        **{name: getattr(response, name).tolist() for name in lists},
        "peak_base_shear": response.peak_base_shear,
    }
    if response.peak_drift_ratio is not None and response.residual_drift_ratio is not None:
        result["peak_drift_ratio"] = response.peak_drift_ratio.tolist()
        result["residual_drift_ratio"] = response.residual_drift_ratio.tolist()
    if file.scene.building is not None:
        building = file.scene.building
        result["mass_stated"] = building.mass_is_stated
        result["peak_shear_over_weight"] = (response.peak_storey_shear / building.weight).tolist()
    result["counts"] = {kind: count for kind, count in response.counts.items() if count}
    result["events"] = [
        {key: value for key, value in event.items() if value is not None}
        for event in response.events.iter_rows(named=True)
    ]
    result["energy"] = response.energy
    if file.scene.building is not None:
        result["damping_matrix"] = file.scene.building.damping_matrix.tolist()
    result["statistics"] = response.statistics
    finite: dict[str, Any] = _finite(result)
    return finite


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def summary(file: SceneFile, response: Response) -> str:
    """Return the readable summary that `seismass run` prints."""
    scene, motion = file.scene, file.motion
    lines = [file.name or file.path.stem]
    if file.note:
        lines.append(f"  {file.note}")
    lines += [f"  {line}" for line in ([] if scene.building is None else _building_lines(scene.building, scene))]
    vertical = "" if motion.vertical is None else f", vertical {max(abs(motion.vertical)) / STANDARD_GRAVITY:.3f} g"
    source = "".join(f"{record.name}, " for record in file.records[:1])
    lines.append(
        f"  motion    {source}{motion.samples} samples at {motion.dt:g} s ({motion.duration:g} s), "
        f"PGA {motion.pga_g:.3f} g{vertical}"
    )
    lines += [f"            {remark}" for remark in file.remarks]
    if scene.building is not None:
        lines += ["", *_aligned(_storey_table(scene.building, response))]
    if scene.blocks:
        lines += ["", *_aligned(_block_table(scene, response))]
    counts = ", ".join(f"{count} {kind}" for kind, count in response.counts.items() if count) or "none"
    end = f"{response.status} at {response.end_time:g} s"
    if response.collapsed_storey is not None:
        end += f": storey {response.collapsed_storey} reached its collapse drift; peaks are those until then"
    return "\n".join(
        [
            *lines,
            "",
            f"  events    {counts}",
            f"  energy    residual {response.energy['relative_residual']:.1e} of the input",
            f"  status    {end}",
        ]
    )


def _building_lines(building: Building, scene: Scene) -> list[str]:
    noun = "storey" if building.storeys == 1 else "storeys"
    periods = ", ".join(f"{period:.3f}" for period in building.periods[:3])
    more = ", ..." if building.storeys > 3 else ""
    lines = [
        f"building  {building.storeys} {noun}, periods {periods}{more} s, {_weight_text(building)}, "
        f"damping {_damping_text(building)}"
    ]
    parameters = ", ".join(f"{symbol} {_listed(values)}" for symbol, values in building.spring_summary().items())
    elastic = math.isinf(building.yield_shear.min()) and not building.laws
    lines.append(f"springs   {'elastic' if elastic else ', '.join([parameters, *building.laws])}")
    if scene.geometric_stiffness.any():
        lines.append(f"P-Delta   P/(h k) {_listed(scene.geometric_stiffness / building.stiffness)}")
    return lines


def _weight_text(building: Building) -> str:
    """The weight; where no mass is stated, that forces are fractions of it."""
    if building.mass_is_stated:
        return f"weight {building.weight / 1000.0:.5g} kN"
    return "no mass stated (forces over the weight W)"


def _damping_text(building: Building) -> str:
    damping = building.damping
    if isinstance(damping, Rayleigh):
        return f"{100.0 * damping.ratio:g} % in modes {damping.modes[0]} and {damping.modes[1]} (Rayleigh)"
    return f"{100.0 * damping:g} % in every mode" if isinstance(damping, float) else "by a given matrix"


def _listed(values: Any) -> str:
    numbers = [f"{value:.4g}" for value in values]
    return numbers[0] if len(set(numbers)) == 1 else " ".join(numbers)


def _storey_table(building: Building, response: Response) -> list[list[str]]:
    stated = building.mass_is_stated
    unit, force = ("kN", 1000.0) if stated else ("/ W", building.weight)
    header = ["storey", "peak drift mm", "at s", "residual mm", f"peak shear {unit}", "floor acceleration g"]
    ratios = response.peak_drift_ratio
    if ratios is not None:
        header.insert(2, "of height %")
    rows = []
    for i in range(len(response.peak_drift)):
        row = [
            str(i + 1),
            f"{1000.0 * response.peak_drift[i]:.3f}",
            f"{response.peak_drift_time[i]:.3f}",
            f"{1000.0 * response.residual_drift[i]:.3f}",
            f"{response.peak_storey_shear[i] / force:.4g}",
            f"{response.peak_floor_acceleration[i] / STANDARD_GRAVITY:.4f}",
        ]
        if ratios is not None:
            row.insert(2, f"{100.0 * ratios[i]:.3f}")
        rows.append(row)
    return [header, *rows]


def _block_table(scene: Scene, response: Response) -> list[list[str]]:
    stated = scene.building is None or scene.building.mass_is_stated
    header = [
        "block",
        "floor",
        "mass kg" if stated else "of floor mass",
        "mu",
        "peak slip mm",
        "at s",
        "residual mm",
        "slip path mm",
    ]
    rows = [
        [
            str(j + 1),
            str(block.floor) if block.floor else "ground",
            _mass_text(block, mass, stated),
            f"{block.mu_s:g}" if block.mu_s == block.mu_k else f"{block.mu_s:g}/{block.mu_k:g}",
            f"{1000.0 * response.peak_slip[j]:.3f}",
            f"{response.peak_slip_time[j]:.3f}",
            f"{1000.0 * response.residual_slip[j]:.3f}",
            f"{1000.0 * response.slip_path[j]:.3f}",
        ]
        for j, (block, mass) in enumerate(zip(scene.blocks, scene.block_mass, strict=True))
    ]
    return [header, *rows]


def _mass_text(block: Block, mass: float, stated: bool) -> str:
    """The mass of a block; over that of its floor where that is not stated, but for blocks on the ground."""
    if stated:
        return f"{mass:.5g}"
    return f"{mass:.5g} kg" if block.mass_ratio is None else f"{block.mass_ratio:.5g}"


def _aligned(rows: list[list[str]]) -> list[str]:
    widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
    return ["  " + "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in rows]
