"""Files of target spectra as programs and people write them: each form with its right reading or refusal."""

from __future__ import annotations

import itertools
import json
from pathlib import Path

import numpy as np
import pytest

import seismass as sm
from seismass import cli
from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS, STANDARD_GRAVITY
from seismass.motions.scaling.suite import target_of

PERIODS = (0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 5.0)
SA_G = (0.5, 0.75, 0.8, 0.8, 0.8, 0.48, 0.24, 0.096)
"""Never above 4, so that nothing but the unit tells one in m/s2 from one in g."""

PERIOD_HEADS = (
    "Periyot T (s)",
    "Schwingzeit [s]",
    "Period (s)",
    "T (s)",
    "T",
    "period",
    "Periodo (s)",
    "P\u00e9riode (s)",
    "Tn [s]",
    "T (sec)",
    "Period [sec]",
)
SA_HEADS = ("Sa ({})", "PSA ({})", "Sa [{}]", "SA ({})", "5% damped Sa ({})", "Spectral acceleration ({})", "Se ({})",
            "pSa ({})", "Target ({})", "Sa_{}", "PSA {}", "Pseudo-spectral acceleration ({})", "Sae ({})",
            "Value ({})")  # fmt: skip
UNITS = {"g": "g", "m/s2": "m/s2", "cm/s2": "cm/s2", "gal": "gal", "m/s^2": "m/s2", "%g": "%g"}
SEPARATORS = (",", ";", "\t", "  ")


def table(heads: list[str], columns: list[list[float]], separator: str = ",", comma: bool = False) -> str:
    """Return a table as text, with decimal commas if asked."""
    rows = [separator.join(f"{value:.6g}" for value in row) for row in zip(*columns, strict=True)]
    text = "\n".join([separator.join(heads), *rows]) + "\n"
    head, _, body = text.partition("\n")
    return f"{head}\n{body.replace('.', ',') if comma else body}"


def ordinates(unit: str) -> list[float]:
    """Return Sa in a unit."""
    return [value * STANDARD_GRAVITY / ACCELERATION_UNITS[unit] for value in SA_G]


def is_right(target: sm.TargetSpectrum, share: float = 1.0) -> bool:
    """Whether a target has the ordinates, to the six figures of the files."""
    return bool(np.allclose(target(list(PERIODS)), share * STANDARD_GRAVITY * np.array(SA_G), rtol=2e-5))


def cases() -> list[tuple[str, str]]:
    """Return name and text of every form that states its unit."""
    found = []
    for (number, period), sa, (unit, name), separator in itertools.product(
        enumerate(PERIOD_HEADS), SA_HEADS, UNITS.items(), SEPARATORS
    ):
        if number % 3 and separator == "\t":
            continue
        head = sa.format(unit)
        comma = separator in (";", "\t") and number % 2 == 1
        found.append(
            (f"{period}{separator}{head}", table([period, head], [list(PERIODS), ordinates(name)], separator, comma))
        )
    return found


def read(folder: Path, text: str, behind: str = "", encoding: str = "utf-8") -> sm.TargetSpectrum:
    """Write a file and read it as --target does."""
    file = folder / "site.csv"
    file.write_bytes(text.encode(encoding))
    return target_of(f"{file}{behind}")


@pytest.mark.parametrize(("name", "text"), cases()[::67])
def test_a_form_is_read_rightly(tmp_path: Path, name: str, text: str) -> None:
    assert is_right(read(tmp_path, text)), name


def test_every_form_is_read_rightly(tmp_path: Path) -> None:
    assert len(cases()) > 2000
    assert [name for name, text in cases() if not is_right(read(tmp_path, text))] == []


@pytest.mark.parametrize(
    "heads", [["period", "Sa"], ["T", "PSA"], ["T (s)", "5% damped Sa"], ["Period (s)", "Target"], None]
)
@pytest.mark.parametrize("unit", ["g", "m/s2", "cm/s2"])
@pytest.mark.parametrize("separator", SEPARATORS)
def test_a_target_without_a_unit_is_refused_or_has_it_behind_its_name(
    tmp_path: Path, heads: list[str] | None, unit: str, separator: str
) -> None:
    text = table(heads or [], [list(PERIODS), ordinates(unit)], separator).lstrip("\n")
    with pytest.raises(RecordFormatError, match=r"unit of Sa of site\.csv must be stated by the head .*site\.csv:m/s2"):
        read(tmp_path, text)
    assert is_right(read(tmp_path, text, f":{unit}"))
    assert is_right(sm.TargetSpectrum.from_csv(tmp_path / "site.csv", unit=unit))
    commented = read(tmp_path, f"# site of mine\n# units: {unit}\n{text}")
    assert is_right(commented)


