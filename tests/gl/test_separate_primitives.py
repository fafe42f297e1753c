"""Strips, fans, loops and polygons in a row become one draw of separate triangles or lines, with the same pixels."""

from random import Random
from typing import Any

import numpy as np
import pytest

from gl.primitives_in_a_row import buffers_and_draws, set_where_order_matters
from gl.shape_writer import ShapeWriter
from softshadow import gl
from softshadow.gl import pair_numbers
from softshadow.inspection.validate_recording import validate_frame
from softshadow.pipeline import use_short_cuts
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.assembly import assemble, edge_flags, edges_of_joined_polygons
from softshadow.pipeline.geometry.lines import LINES, assemble_lines
from softshadow.pipeline.geometry.separate import SEPARABLE, separate_indices

MODES = (*SEPARABLE, gl.GL_QUADS, gl.GL_POINTS)
FACES = (gl.GL_FRONT, gl.GL_BACK, gl.GL_FRONT_AND_BACK)
FILLS = (gl.GL_FILL, gl.GL_LINE, gl.GL_POINT)
SWITCHES = (
    gl.GL_CULL_FACE, gl.GL_POLYGON_OFFSET_FILL, gl.GL_POLYGON_OFFSET_LINE, gl.GL_LINE_SMOOTH, gl.GL_LINE_STIPPLE,
    gl.GL_POLYGON_STIPPLE, gl.GL_LIGHTING, gl.GL_LIGHT0, gl.GL_COLOR_MATERIAL, gl.GL_CLIP_PLANE0, gl.GL_BLEND,
)  # fmt: skip


def change_state(random: Random) -> None:
    """Change what may matter for primitives of a draw: modes of polygons, stipple, provoking vertex, clipping."""
    what = random.randrange(8)
    if what == 0:
        gl.glPolygonMode(random.choice(FACES), random.choice(FILLS))
    elif what == 1:
        gl.glShadeModel(random.choice((gl.GL_FLAT, gl.GL_SMOOTH)))
    elif what == 2:
        gl.glProvokingVertex(random.choice((gl.GL_FIRST_VERTEX_CONVENTION, gl.GL_LAST_VERTEX_CONVENTION)))
    elif what == 3:
        gl.glLineWidth(random.choice((1.0, 3.0)))
    elif what == 4:
        gl.glCullFace(random.choice(FACES[:2]))
    else:
        random.choice((gl.glEnable, gl.glDisable))(random.choice(SWITCHES))


def draw_pairs(random: Random) -> None:
    """Draw pairs of a few modes, some with edge flags or in a debug group of their own, many of them clipped."""
    modes, calls = random.sample(MODES, 2), random.choices((gl.glColor3f, gl.glNormal3f), k=2)
    for _ in range(random.randint(1, 7)):
        if random.random() < 0.06:
            gl.glEdgeFlag(random.random() < 0.7)
        if random.random() < 0.3:
            calls[0](*[random.random() for _ in range(3)])
        grouped = random.random() < 0.1
        if grouped:
            gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "group")
        gl.glBegin(random.choices(modes, (3, 1))[0])
        for _ in range(random.choice((1, 2, 3, 4, 4, 5, 9))):
            if random.random() < 0.4:
                calls[1](*[random.random() for _ in range(3)])
            gl.glVertex3f(*[random.uniform(-1.3, 1.3) for _ in range(3)])
        gl.glEnd()
        if grouped:
            gl.glPopDebugGroup()


def drawn(seed: int) -> tuple[list[bytes], list[Draw]]:
    """Return the buffers that a random program leaves, and its draws."""
    random = Random(seed)
    with gl.create_context(24, 18) as context:
        set_where_order_matters()
        for _ in range(4):
            for _ in range(random.randint(0, 3)):
                change_state(random)
            draw_pairs(random)
        return buffers_and_draws(context)


