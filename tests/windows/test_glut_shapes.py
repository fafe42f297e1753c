"""Shapes of GLUT are computed once, and drawn in a few draws; `test_freeglut` compares them with freeglut's."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.context import Context
from softshadow.pipeline.commands import Draw
from softshadow.windows.glut import drawing
from softshadow.windows.glut.shapes import shape_calls

SHAPES = {
    "Sphere": (0.5, 8, 6), "Cone": (0.5, 0.7, 6, 2), "Cylinder": (0.5, 0.7, 6, 2), "Torus": (0.1, 0.4, 5, 7),
    "Cube": (0.5,), "Teapot": (0.5,), "Teacup": (0.5,), "Teaspoon": (0.5,), "Dodecahedron": (), "Icosahedron": (),
    "Octahedron": (), "RhombicDodecahedron": (), "Tetrahedron": (),
}  # fmt: skip


@pytest.fixture
def context() -> Iterator[Context]:
    with gl.create_context(8, 8) as context:
        yield context


def draws(context: Context) -> list[Draw]:
    return [command for command in context.frame.commands if isinstance(command, Draw)]


@pytest.mark.parametrize("kind", ["Solid", "Wire"])
@pytest.mark.parametrize("name", SHAPES)
def test_a_shape_drawn_again_has_the_same_arrays(context: Context, name: str, kind: str) -> None:
    call = shape_calls()[f"glut{kind}{name}"]
    call(*SHAPES[name])
    call(*SHAPES[name])
    drawn = draws(context)
    n = len(drawn) // 2
    assert 1 <= n <= 2
    for one, again in zip(drawn[:n], drawn[n:], strict=True):
        assert one.vertices is again.vertices
        assert one.indices is again.indices


def test_shapes_of_other_numbers_are_other_shapes(context: Context) -> None:
    sphere = shape_calls()["glutSolidSphere"]
    for numbers in ((0.5, 8, 6), (0.25, 8, 6), (0.5, 6, 8), (np.float64(0.5), 8, 6), (0.0, 8, 6), (-0.0, 8, 6)):
        sphere(*numbers)
    positions = [draw.vertices.position for draw in draws(context)]
    np.testing.assert_array_equal(positions[1][:, :3], positions[0][:, :3] / 2)
    assert len({each.tobytes() for each in positions}) == 5
    assert positions[3] is positions[0]


def test_the_latest_shapes_are_kept(context: Context, monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[Any] = []

    def make(number: int) -> drawing.Shape:
        made.append(number)
        surface = drawing.Surface(np.zeros((number, 3), np.float32), np.zeros((number, 3), np.float32))
        return drawing.Shape(surface, drawing.indices([[0]]))

    monkeypatch.setattr(drawing, "KEPT_SHAPES", 2)
    shape = drawing.kept(make)
    for number in (1, 2, 1, 3, 2, 1):
        shape(number)
    assert made == [1, 2, 3, 2, 1]
    monkeypatch.setattr(drawing, "MOST_VERTICES", 9)
    shape(10)
    shape(10)
    assert made[5:] == [10, 10]
    with pytest.raises(ValueError, match="read-only"):
        shape(1).surface.positions[0] = 1
