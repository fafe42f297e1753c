"""Histories of programs with secondary colours, fog coordinates and materials of vertices end with the buffers."""

import numpy as np
import pytest

from mesa.gl_calls import as_program
from mesa.random_programs import random_program
from softshadow import gl
from softshadow.inspection import pixel_history
from softshadow.inspection.replay import copy_window

N_PIXELS = 12


@pytest.mark.parametrize("family", ["secondary colours", "small pairs"])
@pytest.mark.parametrize("seed", range(3))
def test_last_row_equals_the_buffers_with_attributes_of_all_kinds(family: str, seed: int) -> None:
    calls, size = random_program(family, seed)
    with gl.create_context(*size) as context:
        as_program(calls)(gl)
        frame = context.frame  # draws collected pairs
        window = copy_window(context.storage.window).buffers()
    covered = np.argwhere(window.depth < window.depth.max())
    rng = np.random.default_rng(seed)
    pixels = rng.permutation(covered if len(covered) else np.argwhere(window.depth >= 0))[:N_PIXELS]
    draws = 0
    for y, x in pixels.tolist():
        rows = pixel_history(frame, x, y).rows
        draws += sum(row.draw is not None for row in rows)
        assert rows[-1].color_after == tuple(window.color[y, x, :3])
        assert (rows[-1].depth_after, rows[-1].stencil_after) == (window.depth[y, x], window.stencil[y, x])
    assert draws > 0
