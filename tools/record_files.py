"""Small made-up files of every record format that is read, written by the formats' rules, for tests and fuzzing.

Their motion is a sum of decaying sines, so that nothing recorded is in them.
"""

from __future__ import annotations

import math
import runpy
from collections.abc import Iterator, Sequence
from pathlib import Path

NETWORKS = runpy.run_path(str(Path(__file__).with_name("network_files.py")))

POINTS = 203
DT = 0.02


def motion(channel: int = 0, points: int = POINTS) -> list[float]:
    """Return accelerations in cm/s2 that are small at both ends and have one largest value."""
    found = []
    for index in range(points):
        time = index * DT
        envelope = math.sin(math.pi * (index + 0.5) / points) ** 2
        found.append(
            120.0 * envelope * math.sin(2.0 * math.pi * (2.1 + 0.3 * channel) * time + 0.4)
            + 55.0 * envelope * math.sin(2.0 * math.pi * (5.3 - 0.2 * channel) * time + channel)
        )
    return found


def fortran(value: float, width: int, decimals: int) -> str:
    """Return F format without the leading zero that does not fit, as Fortran writes it."""
    text = f"{value:.{decimals}f}"
    text = text.replace("0.", ".", 1) if text.lstrip("-").startswith("0.") else text
    return text.rjust(width)


def smc_number(value: float) -> str:
    """Return 1PE10.4E1: " 1.5057E+0"."""
    mantissa, _, exponent = f"{value:.4E}".partition("E")
    return f"{mantissa}E{int(exponent):+d}".rjust(10)


def rows(fields: Sequence[str], columns: int, end: str = "") -> str:
    """Return fields in lines of so many."""
    return "".join("".join(fields[at : at + columns]) + end + "\n" for at in range(0, len(fields), columns))


def peak(values: Sequence[float]) -> tuple[float, float]:
    """Return the largest value by size, with its sign, and its time (s)."""
    at = max(range(len(values)), key=lambda index: abs(values[index]))
    return values[at], at * DT


def at2(*, per_line: int = 5, dt: str = f"{DT:.4f} SEC", quantity: str = "ACCELERATION") -> str:
    """Return a PEER file."""
    fields = [f"{value / 980.665:15.7E}" for value in motion()]
    return (
        "PEER NGA STRONG MOTION DATABASE RECORD\nMade Up, 1/1/2000, Nowhere, 90\n"
        f"{quantity} TIME SERIES IN UNITS OF G\nNPTS={POINTS:7d}, DT=   {dt}\n" + rows(fields, per_line)
    )


def cosmos(*, level: int = 2, channels: int = 2, missing_peak: bool = False) -> str:
    """Return a COSMOS file of one or several channels."""
    return "".join(_cosmos_channel(level, channel, channels, missing_peak) for channel in range(channels))


def _cosmos_channel(level: int, channel: int, channels: int, missing_peak: bool) -> str:
    values = [round(value, 5) for value in motion(channel)]
    largest, time = peak(values)
    azimuth = 90 if channel == 0 else 400
    component = f"{azimuth:3d} deg" if channel == 0 else "Up"
    whole = [-999] * 100
    whole[:4] = [level, 1, 4, 120]
    whole[53], whole[75] = azimuth, 0
    reals = [-999.0] * 100
    reals[61:65] = [DT * 1000.0, POINTS * DT, -999.0 if missing_peak else largest, time]
    kind = "Corrected acceleration    " if level == 2 else "Uncorrected acceleration  "
    text = [
        f"{kind}(Format v01.20 with 13 text lines) Src: made up",
        "Record of Made Up Earthquake of Sat Jan 1, 2000 00:00 UTC",
        "Hypocenter: 0.0000 0.0000 H= 10km Mw=6.0",
        "Origin: 2000/01/01 00:00:00 UTC",
        "Statn No: 05-000001 Code:XX-NOW   XXX   Nowhere",
        "Coords: 0.0000 0.0000  Site geology:",
        f"Recorder: none ( {channels} Chns of   {channels} at Sta) Sensor: none",
        "Rcrd start time: 2000/01/01 00:00:00.000 UTC (Q=5) RcrdId: none",
        f"Sta Chan {channel + 1:3d}: {component} (Rcrdr Chan  {channel + 1}) Location:",
        f"Raw record length = {POINTS * DT:7.3f} sec, Uncor max = , at sec.",
        f"Processed: 2000-01-01, Max = {largest:9.3f} cm/sec2 at {time:8.3f} sec",
        "Record filtered below 0.10 Hz, and above 20.0 Hz",
        "Values used when parameter or data value is unknown/unspecified:   -999, -999.0",
        " 100 Integer-header values follow on  10 lines, Format= (10I8)",
    ]
    return (
        "\n".join(text)
        + "\n"
        + rows([f"{number:8d}" for number in whole], 10)
        + " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n"
        + rows([f"{number:13.6f}" for number in reals], 6)
        + '   1 Comment line(s) follow, each starting with a "|":\n|<SCNL>NOW.HN'
        + ("E" if channel == 0 else "Z")
        + ".XX.--\n"
        + f"{POINTS:8d} acceleration pts, approx {POINTS * DT:4.0f} secs, units=cm/sec2(04),Format=(8F10.5)\n"
        + rows([fortran(value, 10, 5) for value in values], 8)
        + f"/&  ----------  End of data for channel  {channel + 1}  ----------\n"
    )


