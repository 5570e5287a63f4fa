"""How results look: figures, words, cards and pages. Numbers are made below.

`VIEWS` says what makes each view that a class declares; see `seismass.base.views`.
"""

from typing import Final

import lazy_loader

VIEWS: Final = {
    "Animation._repr_html_": "seismass.show.animation.html:frame",
    "Animation.fragment": "seismass.show.animation.html:fragment",
    "Animation.html": "seismass.show.animation.html:page",
    "Animation.write": "seismass.show.animation.plane_picture:write_animation",
    "Assessment._repr_html_": "seismass.show.cards:assessment_html",
    "PlaneAnimation.write": "seismass.show.animation.plane_picture:write_plane_animation",
    "Assessment.plot": "seismass.show.assessment.figures:assessment_figure",
    "Assessment.text": "seismass.show.assessment.text:assessment_text",
    "Assessment.write": "seismass.show.assessment.text:write_assessment",
    "Card._repr_html_": "seismass.show.cards:value_html",
    "Building._repr_html_": "seismass.show.cards:building_html",
    "EffectiveMass._repr_html_": "seismass.show.cards:effective_mass_html",
    "EffectiveMass.plot": "seismass.show.effective_mass:effective_mass_figure",
    "EffectiveMassMap.plot": "seismass.show.effective_mass:map_figure",
    "EffectiveMassMap.text": "seismass.show.effective_mass:map_text",
    "Evidence.plot": "seismass.show.evidence:evidence_figure",
    "Evidence.text": "seismass.show.evidence:evidence_text",
    "Evidence.write": "seismass.show.evidence:write_evidence",
    "FragilityAnalysis.plot": "seismass.show.fragility:analysis_figure",
    "FragilityAnalysis.text": "seismass.show.fragility:analysis_text",
    "LiveLoadUncertainty.plot": "seismass.show.effective_mass:uncertainty_figure",
    "MatchedRecord.plot": "seismass.show.motions:matching_figure",
    "OrientationScan.plot": "seismass.show.motions:orientation_figure",
    "PulseResult.plot": "seismass.show.motions:pulse_figure",
    "Pushover.plot": "seismass.show.plots.hysteresis:pushover",
    "PushoverFit.plot": "seismass.show.pushover_fit:pushover_fit_figure",
    "PushoverFit.text": "seismass.show.pushover_fit:pushover_fit_text",
    "Record._repr_html_": "seismass.show.cards:record_html",
    "Record.plot": "seismass.show.motions:record_figure",
    "PlaneResponse.text": "seismass.show.response_text:plane_text",
    "Response._repr_html_": "seismass.show.cards:response_html",
    "Response.animate": "seismass.show.animation.animation:animation_of",
    "Response.text": "seismass.show.response_text:response_text",
    "ResponsePlots.acceleration": "seismass.show.plots.histories:acceleration",
    "ResponsePlots.contacts": "seismass.show.plots.hysteresis:contacts",
    "ResponsePlots.drift": "seismass.show.plots.histories:drift",
    "ResponsePlots.energy": "seismass.show.plots.histories:energy",
    "ResponsePlots.events": "seismass.show.plots.histories:events",
    "ResponsePlots.floor_spectra": "seismass.show.plots.profiles:floor_spectra",
    "ResponsePlots.loops": "seismass.show.plots.hysteresis:loops",
    "ResponsePlots.profile": "seismass.show.plots.profiles:profile",
    "ResponsePlots.rack_drift": "seismass.show.plots.hysteresis:rack_drift",
    "ResponsePlots.rack_profile": "seismass.show.plots.hysteresis:rack_profile",
    "ResponsePlots.slip": "seismass.show.plots.histories:slip",
    "ResponsePlots.slip_path": "seismass.show.plots.histories:slip_path",
    "Result.write": "seismass.media.result:write_result",
    "Result._repr_html_": "seismass.show.cards:result_html",
    "RiskTargetedShare.plot": "seismass.show.risk:risk_figure",
    "RiskTargetedShare.text": "seismass.show.risk:risk_text",
    "ScalingResult.plot": "seismass.show.motions:scaling_figure",
    "ScalingResult.text": "seismass.show.motions:scaling_text",
    "Scene._repr_html_": "seismass.show.cards:scene_html",
    "Sensitivity.plot": "seismass.show.study.write:figure_of_sensitivity",
    "Sensitivity.text": "seismass.show.study.write:text_of_sensitivity",
    "SlipDemand.plot": "seismass.show.slip:slip_demand_figure",
    "SlipDemand.text": "seismass.show.slip:slip_demand_text",
    "StudyResult.figure_names": "seismass.show.study.write:figure_names",
    "StudyResult.plot": "seismass.show.study.write:study_figure",
    "StudyResult.text": "seismass.show.study.write:study_text",
    "StudyResult.write": "seismass.show.study.write:write_result",
    "Suite._repr_html_": "seismass.show.cards:suite_html",
    "TargetSpectrum._repr_html_": "seismass.show.cards:target_html",
    "Validation.figure_names": "seismass.show.validation:figure_names",
    "Validation.plot": "seismass.show.validation:validation_figure",
    "Validation.text": "seismass.show.validation:validation_text",
}
"""What makes each view: "module:function", by the class and name of its declaration."""

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

del lazy_loader
