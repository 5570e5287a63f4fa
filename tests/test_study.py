"""The parametric study: its counts, its tables against the kernel, its files, and its command."""

import hashlib
import itertools
import json
import re
import statistics
from dataclasses import replace
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass import cli
from seismass.base.folders import list_sha256
from seismass.motions.spectra import mean_spectrum
from seismass.show.study import write
from seismass.show.study.answer import findings_text, suite_caption
from seismass.show.study.figures import study_figures
from seismass.studies.study import StudyParameters, StudyResult, run_study
from seismass.studies.study.run import display_names
from seismass.studies.study.tables import findings

TARGET = sm.TargetSpectrum.asce7()
SMALL = StudyParameters(buildings=((2, 0.38), (3, 0.47)), response_modification=(1.0, 4.0), mass_ratios=(1.0,))


@pytest.fixture(scope="module")
def full() -> StudyResult:
    return run_study(sm.builtin_suite("seven"), TARGET)


@pytest.fixture(scope="module")
def small() -> StudyResult:
    return run_study(sm.builtin_suite("seven"), TARGET, SMALL)


def test_equal_runs_are_solved_once(full: StudyResult) -> None:
    counts = full.metadata["counts"]
    # 72 buildings x 3 models x 7 motions. Different scenes: real and attached 9 elastic ones (storeys, alpha) each,
    # which storage and commercial share, and 54 that yield (x R, x occupancy); code 9 + 27 storage, 3 + 9 commercial.
    assert (counts["buildings"], counts["analyses"], counts["distinct"]) == (72, 1512, 7 * (63 + 63 + 48))
    assert counts["completed"] == 1218
    assert full.responses["run"].unique().sort().to_list() == list(range(1, 1219))


def test_yielding_at_r1_makes_buildings_of_two_occupancies_differ() -> None:
    counts = run_study(sm.builtin_suite("seven"), TARGET, StudyParameters(yield_at_r1=True)).metadata["counts"]
    # 72 real, 72 attached, 36 code models of storage and 12 of commercial buildings.
    assert (counts["analyses"], counts["distinct"]) == (1512, 7 * (72 + 72 + 48))


def test_two_equal_motions_count_once() -> None:
    records = list(sm.builtin_suite("seven"))
    suite = sm.Suite("twice", (*records[:2], records[0], records[0]))
    counts = run_study(suite, TARGET, SMALL).metadata["counts"]
    # Of 8 buildings the real and attached scenes are 2 (R = 1) + 4, the code scenes 4 + 4; 2 of 4 motions differ.
    assert (counts["analyses"], counts["distinct"]) == (8 * 3 * 4, (6 + 6 + 8) * 2)


def test_tables_have_a_row_per_building_model_motion_and_storey(full: StudyResult) -> None:
    storeys = 24 * (2 + 3 + 4)
    assert full.responses.height == storeys * 3 * 7
    assert full.summary.height == full.designs.height == storeys
    assert full.fractions.height == 72
    keys = ["building", "model", "motion", "storey"]
    assert full.responses.select(keys).is_duplicated().sum() == 0
    assert full.responses.select(pl.col("peak_drift").is_finite().all()).item()


def test_rows_are_what_the_kernel_gives_for_the_scene_built_by_hand(full: StudyResult) -> None:
    suite = sm.builtin_suite("seven")
    factors = full.scaling.factors
    bare = sm.Building.uniform(3, 0.47, mass=1.0)
    share = np.array([0.25 * 1.5, 0.25 * 1.5, 0.0])
    design = full.designs.filter(occupancy="storage", storeys=3, R=4.0, alpha=1.5).sort("storey")
    strength = design["yield_shear_over_weight"].to_numpy() * bare.weight
    ratios = [1.5, 1.5, 0.0]
    yielding = bare.replace(yield_shear=strength, overstrength=2.0, second_slope=0.05, third_slope=0.0, damping=0.05)
    matrix = bare.damping_matrix  # of the bare building, for all models
    scenes = {
        "real": sm.Scene(yielding, sm.blocks_on_floors(ratios, 0.4)),
        "code": sm.Scene(yielding.replace(mass=bare.mass + share, damping=matrix)),
        "attached": sm.Scene(yielding.replace(mass=bare.mass + ratios, damping=matrix)),
    }
    for model, scene in scenes.items():
        rows = full.responses.filter(occupancy="storage", storeys=3, R=4.0, alpha=1.5, model=model, motion=2)
        response = sm.simulate(scene, suite[1].scaled(factors[1]))
        # The strengths went through a division by the weight and back.
        np.testing.assert_allclose(rows.sort("storey")["peak_drift"], response.peak_drift, rtol=1e-9)
        slips = rows.sort("storey")["peak_slip"].to_list()
        if model == "real":
            assert slips[:2] == pytest.approx(response.peak_slip, rel=1e-9)
            assert slips[2] is None
        else:
            assert slips == [None, None, None]


