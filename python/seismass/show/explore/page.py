"""`explorer_html`: the live page, from its templates, the compiled kernel and the built-in suite."""

from __future__ import annotations

import base64
import gzip
import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final

import numpy as np
from jinja2 import ChoiceLoader, Environment, PackageLoader
from markupsafe import Markup

from seismass import _kernel
from seismass.base.errors import InvalidOption, MissingPackage, SeismassError
from seismass.base.statistics import bootstrap_counts
from seismass.base.values import as_path
from seismass.design import response_spectrum_analysis
from seismass.design.scaling import scale_asce7_10
from seismass.effective_mass import effective_mass, rule
from seismass.media.page import DIFFERENCES, page_html, templates
from seismass.media.roles import ADVISED, CODE, SLIDE
from seismass.model.block import blocks_on_floors
from seismass.model.building import Building
from seismass.model.codes import MARK, NOT_CHECKED, code_fraction
from seismass.model.scene import Scene
from seismass.motions.motion import scaled_motions
from seismass.motions.records.builtin import builtin_suite
from seismass.motions.spectra import TargetSpectrum, mean_spectrum
from seismass.motions.spectra.target import target_of_parameters
from seismass.show.animation.animation import FACTORS
from seismass.show.animation.html import SPEEDS, element_html

CASES: Final = 4928
"""Buildings behind the bins: those of `seismass map` with its default parameters."""


@dataclass(frozen=True)
class Bin:
    """Quantiles (16, 50 and 84 %) of the effective fraction of the buildings with eta in a range, whose ends
    are None where it is open.
    """

    start: float
    end: float | None
    low: float
    median: float
    high: float

    @property
    def content(self) -> dict[str, Any]:
        """What the page takes."""
        return {"from": self.start, "to": self.end, "low": self.low, "median": self.median, "high": self.high}


BINS: Final = (
    Bin(0.0, 0.2, 0.0, 0.0, 0.03),
    Bin(0.2, 0.3, 0.0, 0.0, 0.13),
    Bin(0.3, 0.4, 0.0, 0.08, 0.24),
    Bin(0.4, 0.5, 0.0, 0.25, 0.39),
    Bin(0.5, 0.6, 0.12, 0.37, 0.54),
    Bin(0.6, 0.7, 0.28, 0.51, 0.67),
    Bin(0.7, 0.8, 0.5, 0.67, 0.8),
    Bin(0.8, 1.0, 0.66, 0.84, 0.94),
    Bin(1.0, 1.2, 0.85, 0.96, 1.0),
    Bin(1.2, 1.5, 0.94, 1.0, 1.0),
    Bin(1.5, 2.0, 0.99, 1.0, 1.0),
    Bin(2.0, None, 1.0, 1.0, 1.0),
)
"""The map of the built-in suite, as docs/effective_mass.md prints it, which `tools/pages` computes; a test compares
both."""


NAME: Final = "seismass_web.wasm"
"""Name of the compiled kernel, as `tools/make-web-kernel` writes it."""


def kernel_file() -> Path:
    """Return the compiled kernel of the live page.

    Raises
    ------
    MissingPackage
        This installation has none.
    """
    path = Path(__file__).parent / NAME
    if not path.is_file():
        raise MissingPackage(
            "kernel of the live page must be compiled to WebAssembly: `make explorer` in a clone of the project does "
            f"that, and wheels of releases carry it; got no {path}"
        )
    return path


EMPTY = "#e4e4e0"
"""The bar where no goods act as mass."""
PERIOD, REDUCTION, FRICTION, COUNTED = 0.47, 4.0, 0.2, 0.25
GOODS = (1.0, 1.0, 0.0)
"""The case that the page opens with: `defaultCase` in case.js."""


