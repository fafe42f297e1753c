"""Areas that silhouette edges hide of a light: their sum is what a caster hides, exactly."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from segment_slants import slants
from softshadow.scene import Disc, Light, LightShape, Mesh, Rectangle, SceneObject, Segment, Sphere, placement, shapes
from softshadow.scene.light_coverage import edge_shares, is_inside
from softshadow.scene.penumbra_wedge import silhouette_edges
from softshadow.truth import light_visibility

CENTER = np.array([0.2, 5.0, -0.1])
SHAPES: list[LightShape] = [
    Rectangle((1.1, 0, 0.2), (-0.1, 0.3, 0.55)),
    Disc(0.6, (0.2, 1, 0.1)),
    Sphere(0.7),
    Segment((0.8, 0.3, -0.4)),
]
EXACT = 1e-12  # a sum of a few areas in float64
each_shape = pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
seeds = st.integers(0, 2**32 - 1)


def star(seed: int) -> SceneObject:
    """Return a flat star-shaped polygon, convex or not, somewhere between the light and the floor."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(4, 9))  # and less than half a turn from each corner to the next
    angles = 2 * np.pi * (np.arange(n) + rng.uniform(-0.45, 0.45, n)) / n
    radii = rng.uniform(0.4, 1.4, n)
    rim = np.column_stack([radii * np.cos(angles), np.zeros(n), radii * np.sin(angles)])
    positions = np.concatenate([np.zeros((1, 3)), rim]).astype(np.float32)
    fan = np.array([(0, 1 + (i + 1) % n, 1 + i) for i in range(n)], np.int32)
    turn = (float(rng.uniform(-40, 40)), *rng.normal(size=3))
    place = np.array([0, 2.2, 0]) + rng.uniform(-0.5, 0.5, 3)
    return SceneObject(Mesh(positions, fan, name="star"), placement(place, turn), name="star")


def covered(casters: list[SceneObject], light: Light, points: np.ndarray) -> np.ndarray:
    """Hard count and shares of all edges together, (N,)."""
    ends = silhouette_edges(casters, light).ends
    point_light = Light(light.position)
    counts = sum(1 - light_visibility(points, point_light, [caster]).visible for caster in casters)
    return counts + np.array([edge_shares(ends, light, point).sum() for point in points])


def on_the_floor(seed: int, number: int = 30) -> np.ndarray:
    points = np.random.default_rng(seed).uniform(-3, 3, (number, 3))
    points[:, 1] = 0
    return points


@each_shape
@settings(max_examples=8)
@given(seed=seeds)
def test_shares_and_count_of_a_flat_caster_are_the_exact_area(shape: LightShape, seed: int) -> None:
    light, caster, points = Light(CENTER, shape=shape), star(seed), on_the_floor(seed)
    truth = light_visibility(points, light, [caster], method="exact").visible
    errors = covered([caster], light, points) - (1 - truth)
    if isinstance(shape, Segment):
        errors *= slants([caster], light, points)
    assert np.abs(errors).max() < EXACT


@each_shape
@settings(max_examples=25)
@given(seed=seeds)
def test_an_edge_whose_image_is_off_the_light_contributes_exactly_nothing(shape: LightShape, seed: int) -> None:
    rng = np.random.default_rng(seed)
    point = rng.normal(size=3) * [1, 0.5, 1]
    # beside the cone from the point to the sphere around the light
    towards = CENTER - point
    distance = np.linalg.norm(towards)
    sideways = np.cross(towards, rng.normal(size=3))
    sideways /= np.linalg.norm(sideways)
    farther = 1.2 * shape.bounding_radius / np.sqrt(1 - (shape.bounding_radius / distance) ** 2)
    ways = rng.uniform(0.1, 0.9, (20, 2, 1))
    across = np.cross(towards / distance, sideways) * rng.uniform(-5, 5, (20, 2, 1))
    edges = point + ways * (towards + farther * sideways + across)
    assert not edge_shares(edges, Light(CENTER, shape=shape), point).any()


@each_shape
def test_what_is_beyond_the_light_or_behind_the_point_hides_nothing(shape: LightShape) -> None:
    point = np.array([0.1, 0, 0.2])
    beyond = CENTER + (CENTER - point) * 0.5 + np.array([[[-2, 0.1, 0], [2, 0.3, 0]], [[0, 0.2, -2], [0.1, 0, 2]]])
    behind = point - (CENTER - point) * 0.5 + np.array([[[-2, 0.1, 0], [2, 0.3, 0]], [[0, 0.2, -2], [0.1, 0, 2]]])
    for edges in (beyond, behind):
        assert not edge_shares(edges, Light(CENTER, shape=shape), point).any()


