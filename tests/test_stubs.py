"""The stubs of the extension module are generated, and are those of the module that is built."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


@pytest.mark.skipif(shutil.which("cargo") is None, reason="no cargo on the path: stubs are not made again")
def test_stubs_are_current() -> None:
    pytest.importorskip("maturin", reason="maturin is not installed: stubs are not made again")
    command = [sys.executable, str(ROOT / "tools" / "make_stubs.py"), "--check"]
    check = subprocess.run(command, capture_output=True, text=True, check=False)
    assert check.returncode == 0, check.stdout + check.stderr
