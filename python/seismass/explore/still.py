"""What the live page shows where scripts do not run: the answer of the case that it opens with, as a picture."""

from __future__ import annotations

from markupsafe import Markup

from seismass.design import response_spectrum_analysis
from seismass.effective_mass import effective_mass
from seismass.media.roles import CODE, SLIDE, YIELDS
from seismass.model.block import blocks_on_floors
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.records.builtin import builtin_suite
from seismass.scaling import scale_asce7_10
from seismass.spectra import TargetSpectrum, mean_spectrum

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
    found = effective_mass(scene, [record.scaled(factor) for record, factor in zip(suite, factors, strict=True)])
    low, high = found.interval or (found.value, found.value)
    words = (
        f"{100 * found.value:.0f} % of the goods act as mass (90 % interval {100 * low:.0f} to {100 * high:.0f} %), in "
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
        interval=YIELDS.text,
        counted=CODE.text,
        empty=EMPTY,
        words=words,
        filled=400 * found.value,
        low=400 * low,
        wide=400 * (high - low),
        code=400 * COUNTED,
    )
