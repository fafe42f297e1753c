"""Anisotropic filters (EXT_texture_filter_anisotropic): the texels in an ellipse, bit for bit as llvmpipe.

The pixel's footprint in the texture is an ellipse; its short axis selects the mipmap level. All texels of this level
inside the ellipse count, weighted by a Gaussian (EWA, elliptical weighted average). Derivatives are those of the 2x2
block. llvmpipe does not limit the ratio of the axes: any GL_TEXTURE_MAX_ANISOTROPY of 2 or more gives the same.

References: Heckbert 1989, "Fundamentals of Texture Mapping and Image Warping", p. 59; lp_build_pmin and
lp_build_sample_aniso of Mesa 22.3.
"""

from __future__ import annotations

import math

import numpy as np

from softshadow.image import Image
from softshadow.jit import kernel
from softshadow.programs.box_filtering import box_wraps, mix_floats, nearest_on_axis, row_of
from softshadow.programs.filtering import CONSTANT_ZERO, fetch, sources_of, texels_of
from softshadow.programs.level_of_detail import steps_in_blocks, truncated_levels
from softshadow.programs.wrapping import HALF, ONE, ZERO, to_integer
from softshadow.texture import Texture
from softshadow.tokens import GL_TEXTURE_RECTANGLE

LAST_WEIGHT = 1023
TWO, FOUR, SCALE = np.float32(2.0), np.float32(4.0), np.float32(LAST_WEIGHT)
# texels of an ellipse's box: no loop may be endless, whatever the coordinates are
MOST_TEXELS, WIDEST = 1 << 33, 1 << 16  # in all; on both axes, where there would be more
FEW_COLUMNS = 256  # of a box, which are looked up once for all its rows


def _weights() -> np.ndarray:
    """Return the weights (1024,) by squared distance from the centre: exp(-2 r), in llvmpipe with six decimals."""
    ratios = np.arange(LAST_WEIGHT + 1, dtype=np.float32) / SCALE
    exact = np.array([math.exp(-2 * float(ratio)) for ratio in ratios]).astype(np.float32)
    return np.array([round(float(weight), 6) for weight in exact], np.float32)


WEIGHTS = _weights()


def sample_ellipses(texture: Texture, coordinates: np.ndarray, n_levels: int, out: np.ndarray) -> None:
    """Fill `out` (N, 4) with filtered colours, from the first `n_levels` levels.

    coordinates (N, 3) are those of complete 2x2 blocks.
    """
    image, sampler = texture.base(), texture.sampler
    assert image is not None
    first = texture.images.get((0, 0)) or image
    side = np.array((first.width, first.height), np.float32)
    steps = np.ascontiguousarray(steps_in_blocks(coordinates, 2))
    levels = np.zeros(len(steps), np.int32)
    if n_levels > 1:
        texels = steps * np.array((image.width, image.height), steps.dtype)
        texels = texels * texels
        lengths = texels[..., 0] + texels[..., 1]
        levels = truncated_levels(np.minimum(lengths[:, 0], lengths[:, 1]), sampler, n_levels - 1)
    levels += sampler.base_level
    for level in np.flatnonzero(np.bincount(levels)).tolist():
        blocks = np.flatnonzero(levels == level)
        pixels = (4 * blocks[:, None] + np.arange(4)).ravel()
        part = np.empty((out.shape[1], len(pixels)), out.dtype)
        scaled = side * np.float32(1.0 / (1 << level))
        footprints = steps[blocks] * side * np.float32(1.0 / (1 << level))
        average_level(texture, texture.images[0, level], scaled, footprints, coordinates[pixels], part)
        out[pixels] = part.T


def average_level(
    texture: Texture, image: Image, scaled: np.ndarray, footprints: np.ndarray, coordinates: np.ndarray, out: np.ndarray
) -> None:
    """Fill `out` (k, N) from one level.

    `footprints` (N / 4, 2, 2) are the steps to the next column and row of each 2x2 block, in texels.
    """
    sources = sources_of(image, texture.sampler)
    cells, border, unit = texels_of(image, texture.sampler, coordinates.dtype)
    places = np.ascontiguousarray(coordinates.T)
    sides = np.array((image.width, image.height, image.slices))
    wraps = np.array(box_wraps(texture, texture.images.get((0, 0)) or image))
    normalized = texture.target != GL_TEXTURE_RECTANGLE
    columns, has_texels = np.empty(FEW_COLUMNS, np.int64), np.empty(len(coordinates), np.bool_)
    with np.errstate(all="ignore"):
        average_ellipses(
            places, footprints, scaled, cells, sides, wraps, normalized, border, unit, WEIGHTS, sources, columns,
            has_texels, out,
        )  # fmt: skip
    if not has_texels.all():
        without = np.flatnonzero(~has_texels)
        mixed = np.empty((len(out), len(without)), out.dtype)
        mix_floats(
            np.ascontiguousarray(places[:, without]), cells, sides, wraps, normalized, border, unit, sources, mixed
        )
        out[:, without] = mixed


