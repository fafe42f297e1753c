"""Percentage-closer filtering: one texel is a hard map, and the offset that a square needs."""

import numpy as np
import pytest

from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes
from softshadow.techniques import get
from techniques.drawn_frames import cast_rays, draw, in_context

ROOF = SceneObject(shapes.floor(2, 1), placement((0, 1, 0), (35, 1, 0, 0.3)), receives=True, name="roof")
SLOPE = Scene("slope", Camera((3, 4, 6), (0, 1, 0), fov_y=20, near=1, far=30), (Light((-2.5, 5, 1)),), (ROOF,))


@pytest.mark.parametrize("scene", ["boxes", "torus", "sunlight", "spotlight"])
def test_one_texel_is_the_hard_map(scene: str) -> None:
    hard, filtered = (
        draw(name, Scene.named(scene), **options).maps["visibility"]
        for name, options in (("map", {}), ("map-pcf", {"kernel": 1}))
    )
    # the program divides by q where the fixed function multiplies by its reciprocal: a place on the edge of two texels
    assert (hard != filtered).sum() <= 1


@pytest.mark.parametrize("kernel", [1, 3, 5])
@pytest.mark.parametrize("bilinear", [False, True])
def test_default_offset_is_enough_for_every_kernel(kernel: int, bilinear: bool) -> None:
    options = {"map_size": 32, "units": 0.0, "kernel": kernel, "bilinear": bilinear}
    assert not draw("map-pcf", SLOPE, **options).shadow.any()
    assert draw("map-pcf", SLOPE, factor=0.0, **options).shadow.sum() > 40


def test_offset_for_one_texel_is_not_enough_for_more() -> None:
    assert draw("map-pcf", SLOPE, map_size=32, units=0.0, kernel=5, factor=1.0).shadow.any()


def test_off_the_ramp_the_visibility_is_that_of_rays() -> None:
    scene = Scene.named("boxes")
    truth = cast_rays(scene)
    seen = draw("map-pcf", scene, kernel=3).maps["visibility"]
    compared = truth.sure(width=2) & (truth.objects == 0)
    assert ((seen > 0.5) == (truth.counts[0] == 0))[compared].all()
    inner = truth.sure(width=4) & (truth.objects == 0)  # the ramp is three texels, less than four pixels
    assert (np.isin(seen, (0, 1)))[inner].all()


def test_light_is_added_in_proportion_to_the_visibility() -> None:
    scene = Scene.named("boxes")
    drawn = draw("map-pcf", scene, map_size=64, kernel=5)
    ambient = drawn.color["draw the scene without the light"].astype(int)
    half = drawn.maps["visibility"]
    full = draw("map-pcf", scene, map_size=64, kernel=5, factor=1e6).image.astype(int)  # an offset beyond everything
    ramp = (half > 0) & (half < 1)
    expected = ambient + half[..., None] * (full - ambient)
    # the pass is rounded to 8 bits, and so is the light that it is a share of
    assert np.abs(drawn.image - expected)[ramp].max() <= 1.5
    assert ramp.sum() > 50


def test_a_square_needs_a_middle() -> None:
    options = get("map-pcf").validate_options({"kernel": 4})
    with pytest.raises(ValueError, match="option kernel=4: expected an odd number"):
        in_context(lambda gl: next(iter(get("map-pcf").steps(gl, SLOPE, size=(8, 8), **options))))