def test_strength_is_the_elastic_shear_over_r(full: StudyResult) -> None:
    designs = full.designs.filter(pl.col("R") > 1.0)
    np.testing.assert_allclose(
        designs["yield_shear_over_weight"], designs["elastic_shear_over_weight"] / designs["R"], rtol=1e-14
    )
    assert full.designs.filter(R=1.0)["yield_shear_over_weight"].null_count() == 2 * 3 * 9
    # Spectral acceleration is evaluated at the period of the design model, here the last mode of each building.
    row = designs.filter(occupancy="storage", storeys=4, alpha=1.5, R=2.0).sort("storey")
    suite = list(sm.builtin_suite("seven"))
    expected = mean_spectrum(suite, full.scaling.factors, row["design_period"])
    np.testing.assert_allclose(row["spectral_acceleration"], expected, rtol=1e-14)
    assert row["design_period"][0] == pytest.approx(0.6286, abs=0.5e-4)  # lambda alpha = 0.375
    assert row["design_mass_ratio"].to_list() == [1.375, 1.375, 1.375, 1.0]


def test_commercial_code_model_does_not_depend_on_alpha(full: StudyResult) -> None:
    rows = full.summary.filter(occupancy="commercial").group_by("storeys", "R", "storey")
    assert rows.agg(pl.col("mean_peak_drift_code").n_unique())["mean_peak_drift_code"].max() == 1


def test_summary_holds_means_over_motions_and_their_ratio(full: StudyResult) -> None:
    row = full.summary.filter(occupancy="commercial", storeys=2, R=6.0, alpha=0.5, storey=1).row(0, named=True)
    rows = full.responses.filter(occupancy="commercial", storeys=2, R=6.0, alpha=0.5, storey=1)
    models = [rows.filter(model=model).sort("motion") for model in ("real", "code", "attached")]
    drifts = [frame["peak_drift"].to_numpy() for frame in models]
    real, code, attached = (values.mean() for values in drifts)
    assert row["mean_peak_drift_real"] == pytest.approx(real, rel=1e-14)
    assert row["mean_peak_drift_code"] == pytest.approx(code, rel=1e-14)
    assert row["mean_peak_drift_attached"] == pytest.approx(attached, rel=1e-14)
    assert row["underestimation_percent"] == pytest.approx(100.0 * (real - code) / code, rel=1e-12)
    assert row["ratio"] == pytest.approx(row["ratio_mass"] * row["ratio_sliding"], rel=1e-14)
    assert (row["ratio_mass"], row["ratio_sliding"]) == pytest.approx((attached / code, real / attached), rel=1e-14)
    assert row["motions"] == 7
    # Scatter, by numpy's and the standard library's own functions.
    each = 100.0 * (drifts[0] / drifts[1] - 1.0)
    for name, share in (("median", 0.5), ("p16", 0.16), ("p84", 0.84)):
        assert row[f"{name}_peak_drift_real"] == pytest.approx(np.quantile(drifts[0], share), rel=1e-12)
        assert row[f"{name}_underestimation_percent"] == pytest.approx(np.quantile(each, share), rel=1e-12)
    geometric = [statistics.geometric_mean(values) for values in drifts]
    assert row["geometric_mean_peak_drift_attached"] == pytest.approx(geometric[2], rel=1e-12)
    expected = 100.0 * (geometric[0] / geometric[1] - 1.0)
    assert row["geometric_mean_underestimation_percent"] == pytest.approx(expected, rel=1e-10)
    assert row["mean_peak_drift_ratio_real"] == pytest.approx(real / 3.5, rel=1e-14)
    # One motion left out, each in turn.
    without = [
        100.0 * (np.delete(drifts[0], motion).mean() / np.delete(drifts[1], motion).mean() - 1.0) for motion in range(7)
    ]
    most = int(np.argmax(np.abs(np.array(without) - row["underestimation_percent"])))
    assert row["leave_one_out_motion"] == most + 1
    assert row["leave_one_out_record"] == models[0]["record"][most]
    assert row["leave_one_out_percent"] == pytest.approx(without[most], rel=1e-10)


def test_no_friction_is_the_commercial_rule() -> None:
    """mu = 0: the blocks are not there for the building, so real and code model with lambda = 0 agree."""
    result = run_study(
        sm.builtin_suite("seven"),
        TARGET,
        StudyParameters(buildings=((2, 0.38),), occupancies=(("commercial", 0.0),), mu=(0.0,)),
    )
    np.testing.assert_allclose(result.summary["underestimation_percent"], 0.0, atol=1e-9)


