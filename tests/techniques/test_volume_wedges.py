"""Penumbra wedges: exact for one flat caster, hard for a point, continuous, and wrong where their limits say so."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import softshadow as ss
from segment_slants import slants
from softshadow.errors import EdgeNearLight
from softshadow.inspection import soft_truth
from softshadow.inspection.hard_truth import own_faces, seen_faces
from softshadow.scene import Disc, Light, LightShape, Rectangle, Scene, SceneObject, Segment, Sphere, placement, shapes
from softshadow.scene.penumbra_wedge import SilhouetteEdges
from softshadow.techniques.wedge_passes import WIDEST, edge_texture
from softshadow.truth import light_visibility
from techniques.drawn_frames import draw

pytestmark = pytest.mark.filterwarnings("ignore::softshadow.OpenMesh", "ignore::softshadow.EdgeNearLight")

SIZE = (64, 48)
# the visible point is float32, 2^-22 of a few units off; the visibility changes by at most a few per unit
FLOAT_PRECISION = 1e-5
AT_ITS_POINTS = 5e-6  # at the points that the run has: what float32 areas of wedges lose, some 2^-22 for each edge
SHAPES: list[LightShape] = [
    Rectangle((1, 0, 0.2), (-0.1, 0.3, 0.5)),
    Disc(0.5, (0.2, 1, 0.1)),
    Sphere(0.6),
    Segment((0.8, 0.2, -0.4)),
]
each_shape = pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)


def with_light(scene: Scene, **changes: Any) -> Scene:
    return replace(scene, lights=tuple(replace(light, **changes) for light in scene.lights))


FLOOR = Scene.named("soft-slab").objects[0]
CAMERA = Scene.named("soft-slab").camera
SQUARE = Rectangle((1, 0, 0), (0, 0, 1))


def over_the_floor(light: Light, *casters: SceneObject) -> Scene:
    return Scene("over the floor", CAMERA, (light,), (FLOOR, *casters))


def errors_on_the_floor(scene: Scene, size: tuple[int, int] = SIZE, **options: Any) -> np.ndarray:
    """Return visibility less the exact one, at the pixels where both the run and the rays see the floor."""
    run, truth = ss.run("volume-wedges", scene, size=size, **options), soft_truth(scene, size, method="exact")
    height = run.maps["positions"][..., 1] + scene.lights[0].position[1]
    floor = run.valid & (np.abs(height) < 1e-4) & (seen_faces(scene, size)[0].reshape(run.valid.shape) == 0)
    assert floor.sum() > 500
    return (run.visibility - truth.visibility)[floor]


def errors_at_its_points(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Return what `errors_on_the_floor` returns, with the exact visibility of the points that the run has in float32.

    So it does not matter how narrow a penumbra is. Then return these points.
    """
    run, (light,) = ss.run("volume-wedges", scene, size=SIZE), scene.lights
    objects, triangles, _ = seen_faces(scene, SIZE)
    points = run.maps["positions"].reshape(-1, 3) + np.array(light.position)[:3]  # those of a run begin at the light
    floor = run.valid.ravel() & (np.abs(points[:, 1]) < 1e-4) & (objects == 0)
    assert floor.sum() > 500
    exclude = own_faces(scene, objects[floor], triangles[floor])
    truth = light_visibility(points[floor], light, scene.casters, exclude=exclude, method="exact")
    return run.visibility.ravel()[floor] - truth.visible, points[floor]


@each_shape
@settings(max_examples=5)
@example(seed=198)  # an edge is almost parallel to the segment
@example(seed=671)  # in a narrow penumbra, the float32 point matters more than all else
@given(seed=st.integers(0, 2**32 - 1))
def test_one_flat_convex_caster_is_exact_to_float_precision(shape: LightShape, seed: int) -> None:
    rng = np.random.default_rng(seed)
    turn = (float(rng.uniform(-40, 40)), *rng.normal(size=3))
    sheet = SceneObject(shapes.floor(float(rng.uniform(0.8, 2))), placement((0.2, 1.5, 0), turn), name="sheet")
    light = Light((rng.uniform(-0.8, 0.8), rng.uniform(3.5, 5), rng.uniform(-0.8, 0.8)), shape=shape)
    scene = over_the_floor(light, sheet)
    errors, points = errors_at_its_points(scene)
    if isinstance(shape, Segment):
        errors *= slants(scene.casters, light, points)
    assert np.abs(errors).max() < AT_ITS_POINTS


