"""Shadow volumes by parity: right where no two volumes overlap, and only there."""

import numpy as np
import pytest
from hypothesis import assume, given, settings

from softshadow.errors import NearClipZPass
from softshadow.scene import Scene, scene_names
from strategies import floor_scenes
from techniques.drawn_frames import Drawn, cast_rays, draw

OVERLAPPING = {"overlapping", "soft-overlap", "open-tube"}


def parity_and_count(scene: Scene) -> tuple[Drawn, np.ndarray, np.ndarray]:
    """The drawn parity, its bit before the last light is added, and the count of z-fail."""
    parity, zfail = draw("volume-parity", scene), draw("volume-zfail", scene)
    return parity, parity.stencil[parity.titles[-1]], zfail.stencil[zfail.titles[-1]]


@settings(max_examples=15)
@given(floor_scenes())
def test_parity_is_the_lowest_bit_of_the_count(scene: Scene) -> None:
    parity, bit, count = parity_and_count(scene)
    assume(NearClipZPass not in parity.warnings)
    assert (bit == count & 1).all()
    wrong = (bit == 0) != (count == 0)
    assert (wrong == ((count > 0) & (count % 2 == 0))).all()


@pytest.mark.parametrize("name", sorted({*scene_names()} - {"eye-in-shadow", "near-cut"}))
def test_parity_is_right_exactly_where_volumes_do_not_overlap(name: str) -> None:
    scene = Scene.named(name)
    drawn, bit, count = parity_and_count(scene)
    assert (bit == count & 1).all()
    truth = cast_rays(scene)
    wrong = truth.sure(-1) & ((bit == 0) != (truth.counts[-1] == 0))
    assert wrong.any() == (name in OVERLAPPING)
    assert (truth.counts[-1][wrong] >= 2).all()
    assert drawn.warnings == []


def test_a_near_rectangle_in_shadow_turns_parity_round() -> None:
    drawn, bit, count = parity_and_count(Scene.named("eye-in-shadow"))
    assert drawn.warnings == [NearClipZPass]
    assert (bit == (count + 1) & 1).all()


def test_one_draw_of_the_volumes_is_enough() -> None:
    assert draw("volume-parity", Scene.named("torus")).objects == {
        "draw the scene without the light": ["floor", "torus"],
        "invert at every face": ["torus"],
        "add the light where the parity is even": ["floor", "torus"],
    }
