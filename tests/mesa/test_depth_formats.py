"""Depth of 16, 24 and 32 bits and float depth have the bits of Mesa: cleared, drawn, offset, read, sampled, blitted."""

from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = (32, 16)
FORMATS = ("GL_DEPTH_COMPONENT16", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT32", "GL_DEPTH_COMPONENT32F")
TYPES = ("GL_UNSIGNED_INT", "GL_FLOAT", "GL_UNSIGNED_SHORT", "GL_UNSIGNED_BYTE", "GL_INT", "GL_SHORT", "GL_BYTE")


def bind_object(gl: Any, internal: int, in_texture: bool) -> int:
    """Bind a framebuffer object with a colour and a depth buffer; returns its name. A depth texture stays bound."""
    name = gl.glGenFramebuffers(1)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name)
    points = [(gl.GL_COLOR_ATTACHMENT0, gl.GL_RGBA8)]
    if in_texture:
        texture = gl.glGenTextures(1)
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        image = (internal, *SIZE, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, None)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, *image)
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_TEXTURE_2D, texture, 0)
    else:
        points.append((gl.GL_DEPTH_ATTACHMENT, internal))
    for point, format in points:
        buffer = gl.glGenRenderbuffers(1)
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, buffer)
        gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, format, *SIZE)
        gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, point, gl.GL_RENDERBUFFER, buffer)
    return int(name)


def depths(gl: Any, in_texture: bool) -> list[np.ndarray]:
    """Return the depth buffer as every type, and as a texture."""
    types = [getattr(gl, name) for name in TYPES]
    found = [gl.glReadPixels(0, 0, *SIZE, gl.GL_DEPTH_COMPONENT, kind) for kind in types]
    if in_texture:
        found += [gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, kind) for kind in types[:3]]
    return [np.array(each) for each in found]


def shapes(gl: Any, corners: list[list[float]]) -> None:
    gl.glBegin(gl.GL_TRIANGLES)
    for corner in corners:
        gl.glVertex3f(*corner)
    gl.glEnd()


def sampled(gl: Any, compare_func: int, texture_filter: int) -> np.ndarray:
    """Return the window with the bound depth texture drawn over it, compared with r or not."""
    for parameter in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, texture_filter)
    mode = gl.GL_COMPARE_R_TO_TEXTURE if compare_func else gl.GL_NONE
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_COMPARE_MODE, mode)
    if compare_func:
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_COMPARE_FUNC, compare_func)
    gl.glBegin(gl.GL_QUADS)
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        gl.glTexCoord3f(x / 2 + 0.5, y / 2 + 0.5, 0.5 + 0.3 * x)
        gl.glVertex2f(x, y)
    gl.glEnd()
    return np.array(gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE))


def program_of(format: str, in_texture: bool, seed: int):
    def program(gl: Any) -> list[np.ndarray]:
        rng = np.random.default_rng(seed)
        internal = getattr(gl, format)
        name = bind_object(gl, internal, in_texture)
        gl.glViewport(0, 0, *SIZE)
        answers = [np.array([int(gl.glGetIntegerv(gl.GL_DEPTH_BITS))])]
        gl.glClearDepth(float(rng.random()))
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT | gl.GL_COLOR_BUFFER_BIT)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glScissor(3, 3, 9, 9)
        gl.glClearDepth(float(rng.choice([1.0, rng.random()])))
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        gl.glDisable(gl.GL_SCISSOR_TEST)
        answers += depths(gl, in_texture)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        for number in range(4):
            gl.glDepthFunc(gl.GL_ALWAYS if not number else gl.GL_LESS + int(rng.integers(6)))
            gl.glDepthRange(0, float(rng.choice([1, 1, 1e-3, 1e-5])))  # small depths have bits that 32 cannot keep
            gl.glPolygonOffset(float(rng.integers(-2, 3)), float(rng.choice([0, 1, -1000])))
            corners = rng.uniform(-1.3, 1.3, (6, 3)).tolist()
            gl.glColor3f(*(rng.integers(0, 256, 3) / 255).tolist())
            shapes(gl, corners)
            answers += depths(gl, in_texture)
            gl.glDepthFunc(gl.GL_EQUAL)
            gl.glColor3f(1, 0, 0)
            shapes(gl, corners)
            answers.append(np.array(gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)))
        other = bind_object(gl, internal, in_texture)
        gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, name)
        gl.glBlitFramebuffer(0, 0, *SIZE, 3, 1, 31, 15, gl.GL_DEPTH_BUFFER_BIT, gl.GL_NEAREST)
        gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, other)
        answers += depths(gl, in_texture)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        if not in_texture:
            return answers
        gl.glDisable(gl.GL_DEPTH_TEST)
        gl.glColor3f(1, 1, 1)
        gl.glEnable(gl.GL_TEXTURE_2D)
        for compare_func in (0, gl.GL_LEQUAL, gl.GL_GREATER):
            answers += [sampled(gl, compare_func, kind) for kind in (gl.GL_NEAREST, gl.GL_LINEAR)]
        gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, *SIZE)
        answers.append(np.array(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_INT)))
        return answers

    return program


@pytest.mark.parametrize("in_texture", [True, False])
@pytest.mark.parametrize("format", FORMATS)
def test_depth_of_every_format_has_the_bits_of_mesa(format, in_texture):
    for seed in range(4):
        comparison = compare(program_of(format, in_texture, seed), SIZE)
        assert comparison, f"seed {seed}: {comparison}"