def csmip(*, level: int = 2, pairs: bool = False, channels: int = 2) -> str:
    """Return a CSMIP file: V2, V1, or V1 of times and accelerations in g/10."""
    return "".join(_csmip_channel(level, pairs, channel, channels) for channel in range(channels))


def _csmip_channel(level: int, pairs: bool, channel: int, channels: int) -> str:
    component = " 90 DEG" if channel == 0 else "UP"
    values = motion(channel)
    g = [value / 980.665 for value in values]
    number = f"CHAN {channel + 1:2d}: {component}"
    in_g, time_g = peak(g)
    station = [
        f"STATION NO. 00001   00.000N, 000.000W     NONE  S/N 1  ({channels} CHNS OF {channels} AT STA)",
        "NOWHERE                                   CGS",
        number,
        "MADE UP EARTHQUAKE     JAN 1, 2000 00:00 UTC",
        "HYPOCENTER: NONE",
        "INSTR PERIOD =  .040 SEC,  DAMPING = .600,  SENSITIVITY = 1.0 V/G",
    ]
    top = [
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 01/01/00, CGS",
        "MADE UP EARTHQUAKE",
        "JAN 1, 2000",
        "1",
    ]
    if level == 1:
        unit = "ARE SEC AND G/10." if pairs else "IS G."
        text = [
            *top,
            *station,
            f"NO. OF POINTS = {POINTS:6d}  RECORD LENGTH = {(POINTS - 1) * DT:.3f} SEC",
            f"UNITS OF UNCOR ACCEL {unit}     MAX  = {fortran(in_g, 7, 3)} G, AT {time_g:7.3f} SEC.",
            "RMS ACCEL OF COMPLETE RECORD =  .008 G.",
        ]
        reals = 50
        if pairs:
            fields = [fortran(x, 7, 3) for index, y in enumerate(g) for x in (index * DT, 10.0 * y)]
            data = rows(fields, 10)
        else:
            data = f"{POINTS:6d} POINTS OF ACCEL DATA EQUALLY SPACED AT {fortran(DT, 5, 3)} SEC.  (UNITS: G)\n"
            data += rows([fortran(y, 9, 6) for y in g], 8)
    else:
        largest, time = peak(values)
        text = [
            f"CORRECTED ACCELEROGRAM   00001       {number}     FROM",
            *top,
            *station,
            f"                        RECORD LENGTH = {(POINTS - 1) * DT:.3f} SEC.",
            f"                                     UNCOR MAX  = {fortran(in_g, 7, 3)} G, AT {time_g:7.3f} SEC.",
            "RMS ACCEL OF (UNCOR) RECORD  =  .030 G.",
            "ACCELEROGRAM BANDPASS FILTERED WITH RAMPS AT  .050- .100 AND 23.00-25.00 CYC/SEC",
            f"{POINTS:6d} POINTS OF INSTRUMENT- AND BASELINE-CORRECTED ACCEL, VELOC AND DISPL DATA",
            f"AT EQUALLY-SPACED INTERVALS OF    {fortran(DT, 4, 3)}  SEC.",
            f"PEAK ACCELERATION = {largest:9.3f}    CM/SEC/SEC  AT {time:8.3f}   SEC.",
            "PEAK   VELOCITY   =     1.000      CM/SEC    AT     .100   SEC.",
            "PEAK DISPLACEMENT =     1.000        CM      AT     .100   SEC.",
            "INITIAL VELOCITY  =      .000   CM/SEC;   INITIAL DISPLACEMENT =     .000   CM",
            "MADE UP EARTHQUAKE     JAN 1, 2000 00:00 UTC",
            "",
            "TITLE",
            "",
        ]
        reals = 100
        data = ""
        for what, unit, size in (("ACCEL", "CM/SEC/SEC", 1.0), ("VELOC", "CM/SEC", 0.1), ("DISPL", "CM", 0.01)):
            data += f"{POINTS:6d} POINTS OF {what} DATA EQUALLY SPACED AT {fortran(DT, 5, 3)} SEC.  (UNITS: {unit})\n"
            data += rows([fortran(size * value, 10, 3) for value in values], 8)
    return (
        "\n".join(text)
        + "\n"
        + rows([f"{0:5d}"] * 100, 16)
        + rows([fortran(0.0, 10, 3)] * reals, 8)
        + data
        + f"/&  ----------  END OF DATA FOR CHANNEL {channel + 1:2d}  ----------\n"
    )


