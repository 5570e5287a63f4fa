"""Small made-up files of networks whose formats are a header of words and numbers, for tools/record_files.py.

Each function takes the motion of a channel in cm/s2 and the step (s); nothing recorded is in them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

Motion = Callable[[int], Sequence[float]]


def largest(values: Sequence[float]) -> tuple[float, int]:
    """Return the largest value by size, and where it is."""
    at = max(range(len(values)), key=lambda index: abs(values[index]))
    return values[at], at


def in_lines(fields: Sequence[str], columns: int) -> str:
    """Return fields in lines of so many."""
    return "".join("".join(fields[at : at + columns]) + "\n" for at in range(0, len(fields), columns))


def resorce(motion: Motion, dt: float) -> str:
    """Return a RESORCE file: 1X, 5E14.7 in m/s2, fields that touch where there is a sign."""
    values = [value * 0.01 for value in motion(0)]
    return (
        "Event Date & Time             : 2000-01-01 00:00:00\n"
        "Station Code / Name           : 0001 / Nowhere\n"
        "Network                       : XX\n"
        "Orientation                   : NS\n"
        "Processing Info               : none\n"
        "Filter Cut-off Frequency (Hz) : 0.100 - 25.000\n"
        f"Time Increment (s)            : {dt:.3f}\n"
        f"Number of Data                : {len(values)}\n"
        f"PGA (m/s/s)                   : {abs(largest(values)[0]):.7E}\n"
        "Accelaration time series in m/s/s\n" + in_lines([f"{value:14.7E}" for value in values], 5)
    )


def csmnc(motion: Motion, dt: float) -> str:
    """Return a CSMNC file: 16 lines, then 5E14.6."""
    values = motion(0)
    value, at = largest(values)
    return (
        "00NOW000101000001\n0000101000000 2000-01-01 00:00:00 BTM\nNOWHERE\nEPICENTER  0.0N 0.0E DEPTH 9 KM\n"
        "MAGNITUDE  6.0(Ms)\nSTATION: NOW00 0.0N 0.0E\nSITE CONDITION: SOIL\nINSTRUMENT TYPE: X\n"
        "OBSERVING POINT: GROUND\nCOMP. EW\nUNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC\n"
        f"NO. OF POINTS:  {len(values)}  EQUALLY SPACED INTERVALS OF:  {dt:.3f}  SEC\n"
        f"PEAK VALUE:    {value:.3f}   AT  {at * dt:.2f} SEC    DURATION:  4 SEC\n"
        "PRE-EVENT TIME:  0  SEC\nCSMNC\n\n" + in_lines([f"{value:14.6E}" for value in values], 5)
    )


def jma(motion: Motion, dt: float) -> str:
    """Return a JMA CSV: six lines, the labels, and NS, EW, UD."""
    return (
        "SITE CODE= 00000NOW        ,   0.00,  0.00\n LAT.=  0.0000\n LON.=   0.0000\n"
        f" SAMPLING RATE= {1.0 / dt:.0f}Hz\n UNIT  = gal(cm/s/s)\n INITIAL TIME = 2000 01 01 00 00 00\n NS,EW,UD\n"
        + "".join(f"{n:.3f},{e:.3f},{u:.3f}\n" for n, e, u in zip(motion(0), motion(1), motion(2), strict=True))
    )


def nied(motion: Motion, dt: float) -> str:
    """Return a CSV of NIED: a date and the time since the start before NS, EW, UD."""
    head = (
        "OriginTime,2000/01/01-00:00:00\nLatitude,0.0\nLongitude,0.0\nDepth(km),10\nMagnitude,6.0\nCode,NOW001\n"
        "Latitude,0.0\nLongitude,0.0\nHeight(m),0\nOffset,0.00,0.00,0.00\nTime,RelativeTime(s),NS(gal),EW(gal),UD(gal)\n"
    )
    rows = enumerate(zip(motion(0), motion(1), motion(2), strict=True))
    return head + "".join(
        f"2000/01/01 00:00:{int(index * dt):02d},{index * dt:.2f},{n:.3f},{e:.3f},{u:.3f}\n"
        for index, (n, e, u) in rows
    )


def cwa(motion: Motion, dt: float) -> str:
    """Return a CWA file: time, U, N, E as 4F10.3."""
    up, north, east = motion(0), motion(1), motion(2)
    peaks = "".join(
        f"#AmplitudeMAX. {name}: {max(values):8.3f}~ {min(values):8.3f}\n"
        for name, values in zip("UNE", (up, north, east), strict=True)
    )
    return (
        "#Earthquake Information\n#Origin Time(GMT+08): 2000/01/01-00:00:00\n#StationCode: NOW001\n"
        f"#InstrumentKind: X\n#StartTime: 2000/01/01-00:00:00.000\n#RecordLength(sec): {len(up) * dt:8.3f}\n"
        f"#SampleRate(Hz): {1.0 / dt:.0f}\n#AmplitudeUnit:  gal. DCoffset(corr)\n{peaks}"
        "#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n"
        + "".join(
            f"{index * dt:10.3f}{u:10.3f}{n:10.3f}{e:10.3f}\n"
            for index, (u, n, e) in enumerate(zip(up, north, east, strict=True))
        )
    )


def afad(motion: Motion, dt: float) -> str:
    """Return a text of AFAD: 18 lines, then N-S, E-W, U-D."""
    channels = [motion(number) for number in range(3)]
    peaks = "   ".join(
        f"({name}) {abs(largest(values)[0]):.6f}" for name, values in zip(("N-S", "E-W", "U-D"), channels, strict=True)
    )
    return (
        "STRONG GROUND MOTION RECORDS OF TURKIYE\nPLACE                      : NOWHERE\n"
        "EARTHQUAKE DATE            : 01/01/2000 00:00:00 (GMT)\nEPICENTER COORDINATES      : 0.0N - 0.0E\n"
        "EARTHQUAKE DEPTH (km)      : 10\nEARTHQUAKE MAGNITUDE       : 6.0 Mw\nSTATION ID                 : 0001\n"
        "STATION COORDINATES        : 0.0N - 0.0E\nSTATION ALTITUDE (m)       : 0\nRECORDER TYPE              : X\n"
        "RECORDER SERIAL NO         : 1\nRECORD TIME                : 01/01/2000 00:00:00.000000 (GMT)\n"
        f"NUMBER OF DATA             : {len(channels[0])}\nSAMPLING INTERVAL (sec)    : {dt:.3f}\n"
        f"RAW PGA VALUES (gal)       : {peaks}\n\n\n     N-S         E-W         U-D\n"
        + "".join(f"{n:12.6f}{e:12.6f}{u:12.6f}\n" for n, e, u in zip(*channels, strict=True))
    )


def geonet(motion: Motion, dt: float, *, corrected: bool = True) -> str:
    """Return a GeoNet V2A file of two components, or V1A: 16 lines, 4 of integers, 6 of reals, 10F8.1 in mm/s2."""
    found, factor = "", 0.8
    for number, component in enumerate(("S14E", "Up")):
        values = [round(10.0 * value / factor, 1) for value in motion(number)]
        value, at = largest(values)
        whole = [[0] * 10 for _ in range(4)]
        reals = [[0.0] * 10 for _ in range(6)]
        others = len(values) if corrected else 0
        # Beside the numbers that a reader takes stand others, which differ: of what was recorded, twice as dense.
        whole[3][0], whole[3][3], whole[3][4], whole[3][5] = 2 * len(values) - 1, len(values), others, others
        reals[0][7], reals[2][4], reals[2][5] = factor, 0.5 * dt, dt
        text = [
            f"{'Corrected' if corrected else 'Uncorrected'} accelerogram 20000101_000000_NOWS_20 GNS Science",
            "Site NOWS       0 00 00S    0 00 00E",
            "Nowhere",
            "Instrument X",
            "Resolution: 18-bit   Instr Period: 0.0050 s   Damping: 0.700",
            "Accelerogram 20000101_000000_NOWS_20                 Processed 2000 January 01",
            "0 km east of NOWHERE",
            "2000 January 01         00:00:00 UT",
            "Epicentre   0 00 00S   0 00 00E  Bearing N00E  Dist    0km  Depth   10km M  6.00",
            f"Number of points  {len(values)}    Duration {len(values) * dt:.2f} s",
            f"Units are mm/s/s  at intervals of {dt:.3f} s",
            "Data is filtered",
            f"Component {component}",
            f"Acceleration:  Peak  {factor * value:.1f} mm/s/s at  {at * dt:.2f} s     RMS   1.00 mm/s/s",
            "Velocity record",
            "Displacement record",
        ]
        found += "\n".join(text) + "\n"
        found += "".join("".join(f"{one:8d}" for one in row) + "\n" for row in whole)
        found += "".join("".join(f"{one:8.4f}" for one in row) + "\n" for row in reals)
        for size in (1.0, 0.1, 0.01)[: 3 if corrected else 1]:
            found += in_lines([f"{size * one:8.1f}" for one in values], 10)
    return found


def unam(motion: Motion, dt: float) -> str:
    """Return a standard file of UNAM of three channels: 109 lines, then 3F10.4 in gal."""
    channels = [[round(value, 4) for value in motion(number)] for number in range(3)]
    peaks = [largest(values) for values in channels]
    points, rule = len(channels[0]), "---------+" * 8 + "\n"
    entries = [
        ("NOMBRE DE LA ESTACION", "NOWHERE"),
        ("CLAVE DE LA ESTACION", "NOWS"),
        ("NUMERO DE CANALES", "3"),
        ("ORIENTACION C1-C6 (rumbo;orientacion)", "/V/N00E/N90E"),
        ("ORIENTACION C7-C12 (rumbo;orientacion)", ""),
        ("INTERVALO DE MUESTREO, C1-C6 (s)", f"/{dt:g}/{dt:g}/{dt:g}"),
        ("FECHA DEL SISMO [GMT]", "2000/01/01"),
        ("DURACION DEL REGISTRO (s), C1-C6", "".join(f"/{points * dt:.2f}" for _ in range(3))),
        ("NUM. TOTAL DE MUESTRAS, C1-C6", f"/{points}/{points}/{points}"),
        ("ACEL. MAX.(Gal), C1-C6", "".join(f"/{value:.4f}" for value, _ in peaks)),
        ("ACEL. MAX., C1-C6, EN LA MUESTRA", "".join(f"/{at + 1}" for _, at in peaks)),
        ("UNIDADES DE LOS DATOS", "Gal (cm/s/s)"),
        ("FACTOR DE DECIMACION", "1"),
        ("FORMATO DATOS (FORTRAN,10 campos/dato)", "3F10.4"),
    ]
    return (
        f"{'*' * 86}\n                       INSTITUTO DE INGENIERIA, UNAM\n{'*' * 86}\n"
        "ARCHIVO ESTANDAR DE ACELERACION:\n"
        + "".join(f"{key:39s}: {value}\n" for key, value in entries)
        + f"{'=' * 80}\nDATOS DE ACELERACION:\n{rule}   CANAL-1   CANAL-2   CANAL-3\n"
        f"         V      N00E      N90E\n{rule}"
        + "".join(f"{v:10.4f}{n:10.4f}{e:10.4f}\n" for v, n, e in zip(*channels, strict=True))
    )


def bhrc(motion: Motion, dt: float) -> str:
    """Return a volume 1 of BHRC of three components: 13 lines, 7 of integers, 7 of reals, 10E13.6 in g/10."""
    found = ""
    for number, component in enumerate("LVT"):
        values = [value / 98.0665 for value in motion(number)]
        whole, reals = [0] * 88, [0.0] * 38
        whole[25], reals[2], reals[6] = len(values), len(values) * dt, 1.0 / dt
        text = [
            "* VOL1DS FILE:  0001/01",
            "Inst Type = X",
            "Origin Time : 2000/01/01   00:00:00",
            "",
            component,
            "",
            f"COMP {component}{number + 1}",
            "Nowhere                   Station    0.000 N  0.000 E   Altitude    0m   Azimuth L 316   T 46",
            "Epicenter  0.000 N  0.000 E   FD 10 Km mb      Ms      Mw6.0   M        ML   (X      )",
            "INSTR PERIOD =  .019 SEC   DAMPING =  .640",
            f"NO. OF POINTS =  {len(values)}      DURATION =  {len(values) * dt:.3f}",
            "UNITS ARE SECONDS AND G/10",
            "",
        ]
        found += "\n".join(text) + "\n" + in_lines([f"{value:5d}" for value in whole], 14)
        found += in_lines([f"{value:13.6E}" for value in reals], 6)
        found += in_lines([f"{value:13.6E}" for value in values], 10) + "/&\n"
    return found


def files(motion: Motion, dt: float) -> dict[str, str]:
    """Return name and text of one file of each kind."""
    return {
        "made.cor.acc": resorce(motion, dt),
        "made_csmnc.dat": csmnc(motion, dt),
        "made_jma.csv": jma(motion, dt),
        "made_nied.csv": nied(motion, dt),
        "made_cwa.txt": cwa(motion, dt),
        "made_afad.txt": afad(motion, dt),
        "made.V2A": geonet(motion, dt),
        "made.V1A": geonet(motion, dt, corrected=False),
        "made_unam.191": unam(motion, dt),
        "made_bhrc.V1": bhrc(motion, dt),
    }
