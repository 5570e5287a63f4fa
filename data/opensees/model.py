"""OpenSeesPy models of the building in model.json, beside the exact results that the file carries.

    python model.py [--model NAME ...] [--motion N ...] [--substeps N] [--friction-stiffness RATIO]

needs openseespy alone. Units are kg, N, m, s. README.md says what these models do otherwise than the exact ones.
"""

import argparse
import json
from itertools import combinations
from pathlib import Path

import openseespy.opensees as ops

HERE = Path(__file__).parent
GRAVITY = 9.80665
GROUND = 1000  # number of the ground's node; blocks have those of their order plus BLOCKS
BLOCKS = 100


def springs(model):
    """Storeys: elastic-plastic springs in parallel give the trilinear backbone with Masing's rule."""
    for number, parts in enumerate(model["springs"], start=1):
        tags = []
        for place, (stiffness, strength) in enumerate(parts):
            tag = 10 * number + place
            if strength is None:
                ops.uniaxialMaterial("Elastic", tag, stiffness)
            else:
                ops.uniaxialMaterial("ElasticPP", tag, stiffness, strength / stiffness)
            tags.append(tag)
        p_over_h = model["p_over_h"][number - 1]
        if p_over_h > 0.0:
            ops.uniaxialMaterial("Elastic", 10 * number + 8, -p_over_h)
            tags.append(10 * number + 8)
        ops.uniaxialMaterial("Parallel", 10 * number + 9, *tags)
        below = number - 1 if number > 1 else GROUND
        ops.element("zeroLength", number, below, number, "-mat", 10 * number + 9, "-dir", 1)


def dashpots(model):
    """The damping matrix, as dashpots between every pair of floors and to the ground."""
    matrix = model["damping"]
    floors = range(len(matrix))
    pairs = [(i + 1, j + 1, -matrix[i][j]) for i, j in combinations(floors, 2)]
    pairs += [(GROUND, i + 1, sum(matrix[i])) for i in floors]
    for number, (one, other, coefficient) in enumerate(pairs, start=5000):
        ops.uniaxialMaterial("Viscous", number, coefficient, 1.0)
        ops.element("zeroLength", number, one, other, "-mat", number, "-dir", 1)


def blocks(model, ratio):
    """Goods: stiff elastic-plastic springs that slide at mu_k times the weight of the block."""
    for number, block in enumerate(model["blocks"], start=1):
        limit = block["mu_k"] * block["mass"] * GRAVITY
        stiffness = ratio * model["springs"][0][0][0]
        tag = BLOCKS + number
        if limit > 0.0:
            ops.uniaxialMaterial("ElasticPP", tag, stiffness, limit / stiffness)
        else:
            ops.uniaxialMaterial("Elastic", tag, 0.0)
        ops.element("zeroLength", tag, block["floor"] or GROUND, tag, "-mat", tag, "-dir", 1)


def build(model, motion, ratio):
    """Build the model under a motion."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(GROUND, 0.0)
    ops.fix(GROUND, 1)
    for number, mass in enumerate(model["mass"], start=1):
        ops.node(number, 0.0)
        ops.mass(number, mass)
    for number, block in enumerate(model["blocks"], start=1):
        ops.node(BLOCKS + number, 0.0)
        ops.mass(BLOCKS + number, block["mass"])
    springs(model)
    dashpots(model)
    blocks(model, ratio)
    ops.timeSeries("Path", 1, "-dt", motion["dt"], "-filePath", str(HERE / motion["file"]))
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormUnbalance", 1e-8 * max(model["mass"]) * GRAVITY, 50)
    ops.algorithm("KrylovNewton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def advance(step, halvings=8):
    """One step; where it does not converge another algorithm is tried, then two steps of half the length."""
    if ops.analyze(1, step) == 0:
        return
    for algorithm in ("Newton", "ModifiedNewton", "NewtonLineSearch"):
        ops.algorithm(algorithm)
        converged = ops.analyze(1, step) == 0
        ops.algorithm("KrylovNewton")
        if converged:
            return
    if halvings == 0:
        raise SystemExit(f"OpenSees did not converge at t = {ops.getTime():.4f} s; try --substeps with a larger number")
    for _ in range(2):
        advance(0.5 * step, halvings - 1)


def run(model, motion, substeps, ratio):
    """Return the peak drift of each storey and the peak slip of each block (m)."""
    build(model, motion, ratio)
    storeys = len(model["mass"])
    places = [(block["floor"], BLOCKS + number) for number, block in enumerate(model["blocks"], start=1)]
    drift, slip = [0.0] * storeys, [0.0] * len(places)
    step = motion["dt"] / substeps
    for _ in range((motion["samples"] - 1) * substeps):
        advance(step)
        u = [0.0] + [ops.nodeDisp(number, 1) for number in range(1, storeys + 1)]
        drift = [max(peak, abs(u[i + 1] - u[i])) for i, peak in enumerate(drift)]
        slip = [
            max(peak, abs(ops.nodeDisp(node, 1) - u[floor])) for peak, (floor, node) in zip(slip, places, strict=True)
        ]
    ops.wipe()
    return drift, slip


def main():
    """Run what is asked for and print it beside the exact results."""
    given = json.loads((HERE / "model.json").read_text(encoding="utf-8"))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--model", nargs="*", choices=list(given["models"]), default=list(given["models"]))
    parser.add_argument("--motion", nargs="*", type=int, default=[1], help="numbers of motions, from 1")
    parser.add_argument("--substeps", type=int, default=20, help="steps per sample of the motion")
    parser.add_argument("--friction-stiffness", type=float, default=1e4, help="over the stiffness of storey 1")
    options = parser.parse_args()
    rows = [("model", "motion", "quantity", "OpenSees mm", "exact mm", "ratio")]
    for name in options.model:
        model = given["models"][name]
        for number in options.motion:
            motion, exact = given["motions"][number - 1], model["exact"][number - 1]
            drift, slip = run(model, motion, options.substeps, options.friction_stiffness)
            found = [
                (f"drift of storey {i}", *pair)
                for i, pair in enumerate(zip(drift, exact["drift"], strict=True), start=1)
            ]
            found += [
                (f"slip of goods {i}", *pair) for i, pair in enumerate(zip(slip, exact["slip"], strict=True), start=1)
            ]
            for quantity, own, other in found:
                ratio = f"{own / other:.4f}" if other > 0.0 else "-"
                rows.append((name, str(number), quantity, f"{1e3 * own:.3f}", f"{1e3 * other:.3f}", ratio))
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip())
    with (HERE / "comparison.csv").open("w", encoding="utf-8") as file:
        file.writelines(",".join(row) + "\n" for row in rows)


if __name__ == "__main__":
    main()
