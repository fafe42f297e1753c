"""glPushAttrib and glPopAttrib restore what Mesa restores, which is less than the specification demands."""

from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

SIZE = (8, 6)
Step = Callable[[Any], Any]


def color(gl: Any) -> None:
    gl.glColor3f(0.25, 0.5, 0.75)


def material(gl: Any) -> None:
    gl.glMaterialfv(gl.GL_FRONT, gl.GL_AMBIENT, (0.5, 0.25, 0.5, 1))


def shape(gl: Any) -> None:
    gl.glBegin(gl.GL_TRIANGLES)
    for corner in ((-1, -1), (1, -1), (0, 1)):
        gl.glVertex2f(*corner)
    gl.glEnd()


STEPS: dict[str, Step] = {
    "color": color,
    "material": material,
    "shape": shape,
    "front face": lambda gl: gl.glFrontFace(gl.GL_CW),
    "blend": lambda gl: gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ZERO),
    "depth function": lambda gl: gl.glDepthFunc(gl.GL_GREATER),
    "clear color": lambda gl: gl.glClearColor(0.25, 0, 0, 0),
    "matrix mode": lambda gl: gl.glMatrixMode(gl.GL_PROJECTION),
    "light": lambda gl: gl.glEnable(gl.GL_LIGHT3),
    "fog": lambda gl: gl.glEnable(gl.GL_FOG),
    "query color": lambda gl: gl.glGetFloatv(gl.GL_CURRENT_COLOR),
    "query viewport": lambda gl: gl.glGetIntegerv(gl.GL_VIEWPORT),
    "normal": lambda gl: gl.glNormal3f(1, 0, 0),
    "color material": lambda gl: gl.glEnable(gl.GL_COLOR_MATERIAL),
    "viewport": lambda gl: gl.glViewport(1, 1, 2, 2),
    "push polygon": lambda gl: gl.glPushAttrib(gl.GL_POLYGON_BIT),
    "push current": lambda gl: gl.glPushAttrib(gl.GL_CURRENT_BIT),
    "pop": lambda gl: gl.glPopAttrib(),
}
BITS = ("GL_CURRENT_BIT", "GL_LIGHTING_BIT", "GL_ENABLE_BIT", "GL_ALL_ATTRIB_BITS")


def left_by(bits: str, steps: tuple[str, ...], afterwards: tuple[str, ...] = ()) -> Callable[[Any], list[Any]]:
    """Return a program that pushes, makes the steps, pops, makes more steps, and returns the state."""

    def program(gl: Any) -> list[Any]:
        gl.glPushAttrib(getattr(gl, bits))
        for step in steps:
            STEPS[step](gl)
        gl.glPopAttrib()
        for step in afterwards:
            STEPS[step](gl)
        answers = [
            gl.glGetFloatv(gl.GL_CURRENT_COLOR),
            gl.glGetFloatv(gl.GL_CURRENT_NORMAL),
            gl.glGetMaterialfv(gl.GL_FRONT, gl.GL_AMBIENT),
            [int(gl.glIsEnabled(cap)) for cap in (gl.GL_LIGHT3, gl.GL_FOG, gl.GL_COLOR_MATERIAL)],
            [int(gl.glGetIntegerv(name)) for name in (gl.GL_FRONT_FACE, gl.GL_DEPTH_FUNC, gl.GL_MATRIX_MODE)],
            gl.glGetIntegerv(gl.GL_VIEWPORT),
        ]
        return [np.array(answer) for answer in answers]

    return program


