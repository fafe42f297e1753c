"""Strips of a shape, whatever their modes, become one draw of separate triangles, with the pixels of single strips."""

from collections.abc import Callable
from random import Random
from typing import Any

import numpy as np
import pytest

from gl.primitives_in_a_row import buffers_and_draws, set_where_order_matters
from gl.shape_writer import ShapeWriter
from softshadow import gl
from softshadow.gl import list_primitives, similar_pairs
from softshadow.gl.shape_calls import Calls
from softshadow.pipeline import use_short_cuts
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch.assembly import assemble_draws
from softshadow.pipeline.fast.batch.vertices import (
    ACROSS,
    END,
    IN_STAGES,
    INDEX_END,
    INDEX_START,
    INDEXED,
    JOINED_STRIPS,
    MODE,
    NUMBERS,
    START,
)
from softshadow.pipeline.geometry.assembly import assemble, order_of_joined_strips
from softshadow.pipeline.geometry.separate import STRIPS, separate_indices
from softshadow.pipeline.mesa.segments import SEGMENT, in_clipped_segment

MODES = tuple(sorted(STRIPS))
SWITCHES = (
    gl.GL_CULL_FACE,
    gl.GL_LIGHTING,
    gl.GL_COLOR_MATERIAL,
    gl.GL_CLIP_PLANE0,
    gl.GL_BLEND,
    gl.GL_POLYGON_STIPPLE,
)


def random_shape(random: Random) -> Calls:
    """Return strips of several modes, many of them folded and clipped; some begin with the normal set before them.

    Some vertices are there several times: a display list keeps them once.
    """
    with_normals, late_often = random.random() < 0.8, random.choice((0.0, 0.4))
    calls, points = ShapeWriter(), [[random.uniform(-1.6, 1.6) for _ in range(3)] for _ in range(4)]
    for _ in range(random.randint(1, 6)):
        if random.random() < 0.5:
            calls.normal(*[random.uniform(-1.0, 1.0) for _ in range(3)])
        calls.begin(random.choice(MODES))
        late = random.random() < late_often
        reach = random.choice((0.9, 1.6))
        for vertex in range(random.choice((4, 6, 6, 8, 9, 12, 12))):
            if with_normals and (vertex or not late):
                calls.normal(*[random.uniform(-1.0, 1.0) for _ in range(3)])
            repeats = random.random() < 0.2
            calls.vertex(*(random.choice(points) if repeats else [random.uniform(-reach, reach) for _ in range(3)]))
        calls.end()
    return calls.calls


def make(shape: Calls) -> None:
    """Draw a shape by its calls."""
    shape.make()


def compile_and_call(shape: Calls) -> None:
    """Draw a shape by a display list."""
    gl.glNewList(1, gl.GL_COMPILE)
    shape.make()
    gl.glEndList()
    gl.glCallList(1)


def drawn(seed: int, draw: Callable[[Calls], None]) -> tuple[list[bytes], list[Draw]]:
    """Return the buffers that random shapes under random states leave, and their draws."""
    random = Random(seed)
    with gl.create_context(24, 18) as context:
        set_where_order_matters()
        gl.glEnable(gl.GL_LIGHT0)
        for _ in range(5):
            random.choice((gl.glEnable, gl.glDisable))(random.choice(SWITCHES))
            if random.random() < 0.4:
                gl.glShadeModel(random.choice((gl.GL_FLAT, gl.GL_SMOOTH)))
            if random.random() < 0.4:
                faces = random.choice((gl.GL_FRONT, gl.GL_FRONT_AND_BACK, gl.GL_FRONT_AND_BACK))
                gl.glPolygonMode(faces, random.choice((gl.GL_FILL, gl.GL_FILL, gl.GL_LINE, gl.GL_POINT)))
            gl.glColor3f(random.random(), random.random(), random.random())
            draw(random_shape(random))
        return buffers_and_draws(context)


