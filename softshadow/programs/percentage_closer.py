"""Percentage-closer filtering with comparisons in the program: the number of texels around a position that are lit.

With GL_NEAREST the column of a texel depends on the offset in s alone, and its row on the offset in t alone: (2 r + 1)²
lookups need 2 (2 r + 1) texel coordinates. Each is computed as in a separate lookup, so the bits are the same. Usually
the texels are adjacent, and one corner gives all of them.

References: Reeves, Salesin & Cook 1987, "Rendering antialiased shadows with depth maps".
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.programs.filtering import CONSTANT_ZERO, RED, STEP_OF_23_BITS, fetch, sources_of, texels_of, wraps_of
from softshadow.programs.program import needs_blocks
from softshadow.programs.reads import is_noting
from softshadow.programs.sampling import is_complete, sample
from softshadow.programs.wrapping import nearest_texels
from softshadow.texture import Texture
from softshadow.tokens import GL_NEAREST, GL_NONE

# position of a pixel's texels: adjacent and inside the image, all outside it (border colour), or anything else
ADJACENT, OUTSIDE, MIXED = (np.int8(kind) for kind in range(3))
USUAL_SIDE = 5  # of the square of texels


def count_lit(texture: Texture, projected: np.ndarray, depths: np.ndarray, radius: int, texel: Any) -> np.ndarray:
    """Return the number (N,) of positions around each pixel where its depth is at most the texture's red.

    Parameters
    ----------
    projected : (N, 3)           s and t of the central position
    depths : (N,)                depths to compare
    radius, texel                the positions are offset by `texel` times -radius ... radius on both axes
    """
    stored = np.empty((len(projected), 1), projected.dtype)
    if radius == 0:
        sample(texture, projected, stored)
        return (depths <= stored[:, 0]).astype(projected.dtype)
    lit = np.zeros(len(projected), projected.dtype)
    offsets = np.arange(-radius, radius + 1).astype(projected.dtype) * texel
    if is_plain(texture) and not is_noting():
        image, sampler = texture.base(), texture.sampler
        assert image is not None
        cells, border, unit = texels_of(image, sampler, projected.dtype)
        wraps = wraps_of(sampler, texture.images.get((0, 0)) or image)
        texels = np.empty((2, len(offsets), len(projected)), np.int32)
        for axis, size in enumerate((image.width, image.height)):
            for texel_of, offset in zip(texels[axis], offsets, strict=True):
                nearest_texels(projected[:, axis] + offset, size, wraps[axis], texel_of)
        kinds = np.empty(len(projected), np.int8)
        classify(texels, image.width, image.height, *np.ones((3, len(projected)), bool), kinds)
        if unit == STEP_OF_23_BITS:
            kinds[kinds == ADJACENT] = MIXED
        count_nearest(texels, kinds, depths, cells, image.width, border, unit, lit)
        return lit
    place = projected.copy(order="F")
    for t_offset in offsets:
        place[:, 1] = projected[:, 1] + t_offset
        for s_offset in offsets:
            place[:, 0] = projected[:, 0] + s_offset
            sample(texture, place, stored)
            lit += depths <= stored[:, 0]
    return lit


def is_plain(texture: Texture) -> bool:
    """Return whether the red of a lookup is one unchanged texel of the base image."""
    image, sampler = texture.base(), texture.sampler
    if image is None or not is_complete(texture) or needs_blocks(texture):
        return False
    compares = image.format.kind == "depth" and sampler.compare_mode != GL_NONE
    return sampler.mag_filter == GL_NEAREST and not compares and sources_of(image, sampler)[0] < CONSTANT_ZERO


@kernel
def classify(texels, width, height, inside, beside, above, kinds):
    """Write to `kinds` (N,) whether each pixel's texels (2, k, N), columns and rows, are adjacent, outside or mixed.

    `inside`, `beside`, `above` (N,) bool are temporary arrays, True on entry.
    """
    columns, rows, last = texels[0], texels[1], texels.shape[1] - 1
    for n in range(len(kinds)):
        inside[n] = (columns[0, n] >= 0) & (columns[last, n] < width) & (rows[0, n] >= 0) & (rows[last, n] < height)
    for i in range(last):
        for n in range(len(kinds)):
            inside[n] &= (columns[i + 1, n] - columns[i, n] == 1) & (rows[i + 1, n] - rows[i, n] == 1)
    for i in range(last + 1):
        for n in range(len(kinds)):
            beside[n] &= (columns[i, n] < 0) | (columns[i, n] >= width)
            above[n] &= (rows[i, n] < 0) | (rows[i, n] >= height)
    for n in range(len(kinds)):
        kinds[n] = OUTSIDE if beside[n] | above[n] else (ADJACENT if inside[n] else MIXED)


@inlined
def count_square(cells, column, row, side, depth, border, unit):
    """Return how many of side² texels, from a column and row on, are at least as far as a depth."""
    lit, left, top = np.int32(0), np.uint64(column), np.uint64(row)  # unsigned indices need no check for negative ones
    for j in range(side):
        texels = cells[top + np.uint64(j)]
        for i in range(side):
            lit += np.int32(depth <= border.dtype.type(texels[left + np.uint64(i), 0]) * unit)
    return lit


@kernel
def count_nearest(texels, kinds, depths, cells, width, border, unit, lit):
    """Write to `lit` (N,) how many of each pixel's texels are at least as far as its depth (first channel).

    `texels` (2, k, N) are k columns and k rows for each pixel; `kinds` (N,) says how they are arranged. Texels are read
    row by row.
    """
    columns, rows, side = texels[0], texels[1], texels.shape[1]
    for n in range(len(lit)):
        depth, n_lit = depths[n], np.int32(0)
        if kinds[n] == OUTSIDE:
            n_lit = np.int32(side * side if depth <= border[0] else 0)
        elif kinds[n] == ADJACENT and side == USUAL_SIDE:  # a constant side: the compiler unrolls the loops
            n_lit = count_square(cells, columns[0, n], rows[0, n], USUAL_SIDE, depth, border, unit)
        elif kinds[n] == ADJACENT:
            n_lit = count_square(cells, columns[0, n], rows[0, n], side, depth, border, unit)
        else:
            for j in range(side):
                for i in range(side):
                    column, row = np.int64(columns[i, n]), np.int64(rows[j, n])
                    n_lit += np.int32(depth <= fetch(cells, width, border, unit, column, row, RED))
        lit[n] = n_lit
