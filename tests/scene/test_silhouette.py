"""Casting faces and the silhouette: closed loops of edges, with multiplicity."""

import numpy as np
import pytest
from hypothesis import given

from softshadow.scene import Mesh, casting_faces, shapes, silhouette
from strategies import closed_meshes, lights, open_meshes


def test_cube_seen_from_a_corner_has_a_silhouette_of_six_edges() -> None:
    outline = silhouette(shapes.box(), np.array([3.0, 4, 5, 1]))
    assert len(outline.edges) == 6
    assert outline.multiplicity.tolist() == [1] * 6


def test_edge_is_directed_as_in_the_face_towards_the_light() -> None:
    mesh = Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    towards = silhouette(mesh, np.array([0.0, 0, 1, 0]))
    assert sorted(map(tuple, towards.edges.tolist())) == [(0, 1), (1, 2), (2, 0)]
    away = silhouette(mesh, np.array([0.0, 0, -1, 0]))
    assert sorted(map(tuple, away.edges.tolist())) == [(0, 2), (1, 0), (2, 1)]


def test_face_edge_on_to_the_light_does_not_cast() -> None:
    faces = casting_faces(shapes.quad((0, 0, 0), (1, 0, 0), (0, 1, 0)), np.array([5.0, 5, 0, 1]))
    assert len(faces.facing) == len(faces.reversed) == 0


def test_closed_mesh_casts_with_the_faces_towards_the_light_only() -> None:
    box = shapes.box()
    faces = casting_faces(box, np.array([0.0, 5, 0, 1]))
    assert (box.face_normals[faces.facing, 1] > 0).all()
    assert len(faces.facing) == 2
    assert len(faces.reversed) == 0


def test_closed_body_beside_an_open_one_casts_as_if_alone() -> None:
    box, sheet = shapes.box(), [[5, 0, 0], [6, 0, 0], [5, 1, 0]]
    light = np.array([3.0, 4, -5, 1])  # behind the sheet
    both = Mesh([*box.positions, *sheet], [*box.triangles, [24, 25, 26]])
    faces = casting_faces(both, light)
    assert faces.facing.tolist() == casting_faces(box, light).facing.tolist()
    assert faces.reversed.tolist() == [12]
    assert len(silhouette(both, light).edges) == len(silhouette(box, light).edges) + 3


def test_fold_of_an_open_mesh_has_multiplicity_two() -> None:
    # a roof lit from the side: both slopes are turned to the light and use the ridge in the same direction
    roof = Mesh([[0, 1, 0], [0, 1, 1], [-1, 0, 0], [1, 0, 0]], [[0, 1, 3], [1, 0, 2]])
    outline = silhouette(roof, np.array([5.0, 0, 0.5, 1]))
    ridge = [set(edge) == {0, 1} for edge in outline.edges.tolist()]
    assert outline.multiplicity[ridge].tolist() == [2]


@pytest.mark.parametrize("strategy", [closed_meshes(), open_meshes()], ids=["closed", "open"])
def test_as_many_edges_end_at_a_vertex_as_start_there(strategy: object) -> None:
    @given(strategy, lights())
    def loops_close(mesh: Mesh, light: np.ndarray) -> None:
        outline = silhouette(mesh, light)
        balance = np.zeros(len(mesh.positions), dtype=int)
        np.add.at(balance, outline.edges[:, 0], outline.multiplicity)
        np.subtract.at(balance, outline.edges[:, 1], outline.multiplicity)
        assert not balance.any()

    loops_close()


@given(closed_meshes(), lights())
def test_faces_away_from_the_light_have_the_opposite_chain(mesh: Mesh, light: np.ndarray) -> None:
    """The other faces of a closed mesh have the same boundary, reversed."""
    away = np.setdiff1d(np.arange(len(mesh.triangles)), casting_faces(mesh, light).facing)
    topology = mesh.topology
    assert (topology.chain_sum(casting_faces(mesh, light).facing) == -topology.chain_sum(away)).all()


@pytest.mark.parametrize(
    "light", [[1, 2, 3], [0, 0, 0, 0], [1, 2, 3, -1], [1, np.nan, 3, 1]], ids=["three", "zero", "negative w", "nan"]
)
def test_malformed_light_is_refused(light: list[float]) -> None:
    with pytest.raises(ValueError, match="light: expected four finite numbers"):
        silhouette(shapes.box(), np.array(light, dtype=float))
