"""Shadow polygons drawn over their faces: each method, and the cameras they serve."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes
from softshadow.techniques import shadow_polygons as technique
from softshadow.techniques.detail_polygons import FORMS, shadow_polygons
from softshadow.techniques.planar import DARKNESS
from strategies import floor_scenes
from techniques.drawn_frames import SIZE, cast_rays, draw, in_context, off_the_edges

FLOOR = SceneObject(shapes.floor(8), casts=False, receives=True, name="floor")
BOX = SceneObject(shapes.box(0.8), placement((0, 1, 0), (-20, 0, 1, 0)), name="box")
# a wall in front of the shadow, as the camera sees it, and in the light itself
WALL = SceneObject(shapes.box(0.6, 1.1, 0.1), placement((1.6, 0.55, 1.5)), name="wall")
SCENE = Scene(
    "test", Camera((2.5, 2.8, 6.5), (0.6, 0.4, 0), near=1, far=30), (Light((-2.5, 4, 3.5)),), (FLOOR, BOX, WALL)
)

MARK = "mark the shadow polygons"


@settings(max_examples=8)
@given(floor_scenes(), st.sampled_from(FORMS))
def test_decals_are_where_the_ray_to_the_light_is_blocked(scene: Scene, form: str) -> None:
    drawn, truth = draw("shadow-polygons", scene, form=form, method="decal"), cast_rays(scene)
    compared = drawn.maps["valid"] & truth.sure()
    assert compared.any()
    wrong = (drawn.shadow != (truth.counts[0] > 0)) & compared
    # where polygons of neighbouring faces meet, corners rounded to float32 may leave a sample to neither
    assert wrong.sum() <= 1


@settings(max_examples=6)
@given(floor_scenes())
def test_offset_darkens_every_shadow_and_reaches_a_pixel_beyond_the_surface_at_most(scene: Scene) -> None:
    drawn, truth = draw("shadow-polygons", scene), cast_rays(scene)
    dark = truth.counts[0] > 0
    compared = drawn.maps["valid"] & truth.sure()
    assert (dark & compared & ~drawn.shadow).sum() <= 1  # see above
    # a pixel's slope nearer, polygons show before what stands up to a pixel beside them
    near = ~off_the_edges(drawn.shadow & dark)
    assert not (drawn.shadow & ~dark & compared & ~near).any()


def test_all_methods_and_forms_agree_off_the_edges() -> None:
    size = (160, 120)
    reference = draw("shadow-polygons", SCENE, size, method="decal")
    off = off_the_edges(reference.shadow, 2) & off_the_edges(cast_rays(SCENE, size).objects, 2)
    assert reference.shadow[off].any()
    for form in FORMS:
        for method in ("offset", "decal"):
            drawn = draw("shadow-polygons", SCENE, size, form=form, method=method)
            assert (drawn.shadow == reference.shadow)[off].all()


def test_depth_off_marks_what_stands_before_a_shadow() -> None:
    right, wrong = (draw("shadow-polygons", SCENE, method=method) for method in ("decal", "depth-off"))
    assert (wrong.shadow >= right.shadow).all()
    truth = cast_rays(SCENE)
    on_wall = (truth.objects == 2) & truth.sure()
    assert (wrong.shadow & (truth.counts[0] == 0) & on_wall).any()
    assert not (right.shadow & (truth.counts[0] == 0) & on_wall).any()


def test_without_an_offset_faces_and_polygons_fight() -> None:
    right = draw("shadow-polygons", SCENE, method="decal").shadow
    fighting = draw("shadow-polygons", SCENE, method="offset", factor=0.0, units=0.0).shadow
    floor = cast_rays(SCENE).objects == 0
    assert 0 < (fighting & floor).sum() < (right & floor).sum()


def test_polygons_made_once_serve_every_camera() -> None:
    polygons = [shadow_polygons(SCENE, light) for light in SCENE.lights]
    for camera in (SCENE.camera, Camera((-4, 2, -3), (0, 0.5, 0), near=0.5, far=40)):
        scene = replace(SCENE, camera=camera)

        def program(gl: Any, scene: Scene = scene) -> np.ndarray:
            for _ in technique.draw(gl, scene, SIZE, polygons):
                pass
            return gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)

        assert (in_context(program) == draw("shadow-polygons", scene).image).all()


def test_the_back_of_a_sheet_is_dark_and_its_front_is_lit() -> None:
    sheet = SceneObject(shapes.floor(2), placement((0, 1, 0), (-30, 1, 0, 0)), name="sheet")
    scene = replace(SCENE, objects=(FLOOR, sheet), lights=(Light((0, 5, -3)),))
    for eye, dark in (((0, 4, -6), False), ((0, 0.3, 5), True)):
        seen = replace(scene, camera=Camera(eye, (0, 1, 0), near=1, far=30))
        drawn, truth = draw("shadow-polygons", seen), cast_rays(seen)
        on_sheet = (truth.objects == 1) & off_the_edges(truth.objects)
        assert on_sheet.any()
        assert (drawn.shadow[on_sheet] == dark).all()


def test_modulating_darkens_shadows_by_a_share_and_unlit_faces_twice() -> None:
    added, modulated = draw("shadow-polygons", SCENE), draw("shadow-polygons", SCENE, combine="modulate")
    assert (added.shadow == modulated.shadow).all()
    shadow = added.shadow
    before = modulated.color["draw the scene with all lights"].astype(float)
    # half a step for the rounding of the factor, half a step for that of the product
    assert np.abs(modulated.image[shadow, :3] - (1 - DARKNESS) * before[shadow, :3]).max() <= 1
    assert (modulated.image[~shadow] == before[~shadow]).all()
    # the sides of the box that look away from the light have its ambient light only, before they are darkened
    unlit = shadow & (cast_rays(SCENE).objects == 1)
    assert unlit.any()
    assert (before[unlit] == added.image[unlit]).all()
    assert (modulated.image[unlit, :3] < added.image[unlit, :3]).all()


@pytest.mark.parametrize("method", ["offset", "decal", "depth-off"])
def test_steps_draw_scene_polygons_and_light(method: str) -> None:
    drawn = draw("shadow-polygons", replace(SCENE, objects=(FLOOR, BOX)), method=method)
    scene, polygons, light = drawn.objects.values()
    assert scene == light == ["floor", "box"]
    assert set(polygons) == {"floor", "box"}
    assert (drawn.depth[MARK] == drawn.depth[drawn.titles[0]]).all()
    assert (drawn.color[MARK] == drawn.color[drawn.titles[0]]).all()
