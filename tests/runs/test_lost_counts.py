"""Counts that the stencil buffer cannot hold are named, wherever a picture would be wrong without a word."""

import warnings
from dataclasses import replace

import numpy as np
import pytest

import softshadow as ss
from softshadow.runs.lost_counts import lost_counts, most_overlaps
from softshadow.scene import Camera, Light, Mesh, Scene, SceneObject, shapes
from softshadow.scene.placement import placement

SIZE = (48, 36)


def said(run: ss.Run) -> list[str]:
    return [str(each) for each in run.warnings if isinstance(each, ss.CounterSaturated)]


def run_quietly(*arguments, **options) -> ss.Run:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.Warning)
        return ss.run(*arguments, **options)


def stacked(layers: int) -> Scene:
    """Return a scene with closed boxes, one above the other, all in one mesh."""
    box = shapes.box(1.0, 0.5 / layers, 1.0)
    positions = [box.positions + np.float32([0, 1 + k / layers, 0]) for k in range(layers)]
    triangles = [box.triangles + k * len(box.positions) for k in range(layers)]
    return Scene(
        "stacked",
        Camera((3, 3, 4), (0, 0.5, 0), fov_y=40, near=1, far=30),
        (Light((0.1, 9, 0.2)),),
        (
            SceneObject(shapes.floor(), casts=False, receives=True),
            SceneObject(Mesh(np.concatenate(positions), np.concatenate(triangles), name="stack")),
        ),
    )


def test_256_boxes_are_256_volumes_that_a_byte_counts_as_none():
    scene = stacked(256)
    assert most_overlaps(scene) == 256
    run = run_quietly("volume-zfail", scene, SIZE)
    (text,) = said(run)
    assert "256 volumes overlap, and a counter of 256 values is 0" in text
    assert run.compare(truth="hard").parts["umbra"].wrong > 0  # it is no false alarm
    assert said(run_quietly("volume-zfail", stacked(255), SIZE)) == []


@pytest.mark.parametrize("technique", ["volume-zfail", "volume-zpass"])
def test_one_bit_counts_two_volumes_as_none(technique):
    run = run_quietly(technique, "overlapping", SIZE, stencil_bits=1)
    assert "a counter of 2 values" in said(run)[0] or "the parity is 0" in said(run)[0]
    assert said(run_quietly(technique, "overlapping", SIZE)) == []


def test_parity_says_where_volumes_overlap():
    assert "volume-zfail counts them" in said(run_quietly("volume-parity", "overlapping", SIZE))[0]
    assert said(run_quietly("volume-parity", "boxes", SIZE)) == []


def test_saturating_counters_are_not_checked_by_rays():
    scene = Scene.named("overlapping")
    assert lost_counts("volume-zfail", scene, SIZE, {"ops": "saturate"}, 1) == []


def moved(scene: Scene, by: float, scale: float = 1.0) -> Scene:
    """Return a scene moved along x and scaled, with its camera and its lights."""
    matrix = placement((by, 0, 0)) @ placement(scale=scale)
    shift, camera = np.array([by, 0, 0]), scene.camera
    return replace(
        scene,
        camera=Camera(
            scale * camera.eye + shift, scale * camera.target + shift, camera.up, camera.fov_y, scale * camera.near,
            scale * camera.far,
        ),
        lights=tuple(
            light if light.is_directional else Light(scale * light.position[:3] + shift) for light in scene.lights
        ),
        objects=tuple(replace(thing, object_to_world=matrix @ thing.object_to_world) for thing in scene.objects),
    )  # fmt: skip


def test_a_scene_far_away_and_a_light_far_away_are_named():
    def kinds(scene: Scene) -> list[type]:
        return [type(each) for each in scene.warnings()]

    scene = Scene.named("boxes")
    assert ss.FarFromOrigin not in kinds(scene)
    assert ss.FarFromOrigin in kinds(moved(scene, 1e5))
    assert ss.FarFromOrigin in kinds(replace(scene, lights=(Light((1e6, 2e6, 1e6)),)))
    assert ss.FarFromOrigin not in kinds(replace(scene, lights=(Light((1, 2, 1, 0)),)))


@pytest.mark.parametrize(("near", "coarse"), [(1.0, False), (0.02, False), (1e-3, True), (1e-5, True)])
def test_a_near_plane_too_close_is_named(near, coarse):
    scene = Scene.named("boxes")
    camera = scene.camera
    scene = replace(scene, camera=Camera(camera.eye, camera.target, camera.up, camera.fov_y, near, camera.far))
    assert (ss.CoarseDepth in [type(each) for each in scene.warnings()]) == coarse


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1e3])
def test_the_map_of_a_direction_fits_scenes_of_any_size(scale):
    plain = run_quietly("map", "sunlight", SIZE)
    scaled = run_quietly("map", moved(Scene.named("sunlight"), 0, scale), SIZE)
    # float32 rounds scaled coordinates differently: single pixels on edges may change
    assert (plain.visibility != scaled.visibility).sum() <= 5
    assert (plain.visibility < 1).sum() > 50


@pytest.mark.parametrize(
    ("light", "words"),
    [((100, 250, 150), "texels of a face"), ((0.3, 1.6004, -0.9), "comes nearer to it than"), ((-2, 4, 2), "")],
)
def test_cube_maps_say_when_casters_are_too_far_or_too_near(light, words):
    scene = replace(Scene.named("boxes"), lights=(Light(light),))
    texts = [str(each) for each in run_quietly("map-cube", scene, SIZE).warnings]
    assert any(words in text for text in texts) if words else texts == []
