"""The texels of a texture as one array for kernels; equals `shade.shading.shade`, see fast/test_span_shading.py."""

from __future__ import annotations

from weakref import WeakKeyDictionary

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Image
from softshadow.jit import kernel, read_only
from softshadow.pixels import LARGEST_SAMPLED, LARGEST_UINT
from softshadow.programs.level_of_detail import FILTERS
from softshadow.texture import Texture

LEVELS = 16
OF_UPPER_BITS = 2.0**-9  # of the unit of a 32-bit depth


def level_offsets(image: Image, last: int, n_faces: int) -> list[int]:
    """Return where each level begins in the packed texels of a texture, for `LEVELS` levels."""
    offsets, width, height, slices = [0], image.width, image.height, image.slices
    for _ in range(LEVELS - 1):
        offsets.append(offsets[-1] + (width * height * slices * n_faces if len(offsets) <= last else 0))
        width, height, slices = max(width // 2, 1), max(height // 2, 1), max(slices // 2, 1)
    return offsets


# texels made from images, with the version tokens of these images, by the base image
_made: WeakKeyDictionary[Image, tuple[list[object], np.ndarray]] = WeakKeyDictionary()


def texels_of(texture: Texture) -> np.ndarray:
    """Return all texels (n,) int32 of a texture: its only image with the padding, or all images without it.

    They follow each other level by level, and each level of a cube map face by face. A texel of floats is four numbers.
    """
    base, sampler = texture.base(), texture.sampler
    assert base is not None
    last = sampler.base_level if FILTERS[sampler.min_filter][1] == gl.GL_NONE else texture.last_level()
    levels = range(sampler.base_level, last + 1)
    images = [texture.images[face, level] for level in levels for face in texture.faces]
    is_single = len(images) == 1
    if is_single and base.format.largest != LARGEST_UINT:
        return _in_32_bits(base.read_cells)
    known = _made.get(base)
    if known is not None and len(known[0]) == len(images):
        if all(image.version is version for image, version in zip(images, known[0], strict=True)):
            return known[1]
    parts = [_in_32_bits(image.read_cells if is_single else image.read_cells[:, : image.width]) for image in images]
    texels = parts[0] if is_single else np.concatenate(parts, dtype=np.int32)
    for image in images:
        image.version = image.version if image.version is not None else object()
    _made[base] = [image.version for image in images], texels
    return texels


def _in_32_bits(cells: np.ndarray) -> np.ndarray:
    """Return cells (n,) int32: four bytes, or the bits of numbers in float32; of 32-bit depths the upper 23 bits."""
    if cells.dtype != np.float64:
        return cells.reshape(-1).view(np.int32)
    upper = np.empty(cells.size, np.float32)
    write_upper_bits(read_only(cells.reshape(-1)), upper)
    return upper.view(np.int32)


@kernel
def write_upper_bits(depths, upper):
    """Write the upper 23 bits of 32-bit depths (n,) float64 as numbers (n,) float32."""
    for i in range(depths.shape[0]):
        upper[i] = min(np.floor(depths[i] * OF_UPPER_BITS), LARGEST_SAMPLED)
