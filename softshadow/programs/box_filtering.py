"""Sampling of 1-D and 3-D images and of rectangles with one filter, bit for bit as llvmpipe.

`sample_box` does for them what `filtering.sample_image` does for 2-D images: the filters are the same, one axis after
the other, x first. The coordinates of a rectangle are in texels. 2-D images have faster kernels of their own; with
two axes the kernels here give the same.

References: GL 2.1 sec. 3.8.8; ARB_texture_rectangle; lp_build_sample_image_linear of Mesa 22.3.
"""

from __future__ import annotations

import numpy as np

from softshadow.image import Image
from softshadow.jit import kernel
from softshadow.programs.filtering import (
    CONSTANT_ZERO,
    RED,
    UNORM8_STEP,
    clamp_to_unit,
    fetch,
    in_8_bits,
    mix,
    mix_fixed_point,
    passes,
    sources_of,
    texels_of,
)
from softshadow.programs.wrapping import (
    FIXED_ONE,
    ONE,
    ZERO,
    fixed_point_texels,
    linear_texels,
    linear_texels_at,
    nearest_texel,
    nearest_texel_at,
    to_integer,
    wrap_code,
)
from softshadow.texture import Texture
from softshadow.tokens import GL_NONE, GL_TEXTURE_1D, GL_TEXTURE_3D, GL_TEXTURE_RECTANGLE

BOXES = (GL_TEXTURE_1D, GL_TEXTURE_3D, GL_TEXTURE_RECTANGLE)
AXES = {GL_TEXTURE_1D: 1, GL_TEXTURE_3D: 3}  # all others have 2


def box_wraps(texture: Texture, first: Image) -> tuple[int, ...]:
    """Return the wrap codes of all axes, for all levels of a texture whose level 0 is `first`."""
    sampler, sides = texture.sampler, (first.width, first.height, first.slices)
    wraps = (sampler.wrap_s, sampler.wrap_t, sampler.wrap_r)
    return tuple(wrap_code(*each) for each in list(zip(wraps, sides, strict=True))[: AXES.get(texture.target, 2)])


def sample_box(
    image: Image, texture: Texture, wraps: tuple[int, ...], linear: bool, coordinates: np.ndarray, out: np.ndarray
) -> None:
    """Fill `out` (N, k) from one image with a linear or nearest filter.

    coordinates (N, 3) are s, t and r. Depths are compared with the first of them that is not a position: in Mesa with
    t in a 1-D texture, with r in a rectangle.
    """
    sampler, sources = texture.sampler, sources_of(image, texture.sampler)
    places, channels = np.ascontiguousarray(coordinates.T), out.T
    cells, border, unit = texels_of(image, sampler, coordinates.dtype, in_8_bits(image, wraps))
    sides = np.array((image.width, image.height, image.slices))
    axes = np.array(wraps)
    where = places, cells, sides, axes, texture.target != GL_TEXTURE_RECTANGLE
    if linear and in_8_bits(image, wraps):
        mix_bytes(*where, sources, channels)
    elif image.format.kind == "depth" and sampler.compare_mode != GL_NONE:
        clamped = image.format.largest > 0
        compare_box(*where, border, unit, linear, sampler.compare_func, clamped, sources, channels)
    elif linear:
        mix_floats(*where, border, unit, sources, channels)
    else:
        read_nearest(*where, border, unit, sources, channels)


# -- places ------------------------------------------------------------------------------------------------------------
@kernel
def nearest_on_axis(coordinate, size, wrap, normalized):
    """Return the nearest texel on an axis."""
    return np.int64(nearest_texel(coordinate, size, wrap) if normalized else nearest_texel_at(coordinate, size, wrap))


@kernel
def linear_on_axis(coordinate, size, wrap, normalized):
    """Return (first texel, second texel, weight of the second) on an axis."""
    if normalized:
        return linear_texels(coordinate, size, wrap)
    return linear_texels_at(coordinate, size, wrap)


@kernel
def fixed_on_axis(coordinate, size, wrap, normalized):
    """Return (first texel, second texel, weight of the second in 1/256) on an axis."""
    if normalized:
        return fixed_point_texels(coordinate, size, wrap)
    position, last = to_integer(np.rint(coordinate * FIXED_ONE)) - 128, size - 1
    if position < -(2**31):
        position += 2**32
    first = position >> 8
    return min(max(first, 0), last), min(max(first + 1, 0), last), position & 255


@kernel
def row_of(j, k, sides):
    """Return the row of cells of texel row j in slice k, or -1 outside the image."""
    inside = j >= 0 and j < sides[1] and k >= 0 and k < sides[2]
    return k * sides[1] + j if inside else -1


# -- filters -----------------------------------------------------------------------------------------------------------
@kernel
def read_nearest(coordinates, cells, sides, wraps, normalized, border, unit, sources, out):
    """Write the nearest texels to `out` (k, N)."""
    n_axes = len(wraps)
    for n in range(coordinates.shape[1]):
        i, j, k = nearest_on_axis(coordinates[0, n], sides[0], wraps[0], normalized), 0, 0
        if n_axes > 1:
            j = nearest_on_axis(coordinates[1, n], sides[1], wraps[1], normalized)
        if n_axes > 2:
            k = nearest_on_axis(coordinates[2, n], sides[2], wraps[2], normalized)
        row = row_of(j, k, sides)
        for c in range(out.shape[0]):
            source = sources[c]
            if source >= CONSTANT_ZERO:
                out[c, n] = ZERO if source == CONSTANT_ZERO else ONE
            else:
                out[c, n] = fetch(cells, sides[0], border, unit, i, row, source)


