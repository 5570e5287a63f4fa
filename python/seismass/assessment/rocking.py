"""Goods that tip before they slide: which they are, what stands for them, and how often they lift off and may fall."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.assessment.building import OwnBuilding
from seismass.assessment.checks import friction_words
from seismass.assessment.floors import FloorGoods
from seismass.assessment.models import SLIDING, SLIDING_HIGH, SLIDING_LOW, friction_factors
from seismass.base.values import FloatArray
from seismass.model.scene import Scene
from seismass.model.tipping import FALLS_BELOW, Tipping, demand_in_g, falls_of
from seismass.motions.records.intensity import integrals
from seismass.runs.plane import PlaneResponse
from seismass.runs.simulate import simulate

WORDS: Final[dict[Tipping, str]] = {
    "slide": "goods that slide with their mu",
    "split": "split",
    "attached": "attached",
}
"""What texts call the models of goods that tip."""
TAKEN: Final = "goods that tip taken as "
"""How the answer under another of them begins."""
BOUNDS: Final = (SLIDING_LOW, SLIDING_HIGH)
"""Columns of the models at the bounds of friction."""


def tipping_kinds(building: OwnBuilding) -> tuple[FloorGoods, ...]:
    """Return the kinds of goods present that tip before they slide at any of the frictions of an assessment."""
    factors = friction_factors(building).values()
    return tuple(kind for kind in building.present if any(kind.tips_first(factor) for factor in factors))


def other_models(building: OwnBuilding) -> dict[str, OwnBuilding]:
    """Return a building with the other models of goods that tip, by what they are called."""
    kinds, factors = tipping_kinds(building), friction_factors(building).values()
    models = {kind.model(factor) for kind in kinds for factor in factors if kind.tips_first(factor)}
    others = {model: words for model, words in WORDS.items() if models and models != {model}}
    return {f"{TAKEN}{words}": building.with_tipping(model) for model, words in others.items()}


def tipping_table(building: OwnBuilding, scene: Scene, motions: Sequence[Any]) -> pl.DataFrame:
    """Return one row per kind of goods that tips: size (m), b/h, its model at each friction, the part that stays, and
    under how many motions its floor exceeds b/h ("lifts"), and Ishiyama's limit of velocity too ("limits_exceeded").
    """
    kinds, factors = tipping_kinds(building), friction_factors(building)
    demand, velocity = _floor_peaks(scene, motions) if kinds else (np.empty((0, 0)), np.empty((0, 0)))
    rows = []
    for kind in kinds:
        size, floor = kind.size, kind.floor - 1
        assert size is not None
        lifts = demand[:, floor] > size.uplift_g
        models = {name: kind.model(factor) for name, factor in factors.items()}
        rows.append(
            {
                "floor": kind.floor,
                "name": building.storey_names[floor],
                "goods": kind.name,
                "width": size.width,
                "height": size.height,
                "ratio": size.uplift_g,
                "mu_s": kind.mu_s,
                "model": models.pop(SLIDING),
                "staying": kind.staying(),
                **{name: models.get(name) for name in BOUNDS},
                "motions": len(demand),
                "lifts": int(lifts.sum()),
                "limits_exceeded": int((lifts & (velocity[:, floor] > (size.overturning_velocity or 0.0))).sum()),
            }
        )
    schema: dict[str, Any] = {"floor": pl.UInt32, "name": pl.String, "goods": pl.String}
    schema |= dict.fromkeys(("width", "height", "ratio", "mu_s"), pl.Float64) | {"model": pl.String}
    schema |= {"staying": pl.Float64} | dict.fromkeys(BOUNDS, pl.String)
    return pl.DataFrame(rows, schema=schema | dict.fromkeys(("motions", "lifts", "limits_exceeded"), pl.UInt32))


def _floor_peaks(scene: Scene, motions: Sequence[Any]) -> tuple[FloatArray, FloatArray]:
    """Largest acceleration over g + a_v, and absolute velocity (m/s), of each floor, shape (motions, storeys)."""
    demands, velocities = [], []
    for motion in motions:
        response = simulate(scene, motion, histories=True, events=False)
        grounds = response.motions if isinstance(response, PlaneResponse) else (response.motion,)
        ground = np.stack([integrals(each.acceleration, each.dt)[0] for each in grounds], axis=-1)
        moving = response.floor_velocity.reshape(len(ground), scene.storeys, -1) + ground[:, None, :]
        shaking = response.floor_acceleration.reshape(moving.shape)
        lengths = np.linalg.norm(shaking, axis=-1)
        demands.append([demand_in_g(of_floor, grounds[0].vertical) for of_floor in lengths.T])
        velocities.append(np.nanmax(np.linalg.norm(moving, axis=-1), axis=0))
    return np.array(demands), np.array(velocities)


def tipping_sentences(building: OwnBuilding, table: pl.DataFrame) -> tuple[str, ...]:
    """Return what is said of goods that tip, a sentence for each b/h and model: what stands for them and why, how often
    they lift off and may fall, and how many of such blocks fall.
    """
    sentences = []
    words = friction_words(building.mu_factors)
    keys = ("ratio", "height", "mu_s", "model", *BOUNDS)
    for _, rows in table.group_by(keys, maintain_order=True):
        row = rows.row(0, named=True)
        floors = ", ".join(str(floor) for floor in dict.fromkeys(rows["floor"]))
        named = " and ".join(name for name in dict.fromkeys(rows["goods"]) if name) or "goods"
        first = row["model"] != "slide"
        models = [(words[name], row[name]) for name in BOUNDS if row[name]]
        where = "" if first else f" with {next((text for text, model in models if model != 'slide'), '')}"
        differing = [(text, model) for text, model in models if model != row["model"]]
        other = "; ".join(f"with {text} they are {_model(row, model)}" for text, model in differing)
        how = _model(row, row["model"]) if first else f"taken as goods that slide with {words[SLIDING]}"
        lifts, falls = (rows[name].to_numpy().max() for name in ("lifts", "limits_exceeded"))
        sentences.append(
            f"{named} on floor {floors} tip before they slide{where} (b/h = {row['ratio']:.3g}, mu = "
            f"{row['mu_s']:.3g}): they are {how}{f' ({other})' * bool(other)}; they lift off in up to {lifts} of "
            f"{row['motions']} motions and may fall in up to {falls}, in which both limits of Ishiyama are exceeded"
            f"{_falls(row)}"
        )
    return tuple(sentences)


def _model(row: dict[str, Any], model: Tipping) -> str:
    """What stands for goods, and why."""
    if model == "slide":
        return "taken as goods that slide"
    if model == "split":
        part = f"{row['staying']:.2f}" if row["model"] == "split" else "a part"
        return f"split, {part} of them staying with the floor and the rest sliding with mu = b/h"
    return f"taken as attached{f', as blocks of b/h below {FALLS_BELOW:g} may fall' * (row['ratio'] < FALLS_BELOW)}"


def _falls(row: dict[str, Any]) -> str:
    """How many of single blocks of such a size fall of those that lift off."""
    known = falls_of(row["ratio"], row["height"])
    if known is None:
        return ""
    return (
        f"; of blocks of {known.height} with b/h {known.ratio:g} that lift off at a design level of S_DS = 1 g, "
        f"{100.0 * known.share:.0f} % fall ({100.0 * known.low:.0f} to {100.0 * known.high:.0f} % by building)"
    )
