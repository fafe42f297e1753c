"""Penumbra wedges: each step of their construction, what they contain, and their surfaces."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softshadow.scene import Disc, Light, LightShape, Rectangle, SceneObject, Segment, Sphere, placement, shapes
from softshadow.scene.light_coverage import edge_shares
from softshadow.scene.penumbra_wedge import (
    TRIANGLES,
    PenumbraWedges,
    penumbra_wedges,
    silhouette_edges,
    wedge_polyhedra,
)
from softshadow.scene.shadow_volume import shadow_volume

ROUNDING = 1e-9  # of distances of a few units in float64
CENTER = np.array([0.3, 4.0, -0.2])
SHAPES: list[LightShape] = [
    Rectangle((1.1, 0, 0.2), (-0.1, 0.3, 0.55)),
    Disc(0.6, (0.2, 1, 0.1)),
    Sphere(0.7),
    Segment((0.8, 0.3, -0.4)),
]


def random_edges(seed: int, number: int = 20) -> np.ndarray:
    """Return edges (number, 2, 3) below the light, none of which reaches it."""
    return np.random.default_rng(seed).uniform(-1, 1, (number, 2, 3)) * [2, 1, 2] + [0, 1, 0]


def wedges_of(seed: int, radius: float) -> tuple[np.ndarray, PenumbraWedges]:
    edges = random_edges(seed)
    wedges = penumbra_wedges(edges, CENTER, radius)
    return edges[~wedges.everywhere], penumbra_wedges(edges[~wedges.everywhere], CENTER, radius)


def distances(planes: np.ndarray, points: np.ndarray) -> np.ndarray:
    return (planes[:, :3] * points).sum(axis=1) + planes[:, 3]


@settings(max_examples=25)
@given(st.integers(0, 2**32 - 1), st.floats(0.01, 1))
def test_each_step_of_the_construction(seed: int, radius: float) -> None:
    _, wedges = wedges_of(seed, radius)
    near, far, moved = wedges.near_end, wedges.far_end, wedges.moved_end
    # step 1: both ends are equally far, and the moved one is on the line from the centre to the far end
    to_near, to_far, to_moved = (np.linalg.norm(end - CENTER, axis=1) for end in (near, far, moved))
    assert (to_near <= to_far).all()
    assert np.allclose(to_moved, to_near)
    assert np.allclose((moved - CENTER) / to_moved[:, None], (far - CENTER) / to_far[:, None])
    # step 2: front and back contain the edge; step 3: right and left contain one end each
    for planes, ends in ((wedges.front, (near, moved)), (wedges.back, (near, moved)), (wedges.right, (moved,)),
                         (wedges.left, (near,))):  # fmt: skip
        assert np.allclose(np.linalg.norm(planes[:, :3], axis=1), 1)
        assert all(np.abs(distances(planes, end)).max(initial=0) < ROUNDING for end in ends)
        # all touch the sphere; step 4: it is behind them
        assert np.abs(distances(planes, CENTER) + radius).max(initial=0) < ROUNDING
    # they separate the light from the other end
    assert (distances(wedges.right, near) >= -ROUNDING).all()
    assert (distances(wedges.left, moved) >= -ROUNDING).all()
    # and are perpendicular to the plane of edge and centre
    across = np.cross(near - CENTER, moved - CENTER)
    for planes in (wedges.right, wedges.left):
        assert np.abs((across * planes[:, :3]).sum(axis=1)).max(initial=0) < ROUNDING


@settings(max_examples=25)
@given(st.integers(0, 2**32 - 1), st.floats(0.01, 1))
def test_a_wedge_contains_all_points_that_see_its_edge_in_front_of_the_sphere(seed: int, radius: float) -> None:
    edges, wedges = wedges_of(seed, radius)
    rng = np.random.default_rng(seed)
    for number, (start, end) in enumerate(edges):
        on_edge = start + rng.random((50, 1)) * (end - start)
        on_sphere = rng.normal(size=(50, 3))
        on_sphere = CENTER + radius * on_sphere / np.linalg.norm(on_sphere, axis=1, keepdims=True)
        points = on_edge + rng.uniform(ROUNDING, 3, (50, 1)) * (on_edge - on_sphere)
        planes = wedges[number].planes
        assert (points @ planes[:, :3].T + planes[:, 3] > -ROUNDING).all()
        beyond_rounding = (points @ planes[:, :3].T + planes[:, 3] > ROUNDING).all(axis=1)
        assert wedges.contains(points)[beyond_rounding, number].all()
        assert wedges[number].contains(points)[beyond_rounding].all()


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
@settings(max_examples=25)
@given(seed=st.integers(0, 2**32 - 1))
def test_an_edge_contributes_nothing_outside_its_wedge(shape: LightShape, seed: int) -> None:
    edges = random_edges(seed)
    wedges = penumbra_wedges(edges, CENTER, shape.bounding_radius)
    points = np.random.default_rng(seed).uniform(-4, 4, (40, 3)) - [0, 2, 0]
    light = Light(CENTER, shape=shape)
    for point in points:
        contributing = edge_shares(edges, light, point) != 0
        assert not (contributing & ~wedges.contains(point)).any()


def test_the_lines_of_some_edges_meet_the_sphere() -> None:
    towards = np.array([[[0.4, 0, 0], [0.35, 3, 0]], [[-3, 3.8, 0], [3, 3.8, 0]], [[-3, 2, 0], [3, 2, 0]]], float)
    wedges = penumbra_wedges(towards, np.array([0, 4, 0]), 0.5)
    # the first points at the light, but with equally far ends it passes by
    assert wedges.everywhere.tolist() == [False, True, False]
    anywhere = np.random.default_rng(1).normal(size=(100, 3)) * 10
    assert wedges.contains(anywhere)[:, 1].all()
    assert not wedges.contains(anywhere)[:, 2].all()


def test_an_edge_that_points_at_the_centre_is_no_wedge_of_numbers_that_are_none() -> None:
    wedges = penumbra_wedges(np.array([[[0.0, 1, 0], [0, 2, 0]]]), np.array([0, 4.0, 0]), 0.5)
    assert np.isfinite(wedges.planes).all()
    assert not wedges.everywhere.any()
    assert wedges.contains(np.array([0.0, 0, 0])).all()


@settings(max_examples=25)
@given(st.integers(0, 2**32 - 1), st.floats(0.01, 1))
def test_surfaces_are_closed_convex_and_counter_clockwise_from_outside(seed: int, radius: float) -> None:
    _, wedges = wedges_of(seed, radius)
    triangles, owners = wedge_polyhedra(wedges)
    directed = [pair for names in TRIANGLES for pair in zip(names, (*names[1:], names[0]), strict=True)]
    assert len(set(directed)) == len(directed)
    assert {(end, start) for start, end in directed} == set(directed)
    for number in range(len(wedges)):
        corners = triangles[owners == number].astype(np.float64)
        assert len(corners) == len(TRIANGLES)
        unique = np.unique(corners.reshape(-1, 4), axis=0)
        for triangle in corners:
            # the volume spanned with a corner is positive if the triangle is counter-clockwise seen from outside
            volumes = [np.linalg.det(np.stack([*triangle, corner])) for corner in unique]
            assert min(volumes) > -1e-5  # corners are float32


def test_a_wedge_that_is_all_of_space_is_drawn_as_a_box_at_infinity() -> None:
    wedges = penumbra_wedges(np.array([[[-1, 3.9, 0], [1, 3.9, 0]]]), np.array([0, 4.0, 0]), 0.5)
    triangles, owners = wedge_polyhedra(wedges)
    assert triangles.shape == (12, 3, 4)
    assert not triangles[..., 3].any()
    assert (owners == 0).all()
    normals = np.cross(triangles[:, 1, :3] - triangles[:, 0, :3], triangles[:, 2, :3] - triangles[:, 0, :3])
    assert ((normals * triangles[:, 0, :3]).sum(axis=1) > 0).all()


def test_edges_are_in_the_order_of_the_sides_of_the_volumes() -> None:
    casters = [
        SceneObject(shapes.box(), placement((1, 0.5, 0), (30, 0, 1, 0)), name="box"),
        SceneObject(shapes.cylinder(0.5, 1, capped=False), placement((-1, 1, 0), (20, 1, 0, 0)), name="tube"),
    ]
    light = Light((0, 5, 1), shape=Sphere(0.3))
    edges = silhouette_edges(casters, light)
    assert (np.diff(edges.casters) >= 0).all()
    for number, caster in enumerate(casters):
        sides = shadow_volume(caster.mesh, light.in_object_space(caster.object_to_world)).sides
        v, u = sides[:, 0, :3].astype(float), sides[:, 1, :3].astype(float)
        matrix = caster.object_to_world
        expected = np.stack([u, v], axis=1) @ matrix[:3, :3].T + matrix[:3, 3]
        assert np.allclose(edges.ends[edges.casters == number], expected)
