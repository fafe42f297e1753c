"""Shadow silhouette maps: the points that cells store, the quarters they cut, and the edges that come out."""

from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from softshadow import programs
from softshadow import tokens as gl
from softshadow.image import FORMATS, Image
from softshadow.programs.silhouette_visibility import BESIDE, CORNERS, between, quarters
from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes
from softshadow.techniques.silhouette_points import stored_points
from softshadow.texture import Sampler, Texture
from techniques.drawn_frames import cast_rays, draw

SIDE = 16
NEAR, BETWEEN = 0.25, 0.5  # depths of the caster and of what is compared


def texture(cells: np.ndarray, form: int) -> Texture:
    image = Image.new(FORMATS[form], SIDE, SIDE)
    image.view[(..., slice(3)) if cells.ndim == 3 else ...] = cells  # colours have four channels in store
    return Texture(1, gl.GL_TEXTURE_2D, Sampler(min_filter=gl.GL_NEAREST, mag_filter=gl.GL_NEAREST), {(0, 0): image})


def visibility(depths: np.ndarray, points: np.ndarray, places: np.ndarray) -> np.ndarray:
    """The answer (N,) for places (N, 2) in texels between texel centres."""
    program, inputs = programs.get("silhouette-visibility"), np.ones((len(places), 4), np.float32)
    inputs[:, :2], inputs[:, 2] = (places + 0.5) / SIDE, BETWEEN
    uniforms: dict[str, Any] = {"side": float(SIDE)}
    uniforms["shadowMap"] = texture(depths, gl.GL_DEPTH_COMPONENT32F)
    uniforms["silhouetteMap"] = texture(points, gl.GL_RGB32F)
    out = np.empty((len(places), 4), np.float32)
    program.shade(inputs, {**program.uniforms, **uniforms}, out)
    return out[:, 3] == 1


# a line that is tilted by less has coordinates without a tilt, and lies on the other side of some texels
ANGLES = st.floats(0, 3.14).map(lambda angle: round(angle, 9))


@settings(max_examples=20)
@given(ANGLES, st.floats(-4, 4))
@example(1e-9, 1.5)
def test_a_straight_silhouette_across_the_map_is_exact(angle: float, shift: float) -> None:
    normal = np.array([np.cos(angle), np.sin(angle)])
    middle = np.full(2, SIDE / 2 - 0.5) + shift * normal
    y, x = np.mgrid[:SIDE, :SIDE]
    depths = np.where((np.stack([x, y], axis=-1) - middle) @ normal > 0, 1.0, NEAR).astype(np.float32)
    ends = middle + np.outer([-2 * SIDE, 2 * SIDE], [-normal[1], normal[0]])
    edge = np.concatenate([ends, np.full((2, 1), NEAR)], axis=1)
    points = stored_points(edge[None], depths)
    places = np.random.default_rng(1).uniform(1.5, SIDE - 2.5, (2000, 2))
    distance = (places - middle) @ normal
    sure = np.abs(distance) > 1e-4  # points are float32, in texels
    assert (visibility(depths, points, places) == (distance > 0))[sure].all()
    plain = visibility(depths, np.full((SIDE, SIDE, 3), 0.5), places)
    aligned = min(np.abs(normal)) < 0.05  # along the texels the steps may be where the line is
    assert aligned or (plain != (distance > 0))[sure].sum() > 10


def test_without_a_silhouette_the_nearest_texel_answers() -> None:
    depths = np.random.default_rng(2).random((SIDE, SIDE), np.float32)
    places = np.random.default_rng(3).uniform(0, SIDE - 1, (2000, 2))
    nearest = np.floor(places + 0.5).astype(int)
    expected = depths[nearest[:, 1], nearest[:, 0]] >= BETWEEN
    assert (visibility(depths, np.full((SIDE, SIDE, 3), 0.5), places) == expected).all()


