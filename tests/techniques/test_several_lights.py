"""Several lights, a rule of all techniques: the ambient light once, and every light where its own shadow is not."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from softshadow.scene import Camera, Light, Material, Scene, SceneObject, placement, shapes
from softshadow.techniques import drawing
from strategies import floor_scenes
from techniques.drawn_frames import SIZE, cast_rays, draw, in_context

ADDING: list[tuple[str, dict[str, Any]]] = [
    ("planar", {"method": "stencil"}),
    ("planar", {"method": "texture"}),
    ("shadow-polygons", {"method": "decal"}),
    ("volume-zpass", {}),
    ("volume-zfail", {}),
    ("map", {}),
]
# each light's part is rounded to a step of 1/255 when it is added, in one order or another
ONE_STEP_PER_LIGHT = 3

LIGHTS = (
    Light((-2.5, 5, 1), (0.4, 0.1, 0.1), "red"),
    Light((2, 4, 2), (0.1, 0.4, 0.1), "green"),
    Light((0, 4, -1, 0), (0.1, 0.1, 0.4), "blue"),
)
FLOOR = SceneObject(shapes.floor(8), casts=False, receives=True, name="floor")
BOX = SceneObject(shapes.box(0.8), placement((0, 1, 0), (20, 0, 1, 0)), name="box")
RING = SceneObject(shapes.torus(0.4, 0.15, 8, 5), placement((0.9, 0.6, 0.5)), name="ring")
SCENE = Scene("test", Camera((3, 4, 5), (0, 0.3, 0), near=1, far=30), LIGHTS, (FLOOR, BOX, RING))


def parts_of(scene: Scene) -> list[np.ndarray]:
    """Return the picture by ambient light alone, then what each light adds without shadows; (h, w, 3) float64."""

    def program(gl: Any) -> list[np.ndarray]:
        drawing.begin_frame(gl, replace(scene, background=(0, 0, 0)))
        drawing.set_camera(gl, scene.camera, SIZE)
        drawing.light_ambient_only(gl, scene)
        drawing.draw_objects(gl, scene.objects)
        parts = [gl.glReadPixels(0, 0, *SIZE, gl.GL_RGB, gl.GL_UNSIGNED_BYTE).astype(float)]
        for light in scene.lights:
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            drawing.light_by(gl, scene, [light], ambient=False)
            with drawing.additive_blending(gl):
                drawing.draw_objects(gl, scene.objects, emission=False)
            parts.append(gl.glReadPixels(0, 0, *SIZE, gl.GL_RGB, gl.GL_UNSIGNED_BYTE).astype(float))
        return parts

    return in_context(program)


@pytest.mark.parametrize(("technique", "options"), ADDING)
def test_the_picture_is_the_ambient_light_and_each_light_where_it_is_seen(technique, options) -> None:  # type: ignore[no-untyped-def]
    drawn, (ambient, *direct) = draw(technique, SCENE, **options), parts_of(SCENE)
    visible = [drawn.maps[f"visibility of {light.name}"][:, :, None] for light in LIGHTS]
    expected = ambient + sum(v * part for v, part in zip(visible, direct, strict=True))
    valid = drawn.maps["valid"]
    assert np.abs(drawn.image[valid, :3] - np.minimum(expected, 255)[valid]).max() <= ONE_STEP_PER_LIGHT
    for one in visible:
        assert 0 < one[valid].mean() < 1


@pytest.mark.parametrize(
    ("technique", "options"),
    [*ADDING, ("volume-zpass-plus", {}), ("volume-parity", {}), ("map-pcf", {}), ("map-distance", {})],
)
def test_attenuated_lights_are_added_and_emission_is_drawn_once(technique, options) -> None:  # type: ignore[no-untyped-def]
    lamps = [light if light.is_directional else replace(light, attenuation=(0.5, 0.1, 0.02)) for light in LIGHTS]
    glowing = replace(FLOOR, material=Material((0.5, 0.6, 0.7), emission=(0.05, 0.2, 0.1)))
    scene = replace(SCENE, lights=lamps, objects=(glowing, BOX, RING))
    drawn, (ambient, *direct) = draw(technique, scene, **options), parts_of(scene)
    visible = [drawn.maps[f"visibility of {light.name}"][:, :, None] for light in lamps]
    expected = ambient + sum(v * part for v, part in zip(visible, direct, strict=True))
    valid = drawn.maps["valid"]
    assert np.abs(drawn.image[valid, :3] - np.minimum(expected, 255)[valid]).max() <= ONE_STEP_PER_LIGHT

    plain, *_ = parts_of(replace(scene, objects=(replace(glowing, material=Material((0.5, 0.6, 0.7))), BOX, RING)))
    differences = np.unique(np.rint(ambient - plain).reshape(-1, 3), axis=0)
    assert np.abs(differences - [13, 51, 25]).max(axis=1).min() <= 1  # the floor's emission times 255, and 0 elsewhere
    assert len(np.unique(direct[0][drawn.maps["valid"]], axis=0)) > 5  # attenuation: many levels on one flat floor


@settings(max_examples=4)
@given(floor_scenes(lights=2))
def test_each_light_is_seen_where_its_ray_is_free(scene: Scene) -> None:
    truth = cast_rays(scene)
    for technique, options in (("planar", {}), ("shadow-polygons", {"method": "decal"}), ("volume-zfail", {})):
        drawn = draw(technique, scene, **options)
        for index, light in enumerate(scene.lights):
            compared = drawn.maps["valid"] & truth.sure(index)
            wrong = (drawn.maps[f"visibility of {light.name}"] == 0) != (truth.counts[index] > 0)
            # shadow polygons: corners rounded to float32 may leave a sample to neither of two faces
            assert (wrong & compared).sum() <= (technique == "shadow-polygons")


@pytest.mark.parametrize(("technique", "options"), ADDING)
def test_the_order_of_the_lights_makes_no_difference(technique: str, options: dict[str, Any]) -> None:
    one = draw(technique, SCENE, **options)
    other = draw(technique, replace(SCENE, lights=LIGHTS[::-1]), **options)
    for light in LIGHTS:
        name = f"visibility of {light.name}"
        assert (one.maps[name] == other.maps[name]).all()
    assert np.abs(one.image.astype(int) - other.image).max() <= ONE_STEP_PER_LIGHT


@pytest.mark.parametrize(
    ("technique", "options"),
    [("shadow-polygons", {"combine": "modulate", "method": "decal"}), ("planar", {"method": "stencil-blend"})],
)
def test_modulating_shows_the_shadow_of_one_light_where_the_others_shine(technique, options) -> None:  # type: ignore[no-untyped-def]
    drawn = draw(technique, SCENE, **options)
    ambient, *direct = parts_of(SCENE)
    valid = drawn.maps["valid"]
    visible = [drawn.maps[f"visibility of {light.name}"] for light in LIGHTS]
    right = ambient + sum(v[:, :, None] * part for v, part in zip(visible, direct, strict=True))
    hidden = len(LIGHTS) - sum(visible)
    # lit by all it is right; with one light hidden its share is taken of the others' light, too
    lit, one, two = (valid & (hidden == count) for count in (0, 1, 2))
    assert np.abs(drawn.image[lit, :3] - right[lit]).max() <= ONE_STEP_PER_LIGHT
    assert np.abs(drawn.image[one, :3] - right[one]).max() > 8 * ONE_STEP_PER_LIGHT
    # where two are hidden it is darker than the ambient light leaves it with the third
    assert two.any()
    assert (drawn.image[two, :3].sum(axis=1) < right[two].sum(axis=1)).all()
