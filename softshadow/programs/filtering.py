"""Sampling of one image with one filter at many coordinates, bit for bit as llvmpipe.

`sample_image` selects the kernel: `gather_texels` (nearest), `filter_texels` (linear in float), `filter_fixed_point`
(linear, 8-bit formats under GL_REPEAT and GL_CLAMP_TO_EDGE, which llvmpipe filters in 8-bit integers) or
`compare_depth` (shadow maps). Kernels take coordinates (3, N) and write colours (k, N): column by column, as programs
do.
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Format, Image
from softshadow.jit import allocating_kernel, inlined, kernel
from softshadow.pixels import LARGEST_SAMPLED, LARGEST_UINT
from softshadow.programs.wrapping import (
    FIXED_POINT_WRAPS,
    ONE,
    ZERO,
    fixed_point_texels,
    linear_texels,
    nearest_texel,
    nearest_texels,
    wrap_code,
)
from softshadow.texel_codes import as_floats, codes_of
from softshadow.texture import Sampler
from softshadow.tokens import GL_ALWAYS, GL_EQUAL, GL_GEQUAL, GL_GREATER, GL_LEQUAL, GL_LESS, GL_NOTEQUAL

UNORM8_STEP = ONE / np.float32(255.0)
STEP_OF_23_BITS = ONE / np.float32(LARGEST_SAMPLED)  # llvmpipe reads the upper 23 bits of a 32-bit depth

FIRST_TEXEL = np.uint32(0)
RED = np.int64(0)  # first channel; an int literal would have `fetch` compiled a second time

# source of R, G, B, A of the result: a channel of the cells, or a constant
CONSTANT_ZERO, CONSTANT_ONE = 4, 5
SOURCES = {
    gl.GL_RGBA: (0, 1, 2, 3),
    gl.GL_RGB: (0, 1, 2, CONSTANT_ONE),
    gl.GL_RG: (0, 1, CONSTANT_ZERO, CONSTANT_ONE),
    gl.GL_RED: (0, CONSTANT_ZERO, CONSTANT_ZERO, CONSTANT_ONE),
    gl.GL_ALPHA: (CONSTANT_ZERO, CONSTANT_ZERO, CONSTANT_ZERO, 3),
    gl.GL_LUMINANCE: (0, 0, 0, CONSTANT_ONE),
    gl.GL_LUMINANCE_ALPHA: (0, 0, 0, 3),
    gl.GL_INTENSITY: (0, 0, 0, 0),
}
DEPTH_SOURCES = {**SOURCES, gl.GL_ALPHA: (CONSTANT_ZERO, CONSTANT_ZERO, CONSTANT_ZERO, 0)}


def wraps_of(sampler: Sampler, first: Image) -> tuple[int, int]:
    """Return the wrap codes (s, t) for all levels of a texture whose level 0 is `first`."""
    return wrap_code(sampler.wrap_s, first.width), wrap_code(sampler.wrap_t, first.height)


def in_8_bits(image: Image, wraps: tuple[int, ...]) -> bool:
    """Return whether llvmpipe filters the image in 8-bit integers."""
    return image.format.kind == "unorm8" and set(wraps) <= set(FIXED_POINT_WRAPS)


def sample_image(
    image: Image, sampler: Sampler, wraps: tuple[int, ...], linear: bool, coordinates: np.ndarray, out: np.ndarray
) -> None:
    """Fill `out` (N, k) from one image with a linear or nearest filter; coordinates (N, 3) are s, t, reference."""
    sources = sources_of(image, sampler)
    places, channels = np.ascontiguousarray(coordinates.T), out.T
    if linear and in_8_bits(image, wraps):
        cells = image.cells if image.cells.ndim == 3 else image.cells[:, :, np.newaxis]
        filter_fixed_point(places, cells, image.width, wraps, sources, channels)
        return
    cells, border, unit = texels_of(image, sampler, coordinates.dtype, in_8_bits(image, wraps))
    where = places, cells, image.width, wraps, border, unit
    if image.format.kind == "depth" and sampler.compare_mode != gl.GL_NONE:
        compare_depth(*where, linear, sampler.compare_func, image.format.largest > 0, sources, channels)
    elif linear:
        filter_texels(*where, sources, channels)
    else:
        columns, rows = nearest_places(places, image, wraps)
        gather_texels(columns, rows, cells, image.width, border, unit, sources, channels)


def nearest_places(places: np.ndarray, image: Image, wraps: tuple[int, ...]) -> np.ndarray:
    """Return column and row (2, N) int32 of the nearest texels to coordinates (2 or more, N)."""
    texels = np.empty((2, places.shape[1]), np.int32)
    nearest_texels(places[0], image.width, wraps[0], texels[0])
    nearest_texels(places[1], image.height, wraps[1], texels[1])
    return texels


def texels_of(
    image: Image, sampler: Sampler, real: np.dtype, as_bytes: bool = False
) -> tuple[np.ndarray, np.ndarray, Any]:
    """Return the arguments of `fetch`: cells (H, pitch, channels), border colour, value of one cell unit.

    `real` is the float type: float64 in the "exact" precision. `as_bytes`: channels of few bits are widened to 8, as
    llvmpipe does where it filters `in_8_bits`.
    """
    as_bytes = as_bytes or not image.format.has_few_bits
    cells = image.cells if as_bytes else cells_in_float(image)
    cells = cells if cells.ndim == 3 else cells[:, :, np.newaxis]
    unit = unit_of(image.format, real) if as_bytes else real.type(ONE)
    return cells, border_of(image.format, sampler, real), unit


def border_of(format: Format, sampler: Sampler, real: np.dtype) -> np.ndarray:
    """Return the border colour (4,) of images of a format, clamped to the values that it can store."""
    border = np.array(sampler.border_color, real)
    if format.is_clamped:
        return border.clip(ZERO, ONE)
    return border.clip(-ONE, ONE) if format.encoding == "snorm" else border


_in_float: WeakKeyDictionary[Image, tuple[Hashable, np.ndarray]] = WeakKeyDictionary()


def cells_in_float(image: Image) -> np.ndarray:
    """Return the cells of an image with few bits as llvmpipe filters them in float: not widened to 8 bits before."""
    known = _in_float.get(image)
    if known is not None and image.version is not None and known[0] is image.version:
        return known[1]
    image.version = image.version if image.version is not None else object()
    codes = codes_of(image.read_cells, image.format)
    floats = np.ones(codes.shape, np.float32)
    for channel, n_bits in enumerate(image.format.bits):
        if n_bits:
            floats[..., channel] = as_floats(codes[..., channel], n_bits)
    _in_float[image] = image.version, floats
    return floats


def sources_of(image: Image, sampler: Sampler) -> np.ndarray:
    """Return the sources of R, G, B and A of the result, see `SOURCES`."""
    depth = image.format.kind == "depth"
    return np.array(DEPTH_SOURCES[sampler.looked_up_as] if depth else SOURCES[image.format.base])


def unit_of(format: Format, real: np.dtype) -> Any:
    """Return the value of one cell unit of a format, rounded to float32; `fetch` treats 32-bit depths apart."""
    if format.largest == LARGEST_UINT:
        return real.type(STEP_OF_23_BITS)
    return real.type(ONE / np.float32(format.largest) if format.largest else ONE)


@kernel
def fetch(cells, width, border, unit, i, j, channel):
    """Return one channel of a texel in [0, 1] units, or of the border colour outside the image."""
    if i >= 0 and i < width and j >= 0 and j < cells.shape[0]:
        if unit == STEP_OF_23_BITS:  # as `sampled_depth`
            upper = min(np.floor(cells[j, i, channel] / 512.0), LARGEST_SAMPLED)
            return border.dtype.type(np.float32(upper) * STEP_OF_23_BITS)
        return border.dtype.type(cells[j, i, channel]) * unit
    return border[channel]


@inlined
def mix(weight, a, b):
    """Return a + weight * (b - a), rounded at each step."""
    return weight * (b - a) + a


@kernel
def mix_fixed_point(weight, a, b):
    """Return a + weight/256 * (b - a) in integers, rounded as llvmpipe's 8-bit interpolation rounds."""
    return a + (((b - a) * weight * 128 + 16384) >> 15)


