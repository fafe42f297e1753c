"""Cube map filters that go beyond 2-D filters: across face edges, or with a filter chosen per pixel; in float.

With GL_TEXTURE_CUBE_MAP_SEAMLESS a filter continues on the neighbouring face. At a corner only three faces meet, and
their three texels share the weight of the missing fourth. llvmpipe shades 2x2 blocks: if one pixel of a block lies at a
corner, all four are computed as a sum of four products, which rounds differently from nested interpolation.

References: GL 3.2 sec. 3.8.8 (seamless cube map filtering); lp_build_sample_image_linear, lp_build_cube_new_coords and
lp_build_sample_mipmap_both of Mesa 22.3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow.jit import kernel
from softshadow.programs.filtering import (
    CONSTANT_ZERO,
    clamp_to_unit,
    fetch,
    mix,
    passes,
    sources_of,
    texels_of,
)
from softshadow.programs.wrapping import HALF, ONE, ZERO, linear_texels, nearest_texel, to_integer
from softshadow.texture import Texture
from softshadow.tokens import GL_CLAMP_TO_EDGE, GL_NONE

THIRD = ONE / np.float32(3.0)
PIXELS_OF_A_BLOCK = 4
# filter of a pixel: nearest texel; linear; or linear with all the weight on the texel that would weigh most
NEAREST, LINEAR, HEAVIEST = 0, 1, 2

# for the edges x < 0, x > last, y < 0, y > last (rows) of the six faces (columns): the neighbouring face, and x and y
# on it: the first texel, the last, the position along the edge, or that position counted from the other end
FIRST, LAST, ALONG, BACK = 0, 1, 2, 3
BEYOND = np.array(
    [
        [(4, 1, 2), (5, 1, 2), (1, 2, 0), (1, 3, 1), (1, 1, 2), (0, 1, 2)],
        [(5, 0, 2), (4, 0, 2), (0, 3, 0), (0, 2, 1), (0, 0, 2), (1, 0, 2)],
        [(2, 1, 3), (2, 0, 2), (5, 3, 0), (4, 2, 1), (2, 2, 1), (2, 3, 0)],
        [(3, 1, 2), (3, 0, 3), (4, 2, 0), (5, 3, 1), (3, 2, 0), (3, 3, 1)],
    ],
    np.int32,
)


class Neighbors(NamedTuple):
    """The four texels of each pixel's filter: (x0, y0), (x1, y0), (x0, y1), (x1, y1).

    texels (N, 4, 3) int32: face, x, y; weights (N, 2) of x1 and y1; corners (N,) int8: index of the texel that lies
    beyond a corner of the cube, or -1.
    """

    texels: np.ndarray
    weights: np.ndarray
    corners: np.ndarray


def filter_cube(
    texture: Texture, levels: np.ndarray, faces: np.ndarray, places: np.ndarray, kinds: np.ndarray
) -> np.ndarray:
    """Return the filtered colours (N, 4), each pixel from one mipmap level.

    Parameters
    ----------
    levels : (N,) int32          mipmap levels, counted from 0 (not from the base level)
    faces, places : (N,), (N, 3) as `cube_maps.on_faces` returns them; pixels in complete 2x2 blocks
    kinds : (N,) int8            `NEAREST`, `LINEAR` or `HEAVIEST`
    """
    sampler, image, real = texture.sampler, texture.base(), places.dtype
    assert image is not None
    sides = np.zeros(levels.max(initial=0) + 1, np.int64)
    for level in np.flatnonzero(np.bincount(levels)).tolist():
        sides[level] = texture.images[0, level].width
    n = len(places)
    neighbors = Neighbors(np.empty((n, 4, 3), np.int32), np.empty((n, 2), real), np.empty(n, np.int8))
    find_neighbors(faces, places, sides[levels], kinds, bool(sampler.seamless), neighbors)
    texels = gather_texels_by_level(texture, levels, neighbors.texels, real)
    sources, out = sources_of(image, sampler), np.empty((n, 4), real)
    if image.format.kind == "depth" and sampler.compare_mode != GL_NONE:
        mix_compared(texels, places[:, 2], neighbors, sampler.compare_func, image.format.largest > 0, sources, out)
    else:
        mix_texels(texels, neighbors, sources, out)
    return out


def gather_texels_by_level(texture: Texture, levels: np.ndarray, texels: np.ndarray, real: np.dtype) -> np.ndarray:
    """Return the values (N, 4, channels), in [0, 1] units, of texels (N, 4, 3) in levels (N,)."""
    image = texture.base()
    assert image is not None
    values = np.empty((*texels.shape[:2], image.format.channels), real)
    for level in np.flatnonzero(np.bincount(levels)).tolist():
        faces = [texels_of(texture.images[face, level], texture.sampler, real) for face in texture.faces]
        _, border, unit = faces[0]
        gather_from_faces(tuple(cells for cells, _, _ in faces), border, unit, level, levels, texels, values)
    return values


@kernel
def gather_from_faces(faces, border, unit, level, levels, texels, values):
    """Write the values of those texels whose level is this one; `faces` are the cells of the six images."""
    for n in range(values.shape[0]):
        if levels[n] == level:
            for i in range(4):
                cells, x, y = faces[texels[n, i, 0]], texels[n, i, 1], texels[n, i, 2]
                for c in range(values.shape[2]):
                    values[n, i, c] = fetch(cells, cells.shape[1], border, unit, x, y, c)


@kernel
def on_next_face(edge, face, along, last):
    """Return the texel (face, x, y) beyond an edge."""
    following, x, y = BEYOND[edge, face]
    return following, along_edge(x, along, last), along_edge(y, along, last)


@kernel
def along_edge(place, along, last):
    """Return a texel coordinate on the neighbouring face: its first or last, or how far along the edge."""
    if place == FIRST:
        return 0
    if place == LAST:
        return last
    return along if place == ALONG else last - along


@kernel
def seamless_texels(coordinate, size):
    """Return (first texel, weight of the second); texels -1 and `size` lie beyond the edges."""
    u = (coordinate if coordinate > ZERO else ZERO) * np.float32(size) - HALF
    return to_integer(np.floor(u)), u - np.floor(u)


@kernel
def seamless_texel(face, x, y, last):
    """Return the texel (face, x, y) for a position that may lie beyond an edge; at a corner the edge in x decides."""
    if x < 0 or x > last:
        return on_next_face(0 if x < 0 else 1, face, min(max(y, 0), last), last)
    if y < 0 or y > last:
        return on_next_face(2 if y < 0 else 3, face, x, last)
    return face, x, y


@kernel
def find_neighbors(faces, places, sizes, kinds, seamless, neighbors):
    """Fill `neighbors` with each pixel's four texels, their weights, and the index of a texel beyond a corner."""
    for n in range(len(places)):
        face, size = int(faces[n]), int(sizes[n])
        last, corner = size - 1, -1
        if kinds[n] == NEAREST:
            x0 = x1 = nearest_texel(places[n, 0], size, GL_CLAMP_TO_EDGE)
            y0 = y1 = nearest_texel(places[n, 1], size, GL_CLAMP_TO_EDGE)
            x_weight = y_weight = places[n, 0] * ZERO
        elif seamless:
            x0, x_weight = seamless_texels(places[n, 0], size)
            y0, y_weight = seamless_texels(places[n, 1], size)
            x1, y1 = x0 + 1, y0 + 1
            if (x0 < 0 or x1 > last) and (y0 < 0 or y1 > last):
                corner = (1 if x1 > last else 0) + (2 if y1 > last else 0)
        else:
            x0, x1, x_weight = linear_texels(places[n, 0], size, GL_CLAMP_TO_EDGE)
            y0, y1, y_weight = linear_texels(places[n, 1], size, GL_CLAMP_TO_EDGE)
        if kinds[n] != LINEAR:
            x_weight = ONE if x_weight > HALF else ZERO
            y_weight = ONE if y_weight > HALF else ZERO
        neighbors.weights[n, 0], neighbors.weights[n, 1] = x_weight, y_weight
        neighbors.corners[n] = corner
        for i in range(4):
            texel = seamless_texel(face, x1 if i % 2 else x0, y1 if i > 1 else y0, last)
            neighbors.texels[n, i, 0], neighbors.texels[n, i, 1], neighbors.texels[n, i, 2] = texel


