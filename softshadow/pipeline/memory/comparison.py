"""Comparisons of arrays by their bytes: 0 is not -0, and NaN equals itself."""

import ctypes
import os

import numpy as np

SMALL = 1 << 14  # bytes: up to here, copies are compared faster than memory, of which numpy must tell the address
_memcmp = ctypes.CDLL("msvcrt" if os.name == "nt" else None).memcmp
_memcmp.argtypes = (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t)
_memcmp.restype = ctypes.c_int


def same_memory(address: int, other: int, n_bytes: int) -> bool:
    """Return whether two places in memory hold the same bytes."""
    return bool(_memcmp(address, other, n_bytes) == 0)


def same_bits(a: np.ndarray, b: np.ndarray) -> bool:
    """Return whether two arrays have the same dtype, the same shape and the same bits."""
    if a is b:
        return True
    if a.dtype != b.dtype or a.shape != b.shape:
        return False
    if a.nbytes <= SMALL:
        return a.tobytes() == b.tobytes()
    if a.flags.c_contiguous and b.flags.c_contiguous:
        return same_memory(a.ctypes.data, b.ctypes.data, a.nbytes)
    as_bits = f"u{a.dtype.itemsize}"
    return np.array_equal(a.view(as_bits), b.view(as_bits))
