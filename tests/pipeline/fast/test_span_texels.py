"""The texels that the kernels read are those of the images, and live as long as the images."""

import gc

import numpy as np

from softshadow import tokens as gl
from softshadow.image import FORMATS, Image
from softshadow.pipeline.fast import span_texels
from softshadow.texture import Texture


def mipmapped_texture() -> Texture:
    """Return a texture of 4x2 random texels with all levels."""
    texture, rng = Texture(1, gl.GL_TEXTURE_2D), np.random.default_rng(1)
    for level, (width, height) in enumerate([(4, 2), (2, 1), (1, 1)]):
        texture.images[0, level] = Image.new(FORMATS[gl.GL_RGBA8], width, height)
        texture.images[0, level].cells[:] = rng.integers(0, 256, texture.images[0, level].cells.shape)
    return texture


def test_levels_lie_one_after_the_other_and_are_packed_again_after_changes():
    texture = mipmapped_texture()
    for _ in range(2):
        parts = [np.ascontiguousarray(image.view).view(np.int32).ravel() for image in texture.images.values()]
        assert np.array_equal(span_texels.texels_of(texture), np.concatenate(parts))
        assert span_texels.texels_of(texture) is span_texels.texels_of(texture)
        texture.images[0, 1].cells[:] += 1


def test_texels_are_freed_with_their_images():
    before = len(span_texels._made)
    texture = mipmapped_texture()
    span_texels.texels_of(texture)
    assert len(span_texels._made) == before + 1
    del texture
    gc.collect()
    assert len(span_texels._made) <= before
