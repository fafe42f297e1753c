"""Where z-pass starts to count: 0, the count at the eye, or each pixel's own."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from softshadow.errors import NearClipZPass
from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes
from softshadow.techniques import drawing, start_value
from softshadow.techniques.near_rectangle import eye_count, near_counts
from strategies import scenes_from_within
from techniques.drawn_frames import SIZE, begin_count, cast_rays, draw, in_context, off_the_edges

COUNTED, COUNTED_BY_ZFAIL = "count back faces", "count front faces"
SHADOWED, CUT = Scene.named("eye-in-shadow"), Scene.named("near-cut")


def on_the_near_rectangle(scene: Scene, far: str = "infinite") -> np.ndarray:
    return near_counts(scene, scene.lights[0], scene.casters, SIZE, far)


@settings(max_examples=15)
@given(scenes_from_within())
def test_zpass_and_the_near_plane_count_are_zfail(scene: Scene) -> None:
    near = on_the_near_rectangle(scene)
    zpass, zfail = draw("volume-zpass", scene).stencil[COUNTED], draw("volume-zfail", scene).stencil[COUNTED_BY_ZFAIL]
    # where the near plane cuts a volume, rays and clipped sides may take a sample on the edge to different sides
    differing = zpass != zfail - near.astype(np.uint8)
    assert not (differing & off_the_edges(near)).any()


@settings(max_examples=15)
@given(scenes_from_within())
def test_zpass_from_the_near_plane_count_is_zfail(scene: Scene) -> None:
    drawn = draw("volume-zpass", scene, start="near-plane")
    near = drawn.maps["near-plane count"]
    assert (drawn.stencil["start from the counts on the near rectangle"] == near).all()
    differing = drawn.stencil[COUNTED] != draw("volume-zfail", scene).stencil[COUNTED_BY_ZFAIL]
    assert not (differing & off_the_edges(near)).any()
    assert NearClipZPass not in drawn.warnings


@settings(max_examples=15)
@given(scenes_from_within())
def test_near_caps_drawn_by_the_light_are_the_near_plane_count(scene: Scene) -> None:
    drawn = draw("volume-zpass-plus", scene)
    near = on_the_near_rectangle(scene)
    # the flattened faces have their corners snapped to the sub-pixel grid, rays have not
    assert not ((drawn.maps["near-plane count"] != near) & off_the_edges(near)).any()
    differing = drawn.stencil[COUNTED] != draw("volume-zfail", scene).stencil[COUNTED_BY_ZFAIL]
    assert not (differing & off_the_edges(near)).any()
    assert near.any() or not differing.any()


@settings(max_examples=15)
@given(
    scenes_from_within(),
    st.fixed_dictionaries(
        {
            "far": st.sampled_from(["infinite", "clamp", "finite"]),
            "cap": st.sampled_from(["infinite", "finite"]),
            "ops": st.sampled_from(["wrap", "saturate"]),
            "generator": st.sampled_from(["silhouette", "per-polygon"]),
        }
    ),
)
def test_zpass_after_a_preload_is_zfail_to_the_bit(scene: Scene, options: dict[str, Any]) -> None:
    preloaded = draw("volume-zpass", scene, start="preload", **options)
    zfail = draw("volume-zfail", scene, **{**options, "ops": "wrap"})
    if options["far"] == "finite" and options["ops"] == "saturate":
        return  # volumes that the far plane cuts open count below 0, where saturating counters stop
    assert (preloaded.stencil[COUNTED] == zfail.stencil[COUNTED_BY_ZFAIL]).all()
    assert NearClipZPass not in preloaded.warnings


@pytest.mark.parametrize("far", ["infinite", "clamp"])
@pytest.mark.parametrize(
    ("scene", "start", "right"),
    [
        (SHADOWED, "none", False), (SHADOWED, "eye", True), (SHADOWED, "near-plane", True),
        (CUT, "none", False), (CUT, "eye", False), (CUT, "near-plane", True),
    ],
)  # fmt: skip
def test_a_start_is_warned_of_where_it_is_wrong_and_only_there(scene: Scene, start: str, right: bool, far: str) -> None:
    # under depth clamping the count starts at the eye, which no volume cuts
    right = right or (start == "eye" and far == "clamp")
    drawn = draw("volume-zpass", scene, start=start, far=far)
    truth = cast_rays(scene)
    wrong = (drawn.stencil[COUNTED] != truth.counts[0]) & truth.sure()
    assert wrong.any() != right
    assert drawn.warnings == ([] if right else [NearClipZPass])


def test_a_shadow_that_meets_the_eye_and_not_the_near_rectangle_makes_the_count_at_the_eye_wrong() -> None:
    floor = SceneObject(shapes.floor(12), casts=False, receives=True, name="floor")
    box = SceneObject(shapes.box(0.5), placement((0, 0.5, -2)), name="box")
    speck = SceneObject(shapes.box(0.1), placement((0, 2.5, 3)), name="speck")
    scene = Scene("lamp above", Camera((0, 2, 3), (0, 0, -3), near=1), (Light((0, 9, 3)),), (floor, box, speck))
    assert eye_count(scene, scene.lights[0], scene.casters) == 1
    assert not on_the_near_rectangle(scene).any()
    assert draw("volume-zpass", scene).warnings == []
    assert draw("volume-zpass", scene, start="eye").warnings == [NearClipZPass]
    zfail = draw("volume-zfail", scene).stencil[COUNTED_BY_ZFAIL]
    assert (draw("volume-zpass", scene, start="eye").stencil[COUNTED] == zfail + 1).all()


@pytest.mark.parametrize("technique", ["volume-zpass", "volume-zpass-plus"])
def test_every_light_starts_from_its_own_count(technique: str) -> None:
    sun = Light((0.3, 2, -1, 0), np.full(3, 0.4), "sun")
    scene = replace(CUT, lights=(replace_color(CUT.lights[0]), sun))
    options = {"start": "near-plane"} if technique == "volume-zpass" else {}
    both = draw(technique, scene, **options)
    for light in scene.lights:
        one = draw(technique, replace(scene, lights=(light,)), **options)
        assert (both.stencil[f"{COUNTED}: {light.name}"] == one.stencil[COUNTED]).all()
        assert (both.maps[f"near-plane count: {light.name}"] == one.maps["near-plane count"]).all()
        assert (both.maps[f"visibility of {light.name}"] == one.maps["visibility"]).all()


def replace_color(light: Light) -> Light:
    return Light(light.position, np.full(3, 0.4), "lamp")


@settings(max_examples=20)
@given(arrays(np.int32, (SIZE[1], SIZE[0]), elements=st.integers(0, 3), fill=st.just(0)))
def test_written_stencil_values_are_read_back(values: np.ndarray) -> None:
    def program(gl: Any) -> np.ndarray:
        drawing.set_camera(gl, SHADOWED.camera, SIZE)
        begin_count(gl)
        start_value.write_stencil(gl, values, SIZE)
        return drawing.read_stencil(gl, SIZE)

    assert (in_context(program) == values).all()


def test_a_count_that_the_buffer_does_not_hold_wraps_or_stops() -> None:
    def program(gl: Any) -> tuple[int, int]:
        wrapped = start_value.limited(gl, 258, (gl.GL_INCR_WRAP, gl.GL_DECR_WRAP))
        return wrapped, start_value.limited(gl, 258, (gl.GL_INCR, gl.GL_DECR))

    assert in_context(program) == (2, 255)
