"""Immediate mode, vertex arrays, rectangles and display lists draw the same."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softshadow import gl
from softshadow.testing import compare, run_here

SIZE = (40, 30)
MODES = ("GL_TRIANGLES", "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN", "GL_QUADS", "GL_QUAD_STRIP", "GL_POLYGON")
COUNT = 9


def vertices(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Positions (COUNT, 3) and colours (COUNT, 3), float32."""
    rng = np.random.default_rng(seed)
    return rng.uniform(-1, 1, (COUNT, 3)).astype(np.float32), rng.random((COUNT, 3), np.float32)


def immediate(namespace: Any, mode: str, position: np.ndarray, color: np.ndarray) -> None:
    namespace.glBegin(getattr(namespace, mode))
    for vertex, rgb in zip(position.tolist(), color.tolist(), strict=True):
        namespace.glColor3f(*rgb)
        namespace.glVertex3f(*vertex)
    namespace.glEnd()


def pointers(namespace: Any, position: np.ndarray, color: np.ndarray) -> None:
    namespace.glEnableClientState(namespace.GL_VERTEX_ARRAY)
    namespace.glEnableClientState(namespace.GL_COLOR_ARRAY)
    namespace.glVertexPointer(3, namespace.GL_FLOAT, 0, position)
    namespace.glColorPointer(3, namespace.GL_FLOAT, 0, color)


def from_arrays(namespace: Any, mode: str, position: np.ndarray, color: np.ndarray) -> None:
    pointers(namespace, position, color)
    namespace.glDrawArrays(getattr(namespace, mode), 0, len(position))


def from_elements(namespace: Any, mode: str, position: np.ndarray, color: np.ndarray) -> None:
    order = np.random.default_rng(0).permutation(len(position)).astype(np.uint32)
    shuffled = np.empty_like(position), np.empty_like(color)
    shuffled[0][order], shuffled[1][order] = position, color
    pointers(namespace, *shuffled)
    namespace.glDrawElements(getattr(namespace, mode), len(order), namespace.GL_UNSIGNED_INT, order)


def from_list(namespace: Any, mode: str, position: np.ndarray, color: np.ndarray) -> None:
    name = namespace.glGenLists(1)
    namespace.glNewList(name, namespace.GL_COMPILE)
    immediate(namespace, mode, position, color)
    namespace.glEndList()
    namespace.glCallList(name)


def from_list_of_arrays(namespace: Any, mode: str, position: np.ndarray, color: np.ndarray) -> None:
    own = position.copy()
    pointers(namespace, own, color)
    namespace.glNewList(7, namespace.GL_COMPILE)
    namespace.glDrawArrays(getattr(namespace, mode), 0, len(own))
    namespace.glEndList()
    own[:] = 0  # the list has read it
    namespace.glCallList(7)


WAYS = (immediate, from_arrays, from_elements, from_list, from_list_of_arrays)


def pixels(way: Any, mode: str, seed: int) -> tuple[np.ndarray, ...]:
    def program(namespace: Any) -> None:
        namespace.glEnable(namespace.GL_DEPTH_TEST)
        way(namespace, mode, *vertices(seed))

    result = run_here(program, SIZE)
    return result.color, result.depth


@pytest.mark.parametrize("way", WAYS[1:])
@pytest.mark.parametrize("mode", ["GL_TRIANGLES", "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN", "GL_POLYGON"])
def test_every_way_of_drawing_gives_the_pixels_of_immediate_mode(way, mode):
    for mine, expected in zip(pixels(way, mode, 4), pixels(immediate, mode, 4), strict=True):
        np.testing.assert_array_equal(mine, expected)


@pytest.mark.mesa
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("mode", MODES)
def test_every_way_of_drawing_gives_the_pixels_of_mesa(way, mode):
    def program(namespace: Any) -> None:
        namespace.glEnable(namespace.GL_DEPTH_TEST)
        way(namespace, mode, *vertices(2))

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


@pytest.mark.mesa
@pytest.mark.parametrize(
    ("token", "dtype"),
    [("GL_UNSIGNED_BYTE", np.uint8), ("GL_BYTE", np.int8), ("GL_UNSIGNED_SHORT", np.uint16), ("GL_SHORT", np.int16),
     ("GL_UNSIGNED_INT", np.uint32), ("GL_INT", np.int32), ("GL_DOUBLE", np.float64)],
)  # fmt: skip
def test_colour_arrays_of_every_type_are_those_of_mesa(token, dtype):
    rng = np.random.default_rng(3)
    if dtype is np.float64:
        color = rng.random((COUNT, 3))
    else:
        limits = np.iinfo(dtype)
        color = rng.integers(limits.min, limits.max, (COUNT, 3), dtype, endpoint=True)

    def program(namespace: Any) -> None:
        pointers(namespace, vertices(1)[0], color)
        namespace.glColorPointer(3, getattr(namespace, token), 0, color)
        namespace.glDrawArrays(namespace.GL_TRIANGLES, 0, COUNT)

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