@allocating_kernel
def gather_texels(columns, rows, cells, width, border, unit, sources, out):
    """Write the texels at columns and rows (N,) to `out` (GL_NEAREST); `unit` is the value of one cell unit."""
    places, texels = np.empty(len(columns), np.uint32), cells.reshape(-1)
    pitch, channels = np.uint32(cells.shape[1]), np.uint64(cells.shape[2])
    for c in range(out.shape[0]):
        source = sources[c]
        if source >= CONSTANT_ZERO:
            out[c, :] = ZERO if source == CONSTANT_ZERO else ONE
            continue
        if unit == STEP_OF_23_BITS:
            for n in range(len(columns)):
                out[c, n] = fetch(cells, width, border, unit, np.int64(columns[n]), np.int64(rows[n]), source)
            continue
        outside = border[source]
        # same result as `fetch`, without branches: every pixel reads a texel, and the loops before and after the reads
        # are vectorised
        for n in range(len(columns)):
            i, j = np.uint32(columns[n]), np.uint32(rows[n])
            inside = (i < np.uint32(width)) & (j < np.uint32(cells.shape[0]))
            places[n] = np.uint32(j * pitch + i) if inside else FIRST_TEXEL
        for n in range(len(columns)):
            out[c, n] = border.dtype.type(texels[np.uint64(places[n]) * channels + np.uint64(source)]) * unit
        for n in range(len(columns)):
            inside = (np.uint32(columns[n]) < np.uint32(width)) & (np.uint32(rows[n]) < np.uint32(cells.shape[0]))
            out[c, n] = out[c, n] if inside else outside