def test_where_all_corners_agree_the_silhouette_does_not_matter() -> None:
    points = np.random.default_rng(4).random((SIDE, SIDE, 3), np.float32)
    places = np.random.default_rng(5).uniform(0, SIDE - 1, (500, 2))
    assert visibility(np.ones((SIDE, SIDE), np.float32), points, places).all()
    assert not visibility(np.zeros((SIDE, SIDE), np.float32), points, places).any()


@given(arrays(np.float64, (5, 2), elements=st.integers(0, 8).map(lambda k: k / 8)), st.floats(0, 6.28))
def test_quarters_cover_all_directions_once_whatever_the_points(points: np.ndarray, angle: float) -> None:
    own, *beside = points[:, None, :]
    ways = [point + np.array(at) - own for point, at in zip(beside, BESIDE, strict=True)]
    way = np.array([[np.cos(angle), np.sin(angle)]])
    if any(np.abs(one[:, 0] * way[:, 1] - one[:, 1] * way[:, 0])[0] < 1e-9 for one in ways):
        return  # on a line between two quarters, or a neighbour's point in the same place
    inside = [bool(between(ways[i], ways[(i + 1) % 4], way)[0]) for i in range(4)]
    assert sum(inside) == 1
    assert CORNERS[quarters(ways, way)[0]] == [(1, 1), (0, 1), (0, 0), (1, 0)][inside.index(True)]


def test_an_end_in_a_cell_is_stored_as_it_is_and_the_nearest_edge_wins() -> None:
    far_edge = [(3.1, 4.2, 0.6), (3.7, 4.9, 0.6)]
    near_edge = [(0.2, 4.5, 0.3), (3.25, 4.5, 0.3)]
    points = stored_points(np.array([near_edge, far_edge]), np.ones((SIDE, SIDE)))
    assert points[4, 3] == pytest.approx([0.25, 0.5, 1])
    assert points[4, 1] == pytest.approx([0.5, 0.5, 1])
    assert points[..., 2].sum() == 4


def test_an_edge_behind_a_surface_is_not_stored() -> None:
    edge = np.array([[(1.3, 2.4, 0.6), (9.2, 7.7, 0.6)]])
    assert stored_points(edge, np.ones((SIDE, SIDE)))[..., 2].any()
    assert not stored_points(edge, np.full((SIDE, SIDE), 0.5))[..., 2].any()


@pytest.mark.parametrize("name", ["boxes", "spotlight", "overlapping"])
def test_edges_on_the_floor_are_nearer_to_the_truth_than_those_of_the_texels(name: str) -> None:
    scene, size = Scene.named(name), (160, 120)
    truth = cast_rays(scene, size)
    lit = (truth.counts[0] == 0) & scene.lights[0].shines_on(truth.points)
    wrong = {
        technique: ((draw(technique, scene, size=size, map_size=64).maps["visibility"] == 1) != lit)[
            truth.objects == 0
        ].sum()
        for technique in ("map", "map-silhouette")
    }
    assert 3 * wrong["map-silhouette"] < wrong["map"]


def test_pixels_fall_back_only_where_corners_differ() -> None:
    drawn = draw("map-silhouette", Scene.named("overlapping"), map_size=64)
    cut = drawn.maps["quadrants"] < 4
    assert (drawn.maps["silhouette points"][..., 2] == 1).any()
    assert not (drawn.maps["fall-back"] & ~cut).any()
    assert (cut & ~drawn.maps["fall-back"]).any()


def test_four_corners_take_twice_the_slope_offset_of_one() -> None:
    roof = SceneObject(shapes.floor(2, 1), placement((0, 1, 0), (35, 1, 0, 0.3)), receives=True, name="roof")
    slope = Scene("slope", Camera((3, 4, 6), (0, 1, 0), fov_y=20, near=1, far=30), (Light((-2.5, 5, 1)),), (roof,))
    acne = {
        factor: draw("map-silhouette", slope, map_size=32, units=0.0, factor=factor).shadow.sum()
        for factor in (0.0, 2.0)
    }
    assert acne[0.0] > 40
    assert acne[2.0] == 0