@kernel
def mix_on_row(cells, width, border, unit, i0, i1, weight, row, source):
    """Return a channel filtered on x."""
    return mix(
        weight, fetch(cells, width, border, unit, i0, row, source), fetch(cells, width, border, unit, i1, row, source)
    )


@kernel
def mix_floats(coordinates, cells, sides, wraps, normalized, border, unit, sources, out):
    """Write linearly filtered texels to `out` (k, N), in float."""
    n_axes = len(wraps)
    for n in range(coordinates.shape[1]):
        i0, i1, x = linear_on_axis(coordinates[0, n], sides[0], wraps[0], normalized)
        j0, j1, y, k0, k1, z = 0, 0, x, 0, 0, x
        if n_axes > 1:
            j0, j1, y = linear_on_axis(coordinates[1, n], sides[1], wraps[1], normalized)
        if n_axes > 2:
            k0, k1, z = linear_on_axis(coordinates[2, n], sides[2], wraps[2], normalized)
        for c in range(out.shape[0]):
            source = sources[c]
            if source >= CONSTANT_ZERO:
                out[c, n] = ZERO if source == CONSTANT_ZERO else ONE
                continue
            value = mix_on_row(cells, sides[0], border, unit, i0, i1, x, row_of(j0, k0, sides), source)
            if n_axes > 1:
                upper = mix_on_row(cells, sides[0], border, unit, i0, i1, x, row_of(j1, k0, sides), source)
                value = mix(y, value, upper)
            if n_axes > 2:
                lower = mix_on_row(cells, sides[0], border, unit, i0, i1, x, row_of(j0, k1, sides), source)
                upper = mix_on_row(cells, sides[0], border, unit, i0, i1, x, row_of(j1, k1, sides), source)
                value = mix(z, value, mix(y, lower, upper))
            out[c, n] = value


@kernel
def mix_bytes_on_row(cells, i0, i1, weight, row, source):
    """Return a channel filtered on x, in integers."""
    return mix_fixed_point(weight, np.int64(cells[row, i0, source]), np.int64(cells[row, i1, source]))


@kernel
def mix_bytes(coordinates, cells, sides, wraps, normalized, sources, out):
    """Write linearly filtered texels to `out` (k, N), in 8-bit integers."""
    n_axes = len(wraps)
    for n in range(coordinates.shape[1]):
        i0, i1, x = fixed_on_axis(coordinates[0, n], sides[0], wraps[0], normalized)
        j0, j1, y, k0, k1, z = 0, 0, 0, 0, 0, 0
        if n_axes > 1:
            j0, j1, y = fixed_on_axis(coordinates[1, n], sides[1], wraps[1], normalized)
        if n_axes > 2:
            k0, k1, z = fixed_on_axis(coordinates[2, n], sides[2], wraps[2], normalized)
        for c in range(out.shape[0]):
            source = sources[c]
            if source >= CONSTANT_ZERO:
                out[c, n] = ZERO if source == CONSTANT_ZERO else ONE
                continue
            value = mix_bytes_on_row(cells, i0, i1, x, row_of(j0, k0, sides), source)
            if n_axes > 1:
                upper = mix_bytes_on_row(cells, i0, i1, x, row_of(j1, k0, sides), source)
                value = mix_fixed_point(y, value, upper)
            if n_axes > 2:
                lower = mix_bytes_on_row(cells, i0, i1, x, row_of(j0, k1, sides), source)
                upper = mix_bytes_on_row(cells, i0, i1, x, row_of(j1, k1, sides), source)
                value = mix_fixed_point(z, value, mix_fixed_point(y, lower, upper))
            out[c, n] = np.float32(value) * UNORM8_STEP


@kernel
def passing_on_row(func, r, cells, width, border, unit, i0, i1, weight, row):
    """Return the weighted share of two texels on a row that pass a comparison with r."""
    first = ONE - weight if passes(func, r, fetch(cells, width, border, unit, i0, row, RED)) else ZERO
    return (weight if passes(func, r, fetch(cells, width, border, unit, i1, row, RED)) else ZERO) + first


@kernel
def compare_box(coordinates, cells, sides, wraps, normalized, border, unit, linear, func, clamped, sources, out):
    """Write 0 or 1 for a coordinate compared with the depth, or the weighted share of texels that pass."""
    n_axes = len(wraps)
    for n in range(coordinates.shape[1]):
        r = coordinates[n_axes, n]
        r = clamp_to_unit(r) if clamped else r
        if linear:
            i0, i1, x = linear_on_axis(coordinates[0, n], sides[0], wraps[0], normalized)
            j0, j1, y = 0, 0, x
            if n_axes > 1:
                j0, j1, y = linear_on_axis(coordinates[1, n], sides[1], wraps[1], normalized)
            lit = passing_on_row(func, r, cells, sides[0], border, unit, i0, i1, x, row_of(j0, 0, sides))
            if n_axes > 1:
                upper = passing_on_row(func, r, cells, sides[0], border, unit, i0, i1, x, row_of(j1, 0, sides))
                lit = mix(y, lit, upper)
        else:
            i, j = nearest_on_axis(coordinates[0, n], sides[0], wraps[0], normalized), 0
            if n_axes > 1:
                j = nearest_on_axis(coordinates[1, n], sides[1], wraps[1], normalized)
            texel = fetch(cells, sides[0], border, unit, i, row_of(j, 0, sides), RED)
            lit = ONE if passes(func, r, texel) else ZERO
        for c in range(out.shape[0]):
            source = sources[c]
            out[c, n] = lit if source < CONSTANT_ZERO else (ZERO if source == CONSTANT_ZERO else ONE)
