"""Shapes of strips in display lists: what is recorded at once is what comes of their calls."""

from collections.abc import Callable
from functools import partial
from random import Random
from typing import Any

import numpy as np
import pytest

from gl.test_joined_strips import random_shape
from softshadow import gl
from softshadow.gl import shape_calls
from softshadow.gl.list_primitives import ListPrimitive, SimilarPrimitives
from softshadow.gl.quadrics import GLUquadric
from softshadow.pipeline.commands import Draw


def contents(call: Callable[[], Any]) -> list[Any]:
    """Return what a call of a list does, without the calls that a primitive stands for."""
    if isinstance(call, SimilarPrimitives):
        return [row for primitive in call.primitives for row in contents(primitive)]
    if isinstance(call, ListPrimitive):
        rows = {slot: (array.dtype, array.shape, array.tobytes()) for slot, array in call.rows.items()}
        for slot, start in call.starts.items():  # those before are the current values of the call
            rows[slot] = (*rows[slot][:2], call.rows[slot][start:].tobytes())
        return [(call.mode, rows, call.starts, call.last, call.sizes, call.indices.tolist(), call.leaves_values)]
    assert isinstance(call, partial)
    return [(call.func, call.args)]


def compiled(program: Callable[[], None]) -> list[Any]:
    """Return the contents of a list of a program's calls."""
    gl.glNewList(1, gl.GL_COMPILE)
    program()
    gl.glEndList()
    return [row for call in gl.current().lists[1].calls for row in contents(call)]


def by_calls(program: Callable[[], None], monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Return what `compiled` returns if all calls of shapes are recorded."""
    with monkeypatch.context() as patch:
        patch.setattr(shape_calls, "is_open", lambda _: True)
        return compiled(program)


@pytest.mark.parametrize("precision", ["mesa", "exact"])
@pytest.mark.parametrize("seed", range(40))
def test_random_shapes_are_recorded_as_their_calls(seed: int, precision: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def program() -> None:
        random = Random(seed)
        for _ in range(3):
            if random.random() < 0.5:
                gl.glNormal3f(*[random.uniform(-1.0, 1.0) for _ in range(3)])
            random_shape(random).make()

    with gl.create_context(8, 8, precision=precision):
        assert compiled(program) == by_calls(program, monkeypatch)


@pytest.mark.parametrize("style", [gl.GLU_FILL, gl.GLU_LINE, gl.GLU_POINT, gl.GLU_SILHOUETTE])
@pytest.mark.parametrize("normals", [gl.GLU_SMOOTH, gl.GLU_FLAT, gl.GLU_NONE])
def test_quadrics_are_recorded_as_their_calls(style: int, normals: int, monkeypatch: pytest.MonkeyPatch) -> None:
    def program() -> None:
        for has_texture in (False, True):
            quadric = GLUquadric(normals, has_texture, gl.GLU_OUTSIDE, style)
            gl.gluSphere(quadric, 0.5, 7, 5)
            gl.gluCylinder(quadric, 0.5, 0.2, 1.0, 6, 2)
            gl.glTranslatef(0.1, 0.0, 0.0)
            gl.gluDisk(quadric, 0.0, 0.5, 6, 2)

    with gl.create_context(8, 8):
        assert compiled(program) == by_calls(program, monkeypatch)


def test_lists_with_the_same_sphere_have_primitives_of_their_own() -> None:
    """What is kept of a primitive in one list does not change another one."""
    quadric = gl.gluNewQuadric()
    with gl.create_context(8, 8) as context:
        for name in (1, 2):
            gl.glNewList(name, gl.GL_COMPILE)
            gl.gluSphere(quadric, 0.5, 6, 4)
            gl.glEndList()
        first, second = ([id(each) for each in context.lists[name].calls] for name in (1, 2))
        assert not {*first} & {*second}
        for _ in range(2):
            gl.glCallList(1)
        draws = [command for command in context.frame.commands if isinstance(command, Draw)]
    n = len(draws) // 2
    assert n > 0
    for one, again in zip(draws[:n], draws[n:], strict=True):
        assert one.vertices is again.vertices


def test_a_sphere_inside_of_a_primitive_of_a_list_is_an_error_of_its_calls() -> None:
    quadric = gl.gluNewQuadric()
    with gl.create_context(8, 8):
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glBegin(gl.GL_TRIANGLES)
        gl.glVertex2f(0.0, 0.0)
        gl.gluSphere(quadric, 0.5, 6, 4)
        gl.glEndList()
        with pytest.raises(gl.GLError, match="glBegin"):
            gl.glCallList(1)


def test_a_list_keeps_the_numbers_that_a_call_had() -> None:
    position = np.array([0.25, 0.5, 0.0, 1.0])
    with gl.create_context(8, 8):
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glRasterPos4fv(position)
        gl.glEndList()
        position[:] = 9.0
        gl.glCallList(1)
        assert gl.glGetFloatv(gl.GL_CURRENT_RASTER_POSITION)[:2].tolist() == [5.0, 6.0]
