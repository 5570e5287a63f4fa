"""Columns of the tables of a study: unit and meaning of each, as files carry them and the schema page lists them."""

from __future__ import annotations

from typing import Any, Final

from seismass.base.statistics import CAPPED_MEAN

_MODEL_NAMES: Final = {"real": "real model", "code": "code model", "attached": "attached model"}

KEY_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    "building": ("", "number in the grid, from 1: one for every combination of the columns below"),
    "occupancy": ("", "storage or commercial: decides lambda, and with it the strength"),
    "lambda_design": ("1", "fraction of the block mass that the design counts: it sets the strength"),
    "lambda_analysis": ("1", "fraction of the block mass that the code model carries"),
    "storeys": ("", "number of storeys"),
    "period": ("s", "first period of the bare building"),
    "R": ("1", "response modification factor, V_y = V_e / R; R = 1 is elastic unless `--yield-at-R1`"),
    "alpha": ("1", "block mass over floor mass, on every floor but the roof"),
    "mu": ("1", "friction coefficient, static and kinetic"),
}

_STOREY: Final = {"storey": ("", "storey from 1, and the floor above it")}

RESPONSE_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    **KEY_COLUMNS,
    "model": ("", "real: blocks that may slide; code: `lambda_analysis` of their mass attached; attached: all of it"),
    "motion": ("", "number of the motion from 1, as in the table `scaling`"),
    "record": ("", "event and station of the motion where known, else its name"),
    **_STOREY,
    "status": ("", "completed, collapsed or failed"),
    "reason": ("", "why a run failed, else null"),
    "run": ("", "number of the distinct run, from 1: rows with the same number were solved once"),
    "peak_drift": ("m", "largest absolute drift over continuous time; of a collapsed run until its end"),
    "peak_drift_time": ("s", "time of the largest drift"),
    "peak_drift_ratio": ("1", "largest absolute drift over the storey height"),
    "residual_drift": ("m", "drift at the end of the motion"),
    "peak_shear_over_weight": ("1", "largest spring force of the storey over W"),
    "peak_floor_acceleration": ("m/s2", "largest absolute acceleration of the floor above the storey"),
    "peak_slip": ("m", "largest absolute slip of the block on the floor above; null where there is none"),
    "residual_slip": ("m", "slip of that block at the end"),
    "slip_path": ("m", "length of the path of that block on its floor"),
}

_DRIFT_STATISTICS: Final = {
    "mean_peak_drift": ("m", f"{CAPPED_MEAN}; null where a run failed"),
    "geometric_mean_peak_drift": ("m", "geometric mean of the same; null where a run failed"),
    "median_peak_drift": ("m", "median of the same; null where a run failed"),
    "p16_peak_drift": ("m", "16 % of the motions are below"),
    "p84_peak_drift": ("m", "84 % of the motions are below"),
    "mean_peak_drift_ratio": ("1", "the mean over the storey height"),
    "collapses": ("", "number of motions under which the building collapsed"),
}

SUMMARY_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    **KEY_COLUMNS,
    **_STOREY,
    "motions": ("", "number of motions"),
    **{
        f"{name}_{model}": (unit, f"{meaning} ({words})")
        for model, words in _MODEL_NAMES.items()
        for name, (unit, meaning) in _DRIFT_STATISTICS.items()
    },
    "mean_peak_slip": ("m", "mean over the motions of the peak slip of the block on the floor above"),
    "ratio": ("1", "capped mean drift, real over code: `ratio_mass` times `ratio_sliding`"),
    "ratio_mass": ("1", "capped mean drift, attached over code: what the rest of the mass does"),
    "ratio_sliding": ("1", "capped mean drift, real over attached: what sliding does"),
    "underestimation_percent": ("%", "(real - code) / code of the means; negative where the code model drifts more"),
    "geometric_mean_underestimation_percent": ("%", "the same of the geometric means"),
    "median_underestimation_percent": ("%", "median over the motions of (real - code) / code, motion by motion"),
    "p16_underestimation_percent": ("%", "16 % of the motions are below"),
    "p84_underestimation_percent": ("%", "84 % of the motions are below"),
    "leave_one_out_percent": ("%", "`underestimation_percent` without the motion that changes it most"),
    "leave_one_out_motion": ("", "number of that motion"),
    "leave_one_out_record": ("", "its event and station where known, else its name"),
}