@kernel
def filter_texels(coordinates, cells, width, wraps, border, unit, sources, out):
    """Write linearly filtered texels to `out` (GL_LINEAR), in float; `unit` is the value of one cell unit."""
    height = cells.shape[0]
    for n in range(coordinates.shape[1]):
        i0, i1, x_weight = linear_texels(coordinates[0, n], width, wraps[0])
        j0, j1, y_weight = linear_texels(coordinates[1, n], height, wraps[1])
        for c in range(out.shape[0]):
            source = sources[c]
            if source >= CONSTANT_ZERO:
                out[c, n] = ZERO if source == CONSTANT_ZERO else ONE
                continue
            lower = mix(
                x_weight,
                fetch(cells, width, border, unit, i0, j0, source),
                fetch(cells, width, border, unit, i1, j0, source),
            )
            upper = mix(
                x_weight,
                fetch(cells, width, border, unit, i0, j1, source),
                fetch(cells, width, border, unit, i1, j1, source),
            )
            out[c, n] = mix(y_weight, lower, upper)


@kernel
def filter_fixed_point(coordinates, cells, width, wraps, sources, out):
    """Write linearly filtered texels to `out` (GL_LINEAR), in 8-bit integers: x first, then y."""
    height = cells.shape[0]
    for n in range(coordinates.shape[1]):
        i0, i1, x_weight = fixed_point_texels(coordinates[0, n], width, wraps[0])
        j0, j1, y_weight = fixed_point_texels(coordinates[1, n], height, wraps[1])
        for c in range(out.shape[0]):
            source = sources[c]
            if source >= CONSTANT_ZERO:
                out[c, n] = ZERO if source == CONSTANT_ZERO else ONE
            else:
                lower = mix_fixed_point(x_weight, np.int64(cells[j0, i0, source]), np.int64(cells[j0, i1, source]))
                upper = mix_fixed_point(x_weight, np.int64(cells[j1, i0, source]), np.int64(cells[j1, i1, source]))
                out[c, n] = np.float32(mix_fixed_point(y_weight, lower, upper)) * UNORM8_STEP


@kernel
def passes(func, reference, texel):
    """Return whether `reference func texel` holds; with NaN only GL_NOTEQUAL and GL_ALWAYS do."""
    if func == GL_LEQUAL:
        return reference <= texel
    if func == GL_GEQUAL:
        return reference >= texel
    if func == GL_LESS:
        return reference < texel
    if func == GL_GREATER:
        return reference > texel
    if func == GL_EQUAL:
        return reference == texel
    if func == GL_NOTEQUAL:
        return reference != texel
    return func == GL_ALWAYS


@inlined
def clamp_to_unit(r):
    """Return a reference clamped to [0, 1]; NaN becomes 0."""
    r = r if r > ZERO else ZERO
    return r if r < ONE else ONE


@kernel
def compare_depth(coordinates, cells, width, wraps, border, unit, linear, func, clamped, sources, out):
    """Write 0 or 1 for r compared with the depth; with GL_LINEAR the weighted share of the 2x2 texels that pass."""
    height = cells.shape[0]
    for n in range(coordinates.shape[1]):
        r = coordinates[2, n]
        r = clamp_to_unit(r) if clamped else r
        if linear:
            i0, i1, x_weight = linear_texels(coordinates[0, n], width, wraps[0])
            j0, j1, y_weight = linear_texels(coordinates[1, n], height, wraps[1])
            rest = ONE - x_weight
            lower = rest if passes(func, r, fetch(cells, width, border, unit, i0, j0, RED)) else ZERO
            lower = (x_weight if passes(func, r, fetch(cells, width, border, unit, i1, j0, RED)) else ZERO) + lower
            upper = rest if passes(func, r, fetch(cells, width, border, unit, i0, j1, RED)) else ZERO
            upper = (x_weight if passes(func, r, fetch(cells, width, border, unit, i1, j1, RED)) else ZERO) + upper
            lit = mix(y_weight, lower, upper)
        else:
            i0 = nearest_texel(coordinates[0, n], width, wraps[0])
            j0 = nearest_texel(coordinates[1, n], height, wraps[1])
            lit = ONE if passes(func, r, fetch(cells, width, border, unit, i0, j0, RED)) else ZERO
        for c in range(out.shape[0]):
            source = sources[c]
            out[c, n] = lit if source < CONSTANT_ZERO else (ZERO if source == CONSTANT_ZERO else ONE)
