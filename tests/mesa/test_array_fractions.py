"""Integer colours in arrays are converted to the float32 that Mesa converts them to, for every type."""

import numpy as np
import pytest

from mesa.random_arrays import TYPES
from softshadow.testing import compare

pytestmark = pytest.mark.mesa

COUNT = 512


def colors(kind: str, size: int) -> np.ndarray:
    dtype = np.dtype(TYPES[kind])
    rng = np.random.default_rng(size)
    if dtype.kind == "f":
        return rng.random((COUNT, size)).astype(dtype)
    limits = np.iinfo(dtype)
    made = rng.integers(limits.min, limits.max, (COUNT, size), dtype=dtype, endpoint=True)
    made[:3, 0] = limits.min, limits.max, limits.max - 1
    return made


@pytest.mark.parametrize("size", [3, 4])
@pytest.mark.parametrize("kind", TYPES)
def test_array_colors_reach_a_float_target_with_the_same_bits(kind, size):
    places = np.stack([np.arange(COUNT) + 0.5, np.full(COUNT, 0.5)], axis=1).astype(np.float32)
    given = colors(kind, size)

    def program(gl):
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture := gl.glGenTextures(1))
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA32F, COUNT, 1, 0, gl.GL_RGBA, gl.GL_FLOAT, None)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
        gl.glViewport(0, 0, COUNT, 1)
        gl.glOrtho(0, COUNT, 0, 1, -1, 1)
        for capability in (gl.GL_VERTEX_ARRAY, gl.GL_COLOR_ARRAY):
            gl.glEnableClientState(capability)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, places)
        gl.glColorPointer(size, getattr(gl, kind), 0, given)
        gl.glDrawArrays(gl.GL_POINTS, 0, COUNT)
        return [gl.glReadPixels(0, 0, COUNT, 1, gl.GL_RGBA, gl.GL_FLOAT)]

    comparison = compare(program, (8, 8))
    assert comparison, str(comparison)
