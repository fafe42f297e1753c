"""Mipmaps of compressed textures: means of four pixels without their fractions, compressed again.

References: generate_mipmap_compressed in mipmap.c of Mesa 22.3.
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.color_values import as_rgba
from softshadow.compression import COMPRESSED, decoded, encoded
from softshadow.context import Context
from softshadow.gl.compressed_reading import compressed_pixels
from softshadow.pipeline.commands import DefineImage
from softshadow.texture import Texture


def generate_compressed(context: Context, texture: Texture, face: int, base: int, last: int) -> None:
    """Replace the levels of a face after its base level."""
    image = texture.images[face, base]
    compressed, stored = COMPRESSED[image.internal_format], image.format
    pixels = compressed_pixels(image, stored.base, gl.GL_UNSIGNED_BYTE)
    for level in range(base + 1, last + 1):
        pixels = halved(pixels)
        height, width = pixels.shape[:2]
        blocks = encoded(as_rgba(pixels, stored.base, 255, stored.base), compressed)
        cells = decoded(blocks, compressed, width, height)
        layout = stored, image.internal_format, width, height
        context.execute(DefineImage(texture.name, face, level, *layout, cells, blocks=blocks))


def halved(pixels: np.ndarray) -> np.ndarray:
    """Return the next level of bytes (height, width, components).

    Examples
    --------
    >>> halved(np.array([[[1], [2]], [[4], [8]]], np.uint8)).tolist()
    [[[3]]]
    """
    height, width = (max(side // 2, 1) for side in pixels.shape[:2])
    sums = np.zeros((height, width, pixels.shape[2]), np.int64)
    for row in (0, min(1, pixels.shape[0] - 1)):
        for column in (0, min(1, pixels.shape[1] - 1)):
            sums += pixels[row::2, column::2][:height, :width]
    return (sums // 4).astype(np.uint8)
