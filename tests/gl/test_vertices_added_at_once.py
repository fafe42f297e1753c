"""Strips of shapes and of evaluators, whose vertices are added at once, give the draws of their single calls."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest

from gl.shape_writer import ShapeWriter, call_by_call
from softshadow import gl
from softshadow.context import vertex_buffer
from softshadow.gl import evaluators, pair_numbers
from softshadow.gl.shape_calls import Calls
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.draw_primitives import assembled_triangles, lines_or_points_of
from softshadow.pipeline.geometry.lines import LINES
from softshadow.pipeline.mesa.driver_draws import SEPARATE

MODES = gl.GL_QUAD_STRIP, gl.GL_TRIANGLE_FAN, gl.GL_TRIANGLE_STRIP, gl.GL_LINE_STRIP, gl.GL_POINTS, gl.GL_QUADS
ROUNDS = 60


@pytest.fixture(autouse=True)
def _pairs_are_drawn_one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """Strips that come from calls are draws of their own; those added at once become one draw."""
    monkeypatch.setattr(pair_numbers, "SEPARABLE", {})


def corners_of(command: Draw) -> np.ndarray:
    """Return the vertices (T, 3), (L, 2) or (P, 1) of the primitives of a draw that nothing cuts."""
    if command.mode == gl.GL_POINTS or command.mode in LINES:
        return lines_or_points_of(command)
    return assembled_triangles(command, np.zeros(len(command.vertices.position), bool)).corners


def draws_of(program: Callable[[], None]) -> list[Any]:
    """Return the attributes and the vertex buffer after a program, and what its draws draw.

    That is, of each draw or of several strips in a row under the same state, the corners of all primitives.
    """
    with gl.create_context(16, 12) as context:
        program()
        buffer = context.vertex_buffer
        collected = buffer.sizes.copy(), buffer.active_sizes.copy(), buffer.n_vertices, buffer.used_bytes, buffer.pairs
        commands = [command for command in context.frame.commands if isinstance(command, Draw)]
        current = tuple(
            gl.glGetFloatv(getattr(gl, f"GL_CURRENT_{name}")) for name in ("COLOR", "NORMAL", "TEXTURE_COORDS")
        )
    drawn: list[Any] = [tuple(np.asarray(value).tobytes() for value in current), (*collected, buffer.driver_draw)]
    last: tuple[Any, ...] = ()
    for command in commands:
        vertices, lighting, corners = command.vertices, command.state.lighting, corners_of(command)
        arrays = (vertices.position, vertices.color, vertices.normal, vertices.texcoords[0], vertices.edges)
        rows = [b"" if array is None else array[corners].tobytes() for array in arrays]
        places, width = (command.offset_mode, command.stipple_place), corners.shape[1]
        state = command.called_mode in SEPARATE, width, *places, lighting.color_material, lighting.front
        if state == last and command.called_mode not in SEPARATE:
            drawn[-1] = [before + each for before, each in zip(drawn[-1], rows, strict=True)]
        else:
            drawn += [state, rows]
        last = state
    return drawn


class RandomShapes:
    """Shapes of several strips between other calls, in a random order that depends on a seed."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        self.parts: list[Callable[[Any], None]] = [self._part(rng) for _ in range(30)]

    def _part(self, rng: np.random.Generator) -> Callable[[Any], None]:
        numbers = [float(np.float32(x)) for x in rng.uniform(-1, 1, 4)]
        kind = int(rng.integers(18))
        if kind == 0:
            color = numbers[:3] if numbers[3] > 0 else (1.0, 0.5, 0.0)  # the same one again
            return lambda draw: gl.glColor3f(*color)
        if kind == 1:
            return lambda draw: gl.glColor4f(*numbers)
        if kind == 2:
            return lambda draw: gl.glTexCoord3f(*numbers[:3])
        if kind == 3:
            return lambda draw: gl.glNormal3f(*numbers[:3])
        if kind == 4:
            return lambda draw: gl.glTranslatef(*numbers[:3])
        if kind == 5:
            switch = gl.glEnable if numbers[0] > 0 else gl.glDisable
            return lambda draw: switch(gl.GL_COLOR_MATERIAL if numbers[1] > 0 else gl.GL_LIGHTING)
        if kind == 6:
            return lambda draw: (
                gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, numbers),
                gl.glEnable(gl.GL_COLOR_MATERIAL),
            )
        if kind == 7 and numbers[0] > 0.5:
            return lambda draw: gl.glEdgeFlag(numbers[1] > 0)
        if kind == 8:
            switch = gl.glEnable if numbers[0] > 0 else gl.glDisable
            return lambda draw: switch(gl.GL_LINE_STIPPLE if numbers[1] > 0 else gl.GL_POLYGON_OFFSET_LINE)
        if kind == 9:
            face = gl.GL_FRONT if numbers[0] > 0 else gl.GL_BACK
            return lambda draw: gl.glPolygonMode(face, gl.GL_LINE if numbers[1] > 0 else gl.GL_FILL)
        if kind == 10 and numbers[0] > 0:
            return lambda draw: gl.glBitmap(8, 1, 0, 0, 9, 0, bytes([0x80]))
        if kind == 11:
            return partial(self._draw_none, int(rng.choice(MODES)))
        shape = self._shape(rng)
        return lambda draw: draw(shape)

    @staticmethod
    def _draw_none(mode: int, _: Callable[[Calls], None]) -> None:
        """Draw a pair without vertices: Mesa draws nothing of the strips of its mode that follow."""
        gl.glBegin(mode)
        gl.glEnd()

    def _shape(self, rng: np.random.Generator) -> Calls:
        calls, has_normals, has_coordinates = ShapeWriter(), rng.random() < 0.7, rng.random() < 0.4
        modes = MODES
        most = int(rng.choice([5, 8, 40]))  # after a few vertices, Mesa makes the next ones carry a colour set between
        is_run = rng.random() < 0.5  # of strips that are drawn together
        if is_run:
            modes = (int(rng.choice(modes)),)
        for _ in range(70 if is_run and rng.random() < 0.1 else int(rng.integers(1, 6))):
            if rng.random() < (0.05 if is_run else 0.3):
                calls.normal(*rng.normal(size=3).tolist())
            calls.begin(int(rng.choice(modes)))
            is_late = rng.random() < (0.1 if is_run else 0.3)  # attributes begin after the first vertex
            late = int(rng.integers(1, 4)) if is_late else 0
            for vertex in range(int(rng.integers(4 if is_run else 1, most))):
                if has_normals and vertex >= late and rng.random() < 0.9:
                    calls.normal(*rng.normal(size=3).tolist())
                if has_coordinates and vertex >= late:
                    calls.coordinates(*rng.normal(size=2).tolist())
                calls.vertex(*rng.normal(size=3).tolist())
            calls.end()
        return calls.calls

    def draw(self, draw: Callable[[Calls], None]) -> None:
        for part in self.parts:
            part(draw)


