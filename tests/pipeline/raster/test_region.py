"""Where a draw may write: columns and rows within the buffers, wherever scissor box and triangles are."""

from dataclasses import replace

import numpy as np
import pytest

from softshadow.context import Context
from softshadow.pipeline.raster.region import covered, region_of
from softshadow.pipeline.records import Setup

WIDTH, HEIGHT = 40, 30
PLACES = (-100, -5, 0, 7, 39, 100)


def is_within(region):
    return 0 <= region.left <= region.right <= WIDTH and 0 <= region.first_row <= region.end_row <= HEIGHT


@pytest.mark.parametrize("x", PLACES)
@pytest.mark.parametrize("y", [-100, 3, 100])
def test_a_region_is_within_the_buffers_wherever_the_scissor_box_is(x, y):
    context = Context(WIDTH, HEIGHT)
    state = replace(context.state, scissor=replace(context.state.scissor, enabled=True, x=x, y=y, width=9, height=9))
    assert is_within(region_of(state, context.storage.window))


@pytest.mark.parametrize("x", PLACES)
def test_the_columns_of_triangles_are_within_the_buffers_wherever_these_are(x):
    context = Context(WIDTH, HEIGHT)
    region = region_of(context.state, context.storage.window)
    corners = (np.array([[x, 0, x + 9, 0, x, 9]]) * 256).astype(np.int32)
    cut, _ = covered(Setup(corners, corners, corners, corners, corners), region)
    assert 0 <= cut.left <= cut.right <= WIDTH
    assert (cut.left, cut.right) == (x, x + 10) or not 0 <= x <= WIDTH - 10
