"""Shadow maps: what is stored, what is compared, and what bias and size do."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings

from softshadow.errors import OutsideLightFrustum
from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.truth import first_faces
from strategies import floor_scenes
from techniques.drawn_frames import cast_rays, draw, off_the_edges

FLOOR = SceneObject(shapes.floor(12), casts=False, receives=True, name="floor")
BOX = SceneObject(shapes.box(0.8), placement((0, 1, 0)), name="box")
CAMERA = Camera((3, 4, 6), (0, 0.5, 0), near=1, far=30)
SCENE = Scene("test", CAMERA, (Light((-2.5, 5, 0)),), (FLOOR, BOX))
LIT = "add the light where the map is not nearer"

# the map is d24: it rounds to half a step of 2^-24; before that the "exact" precision loses next to nothing
DEPTH_ROUNDING = 2.0**-24


def light_depths(scene: Scene, camera: LightCamera, map_size: int) -> np.ndarray:
    """The window depth of the first caster along the ray through each texel centre, by ray casting; 1 where none is."""
    centres = (np.arange(map_size) + 0.5) / map_size * 2 - 1
    t, s = (grid.ravel() for grid in np.meshgrid(centres, centres, indexing="ij"))
    right, up, forward = camera.frame
    aside = camera.half * (s[:, None] * right + t[:, None] * up)
    origin = camera.eye + aside if camera.parallel else np.broadcast_to(camera.eye, aside.shape)
    along = np.broadcast_to(forward, aside.shape) if camera.parallel else forward + aside
    distance = first_faces(origin, along, scene.casters)[2]  # along the view, where the direction has length 1
    near, far = camera.near, camera.far
    depth = (distance - near) / (far - near) if camera.parallel else far / (far - near) * (1 - near / distance)
    return np.where(np.isfinite(distance), depth, 1.0).reshape(map_size, map_size)


@settings(max_examples=10)
@given(floor_scenes())
def test_map_holds_the_depth_of_the_first_caster_seen_from_the_light(scene: Scene) -> None:
    stored = draw("map", scene, precision="exact", map_size=32, factor=0.0, units=0.0).maps["ZS"]
    expected = light_depths(scene, light_camera(scene, scene.lights[0]), 32)
    assert stored.dtype == np.float32
    # a texel whose centre is on an edge may have the depth of either face, so of a neighbour
    lowest, highest = (
        extreme([np.roll(expected, (y, x), (0, 1)) for y in (-1, 0, 1) for x in (-1, 0, 1)], axis=0)
        for extreme in (np.min, np.max)
    )
    # vertices are snapped to 1/256 texel: so far beyond its edge a face may reach, and its plane with it
    snapped = DEPTH_ROUNDING + (highest - lowest) / 256
    assert (stored >= lowest - snapped).all()
    assert (stored <= highest + snapped).all()
    close = np.abs(stored - expected) <= DEPTH_ROUNDING
    assert close[off_the_edges(stored < 1)].mean() > 0.99


@settings(max_examples=10)
@given(floor_scenes())
def test_shadow_is_where_the_ray_to_the_light_is_blocked(scene: Scene) -> None:
    drawn, truth = draw("map", scene), cast_rays(scene)
    # a texel of the map is smaller than a pixel of the picture, but not by much; on casters, which it sees at an angle,
    # it covers several pixels, so only the floor is compared
    compared = truth.sure(width=2) & (truth.objects == 0)
    assert compared.any()
    assert (drawn.shadow == (truth.counts[0] > 0))[compared].all()


@pytest.mark.parametrize("scene", ["boxes", "overlapping", "staircase", "thin-wall", "sunlight"])
def test_a_finer_map_comes_nearer_to_the_shadow_volumes(scene: str) -> None:
    truth = draw("volume-zfail", Scene.named(scene), size=(160, 120)).maps["visibility"]
    wrong = [
        (draw("map", Scene.named(scene), size=(160, 120), map_size=size).maps["visibility"] != truth).sum()
        for size in (64, 256, 1024)
    ]
    assert wrong[0] > wrong[1] > wrong[2]


def test_moving_the_camera_does_not_change_the_map() -> None:
    here = draw("map", SCENE).maps["ZS"]
    there = draw("map", replace(SCENE, camera=Camera((-4, 2, 3), (0, 1, 0)))).maps["ZS"]
    assert (here == there).all()


@pytest.mark.parametrize("light", [(-2.5, 5, 1.0, 1.0), (-1, 2, 0.5, 0)])
def test_slope_factor_one_is_enough_against_acne(light: tuple[float, ...]) -> None:
    # a steep and a flat roof in the light, casting on themselves only if the map errs
    roof = SceneObject(shapes.floor(2, 1), placement((0, 1, 0), (35, 1, 0, 0)), receives=True, name="roof")
    scene = replace(SCENE, lights=(Light(light),), objects=(roof,))
    acne = {
        factor: draw("map", scene, map_size=32, factor=factor, units=0.0).shadow.sum() for factor in (0.0, 0.4, 1.0)
    }
    assert acne[0.0] > 40
    assert acne[0.4] > 0
    assert acne[1.0] == 0


def test_a_constant_bias_is_not_enough_for_a_steep_slope() -> None:
    flat = SceneObject(shapes.floor(2, 2), placement((0, 1, 0)), receives=True, name="flat")
    steep = SceneObject(shapes.floor(2, 2), placement((0, 1, 0), (60, 0, 0, 1)), receives=True, name="steep")
    options = {"map_size": 32, "factor": 0.0, "units": 0.0}

    def acne(roof: SceneObject, bias: float) -> int:
        # the light above the middle: the flat roof is seen straight on, the steep one at an angle
        scene = replace(SCENE, lights=(Light((0, 1, 0, 0)),), objects=(roof,))
        return int(draw("map", scene, bias=bias, **options).shadow.sum())

    assert acne(flat, 1e-3) == 0
    assert acne(steep, 1e-3) > 10
    assert acne(steep, 0.03) == 0  # half a texel of 1/32 on a slope of less than 1.8 is less than 0.03


def test_too_much_bias_takes_the_shadow_off_its_caster() -> None:
    standing = replace(BOX, object_to_world=placement((0, 0.4, 0)))
    scene = replace(SCENE, objects=(FLOOR, standing))
    right = draw("map", scene).shadow.sum()
    assert draw("map", scene, bias=0.3).shadow.sum() < right
    assert draw("map", scene, bias=1.0).shadow.sum() == 0


def test_a_closed_caster_drawn_by_its_far_faces_needs_no_bias_on_lit_faces() -> None:
    options = {"map_size": 64, "factor": 0.0, "units": 0.0}
    truth = draw("volume-zfail", SCENE, size=(128, 96)).maps["visibility"]
    lit = off_the_edges(truth, 2) & (truth == 1)
    both, far = (draw("map", SCENE, size=(128, 96), cull=cull, **options).shadow for cull in ("none", "front"))
    assert (both & lit).any()
    assert not (far & lit).any()


def test_what_the_light_does_not_see_is_unknown_and_lit() -> None:
    # two boxes at both sides of the light: its camera looks at their middle and sees neither completely
    beside = tuple(SceneObject(shapes.box(0.8), placement((x, 1, 0)), name=f"box {x}") for x in (-1.5, 1.5))
    scene = replace(SCENE, lights=(Light((0, 1.2, 0.5)),), objects=(FLOOR, *beside))
    drawn = draw("map", scene)
    assert drawn.warnings == [OutsideLightFrustum]
    unknown, valid = drawn.maps["unknown"], drawn.maps["valid"]
    assert (unknown & valid).any()
    assert not (drawn.shadow & unknown & off_the_edges(unknown)).any()
    # the shadows that are missing are all in the unknown part
    missing = draw("volume-zfail", scene).shadow & ~drawn.shadow
    assert missing.any()
    to_point = cast_rays(scene).points - scene.lights[0].position[:3]
    behind = valid & (to_point @ light_camera(scene, scene.lights[0]).frame[2] < 0)
    assert behind.any()
    assert (behind & ~unknown).sum() <= off_the_edges(behind).size - off_the_edges(behind).sum()  # on the border only


def test_points_behind_the_light_find_no_mirrored_shadow() -> None:
    # the light looks along -z at the box; the wall behind it would find the box through the division by q < 0
    wall = SceneObject(shapes.quad((-3, 0, 2), (0, 4, 0), (6, 0, 0)), casts=False, receives=True, name="wall")
    scene = replace(
        SCENE, camera=Camera((0, 2, -6), (0, 1.5, 2), near=1, far=30), lights=(Light((0, 1, 1)),), objects=(wall, BOX)
    )
    drawn = draw("map", scene)
    behind = drawn.maps["unknown"] & drawn.maps["valid"]
    assert behind.sum() > 100
    assert not (drawn.shadow & behind).any()
    assert (drawn.image[behind] != drawn.color["draw the scene without the light"][behind]).any()


def test_a_copy_from_a_smaller_window_leaves_the_rest_of_the_map_empty() -> None:
    copied, drawn_into = (draw("map", SCENE, map_size=64, storage=storage) for storage in ("copy", "framebuffer"))
    assert (copied.maps["ZS"][48:] == 1).all()
    # a copy from the window goes through floats: one step at most
    assert np.abs(copied.maps["ZS"][:48] - drawn_into.maps["ZS"][:48]).max() <= 2.0**-23
    small = draw("map", SCENE, map_size=48, storage="copy").maps["visibility"]
    assert (small == draw("map", SCENE, map_size=48).maps["visibility"]).mean() > 0.999


@settings(max_examples=5)
@given(floor_scenes(lights=2))
def test_picture_is_ambient_light_and_what_each_light_adds(scene: Scene) -> None:
    both = draw("map", scene)
    assume(both.maps["valid"].any())
    total = ambient = both.color["draw the scene without the light"].astype(int)
    for light in scene.lights:
        one = draw("map", replace(scene, lights=(light,)))
        assert (both.maps[f"visibility of {light.name}"] == one.maps["visibility"]).all()
        total = total + one.image - ambient
    assert (both.image == np.minimum(total, 255))[both.maps["valid"]].all()


def test_linear_filtering_decides_by_half_of_the_comparisons() -> None:
    # the boundary runs where the weights of lit and dark texels are equal, off the staircase of the texels
    scene, size = Scene.named("overlapping"), (160, 120)
    truth = draw("volume-zfail", scene, size=size).maps["visibility"]
    wrong = {
        name: (draw("map", scene, size=size, map_size=64, filter=name).maps["visibility"] != truth).sum()
        for name in ("nearest", "linear")
    }
    assert 0 < wrong["linear"] < wrong["nearest"]


def test_passes_are_those_of_the_table_and_one_for_the_ambient_light() -> None:
    assert list(draw("map", SCENE).objects.values()) == [["box"], ["floor", "box"], ["floor", "box"]]
