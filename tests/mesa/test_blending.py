"""Blending into colour buffers of every format, floats included, leaves the same bits as on Mesa."""

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

WIDTH, HEIGHT = 24, 20
FACTORS = [
    "GL_ZERO", "GL_ONE", "GL_SRC_COLOR", "GL_ONE_MINUS_SRC_COLOR", "GL_DST_COLOR", "GL_ONE_MINUS_DST_COLOR",
    "GL_SRC_ALPHA", "GL_ONE_MINUS_SRC_ALPHA", "GL_DST_ALPHA", "GL_ONE_MINUS_DST_ALPHA", "GL_SRC_ALPHA_SATURATE",
    "GL_CONSTANT_COLOR", "GL_ONE_MINUS_CONSTANT_COLOR", "GL_CONSTANT_ALPHA", "GL_ONE_MINUS_CONSTANT_ALPHA",
]  # fmt: skip
EQUATIONS = ["GL_FUNC_ADD", "GL_FUNC_ADD", "GL_FUNC_SUBTRACT", "GL_FUNC_REVERSE_SUBTRACT", "GL_MIN", "GL_MAX"]
FORMATS = [
    "GL_RGBA32F", "GL_RGB32F", "GL_RG32F", "GL_R32F", "GL_RGBA16F", "GL_RGB16F", "GL_RG16F", "GL_R16F", "GL_RGBA8",
    "GL_RGB8", "GL_RG8", "GL_R8",
]  # fmt: skip


def image(gl, internal, texels):
    """Create and bind a texture of these texels, sampled without interpolation; return its name."""
    name = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    texel_type = gl.GL_FLOAT if texels.dtype == np.float32 else gl.GL_UNSIGNED_BYTE
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal, WIDTH, HEIGHT, 0, gl.GL_RGBA, texel_type, texels)
    for texture_filter in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, texture_filter, gl.GL_NEAREST)
    return name


def switch(gl, capability, enabled):
    (gl.glEnable if enabled else gl.glDisable)(capability)


def set_blending(gl, rng):
    """Set random factors, equations and colour; half of the time factors for which llvmpipe has short cuts."""

    def factor():
        return getattr(gl, rng.choice(FACTORS))

    def equation():
        return getattr(gl, rng.choice(EQUATIONS))

    a, b, c, d = factor(), factor(), factor(), factor()
    rgb, alpha = equation(), equation()
    gl.glBlendFuncSeparate(*[(a, b, c, d), (a, b, a, b), (a, a, d, d), (a, b, c, d)][rng.integers(4)])
    gl.glBlendEquationSeparate(rgb, alpha if rng.random() < 0.5 else rgb)
    gl.glBlendColor(*rng.normal(0.5, 1, 4).tolist())


def program_of(internal, seed):
    """Draw triangles of colours and float texels into a framebuffer object of a format, blended at random."""

    def program(gl):
        rng = np.random.default_rng(seed)
        shape = (HEIGHT, WIDTH, 4)
        floats = rng.normal(0, 1.5, shape).astype(np.float32)
        is_float = internal.endswith("F")
        target = image(gl, getattr(gl, internal), floats if is_float else rng.integers(0, 256, shape, np.uint8))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, target, 0)
        image(gl, gl.GL_RGBA32F, rng.normal(0.3, 1.5, shape).astype(np.float32))
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
        gl.glEnable(gl.GL_BLEND)
        answers = []
        for _ in range(4):
            set_blending(gl, rng)
            gl.glColorMask(*(rng.random(4) < 0.85).tolist())
            switch(gl, gl.GL_COLOR_LOGIC_OP, rng.random() < 0.1)
            switch(gl, gl.GL_ALPHA_TEST, rng.random() < 0.2)
            gl.glAlphaFunc(gl.GL_GREATER, 0.5)
            switch(gl, gl.GL_TEXTURE_2D, rng.random() < 0.7)
            gl.glBegin(gl.GL_TRIANGLES)
            for x, y in rng.uniform(-1.5, 1.5, (9, 2)).tolist():
                gl.glColor4f(*(rng.integers(0, 256, 4) / 255).tolist())
                gl.glTexCoord2f(x / 2 + 0.5, y / 2 + 0.5)
                gl.glVertex2f(x, y)
            gl.glEnd()
            read_type = gl.GL_FLOAT if is_float else gl.GL_UNSIGNED_BYTE
            answers.append(gl.glReadPixels(0, 0, WIDTH, HEIGHT, gl.GL_RGBA, read_type))
        return answers

    return program


@pytest.mark.parametrize("internal", FORMATS)
def test_blended_buffers_have_the_bits_of_mesa(internal):
    for seed in range(5):
        comparison = compare(program_of(internal, seed), (WIDTH, HEIGHT))
        assert comparison, f"{internal} {seed}: {comparison}"


def test_the_alpha_test_rounds_to_bytes_only_for_buffers_of_bytes():
    def program(gl):
        target = image(gl, gl.GL_RGBA32F, np.zeros((HEIGHT, WIDTH, 4), np.float32))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, target, 0)
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(gl.GL_GREATER, 0.5)
        gl.glColor4f(1, 1, 1, 0.501)  # as a byte it is the same as the reference
        gl.glRectf(-1, -1, 1, 1)
        return [gl.glReadPixels(0, 0, 1, 1, gl.GL_RGBA, gl.GL_FLOAT)]

    comparison = compare(program, (WIDTH, HEIGHT))
    assert comparison, str(comparison)
    assert comparison.ours.returned[0][0, 0, 3] == np.float32(0.501)
