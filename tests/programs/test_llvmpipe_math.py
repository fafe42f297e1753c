"""llvmpipe's log2, exp2 and pow: close to the exact values, and equal if these are representable."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow.programs.llvmpipe_math import exp2, log2, power

# the largest relative error of llvmpipe's polynomials, measured over 10^6 arguments and rounded up
EXP2_ERROR, LOG2_ERROR = 2e-6, 2e-6


@pytest.mark.interpreted
def test_exact_values():
    assert [float(exp2(np.float32(x))) for x in (-3, 0, 1, 10)] == [0.125, 1, 2, 1024]
    assert [float(log2(np.float32(x))) for x in (0.25, 1, 8)] == [-2, 0, 3]
    assert float(exp2(np.float32(-200))) == 0
    assert float(exp2(np.float32(130))) == math.inf
    assert float(log2(np.float32(0))) == -math.inf
    assert math.isnan(log2(np.float32(-1)))
    assert float(power(np.float32(0), np.float32(0))) == 0  # as in Mesa


@given(st.floats(-100, 100, width=32))
def test_exp2_is_near(x):
    assert math.isclose(exp2(np.float32(x)), 2.0**x, rel_tol=EXP2_ERROR)


@given(st.floats(2**-40, 2**40, width=32))
def test_log2_is_near(x):
    assert math.isclose(log2(np.float32(x)), math.log2(x), rel_tol=LOG2_ERROR, abs_tol=LOG2_ERROR)
