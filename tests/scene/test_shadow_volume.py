"""The shadow volume: exactly closed, with the mesh's own triangles as light cap, and long enough."""

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from softshadow.scene import Mesh, ShadowVolume, casting_faces, shadow_volume, shapes
from strategies import closed_meshes, lights, open_meshes

extrusions = st.one_of(st.just("infinite"), st.sampled_from([0.5, 20.0, 1000.0]))
generators = st.sampled_from(["silhouette", "per-polygon"])


def polygons(mesh: Mesh, volume: ShadowVolume) -> list[np.ndarray]:
    """Return all polygons of a volume as homogeneous points, counter-clockwise from outside."""
    near = np.concatenate([mesh.positions, np.ones((len(mesh.positions), 1), np.float32)], axis=1)
    caps = [near[triangle] for triangle in volume.light_cap]
    turned = [near[triangle[::-1]] for triangle in volume.light_cap_reversed]
    return [*caps, *turned, *volume.sides, *volume.dark_cap]


def directed_edge_sum(outlines: list[np.ndarray]) -> Counter:
    """Return, for each pair of points, the number of edges from the first to the second minus those back."""
    total: Counter = Counter()
    for outline in outlines:
        points = [tuple((point + 0.0).tolist()) for point in outline]  # adding 0 makes -0 equal to 0
        for start, end in pairwise([*points, points[0]]):
            if start != end:
                total[min(start, end), max(start, end)] += 1 if start < end else -1
    return total


@given(st.one_of(closed_meshes(), open_meshes()), lights(), generators, extrusions)
def test_every_edge_occurs_equally_often_in_both_directions(
    mesh: Mesh, light: np.ndarray, generator: str, extrusion: str | float
) -> None:
    volume = shadow_volume(mesh, light, generator=generator, extrusion=extrusion)
    assert not any(directed_edge_sum(polygons(mesh, volume)).values())


@given(st.one_of(closed_meshes(), open_meshes()), lights())
def test_both_generators_have_the_same_caps(mesh: Mesh, light: np.ndarray) -> None:
    one, other = (shadow_volume(mesh, light, generator=name) for name in ("silhouette", "per-polygon"))
    assert (one.light_cap == other.light_cap).all()
    assert (one.light_cap_reversed == other.light_cap_reversed).all()
    assert (one.dark_cap == other.dark_cap).all()


@given(st.one_of(closed_meshes(), open_meshes()), lights())
def test_light_cap_is_triangles_of_the_mesh_in_drawing_order(mesh: Mesh, light: np.ndarray) -> None:
    faces = casting_faces(mesh, light)
    volume = shadow_volume(mesh, light)
    assert (np.diff(faces.facing) > 0).all()
    assert (volume.light_cap == mesh.triangles[faces.facing]).all()
    assert (volume.light_cap_reversed == mesh.triangles[faces.reversed]).all()


# far corners are rounded to float32, by 6e-8 of their largest coordinate
ROUNDING = 1e-5


@given(st.one_of(closed_meshes(), open_meshes()), lights(), st.sampled_from([0.5, 20.0, 1000.0]))
def test_finite_volume_is_long_enough_behind_every_casting_face(mesh: Mesh, light: np.ndarray, reach: float) -> None:
    volume = shadow_volume(mesh, light, extrusion=reach)
    faces = np.concatenate([volume.light_cap, volume.light_cap_reversed[:, ::-1]])
    assume(len(faces))
    near = mesh.positions[faces].astype(np.float64)
    far = volume.dark_cap[:, ::-1, :3].astype(np.float64)
    if light[3]:
        scale = np.linalg.norm(far - light[:3], axis=2).max() / np.linalg.norm(near - light[:3], axis=2).max()
        normals = np.cross(near[:, 1] - near[:, 0], near[:, 2] - near[:, 0])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        distances = scale * ((light[:3] - near[:, 0]) * normals).sum(axis=1)
    else:
        distances = np.linalg.norm(far - near, axis=2)
    assert (distances >= reach * (1 - ROUNDING)).all()


