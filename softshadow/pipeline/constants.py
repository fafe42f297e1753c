"""The numbers of the float32 kernels, named: a literal such as 0.5 would be float64 once compiled."""

import numpy as np

ZERO = np.float32(0.0)
ONE = np.float32(1.0)
TWO = np.float32(2.0)
HALF = np.float32(0.5)
INFINITY = np.float32(np.inf)
SUBPIXEL_BITS = 8
SUBPIXELS = np.float32(1 << SUBPIXEL_BITS)
HALF_RANGE = np.float32(1 << 31)  # of an unsigned 32-bit integer
SMALLEST_NORMAL = np.finfo(np.float32).tiny
