"""Shapes: outward faces, the right volume, and normals that match the faces."""

import numpy as np
import pytest

from softshadow.scene import Mesh, shapes
from softshadow.scene.plane import flat_plane

# inscribed polyhedra have slightly smaller volumes than the smooth solids
VOLUMES = [
    (shapes.box(1, 2, 3), 6.0, 1e-6),
    (shapes.wall(3, 2, 0.1), 0.6, 1e-6),
    (shapes.stairs(3, 2, 0.5, 1), 2 * 0.5 * 1 * (1 + 2 + 3), 1e-6),
    (shapes.tetrahedron(3), 9.0, 1e-6),
    (shapes.sphere(1, 64, 32), 4 / 3 * np.pi, 0.01),
    (shapes.torus(1, 0.25, 64, 32), 2 * np.pi**2 * 0.0625, 0.01),
    (shapes.cylinder(0.5, 2, 64), np.pi / 2, 0.01),
]


@pytest.mark.parametrize(("mesh", "volume", "below"), VOLUMES, ids=lambda value: getattr(value, "name", ""))
def test_faces_point_outward_and_enclose_the_volume(mesh: Mesh, volume: float, below: float) -> None:
    assert mesh.signed_volume == pytest.approx(volume, rel=below)


@pytest.mark.parametrize("mesh", [case[0] for case in VOLUMES], ids=lambda mesh: mesh.name)
def test_normals_are_unit_and_on_the_side_of_their_face(mesh: Mesh) -> None:
    assert np.linalg.norm(mesh.normals, axis=1) == pytest.approx(1, abs=1e-6)  # rounding of float32
    for corner in range(3):
        assert ((mesh.face_normals * mesh.normals[mesh.triangles[:, corner]]).sum(axis=1) > 0).all()


def test_quad_faces_across_times_up() -> None:
    plane = flat_plane(shapes.quad((0, 0, 0), (2, 0, 0), (0, 3, 0)))
    assert plane.tolist() == [0, 0, 1, 0]


def test_floor_faces_up_and_is_divided_into_cells() -> None:
    mesh = shapes.floor(4, cells=3)
    assert len(mesh.triangles) == 18
    assert flat_plane(mesh).tolist() == [0, 1, 0, 0]


@pytest.mark.parametrize("mesh", [shapes.floor(), shapes.sphere(), shapes.torus(), shapes.cylinder(capped=False)])
def test_texture_coordinates_fill_the_unit_square(mesh: Mesh) -> None:
    assert mesh.texcoords.min(axis=0).tolist() == [0, 0]
    assert mesh.texcoords.max(axis=0).tolist() == [1, 1]


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: shapes.sphere(segments=2), "segments: expected at least 3, got 2"),
        (lambda: shapes.torus(sides=1), "sides: expected at least 3"),
        (lambda: shapes.stairs(0), "steps: expected at least 1"),
        (lambda: shapes.quad((0, 0, 0), (1, 0, 0), (2, 0, 0)), "parallel"),
        (lambda: shapes.box(-1), "width: expected a positive length, got -1"),
        (lambda: shapes.sphere(0), "radius: expected a positive length"),
    ],
)
def test_impossible_parameter_is_named(make: object, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        make()


@pytest.mark.parametrize(
    "mesh",
    [
        shapes.box(),
        Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0.5, 0.5, 0]], [[0, 1, 3], [0, 3, 2]]),  # a notch
        Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.01]], [[0, 1, 2], [1, 3, 2]]),  # bent
        Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 1]]),  # both sides
    ],
    ids=["solid", "notch", "bent", "both sides"],
)
def test_mesh_that_is_not_one_flat_convex_polygon_has_no_plane(mesh: Mesh) -> None:
    assert flat_plane(mesh) is None