def test_a_unit_behind_the_name_does_not_change_what_the_head_says(tmp_path: Path) -> None:
    text = table(["T (s)", "Sa (g)"], [list(PERIODS), ordinates("g")])
    assert is_right(read(tmp_path, text, ":g"))
    with pytest.raises(RecordFormatError, match=r"unit of Sa of site\.csv must be that of its head, g; got m/s2"):
        read(tmp_path, text, ":m/s2")


@pytest.mark.parametrize(
    ("first", "second", "asked"),
    [
        ("Sa DBE (g)", "Sa MCE (g)", "Sa DBE"),
        ("Sa 475 (g)", "Sa 2475 (g)", "Sa 475 (g)"),
        ("PSA 2% (g)", "PSA 5% (g)", "5%"),
        ("Mean Sa (g)", "Median Sa (g)", "mean"),
    ],
)
def test_of_several_columns_one_is_named(tmp_path: Path, first: str, second: str, asked: str) -> None:
    halves = [0.5 * value for value in SA_G]
    is_first = asked.lower() in first.lower()
    columns = [list(PERIODS), *([list(SA_G), halves] if is_first else [halves, list(SA_G)])]
    text = table(["T (s)", first, second], columns)
    with pytest.raises(RecordFormatError, match=r"spectra of site\.csv must be one, or named behind the file as"):
        read(tmp_path, text)
    assert is_right(read(tmp_path, text, f":{asked}"))
    bare = text.replace(" (g)", "")
    with pytest.raises(RecordFormatError, match=r"unit of Sa of site\.csv"):
        read(tmp_path, bare, f":{asked.replace(' (g)', '')}")
    assert is_right(read(tmp_path, bare, f":{asked.replace(' (g)', '')}:g"))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"])
def test_encodings(tmp_path: Path, encoding: str) -> None:
    text = table(
        ["P\u00e9riode (s)", "Acc\u00e9l\u00e9ration spectrale (g)"], [list(PERIODS), list(SA_G)], ";", comma=True
    )
    assert is_right(read(tmp_path, text, encoding=encoding))


def test_units_in_a_row_below_with_nothing_below_other_columns(tmp_path: Path) -> None:
    """As ETABS exports its functions, whose ordinates have no unit, and as a head in snake case has one."""
    rows = "".join(f"RS,{period},{sa},0.05\n" for period, sa in zip(PERIODS, SA_G, strict=True))
    text = f"TABLE:  Response Spectrum Functions\nName,Period,Value,Damping\n,sec,,\n{rows}"
    with pytest.raises(RecordFormatError, match=r"unit of Sa of site\.csv"):
        read(tmp_path, text)
    assert is_right(read(tmp_path, text, ":g"))
    assert is_right(read(tmp_path, text.replace(",sec,,", ",(Sec),(g),")))
    assert is_right(read(tmp_path, table(["period_s", "sa_m_s2"], [list(PERIODS), ordinates("m/s2")])))


def test_a_spectrum_from_period_zero_is_linear_to_the_next(tmp_path: Path) -> None:
    target = read(tmp_path, table(["T (s)", "Sa (g)"], [[0.0, *PERIODS], [0.3, *SA_G]]))
    assert is_right(target)
    assert target.shortest == 0.0
    np.testing.assert_allclose(target([0.0, 0.025, 0.05]) / STANDARD_GRAVITY, [0.3, 0.4, 0.5], rtol=1e-12)
    assert target.table()["period (s)"][0] > 0.0


def test_displacements_and_pseudo_velocities(tmp_path: Path) -> None:
    """Sa = omega^2 SD = omega PSV by their definition; from period 0 there is none."""
    omega = 2.0 * np.pi / np.array(PERIODS)
    sa = STANDARD_GRAVITY * np.array(SA_G)
    for head, values in (
        ("SD (cm)", 100.0 * sa / omega**2),
        ("SD (m)", sa / omega**2),
        ("Spectral displacement (mm)", 1000.0 * sa / omega**2),
        ("PSV (cm/s)", 100.0 * sa / omega),
        ("PSV (m/s)", sa / omega),
    ):
        assert is_right(read(tmp_path, table(["period (s)", head], [list(PERIODS), list(values)]))), head
    with pytest.raises(RecordFormatError, match=r"unit of SD of site\.csv must be stated by the head as SD \(m\)"):
        read(tmp_path, table(["period (s)", "SD"], [list(PERIODS), list(sa)]))