def still_answer() -> Markup:
    """Return a bar of the effective fraction as SVG, with a sentence, for the case that the page opens with."""
    suite = builtin_suite("seven")
    factors = scale_asce7_10(suite, TargetSpectrum.asce7(), between=False).factors
    bare = Building.uniform(len(GOODS), PERIOD, mass=1.0)
    design = response_spectrum_analysis(
        [1.0 + COUNTED * goods for goods in GOODS],
        bare.stiffness,
        lambda periods: mean_spectrum(suite, factors, periods),
    )
    strength = design.storey_shear / REDUCTION / bare.weight
    scene = Scene(bare.replace(yield_shear_over_weight=strength), blocks_on_floors(GOODS, FRICTION))
    share = effective_mass(scene, scaled_motions(suite, factors))
    low, high = share.interval or (share.value, share.value)
    words = (
        f"{100 * share.value:.0f} % of the goods act as mass (90 % interval {100 * low:.0f} to {100 * high:.0f} %), in "
        f"a building of three storeys with a first period of {PERIOD:g} s, designed with R = {REDUCTION:g}, goods as "
        f"heavy as the floor on floors 1 and 2, and friction {FRICTION:g}, over seven synthetic motions. "
        f"The code's model counts {100 * COUNTED:.0f} %."
    )
    return Markup(
        '<figure class="still"><svg viewBox="0 0 400 46" role="img" aria-label="{words}">'
        '<rect width="400" height="30" fill="{empty}"/><rect width="{filled:.1f}" height="30" fill="{slide}"/>'
        '<rect x="{low:.1f}" y="11" width="{wide:.1f}" height="8" fill="{interval}"/>'
        '<path d="M{code:.1f} 0V36" stroke="{counted}" stroke-width="2"/>'
        '<text x="{code:.1f}" y="45" font-size="10" text-anchor="middle" fill="currentColor">code</text></svg>'
        "<figcaption>{words}</figcaption></figure>"
    ).format(
        slide=SLIDE.text,
        interval=ADVISED.text,
        counted=CODE.text,
        empty=EMPTY,
        words=words,
        filled=400 * share.value,
        low=400 * low,
        wide=400 * (high - low),
        code=400 * COUNTED,
    )


RESAMPLES: Final = 2000
"""Bootstrap resamples: the default of `effective_mass`, and with its seed the same draws."""
CODES: Final = {"asce7-10": "ASCE 7-10", "nbc": "NBC", "ec8": "EC 8"}
"""Codes whose share for storage the page offers by name, and their short names."""
ASSUMPTIONS: Final = (
    "Shear buildings, motion in one direction. Floors, storeys and heights are alike and there is no P-Delta, unless "
    "the case is that of a building file.",
    "Trilinear springs with Masing unloading; the second yield is at the overstrength times the first, and the slope "
    "behind it is zero. The second slope is an assumption: results depend on it.",
    "Rigid goods that stick and slide with Coulomb friction; they do not rock, stack or hit walls.",
    "Damping is a ratio in every mode of the building without goods; all models have its damping matrix.",
    "Strengths by design: V_y = V_e/R, by a response spectrum analysis (SRSS) of the building with the code's share of "
    "the goods, for the mean 5 % spectrum of the suite at intensity 1. Hand-set strengths and the elastic building "
    "leave that out.",
    "The suite: seven synthetic motions, not recordings, scaled to the default target by ASCE 7-10 for T = 1 s, or as "
    "for the site of a building file. The effective fraction is over this suite, whatever motion is shown; another "
    "suite gives another fraction.",
    "The interval is a percentile bootstrap over the seven motions; it says nothing of another suite.",
)
"""What the page says it assumes."""


