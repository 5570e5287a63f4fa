"""Writes the reference of the documentation site: a page per module with its public names, by `__all__`.

Usage: python tools/api_pages.py FOLDER. The names of the top level are grouped by the module that defines them.
"""

from __future__ import annotations

import inspect
import sys
from pathlib import Path
from typing import Any, Final, Literal, get_args, get_origin

import seismass

MODULES: Final = {
    "records": "Records, readers, pairs, suites, intensity measures, synthetic motions.",
    "spectra": "Response spectra and target spectra.",
    "scaling": "Scaling and selection of motions.",
    "matching": "Spectral matching.",
    "pulses": "Velocity pulses of near-fault motions.",
    "design": "Modes, response spectrum analysis, lateral forces, weights, periods and limits of codes, pushover.",
    "runs": "Runs, batches, grids of scenes, scene files.",
    "fragility": "Incremental dynamic analysis, stripes, clouds, fragility.",
    "evidence": "Shares of the design live load over archetypes of a code; a share for any statistic; many buildings.",
    "risk": "Hazard curves, annual rates, the risk-targeted share.",
    "slip": "Slip demand, clearances, blocks that rock.",
    "campaign": "Studies of any size in a folder.",
    "study": "The parametric study and its sensitivity.",
    "validation": "The validations of the paper.",
    "plots": "Figures of one run, of batches, and of a pushover.",
    "explore": "The live page.",
    "codes": "Live load fractions of codes.",
    "friction": "Friction of contacts.",
    "occupancy": "Goods that are present, as surveys find them.",
    "distributions": "Distributions of what is not known.",
    "errors": "The exceptions of the package.",
}
"""Modules that have a page of their own, beside the top level, and what they hold."""

GROUPS: Final = (
    ("Scenes", ("model", "runs.grid", "runs.scene_file")),
    ("Runs", ("runs",)),
    ("How much acts as mass", ("effective_mass", "assessment")),
    ("Motions", ("records", "spectra")),
    ("Figures and pages", ("animation",)),
    ("Errors", ("base",)),
)
"""Groups of the top level, by the packages that define the names; what is left is listed last."""


def is_documented(value: Any) -> bool:
    """Whether a name has a page of its own: a class or a function, and not a number or the words of an option."""
    return callable(value) and get_origin(value) is not Literal


def rule(title: str, mark: str = "=") -> str:
    """Return a heading."""
    return f"{title}\n{mark * len(title)}\n"


def table(module: str, names: list[str]) -> str:
    """Return a list of names that gets a page for each."""
    lines = "\n".join(f"   {name}" for name in names)
    return f".. currentmodule:: {module}\n\n.. autosummary::\n   :toctree: generated\n\n{lines}\n"


def top_level() -> str:
    """Return the page of the top level."""
    left = [name for name in seismass.__all__ if not name.startswith("_")]
    left = [name for name in left if not inspect.ismodule(getattr(seismass, name))]
    numbers = [name for name in left if not is_documented(getattr(seismass, name))]
    left = [name for name in left if name not in numbers]
    text = rule("seismass") + "\n.. code-block:: python\n\n   import seismass as sm\n\n"
    for title, places in GROUPS:
        found = [name for name in left if _place(name).startswith(places)]
        left = [name for name in left if name not in found]
        text += rule(title, "-") + "\n" + table("seismass", found) + "\n"
    shown = ", ".join(f"``{name}`` = {getattr(seismass, name)}" for name in numbers)
    others = table("seismass", left) if left else ""
    return f"{text}{rule('Other', '-')}\n{others}\nConstants, in SI units: {shown}.\n"


def _place(name: str) -> str:
    """Where a name is defined, below the package."""
    defined: str = getattr(getattr(seismass, name), "__module__", "seismass")
    return defined.partition(".")[2]


def of_module(name: str, text: str) -> str:
    """Return the page of a module; names of the top level are listed with links to their pages there."""
    module = getattr(seismass, name)
    public = [item for item in module.__all__ if not inspect.ismodule(getattr(module, item))]
    objects = [item for item in public if is_documented(getattr(module, item))]
    types = {item: get_args(getattr(module, item)) for item in public if get_origin(getattr(module, item)) is Literal}
    numbers = [item for item in public if item not in objects and item not in types]
    above = [item for item in objects if getattr(seismass, item, None) is getattr(module, item)]
    own = [item for item in objects if item not in above]
    page = (
        rule(f"seismass.{name}") + f"\n{text}\n\n.. code-block:: python\n\n   import seismass as sm\n\n   sm.{name}\n\n"
    )
    if above:
        lines = "\n".join(f"   {item}" for item in above)
        page += f"Also at the top level:\n\n.. currentmodule:: seismass\n\n.. autosummary::\n\n{lines}\n\n"
    if own:
        page += table(module.__name__, own)
    if types:
        page += "\n" + "".join(
            f"``{item}``: {' or '.join(f'``{value!r}``' for value in types[item])}.\n\n" for item in types
        )
    if numbers:
        page += "\nConstants: " + ", ".join(f"``{item}``" for item in numbers) + ".\n"
    return page


def main(folder: Path) -> None:
    """Write all pages."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "top_level.rst").write_text(top_level(), encoding="utf-8")
    for name, text in MODULES.items():
        (folder / f"{name}.rst").write_text(of_module(name, text), encoding="utf-8")
    entries = "\n".join(f"   {name}" for name in ("top_level", *MODULES))
    index = rule("Reference") + "\nPython names, from their docstrings. The kernel's are in :doc:`../rust`.\n\n"
    (folder / "index.rst").write_text(f"{index}.. toctree::\n   :maxdepth: 1\n\n{entries}\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
