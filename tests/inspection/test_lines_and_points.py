"""Histories and counts of lines, points and polygons that are not filled: as complete as those of triangles."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from draws import random_state, random_triangles, vertices
from inspection.recorded_frames import SIZE, set_groups
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.inspection import ledger_of, pixel_history
from softshadow.inspection.replay import copy_window
from softshadow.pipeline.commands import Vertices

pytestmark = pytest.mark.interpreted

PRIMITIVES = (gl.GL_POINTS, gl.GL_LINES, gl.GL_LINE_STRIP, gl.GL_LINE_LOOP, gl.GL_TRIANGLES, gl.GL_QUADS)
POLYGON_MODES = (gl.GL_POINT, gl.GL_LINE, gl.GL_FILL)
COUNTED = ("passed", "alpha failed", "stencil failed", "depth failed")
PIXELS = [(x, y) for y in range(SIZE[1]) for x in range(SIZE[0])]


def draw(context: Context, mode: int, made: Vertices) -> None:
    position, color, normal = (context.frozen(rows) for rows in (made.position, made.color, made.normal))
    context.draw(mode, Vertices(position, color, normal, ()))


def random_frame(seed: int) -> Context:
    rng = np.random.default_rng(seed)
    context = Context(*SIZE)
    for _ in range(5):
        state = random_state(rng, context.state)
        front, back = rng.choice(POLYGON_MODES, 2)
        offset_line, offset_point = (bool(on) for on in rng.random(2) < 0.5)
        polygon = replace(
            state.polygon, mode_front=int(front), mode_back=int(back), offset_line=offset_line,
            offset_point=offset_point, line_width=float(rng.integers(1, 4)), point_size=float(rng.integers(1, 5)),
        )  # fmt: skip
        context.state = replace(state, polygon=polygon, scissor=replace(state.scissor, x=3, y=2, width=10, height=7))
        draw(context, int(rng.choice(PRIMITIVES)), random_triangles(rng, 4))
    context.end_step("all")
    return context


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1))
def test_last_row_equals_the_buffers(seed):
    context = random_frame(seed)
    window = copy_window(context.storage.window).buffers()
    for x, y in PIXELS[:: 1 + seed % 5]:
        rows = pixel_history(context.frame, x, y).rows
        if rows:
            assert rows[-1].color_after == tuple(window.color[y, x, :3])
            assert (rows[-1].depth_after, rows[-1].stencil_after) == (window.depth[y, x], window.stencil[y, x])
        else:
            assert (window.color[y, x].any(), window.depth[y, x], window.stencil[y, x]) == (False, 1, 0)


@pytest.mark.slow
@settings(max_examples=10)
@given(st.integers(0, 2**32 - 1))
def test_histories_of_all_pixels_have_the_verdicts_of_the_ledger(seed):
    frame = random_frame(seed).frame
    rows = [row for x, y in PIXELS for row in pixel_history(frame, x, y)]
    verdicts, total = Counter(row.verdict for row in rows), ledger_of(frame).total
    assert {name: verdicts[name] for name in COUNTED} == {name: total.fragments[name] for name in COUNTED}


def test_a_row_names_the_number_of_the_line_and_no_facing():
    context = Context(*SIZE)
    draw(context, gl.GL_LINE_STRIP, vertices([(-0.9, 0.1, 0, 1), (0, 0.1, 0, 1), (0.9, 0.1, 0, 1)]))
    context.end_step("lines")
    y = SIZE[1] // 2 - 1
    rows = [pixel_history(context.frame, x, y).rows for x in (2, SIZE[0] - 3)]
    assert [[(row.triangle, row.front_facing, row.verdict) for row in found] for found in rows] == [
        [(0, None, "passed")], [(1, None, "passed")]
    ]  # fmt: skip
    assert ledger_of(context.frame).total.triangles == 2


def test_a_row_of_an_outline_names_the_facing_of_its_polygon():
    context = Context(*SIZE)
    set_groups(context, polygon=replace(context.state.polygon, mode_front=gl.GL_LINE, mode_back=gl.GL_LINE))
    corners = [(-0.9, -0.9, 0, 1), (0.9, -0.9, 0, 1), (0.9, 0.9, 0, 1)]
    draw(context, gl.GL_TRIANGLES, vertices(corners[::-1]))
    context.end_step("outline")
    (row,) = pixel_history(context.frame, SIZE[0] // 2, SIZE[1] - 1).rows
    assert (row.triangle, row.front_facing) == (0, False)