@pytest.mark.mesa
def test_rectangle_is_that_of_mesa():
    def program(namespace: Any) -> None:
        namespace.glEnable(namespace.GL_DEPTH_TEST)
        namespace.glMatrixMode(namespace.GL_PROJECTION)
        namespace.gluPerspective(60, 1.3, 1, 10)
        namespace.glMatrixMode(namespace.GL_MODELVIEW)
        namespace.glTranslatef(0, 0, -3)
        namespace.glRotatef(40, 1, 2, 3)
        namespace.glRectf(-0.7, -0.3, 0.4, 0.9)
        namespace.glColor3ub(9, 200, 30)
        namespace.glRectiv((-1, -1), (0, 0))

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


def test_stride_steps_over_what_lies_between_the_vertices():
    position, color = vertices(6)
    packed = np.concatenate([position, color], axis=1)
    with gl.create_context(*SIZE) as context:
        pointers(gl, packed, color)
        gl.glVertexPointer(3, gl.GL_FLOAT, packed.strides[0], packed)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, COUNT)
        drawn = context.frame.commands[-1].vertices.position
    np.testing.assert_array_equal(drawn[:, :3], position)


def test_array_is_copied_once_for_each_content():
    position, color = vertices(6)
    with gl.create_context(*SIZE) as context:
        pointers(gl, position, color)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, COUNT)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, COUNT)
        before = position.copy()
        position += 1
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, COUNT)
        first, second, third = (command.vertices.position for command in context.frame.commands)
    assert np.shares_memory(first, second)
    np.testing.assert_array_equal(second[:, :3], before)
    np.testing.assert_array_equal(third[:, :3], position)


def test_read_only_array_is_taken_as_it_is():
    position = np.ones((3, 4), np.float32)
    position.setflags(write=False)
    with gl.create_context(*SIZE) as context:
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(4, gl.GL_FLOAT, 0, position)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
        assert np.shares_memory(context.frame.commands[-1].vertices.position, position)


def test_array_that_is_too_short_is_not_read_past_its_end():
    with gl.create_context(*SIZE):
        pointers(gl, *vertices(0))
        with pytest.raises(ValueError, match=f"vertex 11 is outside the array of positions, which has {COUNT}"):
            gl.glDrawArrays(gl.GL_TRIANGLES, 0, 12)


def test_a_pair_without_vertices_draws_nothing():
    with gl.create_context(*SIZE) as context:
        gl.glBegin(gl.GL_QUADS)
        gl.glEnd()
        assert context.frame.commands == []


def ranges(namespace: Any) -> None:
    starts, counts = np.array([0, 2], np.int32), np.array([2, 3], np.int32)
    namespace.glMultiDrawArrays(namespace.GL_POINTS, starts, counts, 2)


def by_indices(namespace: Any) -> None:
    indices = np.array([3, 0, 1], np.uint32)
    namespace.glDrawElements(namespace.GL_POINTS, 3, namespace.GL_UNSIGNED_INT, indices)


def one_element(namespace: Any) -> None:
    namespace.glBegin(namespace.GL_POINTS)
    namespace.glArrayElement(1)
    namespace.glEnd()


DRAWN_AT_THE_ORIGIN = [lambda namespace: namespace.glDrawArrays(namespace.GL_POINTS, 2, 6), ranges, by_indices]


@pytest.mark.mesa
@pytest.mark.parametrize("list_mode", ["", "GL_COMPILE", "GL_COMPILE_AND_EXECUTE"])
@pytest.mark.parametrize("has_colors", [False, True])
@pytest.mark.parametrize("draw", [*DRAWN_AT_THE_ORIGIN, one_element])
def test_without_positions_vertices_are_at_the_origin_but_in_lists(draw, has_colors, list_mode):
    def program(namespace: Any) -> Any:
        namespace.glTranslatef(0.3, 0.2, 0.1)
        namespace.glBlendFunc(namespace.GL_ONE, namespace.GL_ONE)
        namespace.glEnable(namespace.GL_BLEND)
        namespace.glPointSize(5)
        if has_colors:
            pointers(namespace, *vertices(1))
            namespace.glDisableClientState(namespace.GL_VERTEX_ARRAY)
        if list_mode:
            namespace.glNewList(1, getattr(namespace, list_mode))
        draw(namespace)
        if list_mode:
            namespace.glEndList()
            namespace.glCallList(1)
        return [namespace.glReadPixels(0, 0, *SIZE, namespace.GL_RGB, namespace.GL_FLOAT)]

    (colors,) = run_here(program, SIZE).returned
    assert (colors.max() > 0) == (not list_mode and draw is not one_element)
    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