def explorer_html(kernel: Path | None = None) -> str:
    """Return the live page: one file that solves buildings with sliding goods in the browser and needs nothing else.

    Its Content-Security-Policy allows no request. The page works from a disk, too.

    Parameters
    ----------
    kernel : path-like, optional
        The kernel compiled to WebAssembly; by default the one of this installation.

    Returns
    -------
    str
        HTML, to be written in UTF-8.

    Raises
    ------
    MissingPackage
        This installation has no compiled kernel.
    OSError
        The kernel cannot be read.
    """
    wasm = (kernel_file() if kernel is None else as_path(kernel, "live page", InvalidOption)).read_bytes()
    factors = [0.0, *(float(factor) for factor in FACTORS)]
    animation = element_html(
        {
            "data": None,
            "alt": "The building with its goods, and a model beside it.",
            "caption": "Both runs are exact; rows are those of the record. Displacements are over the ground. Ticks "
            "below the histories: the storey begins to yield, goods begin to slide.",
            "blocks": True,
            "building": True,
            "attached": True,
            "factor": 0.0,
            "last": 0.0,
            "step": 0.01,
        },
        factors=[(factor, f"{factor:g} \N{MULTIPLICATION SIGN}" if factor else "to fit") for factor in factors],
        speeds=SPEEDS,
    )
    suite = builtin_suite("seven")
    content: str = (
        _templates()
        .get_template("explore.html.jinja")
        .render(
            animation=animation,
            records=[(record.name, f"{record.name}, {record.duration:g} s") for record in suite],
            codes=_codes(),
            codes_legend=f"{MARK} {NOT_CHECKED}",
            still=still_answer(),
            chart={"cases": f"{CASES}"},
            assumptions=ASSUMPTIONS,
            given=Markup(json.dumps(_page_data(), separators=(",", ":")).replace("<", "\\u003c")),
            wasm=_packed(wasm),
        )
    )
    return page_html(
        "How much of a building's live load acts as mass?",
        [],
        subtitle=f"The exact kernel of seismass {_kernel.VERSION} in this page: move a slider, it solves.",
        description="A building with goods that slide, solved in the browser: how much of its live load acts as mass.",
        lead=[Markup(content)],
        runs_kernel=True,
    )


@cache
def _templates() -> Environment:
    """The templates of the live page, with those of the other pages behind them."""
    environment = templates().overlay()
    environment.loader = ChoiceLoader([PackageLoader("seismass.show.explore"), PackageLoader("seismass.media")])
    return environment


def _codes() -> list[tuple[float, str]]:
    rows = [code_fraction(code, "storage") for code in CODES]
    named = [(row.fraction, f"{row.code}{row.mark}, storage: {row.fraction:g}") for row in rows]
    return [(0.0, "none: 0"), *named, (1.0, "all: 1")]


def _named_codes() -> list[tuple[str, float]]:
    """Codes, each with the mark of those that were not checked, and their fractions for storage."""
    rows = ((name, code_fraction(code, "storage")) for code, name in CODES.items())
    return [(f"{name}{row.mark}", row.fraction) for name, row in rows]


def _page_data() -> dict[str, Any]:
    """What the script of the page is given beside the kernel."""
    suite = builtin_suite("seven")
    factors = scale_asce7_10(suite, TargetSpectrum.asce7(), between=False).factors
    files = []
    for record, factor in zip(suite, factors.tolist(), strict=True):
        if record.source is None:
            continue
        files.append({"name": record.name, "text": record.source.read_text(encoding="utf-8"), "factor": factor})
    counts = bootstrap_counts(np.arange(len(suite)), RESAMPLES, seed=0)
    return {
        "version": _kernel.VERSION,
        "codes": _named_codes(),
        "mark": MARK,
        "differences": DIFFERENCES,
        "suite": [record.name for record in suite],
        "records": _packed(json.dumps(files).encode()),
        "resamples": counts.astype(int).tolist(),
        "bins": [one.content for one in BINS],
        "enlargements": list(FACTORS),
        "rule": {
            "slope": rule.SLOPE,
            "offset": rule.OFFSET,
            "smallOffset": rule.SMALL_OFFSET,
            "power": rule.POWER,
            "leastOverstrength": rule.LEAST_OVERSTRENGTH,
            "largestSecondSlope": rule.LARGEST_SECOND_SLOPE,
            "largestLoad": rule.LARGEST_LOAD,
        },
    }


def site_factors(target: dict[str, Any] | None, period: float) -> list[float] | None:
    """Factors of the suite of the page for the target of an assessment, by its parameters, and a period (s); None where
    they cannot be known.
    """
    if target is None:
        return None
    try:
        known = target_of_parameters({key: value for key, value in target.items() if key != "label"})
        factors: list[float] = scale_asce7_10(builtin_suite("seven"), known, period, between=False).factors.tolist()
    except SeismassError:
        return None
    return factors


def _packed(content: bytes) -> str:
    """Compressed without a time, so that equal contents give equal pages, and in base64."""
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()
