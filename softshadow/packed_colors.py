"""Packed pixel types: all components of a colour in one integer, such as GL_UNSIGNED_SHORT_5_6_5.

References: GL 2.1, sec. 3.6.4, tables 3.6-3.8.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow import tokens as gl
from softshadow.packed_floats import SharedExponent, SmallFloats

THREE, FOUR, FOUR_ALIKE = (gl.GL_RGB,), (gl.GL_RGBA, gl.GL_BGRA), (gl.GL_RGBA, gl.GL_BGRA, gl.GL_ABGR_EXT)


@dataclass(frozen=True)
class PackedColor:
    """A packed type: the integer, and (lowest bit, number of bits) of each component, in the order of the format.

    The components are integers, or floats of few bits, whose fields do not matter.
    """

    dtype: np.dtype
    fields: tuple[tuple[int, int], ...]
    small_floats: SharedExponent | SmallFloats | None = None

    @property
    def formats(self) -> tuple[int, ...]:
        """The pixel formats that the type can be used with."""
        if len(self.fields) == len("RGB"):
            return THREE
        return FOUR_ALIKE if len({n_bits for _, n_bits in self.fields}) == 1 else FOUR

    @property
    def largest(self) -> np.ndarray:
        """The integers that represent 1, one for each component."""
        return np.array([(1 << n_bits) - 1 for _, n_bits in self.fields], np.int64)

    def split(self, words: np.ndarray) -> np.ndarray:
        """Return the components (..., n) int64 of packed pixels (...)."""
        parts = [words.astype(np.int64) >> shift & (1 << n_bits) - 1 for shift, n_bits in self.fields]
        return np.stack(parts, axis=-1)

    def join(self, components: np.ndarray) -> np.ndarray:
        """Return the packed pixels (...) of components (..., n), integers from 0 to `largest`."""
        words = np.zeros(components.shape[:-1], np.int64)
        for part, (shift, _) in enumerate(self.fields):
            words |= components[..., part].astype(np.int64) << shift
        return words.astype(self.dtype)


def _types(dtype: type[np.generic], from_top: str, from_bottom: str, *n_bits: int) -> dict[int, PackedColor]:
    """Return a type whose first component is in the highest bits, and its reverse, GL_..._REV, with the lowest."""
    total, begin = sum(n_bits), 0
    top, bottom = [], []
    for n in n_bits:
        top.append((total - begin - n, n))
        bottom.append((begin, n))
        begin += n
    kind = np.dtype(dtype)
    return {
        getattr(gl, from_top): PackedColor(kind, tuple(top)),
        getattr(gl, from_bottom): PackedColor(kind, tuple(bottom)),
    }


PACKED_COLORS: dict[int, PackedColor] = {
    **_types(np.uint8, "GL_UNSIGNED_BYTE_3_3_2", "GL_UNSIGNED_BYTE_2_3_3_REV", 3, 3, 2),
    **_types(np.uint16, "GL_UNSIGNED_SHORT_5_6_5", "GL_UNSIGNED_SHORT_5_6_5_REV", 5, 6, 5),
    **_types(np.uint16, "GL_UNSIGNED_SHORT_4_4_4_4", "GL_UNSIGNED_SHORT_4_4_4_4_REV", 4, 4, 4, 4),
    **_types(np.uint16, "GL_UNSIGNED_SHORT_5_5_5_1", "GL_UNSIGNED_SHORT_1_5_5_5_REV", 5, 5, 5, 1),
    **_types(np.uint32, "GL_UNSIGNED_INT_8_8_8_8", "GL_UNSIGNED_INT_8_8_8_8_REV", 8, 8, 8, 8),
    **_types(np.uint32, "GL_UNSIGNED_INT_10_10_10_2", "GL_UNSIGNED_INT_2_10_10_10_REV", 10, 10, 10, 2),
    gl.GL_UNSIGNED_INT_5_9_9_9_REV: PackedColor(np.dtype(np.uint32), ((0, 9), (9, 9), (18, 9)), SharedExponent()),
    gl.GL_UNSIGNED_INT_10F_11F_11F_REV: PackedColor(np.dtype(np.uint32), ((0, 11), (11, 11), (22, 10)), SmallFloats()),
}


def with_more_bits(values: np.ndarray, n_bits: int, wanted: int) -> np.ndarray:
    """Return integers of some bits with more bits: their upper bits are repeated below them, as in Mesa.

    Examples
    --------
    >>> with_more_bits(np.array([0, 1, 16, 31]), 5, 8).tolist()
    [0, 8, 132, 255]
    """
    one, more = (1 << n_bits) - 1, (1 << wanted) - 1
    rest = values >> (n_bits - wanted % n_bits) if more % one else 0
    widened: np.ndarray = values * (more // one) + rest
    return widened
