"""Kinds of files that are known and not read, by their first bytes or lines, with what is read instead."""

from __future__ import annotations

import re
import struct
from typing import Final

_CONVERT: Final = "convert it to text of one column (acceleration) or two (time, acceleration)"
_NETWORK: Final = f"read the PEER, COSMOS, CSMIP, ESM, K-NET or SMC file of the record, or {_CONVERT}"
_COUNTS: Final = "read it by seismass.records.read_counts with the m/s2 of one count (needs ObsPy)"
_UNPACK: Final = "unpack it and read the files in it"

_MAGIC: Final[tuple[tuple[bytes, str, str], ...]] = (
    (b"\x89HDF\r\n\x1a\n", "HDF5 (ASDF, MATLAB 7.3)", _CONVERT),
    (b"MATLAB ", "MATLAB", _CONVERT),
    (b"\x93NUMPY", "NumPy", _CONVERT),
    (b"PAR1", "Parquet", _CONVERT),
    (b"ARROW1", "Arrow", _CONVERT),
    (b"SQLite format 3\0", "SQLite", _CONVERT),
    (b"CDF\x01", "NetCDF", _CONVERT),
    (b"CDF\x02", "NetCDF", _CONVERT),
    (b"MS\x03", "miniSEED 3", _CONVERT),
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "Excel (.xls)", "save the sheet as CSV"),
    (b"\x1f\x8b", "gzip", _UNPACK),
    (b"BZh", "bzip2", _UNPACK),
    (b"\xfd7zXZ\0", "xz", _UNPACK),
    (b"\x28\xb5\x2f\xfd", "zstd", _UNPACK),
    (b"7z\xbc\xaf\x27\x1c", "7z", _UNPACK),
    (b"Rar!\x1a\x07", "RAR", _UNPACK),
    (b"\x1f\x9d", "compress (.Z)", _UNPACK),
    (b"%PDF-", "PDF", "read the data file, not its report"),
    (b"\x89PNG\r\n\x1a\n", "PNG", "read the data file, not a picture"),
    (b"\xff\xd8\xff", "JPEG", "read the data file, not a picture"),
    (b"GIF8", "GIF", "read the data file, not a picture"),
    (b"%!PS", "PostScript", "read the data file, not a plot"),
    (b"{\\rtf", "RTF", "save it as plain text"),
    (b"BEGIN GSE2", "GSE2", _CONVERT),
    (b"WID2 ", "GSE2", _CONVERT),
    (b"WID1 ", "GSE1", _CONVERT),
    (b"XW01 ", "GSE1", _CONVERT),
    (b"version https://git-lfs", "Git LFS pointer", "fetch the file that it points to"),
)
_MINISEED = re.compile(rb"\d{6}[DRQM][ \0]|[0-9 ]{6}[DRQM] [A-Za-z0-9 ]{5}")
_SEED = re.compile(rb"\d{6}[VAST] ")
_SAC_HEADER_BYTES: Final = 632
_SAC_VERSION_AT: Final = 304
_TAR_AT: Final = 257

_LINES: Final[tuple[tuple[re.Pattern[str], str, str], ...]] = tuple(
    (re.compile(pattern, re.IGNORECASE), name, instead)
    for pattern, name, instead in (
        (
            r"\s*(?:<!doctype html|<html|<head|<body)",
            "HTML page",
            "download the file itself, signed in where its site asks it",
        ),
        (r"\s*<\?xml|\s*<q:quakeml|\s*<FDSNStationXML", "XML", _NETWORK),
        (r"\s*[{\[]\s*(?:[\"{\[]|$)", "JSON", _NETWORK),
        (r"(?:CORRECTED ACCELEROGRAM.*CORRESPONDING|FILE\s+\d+ OF UNCORRECTED ACCELEROGRAM)", "USC volume", _NETWORK),
        (r"\s*RESPONSE AND FOURIER AMPLITUDE SPECTRA", "CSMIP V3 (spectra)", "read its V1 or V2 file"),
        (r"\s*(?:RESPONSE|FOURIER) SPECTR\w+.*\(Format v", "COSMOS V3 (spectra)", "read its V1 or V2 file"),
        (r"TIMESERIES \S+_\S*,.*samples.*sps", "ASCII time series of FDSN", _CONVERT),
        (r"\s*(?:-?\d*\.\d+\s+){4}-?\d*\.\d+\s*\n(?=(?:.*\n){0,24}?.*-12345(?:\.0+)?\b)", "alphanumeric SAC", _CONVERT),
        (r"(?s).{0,600}?UNITS=CM/SEC\*\*2, CM/SEC, AND CM", "USGS text of three quantities", _NETWORK),
        (r"(?s).{0,600}?EUROPEAN STRONG[- ]MOTION DATA", "ISESD", _NETWORK),
    )
)


def known_binary(head: bytes) -> tuple[str, str] | None:
    """Return name and advice of a binary file by its first bytes, or None."""
    for magic, name, instead in _MAGIC:
        if head.startswith(magic):
            return name, instead
    if head.startswith(b"PK\x03\x04"):
        if b"[Content_Types].xml" in head or b"xl/" in head:
            return "Excel (.xlsx)", "save the sheet as CSV"
        return "ZIP", "unpack it, or read it as a folder (read_suite, seismass records)"
    if head[_TAR_AT : _TAR_AT + 5] == b"ustar":
        return "tar", _UNPACK
    if _SEED.match(head):
        return "SEED", _CONVERT
    if _MINISEED.match(head) and (b"\0" in head or not head.isascii()):
        return "miniSEED", _COUNTS
    if len(head) >= _SAC_HEADER_BYTES:
        versions = [struct.unpack_from(order + "i", head, _SAC_VERSION_AT)[0] for order in "<>"]
        if any(version in (6, 7) for version in versions):
            return "SAC", _COUNTS
    return None


def known_text(head: str) -> tuple[str, str] | None:
    """Return name and advice of a text file by its first lines, or None."""
    for pattern, name, instead in _LINES:
        if pattern.match(head):
            return name, instead
    return None
