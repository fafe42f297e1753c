"""Mipmap generation: each level is the one above it, sampled by a rectangle of half the size, as llvmpipe draws it.

Where both sides are even, a texel is the mean of 2x2 texels, in 8 bits rounded up per axis. Where a side is odd, the
weights of the linear filter vary from texel to texel, and float formats keep every bit of the interpolated coordinates:
those of two triangles that share the diagonal from the first texel to the last. A 3-D level is drawn slice by slice:
each is a mixture of two filtered slices.

References: GL 2.1 sec. 3.8.8 (automatic mipmap generation); u_gen_mipmap.c of Mesa 22.3 (a blit per level).
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.color_values import color_as_float
from softshadow.framebuffer import Storage
from softshadow.image import Format, Image
from softshadow.jit import kernel
from softshadow.pipeline.commands import GenerateMipmaps
from softshadow.pipeline.constants import HALF, ONE
from softshadow.pixels import quantized_depth, sampled_depth
from softshadow.programs.filtering import mix, mix_fixed_point
from softshadow.texel_codes import SRGB, cells_of, codes_of, drawn_cells, srgb_codes

STEPS = 256  # of the filter weights in 8 bits
UPPER_BITS, ONE_BIT = np.uint32(0xFEFEFEFE), np.uint32(1)  # seven of each byte


def generate_mipmaps(command: GenerateMipmaps, storage: Storage) -> None:
    """Replace the levels of a texture after the base level.

    The other faces of a cube map get levels of the same sizes, zeros where they had others, as in Mesa.
    """
    texture = storage.textures[command.texture]
    images = texture.images
    for level in range(command.base + 1, command.last + 1):
        for face in command.faces:
            images[face, level] = next_level(images[face, level - 1])
        model = images[command.faces[0], level]
        for face in texture.faces:
            old_image = images.get((face, level))
            if old_image is None or old_image.layout != model.layout:
                shape = model.width, model.height, model.internal_format, model.slices
                images[face, level] = Image.new(model.format, *shape)
            storage.reattach(command.texture, face, level, images[face, level])


def half_of(side: int) -> int:
    """Return the side of the next level: a side of 0 stays 0."""
    return max(side // 2, min(side, 1))


def next_level(image: Image) -> Image:
    """Return the image of the next level."""
    width, height, slices = half_of(image.width), half_of(image.height), half_of(image.slices)
    level = Image.new(image.format, width, height, image.internal_format, slices)
    if 0 in (width, height, slices):
        return level
    texels = image.read_cells[:, : image.width]
    if image.format.kind == "depth":
        z = halved_in_float(sampled_depth(texels, image.format)[..., np.newaxis], width, height)[..., 0]
        level.view[:] = quantized_depth(z, image.format)
        return level
    if image.format.encoding == "srgb" and image.format.base not in (gl.GL_RGB, gl.GL_RGBA):
        level.view[:] = cells_of(_mean_codes(image, width, height, slices), image.format)
        return level
    in_bytes = image.format.kind == "unorm8"
    halved = halved_in_8_bits if in_bytes else halved_in_float
    if image.slices == 1:
        level.view[:] = _stored(halved(texels, width, height), image.format)
        return level
    places = centers_of_slices(image.slices, slices)
    first, second, weight = (texels_and_weights_in_8_bits if in_bytes else texels_and_weights)(places, image.slices)
    filtered = np.stack(
        [halved(each, width, height) for each in texels.reshape(image.slices, image.height, image.width, -1)]
    )
    mixed = mix_in_8_bits if in_bytes else mix_in_float
    for k in range(slices):
        values = mixed(filtered[first[k]], filtered[second[k]], weight[k])
        level.view[k * height : (k + 1) * height] = _stored(values, image.format)
    return level


def _stored(values: np.ndarray, format: Format) -> np.ndarray:
    """Return filtered colours, bytes or floats, as cells; sRGB is encoded."""
    if not format.encoding:
        return values
    cells = drawn_cells(color_as_float(values.astype(format.dtype)), format)
    if format.encoding == "srgb":
        cells[..., :3] = SRGB[srgb_codes(values[..., :3])]
    return cells


def _mean_codes(image: Image, width: int, height: int, slices: int) -> np.ndarray:
    """Return the means of encoded texels (slices * height, width, 4), rounded down: Mesa draws no sRGB luminance.

    Those of several slices are rounded.
    """
    codes = codes_of(image.read_cells[:, : image.width], image.format).reshape(
        image.slices, image.height, image.width, 4
    )
    steps = [2 if side > 1 else 1 for side in codes.shape[:3]]
    total = np.zeros((slices, height, width, 4), np.int64)
    for k in range(2):
        for i in range(2):
            for j in range(2):
                picked = codes
                for axis, (offset, n) in enumerate(zip((k, i, j), (slices, height, width), strict=True)):
                    first = offset if steps[axis] == 2 else 0
                    picked = np.take(picked, np.arange(n) * steps[axis] + first, axis)
                total += picked
    half = 4 if image.slices > 1 else 0
    return ((total + half) // 8).reshape(slices * height, width, 4)


def centers_of_slices(n: int, n_halved: int) -> np.ndarray:
    """Return where the centres of the slices of the next level lie among n slices: coordinates (n_halved,)."""
    step = np.float32(n) / np.float32(n_halved)
    places = np.arange(n_halved, dtype=np.float32) * step + np.float32(0.5 / n_halved * n)
    coordinates: np.ndarray = places / np.float32(n)
    return coordinates


def centers(n: int, n_other: int, from_far_end: bool) -> np.ndarray:
    """Return the interpolated coordinates (n,) of texel centres; the other axis has `n_other` texels."""
    step = np.float32(n_other) * (ONE / np.float32(n * n_other))
    start = ONE - step * (np.float32(n) - HALF) if from_far_end else step * HALF
    return np.arange(n, dtype=np.float32) * step + start


def halved_in_8_bits(texels: np.ndarray, width: int, height: int) -> np.ndarray:
    """Return texels (h, w, 4) uint8 filtered to (height, width, 4)."""
    columns = filter_in_8_bits(width, height, True, texels.shape[1])
    rows = filter_in_8_bits(height, width, False, texels.shape[0])
    texels, halved = np.ascontiguousarray(texels), np.empty((height, width, 4), np.uint8)
    if columns.takes_means and rows.takes_means:
        average_fours(texels.view(np.uint32)[..., 0], halved.view(np.uint32)[..., 0])
    else:
        filter_bytes(texels, *columns[:3], *rows[:3], halved)
    return halved


class AxisFilter(NamedTuple):
    """What `texels_and_weights_in_8_bits` returns for an axis, and whether these are the means of two texels each."""

    first: np.ndarray
    second: np.ndarray
    weight: np.ndarray
    takes_means: bool


@lru_cache(maxsize=256)
def filter_in_8_bits(n: int, n_other: int, from_far_end: bool, size: int) -> AxisFilter:
    """Return the filter from `size` texels of an axis to n; the other axis has `n_other` after it."""
    first, second, weight = texels_and_weights_in_8_bits(centers(n, n_other, from_far_end), size)
    takes_means = np.array_equal(first, np.arange(n) * 2) and np.array_equal(second, first + 1)
    return AxisFilter(first, second, weight, takes_means and bool((weight == STEPS // 2).all()))


@kernel
def average_fours(texels, out):
    """Write the means of 2 x 2 texels of four bytes, rounded up along the columns first, then along the rows."""
    for y in range(np.uint64(out.shape[0])):
        lower = y + y
        upper = lower + np.uint64(1)
        for x in range(np.uint64(out.shape[1])):
            left = x + x
            right = left + np.uint64(1)
            below = mean_of(texels[lower, left], texels[lower, right])
            above = mean_of(texels[upper, left], texels[upper, right])
            out[y, x] = mean_of(below, above)


@kernel
def mean_of(a, b):
    """Return the means of two times four bytes, rounded up: `mix_fixed_point` with the weight 1/2."""
    return np.uint32(np.uint32(a | b) - np.uint32(np.uint32(np.uint32(a ^ b) & UPPER_BITS) >> ONE_BIT))


@kernel
def filter_bytes(texels, left, right, weight_right, lower, upper, weight_upper, out):
    """Write mixtures of four bytes each: along the columns first, then along the rows."""
    for y in range(out.shape[0]):
        for x in range(out.shape[1]):
            for c in range(out.shape[2]):
                below = mix_fixed_point(
                    weight_right[x], np.int32(texels[lower[y], left[x], c]), np.int32(texels[lower[y], right[x], c])
                )
                above = mix_fixed_point(
                    weight_right[x], np.int32(texels[upper[y], left[x], c]), np.int32(texels[upper[y], right[x], c])
                )
                out[y, x, c] = mix_fixed_point(weight_upper[y], below, above)


def texels_and_weights_in_8_bits(coordinates: np.ndarray, size: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return (first texel, second texel, weight of the second in 1/256) of a linear filter under GL_CLAMP_TO_EDGE."""
    position = np.rint(coordinates * np.float32(STEPS * size)).astype(np.int32) - STEPS // 2
    first = position // STEPS
    return first.clip(0, size - 1), (first + 1).clip(0, size - 1), position % STEPS


