"""Draws that wait and are processed together leave the bits of draws carried out one by one."""

from functools import partial

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from softshadow import gl
from softshadow.context import Context
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline import plan, queue, set_threads, threads, use_short_cuts
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch import geometry
from softshadow.pipeline.fast.batch.geometry import Batch, Setting
from softshadow.pipeline.fast.batch.matrices import invert
from softshadow.pipeline.fast.batch.run import Run
from softshadow.pipeline.geometry.geometry import process_geometry
from softshadow.pipeline.memory import threads as pool
from softshadow.programs import inverse

SIZE = 32
MODES = (
    gl.GL_TRIANGLES, gl.GL_TRIANGLE_STRIP, gl.GL_TRIANGLE_FAN, gl.GL_QUADS, gl.GL_QUAD_STRIP, gl.GL_POLYGON,
    gl.GL_LINES, gl.GL_LINE_STRIP, gl.GL_LINE_LOOP, gl.GL_POINTS,
)  # fmt: skip
seeds = st.integers(0, 2**32 - 1)


class Program:
    """A random program: a few states, and under each of them draws that differ in what a run allows."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.environment = np.random.default_rng([seed, 1])  # of its own: seeds of examples keep their programs
        self.mode = self.one_of(*MODES)

    def draw(self, states: int = 3, draws: int = 5, *, changes_tests: bool = False) -> Context:
        """Carry the program out in a new context; `changes_tests`: before each draw, what concerns fragments only."""
        context = gl.create_context(SIZE, SIZE, depth_format=str(self.rng.choice(["d24", "d32f"])))
        self.make_textures()
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
        for _ in range(states):
            self.set_state()
            self.set_lighting()
            self.set_textures()
            for _ in range(draws):
                if changes_tests:
                    self.set_tests()
                self.set_matrices()
                self.draw_something()
        gl.glFinish()
        return context

    def chance(self, p: float = 0.5) -> bool:
        return bool(self.rng.random() < p)

    def switch(self, cap: int, p: float = 0.5) -> None:
        (gl.glEnable if self.chance(p) else gl.glDisable)(cap)

    def one_of(self, *values: int) -> int:
        return int(self.rng.choice(values))

    def numbers(self, n: int, low: float = -1, high: float = 1) -> list[float]:
        return self.rng.uniform(low, high, n).tolist()

    def make_textures(self) -> None:
        for texture, size in enumerate((8, 4, 8), 1):
            gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)
            image = self.rng.integers(0, 256, (size, size, 4), np.uint8)
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, size, size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)

    def set_state(self) -> None:
        for cap, p in (
            (gl.GL_DEPTH_TEST, 0.7), (gl.GL_CULL_FACE, 0.2), (gl.GL_BLEND, 0.3), (gl.GL_STENCIL_TEST, 0.3),
            (gl.GL_FOG, 0.3), (gl.GL_ALPHA_TEST, 0.2), (gl.GL_POLYGON_OFFSET_FILL, 0.2), (gl.GL_DEPTH_CLAMP, 0.1),
            (gl.GL_CLIP_PLANE0, 0.2), (gl.GL_CLIP_PLANE3, 0.1),
        ):  # fmt: skip
            self.switch(cap, p)
        for plane in (gl.GL_CLIP_PLANE0, gl.GL_CLIP_PLANE3):
            gl.glClipPlane(plane, self.numbers(4))
        gl.glBlendFunc(self.one_of(gl.GL_ONE, gl.GL_SRC_ALPHA), self.one_of(gl.GL_ONE, gl.GL_ONE_MINUS_SRC_ALPHA))
        gl.glStencilFunc(self.one_of(gl.GL_ALWAYS, gl.GL_EQUAL), self.one_of(0, 1), 255)
        gl.glStencilOp(gl.GL_KEEP, self.one_of(gl.GL_KEEP, gl.GL_INVERT), self.one_of(gl.GL_INCR, gl.GL_DECR_WRAP))
        gl.glAlphaFunc(gl.GL_GREATER, 0.4)
        gl.glLineWidth(self.one_of(1, 1, 2, 5))
        gl.glPointSize(self.one_of(1, 2, 3))
        gl.glPolygonOffset(*self.numbers(2, -2, 2))
        mode = self.one_of(gl.GL_LINE, gl.GL_POINT) if self.chance(0.3) else gl.GL_FILL
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, mode)
        if self.chance(0.1):
            gl.glPolygonMode(gl.GL_BACK, self.one_of(gl.GL_LINE, gl.GL_POINT, gl.GL_FILL))
        for cap in (gl.GL_POLYGON_OFFSET_LINE, gl.GL_POLYGON_OFFSET_POINT):
            self.switch(cap, 0.2)
        for cap in (
            gl.GL_LINE_SMOOTH, gl.GL_POINT_SMOOTH, gl.GL_LINE_STIPPLE, gl.GL_POLYGON_STIPPLE, gl.GL_POINT_SPRITE,
        ):  # fmt: skip
            self.switch(cap, 0.1)
        gl.glTexEnvi(gl.GL_POINT_SPRITE, gl.GL_COORD_REPLACE, self.chance())
        gl.glPointParameteri(gl.GL_POINT_SPRITE_COORD_ORIGIN, self.one_of(gl.GL_UPPER_LEFT, gl.GL_LOWER_LEFT))
        gl.glPointParameterfv(gl.GL_POINT_DISTANCE_ATTENUATION, [1.0, 0.2 * self.chance(0.2), 0.0])
        gl.glLineStipple(2, 0x3B5D)
        gl.glPolygonStipple(self.rng.bytes(128))
        gl.glFogi(gl.GL_FOG_MODE, self.one_of(gl.GL_LINEAR, gl.GL_EXP))
        gl.glFogi(gl.GL_FOG_COORD_SRC, int(self.environment.choice((gl.GL_FRAGMENT_DEPTH, gl.GL_FOG_COORD))))
        (gl.glEnable if self.environment.random() < 0.3 else gl.glDisable)(gl.GL_COLOR_SUM)
        gl.glColorMask(*[self.chance(0.9)] * 4)

    def set_tests(self) -> None:
        """Change a few of the settings that many small draws of ordinary programs change in between."""
        kind = int(self.rng.integers(10))
        if kind == 0:
            self.switch(gl.GL_SCISSOR_TEST)
            gl.glScissor(*self.rng.integers(0, SIZE, 4).tolist())
        elif kind == 1:
            self.switch(gl.GL_BLEND)
            gl.glBlendFunc(self.one_of(gl.GL_ONE, gl.GL_SRC_ALPHA), self.one_of(gl.GL_ONE, gl.GL_ZERO))
        elif kind == 2:
            self.switch(gl.GL_STENCIL_TEST)
            gl.glStencilFunc(gl.GL_NOTEQUAL, self.one_of(0, 1, 2), 255)
        elif kind == 3:
            gl.glDepthMask(self.chance())
        elif kind == 4:
            gl.glColorMask(*[self.chance(0.7)] * 4)
        elif kind == 5:
            self.switch(gl.GL_ALPHA_TEST, 0.3)
            self.switch(gl.GL_DEPTH_CLAMP, 0.3)
        elif kind == 6:
            gl.glBindTexture(gl.GL_TEXTURE_2D, self.one_of(0, *range(1, 4)))
            self.switch(gl.GL_TEXTURE_2D)
        elif kind == 7:
            self.switch(gl.GL_LIGHTING)
        elif kind == 8:
            gl.glPointSize(self.rng.uniform(0.1, 6))
            gl.glLineWidth(self.environment.uniform(0.1, 6))
        else:
            gl.glViewport(*self.rng.integers(-4, SIZE, 2).tolist(), *self.rng.integers(1, SIZE, 2).tolist())
            gl.glDepthRange(*self.rng.random(2).tolist())

    def set_lighting(self) -> None:
        self.switch(gl.GL_LIGHTING, 0.7)
        for cap in (gl.GL_NORMALIZE, gl.GL_RESCALE_NORMAL, gl.GL_COLOR_MATERIAL):
            self.switch(cap)
        gl.glColorMaterial(
            self.one_of(gl.GL_FRONT, gl.GL_BACK, gl.GL_FRONT_AND_BACK),
            self.one_of(gl.GL_AMBIENT_AND_DIFFUSE, gl.GL_SPECULAR, gl.GL_EMISSION, gl.GL_DIFFUSE),
        )
        gl.glShadeModel(gl.GL_SMOOTH if self.chance(0.8) else gl.GL_FLAT)
        for parameter in (gl.GL_LIGHT_MODEL_LOCAL_VIEWER, gl.GL_LIGHT_MODEL_TWO_SIDE):
            gl.glLightModeli(parameter, int(self.chance(0.3)))
        separate = gl.GL_SEPARATE_SPECULAR_COLOR if self.chance(0.3) else gl.GL_SINGLE_COLOR
        gl.glLightModeli(gl.GL_LIGHT_MODEL_COLOR_CONTROL, separate)
        for light in range(3):
            self.set_light(gl.GL_LIGHT0 + light)

    def set_light(self, light: int) -> None:
        self.switch(light)
        for parameter in (gl.GL_AMBIENT, gl.GL_DIFFUSE, gl.GL_SPECULAR):
            gl.glLightfv(light, parameter, self.numbers(4, 0))
        gl.glLightfv(light, gl.GL_POSITION, [*self.numbers(3, -2, 2), self.one_of(0, 0, 1, 2)])
        gl.glLightfv(light, gl.GL_SPOT_DIRECTION, self.numbers(3))
        gl.glLightf(light, gl.GL_SPOT_CUTOFF, self.one_of(180, 180, 80, 30))
        gl.glLightf(light, gl.GL_SPOT_EXPONENT, self.one_of(0, 1, 7))
        for parameter, low in ((gl.GL_CONSTANT_ATTENUATION, 1), (gl.GL_LINEAR_ATTENUATION, 0)):
            gl.glLightf(light, parameter, low if self.chance() else 0.7)

    def set_textures(self) -> None:
        self.switch(gl.GL_TEXTURE_2D, 0.4)
        caps = {gl.GL_S: gl.GL_TEXTURE_GEN_S, gl.GL_T: gl.GL_TEXTURE_GEN_T, gl.GL_R: gl.GL_TEXTURE_GEN_R}
        for coordinate, cap in caps.items():
            self.switch(cap, 0.1 if coordinate == gl.GL_R else 0.4)
            maps = (
                gl.GL_REFLECTION_MAP,
                gl.GL_NORMAL_MAP,
                gl.GL_REFLECTION_MAP if coordinate == gl.GL_R else gl.GL_SPHERE_MAP,
            )
            gl.glTexGeni(coordinate, gl.GL_TEXTURE_GEN_MODE, self.one_of(gl.GL_OBJECT_LINEAR, gl.GL_EYE_LINEAR, *maps))
            gl.glTexGenfv(coordinate, gl.GL_EYE_PLANE, self.numbers(4))
            gl.glTexGenfv(coordinate, gl.GL_OBJECT_PLANE, self.numbers(4))
        self.set_environment()

    def set_environment(self) -> None:
        """Set the texture function; half of the combinations read the primary colour."""
        choose = self.environment.choice
        modes = gl.GL_MODULATE, gl.GL_MODULATE, gl.GL_REPLACE, gl.GL_COMBINE, gl.GL_COMBINE
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, int(choose(modes)))
        for function in (gl.GL_COMBINE_RGB, gl.GL_COMBINE_ALPHA):
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, function, int(choose((gl.GL_MODULATE, gl.GL_ADD_SIGNED, gl.GL_REPLACE))))
        for source in (gl.GL_SRC0_RGB, gl.GL_SRC1_RGB, gl.GL_SRC0_ALPHA, gl.GL_SRC1_ALPHA):
            sources = gl.GL_TEXTURE, gl.GL_PREVIOUS, gl.GL_PRIMARY_COLOR, gl.GL_CONSTANT
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, source, int(choose(sources)))

    def set_matrices(self) -> None:
        if self.chance(0.7):
            gl.glMatrixMode(gl.GL_PROJECTION)
            gl.glLoadIdentity()
            gl.gluPerspective(60, 1, 0.5, 10)
            gl.glMatrixMode(gl.GL_MODELVIEW)
            gl.glLoadIdentity()
            gl.glTranslatef(0, 0, -2.5)
        if self.chance():
            gl.glRotatef(*self.numbers(1, -180, 180), *self.numbers(3))
        if self.chance(0.4):
            gl.glScalef(*([1.5] * 3 if self.chance() else self.numbers(3, 0.3, 2)))
        if self.chance(0.1):
            gl.glMultMatrixf(self.numbers(16))
        if self.chance(0.2):
            gl.glMatrixMode(gl.GL_TEXTURE)
            gl.glTranslatef(*self.numbers(3))
            gl.glMatrixMode(gl.GL_MODELVIEW)

    def set_secondary(self) -> None:
        """Set the secondary colour and the fog coordinate, or one of them, or none."""
        if self.environment.random() < 0.2:
            gl.glSecondaryColor3f(*self.environment.uniform(-0.5, 1.5, 3).tolist())
        if self.environment.random() < 0.2:
            gl.glFogCoordf(self.environment.uniform(-1, 1))

    def set_material(self) -> None:
        """Set a parameter of a material, as between two vertices."""
        choose = self.environment.choice
        side = int(choose((gl.GL_FRONT, gl.GL_FRONT, gl.GL_BACK, gl.GL_FRONT_AND_BACK)))
        if self.environment.random() < 0.3:
            gl.glMaterialf(side, gl.GL_SHININESS, int(choose((0, 0, 7, 100))))
            return
        colors = gl.GL_AMBIENT, gl.GL_DIFFUSE, gl.GL_SPECULAR, gl.GL_EMISSION, gl.GL_AMBIENT_AND_DIFFUSE
        gl.glMaterialfv(side, int(choose(colors)), self.environment.random(4).tolist())

    def draw_something(self) -> None:
        gl.glColor4f(*self.numbers(4, 0))
        gl.glNormal3f(*self.numbers(3))
        self.set_secondary()
        if self.chance(0.2):
            side = self.one_of(gl.GL_FRONT, gl.GL_BACK, gl.GL_FRONT_AND_BACK)
            gl.glMaterialfv(side, self.one_of(gl.GL_SPECULAR, gl.GL_DIFFUSE), self.numbers(4, 0))
            gl.glMaterialf(side, gl.GL_SHININESS, self.one_of(0, 5, 100))
        if self.chance(0.4):
            self.mode = self.one_of(*MODES)
        mode, n = self.mode, int(self.rng.integers(0, 14))
        if self.chance(0.3):
            materials = self.environment.random() < 0.5
            gl.glBegin(mode)
            for _ in range(n):
                gl.glTexCoord2f(*self.numbers(2))
                self.set_secondary()
                if materials and self.environment.random() < 0.5:
                    self.set_material()
                gl.glVertex3f(*self.numbers(3))
            gl.glEnd()
            return
        arrays = (
            (gl.GL_COLOR_ARRAY, gl.glColorPointer, 4, (4, gl.GL_FLOAT, 0), 0.3),
            (gl.GL_NORMAL_ARRAY, gl.glNormalPointer, 3, (gl.GL_FLOAT, 0), 0.7),
            (gl.GL_TEXTURE_COORD_ARRAY, gl.glTexCoordPointer, 2, (2, gl.GL_FLOAT, 0), 0.5),
            (gl.GL_VERTEX_ARRAY, gl.glVertexPointer, 3, (3, gl.GL_FLOAT, 0), 1),
        )
        for array, point, width, arguments, p in arrays:
            gl.glDisableClientState(array)
            if self.chance(p):
                gl.glEnableClientState(array)
                point(*arguments, np.array(self.numbers(16 * width), np.float32).reshape(-1, width))
        for array, point, width in (
            (gl.GL_SECONDARY_COLOR_ARRAY, partial(gl.glSecondaryColorPointer, 3), 3),
            (gl.GL_FOG_COORD_ARRAY, gl.glFogCoordPointer, 1),
        ):
            gl.glDisableClientState(array)
            if self.environment.random() < 0.3:
                gl.glEnableClientState(array)
                point(gl.GL_FLOAT, 0, self.environment.uniform(-0.5, 1.5, (16, width)).astype(np.float32))
        if self.chance():
            indices = self.rng.integers(0, 16, n).astype(np.uint32)
            gl.glDrawElements(mode, n, gl.GL_UNSIGNED_INT, indices)
        else:
            gl.glDrawArrays(mode, 0, n)


def same_buffers(a: Context, b: Context) -> bool:
    """Return whether colour, depth and stencil of two windows are equal, bit for bit."""
    pairs = zip(a.storage.window.attachments.values(), b.storage.window.attachments.values(), strict=True)
    return all(one.image.view.tobytes() == other.image.view.tobytes() for one, other in pairs)


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

    context, geometry_of = gl.create_context(SIZE, SIZE), queue.geometry_of
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
        patch.setattr(queue, "geometry_of", compared)
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
        patch.setattr(geometry, "VERTICES_PER_TASK", 5)
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
