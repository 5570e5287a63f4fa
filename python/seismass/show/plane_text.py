"""A run in two directions as lines to read."""

from __future__ import annotations

from seismass.media.text_table import text_table
from seismass.runs.plane_response import PlaneResponse


def plane_text(response: PlaneResponse) -> str:
    """Return a run in two directions as lines, under the name of its scene."""
    return plane_run_text(response)


def plane_run_text(response: PlaneResponse, *, title: str | None = None) -> str:
    """Return peaks of storeys and blocks by direction and of the vector, events, energy and status as lines."""
    x, y = response.motions
    lines = [(response.scene.name if title is None else title) or "Response in two directions", f"  {response.scene!r}"]
    lines.append(
        f"  motion    {x.samples} samples at {x.dt:g} s ({x.duration:g} s), "
        f"PGA {x.pga_g:.3f} g in x, {y.pga_g:.3f} g in y"
    )
    lines += [f"            {remark}" for remark in response.remarks]
    for title_of, noun, values, unit, factor in (
        ("peak drift", "storey", response.peak_drift, "mm", 1e3),
        ("peak drift of rack levels", "level", response.peak_rack_drift, "mm", 1e3),
        ("peak acceleration", "floor", response.peak_floor_acceleration, "m/s2", 1.0),
        ("peak slip", "block", response.peak_slip, "mm", 1e3),
    ):
        if len(values):
            rows = [
                [str(number), *(f"{factor * value:.3f}" for value in peaks)]
                for number, peaks in enumerate(values.tolist(), start=1)
            ]
            lines += ["", f"{title_of} ({unit})", *text_table([[noun, "x", "y", "vector"], *rows], left=0)]
    counts = ", ".join(f"{count} {kind}" for kind, count in response.counts.items() if count) or "none"
    lines += ["", f"events    {counts}"]
    if response.status == "collapsed":
        lines.append(f"collapsed: storey {response.collapsed_storey} at {response.end_time:.6g} s")
    else:
        lines.append(f"completed at {response.end_time:g} s")
    return "\n".join(lines)