TOLD = [
    ("GL_CURRENT_BIT", ("color",), ()),
    ("GL_CURRENT_BIT", ("color",), ("front face",)),
    ("GL_CURRENT_BIT", ("color",), ("shape",)),
    ("GL_CURRENT_BIT", ("color", "shape"), ("shape",)),
    ("GL_ALL_ATTRIB_BITS", ("front face", "color"), ()),
    ("GL_ALL_ATTRIB_BITS", ("front face", "color", "query color"), ()),
    ("GL_ALL_ATTRIB_BITS", ("front face", "color", "query viewport"), ()),
    ("GL_ALL_ATTRIB_BITS", ("blend", "color"), ()),
    ("GL_ALL_ATTRIB_BITS", ("viewport", "clear color", "matrix mode", "color"), ()),
    ("GL_CURRENT_BIT", ("push polygon", "color", "pop"), ()),
    ("GL_CURRENT_BIT", ("push polygon", "color", "query color", "pop"), ()),
    ("GL_CURRENT_BIT", ("push current", "color", "pop"), ("front face",)),
    ("GL_CURRENT_BIT", ("color", "push current", "pop"), ()),
    ("GL_LIGHTING_BIT", ("material",), ()),
    ("GL_LIGHTING_BIT", ("material", "shape"), ()),
    ("GL_ALL_ATTRIB_BITS", ("material",), ("shape",)),
    ("GL_ENABLE_BIT", ("light", "fog"), ()),
    ("GL_LIGHTING_BIT", ("light",), ()),
    ("GL_CURRENT_BIT", ("color material", "color", "shape"), ()),
]


@pytest.mark.mesa
@pytest.mark.parametrize(("bits", "steps", "afterwards"), TOLD)
def test_pop_leaves_what_mesa_leaves(bits, steps, afterwards):
    comparison = compare(left_by(bits, steps, afterwards), SIZE)
    assert comparison, str(comparison)


@pytest.mark.mesa
def test_random_steps_between_push_and_pop_leave_what_mesa_leaves():
    rng = np.random.default_rng(11)
    names = [name for name in STEPS if name != "pop" and "push" not in name]
    for _ in range(60):
        inside = [str(name) for name in rng.choice(names, rng.integers(1, 6))]
        if rng.random() < 0.5:
            at = int(rng.integers(len(inside) + 1))
            inside[at:] = [str(rng.choice(["push polygon", "push current"])), *inside[at:], "pop"]
        afterwards = tuple(str(name) for name in rng.choice(names, rng.integers(0, 3)))
        bits = str(rng.choice(BITS))
        comparison = compare(left_by(bits, tuple(inside), afterwards), SIZE)
        assert comparison, (bits, inside, afterwards, str(comparison))


NESTED_BITS = ("GL_HINT_BIT", "GL_LIST_BIT", "GL_PIXEL_MODE_BIT", "GL_TRANSFORM_BIT", "GL_EVAL_BIT", "GL_TEXTURE_BIT")
OUTSIDE_STATE: dict[str, Callable[[Any, int], Any]] = {
    "hint": lambda gl, n: gl.glHint(gl.GL_FOG_HINT, (gl.GL_DONT_CARE, gl.GL_NICEST, gl.GL_FASTEST)[n]),
    "list base": lambda gl, n: gl.glListBase(n),
    "zoom": lambda gl, n: gl.glPixelZoom(n + 1, 1),
    "scale": lambda gl, n: gl.glPixelTransferf(gl.GL_RED_SCALE, n),
    "matrix mode": lambda gl, n: gl.glMatrixMode((gl.GL_MODELVIEW, gl.GL_PROJECTION, gl.GL_TEXTURE)[n]),
    "unit": lambda gl, n: gl.glActiveTexture(gl.GL_TEXTURE0 + n),
    "grid": lambda gl, n: gl.glMapGrid1f(n + 1, 0, 1),
    "draw buffer": lambda gl, n: gl.glDrawBuffer((gl.GL_BACK, gl.GL_NONE, gl.GL_BACK)[n]),
    "index mask": lambda gl, n: gl.glIndexMask(n),
    "blend": lambda gl, n: (gl.glDisable if n else gl.glEnable)(gl.GL_BLEND),
    "lighting": lambda gl, n: (gl.glDisable if n else gl.glEnable)(gl.GL_LIGHTING),
    "texture": lambda gl, n: (gl.glDisable if n else gl.glEnable)(gl.GL_TEXTURE_2D),
    "binding": lambda gl, n: gl.glBindTexture(gl.GL_TEXTURE_2D, n),
    "filter": lambda gl, n: gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST + n % 2),
    "shape": lambda gl, n: shape(gl),
}
NUMBERS = (
    "GL_FOG_HINT", "GL_LIST_BASE", "GL_ZOOM_X", "GL_RED_SCALE", "GL_MATRIX_MODE", "GL_ACTIVE_TEXTURE",
    "GL_MAP1_GRID_SEGMENTS", "GL_DRAW_BUFFER", "GL_INDEX_WRITEMASK", "GL_BLEND", "GL_LIGHTING", "GL_TEXTURE_2D",
    "GL_TEXTURE_BINDING_2D",
)  # fmt: skip


