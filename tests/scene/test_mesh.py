"""The arrays of a mesh, and the content that it refuses."""

import numpy as np
import pytest

from softshadow.errors import MeshError
from softshadow.scene import Mesh, shapes

TRIANGLE = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def test_arrays_are_converted_copied_and_read_only() -> None:
    positions = np.array(TRIANGLE, dtype=np.float64)
    mesh = Mesh(positions, [[0, 1, 2]])
    positions[0] = 7
    assert mesh.positions.dtype == np.float32
    assert mesh.triangles.dtype == np.int32
    assert mesh.positions[0].tolist() == [0, 0, 0]
    with pytest.raises(ValueError, match="read-only"):
        mesh.positions[0] = 1


def test_normals_are_computed_by_default() -> None:
    assert Mesh(TRIANGLE, [[0, 1, 2]]).normals.tolist() == [[0, 0, 1]] * 3


def test_vertex_without_a_face_has_a_finite_normal() -> None:
    assert Mesh([*TRIANGLE, [5, 5, 5]], [[0, 1, 2]]).normals[3].tolist() == [0, 0, 1]


@pytest.mark.parametrize(
    ("positions", "triangles", "said"),
    [
        (TRIANGLE, [[0, 1, 3]], "1 triangles use vertices that do not exist"),
        (TRIANGLE, [[0, 1, -1]], r"expected indices 0 to 2"),
        (TRIANGLE, [[0, 1, 2**40]], "do not exist"),
        (TRIANGLE, np.zeros((0, 3), int), "0 triangles; expected at least one"),
        (np.zeros((0, 3)), [[0, 1, 2]], "0 vertices"),
        ([[0, 0, 0], [1, np.nan, 0], [0, 1, 0]], [[0, 1, 2]], "vertex 1 at .*nan"),
        ([[0, 0, 0], [1, np.inf, 0], [0, 1, 0]], [[0, 1, 2]], "NaN, infinite"),
        ([[0, 0, 0], [1e39, 0, 0], [0, 1, 0]], [[0, 1, 2]], "infinite or beyond"),
        ([[0, 0, 0], [1e30, 0, 0], [0, 1, 0]], [[0, 1, 2]], "beyond 1e.18"),
        ([[0, 0, 0], [1, 1, 1], [2, 2, 2]], [[0, 1, 2]], "none of the 1 triangles has an area"),
    ],
)
def test_unusable_content_is_named(positions: object, triangles: object, said: str) -> None:
    with pytest.raises(MeshError, match=f"^thing: .*{said}"):
        Mesh(positions, triangles, name="thing")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"positions": [[0, 0], [1, 0], [0, 1]]}, r"positions: expected numbers of shape \(V, 3\)"),
        ({"positions": [["a", "b", "c"]]}, "positions: expected numbers"),
        ({"triangles": [[0.5, 1, 2]]}, r"triangles: expected integers of shape \(T, 3\)"),
        ({"triangles": [[0, 1, 2, 2]]}, r"got shape \(1, 4\)"),
        ({"normals": [[0, 0, 1]]}, r"normals: expected one row per vertex \(3\), got 1"),
        ({"texcoords": TRIANGLE}, r"texcoords: expected numbers of shape \(V, 2\)"),
        ({"colors": TRIANGLE}, r"colors: expected numbers of shape \(V, 4\)"),
    ],
)
def test_misuse_is_a_value_error_that_names_the_argument(arguments: dict, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        Mesh(**{"positions": TRIANGLE, "triangles": [[0, 1, 2]], **arguments})


def test_colors_that_are_not_finite_are_refused() -> None:
    with pytest.raises(MeshError, match="colors"):
        Mesh(TRIANGLE, [[0, 1, 2]], colors=np.full((3, 4), np.nan))


def test_bounds_leave_out_vertices_that_no_triangle_uses() -> None:
    assert Mesh([*TRIANGLE, [9, 9, 9]], [[0, 1, 2]]).bounds.tolist() == [[0, 0, 0], [1, 1, 0]]


def test_repr_is_short() -> None:
    assert repr(shapes.box()) == "Mesh('box', 24 vertices, 12 triangles)"
