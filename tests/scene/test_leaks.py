"""Warnings about meshes that are not solid: what is wrong, how often, and where."""

import numpy as np
import pytest

from softshadow.errors import (
    DegenerateFaces,
    FarFromOrigin,
    LightInsideCaster,
    MisorientedMesh,
    NonManifoldMesh,
    OpenMesh,
    TJunction,
    UnweldedMesh,
    Warning,
)
from softshadow.scene import Camera, Light, Mesh, Scene, SceneObject, boundary, placement, shapes


def warnings_of(mesh: Mesh, light: tuple = (3, 5, 2), matrix: np.ndarray | None = None) -> dict[type[Warning], str]:
    """Return the warnings of a scene with only this mesh, by class."""
    scene = Scene("test", Camera((3, 3, 5), (0, 0, 0)), [Light(light)], [SceneObject(mesh, matrix)])
    return {type(warning): str(warning) for warning in scene.warnings()}


def box_with_split_edge(moved: float = 0.0) -> Mesh:
    """Return a box with an edge of its top split in two, but not of its front; the split may lie beside the edge."""
    box = shapes.box(1)
    corners = box.positions[box.topology.representatives]
    triangles = box.topology.triangles
    low, high = (int(np.flatnonzero((corners == corner).all(axis=1))[0]) for corner in ([-0.5, 0.5, 0.5], [0.5] * 3))
    (cut,) = [
        k for k, face in enumerate(triangles) if {low, high} <= set(face.tolist()) and (corners[face, 1] > 0).all()
    ]
    halves = [[len(corners) if c == end else c for c in triangles[cut].tolist()] for end in (low, high)]
    return Mesh([*corners, [0.1, 0.5 + moved, 0.5]], [*np.delete(triangles, cut, axis=0), *halves], name="crate")


def test_loops_of_an_open_mesh_are_counted_and_the_first_is_located() -> None:
    said = warnings_of(shapes.cylinder(segments=8, capped=False))
    assert list(said) == [OpenMesh]
    assert "16 boundary edges in 2 loops, the first at (" in said[OpenMesh]
    assert "volume-parity" in said[OpenMesh]


@pytest.mark.parametrize("moved", [0.0, 1e-6, -2e-6])
def test_a_vertex_within_an_edge_is_located(moved: float) -> None:
    said = warnings_of(box_with_split_edge(moved))
    assert list(said) == [OpenMesh, TJunction]
    assert "crate: 1 vertices lie within an edge of another face, the first at (0.1, 0." in said[TJunction]


def test_a_vertex_clearly_off_an_edge_is_no_t_junction() -> None:
    assert list(warnings_of(box_with_split_edge(0.01))) == [OpenMesh]


def test_a_t_junction_is_found_on_a_long_edge_among_short_ones() -> None:
    # a comb: 200 short edges along one long edge that crosses many cubes of the search grid
    top = [[k / 100 - 1, 0, 0] for k in range(201)]
    points = [*top, [0, 1, 0], [0, -1, 0]]
    comb = Mesh(points, [*[[k, k + 1, 201] for k in range(200)], [200, 0, 202]])
    assert len(boundary.boundary_of(comb).t_junctions) == 199


def test_positions_that_differ_in_a_last_digit_are_located() -> None:
    sphere = shapes.sphere(0.5, 12, 6)
    corners = sphere.positions[sphere.triangles.ravel()].astype(np.float64)
    noise = np.random.default_rng(1).uniform(-4e-7, 4e-7, corners.shape)
    said = warnings_of(Mesh(corners + noise, np.arange(len(corners)).reshape(-1, 3)))
    assert list(said) == [OpenMesh, UnweldedMesh]
    assert f"{len(corners)} boundary vertices lie next to another one" in said[UnweldedMesh]


def test_the_two_ends_of_a_short_edge_are_not_called_unwelded() -> None:
    sliver = Mesh([[0, 0, 0], [1e-6, 0, 0], [0, 1, 0], [3, 3, 3]], [[0, 1, 2]])
    assert list(warnings_of(sliver)) == [OpenMesh]


def test_in_a_large_soup_many_defects_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    sphere = shapes.sphere(0.5, 12, 6)
    corners = sphere.positions[sphere.triangles.ravel()].astype(np.float64)
    noise = np.random.default_rng(1).uniform(-4e-7, 4e-7, corners.shape)
    monkeypatch.setattr(boundary, "MOST_EXAMINED", 10)
    soup = Mesh(corners + noise, np.arange(len(corners)).reshape(-1, 3))
    assert len(boundary.boundary_of(soup).unwelded) > 100


def test_faces_that_disagree_about_the_outside_are_located() -> None:
    box = shapes.box()
    triangles = box.triangles.copy()
    triangles[0] = triangles[0, ::-1]
    said = warnings_of(Mesh(box.positions, triangles))
    assert list(said) == [MisorientedMesh]
    assert "at 3 edges two faces disagree about the outside, the first at (" in said[MisorientedMesh]


def test_an_edge_of_many_faces_is_located() -> None:
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, 0]]
    said = warnings_of(Mesh(corners, [[0, 1, 2], [0, 1, 3], [0, 1, 4]]))
    assert "1 edges have more than two faces, the first at (0, 0, 0) - (1, 0, 0)" in said[NonManifoldMesh]


def test_triangles_without_area_are_numbered() -> None:
    box = shapes.box()
    flat = Mesh([*box.positions, [1, 2, 3], [2, 4, 6], [3, 6, 9]], [*box.triangles, [0, 0, 1], [24, 25, 26]])
    said = warnings_of(flat)
    assert "2 of 14 triangles have no area, the first is triangle 12" in said[DegenerateFaces]


def test_a_light_in_a_closed_body_is_found_beside_an_open_one() -> None:
    box = shapes.box(2)
    both = Mesh([*box.positions, [5, 0, 0], [6, 0, 0], [5, 1, 0]], [*box.triangles, [24, 25, 26]])
    assert LightInsideCaster in warnings_of(both, (0.2, 0.1, 0))
    assert LightInsideCaster not in warnings_of(both, (5.2, 0.1, 0.1))
    assert LightInsideCaster in warnings_of(both, (1.2, 0.1, 0), placement((1, 0, 0)))


@pytest.mark.parametrize(("away", "named"), [(900, False), (1100, True), (-2000, True)])
def test_a_mesh_far_from_the_origin_is_named_with_the_precision_left(away: float, named: bool) -> None:
    box = shapes.box()
    said = warnings_of(Mesh(box.positions + np.float32([0, away, 0]), box.triangles))
    assert (FarFromOrigin in said) == named
    if named:
        assert "keeps its shape to 0.00012 only" in said[FarFromOrigin]
