"""Spot lights: dark outside the cone, and one map along the axis holds all of it."""

from dataclasses import replace

import numpy as np
import pytest

from softshadow.scene import Light, Scene
from softshadow.techniques.light_camera import light_camera
from techniques.drawn_frames import SIZE, Truth, cast_rays, draw, off_the_edges

SCENE = Scene.named("spotlight")
LIGHT = SCENE.lights[0]


def lit_by_rays(scene: Scene, truth: Truth) -> np.ndarray:
    """Whether each pixel's point is within the cone and sees the light."""
    return (truth.counts[0] == 0) & scene.lights[0].shines_on(truth.points)


@pytest.mark.parametrize("technique", ["planar", "volume-zpass", "volume-zfail", "map", "map-distance"])
def test_visibility_is_that_of_rays_within_the_cone(technique: str) -> None:
    drawn, truth = draw(technique, SCENE), cast_rays(SCENE)
    lit = lit_by_rays(SCENE, truth)
    compared = truth.sure(width=2) & off_the_edges(lit, 2) & drawn.maps["valid"]
    if technique.startswith("map"):
        compared &= truth.objects == 0  # on casters, seen at an angle, a texel is wider than a pixel
    assert 100 < (lit & compared).sum() < compared.sum() - 100
    assert ((drawn.maps["visibility"] == 1) == lit)[compared].all()


@pytest.mark.parametrize("technique", ["map", "map-distance"])
@pytest.mark.parametrize(("cutoff", "rise"), [(10.0, -2.0), (35.0, -2.0), (70.0, 0.4), (90.0, 0.9)])
def test_maps_light_nothing_outside_the_cone(cutoff: float, rise: float, technique: str) -> None:
    # the floor is one quad: lit at its vertices alone, it would be dark
    floor = replace(SCENE.objects[0], mesh=Scene.named("boxes").objects[0].mesh)
    light = Light(LIGHT.position, axis=(1, rise, -1), cutoff=cutoff)
    scene = replace(SCENE, objects=(floor, *SCENE.objects[1:]), lights=(light,))
    drawn, truth = draw(technique, scene), cast_rays(scene)
    inside = light.shines_on(truth.points)
    sure = off_the_edges(inside, 1) & (truth.objects == 0)
    added = (drawn.image != drawn.color["draw the scene without the light"]).any(axis=2)
    assert not added[sure & ~inside].any()
    assert added[sure & inside & truth.sure() & (truth.counts[0] == 0) & ~drawn.maps["unknown"]].all()
    assert (sure & ~inside).any()
    assert (sure & inside).any()


def test_what_a_spot_does_not_shine_on_is_not_unknown() -> None:
    drawn = draw("map", SCENE)
    assert not drawn.maps["unknown"].any()
    assert drawn.warnings == []
    assert not cast_rays(SCENE).sure()[light_camera(SCENE, LIGHT).sees(cast_rays(SCENE).points)].all()


def test_the_camera_looks_along_the_axis_and_holds_the_cone() -> None:
    camera = light_camera(SCENE, LIGHT)
    assert LIGHT.axis is not None
    assert camera.frame[2] == pytest.approx(LIGHT.axis, abs=1e-15)  # rounding of a unit vector
    turned = np.linspace(0, 2 * np.pi, 12)
    side = np.tan(np.radians(LIGHT.cutoff)) * (1 - 1e-12)  # rounding of a tangent
    rim = camera.frame[2] + side * (
        np.cos(turned)[:, None] * camera.frame[0] + np.sin(turned)[:, None] * camera.frame[1]
    )
    assert camera.sees(camera.eye + 5 * rim).all()


def test_two_spots_light_what_either_shines_on() -> None:
    other = Light((2.5, 4, 1), (0.4, 0.4, 0.4), "other", axis=(-2.5, -4, -1), cutoff=12)
    scene = replace(SCENE, lights=(Light(LIGHT.position, (0.4,) * 3, "spot", axis=LIGHT.axis, cutoff=20), other))
    both = draw("map", scene, SIZE)
    for light in scene.lights:
        alone = draw("map", replace(scene, lights=(light,)), SIZE)
        assert (both.maps[f"visibility of {light.name}"] == alone.maps["visibility"]).all()
