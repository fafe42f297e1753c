"""Soft shadows from points of the light: one point is the hard technique, and n points give the share of n results."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from softshadow.pipeline import use_short_cuts
from softshadow.scene import Disc, Light, Rectangle, Scene, Segment, Sphere, sample_lights
from techniques.drawn_frames import Drawn, cast_rays, draw

SIZE = (64, 48)
SAMPLED = ("volume-sampled", "map-sampled", "planar-accumulated")
# each technique with one point, and the hard technique that it then is
HARD: list[tuple[str, dict[str, Any], str, dict[str, Any]]] = [
    ("volume-sampled", {}, "volume-zfail", {"two_sided": True}),
    ("map-sampled", {}, "map-pcf", {"kernel": 1}),
    ("planar-accumulated", {"method": "accumulation"}, "planar", {"method": "stencil"}),
]


def with_area_light(name: str, half: float = 0.6) -> Scene:
    """Return a built-in scene whose first light is a square of the side 2 half, parallel to the floor."""
    scene = Scene.named(name)
    lamp = scene.lights[0]
    area = Light(lamp.position[:3], lamp.color, lamp.name, shape=Rectangle((2 * half, 0, 0), (0, 0, 2 * half)))
    return replace(scene, lights=(area, *scene.lights[1:]))


def lit_from(scene: Scene, point: Light) -> Scene:
    return replace(scene, lights=(replace(point, name=scene.lights[0].name), *scene.lights[1:]))


def same_pictures(a: Drawn, b: Drawn) -> bool:
    return all(
        np.array_equal(x, y)
        for x, y in [(a.image, b.image), *((a.maps[name], b.maps[name]) for name in ("visibility", "valid"))]
    )


@pytest.mark.parametrize("name", ["torus", "boxes", "two-lights"])
@pytest.mark.parametrize(("technique", "options", "hard", "hard_options"), HARD)
def test_one_point_draws_the_hard_technique(name, technique, options, hard, hard_options):
    scene = with_area_light(name)
    soft = draw(technique, scene, SIZE, samples=1, **options)
    assert same_pictures(soft, draw(hard, Scene.named(name), SIZE, **hard_options))


@pytest.mark.parametrize(("technique", "options", "hard", "hard_options"), HARD)
def test_a_light_without_a_shape_casts_hard_shadows(technique, options, hard, hard_options):
    soft = draw(technique, Scene.named("torus"), SIZE, samples=9, **options)
    assert same_pictures(soft, draw(hard, Scene.named("torus"), SIZE, **hard_options))


@pytest.mark.parametrize("pattern", ["grid", "jittered", "sobol", "random", "corners"])
@pytest.mark.parametrize(("technique", "options", "hard", "hard_options"), HARD)
def test_visibility_is_the_mean_of_the_hard_technique_over_the_points(technique, options, hard, hard_options, pattern):
    scene = with_area_light("torus")
    soft = draw(technique, scene, SIZE, samples=4, pattern=pattern, **options)
    points = sample_lights(scene.lights[0], 4, pattern, 0)
    pictures = [draw(hard, lit_from(scene, point), SIZE, **hard_options).maps["visibility"] for point in points]
    assert np.array_equal(soft.maps["visibility"], np.mean(pictures, axis=0, dtype=np.float64).astype(np.float32))


@pytest.mark.parametrize("technique", SAMPLED)
def test_values_lie_on_the_grid_of_one_over_n(technique):
    options = {"method": "accumulation"} if technique == "planar-accumulated" else {}
    drawn = draw(technique, with_area_light("torus"), SIZE, samples=7, pattern="sobol", **options)
    values = np.unique(drawn.maps["visibility"])
    assert len(values) > 3
    assert np.isin(values, (np.arange(8) / 7).astype(np.float32)).all()


SHAPES = (
    Rectangle((1, 0.2, 0), (0, 0, 1.1)),
    Disc(0.6, (0.1, 1, 0.2)),
    Sphere(0.5),
    Segment((1, 0.4, -0.3)),
)


@pytest.mark.parametrize("seed", range(8))
def test_maps_compared_together_give_the_bits_of_one_after_the_other(seed):
    rng = np.random.default_rng(seed)
    scene = Scene.named(["torus", "boxes", "two-lights", "soft-overlap"][seed % 4])
    lights = tuple(
        Light(lamp.position[:3] + rng.normal(0, 0.2, 3), lamp.color, lamp.name, shape=SHAPES[rng.integers(4)])
        for lamp in scene.lights
    )
    scene, size = replace(scene, lights=lights), (int(rng.integers(20, 90)), int(rng.integers(20, 70)))
    options = {
        "samples": int(rng.integers(2, 30)), "pattern": str(rng.choice(["grid", "jittered", "sobol"])),
        "map_size": int(rng.integers(16, 200)), "outside": str(rng.choice(["lit", "shadow", "edge"])),
        "bias": float(rng.choice([0.0, 0.002])), "normal_bias": float(rng.choice([0.0, 0.02])),
    }  # fmt: skip
    with use_short_cuts(False):
        one_by_one = draw("map-sampled", scene, size, together=1, **options)
    for policy in (True, "always"):
        with use_short_cuts(policy):
            together = draw("map-sampled", scene, size, together=int(rng.integers(2, 9)), **options)
        assert same_pictures(one_by_one, together)
        for name in one_by_one.maps:
            assert np.array_equal(one_by_one.maps[name], together.maps[name]), name


def test_many_points_are_compared_eight_at_a_time():
    few, many = (draw("map-sampled", with_area_light("torus"), SIZE, samples=n, map_size=32) for n in (16, 17))
    assert len(few.titles) == 1 + 16 + 1
    assert len(many.titles) == 1 + 3 + 1
    assert "compare with the maps of points 1 to 8 of 17" in many.titles
    assert "compare with the map of point 17 of 17" in many.titles


def test_all_corners_blocked_is_the_umbra_of_a_convex_caster():
    scene = Scene.named("soft-slab")
    corners = draw("volume-sampled", scene, SIZE, samples=4, pattern="corners")
    inside = draw("volume-sampled", scene, SIZE, samples=64, pattern="jittered")
    # the points that see all corners blocked see every point of the light between them blocked, off the edges
    floor = off_edges(corners.maps["visibility"])
    dark = corners.maps["valid"] & floor & (corners.maps["visibility"] == 0)
    assert dark.sum() > 20
    assert (inside.maps["visibility"][dark] == 0).all()
    # the reverse does not hold: where no corner is blocked, the middle may be
    lit = corners.maps["valid"] & (corners.maps["visibility"] == 1)
    assert (inside.maps["visibility"][lit] <= 1).all()


def off_edges(values: np.ndarray) -> np.ndarray:
    """Return where a pixel and its neighbours have the same value."""
    framed = np.pad(values, 1, mode="edge")
    rows, columns = values.shape
    return np.all([framed[y : y + rows, x : x + columns] == values for y in range(3) for x in range(3)], axis=0)


@pytest.mark.parametrize("seed", range(3))
def test_textures_of_receivers_agree_with_volumes_off_the_edges(seed):
    scene = with_area_light("torus")
    options = {"samples": 8, "pattern": "jittered", "seed": seed}
    texture = draw("planar-accumulated", scene, (96, 72), texture_size=1024, **options)
    volume = draw("volume-sampled", scene, (96, 72), **options)
    valid = texture.maps["valid"] & volume.maps["valid"]
    # each of 8 edges moves by up to a texel: the textures are filtered, and a texel is about a fifth of a pixel
    flat = valid & off_edges(volume.maps["visibility"])
    assert flat.sum() > 1000
    assert np.abs(texture.maps["visibility"] - volume.maps["visibility"])[flat].max() < 1 / 8


def test_more_points_are_nearer_to_the_area_light():
    scene = with_area_light("torus")
    fine = draw("volume-sampled", scene, SIZE, samples=400).maps
    errors = []
    for samples in (4, 16, 64):
        coarse = draw("volume-sampled", scene, SIZE, samples=samples).maps
        errors.append(float(np.sqrt(np.mean((coarse["visibility"] - fine["visibility"]) ** 2))))
    assert errors[0] > errors[1] > errors[2] > 0


def test_nested_planes_begin_with_the_hard_shadow_and_shrink_to_the_foot_of_the_light():
    scene = Scene.named("torus")
    one = draw("planar-nested", scene, SIZE, layers=1).maps
    hard = draw("planar-accumulated", scene, SIZE, samples=1).maps
    assert np.array_equal(one["visibility"], hard["visibility"])
    nested = draw("planar-nested", scene, SIZE, layers=5, spread=0.5).maps
    values = nested["texture of floor"]
    assert np.isin(np.unique(values), (1 - np.arange(6) / 5).astype(np.float32)).all()


def test_a_layer_is_the_shadow_scaled_about_the_foot_of_the_light():
    """The image on a plane at height k under a light at height H, moved back, is (H - k) / H of that at height 0."""
    from softshadow.techniques.receiver_textures import view_of

    scene = Scene.named("torus")
    (floor,), light = scene.receivers, scene.lights[0].position
    height, shift = float(abs(floor.plane @ light) / np.linalg.norm(floor.plane[:3])), 0.3
    rng = np.random.default_rng(7)
    points = np.column_stack([rng.uniform(-1, 1, (50, 1)), rng.uniform(0.4, 1.0, (50, 1)), rng.uniform(-1, 1, (50, 1))])
    homogeneous = np.column_stack([points, np.ones(50)])

    def image(shift: float) -> np.ndarray:
        clip = homogeneous @ view_of(scene, floor, light, shift).T
        return clip[:, :2] / clip[:, 3:]

    foot = (
        np.append(light[:3] - height * floor.plane[:3] * np.sign(floor.plane @ light), 1)
        @ view_of(scene, floor, light).T
    )
    foot = foot[:2] / foot[3]
    # both sides are computed in float64; the numbers are of the size 1
    assert np.allclose(image(shift) - foot, (height - shift) / height * (image(0.0) - foot), atol=1e-12)


def test_points_of_the_light_agree_with_rays():
    scene = with_area_light("boxes")
    points = sample_lights(scene.lights[0], 5, "sobol", 3)
    drawn = draw("volume-sampled", scene, SIZE, samples=5, pattern="sobol", seed=3)
    truths = [cast_rays(lit_from(scene, point), SIZE) for point in points]
    sure = np.logical_and.reduce([truth.sure() for truth in truths])
    expected = np.mean([truth.counts[0] == 0 for truth in truths], axis=0).astype(np.float32)
    assert sure.sum() > 500
    assert np.array_equal(drawn.maps["visibility"][sure], expected[sure])


@pytest.mark.parametrize(
    ("technique", "options"), [("volume-sampled", {}), ("map-sampled", {"map_size": 1024}), ("planar-accumulated", {})]
)
def test_a_further_caster_takes_light_and_never_gives_any(technique, options):
    """Not so for wedges, which may give back what another caster hides, and for the mean blocker of map-pcss."""
    scene = Scene.named("soft-overlap")
    fewer = replace(scene, objects=tuple(thing for thing in scene.objects if thing.name != "lower"))
    with_both, with_one = (draw(technique, each, SIZE, samples=9, **options) for each in (scene, fewer))
    # the floor, seen in both pictures: the further caster hides a part of it from the camera, too
    floor = cast_rays(scene, SIZE).objects == 0
    both = with_both.maps["valid"] & with_one.maps["valid"] & floor
    # a frame round more casters has larger texels: their rounding may move the edge of a map by a pixel
    both &= off_edges(with_one.maps["visibility"]) if technique == "map-sampled" else True
    gained = (with_both.maps["visibility"] - with_one.maps["visibility"])[both]
    assert gained.max() <= (1e-6 if technique == "planar-accumulated" else 0)  # linear filtering rounds
    assert gained.min() < 0


EXACT = (*SAMPLED, "planar-nested", "volume-wedges", "map-pcss")
BOUNDS = ("map-variance", "map-exponential")  # which reach 0 beside the light's map only
IN_THE_DARK = [(technique, name) for technique in EXACT for name in ("spotlight", "sunlight", "soft-slab")]


@pytest.mark.parametrize(("technique", "name"), [*IN_THE_DARK, *((technique, "spotlight") for technique in BOUNDS)])
def test_where_no_light_is_visible_none_is_added(technique, name):
    """As outside the cone of a spot light, which the program and the picture must leave out alike."""
    drawn = draw(technique, Scene.named(name), SIZE)
    dark = drawn.maps["valid"] & (drawn.maps["visibility"] == 0)
    without_light = drawn.color["draw the scene without the light"]
    assert dark.sum() > 20
    assert np.array_equal(drawn.image[dark], without_light[dark])


@pytest.mark.parametrize("technique", ["planar-accumulated", "planar-nested"])
def test_a_spot_light_lights_its_cone_only(technique):
    options = {"samples": 1} if technique == "planar-accumulated" else {"layers": 1}
    drawn = draw(technique, Scene.named("spotlight"), SIZE, texture_size=1024, **options).maps
    hard = draw("planar", Scene.named("spotlight"), SIZE).maps
    both = drawn["valid"] & hard["valid"] & off_edges(hard["visibility"])
    assert np.array_equal(drawn["visibility"][both] > 0.5, hard["visibility"][both] > 0.5)
    assert (hard["visibility"][both] == 0).sum() > 100
