"""What the measurements depend on: the machine and the versions, what is missing, and where pages are written."""

from __future__ import annotations

import importlib
import importlib.metadata
import os
import platform
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

import seismass

PACKAGES: Final = ("numpy", "numba", "scipy", "openseespy", "heyoka", "pydiffsol", "polars")


def page_module(name: str) -> Any:
    """Return a module of tools/pages."""
    sys.path.append(str(Path(__file__).parents[1] / "tools"))
    return importlib.import_module(f"pages.{name}")


def cpu() -> str:
    """Return the name of the processor, and the number of its cores that this process may use."""
    info = Path("/proc/cpuinfo")
    found = re.search(r"model name\s*:\s*(.+)", info.read_text()) if info.exists() else None
    name = found.group(1).strip() if found else platform.processor() or platform.machine()
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return f"{name}, {cores} cores"


def versions(packages: Sequence[str] = PACKAGES) -> dict[str, str]:
    """Return the version of Python and of each package, or "absent"."""
    found = {"seismass": seismass.__version__, "Python": platform.python_version()}
    for package in packages:
        try:
            found[package] = importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            found[package] = "absent"
    return found


def program_versions(*programs: str) -> dict[str, str]:
    """Return the version that each program says it has, or "absent"."""
    found = {}
    for program in programs:
        if shutil.which(program) is None:
            found[program] = "absent"
        else:
            told = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout
            number = re.search(r"\d+(?:\.\d+)+", told)
            found[program] = number.group() if number else told.strip()
    return found


def summary(packages: Sequence[str] = PACKAGES, programs: Sequence[str] = ()) -> str:
    """Return both in one line, and how busy the machine is besides."""
    found = versions(packages) | program_versions(*programs)
    load = f" (load before: {os.getloadavg()[0]:.1f})" if hasattr(os, "getloadavg") else ""
    return f"{cpu()}{load}; " + ", ".join(f"{name} {version}" for name, version in found.items())