FRACTION_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    **KEY_COLUMNS,
    "base_shear_coefficient": ("1", "mean peak base shear of the attached model over the weight of all"),
    "eta": ("1", "friction coefficient over `base_shear_coefficient`"),
    "coefficient": ("1", "C1 of the rule by hand: S_a/R_y^(2/3) with S_a of the target, R_y = S_a W_g/V_y"),
    "estimate": ("1", "1.35 mu/C1 - 0.15, from 0 to 1: the effective fraction by hand"),
    "effective": ("1", "effective fraction; null without `--effective`, and where many runs collapsed"),
    "kind": ("", "stuck, root, multiple, zero, one or collapsed, as `seismass.effective_mass` has it"),
    "low": ("1", "lower end of the bootstrap interval of the effective fraction over the motions"),
    "high": ("1", "its upper end"),
    "excess": ("1", "real over attached model less 1, of the capped mean of the largest drift, where kind is one"),
}

DESIGN_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    **KEY_COLUMNS,
    **_STOREY,
    "design_mass_ratio": ("1", "mass of the floor above in the design, over its bare mass"),
    "analysis_mass_ratio": ("1", "mass of the floor above in the code model, over its bare mass"),
    "height": ("m", "height of the storey"),
    "geometric_stiffness_ratio": ("1", "P/h over the stiffness of the storey, goods included; 0 without P-Delta"),
    "design_period": ("s", "period of the mode with the storey's number, of the design model"),
    "spectral_acceleration": ("m/s2", "mean scaled pseudo-acceleration at that period, computed there"),
    "elastic_shear_over_weight": ("1", "V_e of the response spectrum analysis over W"),
    "yield_shear_over_weight": ("1", "V_y over W; null where the building stays elastic"),
}

SPECTRUM_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    "period": ("s", "period"),
    "target": ("m/s2", "target pseudo-acceleration"),
    "mean": ("m/s2", "mean of the scaled motions"),
    "motion_*": ("m/s2", "each scaled motion: `motion_1`, `motion_2`, ..."),
}

SCALING_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    "motion": ("", "number of the motion from 1"),
    "record": ("", "name of the record"),
    "individual_factor": ("1", "SF1: closest to the target in the logarithm"),
    "common_factor": ("1", "SF2: lifts the mean until it is not below the target at any period of the scaling"),
    "factor": ("1", "SF1 times SF2, by which accelerations are multiplied"),
}

SENSITIVITY_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    "choice": ("", "what is changed, one thing at a time"),
    "setting": ("", "to what; the first row is the study as it is"),
    "occupancy": KEY_COLUMNS["occupancy"],
    "mu": KEY_COLUMNS["mu"],
    "largest_percent": ("%", "largest underestimation of a first storey"),
    "least_R_percent": ("%", "mean underestimation of first storeys at the smallest R and the largest alpha"),
    "most_R_percent": ("%", "mean underestimation of first storeys at the largest R and alpha"),
    "mass_percent": ("%", "attached over code model, less 1, of the same storeys: what the rest of the mass does"),
    "sliding_percent": ("%", "real over attached model, less 1, of the same storeys: what sliding does"),
    "collapses": ("", "collapsed runs of all models, in which peaks count until the collapse"),
}

CLAIM_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    "number": ("", "place in the table, from 1"),
    "source": ("", "where the paper makes the claim"),
    "claim": ("", "what it says"),
    "verdict": ("", "reproduced, depends, not reproduced or not tested"),
    "numbers": ("", "our numbers"),
    "depends_on": ("", "what the verdict depends on"),
}

_COMPONENT: Final = {"component": ("", "component of the record, or the built-in motion in its place")}
_SLOPE: Final = {"second_slope": ("1", "second slope r2 of the storeys over the first")}


def _of_storeys(name: str, unit: str, meaning: str) -> dict[str, tuple[str, str]]:
    return {f"{name}_{storey}": (unit, meaning.format(storey)) for storey in (1, 2, 3)}


