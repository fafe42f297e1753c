"""Variance shadow maps: the box of percentage-closer filtering on flat surfaces, and light where casters overlap."""

import numpy as np
import pytest

from softshadow.scene import Camera, Light, Scene, SceneObject, placement, scene_names, shapes
from techniques.drawn_frames import cast_rays, draw, off_the_edges

SIZE = (160, 120)
SLAB, OVERLAP = Scene.named("soft-slab"), Scene.named("soft-overlap")


@pytest.mark.parametrize("blur", [0, 1, 3])
def test_on_flat_surfaces_the_bound_is_the_share_of_texels(blur: int) -> None:
    options = {"map_size": 128}
    variance = draw("map-variance", SLAB, SIZE, blur=blur, least_variance=0.0, **options).maps["visibility"]
    filtered = draw("map-pcf", SLAB, SIZE, kernel=2 * blur + 1, bilinear=True, **options).maps["visibility"]
    floor = cast_rays(SLAB, SIZE).objects == 0
    assert ((filtered > 0) & (filtered < 1) & floor).sum() > 50
    # the variance is a difference of float32 squares: 2^-24 of depths near 1, over a variance of some 0.1
    assert np.abs(variance - filtered)[floor].max() < 2e-4


@pytest.mark.parametrize("name", scene_names())
@pytest.mark.filterwarnings("ignore::softshadow.Warning")
def test_visibility_is_a_share(name: str) -> None:
    seen = draw("map-variance", Scene.named(name), map_size=128).maps["visibility"]
    assert seen.min() >= 0
    assert seen.max() <= 1


def bleeding(bleed: float) -> np.ndarray:
    """How much of the light reaches pixels whose neighbours within 6 pixels are in the shadow of both slabs or one."""
    truth = cast_rays(OVERLAP, SIZE)
    shadow = (truth.counts[0] > 0) & (truth.objects == 0)
    inside = shadow & off_the_edges(shadow, 6)
    return draw("map-variance", OVERLAP, SIZE, blur=4, bleed=bleed).maps["visibility"][inside]


def test_light_bleeds_in_where_casters_overlap_and_reduction_takes_it_away() -> None:
    """The known failure: the edge of the upper slab's shadow lies inside the lower one's, and is lit up to a third."""
    light, reduced, dark = (bleeding(bleed) for bleed in (0.0, 0.15, 0.5))
    assert light.max() > 0.3
    assert reduced.max() < light.max()
    assert dark.max() == 0


def test_a_slope_needs_no_offset() -> None:
    roof = SceneObject(shapes.floor(2, 1), placement((0, 1, 0), (35, 1, 0, 0.3)), receives=True, name="roof")
    slope = Scene("slope", Camera((3, 4, 6), (0, 1, 0), fov_y=20, near=1, far=30), (Light((-2.5, 5, 1)),), (roof,))
    drawn = draw("map-variance", slope, map_size=32)
    inside = off_the_edges(drawn.maps["valid"], 2) & drawn.maps["valid"]
    assert drawn.maps["visibility"][inside].min() > 0.9


def test_maps_are_the_moments_of_the_linear_depth() -> None:
    maps = draw("map-variance", SLAB, map_size=64).maps
    depth, square = np.moveaxis(maps["moments"], -1, 0)
    assert (square == depth * depth).all()
    assert set(np.unique(depth[28:36, 28:36])) == {depth[32, 32]}  # the slab is parallel to the map
    assert maps["blurred moments"].mean() == pytest.approx(maps["moments"].mean(), rel=0.02)
