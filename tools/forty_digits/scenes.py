"""Small plane scenes, each from its seed: one to three storeys, one to three blocks, one second of motion."""

from __future__ import annotations

import random
from math import pi, sin
from typing import Any, Final

SAMPLES: Final = 51
STEP: Final = 0.02


def _rounded(value: float, digits: int = 3) -> float:
    return float(f"{value:.{digits}g}")


def _motion(rng: random.Random, size: float) -> list[float]:
    waves = [(rng.uniform(0.4, 1.0), rng.uniform(1.0, 5.0), rng.uniform(0.0, 2.0 * pi)) for _ in range(3)]
    values = [sum(a * sin(2.0 * pi * f * STEP * i + phase) for a, f, phase in waves) for i in range(SAMPLES)]
    return [round(size * value, 3) for value in values]


def _building(rng: random.Random, n: int) -> dict[str, Any]:
    mass = [_rounded(rng.uniform(700.0, 1500.0)) for _ in range(n)]
    stiffness = [_rounded(rng.uniform(3e5, 9e5)) for _ in range(n)]
    building: dict[str, Any] = {"mass": mass, "stiffness": stiffness}
    if rng.random() < 0.5:
        weight = 9.8 * sum(mass)
        building |= {
            "yield_shear": [_rounded(rng.uniform(0.2, 0.4) * weight) for _ in range(n)],
            "overstrength": 1.5,
            "second_slope": 0.3,
            "third_slope": 0.05,
        }
    if rng.random() < 0.3:
        building["geometric_stiffness"] = [_rounded(0.03 * k) for k in stiffness]
    return building


def _damping(building: dict[str, Any]) -> dict[str, Any]:
    """A part of the masses and of the springs' matrix, rounded."""
    mass, k = building["mass"], [*building["stiffness"], 0.0]
    n = len(mass)
    matrix = [[0.0] * n for _ in range(n)]
    for p in range(n):
        matrix[p][p] = round(0.3 * mass[p] + 0.002 * (k[p] + k[p + 1]))
        if p + 1 < n:
            matrix[p][p + 1] = matrix[p + 1][p] = round(-0.002 * k[p + 1])
    return {"kind": "matrix", "matrix": matrix}


def _block(rng: random.Random, floor: int, *, equal: bool, wears: bool) -> dict[str, Any]:
    mu_s = _rounded(rng.uniform(0.1, 0.3))
    block = {
        "floor": floor,
        "mass": _rounded(rng.uniform(100.0, 1500.0)),
        "mu_s": mu_s,
        "mu_k": mu_s if equal else _rounded(rng.uniform(0.6, 0.95) * mu_s),
    }
    if wears:
        block["wear"] = [
            [
                _rounded(rng.uniform(0.02, 0.06), 2),
                _rounded(0.9 * mu_s),
                _rounded(0.9 * mu_s if not equal else 0.8 * mu_s),
            ]
        ]
    return block


def scene(seed: int) -> dict[str, Any]:
    """Return the scene of a seed, with the keys of a scene file."""
    rng = random.Random(seed)
    n, goods = rng.randint(1, 3), rng.randint(1, 3)
    building = _building(rng, n)
    building["damping"] = _damping(building)
    other: dict[str, Any] = {}
    if rng.random() < 0.5:
        other["stiffness"] = [_rounded(rng.uniform(0.6, 0.9) * k) for k in building["stiffness"]]
    # One block alone changes its kind by wear; of several the first two are of either kind.
    blocks = [
        _block(rng, rng.randint(0 if i == 2 else 1, n), equal=i % 2 == 0, wears=goods == 1 or rng.random() < 0.2)
        for i in range(goods)
    ]
    made: dict[str, Any] = {
        "name": f"forty digits, {seed}",
        "building": building,
        "other_direction": other,
        "blocks": blocks,
        "motion": {"dt": STEP, "unit": "m/s2", "acceleration": _motion(rng, 2.5)},
        "other_motion": {"dt": STEP, "unit": "m/s2", "acceleration": _motion(rng, 2.5)},
    }
    if rng.random() < 0.3:
        made["vertical_motion"] = {"dt": STEP, "unit": "m/s2", "acceleration": _motion(rng, 1.0)}
    return made
