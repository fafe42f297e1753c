"""Demonstrations about shadow volumes: what is counted, from where, and how often it is drawn."""

from typing import Any

import numpy as np

from softshadow.demonstrations.demonstration import Demonstration, finish, number, stencil_of
from softshadow.listings.counting import ambient_scene, begin_count, count_passes, draw_volumes, volumes_around_eye
from softshadow.listings.stage import NEAR_SHADOW, STAGE, Stage
from softshadow.scene import Scene, shapes
from softshadow.scene.silhouette import silhouette

ENABLED = frozenset({"E1"})
NEGATIVE = 128  # a count of 8 bits that wraps: from here on it stands for a number below 0


def count(gl: Any, stage: Stage, faces: str = "both", mask: int = 0xFF) -> np.ndarray:
    """Return the stencil buffer after counting the front faces, the back faces, or both, in front of the scene."""
    finish(ambient_scene(gl, stage))
    begin_count(gl, ENABLED, gl.GL_BACK)
    gl.glStencilFunc(gl.GL_ALWAYS, 0, mask)
    if faces in ("front", "both"):
        gl.glCullFace(gl.GL_BACK)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR_WRAP)
        draw_volumes(gl, stage, closed=True)
    if faces in ("back", "both"):
        gl.glCullFace(gl.GL_FRONT)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR_WRAP if faces == "back" else gl.GL_DECR_WRAP)
        draw_volumes(gl, stage, closed=True)
    gl.glDisable(gl.GL_STENCIL_TEST)
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glDepthMask(gl.GL_TRUE)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    return stencil_of(gl)


def negative_differences(gl: Any) -> list[int]:
    """E9: pixels with more back faces than front faces, the eye outside all volumes, and between them."""
    return [number(count(gl, stage) >= NEGATIVE) for stage in (STAGE, NEAR_SHADOW)]


def mask_of_always(gl: Any) -> list[int]:
    """E39: pixels with a count, by the mask 0 of CA:425 and by all bits."""
    return [number(count(gl, STAGE, mask=mask)) for mask in (0, 0xFF)]


def count_or_difference(gl: Any) -> list[int]:
    """E58: pixels where the counter after Pasul 3 is not #PUV, and where it is not #PUV − #PUN."""
    front, back, both = (count(gl, STAGE, faces) for faces in ("front", "back", "both"))
    return [number(both != front), number(both != front - back)]


def second_frame(gl: Any) -> list[int]:
    """E61: pixels whose count is not that of the first frame, if the stencil buffer is not cleared and if it is."""
    first = count(gl, STAGE)
    changed = []
    for cleared in (False, True):
        if cleared:
            gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        finish(count_passes(gl, ENABLED, STAGE))
        gl.glDisable(gl.GL_STENCIL_TEST)
        changed.append(number(stencil_of(gl) != first))
    return changed


def start_values(gl: Any) -> list[int]:
    """E25: volumes around the eye of two views of one scene."""
    return [volumes_around_eye(STAGE), volumes_around_eye(NEAR_SHADOW)]


def silhouette_loops(gl: Any) -> list[int]:
    """E12: loops of the silhouette of a torus, seen along its axis."""
    edges = silhouette(shapes.torus(), np.array([0.0, 4.0, 0.0, 1.0])).edges
    following: dict[int, int] = dict(edges.tolist())
    loops = 0
    while following:
        vertex = next(iter(following))
        while vertex in following:
            vertex = following.pop(vertex)
        loops += 1
    return [1, loops]


def volume_draws(gl: Any) -> list[int]:
    """E18: passes of a z-pass run that draw volumes: those without any receiver."""
    from softshadow.runs import run

    scene = Scene.named("torus")
    drawn = run("volume-zpass", scene, (48, 36))
    receivers = {each.name for each in scene.receivers}
    return [1, sum(not receivers & set(names) for names in drawn.ledger.total.passes)]


def missing_penumbra(gl: Any) -> list[int]:
    """E24: pixels of 64 x 48 that see a part of an area light: in a hard picture, and in truth."""
    from softshadow.inspection.soft_truth import soft_truth
    from softshadow.runs import run
    from softshadow.scene import Light

    scene, size = Scene.named("soft-slab"), (64, 48)
    lights = tuple(Light(light.position, light.color, light.name) for light in scene.lights)
    point = Scene(
        scene.name, scene.camera, lights, scene.objects, ambient=scene.ambient, background=scene.background
    )  # fmt: skip
    hard, truth = run("volume-zfail", point, size), soft_truth(scene, size)
    return [number((share > 0) & (share < 1)) for share in (hard.visibility[hard.valid], truth.visibility[truth.valid])]


DEMONSTRATIONS = (
    Demonstration("negative-differences", "pixels with #PUV < #PUN: eye outside, eye among volumes",
                  negative_differences),
    Demonstration("silhouette-loops", "loops of a torus's silhouette", silhouette_loops, on_mesa=False),
    Demonstration("volume-draws", "draws of the volumes in a frame", volume_draws, on_mesa=False),
    Demonstration("missing-penumbra", "pixels in penumbra, of 64×48", missing_penumbra, on_mesa=False),
    Demonstration("start-values", "volumes around the eye, in two views", start_values, on_mesa=False),
    Demonstration("mask-of-always", "pixels with a count: mask 0, mask 255", mask_of_always),
    Demonstration("count-or-difference", "pixels where the counter differs from #PUV; from #PUV − #PUN",
                  count_or_difference),
    Demonstration("second-frame", "pixels with another count in the second frame: without, with glClear", second_frame),
)  # fmt: skip
