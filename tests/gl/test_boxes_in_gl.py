"""1-D and 3-D textures and rectangles through the facade: images, lists, attribute stacks, saved runs; on Mesa too."""

from typing import Any

import numpy as np
import pytest

import softshadow as ss
from softshadow import gl
from softshadow.testing import compare

SIZE = (24, 20)
BOX = np.arange(3 * 4 * 5 * 4, dtype=np.uint8).reshape(3, 4, 5, 4)


@pytest.fixture
def context():
    with gl.create_context(*SIZE) as context:
        yield context


def define(on: Any) -> None:
    on.glTexImage3D(on.GL_TEXTURE_3D, 0, on.GL_RGBA8, 5, 4, 3, 0, on.GL_RGBA, on.GL_UNSIGNED_BYTE, BOX)
    for name in (on.GL_TEXTURE_MIN_FILTER, on.GL_TEXTURE_MAG_FILTER):
        on.glTexParameteri(on.GL_TEXTURE_3D, name, on.GL_LINEAR)


def draw(on: Any) -> None:
    on.glBegin(on.GL_TRIANGLE_FAN)
    for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
        on.glTexCoord3f(s, t, 0.3 + 0.4 * s)
        on.glVertex2f(2 * s - 1, 2 * t - 1)
    on.glEnd()


@pytest.mark.usefixtures("context")
def test_a_3d_image_is_read_as_it_was_defined():
    define(gl)
    np.testing.assert_array_equal(gl.glGetTexImage(gl.GL_TEXTURE_3D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE), BOX)
    part = BOX[:2, 1:3, 2:] + np.uint8(100)
    gl.glTexSubImage3D(gl.GL_TEXTURE_3D, 0, 2, 1, 1, 3, 2, 2, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, part)
    changed = BOX.copy()
    changed[1:, 1:3, 2:] = part
    np.testing.assert_array_equal(gl.glGetTexImage(gl.GL_TEXTURE_3D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE), changed)


@pytest.mark.usefixtures("context")
def test_skipped_images_and_the_image_height_are_parts_of_3d_images_only():
    gl.glPixelStorei(gl.GL_UNPACK_SKIP_IMAGES, 1)
    gl.glPixelStorei(gl.GL_UNPACK_IMAGE_HEIGHT, 4)
    layout = gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, BOX
    gl.glTexImage3D(gl.GL_TEXTURE_3D, 0, gl.GL_RGBA8, 5, 3, 2, 0, *layout)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 5, 3, 0, *layout)
    read = gl.GL_RGBA, gl.GL_UNSIGNED_BYTE
    np.testing.assert_array_equal(gl.glGetTexImage(gl.GL_TEXTURE_3D, 0, *read), BOX[1:, :3])
    np.testing.assert_array_equal(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *read), BOX[0, :3])


@pytest.mark.usefixtures("context")
def test_a_rectangle_has_neither_mipmaps_nor_repetition():
    target = gl.GL_TEXTURE_RECTANGLE
    assert gl.glGetTexParameteriv(target, gl.GL_TEXTURE_MIN_FILTER) == gl.GL_LINEAR
    assert gl.glGetTexParameteriv(target, gl.GL_TEXTURE_WRAP_S) == gl.GL_CLAMP_TO_EDGE
    for call in (
        lambda: gl.glTexParameteri(target, gl.GL_TEXTURE_WRAP_S, gl.GL_REPEAT),
        lambda: gl.glTexParameteri(target, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR_MIPMAP_LINEAR),
        lambda: gl.glGenerateMipmap(target),
    ):
        with pytest.raises(gl.GLError, match="GL_INVALID_ENUM"):
            call()
    with pytest.raises(gl.GLError, match=r"level=1\): expected 0"):
        gl.glTexImage2D(target, 1, gl.GL_RGBA8, 1, 1, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)


