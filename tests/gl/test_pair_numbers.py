"""Vertices of joined pairs whose numbers wait are those of pairs whose arrays are made at once, bit for bit."""

from random import Random

import numpy as np
import pytest

from softshadow import gl
from softshadow.context import vertex_buffer
from softshadow.context.joined_pairs import LateVertices
from softshadow.gl import list_primitives, pair_numbers

NUMBERS = (0.0, -0.0, 0.25, 1.0, -3.5, 1e30, float("nan"))
ATTRIBUTES = (
    ("glColor3f", 3), ("glColor4f", 4), ("glNormal3f", 3), ("glTexCoord2f", 2), ("glTexCoord4f", 4),
)  # fmt: skip
RARE = (
    ("glEdgeFlag", False), ("glEdgeFlag", True), ("glSecondaryColor3f", 0.5, 0, 0), ("glSecondaryColor3f", 0, 0, 0),
    ("glMaterialf", gl.GL_FRONT, gl.GL_SHININESS, 5.0), ("glMultiTexCoord2f", gl.GL_TEXTURE1, 0.5, 0.25),
    ("glPushDebugGroup", gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "group"), ("glPopDebugGroup",),
    ("glEnable", gl.GL_COLOR_MATERIAL), ("glDisable", gl.GL_COLOR_MATERIAL), ("glFogCoordf", 0.5), ("glFogCoordf", 0),
)  # fmt: skip
INSIDE = (("glMaterialf", gl.GL_FRONT, gl.GL_SHININESS, 7.0), ("glVertex2f", 0.5, 0.25), ("glEvalCoord1f", 0.25))
MODES = {
    gl.GL_QUADS: 8, gl.GL_TRIANGLES: 2, gl.GL_LINES: 1, gl.GL_LINE_LOOP: 2, gl.GL_TRIANGLE_STRIP: 1, gl.GL_POLYGON: 2,
}  # fmt: skip
SMALL_BUFFER = 1536  # bytes: some 60 vertices of two floats and a colour
SEEDS = range(160)


def random_program(seed):
    """Return calls, most of them pairs of one mode with a change of one attribute between or inside."""
    random = Random(seed)
    program, attributes, mode = [], random.sample(ATTRIBUTES, random.randint(1, 3)), gl.GL_QUADS

    def attribute():
        name, count = random.choice(attributes)
        return (name, *random.choices(NUMBERS, k=count))

    for _ in range(12):
        if random.random() < 0.5:
            program.append(attribute())
        if random.random() < 0.12:
            program.append(random.choice(RARE))
        if random.random() < 0.2:
            program.append(("glRectf", *random.choices(NUMBERS, k=4)))
            continue
        if random.random() < 0.5:
            mode = random.choices(list(MODES), list(MODES.values()))[0]
        program.append(("glBegin", mode))
        for _ in range(random.choice((0, 3, 4, 4, 4, 6, 8))):
            if random.random() < 0.2:
                program.append(attribute())
            if random.random() < 0.03:
                program.append(random.choice(INSIDE))
            program.append(("glVertex3f", *random.choices(NUMBERS, k=3)))
        program.append(("glEnd",))
    return program


def drawn(program):
    """Return the state and the arrays of all draws of a program."""
    with gl.create_context(4, 4) as context:
        gl.glMap1f(gl.GL_MAP1_VERTEX_3, 0, 1, [(0, 0, 0), (1, 2, 4)])
        gl.glEnable(gl.GL_MAP1_VERTEX_3)
        for name, *arguments in program:
            if name != "glPopDebugGroup" or context.labels:
                getattr(gl, name)(*arguments)
        return [described(command) for command in context.frame.commands]


def described(command):
    each = command.vertices
    arrays = [each.position, each.color, each.normal, *each.texcoords, *each.materials.values()]
    arrays += [each.edges, each.secondary, each.fog_coordinates, command.joined_positions]
    values = [None if array is None else (array.dtype, array.shape, array.tobytes()) for array in arrays]
    return command.mode, repr(command.state), command.label, command.joined_start, list(each.materials), values