ESM_KEYS = """\
EVENT_NAME EVENT_ID EVENT_DATE_YYYYMMDD EVENT_TIME_HHMMSS EVENT_LATITUDE_DEGREE EVENT_LONGITUDE_DEGREE
EVENT_DEPTH_KM HYPOCENTER_REFERENCE MAGNITUDE_W MAGNITUDE_W_REFERENCE MAGNITUDE_L MAGNITUDE_L_REFERENCE FOCAL_MECHANISM
NETWORK STATION_CODE STATION_NAME STATION_LATITUDE_DEGREE STATION_LONGITUDE_DEGREE STATION_ELEVATION_M LOCATION
SENSOR_DEPTH_M VS30_M/S SITE_CLASSIFICATION_EC8 MORPHOLOGIC_CLASSIFICATION EPICENTRAL_DISTANCE_KM
EARTHQUAKE_BACKAZIMUTH_DEGREE DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS DATE_TIME_FIRST_SAMPLE_PRECISION
SAMPLING_INTERVAL_S NDATA DURATION_S STREAM UNITS INSTRUMENT INSTRUMENT_ANALOG/DIGITAL INSTRUMENTAL_FREQUENCY_HZ
INSTRUMENTAL_DAMPING FULL_SCALE_G N_BIT_DIGITAL_CONVERTER PGA_CM/S^2 TIME_PGA_S BASELINE_CORRECTION FILTER_TYPE
FILTER_ORDER LOW_CUT_FREQUENCY_HZ HIGH_CUT_FREQUENCY_HZ LATE/NORMAL_TRIGGERED DATABASE_VERSION HEADER_FORMAT DATA_TYPE
PROCESSING DATA_TIMESTAMP_YYYYMMDD_HHMMSS DATA_LICENSE DATA_CITATION DATA_CREATOR ORIGINAL_DATA_MEDIATOR_CITATION
ORIGINAL_DATA_MEDIATOR ORIGINAL_DATA_CREATOR_CITATION ORIGINAL_DATA_CREATOR USER1 USER2 USER3 USER4 USER5"""


def esm(**changes: str) -> str:
    """Return an ESM file; a change is by the name of its key, with - and / as the key has them."""
    values = motion()
    largest, time = peak(values)
    stated = {
        "EVENT_NAME": "MADE_UP",
        "EVENT_DATE_YYYYMMDD": "20000101",
        "EVENT_TIME_HHMMSS": "000000",
        "NETWORK": "XX",
        "STATION_CODE": "NOW",
        "STATION_NAME": "Nowhere",
        "SAMPLING_INTERVAL_S": f"{DT:.6f}",
        "NDATA": str(POINTS),
        "DURATION_S": f"{(POINTS - 1) * DT:.3f}",
        "STREAM": "HNE",
        "UNITS": "cm/s^2",
        "PGA_CM/S^2": f"{largest:.6f}",
        "TIME_PGA_S": f"{time:.6f}",
        "HEADER_FORMAT": "DYNA 1.2",
        "DATA_TYPE": "ACCELERATION",
        **changes,
    }
    header = "".join(f"{key}: {stated.get(key, '')}\n" for key in ESM_KEYS.split())
    return header + "".join(f"{value:.6f}\n" for value in values)


