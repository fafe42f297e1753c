"""Texture objects: names, bindings, images, sampler parameters."""

import numpy as np
import pytest

from softshadow import gl
from softshadow.pipeline.execute import execute
from softshadow.pixels import sampled_depth

RGBA = np.arange(48, dtype=np.uint8).reshape(3, 4, 4)


@pytest.fixture(autouse=True)
def context():
    with gl.create_context(8, 6) as context:
        yield context


def bound_texture(pixels=RGBA, internal=gl.GL_RGBA8):
    """A new bound texture of these pixels (h, w, 4)."""
    name = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    height, width = pixels.shape[:2]
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal, width, height, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, pixels)
    return name


def texels():
    """The bound texture's texels as bytes."""
    return gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)


def test_names_are_given_out_once():
    first, several = gl.glGenTextures(1), gl.glGenTextures(3)
    assert (first, several.tolist()) == (1, [2, 3, 4])
    gl.glDeleteTextures([4])
    assert gl.glGenTextures(1) == 5


def test_a_name_becomes_a_texture_when_it_is_bound():
    name = gl.glGenTextures(1)
    assert not gl.glIsTexture(name)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    assert gl.glIsTexture(name)
    assert gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D) == name


def test_texture_0_is_a_texture_too():
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 4, 3, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, RGBA)
    assert (texels() == RGBA).all()
    bound_texture(RGBA + 1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
    assert (texels() == RGBA).all()


def test_a_deleted_texture_leaves_units_and_the_bound_framebuffer():
    name = bound_texture()
    gl.glActiveTexture(gl.GL_TEXTURE1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, name, 0)
    gl.glDeleteTextures(1, [name])
    assert gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D) == 0
    gl.glActiveTexture(gl.GL_TEXTURE0)
    assert gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D) == 0
    assert gl.glCheckFramebufferStatus(gl.GL_FRAMEBUFFER) == gl.GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT


def test_names_of_no_texture_are_deleted_silently():
    gl.glDeleteTextures([0, 77])
    assert gl.glGetError() == gl.GL_NO_ERROR


def test_the_first_row_of_an_image_is_the_bottom_row():
    bound_texture()
    assert (texels()[0] == RGBA[0]).all()


def test_the_users_array_is_copied():
    pixels = RGBA.copy()
    bound_texture(pixels)
    pixels[:] = 0
    assert (texels() == RGBA).all()


def test_a_part_of_an_image_is_replaced():
    bound_texture()
    patch = np.full((2, 3, 4), 200, np.uint8)
    gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 1, 1, 3, 2, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, patch)
    expected = RGBA.copy()
    expected[1:3, 1:4] = 200
    assert (texels() == expected).all()


@pytest.mark.parametrize(("internal", "alpha"), [(gl.GL_RGBA8, 0), (gl.GL_RGB8, 255), (gl.GL_R8, 255)])
def test_an_image_without_pixels_is_black(internal, alpha):
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal, 4, 3, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
    assert texels().reshape(-1, 4).tolist() == [[0, 0, 0, alpha]] * 12


def test_levels_answer_what_they_are():
    bound_texture(internal=gl.GL_RGB8)
    answers = [
        gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, 0, pname)
        for pname in (
            gl.GL_TEXTURE_WIDTH, gl.GL_TEXTURE_HEIGHT, gl.GL_TEXTURE_INTERNAL_FORMAT,
            gl.GL_TEXTURE_RED_SIZE, gl.GL_TEXTURE_ALPHA_SIZE, gl.GL_TEXTURE_DEPTH_SIZE,
        )
    ]  # fmt: skip
    assert answers == [4, 3, gl.GL_RGB8, 8, 0, 0]
    assert gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, 1, gl.GL_TEXTURE_WIDTH) == 0


@pytest.mark.parametrize(
    ("pname", "initial", "value"),
    [
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST_MIPMAP_LINEAR, gl.GL_LINEAR),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_LINEAR, gl.GL_NEAREST),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_REPEAT, gl.GL_CLAMP_TO_BORDER),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_REPEAT, gl.GL_MIRRORED_REPEAT),
        (gl.GL_TEXTURE_COMPARE_MODE, gl.GL_NONE, gl.GL_COMPARE_R_TO_TEXTURE),
        (gl.GL_TEXTURE_COMPARE_FUNC, gl.GL_LEQUAL, gl.GL_GREATER),
        (gl.GL_DEPTH_TEXTURE_MODE, gl.GL_LUMINANCE, gl.GL_ALPHA),
        (gl.GL_TEXTURE_MAX_LEVEL, 1000, 3),
    ],
)
def test_parameters_are_read_back(pname, initial, value):
    assert gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, pname) == initial
    gl.glTexParameteri(gl.GL_TEXTURE_2D, pname, value)
    assert gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, pname) == value
    gl.glTexParameterf(gl.GL_TEXTURE_2D, pname, float(initial))
    assert gl.glGetTexParameterfv(gl.GL_TEXTURE_2D, pname) == initial


def test_the_border_colour_is_queried_clamped():
    gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, (0.5, 2.0, -1.0, 1.0))
    color = gl.glGetTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR)
    assert color.tolist() == [0.5, 1, 0, 1]


def test_textures_keep_their_own_parameters():
    first = bound_texture()
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE)
    bound_texture()
    assert gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S) == gl.GL_REPEAT
    gl.glBindTexture(gl.GL_TEXTURE_2D, first)
    assert gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S) == gl.GL_CLAMP_TO_EDGE


def test_faces_of_a_cube_map_are_images_of_their_own():
    gl.glBindTexture(gl.GL_TEXTURE_CUBE_MAP, gl.glGenTextures(1))
    faces = range(gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X, gl.GL_TEXTURE_CUBE_MAP_NEGATIVE_Z + 1)
    for value, face in enumerate(faces):
        pixels = np.full((2, 2), value, np.uint8)
        gl.glTexImage2D(face, 0, gl.GL_RGBA8, 2, 2, 0, gl.GL_RED, gl.GL_UNSIGNED_BYTE, pixels)
    texels = [gl.glGetTexImage(face, 0, gl.GL_RED, gl.GL_UNSIGNED_BYTE)[0, 0] for face in faces]
    assert texels == list(range(6))


def test_replay_gives_every_texture_again(context):
    bound_texture()
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 1, 1, 0, 0, 2, 2)
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT24, 0, 0, 8, 6, 0)
    storage = context.frame.fresh_storage()
    for command in context.frame.commands:
        execute(command, storage)
    for name, texture in context.storage.textures.items():
        again = storage.textures[name]
        assert again.sampler == texture.sampler
        assert all(image.same_as(again.images[key]) for key, image in texture.images.items())


def test_depth_of_the_window_is_copied_bottom_row_first(context):
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glScissor(0, 0, 8, 1)
    gl.glClearDepth(0.25)
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
    gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT24, 0, 0, 8, 6, 0)
    image = context.storage.textures[0].images[0, 0]
    rows = sampled_depth(image.view, image.format)[:, 0]
    assert np.abs(rows - [0.25, 1, 1, 1, 1, 1]).max() < 2**-23  # one depth unit


def test_fractions_of_places_and_sizes_are_cut_off_as_in_c():
    with gl.create_context(4, 3):
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 4, 4, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, bytes(64))
        pixels = np.full((2, 2, 4), 7, np.uint8)
        gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 1.5, 0.9, 2.0, 2.7, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, pixels)
        texels = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RED, gl.GL_UNSIGNED_BYTE)
    assert np.argwhere(np.asarray(texels).reshape(4, 4)).tolist() == [[0, 1], [0, 2], [1, 1], [1, 2]]
