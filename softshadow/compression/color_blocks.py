"""Blocks of colours: two colours of 5, 6 and 5 bits and, for each of 16 texels, one of four mixtures. S3TC.

References: EXT_texture_compression_s3tc; `s3tc_dxt1_full_to_rgba_aos` in lp_bld_format_s3tc.c of Mesa.
"""

from __future__ import annotations

import numpy as np

from softshadow.packed_colors import with_more_bits

THIRD = 85  # llvmpipe's third, in 1/256


def colors(blocks: np.ndarray, has_three: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return (colours (..., 16, 3) int64 in 0 to 255, transparent (..., 16) bool) of blocks (..., 8) uint8.

    `has_three`: blocks whose first colour is not the larger number have three colours, and transparent black (DXT1).
    """
    words = np.ascontiguousarray(blocks[..., :4]).view("<u2").astype(np.int64)
    first, second = _expanded(words[..., 0]), _expanded(words[..., 1])
    step = THIRD * (second - first)
    four = np.stack([first, second, first + (step >> 8) & 255, first + (step >> 7) & 255], axis=-2)
    is_three = (words[..., 0] <= words[..., 1]) & has_three
    three = np.stack([first, second, first + second + 1 >> 1, np.zeros_like(first)], axis=-2)
    palette = np.where(is_three[..., np.newaxis, np.newaxis], three, four)
    codes = blocks[..., 4:, np.newaxis].astype(np.int64) >> np.array([0, 2, 4, 6]) & 3
    codes = codes.reshape(*blocks.shape[:-1], 16)
    chosen = np.take_along_axis(palette, codes[..., np.newaxis], axis=-2)
    return chosen, is_three[..., np.newaxis] & (codes == 3)


def _expanded(words: np.ndarray) -> np.ndarray:
    """Return colours (..., 3) of 8 bits of words (...) of 5, 6 and 5 bits."""
    parts = ((words >> 11, 5), (words >> 5 & 63, 6), (words & 31, 5))
    return np.stack([with_more_bits(part, n_bits, 8) for part, n_bits in parts], axis=-1)
