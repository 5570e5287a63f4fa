"""How results look: figures, words, cards and pages. Numbers are made below.

`VIEWS` says what makes each view that a class declares; see `seismass.base.views`.
"""

from typing import Final

VIEWS: Final = {
    "Animation.fragment": "seismass.show.animation.html:fragment",
    "Animation.html": "seismass.show.animation.html:page",
    "Assessment.text": "seismass.show.assessment.text:assessment_text",
    "Assessment.write": "seismass.show.assessment.write:write_assessment",
    "EffectiveMassMap.plot": "seismass.show.effective_mass.map:collapse_figure",
    "LiveLoadUncertainty.plot": "seismass.show.effective_mass.live_load:uncertainty_figure",
    "EffectiveMass._repr_html_": "seismass.show.cards.results:effective_mass_html",
    "EffectiveMass.plot": "seismass.show.effective_mass.figures:curve_figure",
    "EffectiveMass.plot_storeys": "seismass.show.effective_mass.figures:storeys_figure",
    "FragilityAnalysis.text": "seismass.show.fragility.text:text_of",
    "FragilityAnalysis.plot": "seismass.show.fragility.figures:fragility_figure",
    "FragilityAnalysis.plot_ida": "seismass.show.fragility.figures:demand_figure",
    "MatchedRecord.plot": "seismass.show.motions.matching:matching_figure",
    "Building._repr_html_": "seismass.show.cards.buildings:building_html",
    "Scene._repr_html_": "seismass.show.cards.buildings:scene_html",
    "PulseResult.plot": "seismass.show.motions.pulse:pulse_figure",
    "OrientationScan.plot": "seismass.show.motions.pulse:orientation_figure",
    "Record.plot": "seismass.show.motions.record:record_figure",
    "Record._repr_html_": "seismass.show.cards.records:record_html",
    "Suite._repr_html_": "seismass.show.cards.motions:suite_html",
    "RiskTargetedShare.text": "seismass.show.risk.text:risk_text",
    "RiskTargetedShare.plot": "seismass.show.risk.figure:risk_figure",
    "Response._repr_html_": "seismass.show.cards.results:response_html",
    "ScalingResult.plot": "seismass.show.motions.scaling:scaling_figure",
    "SlipDemand.text": "seismass.show.slip.text:slip_demand_text",
    "SlipDemand.plot": "seismass.show.slip.figure:slip_demand_figure",
    "TargetSpectrum._repr_html_": "seismass.show.cards.motions:target_html",
    "ResponsePlots.drift": "seismass.plots.histories:drift",
    "ResponsePlots.slip": "seismass.plots.histories:slip",
    "ResponsePlots.acceleration": "seismass.plots.histories:acceleration",
    "ResponsePlots.loops": "seismass.plots.hysteresis:loops",
    "ResponsePlots.slip_path": "seismass.plots.growth:slip_path",
    "ResponsePlots.energy": "seismass.plots.growth:energy",
    "ResponsePlots.profile": "seismass.plots.profiles:profile",
    "ResponsePlots.floor_spectra": "seismass.plots.profiles:floor_spectra",
    "ResponsePlots.events": "seismass.plots.timeline:events",
    "Response.animate": "seismass.animation.animation:animation_of",
    "Pushover.plot": "seismass.plots.pushover:pushover",
    "Animation.write": "seismass.show.animation.write:write_animation",
    "Animation._repr_html_": "seismass.show.animation.html:frame",
    "Assessment.figures": "seismass.show.assessment.figures:figures_of",
}
"""What makes each view: "module:function", by the class and name of its declaration."""