@pytest.mark.parametrize("seeds", [range(start, start + 20) for start in range(0, 120, 20)], ids=str)
@pytest.mark.parametrize("draw", [make, compile_and_call])
def test_strips_of_a_shape_have_the_pixels_of_single_ones(
    seeds: range, draw: Callable[[Calls], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    joined = {seed: drawn(seed, draw) for seed in seeds}
    of_modes = [draw for _, draws in joined.values() for draw in draws if draw.pairs_mode == gl.GL_QUAD_STRIP]
    assert len(of_modes) > 4
    with use_short_cuts(False):
        assert {seed: drawn(seed, draw)[0] for seed in seeds[:5]} == {seed: joined[seed][0] for seed in seeds[:5]}
    monkeypatch.setattr(similar_pairs, "SEPARABLE", {})
    monkeypatch.setattr(similar_pairs, "STRIPS", frozenset())
    monkeypatch.setattr(list_primitives, "can_be_joined", lambda _: False)
    for seed in seeds:
        buffers, draws = drawn(seed, draw)
        assert not any(draw.pairs_mode for draw in draws)
        assert len(draws) >= len(joined[seed][1])
        assert buffers == joined[seed][0], seed


def folded_quads(n_vertices: int) -> bytes:
    """Return the depths that two quad strips in a list leave, whose last vertices are behind the far plane.

    Both triangles of a quad cover some pixels, at other depths: the one drawn last is seen. Mesa draws them the other
    way round if a vertex of the strip, or of 1,024 of a longer one, is outside; the last one of an odd number does not
    count.
    """
    positions = np.random.default_rng(n_vertices).uniform(-1.0, 1.0, (n_vertices, 3))
    positions[-1, 2] = 1.5
    with gl.create_context(12, 9) as context:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_ALWAYS)
        gl.glNewList(1, gl.GL_COMPILE)
        for strip in range(2):
            gl.glBegin(gl.GL_QUAD_STRIP)
            for x, y, z in positions.tolist():
                gl.glVertex3f(0.5 * x + strip - 0.5, y, z)
            gl.glEnd()
        gl.glEndList()
        gl.glCallList(1)
        gl.glFinish()
        assert context.storage.window.depth is not None
        return context.storage.window.depth.view.tobytes()


@pytest.mark.parametrize("n_vertices", [5, 6, 13, 14, 1025, 1026, 1027, 1028])
def test_quads_of_a_list_are_cut_as_those_of_single_strips(n_vertices: int, monkeypatch: pytest.MonkeyPatch) -> None:
    at_once = folded_quads(n_vertices)
    assert len(set(at_once)) > 8
    monkeypatch.setattr(list_primitives, "can_be_joined", lambda _: False)
    assert folded_quads(n_vertices) == at_once


def kernel_triangles(indices: np.ndarray, needs_clipping: np.ndarray, across: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the triangles of joined strips behind two vertices of another draw, and their provoking vertices."""
    numbers = np.zeros((1, NUMBERS), np.int64)
    numbers[0, [START, END, INDEX_START, INDEX_END]] = 2, 2 + len(needs_clipping), 1, 1 + len(indices)
    numbers[0, [MODE, INDEXED, ACROSS]] = JOINED_STRIPS, 1, across
    codes = np.concatenate([np.zeros(2, bool), needs_clipping]).astype(np.int32)
    triangles, provoking = np.empty((len(indices) // 3, 3), np.int32), np.empty(len(indices) // 3, np.int32)
    before = np.concatenate([np.array([7], np.int32), indices])
    assert assemble_draws(numbers, before, codes, triangles, provoking) == len(triangles)
    return triangles - 2, provoking - 2


@pytest.mark.parametrize("in_stages", [False, True])
@pytest.mark.parametrize("seed", range(12))
def test_triangles_are_those_of_each_strip_in_their_order(seed: int, in_stages: bool) -> None:
    random, rng = Random(seed), np.random.default_rng(seed)
    modes = (*random.choices(MODES, k=8), gl.GL_QUAD_STRIP)
    counts = (*random.choices((0, 2, 3, 4, 5, 6, 7, 8, 13), k=8), 2 * SEGMENT + 9)
    needs_clipping = rng.random(sum(counts)) < (0.0, 0.0002, 0.05)[seed % 3]
    corners, provoking, start = [], [], 0
    for mode, count in zip(modes, counts, strict=True):
        clipped = (
            in_clipped_segment(mode, needs_clipping[start : start + count], None) if mode == gl.GL_QUAD_STRIP else None
        )
        strip = assemble(mode, count, np.ones_like(clipped) if in_stages and clipped is not None else clipped)
        corners.append(strip.corners + start)
        provoking.append(strip.provoking + start)
        start += count
    expected: Any = np.concatenate(corners), np.concatenate(provoking)
    indices = separate_indices(modes, counts)
    separate = indices.reshape(-1, 3)
    ordered = separate[order_of_joined_strips(separate, needs_clipping, in_stages)]
    np.testing.assert_array_equal(ordered, expected[0])
    np.testing.assert_array_equal(ordered[:, 2], expected[1])  # the last corner provokes
    ours = kernel_triangles(indices, needs_clipping, IN_STAGES if in_stages else 1)
    np.testing.assert_array_equal(ours[0], expected[0])
    np.testing.assert_array_equal(ours[1], expected[1])