def shapes_with_outlines(seed):
    """Return calls that draw shapes in two or three modes in turn; now and then another call comes between."""
    random = Random(seed)
    modes = random.sample([*MODES, gl.GL_POINTS, gl.GL_LINE_STRIP], random.choice((2, 2, 3)))
    color, is_calm = random.choice(ATTRIBUTES), random.random() < 0.5
    program = []
    for number in range(random.choice((8, 30))):
        if random.random() < 0.4:
            program.append((color[0], *random.choices(NUMBERS, k=color[1])))
        if not is_calm and random.random() < 0.08:
            program.append(random.choice((*RARE, ("glRectf", *random.choices(NUMBERS, k=4)))))
        mode = modes[number % len(modes)] if random.random() < 0.85 else random.choice(modes)
        program.append(("glBegin", mode))
        for _ in range(random.choice((4, 4, 4, 6)) if is_calm else random.choice((0, 3, 4, 4, 4, 8))):
            if random.random() < 0.03:
                program.append(random.choice(INSIDE if random.random() < 0.3 and not is_calm else RARE[:1]))
            program.append(("glVertex3f", *random.choices(NUMBERS, k=3)))
        program.append(("glEnd",))
    return program


@pytest.mark.parametrize("make_program", [random_program, shapes_with_outlines])
@pytest.mark.parametrize("seed", SEEDS)
def test_numbers_that_wait_change_no_bit(make_program, seed, monkeypatch):
    program = make_program(seed)
    if seed % 2:
        monkeypatch.setattr(vertex_buffer, "BYTES", SMALL_BUFFER)
        monkeypatch.setattr(vertex_buffer, "LEAST_BYTES", 64)
    with np.errstate(all="ignore"):
        waiting = drawn(program)
        monkeypatch.setattr(pair_numbers, "FEW", 0)
        assert drawn(program) == waiting


@pytest.fixture
def context():
    with gl.create_context(8, 8) as context:
        yield context


def quad(left):
    gl.glRectf(left, 0, left + 0.25, 0.25)


def test_pairs_of_one_format_are_one_part(context):
    gl.glColor3f(1, 0, 0)
    for left in range(3):
        quad(left)
    (part,) = context.vertex_buffer.joined_pairs.parts
    assert isinstance(part[1], LateVertices)
    assert len(context.frame.commands[0].vertices.position) == 12


def test_a_constant_colour_that_changes_begins_another_part(context):
    quad(0)
    gl.glColor3f(0, 1, 0)  # no vertex carries a colour yet
    quad(1)
    (command,) = context.frame.commands[-1:]
    assert command.vertices.color[-1].tolist() == [0, 1, 0, 1]


def test_a_debug_group_has_the_pairs_that_ended_in_it(context):
    for left in range(3):
        quad(left)
    gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "inside")
    quad(3)
    quad(4)
    gl.glPopDebugGroup()
    quad(5)
    lefts = [(each.label, each.vertices.position[::4, 0].tolist()) for each in context.frame.commands]
    assert lefts == [("", [0, 1, 2]), ("inside", [3, 4]), ("", [5])]


@pytest.mark.parametrize("mode", [gl.GL_LINE_LOOP, gl.GL_LINES])
def test_a_debug_group_that_begins_among_pairs_of_two_modes_changes_no_bit(mode, monkeypatch):
    def pair(x, own):
        return [("glBegin", own), *[("glVertex2f", x, y) for y in range(4)], ("glEnd",)]

    shapes = [call for x in range(4) for call in (*pair(x, gl.GL_QUADS), *pair(x + 0.5, mode))]
    group = ("glPushDebugGroup", gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "inside")
    program = [*shapes, group, *pair(4, mode), *pair(5, mode), ("glPopDebugGroup",), *shapes]
    waiting = drawn(program)
    assert ["inside" in each for each in waiting].count(True) == 1
    monkeypatch.setattr(pair_numbers, "FEW", 0)
    assert drawn(program) == waiting