@kernel
def ellipse_of(ux, vx, uy, vy):
    """Return (A, B, C, half width, half height) of the ellipse A u u + B u v + C v v = LAST_WEIGHT around the origin.

    (ux, vx) and (uy, vy) are the steps to the next column and row, in texels.
    """
    a = (vx * vx + vy * vy) + ONE
    b = (ux * vx + uy * vy) * -TWO
    c = (ux * ux + uy * uy) + ONE
    f = a * c - (b * b) / FOUR
    d = (ZERO - b * b) + (a * c) * FOUR
    half_width, half_height = (TWO / d) * np.sqrt((d * c) * f), (TWO / d) * np.sqrt((a * d) * f)
    scale = SCALE / f
    return a * scale, b * scale, c * scale, half_width, half_height


@kernel
def weight_at(weights, q):
    """Return the weight at a scaled squared distance, 0 outside the ellipse."""
    index = to_integer(q)
    return weights[max(index, 0)] if index <= LAST_WEIGHT else ZERO


@kernel
def box_of(u, v, half_width, half_height):
    """Return (first column, first row, columns - 1, rows - 1) of the box of texels around an ellipse at (u, v)."""
    u0, u1 = to_integer(np.floor(u - half_width)), to_integer(np.ceil(u + half_width))
    v0, v1 = to_integer(np.floor(v - half_height)), to_integer(np.ceil(v + half_height))
    columns, rows = min(u1 - u0, MOST_TEXELS), min(v1 - v0, MOST_TEXELS)
    if (columns + 1) * (rows + 1) > MOST_TEXELS:
        columns, rows = min(columns, WIDEST), min(rows, WIDEST)
    return u0, v0, columns, rows


@kernel
def average_ellipses(
    coordinates, footprints, scaled, cells, sides, wraps, normalized, border, unit, weights, sources, found,
    has_texels, out,
):  # fmt: skip
    """Write the weighted means of the texels in all ellipses to `out` (k, N), and which ellipses have texels.

    `found` is scratch for the columns of a box.
    """
    width = sides[0]
    a, b, c, half_width, half_height = ZERO, ZERO, ZERO, ZERO, ZERO
    for n in range(coordinates.shape[1]):
        if n & 3 == 0:  # the next block
            step = footprints[n >> 2]
            a, b, c, half_width, half_height = ellipse_of(step[0, 0], step[0, 1], step[1, 0], step[1, 1])
        u, v = coordinates[0, n] * scaled[0] - HALF, coordinates[1, n] * scaled[1] - HALF
        u0, v0, columns, rows = box_of(u, v, half_width, half_height)
        left = np.float32(u0) - u
        first_step, first_q = (TWO * left + ONE) * a, (left * left) * a
        total, red, green, blue, alpha = ZERO, ZERO, ZERO, ZERO, ZERO
        k = nearest_on_axis(coordinates[2, n], sides[2], wraps[2], normalized) if len(wraps) > 2 else 0
        is_narrow = columns < len(found)
        if is_narrow:
            for i in range(columns + 1):
                s = np.float32(u0 + i) / np.float32(width)
                found[i] = nearest_on_axis(s, width, wraps[0], normalized)
        for j in range(v0, v0 + rows + 1):
            up = np.float32(j) - v
            step, q = up * b + first_step, (c * up + b * left) * up + first_q
            t = np.float32(j) / np.float32(sides[1])
            row = row_of(nearest_on_axis(t, sides[1], wraps[1], normalized), k, sides)
            for i in range(u0, u0 + columns + 1):
                weight = weight_at(weights, q)
                if weight != ZERO:
                    if is_narrow:
                        column = found[i - u0]
                    else:
                        column = nearest_on_axis(np.float32(i) / np.float32(width), width, wraps[0], normalized)
                    red += channel_of(cells, width, border, unit, column, row, sources[0]) * weight
                    green += channel_of(cells, width, border, unit, column, row, sources[1]) * weight
                    blue += channel_of(cells, width, border, unit, column, row, sources[2]) * weight
                    alpha += channel_of(cells, width, border, unit, column, row, sources[3]) * weight
                    total += weight
                q += step
                step += a * TWO
        has_texels[n] = total != ZERO
        if total != ZERO:
            out[0, n], out[1, n], out[2, n], out[3, n] = red / total, green / total, blue / total, alpha / total


@kernel
def channel_of(cells, width, border, unit, column, row, source):
    """Return a channel of a texel, or a constant."""
    if source >= CONSTANT_ZERO:
        return ZERO if source == CONSTANT_ZERO else ONE
    return fetch(cells, width, border, unit, column, row, source)
