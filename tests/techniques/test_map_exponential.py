"""Exponential shadow maps: nearer to percentage-closer filtering with every larger exponent, until floats overflow."""

from itertools import pairwise

import numpy as np
import pytest

from softshadow.scene import Scene, scene_names
from softshadow.techniques import get
from softshadow.techniques.map_exponential import largest_exponent
from techniques.drawn_frames import cast_rays, draw, in_context, off_the_edges

SIZE = (160, 120)
SLAB = Scene.named("soft-slab")


def test_it_approaches_percentage_closer_filtering_as_the_exponent_grows() -> None:
    options = {"map_size": 128}
    filtered = draw("map-pcf", SLAB, SIZE, kernel=5, bilinear=True, **options).maps["visibility"]
    floor = cast_rays(SLAB, SIZE).objects == 0
    errors = [
        np.abs(draw("map-exponential", SLAB, SIZE, exponent=c, **options).maps["visibility"] - filtered)[floor].max()
        for c in (2.0, 5.0, 10.0, 20.0, 40.0, 80.0)
    ]
    assert errors[0] > 0.2
    assert all(2 * later < earlier for earlier, later in pairwise(errors[:4]))
    # what is left is rounding: 2^-24 of c d, which is up to 80
    assert max(errors[4:]) < 1e-5


def test_light_bleeds_in_behind_casters_for_small_exponents() -> None:
    """The known failure: within 1 / exponent of the depth range behind the caster, its shadow fades."""
    scene = Scene.named("thin-wall")
    truth = cast_rays(scene, SIZE)
    shadow = (truth.counts[0] > 0) & (truth.objects == 0)
    inside = shadow & off_the_edges(shadow, 4)
    light = [
        draw("map-exponential", scene, SIZE, exponent=c).maps["visibility"][inside].max() for c in (5.0, 20.0, 80.0)
    ]
    assert light == sorted(light, reverse=True)
    assert light[0] > 0.4


@pytest.mark.parametrize("name", scene_names())
@pytest.mark.filterwarnings("ignore::softshadow.Warning")
def test_visibility_is_a_share(name: str) -> None:
    seen = draw("map-exponential", Scene.named(name), map_size=128).maps["visibility"]
    assert seen.min() >= 0
    assert seen.max() <= 1


@pytest.mark.parametrize("blur", [0, 2, 64])
def test_largest_exponent_does_not_overflow(blur: int) -> None:
    drawn = draw("map-exponential", SLAB, map_size=64, blur=blur, exponent=largest_exponent(blur))
    assert np.isfinite(drawn.maps["blurred powers"]).all()
    assert np.isfinite(drawn.maps["quotient"]).all()


def test_an_exponent_that_overflows_is_refused() -> None:
    options = get("map-exponential").validate_options({"exponent": 90.0})
    with pytest.raises(ValueError, match=r"option exponent=90: expected at most 87\.\d with blur=2; .* overflows"):
        in_context(lambda gl: next(iter(get("map-exponential").steps(gl, SLAB, size=(8, 8), **options))))