def nested(seed: int) -> Callable[[Any], list[Any]]:
    """Return a program that changes what pops restore, in and between nested pushes; it returns all numbers."""

    def program(gl: Any) -> list[Any]:
        rng = np.random.default_rng(seed)
        gl.glReadBuffer(gl.GL_BACK)
        pushed, answers = 0, []
        for _ in range(40):
            choice = rng.random()
            if choice < 0.25 and pushed < 6:
                pushed += 1
                bits = [*NESTED_BITS, "GL_COLOR_BUFFER_BIT", "GL_ENABLE_BIT", *["GL_ALL_ATTRIB_BITS"] * 4]
                gl.glPushAttrib(getattr(gl, str(rng.choice(bits))))
            elif choice < 0.5 and pushed:
                pushed -= 1
                gl.glPopAttrib()
                answers.append([float(gl.glGetFloatv(getattr(gl, name))) for name in NUMBERS])
            else:
                OUTSIDE_STATE[str(rng.choice(list(OUTSIDE_STATE)))](gl, int(rng.integers(3)))
        gl.glDrawBuffer(gl.GL_BACK)
        return [np.array(answers)]

    return program


@pytest.mark.mesa
def test_nested_pushes_restore_what_mesa_restores():
    for seed in range(25):
        comparison = compare(nested(seed), SIZE)
        assert comparison, (seed, str(comparison))


def popped_elsewhere(bits: str, pushed_in: int, popped_in: int, changes: tuple[str, ...]) -> Callable[[Any], list[Any]]:
    """Return a program that pushes in one framebuffer and pops in another, and returns error codes and both buffers."""

    def program(gl: Any) -> list[Any]:
        objects = [0, *(int(name) for name in gl.glGenFramebuffers(2))]
        for name in objects[1:]:
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name)
            gl.glDrawBuffer(gl.GL_COLOR_ATTACHMENT0 + name)
            gl.glReadBuffer(gl.GL_COLOR_ATTACHMENT0 + name)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, objects[pushed_in])
        gl.glPushAttrib(getattr(gl, bits))
        for call in changes:
            getattr(gl, call)(gl.GL_NONE)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, objects[popped_in])
        with suppress(gl.GLError):
            gl.glPopAttrib()
        answers = [int(gl.glGetError())]
        for name in objects:
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name)
            answers += [int(gl.glGetIntegerv(each)) for each in (gl.GL_DRAW_BUFFER, gl.GL_READ_BUFFER)]
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        gl.glReadBuffer(gl.GL_BACK)  # the comparison reads the window
        return [np.array(answers)]

    return program


@pytest.mark.mesa
@pytest.mark.parametrize("bits", ["GL_COLOR_BUFFER_BIT", "GL_PIXEL_MODE_BIT", "GL_ALL_ATTRIB_BITS"])
@pytest.mark.parametrize(("pushed_in", "popped_in"), [(0, 1), (1, 0), (1, 2), (1, 1)])
def test_pop_in_another_framebuffer_leaves_what_mesa_leaves(bits, pushed_in, popped_in):
    for changes in ((), ("glDrawBuffer",), ("glReadBuffer",), ("glDrawBuffer", "glReadBuffer")):
        comparison = compare(popped_elsewhere(bits, pushed_in, popped_in, changes), SIZE)
        assert comparison, (changes, str(comparison))


