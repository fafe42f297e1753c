"""Draws that wait and are processed together leave the bits of draws carried out one by one."""

from functools import partial

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from pipeline.fast.random_draws import SIZE, Program, same_buffers
from softshadow import gl
from softshadow.context import Context, late_commands
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline import execute_waiting, plan, queue, set_threads, threads, use_short_cuts
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch import geometry, vertex_stage
from softshadow.pipeline.fast.batch.geometry import Batch, Setting
from softshadow.pipeline.fast.batch.matrices import invert
from softshadow.pipeline.fast.batch.planes import planes_of
from softshadow.pipeline.fast.batch.run import Run
from softshadow.pipeline.geometry.clip_planes import user_planes
from softshadow.pipeline.geometry.geometry import process_geometry
from softshadow.pipeline.memory import threads as pool
from softshadow.programs import inverse

seeds = st.integers(0, 2**32 - 1)
OF_OBJECTS = gl.GL_DEPTH_TEST, gl.GL_BLEND, gl.GL_LIGHTING, gl.GL_CULL_FACE, gl.GL_TEXTURE_2D, gl.GL_COLOR_MATERIAL


@given(seeds)
def test_runs_of_draws_leave_the_bits_of_single_draws(seed):
    with use_short_cuts(False):
        expected = Program(seed).draw()
    assert same_buffers(Program(seed).draw(), expected)


@given(seeds)
def test_segments_of_a_batch_leave_the_bits_of_single_draws(seed):
    with use_short_cuts(False):
        expected = Program(seed).draw(2, 16, changes_tests=True)
    assert same_buffers(Program(seed).draw(2, 16, changes_tests=True), expected)


def draw_objects(seed: int) -> Context:
    """Draw shapes of a few modes in turn, most of them under a matrix of their own; few calls change the state."""
    random = np.random.default_rng(seed)
    modes = random.choice(10, random.choice((1, 2, 3)), replace=False).tolist()
    states = [
        *((call, state) for state in OF_OBJECTS for call in (gl.glEnable, gl.glDisable)), (gl.glLoadIdentity,),
        *((gl.glPolygonMode, gl.GL_FRONT_AND_BACK, mode) for mode in (gl.GL_LINE, gl.GL_FILL)), (gl.glLineWidth, 2),
        (gl.glRectf, -0.5, -0.25, 0.5, 0.5), (gl.glNormal3f, 0, 0, -1), (gl.glTexCoord2f, 0.5, 0.25),
    ]  # fmt: skip
    listed, is_colored = random.random() < 0.3, random.random() < 0.5
    with gl.create_context(32, 32) as context:
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 2, 2, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, np.arange(16) * 16)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
        if listed:
            gl.glNewList(1, gl.GL_COMPILE)
            for _ in range(random.choice((1, 3))):
                gl.glBegin(modes[0])
                for corner in random.uniform(-1.2, 1.2, (6, 3)):
                    gl.glVertex3f(*corner)
                gl.glEnd()
            gl.glEndList()
        for number in range(40):
            if random.random() < 0.06:
                call, *arguments = states[random.integers(len(states))]
                call(*arguments)
            if random.random() < 0.7:
                gl.glTranslatef(*random.uniform(-0.2, 0.2, 3))
            if is_colored:
                gl.glColor3f(*random.random(3))
            if listed:
                gl.glCallList(1)
                continue
            gl.glBegin(modes[number % len(modes)])
            for corner in random.uniform(-1.2, 1.2, (random.choice((4, 4, 4, 6, 9)), 3)):
                gl.glVertex3f(*corner)
            gl.glEnd()
        gl.glFinish()
    return context


@given(seeds)
def test_objects_under_matrices_leave_the_bits_of_single_draws(seed):
    with use_short_cuts(False):
        expected = draw_objects(seed)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(late_commands, "MANY", 2)  # else few draws are alike
        assert same_buffers(draw_objects(seed), expected)


@pytest.mark.parametrize("n_strips", [1, 2, 8])
@pytest.mark.parametrize("is_lit", [False, True])
def test_lists_of_quad_strips_under_matrices_leave_the_bits_of_single_draws(n_strips, is_lit):
    def draw() -> Context:
        random = np.random.default_rng(n_strips)
        with gl.create_context(32, 32) as context:
            for switch in (gl.GL_BLEND, gl.GL_LIGHT0, gl.GL_COLOR_MATERIAL, *[gl.GL_LIGHTING] * is_lit):
                gl.glEnable(switch)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
            gl.glNewList(1, gl.GL_COMPILE)
            for _ in range(n_strips):
                gl.glBegin(gl.GL_QUAD_STRIP)
                for corner in random.uniform(-1.5, 1.5, (6, 3)):  # clipped, which changes how quads are cut
                    gl.glNormal3f(*random.uniform(-1, 1, 3))
                    gl.glVertex3f(*corner)
                gl.glEnd()
            gl.glEndList()
            for _ in range(2 * late_commands.MANY):
                gl.glTranslatef(*random.uniform(-0.2, 0.2, 3))
                gl.glColor4f(*random.random(4))
                gl.glCallList(1)
            gl.glFinish()
        return context

    with use_short_cuts(False):
        expected = draw()
    assert same_buffers(draw(), expected)


