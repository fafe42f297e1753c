"""log2, exp2 and pow as in llvmpipe's shaders: polynomials in float32, with the same bits on every CPU.

GL does not specify how to compute them. The terms and their order are those of llvmpipe, so lighting and fog agree with
Mesa to the last bit. Other functions need no emulation: llvmpipe's 1/x and 1/sqrt(x) are exactly rounded divisions and
roots.

Special values are selected last and all integers are int32, so that loops over these functions are vectorised (9 times
as fast).

References: lp_bld_arit.c of Mesa 22.3 (polynomial, exp2, log2_safe, pow).
"""

import numpy as np

from softshadow.jit import inlined, kernel

ZERO, ONE = np.float32(0.0), np.float32(1.0)
INFINITY, NOT_A_NUMBER = np.float32(np.inf), np.float32(np.nan)
# coefficients of x^0, x^1, ...
E0, E1, E2, E3, E4, E5 = (
    np.float32(c)
    for c in (
        1.0,
        0.693153073200168932794,
        0.240153617044375388211,
        0.0558263180532956664775,
        0.00898934009049466391101,
        0.00187757667519147912699,
    )
)
L0, L1, L2, L3, L4 = (
    np.float32(c)
    for c in (
        2.88539009343309178325,
        0.961791550404184197881,
        0.577440339438736392009,
        0.403343858251329912514,
        0.406718052498846252698,
    )
)
LARGEST_EXPONENT, SMALLEST_EXPONENT = np.float32(128.0), np.float32(-126.99999)
EXPONENT_BIAS, MANTISSA_BITS, MANTISSA, ONE_BITS = (np.int32(bits) for bits in (127, 23, 0x7FFFFF, 0x3F800000))


@inlined
def exp2(x):
    """Return 2^x: 0 below -126, infinity from 128 on, NaN for NaN."""
    limited = x if x > SMALLEST_EXPONENT else SMALLEST_EXPONENT
    limited = limited if limited < LARGEST_EXPONENT else LARGEST_EXPONENT
    whole = np.floor(limited)
    part = limited - whole
    square = part * part
    even = square * (square * E4 + E2) + E0
    odd = square * (square * E5 + E3) + E1
    power_of_two = np.int32((np.int32(whole) + EXPONENT_BIAS) << MANTISSA_BITS).view(np.float32)
    return power_of_two * (odd * part + even) if x == x else x


@inlined
def log2(x):
    """Return log2(x): -infinity at 0, NaN below 0."""
    bits = np.float32(x).view(np.int32)
    exponent = np.float32((bits >> MANTISSA_BITS) - EXPONENT_BIAS)
    mantissa = np.int32(bits & MANTISSA | ONE_BITS).view(np.float32)
    y = (mantissa - ONE) / (mantissa + ONE)
    z = y * y
    square = z * z
    even = square * (square * L4 + L2) + L0
    odd = square * L3 + L1
    finite = y * (odd * z + even) + exponent
    positive = finite if x < INFINITY else INFINITY
    return positive if x > ZERO else (-INFINITY if x == ZERO else NOT_A_NUMBER)


@inlined
def power(x, exponent):
    """Return x^exponent as 2^(log2(x) exponent); 0 if x is 0, even for exponent 0."""
    raised = exp2(log2(x if x != ZERO else ONE) * exponent)
    return raised if x != ZERO else ZERO


@kernel
def powers(x, exponents, out):
    """Write x^exponent to `out` (N,) for each pair of elements of two arrays (N,)."""
    for n in range(len(x)):
        out[n] = power(x[n], exponents[n])


@kernel
def exp2_of_all(x, out):
    """Write 2^x to `out` (N,) for each element of an array (N,)."""
    for n in range(len(x)):
        out[n] = exp2(x[n])
