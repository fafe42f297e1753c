"""Materials: set, following the current colour, and changing from vertex to vertex."""

from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from softshadow import gl
from softshadow.testing import compare, run_here

SIZE = (40, 30)
RED, GREEN = (1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0)


def diffuse(face: int) -> list[float]:
    return gl.glGetMaterialfv(face, gl.GL_DIFFUSE).tolist()


def test_followed_colour_is_the_material_until_it_is_switched_off():
    with gl.create_context(*SIZE):
        gl.glColorMaterial(gl.GL_FRONT, gl.GL_DIFFUSE)
        gl.glColor4f(*RED)
        gl.glEnable(gl.GL_COLOR_MATERIAL)
        assert diffuse(gl.GL_FRONT) == [*RED]
        gl.glColor4f(*GREEN)
        gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_DIFFUSE, RED)  # the front follows, the back does not
        assert (diffuse(gl.GL_FRONT), diffuse(gl.GL_BACK)) == ([*GREEN], [*RED])
        gl.glDisable(gl.GL_COLOR_MATERIAL)
        gl.glColor4f(*RED)
        assert diffuse(gl.GL_FRONT) == [*GREEN]


def test_last_colour_of_a_primitive_stays_the_material():
    with gl.create_context(*SIZE):
        gl.glEnable(gl.GL_COLOR_MATERIAL)
        gl.glBegin(gl.GL_TRIANGLES)
        gl.glColor4f(*RED)
        gl.glColor4f(*GREEN)
        gl.glEnd()
        assert diffuse(gl.GL_BACK) == [*GREEN]


def lit(namespace: Any) -> None:
    for capability in ("GL_LIGHTING", "GL_LIGHT0", "GL_NORMALIZE", "GL_DEPTH_TEST"):
        namespace.glEnable(getattr(namespace, capability))
    namespace.glLightfv(namespace.GL_LIGHT0, namespace.GL_POSITION, (1, 2, 3, 1))
    namespace.glMaterialfv(namespace.GL_FRONT_AND_BACK, namespace.GL_SPECULAR, (0.5, 0.5, 0.5, 1))
    namespace.glMaterialf(namespace.GL_FRONT_AND_BACK, namespace.GL_SHININESS, 20.0)


def test_material_between_begin_and_end_is_that_of_the_vertices_after_it():
    def in_one_primitive(namespace: Any) -> None:
        lit(namespace)
        namespace.glBegin(namespace.GL_QUADS)
        for color, left in ((RED, -0.9), (GREEN, 0.1)):
            namespace.glMaterialfv(namespace.GL_FRONT_AND_BACK, namespace.GL_AMBIENT_AND_DIFFUSE, color)
            for x, y in ((0, -1), (0.8, -1), (0.8, 1), (0, 1)):
                namespace.glVertex2f(left + x, y)
        namespace.glEnd()

    def in_two(namespace: Any) -> None:
        lit(namespace)
        for color, left in ((RED, -0.9), (GREEN, 0.1)):
            namespace.glMaterialfv(namespace.GL_FRONT_AND_BACK, namespace.GL_AMBIENT_AND_DIFFUSE, color)
            namespace.glBegin(namespace.GL_QUADS)
            for x, y in ((0, -1), (0.8, -1), (0.8, 1), (0, 1)):
                namespace.glVertex2f(left + x, y)
            namespace.glEnd()

    one, two = run_here(in_one_primitive, SIZE).color, run_here(in_two, SIZE).color
    np.testing.assert_array_equal(one, two)


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(4))
def test_materials_that_change_from_vertex_to_vertex_are_those_of_mesa(seed):
    def program(namespace: Any) -> None:
        rng = np.random.default_rng(seed)
        lit(namespace)
        face = namespace.GL_FRONT_AND_BACK
        namespace.glBegin(namespace.GL_TRIANGLES)
        for _ in range(9):
            name = str(rng.choice(["GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR", "GL_EMISSION"]))
            namespace.glMaterialfv(face, getattr(namespace, name), rng.random(4).tolist())
            if rng.integers(4) == 0:
                namespace.glMaterialf(face, namespace.GL_SHININESS, float(rng.uniform(1, 60)))
            namespace.glNormal3f(*rng.normal(size=3).tolist())
            namespace.glVertex3f(*rng.uniform(-1, 1, 3).tolist())
        namespace.glEnd()

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


MATERIAL_COLORS = st.sampled_from([(0.9, 0.3, 0.5), (0.1, 0.4, 0.8), (1.0, 1.0, 1.0)])
FACES = st.sampled_from(["GL_FRONT", "GL_FRONT_AND_BACK"])
FIELDS = st.sampled_from(["GL_AMBIENT", "GL_DIFFUSE", "GL_EMISSION", "GL_AMBIENT_AND_DIFFUSE"])
MATERIAL_CALLS = st.one_of(
    st.tuples(st.just("glMaterialfv"), FACES, FIELDS, MATERIAL_COLORS),
    st.tuples(st.sampled_from(["glEnable", "glDisable"]), st.just("GL_COLOR_MATERIAL")),
    st.tuples(st.just("glColor3f"), MATERIAL_COLORS),
    st.tuples(st.just("quad"), st.integers(0, 5), st.integers(0, 5)),
)


