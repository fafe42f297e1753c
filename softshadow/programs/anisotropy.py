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
MOST_TEXELS, WIDEST = 1 << 30, 1 << 14  # in all; on both axes, where there would be more


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
        shortest = (texels[..., 0] + texels[..., 1]).min(axis=1)
        levels = truncated_levels(shortest, sampler, n_levels - 1)
    levels = np.repeat(levels, 4) + sampler.base_level
    steps = np.repeat(steps, 4, axis=0)
    for level in np.unique(levels):
        pixels = np.nonzero(levels == level)[0]
        part = np.empty((out.shape[1], len(pixels)), out.dtype)
        scaled = side * np.float32(1.0 / (1 << int(level)))
        footprints = steps[pixels] * side * np.float32(1.0 / (1 << int(level)))
        average_level(texture, texture.images[0, int(level)], scaled, footprints, coordinates[pixels], part)
        out[pixels] = part.T


def average_level(
    texture: Texture, image: Image, scaled: np.ndarray, footprints: np.ndarray, coordinates: np.ndarray, out: np.ndarray
) -> None:
    """Fill `out` (k, N) from one level; `footprints` (N, 2, 2) are the steps to the next column and row in texels."""
    sources = sources_of(image, texture.sampler)
    cells, border, unit = texels_of(image, texture.sampler, coordinates.dtype)
    places = np.ascontiguousarray(coordinates.T)
    sides = np.array((image.width, image.height, image.slices))
    wraps = np.array(box_wraps(texture, texture.images.get((0, 0)) or image))
    normalized = texture.target != GL_TEXTURE_RECTANGLE
    mix_floats(places, cells, sides, wraps, normalized, border, unit, sources, out)
    with np.errstate(all="ignore"):
        average_ellipses(
            places, footprints, scaled, cells, sides, wraps, normalized, border, unit, WEIGHTS, sources, out
        )


@kernel
def ellipse_of(footprint):
    """Return (A, B, C, F, half width, half height) of the ellipse A u u + B u v + C v v = F around the origin."""
    ux, vx, uy, vy = footprint[0, 0], footprint[0, 1], footprint[1, 0], footprint[1, 1]
    a = (vx * vx + vy * vy) + ONE
    b = (ux * vx + uy * vy) * -TWO
    c = (ux * ux + uy * uy) + ONE
    f = a * c - (b * b) / FOUR
    d = (ZERO - b * b) + (a * c) * FOUR
    return a, b, c, f, (TWO / d) * np.sqrt((d * c) * f), (TWO / d) * np.sqrt((a * d) * f)


@kernel
def weight_at(weights, q):
    """Return the weight at a scaled squared distance, 0 outside the ellipse."""
    index = to_integer(q)
    return weights[max(index, 0)] if index <= LAST_WEIGHT else ZERO


@kernel
def average_ellipses(
    coordinates, footprints, scaled, cells, sides, wraps, normalized, border, unit, weights, sources, out
):
    """Write the weighted means of the texels in all ellipses to `out` (k, N); ellipses without texels stay."""
    for n in range(coordinates.shape[1]):
        a, b, c, f, half_width, half_height = ellipse_of(footprints[n])
        scale = SCALE / f
        a, b, c = a * scale, b * scale, c * scale
        u, v = coordinates[0, n] * scaled[0] - HALF, coordinates[1, n] * scaled[1] - HALF
        u0, u1 = to_integer(np.floor(u - half_width)), to_integer(np.ceil(u + half_width))
        v0, v1 = to_integer(np.floor(v - half_height)), to_integer(np.ceil(v + half_height))
        columns, rows = min(u1 - u0, MOST_TEXELS), min(v1 - v0, MOST_TEXELS)
        if (columns + 1) * (rows + 1) > MOST_TEXELS:
            columns, rows = min(columns, WIDEST), min(rows, WIDEST)
        left = np.float32(u0) - u
        first_step, first_q = (TWO * left + ONE) * a, (left * left) * a
        total, red, green, blue, alpha = ZERO, ZERO, ZERO, ZERO, ZERO
        k = nearest_on_axis(coordinates[2, n], sides[2], wraps[2], normalized) if len(wraps) > 2 else 0
        for j in range(v0, v0 + rows + 1):
            up = np.float32(j) - v
            step, q = up * b + first_step, (c * up + b * left) * up + first_q
            t = np.float32(j) / np.float32(sides[1])
            row = row_of(nearest_on_axis(t, sides[1], wraps[1], normalized), k, sides)
            for i in range(u0, u0 + columns + 1):
                weight = weight_at(weights, q)
                if weight != ZERO:
                    s = np.float32(i) / np.float32(sides[0])
                    column = nearest_on_axis(s, sides[0], wraps[0], normalized)
                    red += channel_of(cells, sides[0], border, unit, column, row, sources[0]) * weight
                    green += channel_of(cells, sides[0], border, unit, column, row, sources[1]) * weight
                    blue += channel_of(cells, sides[0], border, unit, column, row, sources[2]) * weight
                    alpha += channel_of(cells, sides[0], border, unit, column, row, sources[3]) * weight
                    total += weight
                q += step
                step += a * TWO
        if total != ZERO:
            out[0, n], out[1, n], out[2, n], out[3, n] = red / total, green / total, blue / total, alpha / total


@kernel
def channel_of(cells, width, border, unit, column, row, source):
    """Return a channel of a texel, or a constant."""
    if source >= CONSTANT_ZERO:
        return ZERO if source == CONSTANT_ZERO else ONE
    return fetch(cells, width, border, unit, column, row, source)