def test_the_slab_is_exact_and_takes_all_kinds_of_pixels() -> None:
    scene = Scene.named("soft-slab")
    assert np.abs(errors_on_the_floor(scene)).max() < FLOAT_PRECISION
    visibility = draw("volume-wedges", scene, SIZE).maps["visibility"]
    assert (visibility == 0).any()
    assert ((visibility > 0) & (visibility < 1)).sum() > 100


@pytest.mark.parametrize("name", ["boxes", "torus", "overlapping", "eye-in-shadow", "room", "open-tube"])
def test_without_a_shape_the_shadow_is_that_of_zfail_bit_for_bit(name: str) -> None:
    scene = Scene.named(name)
    wedges, zfail = draw("volume-wedges", scene, SIZE), draw("volume-zfail", scene, SIZE)
    assert (wedges.maps["visibility"] == zfail.maps["visibility"]).all()
    assert (wedges.image == zfail.image).all()


@each_shape
def test_a_tiny_light_gives_the_hard_picture_where_its_visibility_is_0_or_1(shape: LightShape) -> None:
    scene = with_light(Scene.named("boxes"), shape=shape.scaled(1e-6))
    wedges, zfail = draw("volume-wedges", scene, SIZE), draw("volume-zfail", scene, SIZE)
    visibility = wedges.maps["visibility"]
    hard = (visibility == 0) | (visibility == 1)
    assert (~hard).sum() <= 2
    assert (visibility == zfail.maps["visibility"])[hard].all()
    assert (wedges.image == zfail.image)[hard].all()


@pytest.mark.parametrize("name", ["eye-in-shadow", "near-cut", "light-between", "open-tube", "overlapping", "torus"])
def test_planes_of_sides_count_as_the_depth_test_does(name: str) -> None:
    scene = with_light(Scene.named(name), shape=Sphere(1e-6))
    wedges, zfail = draw("volume-wedges", scene, SIZE), draw("volume-zfail", scene, SIZE)
    counted = next(zfail.stencil[title] for title in zfail.titles if title.startswith("count front faces"))
    # but for single pixels on edges of the hard shadow
    assert ((wedges.maps["count"] != counted) & wedges.maps["valid"]).sum() <= 1


def test_spot_lights_and_several_lights() -> None:
    scene = Scene.named("boxes")
    lights = (
        Light((-2.2, 4.2, 2.2), (0.4, 0.4, 0.4), "lamp", shape=Sphere(0.3)),
        Light((2, 4, 1), (0.3, 0.3, 0.3), "spot", axis=(-0.4, -1, -0.2), cutoff=20),
        Light((0.3, 1, 0.2, 0), (0.3, 0.3, 0.3), "sun"),
    )
    all_of_them = draw("volume-wedges", replace(scene, lights=lights), SIZE)
    for light in lights:
        alone = draw("volume-wedges", replace(scene, lights=(light,)), SIZE).maps["visibility"]
        assert (all_of_them.maps[f"visibility of {light.name}"] == alone).all()
        if light.shape is None:
            hard = draw("volume-zfail", replace(scene, lights=(light,)), SIZE).maps["visibility"]
            assert (alone == hard).all()
    assert {"positions: lamp", "count: spot", "coverage: sun"} <= all_of_them.maps.keys()


def test_exact_precision_is_nearer_to_the_exact_area() -> None:
    exact = ss.run("volume-wedges", "soft-slab", size=SIZE, precision="exact")
    truth = soft_truth(exact.scene, SIZE, method="exact")
    assert np.abs(exact.visibility - truth.visibility)[exact.valid & truth.valid].max() < 2e-7