@pytest.mark.parametrize("seeds", [range(start, start + 25) for start in range(0, 200, 25)], ids=str)
def test_joined_primitives_have_the_pixels_of_single_ones(seeds: range, monkeypatch: pytest.MonkeyPatch) -> None:
    joined = {seed: drawn(seed) for seed in seeds}
    assert any(draw.pairs_mode for _, draws in joined.values() for draw in draws)
    monkeypatch.setattr(pair_numbers, "SEPARABLE", {})
    for seed in seeds:
        buffers, draws = drawn(seed)
        assert not any(draw.pairs_mode for draw in draws)
        assert len(draws) >= len(joined[seed][1])
        assert buffers == joined[seed][0], seed


def outlined_polygons(mode: int) -> bytes:
    """Return the colours after some polygons, by their edges or corners, have been drawn."""
    with gl.create_context(24, 18) as context:
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, mode)
        for polygon in range(5):
            gl.glBegin(gl.GL_POLYGON)
            for corner in range(3 + polygon):
                angle = 6.28 * corner / (3 + polygon)
                gl.glVertex2f(0.4 * polygon - 0.8 + 0.3 * np.cos(angle), 0.7 * np.sin(angle))
            gl.glEnd()
        gl.glFinish()
        return context.storage.window.color.view.tobytes()


@pytest.mark.parametrize("short_cuts", [True, False])
@pytest.mark.parametrize("mode", [gl.GL_LINE, gl.GL_POINT])
def test_joined_polygons_have_no_diagonals(mode: int, short_cuts: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    with use_short_cuts(short_cuts):
        joined = outlined_polygons(mode)
        monkeypatch.setattr(pair_numbers, "SEPARABLE", {})
        assert outlined_polygons(mode) == joined


@pytest.mark.parametrize("mode", SEPARABLE)
def test_indices_are_those_of_each_primitive(mode: int) -> None:
    counts = (4, 3, 1, 7)
    expected, start = [], 0
    for count in counts:
        corners = assemble_lines(mode, count) if mode in LINES else assemble(mode, count).corners
        expected += (corners + start).ravel().tolist()
        start += count
    assert separate_indices((mode,) * len(counts), counts).tolist() == expected
    if mode not in LINES:  # the last corner gives the flat colour, as of separate triangles
        triangles = assemble(mode, 8)
        assert triangles.provoking.tolist() == triangles.corners[:, 2].tolist()


def test_edges_of_joined_polygons_are_those_of_each() -> None:
    counts = (5, 3, 2, 4)
    corners = separate_indices((gl.GL_POLYGON,) * len(counts), counts).reshape(-1, 3)
    expected = np.concatenate([edge_flags(gl.GL_POLYGON, max(count - 2, 0)) for count in counts])
    assert edges_of_joined_polygons(corners).tolist() == expected.tolist()
    assert edges_of_joined_polygons(corners[:0]).shape == (0, 3)


def loops(count: int) -> None:
    for loop in range(count):
        gl.glBegin(gl.GL_LINE_LOOP)
        for x, y in ((0.0, 0.0), (0.2, 0.0), (0.2, 0.2)):
            gl.glVertex2f(x, y + 0.1 * loop)
        gl.glEnd()


def test_a_draw_of_several_loops_is_named_by_their_mode() -> None:
    with gl.create_context(8, 8) as context:
        loops(3)
        (draw,) = context.frame.commands
    assert (draw.mode, draw.called_mode, draw.mode_name) == (gl.GL_LINES, gl.GL_LINE_LOOP, "GL_LINE_LOOP")
    assert repr(draw) == "Draw(GL_LINE_LOOP, 9 vertices, label '')"
    assert draw.indices.tolist() == [0, 1, 1, 2, 2, 0, 3, 4, 4, 5, 5, 3, 6, 7, 7, 8, 8, 6]


def test_a_single_loop_stays_a_loop() -> None:
    with gl.create_context(8, 8) as context:
        loops(1)
        (draw,) = context.frame.commands
    assert (draw.mode, draw.pairs_mode, draw.indices) == (gl.GL_LINE_LOOP, 0, None)


def test_loops_of_two_debug_groups_are_two_draws() -> None:
    with gl.create_context(8, 8) as context:
        loops(2)
        gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "inner")
        loops(1)
        gl.glPopDebugGroup()
        both, single = context.frame.commands
    assert (both.label, both.called_mode, len(both.vertices.position)) == ("", gl.GL_LINE_LOOP, 6)
    assert (single.label, single.mode, single.indices) == ("inner", gl.GL_LINE_LOOP, None)


