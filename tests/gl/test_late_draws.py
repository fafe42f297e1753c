"""Draws whose arrays are made later are those whose arrays are made at once, in the same place among all commands."""

from random import Random

import numpy as np
import pytest

from softshadow import gl
from softshadow.context import late_commands, late_draws
from softshadow.gl import pair_numbers
from softshadow.pipeline.commands import Draw

SIZE = 16, 16
MODES = (gl.GL_POINTS, gl.GL_LINES, gl.GL_LINE_LOOP, gl.GL_TRIANGLES, gl.GL_TRIANGLE_FAN, gl.GL_QUADS, gl.GL_POLYGON)
ATTRIBUTES = (("glColor3f", 3), ("glColor4f", 4), ("glNormal3f", 3), ("glTexCoord2f", 2))
SWITCHES = (
    gl.GL_LIGHTING, gl.GL_COLOR_MATERIAL, gl.GL_TEXTURE_2D, gl.GL_DEPTH_TEST, gl.GL_BLEND, gl.GL_SCISSOR_TEST,
    gl.GL_LINE_STIPPLE, gl.GL_CULL_FACE, gl.GL_POLYGON_OFFSET_LINE, gl.GL_CLIP_PLANE0, gl.GL_LIGHT0,
)  # fmt: skip
ATTACHED = gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D
BITMAP = bytes([0xAA, 0x55] * 4)
CORNERS = np.array([(-1, -1, 0.5), (1, -1, 0.5), (0, 1, -0.5)], np.float32)


def random_calls(seed):
    """Return calls: pairs under matrices, attributes and states of their own, with other commands among them."""
    random = Random(seed)

    def number():
        return random.choice((0.0, -0.0, 0.5, random.uniform(-1, 1)))

    def attribute():
        name, count = random.choice(ATTRIBUTES)
        return (name, *(number() for _ in range(count)))

    def change():
        return random.choice(
            (
                ("glTranslatef", number(), number(), 0.0),
                ("glRotatef", 90 * number(), 0.0, 0.0, 1.0),
                ("glScalef", 0.5, 1.5, 1.0),
                ("glLoadIdentity",),
                ("glLoadMatrixf", np.diag((1.0, number(), 1.0, 1.0))),
                ("glMultMatrixf", np.diag((1.0, 1.0, number(), 1.0))),
                ("glOrtho", -1.0, 1.0, -1.5, 1.0, -1.0, 1.0),
                ("gluPerspective", 60.0, 1.0, 0.5, 5.0),
                ("glActiveTexture", random.choice((gl.GL_TEXTURE0, gl.GL_TEXTURE1))),
                ("glRasterPos2f", number(), number()),
                ("glPushAttrib", gl.GL_ALL_ATTRIB_BITS),
                ("glPopAttrib",),
                ("glMaterialf", gl.GL_FRONT, gl.GL_SHININESS, 10 * abs(number())),
                ("glSecondaryColor3f", number(), 0.0, 0.0),
                ("glEnable", random.choice(SWITCHES)),
                ("glEnable", gl.GL_COLOR_MATERIAL),
                ("glMaterialfv", gl.GL_FRONT, gl.GL_AMBIENT_AND_DIFFUSE, (number(), number(), 0.5, 1.0)),
                ("glDisable", random.choice(SWITCHES)),
                ("glPolygonMode", random.choice((gl.GL_FRONT, gl.GL_BACK)), random.choice((gl.GL_LINE, gl.GL_FILL))),
                ("glScissor", 2, 3, 9, 10),
                ("glViewport", 0, 0, 12, 16),
                ("glLineStipple", 1, 0x0F0F),
                attribute(),
                attribute(),
            )
        )

    def command():
        return random.choice(
            (
                ("glClear", gl.GL_DEPTH_BUFFER_BIT),
                ("glDrawArrays", gl.GL_TRIANGLES, 0, 3),
                ("glRectf", number(), number(), number(), number()),
                ("glBitmap", 8, 4, 0.0, 0.0, 5.0, 0.0, BITMAP),
                ("glTexSubImage2D", gl.GL_TEXTURE_2D, 0, 0, 0, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, BITMAP),
                ("glReadPixels", 3, 4, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE),
                ("glCallList", 1),
                ("glBeginQuery", gl.GL_SAMPLES_PASSED, 1),
                ("glEndQuery", gl.GL_SAMPLES_PASSED),
                ("glMatrixMode", random.choice((gl.GL_MODELVIEW, gl.GL_PROJECTION, gl.GL_TEXTURE))),
                ("glPushDebugGroup", gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "group"),
                ("glPopDebugGroup",),
                ("glFlush",),
                ("glNewList", 2, gl.GL_COMPILE_AND_EXECUTE),
                ("glEndList",),
                ("gluSphere", 0.7, 24, 5),
                ("glBindFramebuffer", gl.GL_FRAMEBUFFER, 1),
                ("glBindFramebuffer", gl.GL_FRAMEBUFFER, 0),
                ("glFramebufferTexture2D", *ATTACHED, random.choice((0, 2, 2, 3)), 0),
            )
        )

    calls = []
    for _ in range(30):
        calls += [change() for _ in range(random.choice((0, 1, 1, 2)))]
        if random.random() < 0.15:
            calls.append(command())
        calls.append(("glBegin", random.choice(MODES)))
        for _ in range(random.choice((0, 2, 3, 4, 4))):
            if random.random() < 0.3:
                calls.append(attribute())
            calls.append(("glVertex3f", number(), number(), number()))
        calls.append(("glEnd",))
    return calls


