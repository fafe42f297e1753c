"""Blob shadows: what they depend on, and what they do not."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from softshadow.scene import Camera, Light, Mesh, Scene, SceneObject, placement, shapes
from strategies import floor_scenes
from techniques.drawn_frames import draw

FLOOR = SceneObject(shapes.floor(8), casts=False, receives=True, name="floor")
BALL = SceneObject(shapes.sphere(0.5, 16, 8), placement((0.5, 1, 0)), name="ball")
ABOVE = Camera((0, 9, 0.01), (0, 0, 0), near=1, far=20)
SCENE = Scene("test", ABOVE, (Light((-2.5, 5, 0)),), (FLOOR, BALL))

BLEND = "blend the blobs"
STEP = 1 / 255  # the colour buffer holds alpha in steps of this


def blob_of(scene: Scene, **options: float) -> np.ndarray:
    """Return what the blobs leave of the light, (h, w) float64."""
    return draw("blob", scene, **options).color[BLEND][:, :, 3] / 255


def with_caster(caster: SceneObject) -> Scene:
    return replace(SCENE, objects=(FLOOR, caster))


@settings(max_examples=8)
@given(floor_scenes(), floor_scenes())
def test_no_light_has_a_part_in_a_blob(scene: Scene, other: Scene) -> None:
    assert (blob_of(scene) == blob_of(replace(scene, lights=other.lights))).all()


def test_two_casters_of_the_same_centre_and_size_have_the_same_blob() -> None:
    # the corners of a box round the origin are as far from it as the ball's poles
    side = 1 / np.sqrt(3)
    box = replace(BALL, mesh=shapes.box(side, side, side), name="box")
    assert np.abs(blob_of(with_caster(BALL)) - blob_of(with_caster(box))).max() <= STEP


def test_the_blob_is_darkest_at_the_foot_of_the_caster_and_ends_at_its_radius() -> None:
    left = blob_of(SCENE, radius=2.0)
    rows, columns = np.nonzero(left < 1)
    middle = np.unravel_index(left.argmin(), left.shape)
    # the eye looks straight down from 9: half the picture's height of 48 spans 9 tan(22.5°)
    pixels = 24 / (9 * np.tan(np.radians(22.5)))
    assert middle[0] == pytest.approx(24, abs=1)
    assert middle[1] == pytest.approx(32 + 0.5 * pixels, abs=1)
    # the outermost ring takes less than half a step and is rounded away
    assert np.hypot(rows - middle[0], columns - middle[1]).max() == pytest.approx(1.0 * pixels, abs=1.5)


def test_a_blob_fades_with_the_height_and_is_gone_at_the_end() -> None:
    heights = (0.5, 1, 1.5)
    scenes = [with_caster(replace(BALL, object_to_world=placement((0, y, 0)))) for y in heights]
    depths = [1 - blob_of(scene, radius=6.0).min() for scene in scenes]
    # 4 radii of 0.5 are a height of 2; a pixel's centre is up to 0.7 from the middle of a blob of 19: hence the tenth
    assert depths == pytest.approx([0.6 * (1 - y / 2) for y in heights], rel=0.1)
    assert (blob_of(with_caster(replace(BALL, object_to_world=placement((0, 2, 0))))) == 1).all()


def test_a_caster_below_a_receiver_leaves_no_blob_on_it() -> None:
    assert (blob_of(with_caster(replace(BALL, object_to_world=placement((0, -0.2, 0))))) == 1).all()


def test_blobs_of_several_casters_multiply() -> None:
    near = replace(BALL, object_to_world=placement((0.9, 0.8, 0.1)), name="near")
    both = blob_of(replace(SCENE, objects=(FLOOR, BALL, near)))
    one, other = blob_of(with_caster(BALL)), blob_of(with_caster(near))
    assert ((one < 1) & (other < 1)).any()
    assert np.abs(both - one * other).max() <= 2 * STEP


def test_a_blob_stays_on_its_receiver_and_every_receiver_has_its_own() -> None:
    table = SceneObject(shapes.floor(1), placement((0.5, 0.5, 0)), casts=False, receives=True, name="table")
    drawn = draw("blob", replace(SCENE, objects=(FLOOR, table, replace(BALL, name="ball"))), radius=3.0)
    marked, left = drawn.stencil[BLEND], drawn.color[BLEND][:, :, 3]
    for number in (1, 2):
        assert (left[marked == number] < 255).any()
    assert (left[marked == 0] == 255).all()
    assert drawn.objects[BLEND] == ["ball", "ball"]


def test_what_a_blob_leaves_is_the_visibility_of_every_light() -> None:
    lights = (Light((-2.5, 5, 0), name="left"), Light((2.5, 5, 1), name="right"))
    maps = draw("blob", replace(SCENE, lights=lights), radius=3.0).maps
    assert (maps["visibility of left"] == maps["visibility of right"]).all()
    assert (maps["visibility"] == maps["visibility of left"]).all()
    assert ((maps["visibility"] > 0) & (maps["visibility"] < 1)).any()
    assert (maps["visibility"][~maps["valid"]] == 1).all()


def test_a_receiver_that_casts_has_no_blob_of_its_own() -> None:
    board = SceneObject(Mesh(shapes.floor(2).positions, shapes.floor(2).triangles), receives=True, name="board")
    assert (blob_of(replace(SCENE, objects=(board,))) == 1).all()
