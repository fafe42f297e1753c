"""How many texels round a place a depth passes: percentage-closer filtering, with a comparison in the program.

Under GL_NEAREST the column of a texel depends on one of the two offsets only, and the row on the other: (2 r + 1)²
lookups take 2 (2 r + 1) texel coordinates. Each is computed as a lookup of its own would compute it, so these are its
bits.

References: Reeves, Salesin & Cook 1987, "Rendering antialiased shadows with depth maps".
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.jit import kernel
from softshadow.programs import needs_blocks
from softshadow.programs.filtering import CONSTANT_ZERO, fetch, sources_of, texels_of, wraps_of
from softshadow.programs.sampling import is_complete, sample
from softshadow.programs.wrapping import nearest_texel
from softshadow.texture import Texture
from softshadow.tokens import GL_NEAREST, GL_NONE


def count_lit(texture: Texture, projected: np.ndarray, depths: np.ndarray, radius: int, texel: Any) -> np.ndarray:
    """Return (N,): at how many places a depth is at most the texture's red.

    Parameters
    ----------
    projected : (N, 3)           s and t in the middle
    depths : (N,)                what is compared
    radius, texel                the places are `texel` times -radius ... radius apart from the middle, on both axes
    """
    lit = np.zeros(len(projected), projected.dtype)
    offsets = np.arange(-radius, radius + 1).astype(projected.dtype) * texel
    if is_plain(texture):
        image, sampler = texture.base(), texture.sampler
        assert image is not None
        cells, border, unit = texels_of(image, sampler, projected.dtype)
        wraps = wraps_of(sampler, texture.images.get((0, 0)) or image)
        count_nearest(projected, depths, offsets, cells, image.width, wraps, border, unit, lit)
        return lit
    place, stored = projected.copy(), np.empty((len(projected), 1), projected.dtype)
    for t_offset in offsets:
        place[:, 1] = projected[:, 1] + t_offset
        for s_offset in offsets:
            place[:, 0] = projected[:, 0] + s_offset
            sample(texture, place, stored)
            lit += depths <= stored[:, 0]
    return lit


def is_plain(texture: Texture) -> bool:
    """Return whether a lookup's red is one texel of the base image, as it is there."""
    image, sampler = texture.base(), texture.sampler
    if image is None or not is_complete(texture) or needs_blocks(texture):
        return False
    compares = image.format.kind == "depth" and sampler.compare_mode != GL_NONE
    return sampler.mag_filter == GL_NEAREST and not compares and sources_of(image, sampler)[0] < CONSTANT_ZERO


@kernel
def count_nearest(projected, depths, offsets, cells, width, wraps, border, unit, lit):
    """Add to `lit` (N,) how many texels round each place are at least as far as its depth; all texels' first channel.

    The columns of one row are looked up before the next row, so that neighbours in memory are read together.
    """
    height, side = cells.shape[0], offsets.shape[0]
    columns = np.empty(side, np.int64)
    for n in range(projected.shape[0]):
        s, t, depth = projected[n, 0], projected[n, 1], depths[n]
        for i in range(side):
            columns[i] = nearest_texel(s + offsets[i], width, wraps[0])
        count = 0
        for j in range(side):
            row = nearest_texel(t + offsets[j], height, wraps[1])
            for i in range(side):
                count += 1 if depth <= fetch(cells, width, border, unit, columns[i], row, 0) else 0
        lit[n] += count