def framebuffer():
    """Bind framebuffer 1, which draws to texture 3; texture 2 has an image of the same shape."""
    for texture in (2, 3):
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, *SIZE, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 1)
    gl.glFramebufferTexture2D(*ATTACHED, 3, 0)


def prepare():
    framebuffer()
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, CORNERS)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    texels = np.arange(48, dtype=np.uint8) * 5
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 4, 4, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, texels)
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glRotatef(30, 0, 0, 1)
    gl.glBegin(gl.GL_LINES)
    gl.glVertex2f(-1, 0)
    gl.glVertex2f(1, 0)
    gl.glEnd()
    gl.glEndList()


def described(command):
    if not isinstance(command, Draw):
        return type(command), repr(command)
    vertices = command.vertices
    arrays: list[np.ndarray | None] = [vertices.position, vertices.color, vertices.normal, *vertices.texcoords]
    arrays += [*vertices.materials.values(), vertices.edges, vertices.secondary, vertices.fog_coordinates]
    arrays += [command.indices, command.modelview, command.projection, *command.texture_matrices]
    values = [None if each is None else (each.dtype, each.shape, each.strides, each.tobytes()) for each in arrays]
    others = command._replace(vertices=None, modelview=None, projection=None, texture_matrices=(), indices=None)
    return repr(tuple(others)), values


def drawn(calls, precision):
    """Return what is recorded, read and left in the window by calls."""
    with gl.create_context(*SIZE, precision=precision, raise_errors=False) as context:
        prepare()
        quadric, answers = gl.gluNewQuadric(), []
        for name, *arguments in calls:
            first = (quadric,) if name == "gluSphere" else ()
            answers.append(np.asarray(getattr(gl, name)(*first, *arguments)).tolist())
        frame, window, textures = context.frame, context.storage.window.color, context.storage.textures
        colors = [image.cells.tobytes() for image in (window, textures[2].images[0, 0], textures[3].images[0, 0])]
        return answers, [*map(described, frame.commands)], frame.bytes, colors


@pytest.mark.parametrize("precision", ["mesa", "exact"])
@pytest.mark.parametrize("seed", range(24))
def test_draws_that_are_late_change_no_bit(seed, precision, monkeypatch):
    calls = random_calls(seed)
    if seed % 2:
        monkeypatch.setattr(late_draws, "MOST_NUMBERS", 40)
    monkeypatch.setattr(late_commands, "MANY", (1, 3, late_commands.MANY)[seed % 3])  # else few are alike
    late = drawn(calls, precision)
    monkeypatch.setattr(pair_numbers, "FEW", 0)
    assert drawn(calls, precision) == late


@pytest.fixture
def context():
    with gl.create_context(*SIZE) as context:
        yield context


def triangle(*, then=lambda: None):
    """Draw the whole window by a triangle, and change a matrix, so that nothing can be joined to it."""
    gl.glBegin(gl.GL_TRIANGLES)
    for corner in ((-3.0, -3.0), (3.0, -3.0), (0.0, 6.0)):
        gl.glVertex2f(*corner)
    then()
    gl.glEnd()
    gl.glTranslatef(0.0, 0.0, 0.125)


def number_of(context):
    return len(context.stream.late.draws)


def test_draws_under_matrices_of_their_own_are_late(context):
    for number in range(3):
        triangle()
        assert number_of(context) == number + 1
    shifts = [draw.modelview[2, 3] for draw in context.frame.commands]
    assert shifts == [0.0, 0.125, 0.25]
    assert number_of(context) == 0


@pytest.mark.parametrize("stack", [gl.GL_PROJECTION, gl.GL_TEXTURE])
def test_other_matrices_are_those_of_each_draw_too(context, stack):
    gl.glMatrixMode(stack)
    for number in range(3):
        triangle()
        assert number_of(context) == number + 1
    draws = context.frame.commands
    matrices = [draw.projection if stack == gl.GL_PROJECTION else draw.texture_matrices[0] for draw in draws]
    assert [matrix[2, 3] for matrix in matrices] == [0.0, 0.125, 0.25]


