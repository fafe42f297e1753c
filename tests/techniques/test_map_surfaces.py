"""What a map stores, and what is done against acne: second depth, midpoint, normal bias; and what is outside it."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes
from softshadow.techniques.light_camera import light_camera
from softshadow.techniques.map_lookups import moved_along_normals
from softshadow.truth import first_faces
from techniques.drawn_frames import cast_rays, draw, off_the_edges

FLOOR = SceneObject(shapes.floor(12), casts=False, receives=True, name="floor")
BALL = SceneObject(shapes.sphere(0.6, 16, 8), placement((0, 1, 0)), name="ball")
CAMERA = Camera((3, 4, 6), (0, 0.5, 0), near=1, far=30)
SCENE = Scene("test", CAMERA, (Light((-2.5, 5, 0)),), (FLOOR, BALL))
NO_OFFSET = {"factor": 0.0, "units": 0.0}
MAP = 48


def second_depths(scene: Scene) -> np.ndarray:
    """The window depth of the second surface along the ray through each texel centre; 1 where none is before far."""
    camera = light_camera(scene, scene.lights[0])
    centres = (np.arange(MAP) + 0.5) / MAP * 2 - 1
    t, s = (grid.ravel() for grid in np.meshgrid(centres, centres, indexing="ij"))
    right, up, forward = camera.frame
    along = forward + camera.half * (s[:, None] * right + t[:, None] * up)
    origin = np.broadcast_to(camera.eye, along.shape)
    first = first_faces(origin, along, scene.casters)[2]
    beyond = np.where(np.isfinite(first), first, camera.near) + 1e-6  # a step off the first surface
    second = beyond + first_faces(origin + beyond[:, None] * along, along, scene.objects)[2]
    depth = camera.far / (camera.far - camera.near) * (1 - camera.near / second)
    return np.minimum(np.where(np.isfinite(second), depth, 1), 1).reshape(MAP, MAP)


def test_second_layer_holds_the_second_surface_that_each_ray_meets() -> None:
    drawn = draw("map", SCENE, surface="midpoint", map_size=MAP, **NO_OFFSET)
    first, second, middle = (drawn.maps[f"ZS {name}"] for name in ("first", "second", "midpoint"))
    caught = off_the_edges(first < 1, 2) & (first < 1)
    assert caught.sum() > 200
    # the faces of the ball have slopes: half a texel of them is what snapped vertices and steep rims may move
    assert np.abs(second - second_depths(SCENE))[caught].max() < 2e-3
    assert (second[caught] > first[caught]).all()
    # one step of the 24 bits
    assert np.abs(middle - (first + second) / 2).max() <= 2.0**-23


@pytest.mark.parametrize("surface", ["back", "midpoint"])
def test_lit_faces_of_a_solid_need_no_bias(surface: str) -> None:
    scene = replace(SCENE, camera=Camera((0.5, 3, 2), (0, 1, 0), near=1, far=30))
    truth = cast_rays(scene, (128, 96))
    lit = truth.sure(width=3) & (truth.counts[0] == 0)
    plain, cured = (
        draw("map", scene, size=(128, 96), map_size=MAP, surface=name, **NO_OFFSET).shadow & lit
        for name in ("front", surface)
    )
    assert plain.sum() > 50
    assert not cured.any()


def test_midpoint_of_a_sheet_is_before_what_it_shadows() -> None:
    sheet = SceneObject(shapes.floor(1.5), placement((0, 1, 0)), name="sheet")
    scene = replace(SCENE, objects=(FLOOR, sheet))
    truth = cast_rays(scene)
    drawn = draw("map", scene, surface="midpoint", **NO_OFFSET)
    compared = truth.sure(width=2) & (truth.objects == 0)
    assert (truth.counts[0] > 0)[compared].any()
    assert (drawn.shadow == (truth.counts[0] > 0))[compared].all()


@pytest.mark.parametrize("angle", [20, 50, 75])
def test_seven_tenths_of_a_texel_along_the_normal_end_acne_on_every_slope(angle: float) -> None:
    # on a slope θ under a parallel light a step d along the normal gains d / cos θ of depth, and half a texel t to both
    # sides loses at most t tan θ / √2: d = t sin θ / √2 is enough
    roof = SceneObject(shapes.floor(2, 2), placement((0, 1, 0), (angle, 1, 0, 0.4)), receives=True, name="roof")
    scene = replace(SCENE, camera=Camera((0.5, 6, 0.5), (0, 1, 0), near=1, far=30), objects=(roof,))
    scene = replace(scene, lights=(Light((0.1, 1, 0, 0)),))
    texel = 2 * light_camera(scene, scene.lights[0]).half / MAP
    acne = {
        share: draw("map", scene, map_size=MAP, normal_bias=share * texel, **NO_OFFSET).shadow.sum()
        for share in (0.0, 0.71)
    }
    assert acne[0.0] > 20
    assert acne[0.71] == 0


@pytest.mark.parametrize("scale", [0.5, 2.0])
def test_normal_bias_is_in_world_units_whatever_the_scale(scale: float) -> None:
    scaled = replace(BALL, object_to_world=placement((0, 1, 0), scale=scale))
    moved = moved_along_normals(scaled, 0.25).astype(np.float64)
    in_world = moved @ scaled.object_to_world[:3, :3].T + scaled.object_to_world[:3, 3]
    # float32 positions
    assert np.linalg.norm(in_world - scaled.world_positions, axis=1) == pytest.approx(0.25, abs=1e-6)


@pytest.mark.parametrize("elevation", [30, 50])
def test_bias_leaves_a_gap_of_its_length_times_the_cosine_of_the_elevation(elevation: float) -> None:
    wall = SceneObject(shapes.wall(2, 1, 0.001), name="wall")
    toward = (0, np.sin(np.radians(elevation)), -np.cos(np.radians(elevation)), 0)
    overhead = Camera((0, 9, 0.6), (0, 0, 0.6), up=(0, 0, -1), fov_y=20, near=1, far=30)
    scene = Scene("wall", overhead, (Light(toward),), (FLOOR, wall))
    camera, size = light_camera(scene, scene.lights[0]), (32, 256)
    bias = 0.3
    drawn = draw("map", scene, size=size, map_size=1024, bias=bias / (camera.far - camera.near), **NO_OFFSET)
    # the middle column from the wall on, away from the light
    pixel = 2 * 9 * np.tan(np.radians(10)) / size[1]
    column = drawn.shadow[:, 16]
    z = 0.6 - (np.arange(size[1]) + 0.5 - size[1] / 2) * pixel
    gap = z[column & (z > 0.02)].min()
    # a pixel, and a texel of the map on the floor
    texel = 2 * camera.half / 1024 / np.sin(np.radians(elevation))
    assert gap == pytest.approx(bias * np.cos(np.radians(elevation)), abs=pixel + texel)


def test_constant_bias_means_more_the_farther_the_surface_is() -> None:
    # one step of window depth spans z² (f - n) / (f n) of eye depth: measured at two sheets, one far below the other
    sheets = [
        SceneObject(shapes.floor(1.0), placement((x, y, 0)), name=f"at {y}") for x, y in ((-0.3, 4.5), (0.6, 0.5))
    ]
    scene = replace(SCENE, lights=(Light((0, 5, 0)),), objects=(FLOOR, *sheets))
    camera = light_camera(scene, scene.lights[0])
    near, far = camera.near, camera.far
    stored = draw("map", scene, precision="exact", map_size=MAP, **NO_OFFSET).maps["ZS"]
    steps = []
    for sheet in sheets:
        distance = float(((sheet.world_positions - camera.eye) @ camera.frame[2]).mean())
        depth = far / (far - near) * (1 - near / distance)
        nearest = stored.ravel()[np.abs(stored - depth).argmin()]
        z = near / (1 - nearest * (far - near) / far)
        biased = near / (1 - (nearest - 0.01) * (far - near) / far)
        steps.append(z - biased)
        assert steps[-1] == pytest.approx(0.01 * z * z * (far - near) / (far * near), rel=0.25)  # to first order
    assert steps[1] > 10 * steps[0]


def test_twice_the_texels_leave_about_half_the_errors() -> None:
    scene, size = Scene.named("overlapping"), (320, 240)
    truth = draw("volume-zfail", scene, size=size).maps["visibility"]
    wrong = [
        (draw("map", scene, size=size, map_size=texels).maps["visibility"] != truth).sum() for texels in (64, 128, 256)
    ]
    for coarse, fine in pairwise(wrong):
        assert 1.5 < coarse / fine < 3  # what a random staircase of so many pixels deviates from 2


@pytest.mark.parametrize("outside", ["lit", "shadow"])
def test_what_the_map_does_not_hold_is_as_the_policy_says(outside: str) -> None:
    scene = Scene.named("light-between")
    drawn = draw("map", scene, outside=outside)
    unknown = drawn.maps["unknown"] & off_the_edges(drawn.maps["unknown"])
    assert unknown.sum() > 200
    assert (drawn.maps["visibility"][unknown] == (outside == "lit")).all()
    added = (drawn.image != drawn.color["draw the scene without the light"]).any(axis=2)
    assert outside == "lit" or not added[unknown].any()


def test_edge_texels_smear_over_what_the_map_does_not_hold() -> None:
    # a sheet that reaches beyond 60 degrees to the side of the light: at the map's edge it is still there (E47)
    sheet = SceneObject(shapes.floor(6, 1), placement((0, 1, 0)), name="sheet")
    scene = replace(SCENE, lights=(Light((0, 2, 0)),), objects=(FLOOR, sheet), camera=Camera((0, 9, 9), (0, 0, 0)))
    shadows = {outside: draw("map", scene, outside=outside) for outside in ("lit", "edge")}
    unknown = shadows["lit"].maps["unknown"] & off_the_edges(shadows["lit"].maps["unknown"])
    assert not shadows["lit"].shadow[unknown].any()
    assert 0 < shadows["edge"].shadow[unknown].sum() < unknown.sum()