def test_accelerations_beside_displacements_and_velocities(tmp_path: Path) -> None:
    """One column has a unit of acceleration: nothing is to be asked."""
    heads = ["T (s)", "Sd (cm)", "Sa (g)", "Sv (cm/s)"]
    assert is_right(read(tmp_path, table(heads, [list(PERIODS), [1.0] * 8, list(SA_G), [2.0] * 8])))


@pytest.mark.parametrize("order", ["{0}~{1}", "{1}~{0}"])
def test_uniform_hazard_of_openquake(tmp_path: Path, order: str) -> None:
    measures = ["PGA", *(f"SA({period:g})" for period in PERIODS)]
    heads = ["lon", "lat", *(order.format(poe, one) for poe in ("0.1", "0.02") for one in measures)]
    row = ["10.0", "45.0", *(f"{share * value:.6f}" for share in (1.0, 2.0) for value in (0.3, *SA_G))]
    first = "#,,,,\"generated_by='OpenQuake engine 3.16', kind='mean', investigation_time=50.0\"\n"
    text = f"{first}{','.join(heads)}\n{','.join(row)}\n"
    with pytest.raises(RecordFormatError, match=r"spectra of site\.csv must be one, or named .* got 0\.1, 0\.02"):
        read(tmp_path, text)
    assert is_right(read(tmp_path, text, ":0.1"))
    assert is_right(read(tmp_path, text, ":0.02"), 2.0)
    with pytest.raises(
        RecordFormatError, match=r"sites of site\.csv must be one: leave the row of yours in a copy; got 2"
    ):
        read(tmp_path, f"{text}{','.join(row)}\n", ":0.1")


def test_answers_of_the_usgs_services(tmp_path: Path) -> None:
    one = {"periods": [0.0, *PERIODS], "ordinates": [0.3, *SA_G]}
    alone = {"response": {"data": {"sds": 0.8, "multiPeriodDesignSpectrum": one}}}
    assert is_right(read(tmp_path, json.dumps(alone)))
    both = {"data": {"multiPeriodDesignSpectrum": one, "multiPeriodMCErSpectrum": {**one, "ordinates": [0.6, *SA_G]}}}
    with pytest.raises(RecordFormatError, match="got multiPeriodDesignSpectrum, multiPeriodMCErSpectrum"):
        read(tmp_path, json.dumps(both))
    assert is_right(read(tmp_path, json.dumps(both), ":multiPeriodDesignSpectrum"))
    older = {"response": {"data": {"sdSpectrum": [list(point) for point in zip(PERIODS, SA_G, strict=True)]}}}
    assert is_right(read(tmp_path, json.dumps(older)))
    with pytest.raises(RecordFormatError, match=r"content of site\.csv must be a spectrum of periods and ordinates"):
        read(tmp_path, "{}")
    with pytest.raises(RecordFormatError, match=r"content of site\.csv must be sound JSON"):
        read(tmp_path, "{1")


def test_rows_of_several_motions_are_spectra_of_their_own(tmp_path: Path) -> None:
    """By motion, record and damping, in any order of columns; the units of what is printed are those of its heads."""
    keys = [("1", "hall", "0.02", 1.0), ("1", "hall", "0.05", 0.7), ("2", "roof", "0.05", 0.4)]
    for order in ([0, 1, 2, 3, 4], [3, 4, 0, 1, 2], [0, 3, 1, 4, 2]):
        rows = [["motion", "record", "damping", "period", "psa (m/s2)"]]
        for period, sa in zip(PERIODS, SA_G, strict=True):
            rows += [[*key, f"{period}", f"{share * sa * STANDARD_GRAVITY:.9g}"] for *key, share in keys]
        text = "\n".join(",".join(row[place] for place in order) for row in rows)
        with pytest.raises(RecordFormatError, match=r"got hall, 2 %, hall, 5 %, roof, 5 %"):
            read(tmp_path, text)
        for _, record, damping, share in keys:
            assert is_right(read(tmp_path, text, f":{record}, {100.0 * float(damping):g} %"), share)
        alone = "\n".join(line for line in text.splitlines() if "roof" in line or "record" in line)
        assert is_right(read(tmp_path, alone), 0.4)


