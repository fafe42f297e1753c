"""Minification against magnification: the switch-over by example, and whole draws against Mesa."""

from typing import Any

import numpy as np
import pytest

from softshadow.programs.level_of_detail import coarse_log2, minified
from softshadow.testing import compare
from softshadow.texture import Sampler


def block(step: float) -> np.ndarray:
    """Coordinates (4, 3) of one block whose s grows by `step` per pixel."""
    return np.float32([[0, 0, 0], [step, 0, 0], [0, 0, 0], [step, 0, 0]])


def test_one_texel_per_pixel_is_still_magnified():
    assert [bool(minified(block(texels / 8), 8, 8, Sampler())[0]) for texels in (0.5, 1, 1.01, 3)] == [
        False, False, True, True,
    ]  # fmt: skip


def test_bias_and_limits_move_the_switch_over():
    assert not minified(block(1.5 / 8), 8, 8, Sampler(lod_bias=-1.0))[0]
    assert minified(block(0.9 / 8), 8, 8, Sampler(lod_bias=1.0))[0]
    assert minified(block(0.1 / 8), 8, 8, Sampler(min_lod=0.5, max_lod=4.0))[0]
    assert not minified(block(9.0), 8, 8, Sampler(min_lod=0.0, max_lod=0.0))[0]


def test_the_coarse_logarithm_is_exact_at_powers_of_two():
    assert coarse_log2(np.float32([0.25, 1, 2, 64])).tolist() == [-2, 0, 1, 6]
    assert coarse_log2(np.float32([3])).tolist() == [1.5]


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(8))
def test_two_filters_in_one_draw_are_mesas(seed):
    rng = np.random.default_rng(seed)
    names = ("GL_NEAREST", "GL_LINEAR") if seed % 2 else ("GL_LINEAR", "GL_NEAREST")
    cells = rng.integers(0, 256, (13 if seed % 3 else 16, 16, 4), dtype=np.uint8)
    positions, texcoords = rng.normal(0, 2, (12, 3)), rng.normal(0, 2, (12, 2))
    bias = (0.0, 0.5, -1.25)[seed % 3]

    def program(gl: Any) -> None:
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.gluPerspective(50, 1, 1, 20)
        gl.glTranslatef(0, 0, -6)
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        size = cells.shape[1], cells.shape[0]
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, *size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, cells)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, getattr(gl, names[0]))
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, getattr(gl, names[1]))
        gl.glTexParameterf(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_LOD_BIAS, bias)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glBegin(gl.GL_TRIANGLES)
        for position, texcoord in zip(positions, texcoords, strict=True):
            gl.glTexCoord2f(*texcoord)
            gl.glVertex3f(*position)
        gl.glEnd()

    assert compare(program, (61, 47)).differences == ()
