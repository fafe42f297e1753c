"""What all techniques with shadow volumes share: options, the volumes of a light, how they are drawn, the lit pixels.

A volume is built and drawn in the space of its caster, under the caster's own modelview matrix: the depth of its light
cap is then, bit for bit, that of the surface it lies on.
"""

import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np

from softshadow.errors import CounterSaturated
from softshadow.scene import Light, Scene, SceneObject
from softshadow.scene.shadow_volume import ShadowVolume, shadow_volume
from softshadow.techniques import drawing
from softshadow.techniques.technique import Range

Generator = Annotated[
    Literal["silhouette", "per-polygon"], "sides at the silhouette of each caster, or a volume for each lit polygon"
]
Cap = Annotated[Literal["infinite", "finite"], "where the volume ends"]
Reach = Annotated[
    float | None,
    "finite cap: every point nearer to the light than this is covered; by default the whole scene is",
    Range(1e-6),
]
Far = Annotated[
    Literal["infinite", "clamp", "finite"],
    "far plane: an infinite projection, GL_DEPTH_CLAMP, or the camera's own, which may cut volumes open",
]
Ops = Annotated[
    Literal["wrap", "saturate"], "stencil counters that wrap around, or that stop at 0 and at the largest value"
]
TwoSided = Annotated[bool, "count front and back faces in one pass with glStencilOpSeparate"]

# a little farther than the farthest vertex, so that rounding does not leave it outside
BEYOND = 1.01


@dataclass(frozen=True, eq=False)
class CasterVolume:
    """A caster, and its volume in the caster's own space."""

    caster: SceneObject
    volume: ShadowVolume


def volumes_of(
    scene: Scene,
    light: Light,
    generator: Generator = "silhouette",
    cap: Cap = "infinite",
    reach: Reach = None,
) -> list[CasterVolume]:
    """Return the volume of every caster; `reach` is in world units and matters for the finite cap only."""
    volumes = []
    for caster in scene.casters:
        extrusion: Any = "infinite"
        if cap == "finite":
            # a world length in object space: divided by the smallest scale it is long enough in every direction
            smallest_scale = np.linalg.svd(caster.object_to_world[:3, :3], compute_uv=False)[-1]
            extrusion = float((scene_reach(scene, light) if reach is None else reach) / smallest_scale)
        in_object_space = light.in_object_space(caster.object_to_world)
        volume = shadow_volume(caster.mesh, in_object_space, generator=generator, extrusion=extrusion)
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
        with drawing.object_space(gl, item.caster):
            gl.glFrontFace(gl.GL_CCW)
            if sides:
                draw_sides(gl, item)
            # caps repeat the surface's vertices in the surface's order, for equal depths; where that order is clockwise
            # seen from outside, glFrontFace is reversed instead
            for part, positions, is_drawn, front_face, reversed_front_face in (
                ("far cap", volume.far_vertices, dark_caps and len(volume.far_vertices), gl.GL_CW, gl.GL_CCW),
                ("near cap", item.caster.mesh.positions, light_caps, gl.GL_CCW, gl.GL_CW),
            ):
                if is_drawn:
                    gl.glFrontFace(front_face)
                    with drawing.made_of(gl, part, "face", volume.cap_faces, [item.caster]):
                        drawing.draw_triangles(gl, positions, volume.light_cap)
                    gl.glFrontFace(reversed_front_face)
                    with drawing.made_of(gl, part, "face", volume.cap_faces_reversed, [item.caster]):
                        drawing.draw_triangles(gl, positions, volume.light_cap_reversed)
            gl.glFrontFace(gl.GL_CCW)


def draw_sides(gl: Any, item: CasterVolume, draw: Callable[[Any, np.ndarray], None] = drawing.draw_polygons) -> None:
    """Draw the sides of a volume in the space of its caster."""
    volume = item.volume
    with drawing.made_of(gl, "volume side", volume.side_feature, volume.side_numbers, [item.caster]):
        draw(gl, volume.sides)


def counting_ops(gl: Any, ops: Ops) -> tuple[int, int]:
    """Return the stencil operations that count up and down."""
    return (gl.GL_INCR_WRAP, gl.GL_DECR_WRAP) if ops == "wrap" else (gl.GL_INCR, gl.GL_DECR)


def lit_pixels(
    gl: Any, scene: Scene, light: Light, depth: np.ndarray, size: tuple[int, int], far: Far, ops: Ops = "wrap"
) -> np.ndarray:
    """Return (h, w) bool, first row = bottom: where the count is 0 and the light shines.

    Warns where a saturating counter has its largest value and may have lost counts (E11).
    """
    stencil = drawing.read_stencil(gl, size)
    largest = 2 ** int(gl.glGetIntegerv(gl.GL_STENCIL_BITS)) - 1
    if ops == "saturate" and (stencil == largest).any():
        warnings.warn(
            f"light {light.name!r}: {int((stencil == largest).sum())} pixels have the largest count, {largest}; "
            "counts beyond it are lost, and shadow may turn into light there",
            CounterSaturated,
            stacklevel=3,
        )
    lit: np.ndarray = (stencil == 0) & drawing.within_cone(scene, light, depth, size, far)
    return lit