def test_draws_of_two_modes_in_turns_are_late(context):
    modes = [gl.GL_QUADS, gl.GL_LINE_LOOP] * 3
    for number, mode in enumerate(modes):
        if number == 4:
            gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glBegin(mode)
        for corner in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)):
            gl.glVertex2f(*corner)
        gl.glEnd()
    gl.glTranslatef(0.0, 0.0, 0.125)
    assert number_of(context) == len(modes)
    draws = context.frame.commands
    assert [draw.mode for draw in draws] == modes
    assert [draw.state.depth.enabled for draw in draws] == [False] * 4 + [True] * 2


def test_pairs_in_turns_with_lists_get_their_arrays_together(context):
    gl.glNewList(1, gl.GL_COMPILE)
    triangle()
    gl.glEndList()
    gl.glCallList(1)  # the first draw of a list is made at once
    gl.glFinish()
    for _ in range(3):
        triangle()
        gl.glCallList(1)
    assert number_of(context) == 6
    draws = context.frame.commands[1:]
    assert [draw.modelview[2, 3] for draw in draws] == [0.125 * n for n in range(1, 7)]
    assert len({id(draw.vertices.position.base) for draw in draws[::2]}) == 1
    assert len({id(draw.vertices) for draw in draws[1::2]}) == 1


def test_states_between_them_are_those_of_each_draw(context):
    for on in (True, False):
        (gl.glEnable if on else gl.glDisable)(gl.GL_DEPTH_TEST)
        triangle()
    assert number_of(context) == 2
    assert [draw.state.depth.enabled for draw in context.frame.commands] == [True, False]


def test_many_numbers_do_not_wait(context, monkeypatch):
    monkeypatch.setattr(late_draws, "MOST_NUMBERS", 24)
    triangle()
    assert number_of(context) == 1
    triangle()
    assert number_of(context) == 0
    assert len(context.stream.frame.commands) == 2


def test_a_large_pair_is_not_late(context):
    gl.glBegin(gl.GL_POINTS)
    for _ in range(pair_numbers.FEW + 1):
        gl.glVertex2f(0.0, 0.0)
    gl.glEnd()
    gl.glTranslatef(1.0, 0.0, 0.0)
    assert number_of(context) == 0
    assert len(context.stream.frame.commands) == 1


def test_whoever_looks_inside_a_pair_sees_the_draws_before(context):
    seen = []
    triangle()
    triangle(then=lambda: seen.append(context.storage.window.color.cells.copy()))
    assert (seen[0][:, : SIZE[0], :3] == 255).all()


def in_a_group(context):
    gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "group")


def with_another_offset_per_side(context):
    gl.glPolygonMode(gl.GL_FRONT, gl.GL_LINE)
    gl.glEnable(gl.GL_POLYGON_OFFSET_LINE)


def with_a_secondary_colour(context):
    gl.glSecondaryColor3f(1.0, 0.0, 0.0)


def to_select(context):
    gl.glSelectBuffer(16)
    gl.glRenderMode(gl.GL_SELECT)


@pytest.mark.parametrize("begin", [in_a_group, with_another_offset_per_side, with_a_secondary_colour, to_select])
def test_what_someone_is_told_about_is_not_late(context, begin):
    begin(context)
    triangle()
    assert number_of(context) == 0


def test_late_draws_to_a_framebuffer_come_before_its_attachment_changes(context):
    framebuffer()
    for number in range(3):
        triangle()
        assert number_of(context) == number + 1
    gl.glFramebufferTexture2D(*ATTACHED, 2, 0)
    assert number_of(context) == 0
    textures = context.storage.textures
    assert [textures[name].images[0, 0].cells.any() for name in (2, 3)] == [False, True]


def test_joined_pairs_are_one_late_draw(context):
    for x in range(3):
        gl.glBegin(gl.GL_POINTS)
        gl.glVertex2f(float(x), 0.0)
        gl.glEnd()
    gl.glLoadIdentity()
    gl.glTranslatef(1.0, 0.0, 0.0)
    assert number_of(context) == 1
    (draw,) = context.frame.commands
    assert draw.vertices.position[:, 0].tolist() == [0.0, 1.0, 2.0]


def test_joined_loops_are_one_late_draw_of_lines(context):
    for number in range(2):
        gl.glBegin(gl.GL_LINE_LOOP)
        for x in range(3):
            gl.glVertex2f(x / 4, number / 2)
        gl.glEnd()
    gl.glTranslatef(1.0, 0.0, 0.0)
    assert number_of(context) == 1
    (draw,) = context.frame.commands
    assert (draw.mode, draw.pairs_mode) == (gl.GL_LINES, gl.GL_LINE_LOOP)
    assert draw.indices.tolist() == [0, 1, 1, 2, 2, 0, 3, 4, 4, 5, 5, 3]


def test_a_quadric_is_drawn_after_them(context):
    triangle()
    gl.gluSphere(gl.gluNewQuadric(), 0.5, 24, 5)
    before, sphere = context.frame.commands
    assert (before.mode, before.pairs_mode) == (gl.GL_TRIANGLES, 0)
    assert sphere.pairs_mode == gl.GL_QUAD_STRIP