def test_extrusion_is_measured_to_the_plane_not_to_the_vertices() -> None:
    # vertices are 10 from the light, the plane only 1: moving vertices to a distance of 20 leaves the plane at 2
    corners = np.array([[10, -1, 0], [-5, -1, 8.66], [-5, -1, -8.66]])
    volume = shadow_volume(Mesh(corners, [[0, 2, 1]]), np.array([0.0, 0, 0, 1]), extrusion=20.0)
    assert volume.dark_cap[0, :, 1] == pytest.approx(-20, rel=1e-6)  # rounding of float32


def test_infinite_far_points_are_directions_away_from_the_light() -> None:
    volume = shadow_volume(shapes.box(), np.array([3.0, 4, 5, 1]))
    near, far = volume.sides[:, 1], volume.sides[:, 2]
    assert (far[:, 3] == 0).all()
    assert far[:, :3] == pytest.approx(near[:, :3] - [3, 4, 5])


def test_sides_of_a_light_at_infinity_end_in_one_point() -> None:
    volume = shadow_volume(shapes.box(), np.array([1.0, 2, 3, 0]))
    assert volume.sides.shape == (6, 3, 4)
    assert (volume.sides[:, 2] == [-1, -2, -3, 0]).all()
    assert volume.dark_cap.shape == (0, 3, 4)


def test_finite_volume_of_a_light_at_infinity_has_both_caps() -> None:
    volume = shadow_volume(shapes.box(), np.array([0.0, 2, 0, 0]), extrusion=7.0)
    assert volume.sides.shape == (4, 4, 4)
    assert volume.dark_cap[:, :, 1] == pytest.approx(0.5 - 7)


def test_sides_face_outward() -> None:
    light = np.array([0.0, 5, 0, 1])
    sides = shadow_volume(shapes.box(), light, extrusion=30.0).sides.astype(np.float64)[:, :, :3]
    normals = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    assert (np.einsum("ij,ij->i", normals[:, [0, 2]], sides[:, 0][:, [0, 2]]) > 0).all()


def test_volume_without_caps_has_sides_only() -> None:
    volume = shadow_volume(shapes.box(), np.array([3.0, 4, 5, 1]), caps=False)
    assert len(volume.light_cap) == len(volume.dark_cap) == 0
    assert len(volume.sides) == 6


def test_light_inside_a_closed_mesh_gives_an_empty_volume() -> None:
    volume = shadow_volume(shapes.box(), np.array([0.0, 0, 0, 1]), extrusion=5.0)
    assert [len(part) for part in (volume.light_cap, volume.sides, volume.dark_cap)] == [0, 0, 0]


@given(lights())
def test_multiplicity_two_gives_two_sides(light: np.ndarray) -> None:
    roof = Mesh([[0, 1, 0], [0, 1, 1], [-1, 0, 0], [1, 0, 0]], [[0, 1, 3], [1, 0, 2]])
    both = casting_faces(roof, light)
    outline = shadow_volume(roof, light).sides
    assert len(outline) in ((4, 6) if len(both.facing) + len(both.reversed) == 2 else (0, 3))


@pytest.mark.parametrize("extrusion", ["far", 0.0, -1.0, float("inf"), float("nan")])
def test_impossible_extrusion_is_named(extrusion: str | float) -> None:
    with pytest.raises(ValueError, match="extrusion: expected 'infinite' or a reach"):
        shadow_volume(shapes.box(), np.array([3.0, 4, 5, 1]), extrusion=extrusion)


def test_unknown_generator_is_named() -> None:
    with pytest.raises(ValueError, match="generator: expected one of silhouette, per-polygon, got 'faces'"):
        shadow_volume(shapes.box(), np.array([3.0, 4, 5, 1]), generator="faces")
