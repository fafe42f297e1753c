"""glClear of colours, and of depth: rounded in double precision, or drawn as a rectangle under a box or a mask."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.image import D24, FORMATS, Image
from softshadow.pipeline.buffers.clear import clear_depth, drawn_clear_depth
from softshadow.testing import compare

DEPTHS = (0.0, 0.1, 0.3, 0.5, 0.7, 1 / 3, 0.123456789, 0.999999, 1e-5, 0.25000001, 1.0)
BOXES = {"whole": (0, 0, 16, 12), "inner": (3, 4, 9, 5), "around": (-2, -1, 100, 100)}


def test_clearing_by_drawing_is_at_most_one_unit_off():
    image = Image.new(D24, 1, 1)
    values = np.random.default_rng(1).random(500).tolist()
    assert {drawn_clear_depth(v, image) - clear_depth(v, image) for v in values} == {-1, 0, 1}


def test_colors_that_wait_are_written_with_the_rows_before_and_after_them():
    image = Image.new(FORMATS[gl.GL_RGBA8], 5, 4)
    image.cells[:] = 9
    red, green = (np.array(color, np.uint8).view(np.uint32)[0] for color in ((255, 0, 0, 128), (0, 255, 0, 64)))
    image.write_later(0, np.broadcast_to(red, image.shape), None)
    image.write_later(1, np.broadcast_to(green, (2, image.shape[1])), None)
    assert image.read_cells[:, 4].tolist() == [[255, 0, 0, 128], [0, 255, 0, 64], [0, 255, 0, 64], [255, 0, 0, 128]]


@pytest.mark.parametrize("box", BOXES)
def test_a_box_is_cleared_over_a_clear_of_all_colors(box):
    with gl.create_context(16, 12):
        gl.glClearColor(1, 0, 0, 1)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        gl.glEnable(gl.GL_SCISSOR_TEST)
        x, y, width, height = BOXES[box]
        gl.glScissor(*BOXES[box])
        gl.glClearColor(0, 0, 1, 1)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        pixels = gl.glReadPixels(0, 0, 16, 12, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
    expected = np.full((12, 16, 3), (255, 0, 0), np.uint8)
    expected[max(y, 0) : y + height, max(x, 0) : x + width] = 0, 0, 255
    np.testing.assert_array_equal(np.asarray(pixels).reshape(expected.shape), expected)


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
