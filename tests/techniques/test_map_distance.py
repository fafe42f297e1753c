"""Distance maps: what is stored, and a bias that is the same distance everywhere."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes
from softshadow.techniques import get
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.map_distance import texel_width
from softshadow.truth import first_faces
from strategies import floor_scenes
from techniques.drawn_frames import cast_rays, draw, off_the_edges

SIZE = (160, 120)
WITHOUT_BIAS = {"bias": 0.0, "normal_bias": 0.0}
# of a position in the light's view, and of its length: a few roundings to 2^-24 of numbers up to the eye's distance
DISTANCE_ROUNDING = 16 * 2.0**-24


def light_distances(scene: Scene, camera: LightCamera, map_size: int) -> np.ndarray:
    """The distance of the first caster along the ray through each texel centre, by ray casting; far where none is."""
    centres = (np.arange(map_size) + 0.5) / map_size * 2 - 1
    t, s = (grid.ravel() for grid in np.meshgrid(centres, centres, indexing="ij"))
    right, up, forward = camera.frame
    aside = camera.half * (s[:, None] * right + t[:, None] * up)
    origin = camera.eye + aside if camera.parallel else np.broadcast_to(camera.eye, aside.shape)
    along = np.broadcast_to(forward, aside.shape) if camera.parallel else forward + aside
    distance = first_faces(origin, along, scene.casters)[2] * np.linalg.norm(along, axis=1)
    return np.where(np.isfinite(distance), distance, camera.far).reshape(map_size, map_size)


@settings(max_examples=10)
@given(floor_scenes())
def test_map_holds_the_distance_of_the_first_caster_seen_from_the_light(scene: Scene) -> None:
    stored = draw("map-distance", scene, map_size=32).maps["distances"]
    camera = light_camera(scene, scene.lights[0])
    expected = light_distances(scene, camera, 32)
    # a texel whose centre is on an edge may have the distance of either face, so of a neighbour
    lowest, highest = (
        extreme([np.roll(expected, (y, x), (0, 1)) for y in (-1, 0, 1) for x in (-1, 0, 1)], axis=0)
        for extreme in (np.min, np.max)
    )
    # vertices are snapped to 1/256 texel: so far beyond its edge a face may reach, and its plane with it
    snapped = DISTANCE_ROUNDING * camera.far + (highest - lowest) / 256
    inside = off_the_edges(stored < camera.far)
    assert (stored >= lowest - snapped)[inside].all()
    assert (stored <= highest + snapped)[inside].all()


@settings(max_examples=10)
@given(floor_scenes())
def test_shadow_is_where_the_ray_to_the_light_is_blocked(scene: Scene) -> None:
    drawn, truth = draw("map-distance", scene), cast_rays(scene)
    compared = truth.sure(width=2) & (truth.objects == 0)  # as for the technique map
    assert compared.any()
    assert (drawn.shadow == (truth.counts[0] > 0))[compared].all()


@pytest.mark.parametrize("scene", ["boxes", "overlapping", "staircase", "thin-wall", "sunlight", "spotlight"])
def test_a_finer_map_comes_nearer_to_the_shadow_volumes(scene: str) -> None:
    truth = draw("volume-zfail", Scene.named(scene), size=SIZE).maps["visibility"]
    wrong = [
        (draw("map-distance", Scene.named(scene), size=SIZE, map_size=size).maps["visibility"] != truth).sum()
        for size in (64, 256, 1024)
    ]
    assert wrong[0] > wrong[1] > wrong[2]


def plates(height: float, gap: float, light: tuple[float, ...]) -> Scene:
    """A large plate, and above it a small one, both across the light's rays in the middle; seen from the side."""
    lower = SceneObject(shapes.floor(2), placement((0, height, 0)), receives=True, name="lower")
    upper = SceneObject(shapes.floor(0.5), placement((0, height + gap, 0)), name="upper")
    camera = Camera((0, height + 1.5, 6), (0, height, 0), fov_y=12, near=1, far=30)
    return Scene("plates", camera, (Light(light),), (lower, upper))


@pytest.mark.parametrize("light", [(0, 10, 0, 1), (0, 1, 0, 0)])
@pytest.mark.parametrize("height", [0.0, 4.0, 7.0])
def test_shadow_ends_where_the_gap_is_the_bias_at_every_distance(height: float, light: tuple[float, ...]) -> None:
    def dark(bias: float) -> int:
        scene = plates(height, 0.1, light)
        seen = draw("map-distance", scene, size=SIZE, bias=bias, normal_bias=0.0)
        return int((seen.shadow & (cast_rays(scene, SIZE).objects == 0)).sum())

    full = dark(0.01)
    assert full > 100
    # the rays to the rim of the upper plate lean by at most 1 in 6, so they are up to 1.4 % longer between the plates
    assert dark(0.098) == full
    assert dark(0.102) == 0


