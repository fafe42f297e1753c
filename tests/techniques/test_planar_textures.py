"""Shadows kept in textures: drawn once, laid over the receivers from any camera."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

import softshadow as ss
from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes
from softshadow.techniques import Technique
from softshadow.techniques.planar_texture import delete_textures, draw, shadow_textures
from techniques.drawn_frames import SIZE, in_context
from techniques.drawn_frames import draw as drawn_by

FLOOR = SceneObject(shapes.floor(4), casts=False, receives=True, name="floor")
WALL = SceneObject(shapes.quad((-2, 0, -2), (4, 0, 0), (0, 3, 0)), casts=False, receives=True, name="wall")
BOX = SceneObject(shapes.box(0.8), placement((0, 1, 0)), name="box")
LIGHTS = (Light((-2.5, 5, 1), np.full(3, 0.4), "left"), Light((2.5, 5, 2), np.full(3, 0.4), "right"))
SCENE = Scene("test", Camera((0, 4, 6), (0, 0.5, 0), near=1, far=20), LIGHTS, (FLOOR, WALL, BOX))
CAMERAS = (SCENE.camera, Camera((3, 2, 4), (0, 0.5, 0), near=0.5, far=30), Camera((-1, 6, 1), (0, 0, 0), far=30))


def test_textures_drawn_once_give_every_camera_the_picture_of_its_own() -> None:
    def program(gl: Any) -> list[np.ndarray]:
        shadows, pictures = shadow_textures(gl, SCENE), []
        for camera in CAMERAS:
            for _ in draw(gl, replace(SCENE, camera=camera), SIZE, shadows):
                pass
            pictures.append(gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE))
        delete_textures(gl, shadows)
        return pictures

    for camera, picture in zip(CAMERAS, in_context(program), strict=True):
        assert (picture == drawn_by("planar", replace(SCENE, camera=camera), method="texture").image).all()


def test_a_further_camera_costs_no_draw_of_a_flattened_caster() -> None:
    def steps(gl: Any, scene: Scene, *, size: tuple[int, int]) -> Iterator[Any]:
        shadows = shadow_textures(gl, scene)
        yield "textures", shadows.images
        for number, camera in enumerate(CAMERAS):
            for _ in draw(gl, replace(scene, camera=camera), size, shadows):
                pass
            yield f"camera {number}"

    frame = ss.run(Technique("several cameras", "", "planar", "", steps, {}), SCENE, SIZE)
    textures, *cameras = frame.ledger.steps
    assert textures.draws == len(LIGHTS) * 2  # the box onto floor and wall
    # floor and wall without light, floor and wall for each light, and the box: as often as the scene has objects
    assert [one.draws for one in cameras] == [2 + len(LIGHTS) * 2 + 1] * len(CAMERAS)
    whole = ss.run("planar", SCENE, SIZE, method="texture").ledger.total
    assert textures.draws + cameras[0].draws == whole.draws