def test_lambda_of_one_is_the_real_model_where_nothing_slides() -> None:
    """mu too large to slide and lambda = 1: all models carry the whole block, and have the same C but for their own."""
    chosen = StudyParameters(
        buildings=((2, 0.38),), occupancies=(("all", 1.0),), mass_ratios=(1.0,), mu=(1e3,), response_modification=(2.0,)
    )
    for base in ("bare", "loaded"):
        result = run_study(sm.builtin_suite("seven"), TARGET, replace(chosen, damping_base=base))
        # Masses, stiffness and C are the same numbers up to rounding of C.
        np.testing.assert_allclose(result.summary["ratio_sliding"], 1.0, atol=1e-12)
        assert result.summary["ratio_mass"].to_list() == [1.0, 1.0]
        assert result.summary["mean_peak_slip"].drop_nulls().to_list() == [0.0]
    own = run_study(sm.builtin_suite("seven"), TARGET, replace(chosen, damping_base="own"))
    # C of the heavier models is larger: the real building drifts more than the same building glued.
    assert (own.summary["ratio_sliding"] > 1.001).all()


def test_threads_change_no_digit(small: StudyResult) -> None:
    again = run_study(sm.builtin_suite("seven"), TARGET, SMALL, threads=1)
    assert again.responses.equals(small.responses)
    assert again.summary.equals(small.summary)
    assert again.metadata == small.metadata


def test_digest_depends_on_motions_target_and_parameters(small: StudyResult) -> None:
    records = list(sm.builtin_suite("seven"))
    others = [
        run_study(sm.Suite("less", tuple(records[:6])), TARGET, SMALL),
        run_study(sm.builtin_suite("seven"), sm.TargetSpectrum.asce7(1.0), SMALL),
        run_study(sm.builtin_suite("seven"), TARGET, StudyParameters(**{**vars(SMALL), "second_slope": 0.1})),
    ]
    with_vertical = (*records[:6], records[6].with_vertical(records[6].scaled(0.6)))
    others.append(run_study(sm.Suite("vertical", with_vertical), TARGET, SMALL))
    assert not others[-1].summary["ratio"].equals(small.summary["ratio"])
    digests = [result.metadata["inputs_sha256"] for result in (small, *others)]
    assert all(a != b for a, b in itertools.combinations(digests, 2))


def test_a_failed_run_gives_no_mean(small: StudyResult, monkeypatch: pytest.MonkeyPatch) -> None:
    from seismass.studies.study import run as study

    def failing(*args, **kwargs) -> pl.DataFrame:
        table = sm.simulate_many(*args, **kwargs)
        lists = ["peak_drift", "peak_drift_time", "residual_drift", "peak_floor_acceleration", "peak_storey_shear"]
        first = pl.int_range(pl.len()) == 0
        return table.with_columns(
            pl.when(first).then(pl.lit("failed")).otherwise("status").alias("status"),
            *(pl.when(~first).then(name).alias(name) for name in [*lists, "peak_slip", "residual_slip", "slip_path"]),
        )

    monkeypatch.setattr(study, "solve_many", failing)
    result = run_study(sm.builtin_suite("seven"), TARGET, SMALL)
    assert result.metadata["counts"]["failed"] == 1
    # Run 1 is the elastic real model under motion 1, which storage and commercial share.
    missing = result.summary.filter(pl.col("ratio").is_null())
    assert missing["median_peak_drift_real"].null_count() == missing.height == 4
    assert missing["mean_peak_drift_code"].null_count() == 0
    assert missing.select("occupancy", "R", "storeys").unique().sort("occupancy").rows() == [
        ("commercial", 1.0, 2),
        ("storage", 1.0, 2),
    ]
    assert findings(result.summary, result.fractions)[0]["storeys_without_result"] == 2


def as_tables(rows: pl.DataFrame) -> tuple[pl.DataFrame, pl.DataFrame]:
    """Summary and fractions of one occupancy with these underestimations, and nothing else in them that matters."""
    statistics = ("ratio_mass", "ratio_sliding", "leave_one_out_percent")
    scatter = [f"{name}_underestimation_percent" for name in ("median", "p16", "p84")]
    summary = rows.with_columns(
        pl.lit("storage").alias("occupancy"),
        pl.lit(0.4).alias("mu"),
        pl.lit("a record").alias("leave_one_out_record"),
        pl.int_range(1, pl.len() + 1).alias("building"),
        *(pl.lit(0.25).alias(f"lambda_{use}") for use in ("design", "analysis")),
        *(pl.lit(1.5).alias(name) for name in (*statistics, *scatter)),
        *(pl.lit(0).alias(f"collapses_{model}") for model in ("real", "code", "attached")),
    )
    numbers = dict.fromkeys(("eta", "estimate", "effective"), pl.lit(0.5))
    return summary, summary.select("building", **numbers)