def test_a_state_prints_the_other_targets_where_they_are_in_use(context: Any) -> None:
    assert "GL_TEXTURE_3D" not in str(context.state)
    gl.glEnable(gl.GL_TEXTURE_3D)
    gl.glBindTexture(gl.GL_TEXTURE_3D, 7)
    printed = str(context.state).splitlines()
    assert {"glEnable(GL_TEXTURE_3D)", "glBindTexture(GL_TEXTURE_3D, 7)"} <= set(printed)


def test_a_saved_run_with_a_3d_texture_is_the_same_when_it_is_loaded(tmp_path):
    with gl.record(*SIZE) as recording:
        define(gl)
        gl.glEnable(gl.GL_TEXTURE_3D)
        draw(gl)
    run = recording.run
    run.save(tmp_path / "box.npz")
    loaded = ss.load_run(tmp_path / "box.npz")
    np.testing.assert_array_equal(loaded.image, run.image)
    assert loaded.pixel(12, 9).rows == run.pixel(12, 9).rows


@pytest.mark.mesa
def test_lists_and_attribute_stacks_hold_3d_textures_as_on_mesa():
    def program(on: Any) -> None:
        on.glNewList(1, on.GL_COMPILE)
        define(on)
        on.glEndList()
        on.glPushAttrib(on.GL_TEXTURE_BIT | on.GL_ENABLE_BIT)
        on.glEnable(on.GL_TEXTURE_3D)
        on.glCallList(1)
        on.glScissor(0, 0, 12, 20)
        on.glEnable(on.GL_SCISSOR_TEST)
        draw(on)
        on.glPopAttrib()
        on.glEnable(on.GL_TEXTURE_3D)  # the filters are the initial ones: no level but the base, so not complete
        on.glScissor(12, 0, 12, 20)
        on.glEnable(on.GL_SCISSOR_TEST)
        draw(on)

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


@pytest.mark.mesa
@pytest.mark.parametrize("filters", ["GL_NEAREST GL_LINEAR", "GL_LINEAR_MIPMAP_LINEAR GL_NEAREST"])
def test_anisotropic_filters_average_the_texels_of_mesa(filters):
    def program(on: Any) -> None:
        rng, target = np.random.default_rng(5), on.GL_TEXTURE_2D
        on.glTexParameteri(target, on.GL_GENERATE_MIPMAP, 1)
        texels = rng.integers(0, 256, (16, 32, 4), dtype=np.uint8)
        on.glTexImage2D(target, 0, on.GL_RGBA8, 32, 16, 0, on.GL_RGBA, on.GL_UNSIGNED_BYTE, texels)
        minifying, magnifying = filters.split()
        on.glTexParameteri(target, on.GL_TEXTURE_MIN_FILTER, getattr(on, minifying))
        on.glTexParameteri(target, on.GL_TEXTURE_MAG_FILTER, getattr(on, magnifying))
        on.glTexParameterf(target, on.GL_TEXTURE_MAX_ANISOTROPY_EXT, 4.0)
        on.glEnable(target)
        on.glBegin(on.GL_TRIANGLES)
        for _ in range(12):
            on.glTexCoord2f(*rng.normal(size=2))
            on.glVertex4f(*rng.uniform(-1, 1, 3), rng.uniform(0.5, 1.5))
        on.glEnd()

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


@pytest.mark.mesa
def test_a_long_ellipse_averages_all_its_texels():
    size = 3, 3

    def program(on: Any) -> None:
        texels = np.random.default_rng(6).integers(0, 256, (8, 4, 4), dtype=np.uint8)
        target, far = on.GL_TEXTURE_RECTANGLE, 20_000.0 * size[0]  # so many texels are in one pixel
        on.glTexImage2D(target, 0, on.GL_RGBA8, 4, 8, 0, on.GL_RGBA, on.GL_UNSIGNED_BYTE, texels)
        on.glTexParameterf(target, on.GL_TEXTURE_MAX_ANISOTROPY_EXT, 4.0)
        on.glEnable(target)
        on.glBegin(on.GL_QUADS)
        for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            on.glTexCoord2f(s * far, 4 + 4 * t)
            on.glVertex2f(s, t)
        on.glEnd()

    comparison = compare(program, size)
    assert comparison, str(comparison)
