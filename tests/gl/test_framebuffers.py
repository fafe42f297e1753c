"""Framebuffer objects and renderbuffers."""

import numpy as np
import pytest

from softshadow import gl


@pytest.fixture(autouse=True)
def context():
    with gl.create_context(8, 6) as context:
        yield context


def texture(internal=gl.GL_RGBA8, width=4, height=3):
    """A new bound texture of zeros."""
    name = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    packed = (gl.GL_DEPTH24_STENCIL8, gl.GL_DEPTH32F_STENCIL8)
    depth = internal in (gl.GL_DEPTH_COMPONENT24, gl.GL_DEPTH_COMPONENT32F, *packed)
    format = gl.GL_DEPTH_COMPONENT if depth else gl.GL_RGBA
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal, width, height, 0, format, gl.GL_FLOAT, None)
    return name


def bound_framebuffer(**attached):
    """A new bound framebuffer object with textures at GL_<NAME>_ATTACHMENT."""
    name = gl.glGenFramebuffers(1)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name)
    for point, texture in attached.items():
        token = getattr(gl, "GL_COLOR_ATTACHMENT0" if point == "color" else f"GL_{point.upper()}_ATTACHMENT")
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, token, gl.GL_TEXTURE_2D, texture, 0)
    return name


def status():
    return gl.glCheckFramebufferStatus(gl.GL_FRAMEBUFFER)


def test_the_window_is_complete():
    assert status() == gl.GL_FRAMEBUFFER_COMPLETE


def test_an_object_without_buffers_is_incomplete():
    bound_framebuffer()
    assert status() == gl.GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT


@pytest.mark.parametrize(
    ("attached", "expected"),
    [
        ({"color": gl.GL_RGBA8}, gl.GL_FRAMEBUFFER_COMPLETE),
        ({"color": gl.GL_R32F, "depth": gl.GL_DEPTH_COMPONENT32F}, gl.GL_FRAMEBUFFER_COMPLETE),
        ({"depth": gl.GL_DEPTH_COMPONENT24}, gl.GL_FRAMEBUFFER_COMPLETE),
        ({"depth_stencil": gl.GL_DEPTH24_STENCIL8}, gl.GL_FRAMEBUFFER_COMPLETE),
        ({"color": gl.GL_DEPTH_COMPONENT24}, gl.GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT),
        ({"depth": gl.GL_RGBA8}, gl.GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT),
        ({"stencil": gl.GL_DEPTH_COMPONENT24}, gl.GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT),
        ({"color": gl.GL_LUMINANCE8}, gl.GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT),
    ],
)
def test_a_buffer_must_serve_its_attachment_point(attached, expected):
    bound_framebuffer(**{point: texture(internal) for point, internal in attached.items()})
    assert status() == expected