def test_bias_of_window_depth_is_another_distance_at_every_height() -> None:
    """The scene of the test above, with the technique map: what removes the far shadow leaves the near one."""

    def dark(height: float, bias: float) -> int:
        # a third plate at the far end, so that near and far of the light's camera are the same
        scene = plates(height, 0.1, (0, 10, 0, 1))
        posts = (SceneObject(shapes.floor(0.1), placement((0.9, y, 0.9)), name=f"post {y}") for y in (-1.0, 8.0))
        scene = replace(scene, objects=(*scene.objects, *posts))
        shadow = draw("map", scene, size=SIZE, factor=0.0, units=0.0, bias=bias).shadow
        middle = cast_rays(scene, SIZE)
        return int((shadow & (middle.objects == 0) & (np.abs(middle.points[..., [0, 2]]) < 0.4).all(axis=-1)).sum())

    bias = 0.004
    assert dark(0.0, bias) == 0
    assert dark(7.0, bias) > 100


def test_under_parallel_rays_the_bias_is_that_of_window_depth_times_the_depth_range() -> None:
    scene = Scene.named("sunlight")
    camera = light_camera(scene, scene.lights[0])
    bias = 0.05
    depth = draw("map", scene, factor=0.0, units=0.0, bias=bias / (camera.far - camera.near)).maps["visibility"]
    distance = draw("map-distance", scene, bias=bias, normal_bias=0.0).maps["visibility"]
    # a place on the edge of two texels: the texture unit and the program compute it in different ways
    assert (depth != distance).sum() <= 2
    assert (depth != draw("map", scene).maps["visibility"]).sum() > 2


@pytest.mark.parametrize("w", [0.0, 1.0])
@pytest.mark.parametrize("turn", [0, 35, 60, 75])
def test_default_biases_leave_no_acne_on_flat_faces(turn: int, w: float) -> None:
    roof = SceneObject(shapes.floor(2, 1), placement((0, 1, 0), (turn, 0, 0, 1)), receives=True, name="roof")
    scene = Scene("roof", Camera((0, 6, 3), (0, 1, 0), near=1, far=20), [Light((0, 5, 0, w))], [roof])
    assert not draw("map-distance", scene, map_size=32).shadow.any()
    acne = draw("map-distance", scene, map_size=32, **WITHOUT_BIAS).shadow.sum()
    assert acne > 10 or (turn == 0 and w == 0)  # the rays meet this roof at right angles


def test_default_bias_is_the_width_of_a_texel_at_the_far_end() -> None:
    scene = Scene.named("boxes")
    camera = light_camera(scene, scene.lights[0])
    width = 2 * camera.far * np.tan(np.radians(camera.fov / 2)) / 256
    assert texel_width(camera, 256) == pytest.approx(width)
    options = {"bias": width, "normal_bias": width / np.sqrt(2)}
    left_out, given_ = draw("map-distance", scene, map_size=256), draw("map-distance", scene, map_size=256, **options)
    assert (left_out.maps["visibility"] == given_.maps["visibility"]).all()


def test_maps_of_a_run_have_both_distances_at_every_pixel() -> None:
    scene = Scene.named("boxes")
    drawn, truth = draw("map-distance", scene, SIZE, bias=0.25, normal_bias=0.0), cast_rays(scene, SIZE)
    camera = light_camera(scene, scene.lights[0])
    away = np.linalg.norm(truth.points - camera.eye, axis=-1)
    surface = off_the_edges(truth.objects) & (truth.objects >= 0)
    compared, stored = drawn.maps["compared distance"], drawn.maps["stored distance"]
    # pixels of the pipeline and of the ray caster see the same point to about 1e-5 of its distance
    assert compared[surface] == pytest.approx(np.minimum(away - 0.25, camera.far)[surface], rel=1e-4)
    valid = drawn.maps["valid"] & ~drawn.maps["unknown"]
    assert ((compared <= stored) == (drawn.maps["visibility"] == 1))[valid].all()
    assert not drawn.maps["compared distance"][~drawn.maps["valid"]].any()


def test_a_bias_is_not_negative() -> None:
    with pytest.raises(ValueError, match=r"option bias=-0\.1: expected a number of at least 0"):
        get("map-distance").validate_options({"bias": -0.1})