@pytest.mark.mesa
@pytest.mark.parametrize("asks", [False, True])
def test_pop_restores_a_colour_like_that_of_the_vertices_before(asks):
    def program(gl):
        gl.glBegin(gl.GL_TRIANGLES)
        for x, y in ((-1, -1), (1, -1), (0, 1)):
            gl.glColor3f(1, x, y)
            gl.glVertex2f(x, y)
        gl.glEnd()
        if asks:  # then the colour is current, and vertices still carry one
            gl.glGetFloatv(gl.GL_CURRENT_COLOR)
        gl.glPushAttrib(gl.GL_CURRENT_BIT)
        gl.glColor3f(0, 0.5, 1)
        gl.glPopAttrib()
        return gl.glGetFloatv(gl.GL_CURRENT_COLOR)

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


GL_STENCIL_TEST_TWO_SIDE_EXT = 0x8910  # PyOpenGL has it in a module of its own
BACK_AND_FORTH = {  # changes of the lighting that are taken back before glPopAttrib
    "nothing": lambda gl: ((), ()),
    "depth test": lambda gl: ((gl.glEnable, gl.GL_DEPTH_TEST), (gl.glDisable, gl.GL_DEPTH_TEST)),
    "the same light": lambda gl: 2 * ((gl.glLightfv, gl.GL_LIGHT0, gl.GL_AMBIENT, (0, 0, 0, 1)),),
    "the same model": lambda gl: 2 * ((gl.glLightModeli, gl.GL_LIGHT_MODEL_TWO_SIDE, 0),),
    "the same shade model": lambda gl: 2 * ((gl.glShadeModel, int(str(int(gl.GL_SMOOTH)))),),  # another object
    "two-sided stencil test": lambda gl: (
        (gl.glEnable, GL_STENCIL_TEST_TWO_SIDE_EXT),
        (gl.glDisable, GL_STENCIL_TEST_TWO_SIDE_EXT),
    ),
    "lighting": lambda gl: ((gl.glDisable, gl.GL_LIGHTING), (gl.glEnable, gl.GL_LIGHTING)),
    "color material": lambda gl: ((gl.glDisable, gl.GL_COLOR_MATERIAL), (gl.glEnable, gl.GL_COLOR_MATERIAL)),
    "light": lambda gl: ((gl.glEnable, gl.GL_LIGHT1), (gl.glDisable, gl.GL_LIGHT1)),
    "shade model": lambda gl: ((gl.glShadeModel, gl.GL_FLAT), (gl.glShadeModel, gl.GL_SMOOTH)),
    "mode": lambda gl: (
        (gl.glColorMaterial, gl.GL_FRONT, gl.GL_DIFFUSE),
        (gl.glColorMaterial, gl.GL_FRONT_AND_BACK, gl.GL_AMBIENT_AND_DIFFUSE),
    ),
    "light's colour": lambda gl: (
        (gl.glLightfv, gl.GL_LIGHT0, gl.GL_AMBIENT, (0.5, 0.5, 0.5, 1)),
        (gl.glLightfv, gl.GL_LIGHT0, gl.GL_AMBIENT, (0, 0, 0, 1)),
    ),
}


@pytest.mark.mesa
@pytest.mark.parametrize("drawn_between", [False, True])
@pytest.mark.parametrize("bits", BITS)
@pytest.mark.parametrize("change", BACK_AND_FORTH)
def test_materials_that_follow_a_colour_return_with_a_lighting_that_has_changed(change, bits, drawn_between):
    def triangle(gl):
        gl.glColor4f(0.1, 0.4, 0.06, 0.96)
        gl.glRectf(-1, -1, 1, 0)

    def program(gl):
        gl.glEnable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_COLOR_MATERIAL)
        gl.glPushAttrib(getattr(gl, bits))
        away, back = BACK_AND_FORTH[change](gl)
        for call in (away, triangle, back) if drawn_between else (away, back, triangle):
            if call is triangle:
                triangle(gl)
            elif call:
                call[0](*call[1:])
        gl.glPopAttrib()
        gl.glRectf(-1, 0, 1, 1)

    comparison = compare(program, (8, 8))
    assert comparison, str(comparison)


