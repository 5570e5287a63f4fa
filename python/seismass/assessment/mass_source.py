"""The way back into ETABS and SAP2000: mass sources of both analyses as lines of e2k and s2k.

The keys are those of files of these programs, and of other writers, in public repositories; no documentation of CSI was
at hand.
"""

from __future__ import annotations

from typing import Final

from seismass.assessment.answer import Analysis, Answer
from seismass.assessment.building import OwnBuilding
from seismass.base.errors import InvalidOption
from seismass.base.values import printable, refusal

NAMES: Final = ("SEISMASS1", "SEISMASS2")
"""Mass sources of analysis 1 and 2."""
_E2K: Final = (
    '  MASSSOURCE  "{name}"  INCLUDEELEMENTS "Yes"  INCLUDEADDEDMASS "Yes"  INCLUDELOADS "{loads}"  INCLUDEMOVE "No"  '
    'INCLUDELATERALMASS "Yes"  INCLUDEVERTICALMASS "No"  LUMPATSTORIES "Yes"  ISDEFAULT "{default}"'
)
_S2K: Final = "   MassSource={name}   Elements=Yes   Masses=Yes   Loads={loads}   IsDefault={default}"


def mass_source_lines(answer: Answer, building: OwnBuilding, suffix: str, pattern: str = "Live") -> str:
    """Return lines of an e2k or s2k file with the mass sources of both analyses; `pattern` is the load pattern of the
    design live load. Floors whose multipliers differ need a pattern for each.
    """
    if not answer.analyses:
        raise refusal(InvalidOption, "mass source", "building", "that of an answer", f"none: {answer.reason}")
    groups = _groups(answer.analyses, building)
    patterns = [pattern if len(groups) == 1 else f"{pattern}{number}" for number in range(1, len(groups) + 1)]
    words = _words(answer.analyses, building, dict(zip(patterns, groups.values(), strict=True)))
    sources: list[tuple[str, str, list[tuple[str, float]]]] = []
    for place, name in enumerate(NAMES):
        loads = [(each, group[place]) for each, group in zip(patterns, groups, strict=True) if group[place] > 0.0]
        sources.append((name, "No" if place else "Yes", loads))
    lines: list[str] = []
    if suffix == ".e2k":
        lines += [*(f"$ {line}" for line in words), "$ MASS SOURCE"]
        for name, default, loads in sources:
            lines.append(_E2K.format(name=name, loads="Yes" if loads else "No", default=default))
            lines += [f'  MASSSOURCELOAD  "{name}"  "{each}"  {factor:.6g}' for each, factor in loads]
    else:
        lines += [f"File written by seismass. {' '.join(words)}", "", 'TABLE:  "MASS SOURCE"']
        for name, default, loads in sources:
            tails = [f'   LoadPat="{each}"   Multiplier={factor:.6g}' for each, factor in loads] or [""]
            lines.append(_S2K.format(name=name, loads="Yes" if loads else "No", default=default) + tails[0])
            lines += [f"   MassSource={name}{tail}" for tail in tails[1:]]
        lines += ["", "END TABLE DATA"]
    return "\n".join(lines) + "\n"


def _groups(analyses: tuple[Analysis, ...], building: OwnBuilding) -> dict[tuple[float, float], list[int]]:
    """Floors with a design live load by their multipliers in both analyses."""
    groups: dict[tuple[float, float], list[int]] = {}
    for floor in range(building.storeys):
        if building.live_load[floor] > 0.0:
            first, second = (round(one.multipliers[floor], 9) for one in analyses)
            groups.setdefault((first, second), []).append(floor)
    return groups


def _words(analyses: tuple[Analysis, ...], building: OwnBuilding, patterns: dict[str, list[int]]) -> list[str]:
    """What to do with the lines, and the floor masses to compare afterwards."""
    names = [printable(name) or f"floor {floor}" for floor, name in enumerate(building.storey_names, start=1)]
    lines = [
        f"Run modal and seismic load cases with the mass source {NAMES[0]}, then make {NAMES[1]} the default and run "
        "them again; the larger of both counts.",
        "Add a line for each superimposed dead load, which these masses contain.",
    ]
    for pattern, floors in patterns.items():
        where = ", ".join(names[floor] for floor in floors)
        lines.append(f"The load pattern {pattern} is the design live load of {where}, and of no other floor.")
    for floor in reversed(range(building.storeys)):
        first, second = (1e-3 * one.mass[floor] for one in analyses)
        lines.append(f"Mass of {names[floor]}: {first:.6g} t in analysis 1, {second:.6g} t in analysis 2.")
    return lines