def test_findings_are_counted_from_the_summary() -> None:
    rows = [
        # storeys, R, alpha, storey, underestimation (%)
        (2, 2.0, 0.5, 1, 10.0),
        (2, 2.0, 1.0, 1, 30.0),
        (2, 4.0, 0.5, 1, 20.0),
        (2, 4.0, 1.0, 1, 25.0),
        (2, 2.0, 0.5, 2, -5.0),
        (2, 2.0, 1.0, 2, -10.0),
        (2, 4.0, 0.5, 2, 1.0),
        (2, 4.0, 1.0, 2, -50.0),
    ]
    names = ["storeys", "R", "alpha", "storey", "underestimation_percent"]
    (entry,) = findings(*as_tables(pl.DataFrame(rows, schema=names, orient="row").with_columns(period=0.38)))
    assert (entry["storeys_compared"], entry["code_gives_more"], entry["code_gives_more_top"]) == (8, 3, 3)
    assert entry["largest"]["underestimation_percent"] == 30.0
    assert entry["smallest"]["underestimation_percent"] == -50.0
    assert entry["growth"] == {
        "alpha": {"pairs": 4, "grows": 2},
        "R": {"pairs": 4, "grows": 2},
        "alpha_first_storey": {"pairs": 2, "grows": 2},
        "R_first_storey": {"pairs": 2, "grows": 1},
    }
    assert "+30 % (storey 1 of 2, R = 2, alpha = 1)" in findings_text([entry])


def test_rounding_is_no_finding() -> None:
    """mu = 0: real and commercial code model are one building, and its drifts agree to rounding."""
    chosen = StudyParameters(buildings=((2, 0.38),), occupancies=(("commercial", 0.0),), mu=(0.0,))
    result = run_study(sm.builtin_suite("seven"), TARGET, chosen)
    assert (result.summary["underestimation_percent"] != 0.0).any()
    (entry,) = findings(result.summary, result.fractions)
    assert (entry["code_gives_more"], entry["growth"]["alpha"]["grows"], entry["growth"]["R"]["grows"]) == (0, 0, 0)


def one_storey(values: dict[tuple[float, float], float | None]) -> tuple[pl.DataFrame, pl.DataFrame]:
    """Tables of one-storey buildings: underestimation (%) by period and alpha."""
    rows = [(1, period, 2.0, alpha, 1, value) for (period, alpha), value in values.items()]
    names = ["storeys", "period", "R", "alpha", "storey", "underestimation_percent"]
    return as_tables(pl.DataFrame(rows, schema=names, orient="row"))


def test_growth_is_counted_within_each_building() -> None:
    """Two buildings that differ in their period alone: 2 steps of alpha each, the second one's downwards."""
    up = {(0.47, alpha): value for alpha, value in zip((0.5, 1.0, 1.5), (10.0, 20.0, 30.0), strict=True)}
    down = {(0.8, alpha): value for alpha, value in zip((0.5, 1.0, 1.5), (35.0, 25.0, 15.0), strict=True)}
    (entry,) = findings(*one_storey(up | down))
    assert entry["growth"]["alpha"] == {"pairs": 4, "grows": 2}


