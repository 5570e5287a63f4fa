"""The same bits on every x86-64 processor: elementary functions, and a matched motion, with and without AVX-512."""

from __future__ import annotations

import hashlib
import math
import os
import subprocess
import sys
from functools import cache

import numpy as np
import pytest

from seismass.motions import elementary

AVX512 = ("X86_V4", "AVX512_ICL", "AVX512_SPR", "AVX512_SKX", "AVX512_CLX", "AVX512_CNL", "AVX512F", "AVX512CD")
"""What NumPy calls features of processors with AVX-512, in old and new versions."""
FUSED = ("X86_V3", "AVX2", "FMA3")
PROGRAM = """
import hashlib
import sys

import numpy as np

import seismass as sm
from seismass.motions import elementary

if sys.argv[1] == "functions":
    x = np.random.default_rng(1).uniform(-1.0, 1.0, 2 * 10**5)
    z = elementary.joined(x, 1000.0 * x)
    far, near = elementary.complex_series(z[:9], 1e-3 * z[:9], 500)
    parts = [
        elementary.exp(700.0 * x), elementary.log(1.5 + x),
        elementary.power(1.0 + x, 0.93), *elementary.cos_sin(1e5 * x),
        elementary.sinh(2.0 * x), elementary.complex_exp(z), elementary.complex_sinh(z), elementary.times(z, z[::-1]),
        elementary.series_real(far[0], near[0]), elementary.geomspace(0.2, 1.5, 163),
    ]
else:
    record = sm.builtin_suite()[0].with_duration(15.0)
    found = sm.matching.match_spectrum(record, sm.TargetSpectrum.asce7().tilted(0.1), points=100, max_iterations=2)
    parts = [found.record.acceleration]
digest = hashlib.sha256()
for part in parts:
    digest.update(np.ascontiguousarray(part).tobytes())
print(digest.hexdigest())
"""


def present(*names: str) -> list[str]:
    """Those of NumPy's features that this processor has and this NumPy tells apart."""
    core = getattr(np, "_core", None) or np.core
    features = core._multiarray_umath.__cpu_features__
    dispatched = core._multiarray_umath.__cpu_dispatch__
    return [name for name in names if features.get(name) and name in dispatched]


@cache
def digest(what: str, **environment: str) -> str:
    """What the program prints with these variables set; run once for each."""
    kept = {name: value for name, value in os.environ.items() if name not in environment}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, what], env=kept | environment, capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


@pytest.mark.parametrize("what", ["functions", "matching"])
def test_bits_do_not_depend_on_avx512(what: str) -> None:
    disabled = present(*AVX512)
    if not disabled:
        pytest.skip("no AVX-512 here: NumPy has nothing to leave out")
    expected = digest(what)
    assert len(expected) == hashlib.sha256().digest_size * 2
    assert digest(what, NPY_DISABLE_CPU_FEATURES=" ".join(disabled)) == expected
    older = " ".join(disabled + present(*FUSED))
    variables = {"OPENBLAS_CORETYPE": "Nehalem", "SEISMASS_INSTRUCTIONS": "baseline"}
    assert digest(what, NPY_DISABLE_CPU_FEATURES=older, **variables) == expected


def test_bits_do_not_depend_on_the_linear_algebra_library() -> None:
    """OpenBLAS as on processors of four kinds; those that this one cannot run, it replaces."""
    expected = digest("matching")
    for kind in ("Nehalem", "Haswell"):
        assert digest("matching", OPENBLAS_CORETYPE=kind) == expected


def test_elementary_functions_are_close_to_those_of_the_c_library() -> None:
    """Within 3 units of the last digit, with one for the C library."""
    x = np.random.default_rng(3).uniform(-1.0, 1.0, 3000)
    for found, of, at in (
        (elementary.exp(700.0 * x), math.exp, 700.0 * x),
        (elementary.log(1.0 + 0.99 * x), math.log, 1.0 + 0.99 * x),
        (elementary.log(np.ldexp(1.5 + x, 300)), math.log, np.ldexp(1.5 + x, 300)),
        (elementary.cos(20.0 * x), math.cos, 20.0 * x),
        (elementary.cos_sin(20.0 * x)[1], math.sin, 20.0 * x),
        (elementary.sinh(1e-3 * x), math.sinh, 1e-3 * x),
        (elementary.sinh(2.0 * x), math.sinh, 2.0 * x),
    ):
        expected = np.array([of(value) for value in at.tolist()])
        assert (np.abs(found - expected) <= 4.0 * np.spacing(np.abs(expected))).all()
    assert elementary.power(np.array([0.0, 1.0, 4.0, 9.0]), 0.5) == pytest.approx([0.0, 1.0, 2.0, 3.0], rel=1e-15)
    assert elementary.power(4.0, -0.5) == pytest.approx(0.5, rel=1e-15)
    assert elementary.exp(np.array([-1000.0, 0.0])).tolist() == [0.0, 1.0]
    z = elementary.joined(x, 5.0 * x[::-1])
    assert elementary.complex_exp(z) == pytest.approx(np.exp(z), rel=1e-14)
    assert elementary.complex_sinh(z) == pytest.approx(np.sinh(z), rel=1e-14)
    assert elementary.times(z, z[::-1]) == pytest.approx(z * z[::-1], rel=1e-14, abs=1e-15)
    assert elementary.geomspace(0.2, 1.5, 50) == pytest.approx(np.geomspace(0.2, 1.5, 50), rel=1e-14)
    assert elementary.geomspace(0.2, 1.5, 1).tolist() == [0.2]
    assert elementary.rounded(np.array([0.0, 1.75, -23.0]), 2).tolist() == [0.0, 2.0, -24.0]


def test_series_are_exponentials_of_equal_steps() -> None:
    start, rate = np.array([0.1 + 2.0j, -0.3j]), np.array([-0.01 + 0.3j, 0.02j])
    far, near = elementary.complex_series(start, rate, 300)
    for number in range(2):
        expected = np.exp(start[number] + rate[number] * np.arange(300))
        assert elementary.series_real(far[number], near[number])[:300] == pytest.approx(expected.real, abs=1e-13)
        assert elementary.series_imaginary(far[number], near[number])[:300] == pytest.approx(expected.imag, abs=1e-13)


def test_numbers_without_a_result_are_refused() -> None:
    with pytest.raises(ValueError, match=r"x of exp must be up to 709\.7; got 710"):
        elementary.exp(710.0)
    with pytest.raises(ValueError, match=r"x of log must be positive and finite; got -1"):
        elementary.log(np.array([1.0, -1.0]))