def mix_in_8_bits(a: np.ndarray, b: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return the mixtures of bytes, rounded as llvmpipe's 8-bit interpolation rounds them."""
    a, b = a.astype(np.int32), b.astype(np.int32)
    mixed: np.ndarray = a + ((weight * (b - a) * 128 + 16384) >> 15)
    return mixed


def mix_in_float(a: np.ndarray, b: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return the mixtures of floats."""
    mixed: np.ndarray = weight * (b - a) + a
    return mixed


def halved_in_float(texels: np.ndarray, width: int, height: int) -> np.ndarray:
    """Return texels (h, w, channels) float32 filtered to (height, width, channels)."""
    columns = texels_and_weights(centers(width, height, True), texels.shape[1])
    rows = [texels_and_weights(centers(height, width, upper), texels.shape[0]) for upper in (False, True)]
    halved = np.empty((height, width, texels.shape[2]), np.float32)
    filter_floats(np.ascontiguousarray(texels), *columns, *rows[0], *rows[1], halved)
    return halved


@kernel
def filter_floats(texels, left, right, weight, lower, upper, weight_up, other_lower, other_upper, other_weight_up, out):
    """Write mixtures of floats: along the columns first, then along the rows, which differ above the diagonal."""
    height, width, channels = out.shape
    for y in range(height):
        for x in range(width):
            is_above = (2 * y + 1) * width > (2 * x + 1) * height
            j, k = (other_lower[y], other_upper[y]) if is_above else (lower[y], upper[y])
            i, next_i, share = left[x], right[x], other_weight_up[y] if is_above else weight_up[y]
            for c in range(channels):
                below = mix(weight[x], texels[j, i, c], texels[j, next_i, c])
                out[y, x, c] = mix(share, below, mix(weight[x], texels[k, i, c], texels[k, next_i, c]))


def texels_and_weights(coordinates: np.ndarray, size: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return (first texel, second texel, weight of the second) of a linear filter under GL_CLAMP_TO_EDGE."""
    length = np.float32(size)
    u = np.maximum(np.minimum(coordinates * length, length) - HALF, np.float32(0))
    first = np.floor(u).astype(np.int32)
    return first, np.minimum(first + 1, size - 1), u - np.floor(u)