@pytest.mark.parametrize("missing", [None, np.nan, np.inf])
def test_growth_is_not_counted_over_a_gap(missing: float | None) -> None:
    (entry,) = findings(*one_storey({(0.47, 0.5): 10.0, (0.47, 1.0): missing, (0.47, 1.5): 30.0}))
    assert (entry["storeys_compared"], entry["storeys_without_result"]) == (2, 1)
    assert entry["growth"]["alpha"] == entry["growth"]["alpha_first_storey"] == {"pairs": 0, "grows": 0}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"mu": (-0.1,)}, "mu of study must be zero or positive; got -0.1"),
        ({"mu": (np.nan,)}, "mu of study must be zero or positive; got nan"),
        ({"mu": ("0.4",)}, "mu of study must be a number; got '0.4'"),
        ({"mu": 0.4}, "mu of study must be a tuple of at least one value, none twice; got 0.4"),
        ({"mu": (0.4, 0.4)}, "mu of study must be a tuple of at least one value, none twice; got (0.4, 0.4)"),
        ({"damping_base": "none"}, "damping_base of study must be one of bare, loaded, own; got 'none'"),
        ({"height": 0.0}, "height of study must be a positive number; got 0"),
        ({"p_delta": 1}, "p_delta of study must be True or False; got 1"),
        ({"collapse_drift_ratio": -1.0}, "collapse_drift_ratio of study must be a positive number; got -1"),
        ({"code": "asce"}, "id of code must be one of asce7-10,"),
        ({"occupancies": (("a", 0.25, 1.5),)}, "lambda of study must be between 0 and 1; got 1.5"),
        ({"overstrength": 0.9}, "overstrength of study must be a number of at least 1; got 0.9"),
        ({"overstrength": np.inf}, "overstrength of study must be a number of at least 1; got inf"),
        ({"second_slope": 1.1}, "second_slope of study must be between 0 and 1; got 1.1"),
        ({"third_slope": 0.1}, "third_slope of study must be between 0 and the second slope; got 0.1"),
        ({"damping": 0.0}, "damping of study must be above 0 and below 1; got 0"),
        ({"scaling_period": 0.0}, "scaling_period of study must be a positive number; got 0"),
        ({"combination": "sum"}, "combination of study must be srss or cqc; got 'sum'"),
        ({"response_modification": (0.5,)}, "response_modification of study must be at least 1; got 0.5"),
        ({"response_modification": [1.0]}, "response_modification of study must be a tuple of at least one value"),
        ({"mass_ratios": (0.0,)}, "mass_ratios of study must be positive; got 0"),
        ({"mass_ratios": (1.0, 1.0)}, "mass_ratios of study must be a tuple of at least one value, none twice"),
        ({"buildings": ()}, "buildings of study must be a tuple of at least one value"),
        ({"buildings": ((0, 1.0),)}, "storeys of study must be a whole number of at least 1; got 0"),
        ({"buildings": ((1, -1.0),)}, "period of study must be a positive number; got -1"),
        ({"occupancies": (("all", 1.5),)}, "lambda of study must be between 0 and 1; got 1.5"),
        (
            {"occupancies": (("a", 0.25), ("a", 0.0))},
            "occupancies of study must be a tuple of at least one value, none twice; got (('a', 0.25), ('a', 0.0))",
        ),
        ({"occupancies": ((1, 0.5),)}, "occupancy name of study must be a string; got 1"),
        (
            {"occupancies": ("ab",)},
            "occupancies of study must be a tuple of (name, lambda) or (name, lambda of the design, lambda of",
        ),
        ({"buildings": ((3,),)}, "buildings of study must be a tuple of (storeys, period); got (3,) in it"),
        ({"buildings": (3,)}, "buildings of study must be a tuple of (storeys, period); got 3 in it"),
        ({"buildings": ([3, 0.4],)}, "buildings of study must be a tuple of (storeys, period); got [3, 0.4]"),
        ({"buildings": ((3, 0.4), (3, 0.4))}, "buildings of study must be a tuple of at least one value, none twice"),
        ({"mass_ratios": ([1.0],)}, "mass_ratios of study must be a number; got [1.0]"),
        ({"yield_at_r1": "no"}, "yield_at_r1 of study must be True or False; got 'no'"),
    ],
)
def test_bad_parameters_are_refused(arguments: dict, message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=re.escape(message)):
        StudyParameters(**arguments)


def test_numbers_of_any_kind_are_the_same_parameters() -> None:
    chosen = StudyParameters(
        buildings=((np.int64(2), np.float64(0.38)),), mass_ratios=(np.float32(1.0), 2), damping=np.array(0.05)
    )
    assert chosen == StudyParameters(buildings=((2, 0.38),), mass_ratios=(1.0, 2.0))
    assert json.dumps(chosen.mass_ratios) == "[1.0, 2.0]"


def test_a_suite_is_asked_for() -> None:
    with pytest.raises(sm.errors.InvalidMotion, match="suite of study must be a Suite; got 3"):
        run_study(3, TARGET)  # type: ignore[arg-type]


def test_files_are_written_whole_and_agree(small: StudyResult, tmp_path: Path) -> None:
    out = tmp_path / "deep" / "study"
    files = write.write_study(small, out, png=True)
    assert sorted(files) == sorted(out.iterdir())
    for name, table in (("responses", small.responses), ("summary", small.summary), ("designs", small.designs)):
        assert pl.read_parquet(out / f"{name}.parquet").equals(table)
        assert pl.read_csv(out / f"{name}.csv").height == table.height
    document = json.loads((out / "study.json").read_text())
    assert document["schema_version"] == 5
    assert document["package_version"] == sm.__version__
    assert document["parameters"]["second_slope"] == 0.05
    assert document["instructions"] == sm.runs.instruction_set()
    assert document["suite"]["synthetic"] == 7
    for name in ("spectrum", "underestimation", "heat", "slip", "drift_R1", "drift_R4"):
        assert (out / f"{name}.png").read_bytes().startswith(b"\x89PNG")
        assert (out / f"{name}.svg").read_text().startswith("<?xml")
    assert "synthetic motions" in (out / "drift_R4.svg").read_text()
    before = {file.name: file.read_bytes() for file in files}
    write.write_study(small, out, png=True)
    assert {file.name: file.read_bytes() for file in out.iterdir()} == before


