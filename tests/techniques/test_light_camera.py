"""The camera in the light sees every caster."""

import numpy as np
import pytest
from hypothesis import given

from softshadow.scene import Scene, scene_names
from softshadow.techniques.light_camera import WIDEST, light_camera
from strategies import floor_scenes


@given(floor_scenes())
def test_every_caster_is_seen_between_near_and_far(scene: Scene) -> None:
    camera = light_camera(scene, scene.lights[0])
    assert camera.parallel == scene.lights[0].is_directional
    for caster in scene.casters:
        assert camera.sees(caster.world_positions).all()
        depth = (caster.world_positions - camera.eye) @ camera.frame[2]
        assert (depth > camera.near).all()
        assert (depth < camera.far).all()


@given(floor_scenes())
def test_the_map_is_no_larger_than_the_casters_need(scene: Scene) -> None:
    camera = light_camera(scene, scene.lights[0])
    tight = type(camera)(
        camera.eye, camera.target, camera.up, camera.half / 1.1, camera.near, camera.far, camera.parallel
    )
    assert not all(tight.sees(caster.world_positions).all() for caster in scene.casters)


@pytest.mark.parametrize("name", scene_names())
def test_a_light_among_its_casters_keeps_a_usable_camera(name: str) -> None:
    scene = Scene.named(name)
    for light in scene.lights:
        camera = light_camera(scene, light)
        assert 0 < camera.near < camera.far
        assert camera.parallel or 0 < camera.half <= WIDEST
        assert np.isfinite(camera.frame).all()


def test_frame_is_that_of_the_view() -> None:
    camera = light_camera(Scene.named("boxes"), Scene.named("boxes").lights[0])
    # rounding of unit vectors in double precision
    assert np.allclose(camera.frame @ camera.frame.T, np.eye(3), atol=1e-15)
    ahead = camera.eye + 2 * camera.frame[2]
    assert camera.sees(ahead)
    assert not camera.sees(camera.eye - 2 * camera.frame[2])
    assert camera.sees(ahead + 1.99 * camera.half * camera.frame[0])
    assert not camera.sees(ahead + 2.01 * camera.half * camera.frame[1])
