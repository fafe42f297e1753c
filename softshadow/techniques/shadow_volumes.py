"""What all ways of counting share: the volumes of a light, how they are drawn, and the light pass after the count.

A volume is made in its object's own space, with the light carried there, and drawn under the object's own modelview
matrix: its light cap then has the depth of the surface it lies on, bit for bit.
"""

import warnings
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from softshadow.errors import CounterSaturated
from softshadow.scene import Light, Scene, SceneObject
from softshadow.scene.shadow_volume import ShadowVolume, shadow_volume
from softshadow.techniques.drawing import (
    added,
    draw_objects,
    draw_polygons,
    draw_triangles,
    light_by,
    object_space,
)
from softshadow.techniques.technique import Option

OPTIONS = {
    "generator": Option(
        "silhouette",
        str,
        "sides at the silhouette of each caster, or a volume for each lit polygon",
        choices=("silhouette", "per-polygon"),
    ),
    "cap": Option("infinite", str, "where the volume ends", choices=("infinite", "finite")),
    "reach": Option(
        None,
        float,
        "finite cap: every point nearer to the light than this is covered; by default the whole scene is",
        minimum=1e-6,
    ),
    "far": Option(
        "infinite",
        str,
        "far plane: an infinite projection, GL_DEPTH_CLAMP, or the camera's own, which may cut volumes open",
        choices=("infinite", "clamp", "finite"),
    ),
    "ops": Option(
        "wrap",
        str,
        "stencil counters that wrap around, or stop at 0 and the largest value",
        choices=("wrap", "saturate"),
    ),
    "two_sided": Option(False, bool, "count front and back faces in one pass with glStencilOpSeparate"),
}

# a little further than the farthest vertex, so that rounding does not leave it outside
BEYOND = 1.01


@dataclass(frozen=True, eq=False)
class CasterVolume:
    """A caster, and its volume in the caster's own space."""

    caster: SceneObject
    volume: ShadowVolume


def volumes_of(scene: Scene, light: Light, generator: str, cap: str, reach: float | None) -> list[CasterVolume]:
    """Return the volume of every caster; `reach` is in world units and counts for the finite cap only."""
    volumes = []
    for caster in scene.casters:
        extrusion: Any = "infinite"
        if cap == "finite":
            # the shortest object-space length of a world length: the smallest singular value shrinks least when
            # divided by
            shrunk = np.linalg.svd(caster.object_to_world[:3, :3], compute_uv=False)[-1]
            extrusion = float((scene_reach(scene, light) if reach is None else reach) / shrunk)
        in_object_space = light.in_object_space(caster.object_to_world)
        volume = shadow_volume(caster.mesh, in_object_space, generator=generator, extrusion=extrusion)  # type: ignore[arg-type]
        volumes.append(CasterVolume(caster, volume))
    return volumes


def scene_reach(scene: Scene, light: Light) -> float:
    """Return how far shadows reach at most: to the vertex farthest from a point light, or across the scene."""
    vertices = np.concatenate([thing.world_positions for thing in scene.objects])
    spread = np.ptp(vertices, axis=0) if light.is_directional else vertices - light.position[:3]
    return BEYOND * float(np.linalg.norm(spread, axis=-1).max())


def draw_volumes(
    gl: Any, volumes: Iterable[CasterVolume], light_caps: bool = True, dark_caps: bool = True, sides: bool = True
) -> None:
    """Draw the sides and the caps of volumes, counter-clockwise seen from outside."""
    for item in volumes:
        volume = item.volume
        with object_space(gl, item.caster):
            gl.glFrontFace(gl.GL_CCW)
            if sides:
                draw_polygons(gl, volume.sides)
            # the surface's own vertices in the surface's own order: what faces the other way turns the rule, not the
            # order
            for positions, is_drawn, kept, turned in (
                (volume.far_vertices, dark_caps and len(volume.far_vertices), gl.GL_CW, gl.GL_CCW),
                (item.caster.mesh.positions, light_caps, gl.GL_CCW, gl.GL_CW),
            ):
                if is_drawn:
                    gl.glFrontFace(kept)
                    draw_triangles(gl, positions, volume.light_cap)
                    gl.glFrontFace(turned)
                    draw_triangles(gl, positions, volume.light_cap_reversed)
            gl.glFrontFace(gl.GL_CCW)


def begin_count(gl: Any) -> None:
    """Set what holds while volumes are counted: nothing but the stencil buffer changes."""
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)  # E1: without both tests nothing is counted
    gl.glEnable(gl.GL_CULL_FACE)
    gl.glDepthMask(gl.GL_FALSE)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)


def end_count(gl: Any) -> None:
    """Let colour and depth be written again, and draw both sides of surfaces again (E3)."""
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glDepthMask(gl.GL_TRUE)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)


def counting_ops(gl: Any, ops: str) -> tuple[int, int]:
    """Return the stencil operations that count up and down."""
    return (gl.GL_INCR_WRAP, gl.GL_DECR_WRAP) if ops == "wrap" else (gl.GL_INCR, gl.GL_DECR)


def add_light(gl: Any, scene: Scene, light: Light) -> None:
    """Add a light where the count is 0; the test takes all bits (E38), the stencil buffer stays as it is."""
    gl.glStencilFunc(gl.GL_EQUAL, 0, 0xFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
    light_by(gl, scene, [light], ambient=False)
    with added(gl):
        draw_objects(gl, scene.objects)
    gl.glDisable(gl.GL_STENCIL_TEST)


def warn_when_saturated(gl: Any, stencil: np.ndarray, ops: str, light: Light) -> None:
    """Warn where a counter stands at its largest value and may have lost counts (E11)."""
    largest = 2 ** int(gl.glGetIntegerv(gl.GL_STENCIL_BITS)) - 1
    if ops == "saturate" and (stencil == largest).any():
        warnings.warn(
            f"light {light.name!r}: {int((stencil == largest).sum())} pixels have the largest count, {largest}; "
            "counts beyond it are lost, and shadow may turn into light there",
            CounterSaturated,
            stacklevel=3,
        )
