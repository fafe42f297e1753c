"""Copies from framebuffers into textures, and the one place that flips."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow import tokens as gl
from softshadow.framebuffer import Attachment, Framebuffer, Storage, default_framebuffer
from softshadow.image import FORMATS, Image, storage_format
from softshadow.pipeline.buffers.copy import bottom_up, clipped, copy_to_texture
from softshadow.pipeline.commands import CopyToTexture
from softshadow.pixels import quantized_depth, sampled_depth
from softshadow.texture import Texture

POINTS = {"depth": gl.GL_DEPTH_ATTACHMENT, "unorm8": gl.GL_COLOR_ATTACHMENT0, "float": gl.GL_COLOR_ATTACHMENT0}
DEPTH_STEP = np.float32(1) / np.float32(16777215)
DEPTH_FORMATS = (
    gl.GL_DEPTH_COMPONENT16, gl.GL_DEPTH_COMPONENT24, gl.GL_DEPTH_COMPONENT32, gl.GL_DEPTH_COMPONENT32F,
)  # fmt: skip
size = st.integers(1, 9)
coordinate = st.integers(-12, 12)


def random_image(internal: int, width: int, height: int, seed: int = 0) -> Image:
    """Return an image with random cells over their whole range."""
    rng = np.random.default_rng(seed)
    image = Image.new(storage_format(internal), width, height, internal)
    largest = image.format.largest or 1
    values = rng.random(image.view.shape) * largest
    image.view[:] = np.rint(values) if image.format.largest else values
    return image


def offscreen(image: Image) -> Framebuffer:
    """Return a framebuffer object with one image."""
    return Framebuffer(1, {POINTS[image.format.kind]: Attachment(image)})


def copied_texels(source: Framebuffer, image: Image, *arguments: int) -> np.ndarray:
    """Return the texels after glCopyTexSubImage2D(x_offset, y_offset, x, y, width, height)."""
    texture = Texture(5, gl.GL_TEXTURE_2D, images={(0, 0): image})
    storage = Storage({source.name: source}, {5: texture})
    copy_to_texture(CopyToTexture(source.name, 5, 0, 0, *arguments), storage)
    return image.view


@given(size, size)
def test_the_window_is_flipped_once_and_framebuffer_objects_never(width, height):
    window = default_framebuffer(width, height)
    color = window.color
    assert color is not None
    color.view[:] = random_image(gl.GL_RGBA8, width, height).view
    assert (bottom_up(window, color) == color.view[::-1]).all()
    assert (bottom_up(offscreen(color), color) == color.view).all()


@given(coordinate, coordinate, st.integers(0, 15), st.integers(0, 15), size, size)
def test_clipping_keeps_exactly_the_pixels_inside(x, y, width, height, total_width, total_height):
    source = offscreen(Image.new(FORMATS[gl.GL_RGBA8], total_width, total_height))
    rows, columns, moved_x, moved_y = clipped(source, x, y, width, height)
    inside_x = [i for i in range(x, x + width) if 0 <= i < total_width]
    inside_y = [j for j in range(y, y + height) if 0 <= j < total_height]
    assert list(range(columns.start, columns.stop)) == inside_x
    assert list(range(rows.start, rows.stop)) == inside_y
    assert not inside_x or x + moved_x == inside_x[0]
    assert not inside_y or y + moved_y == inside_y[0]


def test_depth_of_a_framebuffer_object_is_copied_unchanged():
    source = random_image(gl.GL_DEPTH_COMPONENT24, 40, 30)
    image = Image.new(source.format, 40, 30)
    assert (copied_texels(offscreen(source), image, 0, 0, 0, 0, 40, 30) == source.view).all()


def test_depth_of_the_window_goes_through_float():
    window = default_framebuffer(60, 50)
    assert window.depth is not None
    window.depth.view[:] = random_image(gl.GL_DEPTH_COMPONENT24, 60, 50).view
    image = Image.new(window.depth.format, 60, 50)
    expected = np.rint((window.depth.view[::-1] * DEPTH_STEP) * np.float32(16777215))
    texels = copied_texels(window, image, 0, 0, 0, 0, 60, 50)
    assert (texels == expected).all()
    assert (texels != window.depth.view[::-1]).any()


@pytest.mark.parametrize("internal", DEPTH_FORMATS)
@pytest.mark.parametrize("of_window", DEPTH_FORMATS)
def test_a_rectangle_of_the_window_is_sampled_and_quantized(of_window, internal):
    depth = random_image(of_window, 60, 50)
    window = default_framebuffer(60, 50)
    window.attachments[gl.GL_DEPTH_ATTACHMENT] = Attachment(depth)
    image = random_image(internal, 40, 30, seed=1)
    expected = image.view.copy()
    lower_left = depth.view[::-1][7:27, 11:46]
    expected[4:24, 3:38] = quantized_depth(sampled_depth(lower_left, depth.format), image.format)
    assert (copied_texels(window, image, 3, 4, 11, 7, 35, 20) == expected).all()


def test_pixels_outside_the_framebuffer_leave_their_texels_unchanged():
    source = random_image(gl.GL_RGBA8, 4, 3)
    image = random_image(gl.GL_RGBA8, 10, 10, seed=1)
    before = image.view.copy()
    before[4:7, 3:7] = source.view
    assert (copied_texels(offscreen(source), image, 1, 2, -2, -2, 9, 8) == before).all()


def test_stencil_is_copied_with_packed_depth():
    source = random_image(gl.GL_DEPTH24_STENCIL8, 5, 4)
    assert source.stencil is not None
    source.stencil.view[:] = np.arange(20).reshape(4, 5)
    framebuffer = Framebuffer(
        1, {gl.GL_DEPTH_ATTACHMENT: Attachment(source), gl.GL_STENCIL_ATTACHMENT: Attachment(source.stencil)}
    )
    image = Image.new(source.format, 5, 4, gl.GL_DEPTH24_STENCIL8)
    copied_texels(framebuffer, image, 0, 0, 0, 0, 5, 4)
    assert image.same_as(source)


@pytest.mark.parametrize("internal", [gl.GL_RGB8, gl.GL_LUMINANCE8, gl.GL_RGBA32F])
def test_colors_are_converted_to_the_format_of_the_texture(internal):
    source = random_image(gl.GL_RGBA8, 3, 2)
    texels = copied_texels(offscreen(source), Image.new(FORMATS[internal], 3, 2), 0, 0, 0, 0, 3, 2)
    rgba = source.view
    if internal == gl.GL_RGBA32F:
        assert (texels == rgba * (np.float32(1) / np.float32(255))).all()
    else:
        assert (texels[..., 0] == rgba[..., 0]).all()
        assert (texels[..., 3] == 255).all()
        assert (texels[..., 1] == rgba[..., 1 if internal == gl.GL_RGB8 else 0]).all()