@pytest.mark.mesa
def test_an_array_of_positions_that_was_never_set_draws_nothing():
    def program(namespace: Any) -> Any:
        answers = []
        for call in (namespace.glDisableClientState, namespace.glEnableClientState):
            call(namespace.GL_VERTEX_ARRAY)
            for draw in DRAWN_AT_THE_ORIGIN:
                namespace.glClear(namespace.GL_COLOR_BUFFER_BIT)
                draw(namespace)
                answers.append(namespace.glReadPixels(0, 0, *SIZE, namespace.GL_RGB, namespace.GL_FLOAT))
        return answers

    visible = [colors.max() > 0 for colors in run_here(program, SIZE).returned]
    assert visible == [True] * 3 + [False] * 3
    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


@pytest.mark.mesa
def test_draws_without_positions_leave_nothing_behind():
    indices = np.array([3, 0, 1], np.uint32)
    indices.setflags(write=False)

    def program(namespace: Any) -> Any:
        answers = []

        def draw() -> None:
            namespace.glDrawElements(namespace.GL_POINTS, 3, namespace.GL_UNSIGNED_INT, indices)

        def read() -> None:
            answers.append(namespace.glReadPixels(0, 0, *SIZE, namespace.GL_RGB, namespace.GL_FLOAT))
            namespace.glClear(namespace.GL_COLOR_BUFFER_BIT)

        draw()
        read()
        namespace.glNewList(1, namespace.GL_COMPILE)
        draw()
        namespace.glEndList()
        namespace.glCallList(1)
        read()
        namespace.glEnableClientState(namespace.GL_VERTEX_ARRAY)
        draw()
        read()
        return answers

    visible = [colors.max() > 0 for colors in run_here(program, SIZE).returned]
    assert visible == [True, False, False]
    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


def test_a_billion_vertices_without_arrays_are_refused():
    with gl.create_context(*SIZE), pytest.raises(ValueError, match=r"no array is enabled .*: expected at most 1048576"):
        gl.glDrawArrays(gl.GL_POINTS, 0, 2**30)


@settings(max_examples=30)
@given(st.lists(st.sampled_from(["f", "d", "i", "s"]), min_size=3, max_size=3), st.integers(2, 4))
def test_variants_of_a_vertex_are_the_same_vertex(kinds, size):
    corners = [(3, -1, 2, 1), (0, 2, -1, 2), (-1, -2, 0, 1)]
    with gl.create_context(*SIZE) as context:
        for suffixes in (["f"] * 3, kinds, [f"{kind}v" for kind in kinds]):
            gl.glBegin(gl.GL_TRIANGLES)
            for suffix, corner in zip(suffixes, corners, strict=True):
                values = corner[:size]
                call = getattr(gl, f"glVertex{size}{suffix}")
                call(values) if suffix.endswith("v") else call(*values)
            gl.glEnd()
        (command,) = context.frame.commands  # nothing separates the three
        plain, other, of_vectors = np.split(command.vertices.position, 3)
    np.testing.assert_array_equal(plain, other)
    np.testing.assert_array_equal(plain, of_vectors)


def test_vertex_takes_colour_normal_and_texture_coordinates_along():
    with gl.create_context(*SIZE) as context:
        gl.glNormal3f(0, 1, 0)
        gl.glBegin(gl.GL_TRIANGLES)
        for index in range(3):
            gl.glColor4f(index, 0, 0, 0.5)
            gl.glTexCoord2f(index, 7)
            gl.glMultiTexCoord4f(gl.GL_TEXTURE2, 0, 0, index, 1)
            gl.glVertex2f(index, 0)
        gl.glEnd()
        drawn = context.frame.commands[-1].vertices
    np.testing.assert_array_equal(drawn.color, [[i, 0, 0, 0.5] for i in range(3)])
    np.testing.assert_array_equal(drawn.normal, [[0, 1, 0]] * 3)
    np.testing.assert_array_equal(drawn.texcoords[0], [[i, 7, 0, 1] for i in range(3)])
    np.testing.assert_array_equal(drawn.texcoords[2], [[0, 0, i, 1] for i in range(3)])


def test_debug_groups_name_the_draws_in_between():
    with gl.create_context(*SIZE) as context:
        gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "volumes")
        gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, 5, b"torus, front")
        gl.glRectf(0, 0, 1, 1)
        gl.glPopDebugGroup()
        gl.glPopDebugGroup()
        gl.glRectf(0, 0, 1, 1)
        assert [command.label for command in context.frame.commands] == ["volumes/torus", ""]
