"""Which casters stand between the light and the near rectangle, also where the light sees it edge-on."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from softshadow.errors import NearClipZPass
from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes
from softshadow.techniques.near_rectangle import corners, counts_by_rays, seen_edge_on, shadows_near_rectangle
from strategies import coordinates, scenes_from_within
from techniques.drawn_frames import SIZE, draw

FARS = st.sampled_from(["infinite", "clamp"])
BOX = shapes.box(0.8)


@given(scenes_from_within(), FARS)
def test_a_caster_that_shadows_a_start_point_shadows_the_near_rectangle(scene: Scene, far: str) -> None:
    light = scene.lights[0]
    for caster in scene.casters:
        reached = counts_by_rays(scene.camera, light, [caster], SIZE, far).any()
        assert shadows_near_rectangle(caster, light, scene.camera, SIZE, far) or not reached


@given(
    st.tuples(*[coordinates(-1, 1)] * 3),
    st.sampled_from([(0.0, 1.0, 0.0, 0.0), (0.0, 6.0, 0.2, 1.0), (0.5, 6.0, 0.2, 1.0)]),
    FARS,
)
@example((0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), "infinite")
@example((0.0, 0.0, 0.5), (0.0, 1.0, 0.0, 0.0), "infinite")  # before the near plane, and beside the rectangle
def test_a_light_in_the_near_plane_is_shadowed_where_rays_are(
    move: tuple[float, ...], light: tuple[float, ...], far: str
) -> None:
    camera = Camera((0, 0, 1), (0, 0, 0), near=0.8)
    source, caster = Light(light), SceneObject(BOX, placement(np.add(move, (0, 2.5, 0.2))), name="box")
    assert far == "clamp" or seen_edge_on(source, corners(camera, SIZE, far))
    reached = counts_by_rays(camera, source, [caster], SIZE, far).any()
    said = shadows_near_rectangle(caster, source, camera, SIZE, far)
    # where it is not seen edge-on, also points of the rectangle between the pixels' count
    assert said == reached or (far == "clamp" and said)


@pytest.mark.parametrize(("aside", "warned"), [(0.0, True), (2.5, False)])
def test_a_box_above_a_level_camera_is_warned_of_where_its_shadow_meets_it(aside: float, warned: bool) -> None:
    floor = SceneObject(shapes.floor(12), casts=False, receives=True, name="floor")
    box = SceneObject(BOX, placement((aside, 3, 0.2)), name="box")
    scene = Scene("level", Camera((0, 1, 1), (0, 1, 0), near=0.8), (Light((0, 1, 0, 0)),), (floor, box))
    assert (NearClipZPass in draw("volume-zpass", scene).warnings) == warned
    zfail = draw("volume-zfail", scene).maps["visibility"]
    for technique, options in (
        ("volume-zpass", {"start": "near-plane"}),
        ("volume-zpass", {"choose": "per-caster"}),
        ("volume-zpass-plus", {}),
    ):
        assert (draw(technique, scene, **options).maps["visibility"] == zfail).all()
