"""Cube maps and texture units through the facade: the cube map named 0, faces as attachments, biases, on Mesa too."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.context import Context
from softshadow.testing import compare

FACES = [f"GL_TEXTURE_CUBE_MAP_{sign}_{axis}" for axis in "XYZ" for sign in ("POSITIVE", "NEGATIVE")]
SIZE = (24, 20)


@pytest.fixture
def context():
    with gl.create_context(*SIZE) as context:
        yield context


def define(on: Any, side: int, seed: int = 1) -> None:
    """Give the bound cube map six faces of random colours, one level."""
    rng = np.random.default_rng(seed)
    for face in FACES:
        texels = rng.integers(0, 256, (side, side, 4), dtype=np.uint8)
        layout = on.GL_RGBA8, side, side, 0, on.GL_RGBA, on.GL_UNSIGNED_BYTE
        on.glTexImage2D(getattr(on, face), 0, *layout, texels)
    for name in (on.GL_TEXTURE_MIN_FILTER, on.GL_TEXTURE_MAG_FILTER):
        on.glTexParameteri(on.GL_TEXTURE_CUBE_MAP, name, on.GL_LINEAR)


def draw(on: Any, seed: int = 2) -> None:
    rng = np.random.default_rng(seed)
    on.glBegin(on.GL_TRIANGLES)
    for _ in range(9):
        on.glTexCoord3f(*rng.normal(size=3))
        on.glVertex3f(*rng.uniform(-1, 1, 3))
    on.glEnd()


def test_the_cube_map_named_0_is_not_the_2d_texture_named_0(context: Context):
    define(gl, 4)
    assert gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_CUBE_MAP_NEGATIVE_Z, 0, gl.GL_TEXTURE_WIDTH) == 4
    assert gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, 0, gl.GL_TEXTURE_WIDTH) == 0
    assert gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_CUBE_MAP) == 0
    assert not gl.glIsTexture(0)


def test_the_bias_of_a_unit_is_its_own_and_is_popped(context: Context):
    gl.glTexEnvf(gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS, -1.75)
    gl.glPushAttrib(gl.GL_TEXTURE_BIT)
    gl.glTexEnvf(gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS, 2)
    gl.glActiveTexture(gl.GL_TEXTURE1)
    assert gl.glGetTexEnvfv(gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS) == 0
    gl.glPopAttrib()
    assert gl.glGetTexEnvfv(gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS) == -1.75
    assert gl.glGetTexEnviv(gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS) == -1
    assert "glTexEnvf(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, -1.75)" in str(context.state)


def test_states_of_cube_maps_print_as_their_calls(context: Context):
    gl.glEnable(gl.GL_TEXTURE_CUBE_MAP_SEAMLESS)
    gl.glTexGeni(gl.GL_S, gl.GL_TEXTURE_GEN_MODE, gl.GL_REFLECTION_MAP)
    gl.glEnable(gl.GL_TEXTURE_GEN_S)
    printed = str(context.state).splitlines()
    assert "glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS)" in printed
    assert "glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_REFLECTION_MAP)" in printed
    assert not any("PLANE" in call for call in printed)


@pytest.mark.mesa
def test_no_group_of_attributes_brings_seamless_back():
    def program(on: Any) -> list[Any]:
        answers = []
        for bit in (on.GL_ENABLE_BIT, on.GL_TEXTURE_BIT, on.GL_ALL_ATTRIB_BITS):
            on.glEnable(on.GL_TEXTURE_CUBE_MAP_SEAMLESS)
            on.glPushAttrib(bit)
            on.glDisable(on.GL_TEXTURE_CUBE_MAP_SEAMLESS)
            on.glPopAttrib()
            answers.append(np.array(int(on.glIsEnabled(on.GL_TEXTURE_CUBE_MAP_SEAMLESS))))
        return answers

    assert compare(program, SIZE)


@pytest.mark.mesa
@pytest.mark.parametrize("target", ["GL_TEXTURE_2D", "GL_TEXTURE_CUBE_MAP"])
def test_parameters_of_textures_named_0_are_popped_as_on_mesa(target):
    def program(on: Any) -> list[Any]:
        on.glPushAttrib(on.GL_TEXTURE_BIT)
        on.glTexParameteri(getattr(on, target), on.GL_TEXTURE_MIN_FILTER, on.GL_LINEAR)
        on.glPopAttrib()
        return [np.array(on.glGetTexParameteriv(getattr(on, target), on.GL_TEXTURE_MIN_FILTER))]

    assert compare(program, SIZE)


@pytest.mark.mesa
def test_a_cube_map_comes_before_a_2d_texture_as_long_as_it_is_complete():
    def program(on: Any) -> None:
        on.glEnable(on.GL_TEXTURE_2D)
        on.glEnable(on.GL_TEXTURE_CUBE_MAP)
        texel = np.full((1, 1, 4), 90, np.uint8)
        on.glTexImage2D(on.GL_TEXTURE_2D, 0, on.GL_RGBA8, 1, 1, 0, on.GL_RGBA, on.GL_UNSIGNED_BYTE, texel)
        draw(on, 3)  # no face: the 2-D texture
        define(on, 4)
        draw(on, 4)
        on.glTexImage2D(getattr(on, FACES[3]), 0, on.GL_RGBA8, 1, 1, 0, on.GL_RGBA, on.GL_UNSIGNED_BYTE, texel)
        draw(on, 5)  # a face of another size

    assert compare(program, SIZE)


@pytest.mark.mesa
def test_faces_are_attachments_as_on_mesa():
    def program(on: Any) -> list[Any]:
        answers, (color, depth) = [], on.glGenTextures(2)
        packed = on.GL_DEPTH24_STENCIL8, 16, 16, 0, on.GL_DEPTH_STENCIL, on.GL_UNSIGNED_INT_24_8
        on.glBindTexture(on.GL_TEXTURE_CUBE_MAP, depth)
        for face in FACES:
            on.glTexImage2D(getattr(on, face), 0, *packed, None)
        on.glBindTexture(on.GL_TEXTURE_CUBE_MAP, color)
        define(on, 16)
        on.glBindFramebuffer(on.GL_FRAMEBUFFER, on.glGenFramebuffers(1))
        on.glViewport(0, 0, 16, 16)
        on.glEnable(on.GL_DEPTH_TEST)
        for seed, face in enumerate(FACES):
            attach = on.glFramebufferTexture2D
            attach(on.GL_FRAMEBUFFER, on.GL_COLOR_ATTACHMENT0, getattr(on, face), color, 0)
            attach(on.GL_FRAMEBUFFER, on.GL_DEPTH_STENCIL_ATTACHMENT, getattr(on, FACES[seed - 1]), depth, 0)
            on.glClear(on.GL_DEPTH_BUFFER_BIT)
            draw(on, seed)
            answers.append(np.array(on.glCheckFramebufferStatus(on.GL_FRAMEBUFFER)))
            answers.append(on.glReadPixels(0, 0, 16, 16, on.GL_DEPTH_COMPONENT, on.GL_FLOAT))
            for name in (on.GL_COLOR_ATTACHMENT0, on.GL_DEPTH_ATTACHMENT):
                query = on.GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_CUBE_MAP_FACE
                answer = on.glGetFramebufferAttachmentParameteriv(on.GL_FRAMEBUFFER, name, query)
                answers.append(np.array(answer))
        on.glBindFramebuffer(on.GL_FRAMEBUFFER, 0)
        on.glViewport(0, 0, *SIZE)
        on.glEnable(on.GL_TEXTURE_CUBE_MAP)
        draw(on, 7)
        return answers + [on.glGetTexImage(getattr(on, f), 0, on.GL_RGBA, on.GL_UNSIGNED_BYTE) for f in FACES]

    assert compare(program, SIZE)