class CountedProgram(Program):
    """A random program that counts the fragments of most of its draws, one or two at a time, in three queries."""

    def __init__(self, seed: int) -> None:
        super().__init__(seed)
        self.counted: list[int] = []

    def draw_something(self) -> None:
        if self.chance(0.3):
            super().draw_something()
            return
        query = int(self.rng.integers(1, 4))
        gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
        for _ in range(1 + self.chance()):
            super().draw_something()
        gl.glEndQuery(gl.GL_SAMPLES_PASSED)
        if self.chance(0.3):
            self.counted.append(int(gl.glGetQueryObjectuiv(query, gl.GL_QUERY_RESULT)))


@given(seeds)
@example(33)  # smooth points are on, and polygons pass Mesa's stages
def test_queries_count_the_fragments_of_draws_that_wait(seed):
    one, other = CountedProgram(seed), CountedProgram(seed)
    with use_short_cuts(False):
        expected = one.draw()
    context = other.draw()
    assert same_buffers(context, expected)
    assert other.counted == one.counted
    assert context.storage.queries == expected.storage.queries


@pytest.mark.parametrize("mode", [gl.GL_POINTS, gl.GL_LINES, gl.GL_TRIANGLES])
def test_sprites_replace_the_coordinates_of_all_primitives(mode):
    def draw() -> Context:
        context = gl.create_context(SIZE, SIZE)
        texels = np.random.default_rng(1).integers(0, 256, (8, 8, 4), np.uint8)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 8, 8, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        for cap in (gl.GL_TEXTURE_2D, gl.GL_POINT_SPRITE):
            gl.glEnable(cap)
        gl.glTexEnvi(gl.GL_POINT_SPRITE, gl.GL_COORD_REPLACE, True)
        gl.glPointSize(9)
        for n in range(4):
            gl.glBegin(mode)
            for x, y in ((-1, -1), (0, -1), (-0.5, 0)):
                gl.glTexCoord2f(x, y)
                gl.glVertex2f(x + n % 2, y + n // 2)
            gl.glEnd()
        gl.glFinish()
        return context

    with use_short_cuts(False):
        expected = draw()
    assert same_buffers(draw(), expected)


@pytest.mark.interpreted
@pytest.mark.parametrize("shade_model", [gl.GL_FLAT, gl.GL_SMOOTH])
@pytest.mark.parametrize("varies", [False, True])
def test_a_combined_primary_color_is_interpolated_and_decides_how_quads_are_cut(shade_model, varies):
    def draw() -> Context:
        rng = np.random.default_rng(4)
        context = gl.create_context(SIZE, SIZE)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        texels = rng.integers(0, 256, (8, 8, 4), np.uint8)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 8, 8, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_SRC1_RGB, gl.GL_PRIMARY_COLOR)
        gl.glShadeModel(shade_model)
        gl.glColor4f(0.9, 0.3, 0.6, 1.2)
        for x in (-1, 0):
            gl.glBegin(gl.GL_QUADS)
            for across, up in ((0, -1), (1, -1), (1, 1), (0, 1)):
                if varies:
                    gl.glColor4f(*rng.random(4))
                gl.glTexCoord2f(*rng.random(2))
                gl.glVertex3f(x + across, up, rng.uniform(-1, 1))
            gl.glEnd()
            gl.glTranslatef(0, 0.1, 0)
        gl.glFinish()
        return context

    with use_short_cuts(False):
        expected = draw()
    assert same_buffers(draw(), expected)


@pytest.mark.interpreted
@pytest.mark.parametrize("seed", range(16))
def test_short_programs_leave_the_bits_of_single_draws(seed):
    with use_short_cuts(False):
        expected = Program(seed).draw(states=1, draws=3)
    assert same_buffers(Program(seed).draw(states=1, draws=3), expected)