@pytest.mark.parametrize("n_bytes", [vertex_buffer.BYTES, 4096])
def test_shapes_give_the_draws_of_their_calls(n_bytes: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(vertex_buffer, "BYTES", n_bytes)
    for seed in range(ROUNDS):
        program = RandomShapes(seed)
        assert draws_of(partial(program.draw, Calls.make)) == draws_of(partial(program.draw, call_by_call)), seed


def test_a_shape_in_an_incomplete_framebuffer_draws_nothing() -> None:
    with gl.create_context(8, 8) as context:
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        quadric = gl.gluNewQuadric()
        with pytest.raises(gl.GLError, match="is not complete"):
            gl.gluSphere(quadric, 1, 8, 8)
    assert not [command for command in context.frame.commands if isinstance(command, Draw)]


def strips(count: int, length: int) -> Calls:
    calls = ShapeWriter()
    for strip in range(count):
        calls.begin(gl.GL_TRIANGLE_STRIP)
        for vertex in range(length):
            calls.normal(0.0, 0.0, float(vertex))
            calls.vertex(float(vertex), 0.0, float(strip))
        calls.end()
    return calls.calls


def test_strips_with_kept_materials_give_the_draws_of_their_calls() -> None:
    """A material set before GL_COLOR_MATERIAL lasts for vertices that share the colour, not for those that carry it."""
    short, long = strips(1, 4), strips(3, 6)

    def program(draw: Callable[[Calls], None]) -> None:
        gl.glColor3f(1.0, 0.5, 0.0)
        draw(long)
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, (0.1, 0.2, 0.3, 1.0))
        gl.glEnable(gl.GL_COLOR_MATERIAL)
        draw(short)
        gl.glColor3f(1.0, 0.5, 0.0)  # the vertices carry it, because few others are collected
        draw(long)

    assert draws_of(partial(program, Calls.make)) == draws_of(partial(program, call_by_call))


