"""Textures that change among draws that wait: which draws see what, and what is carried out first."""

import gc
import weakref

import numpy as np
import pytest

from pipeline.small_draws import SIZE, draw_triangle, load_texture
from softshadow import context, gl
from softshadow.context import late_draws
from softshadow.pipeline import queue


def test_textures_loaded_between_draws_do_not_divide_their_batch(batches):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_SCISSOR_TEST)
    for n in range(5):
        gl.glScissor(n, 0, SIZE, SIZE)
        load_texture(n + 1, 50 * n)
        draw_triangle()
    assert not batches
    pixels = gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    assert batches == [5]
    assert pixels[0, :6, 0].tolist() == [0, 50, 100, 150, 200, 200]


def test_a_texture_in_use_gets_an_image_after_the_draws_that_wait(batches):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glBindTexture(gl.GL_TEXTURE_2D, 1)
    draw_triangle()  # white: the texture has no image yet
    load_texture(1, 50)
    assert batches == [1]
    assert gl.glReadPixels(0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, 0, 0] == 255


@pytest.mark.parametrize("side", [2, 256])
@pytest.mark.parametrize("is_whole", [True, False])
def test_new_texels_of_a_texture_in_use_wait(batches, side, is_whole):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    form = gl.GL_RGBA, gl.GL_UNSIGNED_BYTE
    for n in range(20):  # more versions of the texture than one call of the kernels takes
        image = np.full((side, side, 4), 10 * n, np.uint8)
        if is_whole or n == 0:
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, side, side, 0, *form, image)
        else:
            gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, side, side, *form, image)
        gl.glScissor(n, 0, SIZE, SIZE)
        draw_triangle()
    assert not batches
    pixels = gl.glReadPixels(0, 0, SIZE, SIZE, *form)
    assert batches == [20]
    assert pixels[0, :20, 0].tolist() == [10 * n for n in range(20)]
    assert (gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *form) == 190).all()


def test_texels_that_wait_are_bounded(batches, monkeypatch):
    monkeypatch.setattr(queue, "MOST_BYTES", 50)
    monkeypatch.setattr(late_draws, "MOST_BYTES", 16)
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_TEXTURE_2D)
    for n in range(7):  # 16 bytes each
        load_texture(1, n)
        draw_triangle()
    assert batches == [4]
    assert gl.glReadPixels(0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, 0, 0] == 6


def test_draws_keep_the_filter_that_their_texture_had(planned, batches):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    image = np.array([[0, 200]], np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_LUMINANCE, 2, 1, 0, gl.GL_LUMINANCE, gl.GL_UNSIGNED_BYTE, image)
    gl.glTexCoord2f(0.5, 0.5)
    for frame in range(3):
        for n, filter in enumerate([gl.GL_NEAREST, gl.GL_LINEAR] * 4):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, filter)
            gl.glScissor(n, 0, SIZE, SIZE)
            draw_triangle()
        assert batches == [8] * frame
        row = gl.glReadPixels(0, 0, 8, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, :, 0]
        assert row.tolist() == [200, 100] * 4
    assert len(planned) == 2, "the kinds of both filters are found again"


@pytest.mark.parametrize("target", [gl.GL_TEXTURE_1D, gl.GL_TEXTURE_2D])
def test_the_default_texture_is_one_of_each_target(batches, target):
    gl.create_context(SIZE, SIZE)
    gl.glEnable(target)
    gl.glTexParameteri(target, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    size = (2,) if target == gl.GL_TEXTURE_1D else (2, 2)
    load = gl.glTexImage1D if target == gl.GL_TEXTURE_1D else gl.glTexImage2D
    for gray in (40, 80):
        image = np.full((*size, 3), gray, np.uint8)
        load(target, 0, gl.GL_RGB, *size, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, image)
        draw_triangle()
    load(target, 0, gl.GL_RGBA, *size, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, image)
    assert batches == [2], "an image of another format comes after draws that read the texture"
    assert gl.glReadPixels(0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, 0, 0] == 80


def test_new_texels_of_a_texture_that_waiting_draws_write_to_come_after_them(batches):
    gl.create_context(SIZE, SIZE)
    load_texture(1, 0)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, 1, 0)
    draw_triangle()
    image = np.full((1, 1, 3), 70, np.uint8)
    gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, image)
    draw_triangle(0.5)  # of no pixel
    assert not batches
    assert gl.glReadPixels(0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, 0, 0] == 70
    assert batches == [2]


def test_contexts_that_share_textures_see_each_others_changes():
    first, second = gl.create_context(SIZE, SIZE), gl.create_context(SIZE, SIZE)
    second.objects.textures = first.objects.textures
    form = gl.GL_LUMINANCE, gl.GL_UNSIGNED_BYTE
    textures = (gl.GL_LINEAR, [0, 200]), (gl.GL_LINEAR, [0, 160, 40, 160]), (gl.GL_NEAREST, [0, 120])
    for n, (filter, row) in enumerate(textures):
        context.make_current(second)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 1)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, filter)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_LUMINANCE, len(row), 1, 0, *form, np.array([row], np.uint8))
        context.make_current(first)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glScissor(n, 0, SIZE, SIZE)
        gl.glBindTexture(gl.GL_TEXTURE_2D, 1)
        gl.glTexCoord2f(0.5, 0.5)
        draw_triangle()
    read = gl.glReadPixels(0, 0, 3, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, :, 0].tolist()
    assert read == [100, 100, 120]


def test_the_image_of_a_deleted_texture_is_freed_at_once():
    with gl.create_context(SIZE, SIZE) as current:
        gl.glEnable(gl.GL_TEXTURE_2D)
        load_texture(1, 50)
        for filter in (gl.GL_LINEAR, gl.GL_NEAREST):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, filter)
            draw_triangle()
        image = weakref.ref(current.objects.textures[1].images[0, 0])
        gc.disable()
        try:
            gl.glDeleteTextures([1])
            assert image() is None
        finally:
            gc.enable()