def test_what_is_drawn_is_in_the_texture():
    name = texture()
    bound_framebuffer(color=name)
    gl.glClearColor(1, 0, 0.2, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    texels = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    assert texels.reshape(-1, 4).tolist() == [[255, 0, 51, 255]] * 12


def test_a_framebuffer_follows_its_texture_to_a_new_image():
    name = texture()
    bound_framebuffer(color=name)
    pixels = np.full((2, 2), 9, np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 2, 2, 0, gl.GL_RED, gl.GL_UNSIGNED_BYTE, pixels)
    assert (gl.glReadPixels(0, 0, 2, 2, gl.GL_RED, gl.GL_UNSIGNED_BYTE) == 9).all()


def test_a_level_can_be_attached_before_it_is_defined():
    name = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    bound_framebuffer(color=name)
    assert status() == gl.GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 2, 2, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
    assert status() == gl.GL_FRAMEBUFFER_COMPLETE


def test_a_deleted_object_gives_way_to_the_window():
    name = bound_framebuffer(color=texture())
    assert gl.glIsFramebuffer(name)
    gl.glDeleteFramebuffers(1, [name])
    assert not gl.glIsFramebuffer(name)
    assert gl.glGetIntegerv(gl.GL_FRAMEBUFFER_BINDING) == 0


def test_draw_and_read_framebuffer_are_bound_apart():
    source, target = (bound_framebuffer(color=texture()) for _ in range(2))
    gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, source)
    assert gl.glGetIntegerv(gl.GL_DRAW_FRAMEBUFFER_BINDING) == target
    assert gl.glGetIntegerv(gl.GL_READ_FRAMEBUFFER_BINDING) == source
    gl.glClearColor(1, 1, 1, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    assert not gl.glReadPixels(0, 0, 4, 3, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE).any()


def test_nothing_is_written_without_a_draw_buffer():
    bound_framebuffer(color=texture())
    gl.glDrawBuffer(gl.GL_NONE)
    gl.glClearColor(1, 1, 1, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    assert not gl.glReadPixels(0, 0, 4, 3, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE).any()


def test_the_chosen_attachment_is_written_and_read():
    first, second = texture(), texture()
    bound_framebuffer(color=first)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT1, gl.GL_TEXTURE_2D, second, 0)
    gl.glDrawBuffers(1, [gl.GL_COLOR_ATTACHMENT0])
    gl.glDrawBuffer(gl.GL_COLOR_ATTACHMENT1)
    gl.glClearColor(1, 1, 1, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    assert not gl.glReadPixels(0, 0, 4, 3, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE).any()
    gl.glReadBuffer(gl.GL_COLOR_ATTACHMENT1)
    assert (gl.glReadPixels(0, 0, 4, 3, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE) == 255).all()


def test_the_window_has_one_colour_buffer_by_every_name():
    for name in (gl.GL_FRONT, gl.GL_BACK, gl.GL_LEFT, gl.GL_FRONT_AND_BACK):
        gl.glDrawBuffer(name)
        gl.glReadBuffer(name)
        gl.glReadPixels(0, 0, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    gl.glReadBuffer(gl.GL_NONE)
    with pytest.raises(gl.GLError, match="has no colour buffer to read"):
        gl.glReadPixels(0, 0, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)


def test_packed_depth_and_stencil_are_two_buffers_of_one_texture():
    bound_framebuffer(depth_stencil=texture(gl.GL_DEPTH24_STENCIL8))
    gl.glClearDepth(0.5)
    gl.glClearStencil(7)
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    word = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8)[0, 0]
    assert (word >> 8, word & 255) == (8388608, 7)


def test_float_depth_and_stencil_are_two_fields_of_one_pixel():
    bound_framebuffer(depth_stencil=texture(gl.GL_DEPTH32F_STENCIL8))
    gl.glClearDepth(0.1)
    gl.glClearStencil(7)
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    packed = (gl.GL_DEPTH_STENCIL, gl.GL_FLOAT_32_UNSIGNED_INT_24_8_REV)
    pixels = gl.glReadPixels(0, 0, 4, 3, *packed)
    assert (pixels["depth"] == np.float32(0.1)).all()
    assert (pixels["stencil"] == 7).all()
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH32F_STENCIL8, 4, 3, 0, *packed, pixels.tobytes())
    assert (gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *packed) == pixels).all()
    with pytest.raises(TypeError, match="pixels are float32"):
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH32F_STENCIL8, 4, 3, 0, *packed, pixels["depth"])


def test_depth_and_stencil_in_two_objects_are_not_drawn_to():
    depth, stencil = texture(gl.GL_DEPTH_COMPONENT24), texture(gl.GL_DEPTH24_STENCIL8)
    bound_framebuffer(depth=depth, stencil=stencil)
    assert status() == gl.GL_FRAMEBUFFER_UNSUPPORTED
    with pytest.raises(gl.GLError, match="GL_INVALID_FRAMEBUFFER_OPERATION"):
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
    with pytest.raises(gl.GLError, match="not the same object"):
        gl.glGetFramebufferAttachmentParameteriv(
            gl.GL_FRAMEBUFFER, gl.GL_DEPTH_STENCIL_ATTACHMENT, gl.GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE
        )


def test_a_renderbuffer_of_depth_alone_is_not_attached_to_both_points():
    bound_framebuffer(color=texture())
    renderbuffer = gl.glGenRenderbuffers(1)
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, renderbuffer)
    gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH_COMPONENT24, 4, 3)
    with pytest.raises(gl.GLError, match="expected depth and stencil, it is GL_DEPTH_COMPONENT24"):
        gl.glFramebufferRenderbuffer(
            gl.GL_FRAMEBUFFER, gl.GL_DEPTH_STENCIL_ATTACHMENT, gl.GL_RENDERBUFFER, renderbuffer
        )


def test_a_renderbuffer_serves_as_a_buffer():
    renderbuffer = gl.glGenRenderbuffers(1)
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, renderbuffer)
    bound_framebuffer(color=texture())
    gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_RENDERBUFFER, renderbuffer)
    assert status() == gl.GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT
    gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH_COMPONENT24, 4, 3)
    assert status() == gl.GL_FRAMEBUFFER_COMPLETE
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
    assert (gl.glReadPixels(0, 0, 4, 3, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT) == 1).all()
    gl.glDeleteRenderbuffers(1, [renderbuffer])
    with pytest.raises(gl.GLError, match="has no depth buffer to read"):
        gl.glReadPixels(0, 0, 4, 3, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)


def test_attachments_answer_what_they_are():
    name = texture()
    bound_framebuffer(color=name)
    kind, attached = (
        gl.glGetFramebufferAttachmentParameteriv(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, pname)
        for pname in (gl.GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, gl.GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME)
    )
    assert (kind, attached) == (gl.GL_TEXTURE, name)