def test_search_results_of_peer(tmp_path: Path) -> None:
    head = "PEER Ground Motion Database\n\n -- Summary of Metadata of Selected Records --\n"
    head += "Result ID, Spectral Ordinate, Tp-Pulse Period (sec), Magnitude\n1, SRSS, -, 6.7\n\n"
    spectra = table(["Period (sec)", "Target pSa (g)", "RSN-1 SRSS pSa (g)"], [list(PERIODS), list(SA_G), [0.1] * 8])
    unscaled = table(["Period (sec)", "RSN-1 Horizontal-1 pSa (g)"], [list(PERIODS), [0.2] * 8])
    text = f"{head} -- Scaled Spectra used in Search & Scaling --\n{spectra}\n -- Unscaled Spectra --\n{unscaled}"
    assert is_right(read(tmp_path, text))
    assert read(tmp_path, text, ":RSN-1 SRSS pSa (g)")(1.0) == pytest.approx(0.1 * STANDARD_GRAVITY)
    assert read(tmp_path, text, ":Horizontal-1")(1.0) == pytest.approx(0.2 * STANDARD_GRAVITY)


@pytest.mark.parametrize("kind", ["psa", "psv", "sd", "sa"])
def test_what_the_command_spectrum_prints_is_read(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], kind: str
) -> None:
    """The target at the printed periods is the spectrum; at 5 % and these periods true and pseudo agree to 6 %."""
    record = sm.builtin_record("synthetic-1")
    words = ["spectrum", str(record.source), "--period", "0.1,0.2,0.5,1,2", "--kind", kind]
    assert cli.main(words) == 0
    target = read(tmp_path, capsys.readouterr().out)
    expected = sm.response_spectrum(record, [0.1, 0.2, 0.5, 1.0, 2.0])
    np.testing.assert_allclose(
        target([0.1, 0.2, 0.5, 1.0, 2.0]), np.ravel(expected), rtol=0.06 if kind == "sa" else 1e-6
    )


def test_of_several_motions_one_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source = sm.builtin_record("synthetic-1").source
    assert source is not None
    assert cli.main(["spectrum", str(source), "--period", "0.1,1,2", "--damping", "0.02,0.05"]) == 0
    text = capsys.readouterr().out
    with pytest.raises(RecordFormatError, match=r"must be one, or named behind the file .*2 %.*5 %"):
        read(tmp_path, text)
    assert read(tmp_path, text, ":synthetic-1, 5 %")(1.0) < read(tmp_path, text, ":synthetic-1, 2 %")(1.0)


def test_what_the_command_target_prints_is_read(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["target", "ec8:1:C:0.3"]) == 0
    target = read(tmp_path, capsys.readouterr().out)
    ec8 = sm.TargetSpectrum.eurocode8(1, "C", agr_g=0.3)
    np.testing.assert_allclose(target([0.1, 0.6, 2.0]), ec8([0.1, 0.6, 2.0]), rtol=1e-3)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Period (ms),Sa (g)\n50,1\n100,2\n", "unit of period of site.csv must be s; got ms"),
        ("x,y\n1,2\n2,3\n", "columns of site.csv must be one period or T and one Sa; got x, y"),
        ("Frequency (Hz),Sa (g)\n1,2\n2,3\n", "columns of site.csv must be one period or T and one Sa"),
        ("T (s),Sigma\n1,2\n2,3\n", "columns of site.csv must be one period or T and one Sa"),
        ("T (s),Sa (kN)\n1,2\n2,3\n", "unit of Sa of site.csv must be stated by the head as Sa (g)"),
        ("T (s),Sa (g)\n1,2\n", "points of site.csv must be at least two rows"),
        ("T (s),Sa (g)\n1,2\n0.5,3\n", "period of site.csv, point 2, must be longer than the one before"),
        ("T (s),Sa (g)\n0,2\n0,3\n", "period of site.csv, point 2, must be a positive number"),
    ],
)
def test_what_is_no_target_is_refused(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(RecordFormatError) as error:
        read(tmp_path, text)
    assert message in str(error.value)
