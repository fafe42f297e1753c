"""Projected planar shadows: five methods, each with its failure."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from softshadow import techniques
from softshadow.errors import SceneError
from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes
from softshadow.techniques import planar
from strategies import floor_scenes
from techniques.drawn_frames import SIZE, cast_rays, draw, off_the_edges

METHODS = techniques.get("planar").options["method"].choices

FLOOR = SceneObject(shapes.floor(4), casts=False, receives=True, name="floor")
BOX = SceneObject(shapes.box(0.8), placement((0, 1, 0)), name="box")
# seen from above, box and shadow side by side, sky round the floor
SCENE = Scene("test", Camera((0, 7, 4), (0, 0, 0), near=1, far=20), (Light((-2.5, 5, 0)),), (FLOOR, BOX))


def with_objects(*objects: SceneObject) -> Scene:
    return replace(SCENE, objects=objects)


@settings(max_examples=10)
@given(floor_scenes())
def test_stencil_shadow_is_where_the_ray_to_the_light_is_blocked(scene: Scene) -> None:
    drawn, truth = draw("planar", scene), cast_rays(scene)
    compared = drawn.maps["valid"] & truth.sure()
    assert compared.any()
    assert (drawn.shadow == (truth.counts[0] > 0))[compared].all()


def test_stencil_marks_just_the_receiver_then_unmarks_just_the_shadow() -> None:
    drawn = draw("planar", SCENE)
    mark, unmark = drawn.titles[:2]
    floor = drawn.depth[mark] < 1
    assert (drawn.stencil[mark] == floor).all()
    shadow = floor & (drawn.stencil[unmark] == 0)
    truth = cast_rays(SCENE)
    seen = truth.sure() & (truth.objects == 0)
    assert (shadow & seen).any()
    assert (shadow == (truth.counts[0] > 0))[seen].all()


def test_stencil_darkens_no_pixel_off_the_receiver() -> None:
    # the light stands low: the shadow is longer than the floor
    scene = replace(SCENE, lights=(Light((-3, 1.8, 0)),))
    drawn = draw("planar", scene)
    sky = drawn.depth[drawn.titles[0]] == 1
    dark = drawn.color["draw the dark part of the receivers"]
    assert (dark[sky] == dark[0, 0]).all()
    for method in ("depth-off", "offset"):
        painted = draw("planar", scene, method=method).color["draw the flattened casters"]
        assert (painted[sky] != painted[0, 0]).any()


def test_a_second_receiver_keeps_its_light_where_the_first_has_shadow() -> None:
    # a table on the line of sight to the shadow on the floor, in the light itself
    table = SceneObject(shapes.floor(0.6), placement((0.54, 2.1, 1.2)), casts=False, receives=True, name="table")
    scene = with_objects(FLOOR, table, BOX)
    drawn, solid = draw("planar", scene), draw("volume-zfail", scene)
    compared = drawn.maps["valid"] & off_the_edges(solid.maps["visibility"])
    assert (drawn.shadow == solid.shadow)[compared].all()
    wrong = draw("planar", scene, method="depth-off")
    assert (wrong.shadow & ~solid.shadow & compared).any()


@pytest.mark.parametrize("method", METHODS)
def test_all_methods_agree_on_a_wide_floor(method: str) -> None:
    scene = with_objects(replace(FLOOR, mesh=shapes.floor(40)), BOX)
    shadow, reference = draw("planar", scene, method=method).shadow, draw("planar", scene).shadow
    # the texture has texels of 40 / 256, more than a pixel: nothing is sure within two pixels of an edge
    off = off_the_edges(reference, 2)
    assert reference[off].any()
    assert (shadow == reference)[off].all()
    if method in ("depth-off", "stencil-blend"):
        assert (shadow == reference).all()


def test_depth_off_paints_a_convex_caster_twice_and_stencil_blend_darkens_once() -> None:
    painted = draw("planar", SCENE, method="depth-off").stencil["draw the flattened casters"]
    inside = off_the_edges(painted) & (painted > 0)
    assert inside.any()
    assert (painted[inside] == 2).all()  # the side towards the light and the side away from it
    blended = draw("planar", SCENE, method="stencil-blend")
    before, after = (blended.color[title].astype(float) for title in blended.titles[:2])
    dark = (blended.stencil[blended.titles[1]] == 0) & (blended.stencil[blended.titles[0]] == 1)
    assert dark.any()
    # half a step for the rounding of the factor, half a step for that of the product
    assert np.abs(after[dark, :3] - (1 - planar.DARKNESS) * before[dark, :3]).max() <= 1
    assert (after[~dark] == before[~dark]).all()


def test_offset_fights_for_depth_without_an_offset() -> None:
    right = draw("planar", SCENE, method="offset").stencil["draw the flattened casters"] > 0
    fighting = draw("planar", SCENE, method="offset", factor=0.0, units=0.0)
    painted = fighting.stencil["draw the flattened casters"] > 0
    floor = fighting.depth["draw the receivers"] < 1
    assert 0 < (painted & floor).sum() < (right & floor).sum()


def test_what_is_below_the_receiver_casts_on_it_only_without_clipping() -> None:
    below = replace(BOX, object_to_world=placement((0, -1, 0)), name="below")
    across = replace(BOX, object_to_world=placement((0, 0.5, 0), scale=1.8), name="across")
    scene = with_objects(FLOOR, below)
    assert not draw("planar", scene).shadow.any()
    assert draw("planar", scene, clip=False).shadow.any()
    # a caster that goes through the floor casts with its upper part
    half = with_objects(FLOOR, across)
    drawn, truth = draw("planar", half), cast_rays(half)
    compared = truth.sure() & drawn.maps["valid"]
    assert (drawn.shadow & compared).any()
    assert (drawn.shadow == (truth.counts[0] > 0))[compared].all()


def test_what_is_behind_the_light_casts_no_shadow() -> None:
    behind = replace(BOX, object_to_world=placement((-2.5, 6, 0)), name="behind")
    between = replace(BOX, object_to_world=placement((-2.5, 4.9, 0)), name="round the light")
    assert not draw("planar", with_objects(FLOOR, behind)).shadow.any()
    assert draw("planar", with_objects(FLOOR, between)).shadow.any()


def test_a_light_in_the_plane_of_the_receiver_casts_no_shadow_on_it() -> None:
    assert not draw("planar", replace(SCENE, lights=(Light((-6, 0, 0)),))).shadow.any()


@pytest.mark.parametrize("method", ["stencil", "texture"])
def test_each_light_is_left_out_just_in_its_own_shadow(method: str) -> None:
    lights = (Light((-2.5, 5, 0), np.full(3, 0.4), "left"), Light((2.5, 5, 1), np.full(3, 0.4), "right"))
    scene = replace(SCENE, lights=lights)
    both = draw("planar", scene, method=method)
    left, right = (draw("planar", replace(scene, lights=(one,)), method=method) for one in lights)
    assert (both.maps["visibility of left"] == left.maps["visibility"]).all()
    assert (both.maps["visibility of right"] == right.maps["visibility"]).all()
    ambient = np.round(255 * 0.8 * scene.ambient[0])
    floor = both.maps["valid"]
    total = left.image[floor, :3].astype(int) + right.image[floor, :3] - int(ambient)
    # each of the three pictures is rounded to whole steps once or twice
    assert np.abs(both.image[floor, :3] - total).max() <= 2


@pytest.mark.parametrize(
    ("method", "draws"),
    [
        ("depth-off", [["floor"], ["box"], ["box"]]),
        ("offset", [["floor"], ["box"], ["box"]]),
        ("stencil", [["floor"], ["box"], ["floor"], ["box"]]),
        ("stencil-blend", [["floor"], ["box"], ["box"]]),
        ("texture", [["box"], ["floor"], ["floor"], ["box"]]),
    ],
)
def test_passes_are_those_of_the_table(method: str, draws: list[list[str]]) -> None:
    assert list(draw("planar", SCENE, method=method).objects.values()) == draws


@pytest.mark.parametrize("method", METHODS)
def test_maps_are_float_visibility_and_where_it_is_valid(method: str) -> None:
    maps = draw("planar", SCENE, method=method).maps
    assert maps["visibility"].dtype == np.float32
    assert maps["valid"].dtype == bool
    assert maps["visibility"].shape == maps["valid"].shape == SIZE[::-1]
    assert (maps["visibility"][~maps["valid"]] == 1).all()


def test_more_lights_or_receivers_than_there_are_numbers_for_is_an_error() -> None:
    lights = tuple(Light((x, 5, 0), name=f"light {x}") for x in range(9))
    with pytest.raises(SceneError, match="9 lights; expected at most 8"):
        draw("planar", replace(SCENE, lights=lights))
    floors = tuple(replace(FLOOR, object_to_world=placement((0, -y, 0)), name=f"floor {y}") for y in range(256))
    with pytest.raises(SceneError, match="256 receivers; expected at most 255"):
        draw("planar", with_objects(*floors, BOX))
    assert draw("planar", with_objects(*floors, BOX), method="depth-off").shadow.any()


def test_a_scene_without_receivers_is_drawn_without_shadows() -> None:
    drawn = draw("planar", with_objects(BOX))
    assert not drawn.maps["valid"].any()
    assert (drawn.image != drawn.image[0, 0]).any()
