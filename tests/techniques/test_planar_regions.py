"""Planar shadows: which parts of a caster cast, and how often the flattened casters paint a pixel."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from softshadow import matrices
from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes
from softshadow.techniques import get
from softshadow.truth import casting_faces_between
from strategies import floor_scenes
from techniques.drawn_frames import SIZE, cast_rays, draw, in_context, off_the_edges

FLOOR = SceneObject(shapes.floor(8), casts=False, receives=True, name="floor")
BOX = SceneObject(shapes.box(0.8), placement((0, 1, 0)), name="box")
# low between boxes, so that one of them is behind the light as the floor sees it
LAMP = Light((-1, 2.0, 0))
BEHIND = SceneObject(shapes.box(0.6), placement((-1.3, 3, 0.2)), name="behind")
SCENE = Scene("test", Camera((0, 7, 4), (0, 0, 0), near=1, far=20), (LAMP,), (FLOOR, BOX, BEHIND))

PAINT = "draw the flattened casters"


def painted(scene: Scene, depth_clamp: bool = False, **options: Any) -> np.ndarray:
    """Return (h, w): how often the flattened casters paint a pixel."""

    def program(gl: Any) -> np.ndarray:
        if depth_clamp:
            gl.glEnable(gl.GL_DEPTH_CLAMP)
        planar = get("planar")
        given = planar.validate_options({"method": "depth-off", **options})
        for title in planar.steps(gl, scene, size=SIZE, **given):
            if title == PAINT:
                return gl.glReadPixels(0, 0, *SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
        raise AssertionError(f"no step {PAINT!r}")

    return in_context(program)


@settings(max_examples=8)
@given(floor_scenes())
def test_a_pixel_is_painted_once_for_every_face_between_it_and_the_light(scene: Scene) -> None:
    counts, truth = painted(scene), cast_rays(scene)
    on_floor = truth.objects == 0
    points = truth.points[on_floor]
    layers = np.zeros(counts.shape, int)
    layers[on_floor] = casting_faces_between(points, scene.lights[0].position, scene.casters, faces="all")
    compared = truth.sure() & on_floor & off_the_edges(layers)
    assert compared.any()
    assert (counts == layers)[compared].all()
    blended = draw("planar", scene, method="stencil-blend")
    assert ((blended.stencil[blended.titles[1]] == 0) == (layers > 0))[compared].all()  # once, however many layers


def test_gl_clips_the_anti_shadow_away_unless_depth_is_clamped() -> None:
    # with the eye between the light and the anti-shadow: w is positive once more, and only the far plane cuts
    high = SceneObject(shapes.box(0.6), placement((-1, 2.6, -3)), name="high")
    scene = replace(SCENE, camera=Camera((0, 2, 6), (0, 1.5, 0), near=1, far=20), objects=(FLOOR, high))
    assert not painted(scene, clip=False).any()
    assert painted(scene, clip=False, depth_clamp=True).any()
    assert not painted(scene, clip=True, depth_clamp=True).any()
    # before the eye w is negative: nothing is seen of it, clamped or not
    assert not painted(replace(SCENE, objects=(FLOOR, BEHIND)), clip=False, depth_clamp=True).any()


def test_nothing_hides_the_false_shadow_but_clipping() -> None:
    below = SceneObject(shapes.box(0.6), placement((0.5, -1, 0)), name="below")
    alone = replace(SCENE, objects=(FLOOR, below))
    assert painted(alone, clip=False).any()
    assert not painted(alone, clip=True).any()


def test_with_the_other_sign_nothing_is_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    right = matrices.planar_shadow
    assert painted(SCENE).any()
    monkeypatch.setattr(matrices, "planar_shadow", lambda plane, light: -right(plane, light))
    assert not painted(SCENE).any()


@pytest.mark.parametrize("method", ["stencil", "texture"])
def test_every_wall_of_a_room_receives_its_own_shadows(method: str) -> None:
    scene = Scene.named("room")
    size = (160, 120)
    drawn, truth = draw("planar", scene, size, method=method, texture_size=512), cast_rays(scene, size)
    # texels of 7 / 512 are less than a pixel, but an edge lies up to a texel beside its own
    compared = drawn.maps["valid"] & truth.sure(width=1 if method == "stencil" else 2)
    receivers = [k for k, thing in enumerate(scene.objects) if any(thing is one for one in scene.receivers)]
    shadowed = [k for k in receivers if (truth.counts[0][compared & (truth.objects == k)] > 0).any()]
    assert len(shadowed) >= 3
    assert (drawn.shadow == (truth.counts[0] > 0))[compared].all()