def test_maps_add_up() -> None:
    maps = draw("volume-wedges", Scene.named("soft-torus"), (160, 120)).maps
    difference = maps["count"] + maps["taken"] - maps["given back"] - maps["coverage"]
    assert np.abs(difference).max() < 1e-6
    assert (maps["visibility"] == np.clip(np.float32(1) - maps["coverage"], 0, 1))[maps["valid"]].all()
    quiet = maps["wedges"] == 0
    assert (maps["coverage"] == maps["count"])[quiet].all()
    assert (maps["wedges"] > 2).any()


@pytest.mark.filterwarnings("ignore::softshadow.CoarseDepth")
def test_count_and_wedges_have_to_agree_at_the_edge_of_the_hard_shadow() -> None:
    # so small a near distance leaves few depths for the scene, and near edges the depth test errs
    scene = replace(Scene.named("soft-slab"), camera=replace(CAMERA, near=0.001))
    agreed, disagreed = (errors_on_the_floor(scene, (160, 120), decide=decide) for decide in ("planes", "depth"))
    assert np.abs(agreed).max() < FLOAT_PRECISION
    # at the edge, half of the light is visible; where they disagree, all or nothing
    wrong = np.abs(disagreed) > FLOAT_PRECISION
    assert wrong.any()
    assert np.allclose(np.abs(disagreed)[wrong], 0.5, atol=0.01)


def test_a_light_near_an_edge_is_reported_and_its_wedges_reach_everywhere() -> None:
    sheet = SceneObject(shapes.floor(3), placement((0, 2.5, 0)), name="sheet")
    scene = over_the_floor(Light((0, 4, 0), shape=Rectangle((3, 0, 0), (0, 0, 3))), sheet)
    assert draw("volume-wedges", scene, SIZE).warnings == [EdgeNearLight]
    with pytest.warns(EdgeNearLight, match="the lines of 4 of 4 silhouette edges"):
        assert np.abs(errors_on_the_floor(scene)).max() < FLOAT_PRECISION


def test_what_overlapping_casters_hide_is_added() -> None:
    scene = Scene.named("soft-overlap")
    together = errors_on_the_floor(scene)
    alone = [errors_on_the_floor(replace(scene, objects=[FLOOR, caster])) for caster in scene.casters]
    assert all(np.abs(errors).max() < 0.04 for errors in alone)  # the centre sees other edges of a thick slab
    assert together.min() < -0.2
    assert together.max() < 0.04


def test_the_silhouette_of_the_centre_is_wrong_near_a_large_light() -> None:
    cube = SceneObject(shapes.box(), placement((0, 2.2, 0)), name="cube")
    small, large = (
        np.abs(errors_on_the_floor(over_the_floor(Light((0, 4, 0), shape=SQUARE.scaled(side)), cube))).max()
        for side in (0.5, 2.5)
    )
    # the small light sees the top only, from all its places; below the large one, the lower edges hide more
    assert small < FLOAT_PRECISION
    assert 0.4 < large < 0.6


@pytest.mark.parametrize("number", [0, 1, WIDEST, WIDEST + 1, 3 * WIDEST])
def test_edges_are_found_at_their_places_in_the_texture(number: int) -> None:
    ends = np.random.default_rng(number).normal(size=(number, 2, 3))
    light = Light((1, 2, 3), shape=Sphere(1))
    with ss.gl.create_context(8, 8):
        edges = edge_texture(ss.gl, SilhouetteEdges(ends, np.zeros(number, int)), light)
        texels = ss.gl.glGetTexImage(ss.gl.GL_TEXTURE_2D, 0, ss.gl.GL_RGBA, ss.gl.GL_FLOAT)
    rows, columns = texels.shape[:2]
    assert edges.row_height == 1 / rows
    x, y = (edges.places * [columns, rows]).astype(int).T
    for end in (0, 1):
        assert np.allclose(texels[y + end, x, :3], ends[:, end] - [1, 2, 3], atol=1e-6)