def test_a_pair_cannot_begin_inside_a_resumed_one(context):
    quad(0)
    quad(1)
    gl.glBegin(gl.GL_QUADS)
    with pytest.raises(gl.GLError, match="glBegin"):
        gl.glBegin(gl.GL_QUADS)
    for x in range(4):
        gl.glVertex2f(x, 0)
    gl.glEnd()
    assert context.frame.commands[0].vertices.position[8:, 0].tolist() == [0, 1, 2, 3]


def test_a_mode_that_is_an_array_is_refused_also_after_pairs(context):
    quad(0)
    quad(1)
    with pytest.raises(TypeError, match="glBegin"):
        gl.glBegin(np.array([gl.GL_QUADS, gl.GL_QUADS]))


def test_pairs_that_a_list_records_and_executes_are_in_the_list(context):
    gl.glNewList(1, gl.GL_COMPILE_AND_EXECUTE)
    for x in range(3):
        gl.glBegin(gl.GL_QUADS)
        for y in range(4):
            gl.glVertex2f(x, y)
        gl.glEnd()
    gl.glEndList()
    gl.glCallList(1)
    positions = np.concatenate([each.vertices.position[:, :2] for each in context.frame.commands])
    assert positions.tolist() == [[x, y] for x in range(3) for y in range(4)] * 2


def test_pairs_after_one_that_a_list_has_begun_fill_the_buffer_as_others_do(monkeypatch):
    monkeypatch.setattr(vertex_buffer, "BYTES", SMALL_BUFFER)
    program = [("glNewList", 1, gl.GL_COMPILE), ("glBegin", gl.GL_QUADS), ("glEndList",), ("glCallList", 1)]
    program += [*[("glVertex2f", x, 0) for x in range(4)], ("glEnd",)]
    for x in range(60):
        program += [("glBegin", gl.GL_QUADS), *[("glVertex2f", x, y) for y in range(4)], ("glEnd",)]
    waiting = drawn(program)
    monkeypatch.setattr(pair_numbers, "FEW", 0)
    assert drawn(program) == waiting
    assert len(waiting) > 1


