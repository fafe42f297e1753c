"""glMultiDrawArrays and glMultiDrawElements draw strips, fans and lines at once, with the pixels of single draws."""

import ctypes
from random import Random
from typing import Any

import numpy as np
import pytest

from gl.primitives_in_a_row import buffers_and_draws, set_where_order_matters
from softshadow import gl
from softshadow.gl import array_draws
from softshadow.inspection.validate_recording import validate_frame
from softshadow.pipeline import use_short_cuts
from softshadow.pipeline.commands import Draw

MODES = range(gl.GL_POINTS, gl.GL_POLYGON + 1)
SWITCHES = (gl.GL_CULL_FACE, gl.GL_LINE_STIPPLE, gl.GL_POLYGON_STIPPLE, gl.GL_CLIP_PLANE0, gl.GL_BLEND)
N = 30


def elements(random: Random, mode: int) -> None:
    """Draw a list of arrays, the rows of an array, or places in a buffer object."""
    width, what = random.choice((3, 4, 6)), random.randrange(3)
    rows = np.array([[random.randrange(N) for _ in range(width)] for _ in range(random.randint(1, 5))], np.uint16)
    counts, short = [width] * len(rows), gl.GL_UNSIGNED_SHORT
    if what == 0:
        counts = [random.choice((0, 2, 3, width)) if random.random() < 0.3 else width for _ in counts]
        gl.glMultiDrawElements(
            mode, counts, short, [row[:count] for row, count in zip(rows, counts, strict=True)], len(rows)
        )
    elif what == 1:
        gl.glMultiDrawElements(mode, np.array(counts, np.int32), short, rows, len(rows))
    else:
        gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, gl.glGenBuffers(1))
        gl.glBufferData(gl.GL_ELEMENT_ARRAY_BUFFER, rows, gl.GL_STATIC_DRAW)
        places = [ctypes.c_void_p(2 * width * row) for row in range(len(rows))]
        gl.glMultiDrawElements(mode, counts, short, places, len(rows))
        gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, 0)


def ranges(random: Random, mode: int) -> None:
    counts = [random.choice((1, 3, 4, 5, 8)) for _ in range(random.randint(1, 5))]
    firsts = [random.randrange(N - count) for count in counts]
    gl.glMultiDrawArrays(mode, firsts, counts, len(counts))


def drawn(seed: int) -> tuple[list[bytes], list[Draw]]:
    """Return the buffers that many draws under random states leave, and the draws."""
    random, rng = Random(seed), np.random.default_rng(seed)
    with gl.create_context(24, 18) as context:
        set_where_order_matters()
        for _ in range(6):
            random.choice((gl.glEnable, gl.glDisable))(random.choice(SWITCHES))
            if random.random() < 0.3:
                gl.glShadeModel(random.choice((gl.GL_FLAT, gl.GL_SMOOTH)))
            if random.random() < 0.2:
                gl.glProvokingVertex(random.choice((gl.GL_FIRST_VERTEX_CONVENTION, gl.GL_LAST_VERTEX_CONVENTION)))
            if random.random() < 0.3:
                faces = random.choice((gl.GL_FRONT, gl.GL_FRONT_AND_BACK, gl.GL_FRONT_AND_BACK))
                gl.glPolygonMode(faces, random.choice((gl.GL_FILL, gl.GL_LINE, gl.GL_POINT)))
            arrays = (
                (gl.GL_VERTEX_ARRAY, gl.glVertexPointer, 1.0),
                (gl.GL_COLOR_ARRAY, gl.glColorPointer, 0.5),
            )
            for array, point, probability in arrays:
                switch = gl.glEnableClientState if random.random() < probability else gl.glDisableClientState
                switch(array)
                point(3, gl.GL_FLOAT, 0, rng.uniform(-1.3, 1.3, (N, 3)).astype(np.float32))
            gl.glColor3f(random.random(), random.random(), random.random())
            if random.random() < 0.1:
                gl.glEdgeFlag(random.random() < 0.5)
            random.choice((elements, ranges))(random, random.choice(MODES))
        buffers, draws = buffers_and_draws(context)
        validate_frame(context.frame)
        return buffers, draws


