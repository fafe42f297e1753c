"""The built-in scenes show what their titles say: each failure occurs where the camera sees it."""

import numpy as np
import pytest

from softshadow.errors import SceneError
from softshadow.scene import Scene, scene_names, scene_title
from softshadow.truth import casting_faces_between, first_faces

SIZE = (64, 48)
REQUIRED = {
    "boxes",
    "torus",
    "overlapping",
    "light-between",
    "room",
    "eye-in-shadow",
    "thin-wall",
    "staircase",
}


def near_points(scene: Scene) -> np.ndarray:
    """Return the world points of the pixel centres on the near rectangle."""
    x, y = np.meshgrid(np.arange(SIZE[0]) + 0.5, np.arange(SIZE[1]) + 0.5)
    return scene.camera.near_points(np.stack([x.ravel(), y.ravel()], axis=1), SIZE)


def seen(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Return (N,) the object that each pixel shows, -1 for none, and (N, 3) the point on it."""
    eye = np.broadcast_to(scene.camera.eye, (SIZE[0] * SIZE[1], 3))
    directions = near_points(scene) - eye
    objects, _, distances = first_faces(eye, directions, scene.objects)
    return objects, eye + directions * np.where(objects >= 0, distances, 0)[:, None]


def seen_on(scene: Scene, *names: str) -> np.ndarray:
    """Return the world points that the camera sees on the named objects."""
    objects, points = seen(scene)
    return points[np.isin(objects, [i for i, item in enumerate(scene.objects) if item.name in names])]


def images_on(scene: Scene, caster: str, receiver: str) -> tuple[np.ndarray, np.ndarray]:
    """Return t (V,) and L + t (P - L) (V, 3), the projection of each caster vertex P onto the receiver's plane."""
    (plane,) = [item.plane for item in scene.receivers if item.name == receiver]
    (points,) = [item.world_positions for item in scene.casters if item.name == caster]
    light = scene.lights[0].position
    t = (plane @ light) / ((light[:3] - points) @ plane[:3])
    return t, light[:3] + t[:, None] * (points - light[:3])


def test_required_scenes_exist() -> None:
    assert set(scene_names()) >= REQUIRED


@pytest.mark.parametrize("name", scene_names())
def test_scene_has_a_title_a_receiver_and_casters_off_the_near_plane(name: str) -> None:
    scene = Scene.named(name)
    assert scene.name == name
    assert scene.title == scene_title(name)
    assert scene.title.endswith(".")
    assert scene.receivers
    assert any(item.mesh.topology.closed for item in scene.casters) or name == "open-tube"
    assert sum(len(item.mesh.triangles) for item in scene.objects) < 5000


@pytest.mark.parametrize("name", scene_names())
def test_camera_sees_light_and_shadow_on_a_receiver(name: str) -> None:
    scene = Scene.named(name)
    points = seen_on(scene, *(item.name for item in scene.receivers))
    for light in scene.lights:
        shadowed = casting_faces_between(points, light.position, scene.casters) > 0
        assert 30 < shadowed.sum() < len(points) - 100


@pytest.mark.parametrize("name", scene_names())
def test_casters_fill_a_fair_part_of_the_picture(name: str) -> None:
    scene = Scene.named(name)
    objects, _ = seen(scene)
    casters = [index for index, item in enumerate(scene.objects) if item.casts]
    assert 0.02 < np.isin(objects, casters).mean() < 0.6


@pytest.mark.parametrize("name", scene_names())
def test_near_rectangle_is_in_a_volume_only_in_the_scenes_that_show_it(name: str) -> None:
    scene = Scene.named(name)
    counts = casting_faces_between(near_points(scene), scene.lights[0].position, scene.casters)
    assert set(counts.tolist()) == {"eye-in-shadow": {1}, "near-cut": {0, 1}}.get(name, {0})


def test_overlapping_casters_count_two_on_the_floor() -> None:
    scene = Scene.named("overlapping")
    counts = casting_faces_between(seen_on(scene, "floor"), scene.lights[0].position, scene.casters)
    assert (counts == 2).sum() > 30


def test_slab_above_the_light_has_an_image_on_the_visible_floor() -> None:
    t, images = images_on(Scene.named("light-between"), "slab", "floor")
    assert (t < 0).all()
    assert (np.abs(images[:, [0, 2]]) < 3).all()


def test_light_is_between_the_boxes() -> None:
    scene = Scene.named("light-between")
    left, right = (next(item for item in scene.casters if item.name == side) for side in ("left", "right"))
    x = scene.lights[0].position[0]
    assert left.world_positions[:, 0].max() < x < right.world_positions[:, 0].min()


def test_crate_behind_the_steps_has_a_false_image_on_a_step() -> None:
    scene = Scene.named("staircase")
    t, images = images_on(scene, "crate behind", "tread 4")
    (tread,) = [item.world_positions for item in scene.receivers if item.name == "tread 4"]
    on = ((images >= tread.min(axis=0) - 1e-9) & (images <= tread.max(axis=0) + 1e-9)).all(axis=1)
    assert ((t > 0) & (t < 1) & on).any()


def test_steps_are_receivers_at_four_heights() -> None:
    heights = {round(-item.plane[3], 3) for item in Scene.named("staircase").receivers if "tread" in item.name}
    assert heights == {0.35, 0.7, 1.05, 1.4}


def test_light_of_the_room_is_inside_all_walls() -> None:
    scene = Scene.named("room")
    assert len(scene.receivers) == 6
    assert all(item.plane @ scene.lights[0].position > 0 for item in scene.receivers)


def test_thin_wall_stands_on_the_floor() -> None:
    (wall,) = [item for item in Scene.named("thin-wall").casters if item.name == "wall"]
    assert wall.world_positions[:, 1].min() == 0
    assert np.ptp(wall.mesh.positions, axis=0).min() < 0.05


def test_sun_is_at_infinity() -> None:
    assert Scene.named("sunlight").lights[0].is_directional


def test_unknown_scene_gives_the_nearest_name() -> None:
    with pytest.raises(SceneError, match=r"no built-in scene is called 'boxs'; did you mean 'boxes'\?"):
        Scene.named("boxs")