@pytest.mark.parametrize(
    ("name", "arguments", "values"),
    [("glMaterialf", (gl.GL_FRONT, gl.GL_SHININESS), (3.0, 5.0)), ("glEdgeFlag", (), (False, True))],
)
def test_an_attribute_that_few_vertices_have_can_change_between_pairs(context, name, arguments, values):
    setting = getattr(gl, name)
    gl.glBegin(gl.GL_LINES)  # makes the vertices that follow carry the attribute
    gl.glVertex2f(0, 0)
    setting(*arguments, values[0])
    gl.glVertex2f(0, 0)
    gl.glEnd()
    for pair in range(4):
        setting(*arguments, values[pair // 2])
        quad(pair)
    vertices = context.frame.commands[-1].vertices
    found = vertices.materials["front.shininess"].ravel() if vertices.edges is None else vertices.edges
    assert found[-8:].tolist() == [values[1]] * 8
    assert found[-16:-8].tolist() == [values[0]] * 8


def test_a_strip_of_one_triangle_is_drawn_after_the_strips_before(context):
    for length in (4, 4, 3, 4):  # Mesa draws three vertices as a triangle
        gl.glBegin(gl.GL_TRIANGLE_STRIP)
        for x in range(length):
            gl.glVertex2f(x, length)
        gl.glEnd()
    drawn = [(each.mode, each.vertices.position[:, 1].tolist()) for each in context.frame.commands]
    assert drawn == [
        (gl.GL_TRIANGLES, [4] * 8), (gl.GL_TRIANGLES, [3] * 3), (gl.GL_TRIANGLE_STRIP, [4] * 4),
    ]  # fmt: skip


def test_a_large_pair_makes_its_arrays_at_once(context):
    gl.glBegin(gl.GL_TRIANGLES)
    for _ in range(pair_numbers.FEW // 3 * 3 + 3):
        gl.glVertex2f(0, 0)
    gl.glEnd()
    (part,) = context.vertex_buffer.joined_pairs.parts
    assert not isinstance(part[1], LateVertices)


@pytest.mark.parametrize("mode", [gl.GL_QUADS, gl.GL_POINTS])
def test_evaluated_vertices_are_those_of_the_map(context, mode):
    gl.glMap1f(gl.GL_MAP1_VERTEX_3, 0, 1, [(0, 0, 0), (1, 2, 4)])
    gl.glEnable(gl.GL_MAP1_VERTEX_3)
    for pair in range(3):
        gl.glBegin(mode)
        for k in range(4):
            gl.glEvalCoord1f((4 * pair + k) / 16)
        gl.glEnd()
    positions = np.concatenate([command.vertices.position for command in context.frame.commands])
    assert positions.tolist() == [[n / 16, n / 8, n / 4, 1] for n in range(12)]


def test_evaluated_vertices_fill_the_buffer_as_others_do(monkeypatch):
    monkeypatch.setattr(vertex_buffer, "BYTES", SMALL_BUFFER)

    def strip(vertex):
        return drawn([("glBegin", gl.GL_LINE_STRIP), *map(vertex, range(257)), ("glEnd",)])

    evaluated = strip(lambda n: ("glEvalCoord1f", n / 256))
    assert evaluated == strip(lambda n: ("glVertex3f", n / 256, n / 128, n / 64))
    assert len(evaluated) > 1


@pytest.mark.parametrize("few", [0, 16])
def test_meshes_of_points_have_the_colours_of_their_maps(context, monkeypatch, few):
    monkeypatch.setattr(pair_numbers, "FEW", few)
    gl.glMap1f(gl.GL_MAP1_VERTEX_3, 0, 1, [(0, 0, 0), (1, 2, 4)])
    gl.glMap1f(gl.GL_MAP1_COLOR_4, 0, 1, [(0, 0, 0, 1), (1, 0.5, 0, 1)])
    gl.glEnable(gl.GL_MAP1_VERTEX_3)
    gl.glEnable(gl.GL_MAP1_COLOR_4)
    gl.glMapGrid1f(4, 0, 1)
    for _ in range(3):
        gl.glEvalMesh1(gl.GL_POINT, 0, 4)
    colors = np.concatenate([command.vertices.color for command in context.frame.commands])
    assert colors.tolist() == [[n / 4, n / 8, 0, 1] for n in range(5)] * 3


@pytest.mark.parametrize("list_mode", [None, gl.GL_COMPILE, gl.GL_COMPILE_AND_EXECUTE])
def test_rectangles_are_quads_also_where_the_buffer_is_full(monkeypatch, list_mode):
    monkeypatch.setattr(vertex_buffer, "BYTES", 4096)
    monkeypatch.setattr(list_primitives, "can_be_joined", lambda _: False)  # pairs in a list: test_faces_in_lists.py

    def rectangle(x):
        gl.glRectf(x, 0, x + 1, 2)

    def pair(x):
        gl.glBegin(gl.GL_QUADS)
        for corner in ((x, 0), (x + 1, 0), (x + 1, 2), (x, 2)):
            gl.glVertex2f(*corner)
        gl.glEnd()

    def draws(draw_one):
        with gl.create_context(4, 4) as context:
            if list_mode:
                gl.glNewList(1, list_mode)
            for x in range(300):
                if x in (1, 2, 150):
                    gl.glColor3f(x / 300, 0, 1)
                draw_one(x)
            if list_mode:
                gl.glEndList()
                gl.glCallList(1)
            return [described(command) for command in context.frame.commands]

    of_pairs = draws(pair)
    assert draws(rectangle) == of_pairs
    assert len(of_pairs) > 3  # more than the colours would make