def test_shapes_keep_the_arrays_of_their_strips() -> None:
    """What is derived from the same arrays is found again."""
    shape = ShapeWriter()
    shape.begin(gl.GL_TRIANGLE_STRIP)
    for n in range(5):
        shape.vertex(float(n), 0.0, 0.0)
    shape.end()
    with gl.create_context(8, 8) as context:
        shape.calls.make()
        shape.calls.make()
        first, second = context.frame.commands
    assert first.vertices.position is second.vertices.position


def test_described_polygons_stay_draws_of_their_own() -> None:
    """The description numbers the triangles of each draw."""
    with gl.create_context(8, 8) as context:
        gl.describe_primitives("cap", "face", np.array([5, 6]))
        loops(2)
        gl.describe_primitives("")
        assert [(draw.mode, draw.origin.part) for draw in context.frame.commands] == 2 * [(gl.GL_LINE_LOOP, "cap")]


@pytest.mark.parametrize(
    "wrong",
    [
        {"indices": None},
        {"mode": gl.GL_TRIANGLES},
        {"pairs_mode": gl.GL_QUADS},
        {"indices": np.arange(5, dtype=np.int32)},
    ],
    ids=["no indices", "other primitives", "another mode", "half a line"],
)
def test_a_file_with_other_indices_is_refused(wrong: dict[str, Any]) -> None:
    """Kernels rely on them: they check no index."""
    with gl.create_context(8, 8) as context:
        loops(2)
        frame = context.frame
    validate_frame(frame)
    frame.commands[0] = frame.commands[0]._replace(**wrong)
    with pytest.raises(ValueError, match="a draw of pairs of mode"):
        validate_frame(frame)


def test_feedback_names_each_polygon() -> None:
    """The outline of each polygon begins with GL_LINE_RESET_TOKEN."""
    with gl.create_context(8, 8):
        gl.glFeedbackBuffer(200, gl.GL_2D)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        gl.glRenderMode(gl.GL_FEEDBACK)
        for _ in range(2):
            gl.glBegin(gl.GL_POLYGON)
            for x, y in ((0.0, 0.0), (0.4, 0.0), (0.4, 0.4), (0.0, 0.4)):
                gl.glVertex2f(x, y)
            gl.glEnd()
        tokens = [token for token, *_ in gl.glRenderMode(gl.GL_RENDER)]
    assert tokens == 2 * [gl.GL_LINE_RESET_TOKEN, *3 * [gl.GL_LINE_TOKEN]]


@pytest.mark.parametrize("n", [12, 64, 150])
def test_a_sphere_of_many_slices_is_computed_once(n: int) -> None:
    """Also one that fills Mesa's vertex buffer: then some strips are drawn by their calls."""
    quadric = gl.gluNewQuadric()
    with gl.create_context(8, 8) as context:
        for _ in range(2):
            gl.gluSphere(quadric, 0.5, n, n)
            gl.glTranslatef(0.1, 0.0, 0.0)
        draws = [command for command in context.frame.commands if isinstance(command, Draw)]
    half = len(draws) // 2
    assert 1 <= half < 10
    assert all(one.vertices is other.vertices for one, other in zip(draws[:half], draws[half:], strict=True)) or n > 64
    ids = [{id(draw.vertices) for draw in each} for each in (draws[:half], draws[half:])]
    assert ids[0] & ids[1]
