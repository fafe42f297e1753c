"""The texels that the kernels read are those of the images, and live as long as the images."""

import gc

import numpy as np
import pytest

from softshadow import tokens as gl
from softshadow.image import FORMATS, Image
from softshadow.pipeline.fast import span_texels
from softshadow.pixels import LARGEST_SAMPLED, LARGEST_UINT
from softshadow.texture import Sampler, Texture


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


@pytest.mark.interpreted
def test_32_bit_depths_are_sampled_by_their_upper_23_bits():
    rng = np.random.default_rng(2)
    limits = [0, 511, 512, 1023, LARGEST_UINT - 512, LARGEST_UINT - 511, LARGEST_UINT, 1 << 32]
    depths = np.append(limits, rng.integers(0, 1 << 32, 5 * 17 - len(limits))).reshape(5, 17)
    image = Image.new(FORMATS[gl.GL_DEPTH_COMPONENT32], 17, 5)
    image.view[:] = depths
    texture = Texture(1, gl.GL_TEXTURE_2D, Sampler(min_filter=gl.GL_NEAREST), {(0, 0): image})
    texels = span_texels.texels_of(texture).view(np.float32).reshape(5, -1)[:, :17]
    assert np.array_equal(texels, np.minimum(depths >> 9, LARGEST_SAMPLED).astype(np.float32))