@kernel
def corner_in_block(corners, n):
    """Return whether a pixel in the 2x2 block of pixel n has a texel beyond a corner."""
    first = n - n % PIXELS_OF_A_BLOCK
    largest = corners[first]
    for i in range(first + 1, min(first + PIXELS_OF_A_BLOCK, corners.shape[0])):
        largest = max(largest, corners[i])
    return largest >= 0


@kernel
def corner_weights(weights, corner):
    """Return the weights of the four texels; the others share the weight of one beyond a corner."""
    x, y = weights
    w00, w01, w10, w11 = (ONE - x) * (ONE - y), x * (ONE - y), (ONE - x) * y, x * y
    if corner < 0:
        return w00, w01, w10, w11
    share = (w00 if corner == 0 else w01 if corner == 1 else w10 if corner == 2 else w11) * THIRD
    return (
        ZERO if corner == 0 else w00 + share,
        ZERO if corner == 1 else w01 + share,
        ZERO if corner == 2 else w10 + share,
        ZERO if corner == 3 else w11 + share,
    )


@kernel
def mix_texels(texels, neighbors, sources, out):
    """Write the filtered colours of texels (N, 4, channels) to `out` (N, 4)."""
    for n in range(len(out)):
        by_sum = corner_in_block(neighbors.corners, n)
        w00, w01, w10, w11 = corner_weights(neighbors.weights[n], neighbors.corners[n])
        for c in range(4):
            source = sources[c]
            if source >= CONSTANT_ZERO:
                out[n, c] = ZERO if source == CONSTANT_ZERO else ONE
                continue
            a, b = texels[n, 0, source], texels[n, 1, source]
            d, e = texels[n, 2, source], texels[n, 3, source]
            if by_sum:
                out[n, c] = ((w00 * a + w01 * b) + w10 * d) + w11 * e
            else:
                x, y = neighbors.weights[n]
                out[n, c] = mix(y, mix(x, a, b), mix(x, d, e))


@kernel
def mix_compared(texels, references, neighbors, func, clamped, sources, out):
    """Write the weighted share of texels (N, 4, 1) that pass the comparison with the references (N,) to `out`."""
    for n in range(len(out)):
        r = clamp_to_unit(references[n]) if clamped else references[n]
        w00, w01, w10, w11 = corner_weights(neighbors.weights[n], neighbors.corners[n])
        x, y = neighbors.weights[n]
        if not corner_in_block(neighbors.corners, n):
            w00, w01, w10, w11 = ONE - x, x, ONE - x, x
        lower = w00 if passes(func, r, texels[n, 0, 0]) else ZERO
        lower = (w01 if passes(func, r, texels[n, 1, 0]) else ZERO) + lower
        third = w10 if passes(func, r, texels[n, 2, 0]) else ZERO
        fourth = w11 if passes(func, r, texels[n, 3, 0]) else ZERO
        if corner_in_block(neighbors.corners, n):
            lit = (lower + third) + fourth
        else:
            lit = mix(y, lower, third + fourth)
        for c in range(4):
            source = sources[c]
            out[n, c] = lit if source < CONSTANT_ZERO else (ZERO if source == CONSTANT_ZERO else ONE)
