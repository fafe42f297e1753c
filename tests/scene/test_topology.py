"""Topology by position: closed and open meshes, bodies, and defects."""

import numpy as np
import pytest
from hypothesis import given

from softshadow.scene import Mesh, shapes
from softshadow.scene.topology import weld
from strategies import closed_meshes, open_meshes

TRIANGLE = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
SOLID_SHAPES = [
    shapes.box(),
    shapes.wall(),
    shapes.stairs(),
    shapes.tetrahedron(),
    shapes.sphere(),
    shapes.torus(),
    shapes.cylinder(),
    shapes.sphere(0.5, 3, 2),
    shapes.torus(1, 0.2, 3, 3),
]


@pytest.mark.parametrize("mesh", SOLID_SHAPES, ids=lambda mesh: mesh.name)
def test_solid_shape_is_closed_in_spite_of_split_normals(mesh: Mesh) -> None:
    assert mesh.topology.closed
    assert mesh.topology.describe() == "closed, 1 body"
    assert len(mesh.topology.representatives) < len(mesh.positions)


def test_cube_has_eight_positions_and_eighteen_edges() -> None:
    topology = shapes.box().topology
    assert len(topology.representatives) == 8
    assert len(topology.edges) == 18
    assert (topology.edge_faces == 2).all()


def test_open_tube_has_a_boundary_at_both_ends() -> None:
    topology = shapes.cylinder(segments=12, capped=False).topology
    assert not topology.closed
    assert topology.boundary_edges == 24
    assert topology.describe() == "open, 1 body: 24 boundary edges"


def test_minus_zero_is_the_same_position_as_zero() -> None:
    ids, _ = weld(np.array([[0.0, 1, 2], [-0.0, 1, 2]], dtype=np.float32))
    assert ids[0] == ids[1]


def test_positions_one_float_apart_are_not_welded() -> None:
    ids, _ = weld(np.array([[1, 0, 0], [np.nextafter(np.float32(1), np.float32(2)), 0, 0]], dtype=np.float32))
    assert ids[0] != ids[1]


def test_edge_of_two_faces_that_disagree_about_the_outside_is_misoriented() -> None:
    topology = Mesh([*TRIANGLE, [1, 1, 0]], [[0, 1, 2], [1, 2, 3]]).topology  # both use the edge from 1 to 2
    assert (topology.misoriented_edges, topology.nonmanifold_edges) == (1, 0)
    assert topology.boundary_edges == 4


def test_edge_of_three_faces_is_nonmanifold() -> None:
    fan = [[0, 1, 2], [0, 1, 3], [0, 1, 4]]
    assert Mesh([*TRIANGLE, [0, 0, 1], [0, -1, 0]], fan).topology.nonmanifold_edges == 1


def test_face_with_two_equal_positions_has_no_edges() -> None:
    topology = Mesh([*TRIANGLE, [1, 0, 0]], [[0, 1, 2], [1, 3, 2]]).topology
    assert topology.degenerate_faces == 1
    assert topology.boundary_edges == 3


def test_bodies_are_counted_over_shared_positions() -> None:
    far = np.add(TRIANGLE, 5)
    assert Mesh([*TRIANGLE, *far], [[0, 1, 2], [3, 4, 5]]).topology.bodies == 2
    long_strip = [[i, i + 1, i + 2] for i in range(400)]
    corners = [(i, i % 2, 0) for i in range(402)]
    assert Mesh(corners, long_strip).topology.bodies == 1


def test_an_open_body_does_not_open_the_closed_one_beside_it() -> None:
    box = shapes.box()
    sheet = np.add(TRIANGLE, 5)
    both = Mesh([*sheet, *box.positions], [[0, 1, 2], *(box.triangles + 3)]).topology
    assert not both.closed
    assert both.closed_faces.tolist() == [False] + [True] * 12
    touching = Mesh([*np.add(TRIANGLE, 0.5), *box.positions], [[0, 1, 2], *(box.triangles + 3)]).topology
    assert not touching.closed_faces.any()  # at a corner: one body


@given(open_meshes())
def test_faces_that_share_positions_form_a_body(mesh: Mesh) -> None:
    topology = mesh.topology
    together = (topology.triangles[:, None, :, None] == topology.triangles[None, :, None, :]).any(axis=(2, 3))
    for _ in range(len(mesh.triangles)):
        together = together @ together
    assert (together == (topology.face_bodies[:, None] == topology.face_bodies)).all()


@given(closed_meshes())
def test_closed_mesh_stays_closed_however_its_vertices_move(mesh: Mesh) -> None:
    assert mesh.topology.closed


@given(open_meshes())
def test_edge_sum_is_the_sum_over_the_faces_one_by_one(mesh: Mesh) -> None:
    topology = mesh.topology
    sums = dict.fromkeys(map(tuple, topology.edges.tolist()), 0)
    for face in topology.triangles.tolist():
        if len(set(face)) == 3:
            for u, v in zip(face, [*face[1:], face[0]], strict=True):
                sums[min(u, v), max(u, v)] += 1 if u < v else -1
    assert list(sums.values()) == topology.edge_sums.tolist()


@given(open_meshes())
def test_representative_has_the_position_of_its_vertices(mesh: Mesh) -> None:
    topology = mesh.topology
    assert (mesh.positions[topology.representatives[topology.vertex_ids]] == mesh.positions).all()