@each_shape
@settings(max_examples=25)
@given(seed=seeds)
def test_visibility_does_not_jump_at_the_edge_of_the_hard_shadow(shape: LightShape, seed: int) -> None:
    light, rng = Light(CENTER, shape=shape), np.random.default_rng(seed)
    edge = rng.uniform(-1, 1, (1, 2, 3)) * [2, 0.5, 2] + [0, 2, 0]
    along, middle = edge[0, 1] - edge[0, 0], edge.mean(axis=1)[0]
    normal = np.cross(edge[0, 0] - CENTER, edge[0, 1] - CENTER)
    assume(np.linalg.norm(normal) > 0.5 and np.linalg.norm(along) > 0.5)
    normal /= np.linalg.norm(normal)
    behind = middle + (middle - CENTER) * rng.uniform(0.2, 1)
    step = 1e-7
    sides = [behind + step * normal, behind - step * normal]
    # the hard count is 1 on the inner side of the plane, and 0 on the other
    sums = [float(is_inside(edge - CENTER, p - CENTER)[0]) + edge_shares(edge, light, p)[0] for p in sides]
    assert abs(edge_shares(edge, light, behind)[0]) > 0.01
    # the smaller the angle between a segment and an edge, the farther a crossing moves with the edge
    slant = abs(normal @ shape.half_axes[0]) if isinstance(shape, Segment) else 1
    assert abs(sums[0] - sums[1]) < 100 / slant * step


@each_shape
@pytest.mark.parametrize("direction", [(1, 0, 0), (0.6, 0, 0.8)])
def test_coverage_falls_along_a_ray_across_the_band_of_a_straight_edge(
    shape: LightShape, direction: tuple[float, float, float]
) -> None:
    light = Light(CENTER, shape=shape)
    wall = SceneObject(shapes.floor(40), placement((-20, 2.5, 0)), name="half plane")  # ends at x = 0
    points = np.linspace(-3, 3, 200)[:, None] * np.array(direction)
    values = covered([wall], light, points)
    assert (np.diff(values) <= EXACT).all()
    assert values[0] == pytest.approx(1)
    assert values[-1] == pytest.approx(0)
    assert ((values > 0.01) & (values < 0.99)).sum() > 10


@each_shape
def test_a_small_light_has_the_hard_shadow_off_the_edge(shape: LightShape) -> None:
    caster, points = star(3), on_the_floor(3, 300)
    light = Light(CENTER, shape=shape.scaled(1e-9))
    values = covered([caster], light, points)
    assert (np.isin(values, [0.0, 1.0])).all()
    assert 0 < values.sum() < len(values)


def test_a_light_without_a_shape_and_points_that_see_no_area_get_nothing() -> None:
    edges = silhouette_edges([star(1)], Light(CENTER)).ends
    assert not edge_shares(edges, Light(CENTER), np.zeros(3)).any()
    in_plane = CENTER + np.array([3.0, 0, 0])
    for shape, point in (
        (Rectangle((1, 0, 0), (0, 0, 1)), in_plane),
        (Sphere(0.7), CENTER + np.array([0.3, 0, 0])),
        (Segment((1, 0, 0)), in_plane),
    ):
        assert not edge_shares(edges, Light(CENTER, shape=shape), point).any()


def test_what_two_casters_hide_is_added_where_they_overlap() -> None:
    light = Light((0, 4, 0), shape=Rectangle((1, 0, 0), (0, 0, 1)))
    # both end at the line that hides 0.4 of the light from the origin
    casters = [
        SceneObject(shapes.floor(40), placement((-20 - 0.1 * height / 4, height, 0)), name=f"at {height}")
        for height in (1, 2)
    ]
    origin = np.zeros((1, 3))
    for caster in casters:
        assert covered([caster], light, origin) == pytest.approx(0.4)
    assert covered(casters, light, origin) == pytest.approx(0.8)
    assert light_visibility(origin, light, casters).visible == pytest.approx(1 - 0.4)


def test_the_silhouette_of_the_centre_is_wrong_for_a_cube_near_a_large_light() -> None:
    cube = [SceneObject(shapes.box(), placement((0, 2.2, 0)), name="cube")]
    points = on_the_floor(1, 400)
    errors = {}
    for side in (0.25, 2.0):
        light = Light((0, 4, 0), shape=Rectangle((side, 0, 0), (0, 0, side)))
        hidden = 1 - light_visibility(points, light, cube, method="exact").visible
        errors[side] = np.abs(np.clip(covered(cube, light, points), 0, 1) - hidden).max()
    # from the centre only the top is seen; the sides hide more of the large light, not of the one as narrow as the top
    assert errors[0.25] < EXACT
    assert errors[2.0] > 0.3
