"""What a study lets one choose: friction, damping base, fractions, P-Delta, code; and what it says of sensitivity."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass import cli
from seismass.base.statistics import quantile
from seismass.base.units import STANDARD_GRAVITY
from seismass.show.study.answer import findings_text
from seismass.show.study.figures import sensitivity_figure, slip_demand, study_figures
from seismass.show.study.tables import completed
from seismass.show.study.write import sensitivity_markdown, sensitivity_text, write_study
from seismass.studies.study import MODELS, StudyParameters, StudyResult, run_study, study_sensitivity
from seismass.studies.study.run import OWN_TABLES
from seismass.studies.study.sensitivity import MATCHED_TOLERANCE
from seismass.studies.study.tables import SHARES, TABLES, findings
from seismass.studies.validation import validate

TARGET = sm.TargetSpectrum.asce7()
SMALL = StudyParameters(buildings=((2, 0.38), (3, 0.47)), response_modification=(1.0, 4.0), mass_ratios=(1.0,))
ONE = StudyParameters(
    buildings=((3, 0.47),), response_modification=(4.0,), mass_ratios=(1.0,), occupancies=(("storage", 0.25),)
)


def quickly_matched() -> sm.Suite:
    """Three motions, as few as ASCE 7-10 allows, that are matched to the target in two or three passes."""
    motions = sm.builtin_suite("seven")
    return sm.Suite("three", (motions[0], motions[3], motions[6]))


@pytest.fixture(scope="module")
def small() -> StudyResult:
    return run_study(sm.builtin_suite("seven"), TARGET, SMALL)


def rows_of(result: StudyResult, model: str, **keys: object) -> pl.DataFrame:
    return result.responses.filter(model=model, **keys).sort("building", "motion", "storey")


def test_friction_is_an_axis_whose_parts_are_studies_of_their_own(small: StudyResult) -> None:
    both = run_study(sm.builtin_suite("seven"), TARGET, replace(SMALL, mu=(0.4, 0.2)))
    counts = both.metadata["counts"]
    # The 6 real scenes once more; models without blocks are the same for every mu.
    assert (counts["buildings"], counts["distinct"]) == (16, small.metadata["counts"]["distinct"] + 6 * 7)
    # The first coefficient's buildings have the numbers that they have alone, and rows of the same bits.
    first = both.responses.filter(mu=0.4)
    assert first.drop("run").equals(small.responses.drop("run"))
    assert both.summary.filter(mu=0.4).equals(small.summary)
    low = both.summary.filter(mu=0.2)
    for name in ("mean_peak_drift_code", "mean_peak_drift_attached", "ratio_mass"):
        assert low[name].to_list() == small.summary[name].to_list()
    assert not low["ratio_sliding"].equals(small.summary["ratio_sliding"])
    assert [entry["mu"] for entry in findings(both.summary, both.fractions)] == [0.4, 0.4, 0.2, 0.2]
    assert "storage, mu = 0.2 (code: 25 % of the live load)" in findings_text(findings(both.summary, both.fractions))


def test_figures_of_several_frictions_are_named_after_them() -> None:
    result = run_study(sm.builtin_suite("seven"), TARGET, replace(ONE, mu=(0.4, 0.2)))
    names = [
        "spectrum",
        *(f"{name}_mu{mu}" for mu in (0.2, 0.4) for name in ("underestimation", "heat", "slip", "drift_R4")),
    ]
    figures = study_figures(result)
    assert list(figures) == names
    assert "\u03bc = 0.2;" in figures["drift_R4_mu0.2"].get_supxlabel()


def test_figures_show_the_three_models_and_say_what_they_depend_on(small: StudyResult) -> None:
    figure = study_figures(small)["drift_R4"]
    here = small.summary.filter(R=4.0, storeys=2, occupancy="storage").sort("storey")
    drawn = [np.asarray(line.get_xdata()) for line in figure.axes[0].lines]
    expected = [1e3 * here[f"mean_peak_drift_{model}"].to_numpy() for model in ("code", "attached", "real")]
    np.testing.assert_array_equal(drawn, expected)
    styles = {(line.get_linestyle(), line.get_marker()) for line in figure.axes[0].lines}
    assert len(styles) == 3
    caption = " ".join(figure.get_supxlabel().split())
    assert "damping 5 % in the modes of the bare building, one C for all models" in caption
    assert f"target: {TARGET.label}" in caption
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert any("ASCE/SEI 7-10" in text for text in texts)


def test_lambda_of_design_and_analysis_are_separate() -> None:
    suite = sm.builtin_suite("seven")
    both = run_study(suite, TARGET, ONE)
    glued = run_study(suite, TARGET, replace(ONE, occupancies=(("storage", 0.25, 1.0),)))
    bare = run_study(suite, TARGET, replace(ONE, occupancies=(("storage", 0.0, 0.25),)))
    # The design sets the strength, and with it the real building; the analysis the code model alone.
    assert glued.designs["yield_shear_over_weight"].equals(both.designs["yield_shear_over_weight"])
    assert (
        rows_of(glued, "real")
        .drop("lambda_analysis", "run")
        .equals(rows_of(both, "real").drop("lambda_analysis", "run"))
    )
    assert glued.designs["design_mass_ratio"].to_list() == [1.25, 1.25, 1.0]
    assert glued.designs["analysis_mass_ratio"].to_list() == [2.0, 2.0, 1.0]
    assert glued.summary["ratio_mass"].to_list() == [1.0, 1.0, 1.0]
    assert (bare.designs["yield_shear_over_weight"] < both.designs["yield_shear_over_weight"]).all()
    assert bare.designs["analysis_mass_ratio"].to_list() == [1.25, 1.25, 1.0]
    assert bare.metadata["parameters"]["occupancies"] == (("storage", 0.0, 0.25),)
    text = findings_text(findings(bare.summary, bare.fractions))
    assert text.startswith("storage (code: 0 % of the live load in the design, 25 % in the analysis)")


@pytest.mark.parametrize("base", ["bare", "loaded", "own"])
def test_damping_base_is_the_matrix_of_the_building_it_names(base: str) -> None:
    """Each model against a run of the scene with C written out: M Phi diag(2 zeta w) Phi^T M by numpy."""
    suite = sm.builtin_suite("seven")
    result = run_study(suite, TARGET, replace(ONE, damping_base=base))
    bare = sm.Building.uniform(3, 0.47, mass=1.0)
    goods = np.array([1.0, 1.0, 0.0])
    attached = {"real": 0.0, "code": 0.25, "attached": 1.0}
    strength = result.designs.sort("storey")["yield_shear_over_weight"].to_numpy() * bare.weight
    motion = suite[0].scaled(result.scaling.factors[0])
    for model in MODELS:
        own = bare.mass + attached[model] * goods
        damped = {"bare": bare.mass, "loaded": bare.mass + goods, "own": own}[base]
        building = sm.Building(own, bare.stiffness, yield_shear=strength, damping=modal_matrix(damped, bare.stiffness))
        blocks = sm.blocks_on_floors(goods, 0.4) if model == "real" else []
        expected = sm.simulate(sm.Scene(building, blocks), motion).peak_drift
        # Strengths and C went through other operations: rounding, grown by yielding.
        np.testing.assert_allclose(rows_of(result, model, motion=1)["peak_drift"], expected, rtol=1e-9)


def modal_matrix(mass: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
    """Damping matrix with 5 % of critical in every mode, by a dense eigenvalue problem."""
    k = np.diag(stiffness + np.append(stiffness[1:], 0.0)) - np.diag(stiffness[1:], 1) - np.diag(stiffness[1:], -1)
    root = np.sqrt(mass)
    squares, vectors = np.linalg.eigh(k / np.outer(root, root))
    return np.outer(root, root) * (vectors @ np.diag(2.0 * 0.05 * np.sqrt(squares)) @ vectors.T)


def test_eta_and_the_rule_are_those_of_the_attached_model(small: StudyResult) -> None:
    for number in (1, 4, 8):
        row = small.fractions.filter(building=number).row(0, named=True)
        shear = rows_of(small, "attached", building=number, storey=1)["peak_shear_over_weight"].mean()
        # Over the weight of building and goods: goods of alpha = 1 on every floor but the roof.
        coefficient = shear * row["storeys"] / (2 * row["storeys"] - 1)
        assert row["base_shear_coefficient"] == pytest.approx(coefficient, rel=1e-12)
        assert row["eta"] == pytest.approx(0.4 / coefficient, rel=1e-12)
        assert row["estimate"] == pytest.approx(min(1.0, 1.35 * 0.4 / row["coefficient"] - 0.15), rel=1e-12)
    assert small.fractions["effective"].null_count() == small.fractions.height


def test_effective_fraction_is_that_of_the_scene_alone() -> None:
    suite = sm.builtin_suite("seven")
    result = run_study(suite, TARGET, replace(ONE, mu=(0.2,)), effective=True)
    row = result.fractions.row(0, named=True)
    strength = result.designs.sort("storey")["yield_shear_over_weight"].to_numpy()
    building = sm.Building.uniform(3, 0.47, yield_shear_over_weight=strength)
    scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], 0.2))
    records = [record.scaled(factor) for record, factor in zip(suite, result.scaling.factors, strict=True)]
    alone = sm.effective_mass(scene, records, fractions=SHARES)
    # 0.664895716 by an independent leapfrog to its order: this building is a case of the definition's own table.
    assert row["effective"] == pytest.approx(alone.value, abs=1e-7)
    assert row["effective"] == pytest.approx(0.664895716, abs=1e-7)
    assert row["kind"] == alone.kind == "root"
    assert alone.interval is not None
    assert (row["low"], row["high"]) == pytest.approx(alone.interval, abs=1e-7)
    assert row["eta"] == pytest.approx(0.773134, abs=1e-6)
    assert "effective fraction" in findings_text(findings(result.summary, result.fractions))
    assert "effective" in study_figures(result)


def test_p_delta_has_the_same_weight_in_all_models() -> None:
    suite = sm.builtin_suite("seven")
    chosen = replace(ONE, p_delta=True, height=4.0, response_modification=(2.0,))
    result, without = run_study(suite, TARGET, chosen), run_study(suite, TARGET, replace(chosen, p_delta=False))
    bare = sm.Building.uniform(3, 0.47, mass=1.0)
    # Weight above each storey: three floors and the goods of two, two and one, one.
    geometric = STANDARD_GRAVITY * np.array([5.0, 3.0, 1.0]) / 4.0
    designs = result.designs.sort("storey")
    np.testing.assert_allclose(designs["geometric_stiffness_ratio"], geometric / bare.stiffness, rtol=1e-12)
    assert without.designs["geometric_stiffness_ratio"].to_list() == [0.0, 0.0, 0.0]
    strength = designs["yield_shear_over_weight"].to_numpy() * bare.weight
    building = sm.Building(
        [1.25, 1.25, 1.0],
        bare.stiffness,
        yield_shear=strength,
        damping=bare.damping_matrix,
        geometric_stiffness=geometric,
    )
    expected = sm.simulate(sm.Scene(building), suite[0].scaled(result.scaling.factors[0]))
    rows = rows_of(result, "code", motion=1)
    np.testing.assert_allclose(rows["peak_drift"], expected.peak_drift, rtol=1e-9)
    np.testing.assert_allclose(rows["peak_drift_ratio"], rows["peak_drift"] / 4.0, rtol=1e-15)


def test_collapsed_runs_are_counted_and_count_their_peaks_until_then() -> None:
    suite = sm.builtin_suite("seven")
    free = run_study(suite, TARGET, ONE)
    drifts = rows_of(free, "real", storey=1)["peak_drift"].to_numpy()
    limit = float(np.sort(drifts)[-2:].mean()) / 3.5  # between the largest drift and the one before
    result = run_study(suite, TARGET, replace(ONE, collapse_drift_ratio=limit))
    row = result.summary.filter(storey=1).row(0, named=True)
    collapsed = int((drifts > 3.5 * limit).sum())
    assert row["collapses_real"] == collapsed == 1
    assert rows_of(result, "real", storey=1)["status"].to_list().count("collapsed") == 1
    # The others are below the limit and unchanged; a cap below both changes more of them.
    until = np.minimum(drifts, 3.5 * limit)
    assert row["mean_peak_drift_real"] == pytest.approx(until.mean(), rel=1e-9)
    assert row["p84_peak_drift_real"] == pytest.approx(np.quantile(until, 0.84), rel=1e-9)
    cap = float(np.median(drifts)) / 3.5
    below = run_study(suite, TARGET, replace(ONE, drift_cap=cap)).summary.filter(storey=1).row(0, named=True)
    assert below["collapses_real"] == 0
    assert below["mean_peak_drift_real"] == pytest.approx(np.minimum(drifts, 3.5 * cap).mean(), rel=1e-12)
    assert "collapsed runs            real 1," in findings_text(findings(result.summary, result.fractions))
    json.dumps(findings(result.summary, result.fractions), allow_nan=False)


def test_no_mean_over_buildings_is_of_fewer_buildings(small: StudyResult) -> None:
    lost = (pl.col("R") == 4.0) & (pl.col("storeys") == 3) & (pl.col("occupancy") == "storage")
    columns = ("underestimation_percent", "ratio", "ratio_mass", "ratio_sliding")
    summary = small.summary.with_columns(pl.when(~lost).then(name).alias(name) for name in columns)
    storage, commercial = findings(summary, small.fractions)
    (at_r4,) = (row for row in storage["first_storey"] if row["R"] == 4.0)
    assert at_r4["underestimation_percent"] is at_r4["mass_percent"] is None
    assert at_r4["eta"] is not None
    assert all(row["underestimation_percent"] is not None for row in commercial["first_storey"])


def test_quantiles_of_infinite_values() -> None:
    values = np.array([[3.0, np.inf, 1.0, 2.0], [np.inf, np.inf, 1.0, 2.0], [np.nan, 1.0, 2.0, 3.0]])
    np.testing.assert_array_equal(quantile(values, 0.5), [2.5, np.inf, np.nan])
    np.testing.assert_array_equal(quantile(values, 1.0), [np.inf, np.inf, np.nan])
    np.testing.assert_array_equal(quantile(values, 1.0 / 3.0), [2.0, 2.0, np.nan])


def test_any_code_takes_the_place_of_asce() -> None:
    result = run_study(sm.builtin_suite("seven"), TARGET, replace(SMALL, code="ec8"))
    storage, ordinary = (sm.codes.code_fraction("ec8", use) for use in ("storage", "ordinary"))
    assert result.metadata["code"]["name"] == storage.code
    assert result.metadata["code"]["fractions"]["storage"]["status"] == storage.status
    shares = dict(result.summary.select("occupancy", "lambda_analysis").unique().rows())
    assert shares == {"storage": storage.fraction, "commercial": ordinary.fraction}
    # A code that says nothing of ordinary buildings has none.
    racks = StudyParameters(code="asce7-10-racks")
    assert racks.fractions == (("storage", 0.67, 0.67),)
    own = run_study(sm.builtin_suite("seven"), TARGET, ONE)
    assert own.metadata["code"] == {"id": None, "name": "code", "fractions": {}}


def test_files_carry_what_their_numbers_depend_on(small: StudyResult, tmp_path: Path) -> None:
    sensitivity = study_sensitivity(quickly_matched(), TARGET, ONE)
    validation = validate(study=small, sensitivity=sensitivity)
    files = write_study(completed(small, sensitivity=sensitivity, validation=validation), tmp_path, figures=False)
    tables = sorted(file for file in files if file.suffix == ".parquet")
    assert [file.stem for file in tables] == sorted(TABLES)
    document = json.loads((tmp_path / "tables.json").read_text())
    for file in tables:
        found = pl.read_parquet_metadata(file)
        assert json.loads(found["seismass.schema_version"]) == 5
        assert json.loads(found["seismass.package_version"]) == sm.__version__
        assert json.loads(found["seismass.inputs_sha256"]) == small.metadata["inputs_sha256"]
        assert json.loads(found["seismass.target"])["label"] == TARGET.label
        parameters = json.loads(found["seismass.parameters"])
        assert [parameters[name] for name in ("second_slope", "overstrength", "damping", "damping_base")] == [
            0.05,
            2.0,
            0.05,
            "bare",
        ]
        columns = pl.read_parquet(file).columns
        units = json.loads(found["seismass.units"])
        assert list(units) == columns
        described = document["tables"][file.stem]["columns"]
        assert list(described) == columns == pl.read_csv(file.with_suffix(".csv"), n_rows=1).columns
        assert {name: column["unit"] for name, column in described.items()} == units
        assert all(column["meaning"] for column in described.values())
    assert json.loads(pl.read_parquet_metadata(tmp_path / "responses.parquet")["seismass.units"])["peak_drift"] == "m"
    assert document["parameters"]["second_slope"] == 0.05
    # A study without it leaves no table of another one behind.
    write_study(small, tmp_path, figures=False)
    assert {file.stem for file in tmp_path.glob("*.parquet")} == {*OWN_TABLES}


def test_remarks_on_inputs_are_kept_and_printed_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    result = run_study(sm.builtin_suite("seven"), TARGET, replace(SMALL, mu=(40.0,)))
    assert result.metadata["remarks"] == [
        "mu_s of block 1 is 40, above 1.5: friction coefficients are ratios, not per cent",
        "mu_s of block 1 is 40, above 1.5 (and 1 more): friction coefficients are ratios, not per cent",
    ]
    assert cli.main(["study", "--out", str(tmp_path), "--no-figures", "--sds", "107", "--sd1", "61"]) == 0
    assert capsys.readouterr().out.count("S_DS of the target spectrum is 107 g, above 4 g") == 1


def test_sensitivity_changes_one_choice_at_a_time() -> None:
    suite = quickly_matched()
    chosen = replace(SMALL, response_modification=(1.0, 4.0))
    seen: list[tuple[int, int]] = []
    result = study_sensitivity(suite, TARGET, chosen, progress=lambda done, total: seen.append((done, total)))
    table = result.table.filter(occupancy="storage")
    assert list(table.columns) == list(TABLES["sensitivity"][1])
    assert seen[-1] == (len(seen), len(seen))

    def row(choice: str, setting: str) -> dict:
        (found,) = table.filter(choice=choice, setting=setting).to_dicts()
        return found

    def headline(study: StudyResult, name: str = "underestimation_percent") -> float:
        return study.summary.filter(storey=1, occupancy="storage", R=4.0)[name].mean()

    base = run_study(suite, TARGET, chosen)
    as_is = row("as it is", "")
    assert as_is["most_R_percent"] == pytest.approx(headline(base), rel=1e-12)
    first = base.summary.filter(storey=1, occupancy="storage")
    assert as_is["largest_percent"] == pytest.approx(first["underestimation_percent"].max(), rel=1e-12)
    assert as_is["sliding_percent"] == pytest.approx(100.0 * headline(base, "ratio_sliding") - 100.0, rel=1e-9)
    for choice, setting, changes in (
        ("r2", "0.1", {"second_slope": 0.1}),
        ("r3", "0.05, as r2", {"third_slope": 0.05}),
        ("Omega", "1", {"overstrength": 1.0}),
        ("combination", "CQC", {"combination": "cqc"}),
        ("damping base", "own", {"damping_base": "own"}),
        ("scaling period", "0.5 s", {"scaling_period": 0.5}),
    ):
        expected = headline(run_study(suite, TARGET, replace(chosen, **changes)))
        assert row(choice, setting)["most_R_percent"] == pytest.approx(expected, rel=1e-12), choice
    expected = headline(run_study(suite, TARGET.tilted(0.3), chosen))
    assert row("target shape", "times (T/1 s)^0.3")["most_R_percent"] == pytest.approx(expected, rel=1e-12)
    mps = sm.scaling.scale_modal_pushover(suite, TARGET, period=chosen.scaling_period, reduction=4.0)
    expected = headline(run_study(suite, TARGET, chosen, scaling=mps))
    assert row("motions", "modal pushover, R_y = 4")["most_R_percent"] == pytest.approx(expected, rel=1e-12)
    matched = sm.matching.match_suite(suite, TARGET, periods=(0.2, 1.5), tolerance=MATCHED_TOLERANCE)
    assert all(one.converged for one in matched)
    expected = headline(run_study(matched.suite, TARGET, chosen))
    assert row("motions", "matched, 10 %, 0.2 to 1.5 s")["most_R_percent"] == pytest.approx(expected, rel=1e-12)
    medians = base.summary.filter(storey=1, occupancy="storage", R=4.0)
    ratio = medians["median_peak_drift_real"] / medians["median_peak_drift_code"]
    assert row("statistic", "median")["most_R_percent"] == pytest.approx(100.0 * (ratio.mean() - 1.0), rel=1e-12)
    geometric = headline(base, "geometric_mean_underestimation_percent")
    assert row("statistic", "geometric mean")["most_R_percent"] == pytest.approx(geometric, rel=1e-10)
    # R = 1 changes the elastic buildings alone.
    assert row("R = 1", "yields at V_e")["most_R_percent"] == as_is["most_R_percent"]
    assert row("R = 1", "yields at V_e")["least_R_percent"] != as_is["least_R_percent"]
    assert table["choice"].to_list().count("one record left out") >= 1
    text = sensitivity_text(result.table)
    assert "loaded, of the code model its own" in text
    assert sensitivity_markdown(result.table).count("| choice | setting |") == 2


def test_a_study_takes_factors_of_another_scaling() -> None:
    """The same factors give the same drifts; other factors, another digest; a wrong number of them is refused."""
    suite = sm.builtin_suite("seven")
    own = run_study(suite, TARGET, SMALL)
    scaling = sm.scaling.scale_asce7_10(suite, TARGET, SMALL.scaling_period, between=False)
    given = run_study(suite, TARGET, SMALL, scaling=scaling)
    assert given.responses.equals(own.responses)
    other = run_study(suite, TARGET, SMALL, scaling=sm.scaling.scale_asce7_10(suite, TARGET, 0.5, between=False))
    assert other.responses.equals(run_study(suite, TARGET, replace(SMALL, scaling_period=0.5)).responses)
    assert other.metadata["inputs_sha256"] != given.metadata["inputs_sha256"]
    with pytest.raises(
        sm.errors.InvalidOption, match="scaling of study must be a ScalingResult of 7 motions; got one of 3"
    ):
        run_study(suite, TARGET, SMALL, scaling=sm.scaling.scale_asce7_10(suite[:3], TARGET))


def test_commands_of_the_choices(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["study", "--out", str(tmp_path), "--no-figures", "--occupancy", "archive:0.25:1", "--mu", "0.2,0.4"]
    options = ["--damping-base", "loaded", "--height", "3", "--p-delta", "--collapse-drift-ratio", "0.2", "--json"]
    assert cli.main([*arguments, *options]) == 0
    parameters = json.loads(capsys.readouterr().out)["parameters"]
    assert parameters["occupancies"] == [["archive", 0.25, 1.0]]
    assert parameters["mu"] == [0.2, 0.4]
    assert (parameters["damping_base"], parameters["height"], parameters["p_delta"]) == ("loaded", 3.0, True)
    assert parameters["collapse_drift_ratio"] == 0.2


def test_slip_drawn_is_that_of_the_floor_that_slides_most(small: StudyResult) -> None:
    """Statistics over the motions of the largest peak slip of any floor, and the residual slip there."""
    responses = small.responses.filter(model="real").drop_nulls("peak_slip")
    for row in slip_demand(small.responses).iter_rows(named=True):
        keys = {name: row[name] for name in ("building", "occupancy", "R", "alpha", "mu")}
        peaks, residuals = [], []
        for _, floors in responses.filter(**keys).sort("storey").group_by("motion", maintain_order=True):
            place = int(np.argmax(floors["peak_slip"]))
            peaks.append(floors["peak_slip"][place])
            residuals.append(abs(floors["residual_slip"][place]))
        assert len(peaks) == 7
        expected = [np.mean(peaks), np.quantile(peaks, 0.16), np.quantile(peaks, 0.84), max(peaks), np.mean(residuals)]
        found = [row[name] for name in ("mean", "p16", "p84", "largest", "residual")]
        assert found == pytest.approx(expected, rel=1e-12, abs=1e-15)
        assert row["slides"] == np.count_nonzero(peaks)


@pytest.mark.parametrize("frictions", [[0.3], [0.3, 0.5]])
def test_the_figure_of_choices_names_the_friction_where_there_are_several(frictions: list[float]) -> None:
    """One line and one row of dots per occupancy and friction; a row per setting, the study as it is above."""
    settings = [("as it is", ""), ("damping", "bare"), ("damping", "full")]
    rows = [
        {"choice": choice, "setting": setting, "occupancy": use, "mu": mu, "largest_percent": 10.0 * place + 7.0 * mu}
        for use in ("storage", "office")
        for mu in frictions
        for place, (choice, setting) in enumerate(settings)
    ]
    figure = sensitivity_figure(pl.DataFrame(rows))
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    several = len(frictions) > 1
    assert labels == [f"{use}, μ = {mu:g}" if several else use for use in ("storage", "office") for mu in frictions]
    (axes,) = figure.axes
    dots = [line for line in axes.lines if line.get_linestyle() == "None"]
    assert len(dots) == len(labels)
    for line, mu in zip(dots, 2 * frictions, strict=True):
        assert line.get_xdata().tolist() == pytest.approx([7.0 * mu, 10.0 + 7.0 * mu, 20.0 + 7.0 * mu])
        assert list(line.get_ydata()) == [0, 1, 2]
    assert [label.get_text() for label in axes.get_yticklabels()] == ["as it is", "damping: bare", "damping: full"]
