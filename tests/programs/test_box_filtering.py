"""The kernels for 1-D and 3-D textures and rectangles equal those for 2-D images where both can be used."""

import numpy as np
import pytest

from softshadow import tokens as gl
from softshadow.image import FORMATS, Image
from softshadow.programs.anisotropy import WEIGHTS
from softshadow.programs.box_filtering import sample_box
from softshadow.programs.filtering import sample_image, wraps_of
from softshadow.texture import Sampler, Texture

WRAPS = [gl.GL_REPEAT, gl.GL_CLAMP, gl.GL_CLAMP_TO_EDGE, gl.GL_CLAMP_TO_BORDER, gl.GL_MIRRORED_REPEAT]
F32 = np.float32


def random_image(internal: int, width: int, height: int, slices: int = 1) -> Image:
    rng = np.random.default_rng(width + height)
    image = Image.new(FORMATS[internal], width, height, internal, slices)
    image.view[:] = (rng.random(image.view.shape) * (image.format.largest or 1)).astype(image.view.dtype)
    return image


def sampled(
    texture: Texture, image: Image, wraps: tuple[int, ...], linear: bool, coordinates: np.ndarray
) -> np.ndarray:
    out = np.empty((len(coordinates), 4), F32)
    sample_box(image, texture, wraps, linear, coordinates, out)
    return out


@pytest.mark.parametrize("wrap", WRAPS)
@pytest.mark.parametrize("internal", [gl.GL_RGBA8, gl.GL_RGBA32F, gl.GL_DEPTH_COMPONENT24])
def test_two_axes_are_filtered_as_a_2d_image(wrap, internal):
    image = random_image(internal, 8, 5)
    sampler = Sampler(wrap_s=wrap, wrap_t=wrap, border_color=(0.25, 0.5, 0.75, 1.0))
    texture = Texture(1, gl.GL_TEXTURE_2D, sampler, {(0, 0): image})
    coordinates = np.random.default_rng(1).normal(size=(200, 3)).astype(F32)
    for linear in (False, True):
        expected = np.empty((len(coordinates), 4), F32)
        sample_image(image, sampler, wraps_of(sampler, image), linear, coordinates, expected)
        np.testing.assert_array_equal(sampled(texture, image, wraps_of(sampler, image), linear, coordinates), expected)


def test_the_centres_of_a_rectangle_are_its_texels():
    image = random_image(gl.GL_RGBA8, 5, 3)
    texture = Texture(1, gl.GL_TEXTURE_RECTANGLE, Sampler(), {(0, 0): image})
    y, x = (axis.reshape(-1) for axis in np.indices((3, 5)))
    centres = np.stack([x + 0.5, y + 0.5, 0 * x], axis=1).astype(F32)
    expected = image.view.reshape(-1, 4) * (F32(1) / F32(255))
    for linear in (False, True):
        wraps = (gl.GL_CLAMP_TO_EDGE, gl.GL_CLAMP_TO_EDGE)
        np.testing.assert_array_equal(sampled(texture, image, wraps, linear, centres), expected)


def test_half_way_between_two_slices_is_their_mean():
    image = random_image(gl.GL_RGBA32F, 1, 1, slices=2)
    texture = Texture(1, gl.GL_TEXTURE_3D, Sampler(), {(0, 0): image})
    middle = sampled(texture, image, (gl.GL_CLAMP_TO_EDGE,) * 3, True, np.full((1, 3), 0.5, F32))
    first, second = image.view.reshape(2, 4)
    np.testing.assert_array_equal(middle[0], F32(0.5) * (second - first) + first)


def test_the_weights_of_an_ellipse_fall_from_1_to_the_square_of_1_over_e():
    assert WEIGHTS[0] == 1
    assert abs(WEIGHTS[-1] - np.exp(-2)) < 1e-6  # six decimals
    assert (np.diff(WEIGHTS) < 0).all()