def make_material_calls(face: str, field: str, calls: list[tuple[Any, ...]], namespace: Any) -> None:
    lit(namespace)
    namespace.glColorMaterial(getattr(namespace, face), getattr(namespace, field))
    namespace.glDisable(namespace.GL_DEPTH_TEST)
    for name, *arguments in calls:
        if name == "quad":
            left, bottom = (3 * argument / 8 - 1 for argument in arguments)
            namespace.glBegin(namespace.GL_QUADS)
            for x, y in ((0, 0), (0.5, 0), (0.5, 0.5), (0, 0.5)):
                namespace.glVertex2f(left + x, bottom + y)
            namespace.glEnd()
        elif name == "glColor3f":
            namespace.glColor3f(*arguments[0])
        else:
            values = [getattr(namespace, value) if isinstance(value, str) else (*value, 1.0) for value in arguments]
            getattr(namespace, name)(*values)


@pytest.mark.mesa
@given(FACES, FIELDS, st.lists(MATERIAL_CALLS, min_size=3, max_size=14))
@example(
    "GL_FRONT_AND_BACK",
    "GL_AMBIENT_AND_DIFFUSE",
    [
        ("glMaterialfv", "GL_FRONT", "GL_DIFFUSE", (0.1, 0.4, 0.8)),
        ("glEnable", "GL_COLOR_MATERIAL"),
        ("glColor3f", (1.0, 1.0, 1.0)),  # the current colour, which does not displace the material
        ("quad", 2, 2),
    ],
)
@example(
    "GL_FRONT_AND_BACK",
    "GL_AMBIENT_AND_DIFFUSE",
    [
        ("glEnable", "GL_COLOR_MATERIAL"),
        ("glColor3f", (0.9, 0.3, 0.5)),
        ("glColor3f", (1.0, 1.0, 1.0)),
        ("quad", 2, 2),
    ],
)
@example(
    "GL_FRONT",
    "GL_AMBIENT",
    [
        ("glMaterialfv", "GL_FRONT", "GL_AMBIENT", (0.9, 0.3, 0.5)),
        ("glEnable", "GL_COLOR_MATERIAL"),
        ("glColor3f", (0.9, 0.3, 0.5)),
        ("glMaterialfv", "GL_FRONT", "GL_DIFFUSE", (0.9, 0.3, 0.5)),
        ("glColor3f", (1.0, 1.0, 1.0)),
        ("quad", 0, 0),
    ],
)
@example(
    "GL_FRONT",
    "GL_AMBIENT",
    [
        ("glMaterialfv", "GL_FRONT", "GL_AMBIENT", (0.9, 0.3, 0.5)),
        ("glEnable", "GL_COLOR_MATERIAL"),
        ("glColor3f", (0.1, 0.4, 0.8)),
        ("glEnable", "GL_COLOR_MATERIAL"),  # on already: nothing happens
        ("quad", 0, 0),
    ],
)
def test_colours_and_materials_in_any_order_are_those_of_mesa(
    face: str, field: str, calls: list[tuple[Any, ...]]
) -> None:
    comparison = compare(partial(make_material_calls, face, field, calls), SIZE)
    assert comparison, str(comparison)


@pytest.mark.mesa
@pytest.mark.parametrize("n_vertices", [6, 12])  # Mesa's vertices after glMaterial carry their colour after 8 at most
@pytest.mark.parametrize("with_material", [False, True])
def test_colours_after_a_material_are_carried_or_constant_as_in_mesa(n_vertices, with_material):
    def program(namespace: Any) -> None:
        namespace.gluPerspective(60, SIZE[0] / SIZE[1], 0.5, 10)
        namespace.glBegin(namespace.GL_TRIANGLES)
        for number in range(n_vertices):
            namespace.glVertex3f(number % 3 - 1, number % 2 - 1, -2)
        namespace.glEnd()
        if with_material:
            namespace.glMaterialfv(namespace.GL_FRONT, namespace.GL_DIFFUSE, RED)
        for level in (0.9, 0.7, 0.5, 0.3, 0.1):  # half-way between two of 255 levels: the last bit decides
            namespace.glColor3f(level, level, level)
            namespace.glBegin(namespace.GL_QUADS)
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                namespace.glVertex3f(2 * x * level, 2 * y * level, -2 + 0.7 * x + 0.3 * y)
            namespace.glEnd()

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)