def knet(*, direction: str = "E-W") -> str:
    """Return a K-NET file, or one of KiK-net by its number of direction."""
    per_count = 3920.0 / 6182761.0
    counts = [round(value / per_count) - 12000 for value in motion(points=200)]  # whole seconds
    mean = sum(counts) / len(counts)
    largest = max(abs(count - mean) for count in counts) * per_count
    header = {
        "Origin Time": "2000/01/01 00:00:00",
        "Lat.": "0.0",
        "Long.": "0.0",
        "Depth. (km)": "10",
        "Mag.": "6.0",
        "Station Code": "NOW001",
        "Station Lat.": "0.0",
        "Station Long.": "0.0",
        "Station Height(m)": "0",
        "Record Time": "2000/01/01 00:00:10",
        "Sampling Freq(Hz)": f"{1.0 / DT:.0f}Hz",
        "Duration Time(s)": f"{200 * DT:.0f}",
        "Dir.": direction,
        "Scale Factor": "3920(gal)/6182761",
        "Max. Acc. (gal)": f"{largest:.3f}",
        "Last Correction": "2000/01/01 00:00:00",
        "Memo.": "",
    }
    top = "".join(f"{key:<18}{value}\n" for key, value in header.items())
    return top + rows([f"{count:8d} " for count in counts], 8)


def smc(*, pairs: bool = False, fixed: bool = False, kind: str = "2 CORRECTED ACCELEROGRAM") -> str:
    """Return an SMC file: with exponents, in F10.5, or of times and accelerations."""
    values = motion()
    numbers = [x for index, y in enumerate(values) for x in (index * DT, y)] if pairs else values
    high, low = max(values), min(values)
    whole = [-32768] * 48
    whole[12], whole[13], whole[15], whole[16] = 90, 45, 2, len(numbers)
    reals = [1.7e38] * 50
    reals[28:32] = [values.index(high) * DT, high, values.index(low) * DT, low]
    if not pairs:
        reals[1] = 1.0 / DT
    lines = [
        kind,
        "*",
        "NOW0A",
        "     2000  01  01    0000 MADE UP",
        "Moment Mag=      6.0 Ms=      6.0 Ml=      6.0",
        "station = Nowhere                        component=     45",
        "epicentral dist =     10.0       pk acc =    100.0",
        "inst type=none      data source = XXXX",
        "*",
        "*",
        "*",
    ]
    write = (lambda number: fortran(number, 10, 5)) if fixed else smc_number
    return (
        "\n".join(lines)
        + "\n"
        + rows([f"{number:10d}" for number in whole], 8)
        + rows([f"{number:15.7E}" for number in reals], 5)
        + "|\n| nothing recorded\n"
        + rows([write(number) for number in numbers], 8)
    )


def column() -> str:
    """Return one column that states its count, unit and step."""
    return f"# npts: {POINTS}\n# dt = {DT} s, acceleration (gal)\n" + "".join(f"{value:.5f}\n" for value in motion())


def two_columns() -> str:
    """Return time and acceleration as CSV."""
    g = [value / 980.665 for value in motion()]
    return "time (s),acceleration (g)\n" + "".join(f"{index * DT:.2f},{value:.6f}\n" for index, value in enumerate(g))


def components() -> str:
    """Return times in ms and three components, with semicolons and decimal commas."""
    rows = enumerate(zip(motion(0), motion(1), motion(2), strict=True))
    text = "t (ms);NS (gal);EW (gal);UD (gal)\n"
    lines = (f"{1000.0 * index * DT:.1f};{n:.5f};{e:.5f};{u:.5f}\n" for index, (n, e, u) in rows)
    return text + "".join(lines).replace(".", ",")


def block() -> str:
    """Return samples line after line behind their count and step, as 5E15.7 in g."""
    fields = [f"{value / 980.665:15.7E}" for value in motion()]
    return f"Acceleration (g)\n{POINTS} {DT}\n" + rows(fields, 5)


def files() -> Iterator[tuple[str, bytes]]:
    """Yield name and content of one file of each kind."""
    kinds = {
        "made.AT2": at2(),
        "made_v2.cosmos": cosmos(),
        "made_v1.cosmos": cosmos(level=1, channels=1),
        "made.V2": csmip(),
        "made.V1": csmip(level=1),
        "made_pairs.V1": csmip(level=1, pairs=True, channels=1),
        "made.ASC": esm(),
        "made.EW": knet(),
        "made.UD2": knet(direction="6"),
        "made.smc": smc(),
        "made_fixed.smc": smc(fixed=True),
        "made_pairs.smc": smc(pairs=True, kind="1 UNCORRECTED ACCELEROGRAM"),
        "made.txt": column(),
        "made.csv": two_columns(),
        "made_components.csv": components(),
        "made_block.g3": block(),
        **NETWORKS["files"](motion, DT),
    }
    for name, text in kinds.items():
        yield name, text.encode()
