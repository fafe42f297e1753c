"""Texture sampling for a batch of coordinates, bit for bit as llvmpipe samples.

`sample` is the door: it reads the texture's sampler, selects levels, and leaves the texture's RGBA. What one image
gives is computed in `filtering`, which level by `level_of_detail`.
"""

from __future__ import annotations

import numpy as np

from softshadow.errors import StateError
from softshadow.programs import needs_blocks
from softshadow.programs.filtering import UNORM8_STEP, in_8_bits, sample_image, wraps_of
from softshadow.programs.level_of_detail import FILTERS, Levels, select_levels, squared_texels_per_pixel
from softshadow.programs.wrapping import ONE
from softshadow.texture import Texture
from softshadow.tokens import GL_LINEAR, GL_NONE

PIXELS_OF_A_BLOCK = 4
WEIGHT_STEPS = np.float32(256.0)


def base_format(texture: Texture) -> int:
    """Return the base internal format that texture environments go by; that of a depth texture is its depth mode."""
    image = texture.base()
    if image is None:
        raise StateError(f"texture {texture.name}: no image; define one with glTexImage2D")
    return texture.sampler.depth_mode if image.format.kind == "depth" else image.format.base


def is_complete(texture: Texture) -> bool:
    """Return whether the texture can be sampled: its base image exists, and all levels where the filter uses mipmaps.

    References: GL 2.1 sec. 3.8.10.
    """
    sampler, image = texture.sampler, texture.base()
    if image is None or image.width == 0 or image.height == 0:
        return False
    if FILTERS[sampler.min_filter][1] == GL_NONE:
        return True
    width, height = image.width, image.height
    for level in range(sampler.base_level + 1, texture.last_level() + 1):
        width, height = max(width // 2, 1), max(height // 2, 1)
        image_of_level = texture.images.get((0, level))
        if (
            image_of_level is None
            or (image_of_level.width, image_of_level.height) != (width, height)
            or image_of_level.format != image.format
        ):
            return False
    return sampler.max_level >= sampler.base_level


def project(coordinates: np.ndarray) -> np.ndarray:
    """Return (s, t, r) / q of coordinates (N, 4), computed as s * (1/q)."""
    with np.errstate(all="ignore"):  # q = 0 gives infinities, as in GL
        projected: np.ndarray = coordinates[:, :3] * (ONE / coordinates[:, 3:])
    return projected


def sample(texture: Texture, coordinates: np.ndarray, out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the texture's RGBA at coordinates (N, 3): s, t, and r for depth comparison.

    An incomplete texture gives (0, 0, 0, 1), as programs see it. Where the filter depends on the level of detail, the
    coordinates must be complete 2x2 blocks of pixels (see `Program.blocks`).

    Raises
    ------
    StateError                   the fragments do not come in blocks
    """
    image, sampler = texture.base(), texture.sampler
    if image is None or not is_complete(texture):
        out[:] = (0.0, 0.0, 0.0, 1.0)
        return
    if not needs_blocks(texture):
        first = texture.images.get((0, 0), image)
        sample_image(image, sampler, wraps_of(sampler, first), sampler.mag_filter == GL_LINEAR, coordinates, out)
        return
    if len(coordinates) % PIXELS_OF_A_BLOCK:
        raise StateError(
            f"texture {texture.name}: GL_TEXTURE_MIN_FILTER and GL_TEXTURE_MAG_FILTER differ, which takes fragments in "
            "blocks; set both to GL_NEAREST or both to GL_LINEAR"
        )
    squared = squared_texels_per_pixel(coordinates, image.width, image.height)
    levels = select_levels(squared, sampler, texture.last_level() - sampler.base_level)
    sample_levels(texture, Levels(*(np.repeat(a, PIXELS_OF_A_BLOCK) for a in levels)), coordinates, out)


def sample_levels(texture: Texture, levels: Levels, coordinates: np.ndarray, out: np.ndarray) -> None:
    """Fill `out` (N, 4) from the levels that were selected for each pixel (N,)."""
    image, sampler = texture.base(), texture.sampler
    assert image is not None
    wraps = wraps_of(sampler, texture.images.get((0, 0), image))
    within, between = FILTERS[sampler.min_filter]

    def fill(chosen: np.ndarray, which: np.ndarray, filter_name: int, into: np.ndarray) -> None:
        for level in np.unique(which[chosen]):
            pixels = np.nonzero(chosen & (which == level))[0]
            part = np.empty((len(pixels), 4), out.dtype)
            of_level = texture.images[0, sampler.base_level + int(level)]
            sample_image(of_level, sampler, wraps, filter_name == GL_LINEAR, coordinates[pixels], part)
            into[pixels] = part

    small = levels.minified if within != sampler.mag_filter else np.ones(len(out), bool)
    if between == GL_NONE:
        levels = levels._replace(lower=np.zeros_like(levels.lower))
    fill(small, levels.lower, within, out)
    fill(~small, np.zeros_like(levels.lower), sampler.mag_filter, out)
    both = small & (levels.weight > 0)
    if between == GL_LINEAR and both.any():
        upper = np.empty_like(out)
        fill(both, levels.upper, within, upper)
        mix = mix_in_8_bits if in_8_bits(image, wraps) else mix_in_float
        out[both] = mix(out[both], upper[both], levels.weight[both, np.newaxis])


def mix_in_float(a: np.ndarray, b: np.ndarray, weight: np.ndarray) -> np.ndarray:
    mixed: np.ndarray = weight * (b - a) + a
    return mixed


def mix_in_8_bits(a: np.ndarray, b: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return the mixture of colours that are multiples of 1/255, as llvmpipe's 8-bit interpolation rounds it."""
    lower, upper = (np.rint(c * np.float32(255)).astype(np.int32) for c in (a, b))
    steps = np.trunc(weight * WEIGHT_STEPS).astype(np.int32)
    mixed: np.ndarray = (lower + (((upper - lower) * steps * 128 + 16384) >> 15)).astype(np.float32) * UNORM8_STEP
    return mixed
