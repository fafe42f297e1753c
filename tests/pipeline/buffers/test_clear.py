"""glClear of depth: rounded in double precision, or drawn as a rectangle under a scissor box or a stencil mask."""

from typing import Any

import numpy as np
import pytest

from softshadow.image import D24, Image
from softshadow.pipeline.buffers.clear import clear_depth, drawn_clear_depth
from softshadow.testing import compare

DEPTHS = (0.0, 0.1, 0.3, 0.5, 0.7, 1 / 3, 0.123456789, 0.999999, 1e-5, 0.25000001, 1.0)
BOXES = {"whole": (0, 0, 16, 12), "inner": (3, 4, 9, 5), "around": (-2, -1, 100, 100)}


def test_clearing_by_drawing_is_at_most_one_unit_off():
    image = Image.new(D24, 1, 1)
    values = np.random.default_rng(1).random(500).tolist()
    assert {drawn_clear_depth(v, image) - clear_depth(v, image) for v in values} == {-1, 0, 1}


@pytest.mark.mesa
@pytest.mark.parametrize("box", [None, *BOXES])
@pytest.mark.parametrize("stencil_mask", [0xFF, 0x01, 0x00])
def test_cleared_depth_is_that_of_mesa(box, stencil_mask):
    def program(gl: Any) -> list[np.ndarray]:
        depths = []
        if box:
            gl.glEnable(gl.GL_SCISSOR_TEST)
            gl.glScissor(*BOXES[box])
        gl.glStencilMask(stencil_mask)
        for depth in DEPTHS:
            gl.glClearDepth(depth)
            for buffers in (gl.GL_DEPTH_BUFFER_BIT, gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT):
                gl.glClear(buffers)
                depths.append(gl.glReadPixels(0, 0, 16, 12, gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_INT))
        return depths

    comparison = compare(program, (16, 12))
    assert comparison, str(comparison)