@pytest.mark.parametrize("seeds", [range(start, start + 25) for start in range(0, 150, 25)], ids=str)
def test_draws_at_once_have_the_pixels_of_single_ones(seeds: range, monkeypatch: pytest.MonkeyPatch) -> None:
    at_once = {seed: drawn(seed) for seed in seeds}
    assert sum(bool(draw.pairs_mode) for _, draws in at_once.values() for draw in draws) > len(seeds) / 2
    with use_short_cuts(False):
        assert {seed: drawn(seed)[0] for seed in seeds[:8]} == {seed: at_once[seed][0] for seed in seeds[:8]}
    monkeypatch.setattr(array_draws, "_may_be_one", lambda *_: False)
    for seed in seeds:
        buffers, draws = drawn(seed)
        assert not any(draw.pairs_mode for draw in draws)
        assert buffers == at_once[seed][0], seed


@pytest.fixture
def draws() -> Any:
    """A context with an array of positions, of which this returns the draws."""
    with gl.create_context(8, 8) as context:
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.zeros((1000, 3), np.float32))
        yield lambda: [command for command in context.frame.commands if isinstance(command, Draw)]


STRIPS = np.array([[0, 1, 2, 3], [4, 5, 6, 7]], np.uint16)


def test_strips_far_from_each_other_are_drawn_one_by_one(draws: Any) -> None:
    """Else all vertices between them would be processed."""
    strips = [STRIPS[0], STRIPS[0] + np.uint16(900)]
    gl.glMultiDrawElements(gl.GL_TRIANGLE_STRIP, [4, 4], gl.GL_UNSIGNED_SHORT, strips, 2)
    gl.glMultiDrawArrays(gl.GL_LINE_STRIP, [0, 900], [4, 4], 2)
    assert [(draw.mode, len(draw.vertices.position)) for draw in draws()] == [
        *2 * [(gl.GL_TRIANGLE_STRIP, 4)],
        *2 * [(gl.GL_LINE_STRIP, 4)],
    ]


def test_an_index_outside_of_the_arrays_draws_nothing(draws: Any) -> None:
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.zeros((8, 3), np.float32))
    wrong = STRIPS.copy()
    wrong[1, 3] = 8
    with pytest.raises(ValueError, match="vertex 8 is outside the array of positions, which has 8"):
        gl.glMultiDrawElements(gl.GL_TRIANGLE_STRIP, [4, 4], gl.GL_UNSIGNED_SHORT, wrong, 2)
    with pytest.raises(ValueError, match="vertex 8 is outside the array of positions, which has 8"):
        gl.glMultiDrawArrays(gl.GL_LINE_STRIP, [0, 5], [4, 4], 2)
    with pytest.raises(ValueError, match="first=-1: expected 0 or more"):
        gl.glMultiDrawArrays(gl.GL_LINE_STRIP, [-1, 3], [4, 4], 2)
    assert draws() == []


def test_the_same_strips_have_the_same_indices(draws: Any) -> None:
    """What is derived from the same arrays is found again; changed ones are read anew."""
    strips = STRIPS.copy()
    for _ in range(2):
        gl.glMultiDrawElements(gl.GL_TRIANGLE_STRIP, [4, 4], gl.GL_UNSIGNED_SHORT, strips, 2)
        gl.glMultiDrawArrays(gl.GL_LINE_LOOP, [0, 4], [4, 4], 2)
    strips[1] += 1
    gl.glMultiDrawElements(gl.GL_TRIANGLE_STRIP, [4, 4], gl.GL_UNSIGNED_SHORT, strips, 2)
    one, loops, again, loops_again, changed = [draw.indices for draw in draws()]
    assert one is again
    assert loops is loops_again
    assert changed.tolist() == [0, 1, 2, 2, 1, 3, 5, 6, 7, 7, 6, 8]
