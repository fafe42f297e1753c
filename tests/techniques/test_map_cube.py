"""Six maps round a light: what each holds, no seam between them, nothing unknown."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from softshadow.errors import SceneError
from softshadow.scene import Light, Scene
from softshadow.techniques.map_cube import FACES, face_camera
from softshadow.truth import first_faces
from strategies import floor_scenes
from techniques.drawn_frames import SIZE, cast_rays, draw, off_the_edges

INSIDE = Scene.named("light-between")


def faces_of(scene: Scene, points: np.ndarray) -> np.ndarray:
    """The face that each point is in, 0 to 5."""
    away = points - scene.lights[0].position[:3]
    axis = np.abs(away).argmax(axis=-1)
    return 2 * axis + (np.take_along_axis(away, axis[..., None], -1)[..., 0] < 0)


@settings(max_examples=10)
@given(floor_scenes())
def test_six_views_divide_all_directions_between_them(scene: Scene) -> None:
    points = np.random.default_rng(0).normal(size=(200, 3)) + scene.lights[0].position[:3]
    sees = np.array([face_camera(scene, scene.lights[0], index).sees(points) for index in range(6)])
    assert (sees.sum(axis=0) == 1).all()
    assert (sees.argmax(axis=0) == faces_of(scene, points)).all()


@pytest.mark.parametrize("index", range(6))
def test_face_holds_the_depth_of_the_first_caster_as_cube_maps_are_laid_out(index: int) -> None:
    side, light = 24, INSIDE.lights[0]
    stored = draw("map-cube", INSIDE, precision="exact", map_size=side, factor=0.0, units=0.0).maps[
        f"ZS {FACES[index][0]}"
    ]
    camera = face_camera(INSIDE, light, index)
    # the direction of a texel from GL 2.1, table 3.21: the inverse of what a lookup does
    t, s = np.meshgrid(*[(np.arange(side) + 0.5) / side * 2 - 1] * 2, indexing="ij")
    one = np.ones_like(s)
    along = [(one, -t, -s), (-one, -t, s), (s, one, t), (s, -one, -t), (s, -t, one), (-s, -t, -one)][index]
    directions = np.stack(along, axis=-1).reshape(-1, 3)
    distance = first_faces(np.broadcast_to(camera.eye, directions.shape), directions, INSIDE.casters)[2]
    expected = camera.far / (camera.far - camera.near) * (1 - camera.near / distance)
    expected = np.where(np.isfinite(distance), expected, 1).reshape(side, side)
    sure = off_the_edges(stored < 1)
    # 24 bits, and depths of 1/1000 of the range that snapped vertices move by 1/256 texel
    assert np.abs(stored - expected)[sure].max() < 1e-4


@pytest.mark.parametrize("name", ["light-between", "room", "spotlight"])
def test_shadow_is_that_of_rays_across_all_seams(name: str) -> None:
    scene = Scene.named(name)
    size = (160, 120)
    drawn, truth = draw("map-cube", scene, size=size, map_size=1024), cast_rays(scene, size)
    lit = (truth.counts[0] == 0) & scene.lights[0].shines_on(truth.points)
    receivers = [index for index, thing in enumerate(scene.objects) if not thing.casts]
    compared = truth.sure(width=2) & off_the_edges(lit, 2) & np.isin(truth.objects, receivers)
    assert ((drawn.maps["visibility"] == 1) == lit)[compared].all()
    faces = faces_of(scene, truth.points)
    at_a_seam = compared & ~off_the_edges(faces)
    assert at_a_seam.sum() > 50
    assert len(np.unique(faces[compared])) >= 3


def test_what_one_map_leaves_unknown_six_maps_know() -> None:
    truth = cast_rays(INSIDE)
    one, six = draw("map", INSIDE), draw("map-cube", INSIDE)
    assert one.maps["unknown"].sum() > 200
    assert "unknown" not in six.maps
    wrong = [
        (drawn.shadow != (truth.counts[0] > 0))[truth.sure(width=2) & (truth.objects == 0)] for drawn in (one, six)
    ]
    assert wrong[0].sum() > 50
    assert not wrong[1].any()
    assert six.warnings == []


def test_slope_factor_one_is_enough_on_every_face() -> None:
    scene = Scene.named("room")
    inside = replace(scene, objects=tuple(replace(thing, casts=True) for thing in scene.objects[:6]))
    options = {"map_size": 32, "units": 0.0, "size": SIZE}
    assert draw("map-cube", inside, factor=0.0, **options).shadow.sum() > 100
    # a wall ends where the next begins: only there is a texel's plane not the wall's
    corner = ~off_the_edges(cast_rays(inside).objects, 3)
    assert not (draw("map-cube", inside, factor=1.0, **options).shadow & ~corner).any()


def test_a_light_at_infinity_has_no_inside() -> None:
    with pytest.raises(SceneError, match="'sun' is at infinity; map-cube expected point lights"):
        draw("map-cube", Scene.named("sunlight"))


def test_two_lights_have_cubes_of_their_own() -> None:
    both = replace(INSIDE, lights=(Light((0, 1.7, 0.2), (0.4,) * 3, "a"), Light((0.5, 2.2, 0.9), (0.4,) * 3, "b")))
    drawn = draw("map-cube", both, map_size=128)
    for light in both.lights:
        alone = draw("map-cube", replace(both, lights=(light,)), map_size=128)
        assert (drawn.maps[f"visibility of {light.name}"] == alone.maps["visibility"]).all()