EARLIER = {  # what comes before the push: does a shininess of 0 change anything after it?
    "never set": (),
    "set": ("shininess",),
    "set and drawn": ("shininess", "point"),
    "set and taken back": ("push", "shininess", "point", "pop"),
    "set again and taken back": ("shininess", "point", "push", "shininess", "point", "pop"),
}


@pytest.mark.mesa
@pytest.mark.parametrize("face", ["GL_FRONT", "GL_BACK", "GL_FRONT_AND_BACK"])
@pytest.mark.parametrize("earlier", EARLIER)
@pytest.mark.parametrize("is_vertex_attribute", [False, True])
def test_the_first_shininess_is_a_change_even_if_it_is_the_initial_one(is_vertex_attribute, earlier, face):
    """The change lets glPopAttrib restore all materials; they follow a colour that is set meanwhile."""

    def program(gl):
        def point(y):
            gl.glBegin(gl.GL_POINTS)
            gl.glVertex2f(0, y)
            gl.glEnd()

        calls = {
            "shininess": lambda: gl.glMaterialf(getattr(gl, face), gl.GL_SHININESS, 0.0),
            "point": lambda: point(-0.5),
            "push": lambda: gl.glPushAttrib(gl.GL_LIGHTING_BIT),
            "pop": gl.glPopAttrib,
        }
        gl.glEnable(gl.GL_COLOR_MATERIAL)
        for name in (*EARLIER[earlier], "push"):
            calls[name]()
        if not is_vertex_attribute:
            calls["shininess"]()
        gl.glBegin(gl.GL_POINTS)
        if is_vertex_attribute:
            calls["shininess"]()
        gl.glColor3f(0.4, 0.9, 0.5)
        gl.glVertex2f(0, -0.5)
        gl.glEnd()
        calls["pop"]()
        gl.glEnable(gl.GL_LIGHTING)
        point(0.5)

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


BEFORE_ARRAYS = {  # calls of the list before it draws arrays: a colour that is hidden returns first
    "hidden": ("push", "green", "pop"),
    "hidden after another": ("blue point", "push", "green", "pop"),
    "hidden, another drawn": ("push", "blue point", "green", "pop"),
    "set": ("green",),
}


@pytest.mark.mesa
@pytest.mark.parametrize("before", BEFORE_ARRAYS)
def test_arrays_that_a_list_draws_have_the_colour_that_returns(before):
    """With edge flags, they are drawn as by glDrawArrays, not as a glBegin ... glEnd pair."""
    corners, flags = np.float32([[-1, -1], [1, -1], [1, 1], [-1, 1]]), np.ones(4, np.uint8)

    def program(gl):
        def blue_point():
            gl.glBegin(gl.GL_POINTS)
            gl.glColor3f(0, 0, 1)
            gl.glVertex2f(0, 0)
            gl.glEnd()

        calls = {
            "push": lambda: gl.glPushAttrib(gl.GL_CURRENT_BIT),
            "green": lambda: gl.glColor3f(0, 1, 0),
            "blue point": blue_point,
            "pop": gl.glPopAttrib,
        }
        gl.glColor3f(1, 0, 0)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, corners)
        gl.glEdgeFlagPointer(0, flags)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glEnableClientState(gl.GL_EDGE_FLAG_ARRAY)
        gl.glNewList(1, gl.GL_COMPILE)
        for name in BEFORE_ARRAYS[before]:
            calls[name]()
        gl.glDrawArrays(gl.GL_QUADS, 0, 4)
        gl.glEndList()
        gl.glCallList(1)
        return gl.glGetFloatv(gl.GL_CURRENT_COLOR)

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)