@given(seeds)
def test_a_lit_mesh_has_the_colours_of_the_textbook(seed):
    """The mesh has three blocks of `light_block`, the last one with fewer vertices."""
    geometries = []
    program, rng = Program(seed), np.random.default_rng(seed)

    def compared(run: Run, setting: Setting, draws: list[Draw], target: Framebuffer, storage: Storage) -> Batch:
        result = geometry_of(run, setting, draws, target, storage)
        geometries.append((result.geometry, process_geometry(draws[0], target, context.storage)))
        return result

    context, geometry_of = gl.create_context(SIZE, SIZE), execute_waiting.geometry_of
    program.set_lighting()
    gl.glEnable(gl.GL_LIGHTING)
    program.set_matrices()
    for array, point, width in (
        (gl.GL_VERTEX_ARRAY, partial(gl.glVertexPointer, 3), 3), (gl.GL_NORMAL_ARRAY, gl.glNormalPointer, 3),
        (gl.GL_COLOR_ARRAY, partial(gl.glColorPointer, 4), 4),
    ):  # fmt: skip
        if array == gl.GL_VERTEX_ARRAY or program.chance(0.8):
            gl.glEnableClientState(array)
            point(gl.GL_FLOAT, 0, rng.uniform(-1, 1, (150, width)).astype(np.float32))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(execute_waiting, "geometry_of", compared)
        if program.environment.random() < 0.5:
            gl.glDrawArrays(gl.GL_TRIANGLES, 0, 150)
        else:
            gl.glBegin(gl.GL_TRIANGLES)
            for vertex in range(150):
                if program.environment.random() < 0.1:
                    program.set_material()
                gl.glArrayElement(vertex)
            gl.glEnd()
        gl.glFinish()
    for ours, expected in geometries:
        np.testing.assert_array_equal(ours.values, expected.values)
        assert (ours.back is None) == (expected.back is None)
        if ours.back is not None:
            np.testing.assert_array_equal(ours.back, expected.back)


@pytest.mark.slow
@given(seeds)
def test_threads_and_small_runs_make_no_difference(seed):
    expected, before = Program(seed).draw(), threads()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pool, "PART_SIZE", 5)
        patch.setattr(queue, "MOST_DRAWS", 3)
        patch.setattr(geometry, "SMALL", 8)
        patch.setattr(vertex_stage, "VERTICES_PER_TASK", 5)
        set_threads(3)
        try:
            assert same_buffers(Program(seed).draw(), expected)
        finally:
            set_threads(before)


@given(seeds, st.sampled_from([1, 37]))
def test_the_cut_of_quads_depends_on_their_segment(seed, n_clipped):
    """Segments have 4096 vertices, 1024 with indices: a clipped vertex in one decides how its quads are cut."""

    def quads() -> Context:
        rng = np.random.default_rng(seed)
        context = gl.create_context(SIZE, SIZE)
        positions = rng.uniform(-0.9, 0.9, (6000, 3)).astype(np.float32)
        positions[rng.integers(0, 6000, n_clipped), 0] = 1.5
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glEnableClientState(gl.GL_COLOR_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, positions)
        gl.glColorPointer(4, gl.GL_FLOAT, 0, rng.random((6000, 4)).astype(np.float32))
        mode = gl.GL_QUADS if rng.random() < 0.5 else gl.GL_QUAD_STRIP
        gl.glDrawArrays(mode, 0, 6000)
        gl.glDrawElements(mode, 2500, gl.GL_UNSIGNED_INT, rng.integers(0, 6000, 2500).astype(np.uint32))
        return context

    with use_short_cuts(False):
        expected = quads()
    assert same_buffers(quads(), expected)


def test_the_planes_of_draws_are_those_of_single_draws(monkeypatch):
    waiting, geometry_of = [], execute_waiting.geometry_of
    monkeypatch.setattr(execute_waiting, "geometry_of", lambda run, setting, draws, *more: (
        waiting.append(draws), geometry_of(run, setting, draws, *more))[1])  # fmt: skip
    for seed in range(20):
        Program(seed).draw()
    n_rows = set()
    for draws in waiting:
        planes = planes_of(draws)
        n_rows.add(len(planes.rows))
        for draw, first, end in zip(draws, planes.firsts, planes.ends, strict=True):
            np.testing.assert_array_equal(planes.rows[first:end], user_planes(draw))
    assert {0, 1, 2, 3} <= n_rows


def test_a_long_run_is_cut(monkeypatch):
    monkeypatch.setattr(queue, "MOST_VERTICES", 10)
    context = gl.create_context(SIZE, SIZE)
    with use_short_cuts(False):
        expected = Program(3).draw()
    assert same_buffers(Program(3).draw(), expected)
    assert plan.MOST_VERTICES > 10
    assert not context.storage.active_query


@given(seeds, st.sampled_from(range(64)))
def test_inverses_are_those_of_the_textbook(seed, kind):
    rng = np.random.default_rng(seed)
    matrix = rng.choice(np.float32([0, 0, 0, 0, 1, 1, 1, -1, 0.5, 0.5, 3e-9, 7e8, np.nan]), (4, 4))
    matrix[rng.random((4, 4)) < 0.3] = np.float32(rng.normal())
    result = np.empty((4, 4), np.float32)
    with np.errstate(all="ignore"):
        invert(matrix, kind, result)
        expected = inverse.inverse(matrix, kind)
    np.testing.assert_array_equal(result, expected)