SECTION4_RUN_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    **_COMPONENT,
    **_SLOPE,
    "peak_g": ("g", "peak to which the record is scaled"),
    "all_yield": ("", "whether all storeys yield"),
    "slides_most": ("", "floor whose block slides most; null where none slides"),
    **_of_storeys("yields", "", "times that storey {} yields"),
    **_of_storeys("peak_drift", "m", "peak drift of storey {}"),
    **_of_storeys("peak_slip", "m", "peak slip of the block of floor {}"),
}

SECTION4_DIFFERENCE_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    **_COMPONENT,
    **_SLOPE,
    "program": ("", "OpenSees, or friction springs"),
    "setting": ("", "stiffness of its friction springs over that of storey 1, and its step"),
    "drift_mm": ("mm", "largest difference of drift from the exact kernel; null where it did not converge"),
    "drift_percent": ("%", "that over the largest drift"),
    "slip_mm": ("mm", "largest difference of slip"),
    "slip_percent": ("%", "that over the largest slip; null where no block slides"),
}

SECTION4_HISTORY_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    **_COMPONENT,
    **_SLOPE,
    "program": ("", "exact kernel, OpenSees, or friction springs"),
    "setting": SECTION4_DIFFERENCE_COLUMNS["setting"],
    "every": ("", "sample intervals of the record between instants that were compared"),
    "time": ("s", "time; as many instants as figures need"),
    **_of_storeys("drift", "m", "drift of storey {}"),
    **_of_storeys("slip", "m", "slip of the block of floor {}"),
}

PLATFORM_RUN_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    **_COMPONENT,
    "mass_ratio": ("1", "mass of the block over that of the platform"),
    "period": ("s", "period of the platform alone"),
    "mu": KEY_COLUMNS["mu"],
    "damping": ("1", "damping ratio of the platform alone"),
    "amplitude": ("1", "factor of the accelerations"),
    "peak_drift": ("m", "peak drift"),
    "peak_slip": ("m", "peak slip of the block"),
    "attached_drift": ("m", "peak drift with the block attached"),
}

PLATFORM_BAND_COLUMNS: Final[dict[str, tuple[str, str]]] = {
    **_COMPONENT,
    "mass_ratio": PLATFORM_RUN_COLUMNS["mass_ratio"],
    "time": ("s", "time of the model, start of a window as long as figures need"),
    "low": ("m", "least drift in the window over all friction coefficients and damping ratios"),
    "high": ("m", "largest drift in the window"),
    "central": ("m", "drift with the central values, at the time"),
    "attached": ("m", "drift with the block attached, at the time"),
}

TABLES: Final[dict[str, tuple[str, dict[str, tuple[str, str]]]]] = {
    "responses": ("one row per building, model, motion and storey", RESPONSE_COLUMNS),
    "summary": ("one row per building and storey", SUMMARY_COLUMNS),
    "fractions": ("one row per building", FRACTION_COLUMNS),
    "designs": ("one row per building and storey", DESIGN_COLUMNS),
    "scaling": ("one row per motion", SCALING_COLUMNS),
    "spectrum": ("one row per period", SPECTRUM_COLUMNS),
    "sensitivity": (
        "one row per setting, occupancy and friction coefficient; written by `--sensitivity`",
        SENSITIVITY_COLUMNS,
    ),
    "claims": ("one row per claim of the paper", CLAIM_COLUMNS),
    "section4_runs": (
        "the paper's section 4: one row per component, second slope and peak of the record",
        SECTION4_RUN_COLUMNS,
    ),
    "section4_differences": (
        "one row per component, second slope, program and setting",
        SECTION4_DIFFERENCE_COLUMNS,
    ),
    "section4_histories": (
        "one row per component, second slope, program and instant",
        SECTION4_HISTORY_COLUMNS,
    ),
    "platform_runs": (
        "the paper's shaking table: one row per component, mass ratio, period, friction coefficient, damping ratio and "
        "amplitude",
        PLATFORM_RUN_COLUMNS,
    ),
    "platform_bands": ("one row per component, mass ratio and window of time", PLATFORM_BAND_COLUMNS),
}
"""What a row of each table is, and its columns with unit ("" where there is none, "1" for ratios) and meaning."""


def units_of(table: str, columns: list[str]) -> dict[str, str]:
    """Return the unit of each column of a table."""
    known: dict[str, Any] = TABLES[table][1]
    return {name: known[name if name in known else "motion_*"][0] for name in columns}
