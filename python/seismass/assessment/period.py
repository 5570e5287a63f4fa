"""What the first period of a building stands for, and what the share would be were it that of another mass."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

from seismass.assessment.file_site import PERIOD_MASSES
from seismass.assessment.own_building import OwnBuilding
from seismass.base.values import FloatArray
from seismass.effective_mass.by_hand import rule_by_hand
from seismass.effective_mass.runs import named_motions
from seismass.effective_mass.search import OWNER
from seismass.model.codes import NOT_CHECKED, VERIFIED
from seismass.spectra import TargetSpectrum

WORDS: Final = {
    "bare": "no goods",
    "code share": "the code's share of the live load",
    "all": "all goods present",
}
"""What acts as mass in a period."""


def period_sentences(
    building: OwnBuilding, target: TargetSpectrum | None, motions: list[Any], yields: bool | None
) -> tuple[str, ...]:
    """Return which mass acts in the stated period, its source, and the share by hand for other masses; None where
    stiffnesses were stated. `yields`: whether the building yields with all goods attached.
    """
    if building.stated_period is None:
        return ()
    rule = building.period_rule
    source = "as stated"
    if rule is not None:
        checked = rule.status if rule.status == VERIFIED else f"{rule.status}; {NOT_CHECKED}"
        size = "storeys" if rule.variable == "storeys" else "height in m"
        source = (
            f"{rule.coefficient:g} h^{rule.exponent:g} with h the {size}, {rule.code}, {rule.clause}, {rule.system} "
            f"({checked})"
        )
    told = [
        f"Period: {building.stated_period:.3g} s, {source}, taken with {WORDS[building.period_mass]} as mass; "
        f"{building.period():.3g} s without goods, {building.period(building.goods):.3g} s with all of them."
    ]
    if rule is not None:
        told.append(
            "Formulas of codes give short periods, for forces on the safe side: drifts are then on the unsafe side, "
            "and the share is that of a stiff building; state a calculated period (period_s) where there is one."
        )
    if yields is not None:
        shares = {mass: _by_hand(_with_period_of(building, mass), target, motions, yields) for mass in PERIOD_MASSES}
        others = ", ".join(
            f"{share:.2f} were it that with {WORDS[mass]}"
            for mass, share in shares.items()
            if mass != building.period_mass
        )
        told.append(
            f"The rule by hand gives a share of {shares[building.period_mass]:.2f} for this period, {others}, under "
            "the same motions."
        )
    return tuple(told)


def _with_period_of(building: OwnBuilding, mass: str) -> OwnBuilding:
    """The building whose stated period is that with another mass."""
    counted: dict[str, FloatArray] = {
        "bare": 0.0 * building.mass,
        "code share": building.code_mass,
        "all": building.goods,
    }
    assert building.stated_period is not None
    factor = (building.period(counted[mass]) / building.stated_period) ** 2
    return replace(building, stiffness=factor * building.stiffness, period_mass=mass)


def _by_hand(building: OwnBuilding, target: TargetSpectrum | None, motions: list[Any], yields: bool) -> float:
    scene = building.scene(target)
    return rule_by_hand(scene, named_motions(motions, OWNER, scene), yields).estimate