def strip_of_each(modes: tuple[int, ...]) -> Calls:
    calls = ShapeWriter()
    for strip, mode in enumerate(modes):
        calls.begin(mode)
        for vertex in range(6):
            calls.vertex(0.1 * vertex, 0.2 * (vertex % 2), 0.1 * strip)
        calls.end()
    return calls.calls


@pytest.mark.parametrize("modes", [(gl.GL_TRIANGLE_FAN, gl.GL_TRIANGLE_STRIP), 2 * (gl.GL_TRIANGLE_STRIP,)])
def test_strips_behind_a_pair_without_vertices_give_the_draws_of_their_calls(modes: tuple[int, ...]) -> None:
    """Mesa draws nothing of the fans that follow an empty one, up to the next strip of another mode."""
    strips, fan = strip_of_each(modes), strip_of_each((gl.GL_TRIANGLE_FAN,))

    def program(draw: Callable[[Calls], None]) -> None:
        draw(strips)
        gl.glBegin(gl.GL_TRIANGLE_FAN)
        gl.glEnd()
        draw(strips)
        call_by_call(fan)

    at_once = draws_of(partial(program, Calls.make))
    assert at_once == draws_of(partial(program, call_by_call))
    n_vertices = sum(len(rows[0]) // 16 for rows in at_once[3::2])  # of separate triangles: four of each strip
    assert n_vertices == 12 * (4 if modes[0] == gl.GL_TRIANGLE_FAN else 5)


def test_the_stipple_goes_on_where_the_first_line_of_a_strip_is_clipped_away() -> None:
    lines = ShapeWriter()
    for strip in range(6):
        lines.begin(gl.GL_LINE_STRIP)
        for vertex in range(5):
            lines.vertex(-1.9 + 0.4 * vertex, -0.8 + 0.3 * strip, 0.0)
        lines.end()

    def program(draw: Callable[[Calls], None]) -> None:
        gl.glEnable(gl.GL_LINE_STIPPLE)
        gl.glLineStipple(3, 0x5F31)
        draw(lines.calls)

    at_once = draws_of(partial(program, Calls.make))
    assert len({stipple_place for _, _, _, stipple_place, *_ in at_once[2::2]}) > 1
    assert at_once == draws_of(partial(program, call_by_call))


def test_strips_use_their_arrays() -> None:
    calls = ShapeWriter()
    calls.begin(gl.GL_TRIANGLE_STRIP)
    for n in range(5):
        calls.normal(0.0, 0.0, float(n))
        calls.vertex(float(n), 0.0, 0.0)
    calls.end()
    with gl.create_context(8, 8) as context:
        calls.calls.make()
        calls.calls.make()
        first, second = (command for command in context.frame.commands if isinstance(command, Draw))
    assert first.vertices.position is second.vertices.position
    assert first.vertices.normal[:, 2].tolist() == [0, 1, 2, 3, 4]


def evaluate_meshes(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for target, size in (("VERTEX_3", 3), ("COLOR_4", 4), ("TEXTURE_COORD_2", 2), ("NORMAL", 3)):
        if target == "VERTEX_3" or rng.random() < 0.4:
            gl.glMap2f(getattr(gl, f"GL_MAP2_{target}"), 0, 1, 0, 1, rng.normal(size=(3, 4, size)).astype(np.float32))
            gl.glEnable(getattr(gl, f"GL_MAP2_{target}"))
    for switch in (gl.GL_AUTO_NORMAL, gl.GL_COLOR_MATERIAL):
        if rng.random() < 0.5:
            gl.glEnable(switch)
    for _ in range(4):
        gl.glMapGrid2f(int(rng.integers(1, 12)), 0, 1, int(rng.integers(1, 5)), 0, 1)
        mode = int(rng.choice([gl.GL_POINT, gl.GL_LINE, gl.GL_FILL]))
        if rng.random() < 0.7:
            gl.glColor4f(*rng.random(4).tolist())
        gl.glEvalMesh2(mode, 0, int(rng.integers(0, 12)), 0, int(rng.integers(0, 5)))
        if rng.random() < 0.5:
            gl.glTexCoord4f(*rng.random(4).tolist())


@pytest.mark.parametrize("n_bytes", [vertex_buffer.BYTES, 4096])
def test_meshes_of_evaluators_give_the_draws_of_single_vertices(n_bytes: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(vertex_buffer, "BYTES", n_bytes)
    for seed in range(ROUNDS):
        at_once = draws_of(partial(evaluate_meshes, seed))
        with monkeypatch.context() as patch:
            patch.setattr(evaluators, "_takes_all", lambda *_: False)
            patch.setattr(evaluators, "similar_pairs", lambda *_: None)
            patch.setattr(evaluators, "first_pairs", lambda *_: None)
            assert draws_of(partial(evaluate_meshes, seed)) == at_once, seed


def add_vertices(rng: np.random.Generator) -> None:
    """Add evaluated vertices, often, or another vertex, or set an attribute."""
    what = int(rng.choice(6, p=(0.4, 0.2, 0.1, 0.1, 0.1, 0.1)))
    if what == 0:
        for _ in range(int(rng.integers(1, 9))):
            gl.glEvalCoord2f(*rng.random(2).tolist())
    elif what == 1:
        gl.glEvalPoint2(*rng.integers(0, 4, 2).tolist())
    elif what == 2:
        gl.glVertex3f(*rng.normal(size=3).tolist())
    elif what == 3:
        gl.glVertex2f(*rng.normal(size=2).tolist())
    elif what == 4:
        gl.glColor3f(*rng.random(3).tolist())
    else:
        gl.glNormal3f(*rng.normal(size=3).tolist())


def evaluate_vertices(seed: int) -> None:
    """Draw primitives of random modes with evaluated and other vertices, some of them in a display list."""
    rng = np.random.default_rng(seed)
    gl.glMapGrid2f(4, 0, 1, 3, 0, 1)
    for name, size, p in (("VERTEX_3", 3, 0.9), ("COLOR_4", 4, 0.5), ("NORMAL", 3, 0.3), ("TEXTURE_COORD_2", 2, 0.3)):
        target = getattr(gl, f"GL_MAP2_{name}")
        gl.glMap2f(target, 0, 1, 0, 1, rng.normal(size=(3, 2, size)).astype(np.float32))
        if rng.random() < p:
            gl.glEnable(target)
    for switch in (gl.GL_AUTO_NORMAL, gl.GL_COLOR_MATERIAL):
        if rng.random() < 0.5:
            gl.glEnable(switch)
    is_listed = rng.random() < 0.3
    if is_listed:
        gl.glNewList(1, int(rng.choice([gl.GL_COMPILE, gl.GL_COMPILE_AND_EXECUTE])))
    for _ in range(4):
        gl.glBegin(int(rng.integers(gl.GL_POINTS, gl.GL_POLYGON + 1)))
        for _ in range(int(rng.integers(1, 20))):
            add_vertices(rng)
        gl.glEnd()
    if is_listed:
        gl.glEndList()
        gl.glCallList(1)


@pytest.mark.parametrize("n_bytes", [vertex_buffer.BYTES, 2048])
def test_vertices_whose_numbers_wait_are_those_computed_at_once(n_bytes: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(vertex_buffer, "BYTES", n_bytes)
    waited: list[bool] = []
    add = evaluators.WaitingVertices.add
    for seed in range(ROUNDS):
        with monkeypatch.context() as patch:
            patch.setattr(evaluators.WaitingVertices, "add", lambda *each: waited.append(add(*each)) or waited[-1])
            waiting = draws_of(partial(evaluate_vertices, seed))
            patch.setattr(evaluators.WaitingVertices, "add", lambda *_: False)
            assert draws_of(partial(evaluate_vertices, seed)) == waiting, seed
    assert waited.count(True) > 10 * ROUNDS


def test_a_parameter_that_is_no_number_is_refused_where_it_is_given() -> None:
    with gl.create_context(16, 12):
        gl.glEnable(gl.GL_MAP1_VERTEX_3)
        gl.glBegin(gl.GL_POINTS)
        gl.glEvalCoord1f(0.5)
        gl.glEvalCoord1f(0.5)
        with pytest.raises(TypeError, match="glEvalCoord1f"):
            gl.glEvalCoord1f("half")
        gl.glEnd()


def test_meshes_are_kept_only_where_all_they_depend_on_is_equal() -> None:
    """The positions of each draw are those of a new context, whose calls before set other maps and grids."""

    def positions(calls: list[Callable[[], None]]) -> list[bytes]:
        with gl.create_context(16, 12) as context:
            gl.glEnable(gl.GL_MAP2_VERTEX_3)
            gl.glMapGrid2f(3, 0, 1, 2, 0, 1)
            for call in calls:
                call()
            before = [command for command in context.frame.commands if isinstance(command, Draw)]
            gl.glEvalMesh2(gl.GL_FILL, 0, 3, 0, 2)
            draws = [command.vertices for command in context.frame.commands if isinstance(command, Draw)]
        mesh = draws[len(before) :]
        return [b"".join([getattr(each, name).tobytes() for each in mesh]) for name in ("position", "normal")]

    rng = np.random.default_rng(4)
    maps = [rng.normal(size=(3, 4, 3)).astype(np.float32) for _ in range(2)]
    settings: list[Callable[[], None]] = [
        partial(gl.glMap2f, gl.GL_MAP2_VERTEX_3, 0, 1, 0, 1, maps[0]),
        partial(gl.glMap2f, gl.GL_MAP2_VERTEX_3, 0, 1, 0, 1, maps[1]),
        partial(gl.glMap2f, gl.GL_MAP2_VERTEX_3, 0, 1, 0, 2, maps[1]),
        partial(gl.glMapGrid2f, 3, 0, 1, 2, 0.25, 1),
        partial(gl.glEnable, gl.GL_AUTO_NORMAL),
        partial(gl.glMap2f, gl.GL_MAP2_NORMAL, 0, 1, 0, 1, maps[0]),
        partial(gl.glEnable, gl.GL_MAP2_NORMAL),
        partial(gl.glDisable, gl.GL_AUTO_NORMAL),
    ]
    mesh = partial(gl.glEvalMesh2, gl.GL_FILL, 0, 3, 0, 2)
    for end in range(1, len(settings) + 1):
        drawn_between = [call for setting in settings[:end] for call in (setting, mesh)]
        assert positions(drawn_between) == positions(settings[:end]), end