def test_figures_of_an_earlier_study_do_not_stay(
    small: StudyResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    earlier = {"drift_R2.5.svg", "drift_R1e+06.png", "slip_mu0.1.svg"}
    others = {"drift_R_mine.png", "drift_R3.png", "drift_R1.pdf", "notes.txt", "heat_mu9.png", "../outside_heat.png"}
    for name in earlier | others:
        (tmp_path / name).write_text("earlier")
    # What is listed is removed where it has the bytes and the name of a figure; what is not listed is the user's.
    listed = dict.fromkeys([*earlier, "notes.txt", "../outside_heat.png"], hashlib.sha256(b"earlier").hexdigest())
    listed["heat_mu9.png"] = hashlib.sha256(b"changed since").hexdigest()
    document = {"sha256": listed, "sha256_of_list": list_sha256(listed)}
    (tmp_path / "files.json").write_text(json.dumps(document))
    earlier.add("files.json")
    others.remove("../outside_heat.png")

    def failing(*_: object) -> None:
        raise OSError("disk full")

    with monkeypatch.context() as patch:
        patch.setattr("seismass.media.svg.figure_content", failing)
        with pytest.raises(OSError, match="disk full"):
            write.write_study(small, tmp_path, png=True)
    assert {file.name for file in tmp_path.iterdir()} == earlier | others

    files = write.write_study(small, tmp_path, png=True)
    figures = {file.name for file in files if file.suffix in (".png", ".svg")}
    assert figures == {file.name for file in files if write.FIGURE_FILE.fullmatch(file.name)}
    assert {file.name for file in tmp_path.iterdir()} == {file.name for file in files} | others
    tables = write.write_study(small, tmp_path, figures=False)
    assert {file.name for file in tmp_path.iterdir()} == {file.name for file in tables} | others
    assert (tmp_path / "drift_R3.png").read_text() == "earlier"
    assert (tmp_path.parent / "outside_heat.png").read_text() == "earlier"


@pytest.mark.parametrize(
    ("labels", "names"),
    [
        ([("E", "S", "a"), ("E", "S", "b"), ("E", "S", "b"), ("E", "S", "b")], ["E, S", "E, S (b)", "E, S (b) (2)"]),
        ([("", "", "a"), ("", "", "a"), ("", "", "a")], ["a", "a (2)", "a (3)"]),
        ([("", "", "a (2)"), ("", "", "a"), ("", "", "a")], ["a (2)", "a", "a (3)"]),
        ([("", "", ""), ("", "", ""), ("E", "", "")], ["motion 1", "motion 2", "E"]),
    ],
)
def test_names_of_motions_differ(labels: list[tuple[str, str, str]], names: list[str]) -> None:
    suite = sm.Suite("x", tuple(sm.Record([0.0], 0.01, name, event, station) for event, station, name in labels))
    shown = display_names(suite)
    assert shown[: len(names)] == names
    assert len(set(shown)) == len(suite)


def test_recorded_and_synthetic_motions_are_counted_apart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    records = list(sm.builtin_suite("seven"))[:3]
    mixed = sm.Suite("mixed", (*records[:2], records[2].replace(synthetic=False, remarks=("found in a drawer",))))
    result = run_study(mixed, TARGET, SMALL)
    assert result.metadata["suite"]["synthetic"] == 2
    assert result.metadata["suite"]["motions"][2]["remarks"] == ["found in a drawer"]
    says = "3 motions, 2 synthetic and 1 recorded"
    assert suite_caption(result).startswith(f"{says} (mixed), scaled")
    (legend,) = study_figures(result)["spectrum"].legends
    assert legend.get_texts()[0].get_text() == f"mean of {says}, scaled"
    monkeypatch.setattr("seismass.motions.records.builtin_suite", lambda _: mixed)
    assert command("study", "--out", tmp_path / "out", "--no-figures") == 0
    printed = capsys.readouterr().out
    assert f": {says}\n" in printed
    assert "   found in a drawer\n" in printed


def test_spectra_are_tabulated_over_the_periods_of_the_scaling(tmp_path: Path) -> None:
    """A target from 3.5 s on, of a suite scaled for a period of 20 s: none of the usual periods."""
    file = tmp_path / "long.csv"
    file.write_text("period,sa (g)\n3.5,0.1\n60,0.001\n")
    chosen = StudyParameters(
        buildings=((2, 4.0),), response_modification=(4.0,), mass_ratios=(1e-3,), scaling_period=20.0
    )
    spectrum = run_study(sm.builtin_suite("seven"), sm.TargetSpectrum.from_csv(file), chosen).spectrum
    assert (spectrum["period"][0], spectrum["period"][-1]) == (3.5, 30.0)


def test_figures_tell_every_alpha_and_r_apart() -> None:
    chosen = StudyParameters(
        buildings=((2, 0.38),),
        occupancies=(("all of $x$", 0.25),),
        response_modification=(2.0, 2.0000001),
        mass_ratios=(0.25, 0.5, 0.75, 1.0, 1.25),
    )
    result = run_study(sm.Suite("x$_$y", sm.builtin_suite("seven").records), TARGET, chosen)
    figures = study_figures(result)
    assert list(figures) == ["spectrum", "underestimation", "heat", "slip", "drift_R2", "drift_R2.0000001"]
    assert all(write.FIGURE_FILE.fullmatch(f"{name}.png") for name in figures)
    (axes,) = figures["underestimation"].axes
    # Rings are the attached model, two for each alpha.
    points = [line for line in axes.lines if line.get_marker() not in ("_", "None", "")]
    points = [line for line in points if line.get_markerfacecolor() != "none"]
    assert len({(line.get_color(), line.get_marker()) for line in points}) == len(points) == 5
    places = np.sort(np.concatenate([line.get_xdata() for line in points]))
    np.testing.assert_allclose(np.diff(places), [*[0.16] * 4, 0.36, *[0.16] * 4])


def test_schema_of_the_tables_is_documented(small: StudyResult) -> None:
    text = (Path(__file__).parents[1] / "docs" / "study_schema.md").read_text()
    for table in (small.responses, small.summary, small.fractions, small.designs, small.scaling.table()):
        for column in table.columns:
            assert f"`{column}`" in text, column


@pytest.mark.parametrize("error", [OSError("disk full"), KeyboardInterrupt()])
def test_nothing_is_left_when_writing_stops(
    small: StudyResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    def failing(*_: object) -> None:
        raise error

    monkeypatch.setattr("seismass.media.svg.figure_content", failing)
    with pytest.raises(type(error)):
        write.write_study(small, tmp_path / "out", png=True)
    assert list(tmp_path.iterdir()) == []


def test_no_file_is_changed_where_one_cannot_be(small: StudyResult, tmp_path: Path) -> None:
    (tmp_path / "summary.csv").write_text("earlier")
    (tmp_path / "drift_R2.svg").write_text("earlier")
    (tmp_path / "drift_R4.svg").mkdir()
    with pytest.raises(IsADirectoryError, match=r"drift_R4\.svg"):
        write.write_study(small, tmp_path, png=True)
    assert {file.name for file in tmp_path.iterdir()} == {"summary.csv", "drift_R2.svg", "drift_R4.svg"}
    assert (tmp_path / "summary.csv").read_text() == "earlier"


def command(*arguments: object) -> int:
    return cli.main([str(argument) for argument in arguments])


def test_command_writes_tables_and_says_what_they_say(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert command("study", "--out", tmp_path / "out", "--no-figures", "--jobs", 1) == 0
    text = capsys.readouterr()
    assert "1512 analyses, 1218 distinct" in text.out
    assert "code model gives more" in text.out
    assert "code     ASCE/SEI 7-10, storage: 0.25 of the live load (12.7.2, item 1, verified)" in text.out
    assert text.err == ""
    assert (tmp_path / "out" / "summary.csv").is_file()
    assert not list((tmp_path / "out").glob("*.png"))


def test_command_prints_json_and_takes_options(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "uhs.csv"
    target.write_text("period,sa (g)\n0.01,0.4\n0.2,1.0\n0.6,1.0\n3.0,0.2\n")
    arguments = [
        "--target",
        target,
        "--second-slope",
        0.1,
        "--overstrength",
        1.5,
        "--combination",
        "cqc",
        "--period",
        0.8,
    ]
    assert command("study", "--out", tmp_path / "out", "--no-figures", "--yield-at-R1", "--json", *arguments) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["counts"]["distinct"] == 7 * (72 + 72 + 48)
    assert document["parameters"]["second_slope"] == 0.1
    assert document["parameters"]["combination"] == "cqc"
    assert document["scaling"]["periods"] == pytest.approx([0.16, 1.2, 100])
    assert document == json.loads((tmp_path / "out" / "study.json").read_text())


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--records", "nowhere"], "suite of records must be a directory, a ZIP archive or a .csv file; got nowhere"),
        (
            ["--target", "nowhere.csv"],
            "path of target spectrum must be a file of text that can be read; got nowhere.csv",
        ),
        (["--target", "x.csv", "--sds", "1"], "sds of target spectrum must be left out where --target is given; got 1"),
        (["--mu", "nan"], "mu of study must be zero or positive; got nan"),
        (["--third-slope", "0.2"], "third_slope of study must be between 0 and the second slope; got 0.2"),
        (["--out", __file__], "out of study must be a folder that can be written to"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(
    arguments: list[str],
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert command("study", *arguments) == 2
    text = capsys.readouterr()
    assert text.err.startswith("seismass: error: ")
    assert message in text.err
    assert text.err.count("\n") == 1
    assert text.out == ""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["study", "--jobs", "0"], "argument --jobs: must be a whole number from 1 to 1024; got '0'"),
        (["study", "--jobs", "5000"], "argument --jobs: must be a whole number from 1 to 1024; got '5000'"),
        (["study", "--period", "-1"], "argument --period: must be a positive number; got '-1'"),
        (["scale", "--period", "inf"], "argument --period: must be a positive number; got 'inf'"),
        (["scale", "--sds", "0"], "argument --sds: must be a positive number; got '0'"),
        (["scale", "--tl", "long"], "argument --tl: must be a positive number; got 'long'"),
        (["study", "--mu", "0.1,x"], "argument --mu: must be numbers, with commas or spaces between; got '0.1,x'"),
        (["study", "--occupancy", "a"], "argument --occupancy: must be NAME:LAMBDA or NAME:LAMBDA:LAMBDA; got 'a'"),
        (["nothing"], "invalid choice: 'nothing'"),
        ([], "the following arguments are required: COMMAND"),
    ],
)
def test_command_line_that_cannot_be_read_exits_with_2(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as exit_:
        command(*arguments)
    assert exit_.value.code == 2
    assert message in capsys.readouterr().err


def test_failed_runs_give_exit_code_1(small: StudyResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    counts = small.metadata["counts"] | {"failed": 1}
    failed = StudyResult(**{**vars(small), "metadata": small.metadata | {"counts": counts}})
    monkeypatch.setattr("seismass.studies.study.run_study", lambda *_, **__: failed)
    assert command("study", "--out", tmp_path / "out", "--no-figures") == 1


def test_interrupt_exits_with_130_and_keeps_only_what_is_solved(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr("seismass.studies.study.run.solve_many", interrupted)
        assert command("study", "--out", tmp_path / "out") == 130
        assert "interrupted" in capsys.readouterr().err
        assert list(tmp_path.iterdir()) == []
    with monkeypatch.context() as patched:
        patched.setattr("seismass.studies.study.run.effective_fractions", interrupted)
        assert command("study", "--out", tmp_path / "out", "--effective", "--no-figures") == 130
        (kept,) = tmp_path.iterdir()
        assert {file.name for file in kept.iterdir()} == {"inputs", "part-runs.parquet"}
        patched.setattr("seismass.studies.study.run.solve_many", None)
        patched.undo()
    assert command("study", "--out", tmp_path / "out", "--no-figures") == 0
    assert not kept.exists()


def test_version_spectrum_and_scale_commands(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    with pytest.raises(SystemExit) as exit_:
        command("--version")
    assert exit_.value.code == 0
    assert capsys.readouterr().out == f"seismass {sm.__version__}\n"

    record = tmp_path / "step.txt"
    record.write_text("time (s), acceleration (m/s2)\n" + "".join(f"{0.01 * i:.2f}, 2.0\n" for i in range(300)))
    assert command("spectrum", record, "--period", 0.5, 1.0, "--damping", 0.0, "--kind", "sd") == 0
    table = pl.read_csv(capsys.readouterr().out.encode())
    assert table.columns == ["motion", "record", "damping", "period", "sd"]
    w = 2.0 * np.pi / np.array([0.5, 1.0])
    np.testing.assert_allclose(table["sd"], 4.0 / w**2, rtol=1e-12)

    assert command("scale", "--json") == 0
    document = json.loads(capsys.readouterr().out)
    expected = sm.scaling.scale_asce7_10(sm.builtin_suite("seven"), TARGET)
    assert [row["factor"] for row in document["motions"]] == expected.factors.tolist()
    assert document["motions"][0]["remarks"] == list(sm.builtin_suite("seven")[0].remarks)
    assert command("scale", "--suite", "seven") == 0
    printed = capsys.readouterr().out
    assert "synthetic-1" in printed
    assert "100 periods from 0.2 to 1.5 s" in printed
    assert sm.builtin_suite("seven")[0].remarks[0] in printed
