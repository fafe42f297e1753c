"""Soft planar shadows by accumulation: the mean of the flattened casters' pictures over points of the light.

A texture on each flat receiver collects how many points of the light its texels see. The picture for one point is drawn
through a projection that looks from the point at the receiver, and fills the texture with the receiver's outline: what
is drawn there is in the receiver's shadow (`method` = texture). The older way takes the mean of whole pictures in the
accumulation buffer, each with hard planar shadows (`method` = accumulation).

Paper: Heckbert & Herf 1997, "Simulating soft shadows with graphics hardware", CMU-CS-97-104; the accumulation buffer is
that of Haeberli & Akeley 1990.
Slides: Zimányi & Valient, Mäkké tiene, Heckbert a Herf; Moldoveanu "umbre 2".

Known failures: receivers have to be flat, casters have no shadow on themselves or on each other; n points give n + 1
shades (banding); the number of pictures is that of receivers times points. accumulation: the buffer has 16 bits, so
with many points each loses a part of its last bit.
"""

from dataclasses import replace
from typing import Annotated, Any, Literal

import numpy as np

from softshadow.scene import Scene
from softshadow.scene.light_samples import Pattern
from softshadow.techniques import drawing, light_points, planar, receiver_textures
from softshadow.techniques.flattened import others
from softshadow.techniques.technique import Range, Steps


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    samples: light_points.Samples = 16,
    pattern: light_points.LightPattern = "grid",
    seed: light_points.Seed = 0,
    method: Annotated[
        Literal["texture", "accumulation"], "sum up in a texture of each receiver, or whole pictures by glAccum"
    ] = "texture",
    texture_size: Annotated[int, "texture: texels on a side of each receiver's shadow", Range(1, 4096)] = 512,
) -> Steps:
    """Draw the scene with planar shadows of points of each light."""
    if method == "accumulation":
        yield from accumulation(gl, scene, size, samples, pattern, seed)
    else:
        yield from texture(gl, scene, size, samples, pattern, seed, texture_size)


def texture(
    gl: Any, scene: Scene, size: tuple[int, int], samples: int, pattern: Pattern, seed: int, texture_size: int
) -> Steps:
    """Count the points that each texel of the receivers sees, then draw the scene with these textures."""
    # 1. the flattened casters, for each light, receiver and point of the light
    shares: list[dict[str, np.ndarray]] = []
    for light in scene.lights:
        points = light_points.points_of(light, samples, pattern, seed)
        share = {}
        for receiver in scene.receivers:
            views = (receiver_textures.view_of(scene, receiver, point.position) for point in points)
            covered = receiver_textures.count_covered(gl, scene, receiver, views, texture_size)
            share[receiver.name] = (1 - covered / len(points)).astype(np.float32)
        shares.append(share)
        yield (
            drawing.title("count the points that the receivers see", scene, light),
            {drawing.title(f"texture of {name}", scene, light): image for name, image in share.items()},
        )
    yield from draw_with_shares(gl, scene, size, shares)


def draw_with_shares(gl: Any, scene: Scene, size: tuple[int, int], shares: list[dict[str, np.ndarray]]) -> Steps:
    """Draw the scene; each light as far as the textures of the receivers say, one dictionary for each light."""
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.receivers)
    receivers = drawing.read_depth(gl, size)
    drawing.draw_objects(gl, others(scene))
    depth = drawing.read_depth(gl, size)
    valid = (receivers < 1) & (depth == receivers)  # a nearer caster has changed the depth of its pixels
    yield "draw the scene without the light"

    seen = []
    for light, share in zip(scene.lights, shares, strict=True):
        values = receiver_textures.draw_shares(gl, scene, size, share)
        seen.append(values * np.float32(drawing.within_cone(scene, light, depth, size)))
        light_points.add_share(gl, scene, size, light, seen[-1])
        yield light_points.finish_title(scene, light), drawing.visibility_maps(scene, seen, valid)


def accumulation(gl: Any, scene: Scene, size: tuple[int, int], samples: int, pattern: Pattern, seed: int) -> Steps:
    """Draw the picture with hard planar shadows for each point, and take the mean in the accumulation buffer."""
    total: dict[str, np.ndarray] = {}
    scenes = scenes_of_all_lights(scene, samples, pattern, seed)
    for number, with_points in enumerate(scenes, start=1):
        maps: dict[str, np.ndarray] = {}
        for item in planar.steps(gl, with_points, size=size, method="stencil"):
            maps |= {} if isinstance(item, str) else item[1]
        gl.glAccum(gl.GL_LOAD if number == 1 else gl.GL_ACCUM, 1 / len(scenes))
        for name, array in maps.items():
            total[name] = total.get(name, 0) + array.astype(np.float64)
        yield f"draw and accumulate the picture of point {number} of {len(scenes)}"
    gl.glAccum(gl.GL_RETURN, 1.0)
    means = {name: (array / len(scenes)).astype(np.float32) for name, array in total.items() if name != "valid"}
    yield "return the mean", means | {"valid": total["valid"] == len(scenes)}


def scenes_of_all_lights(scene: Scene, samples: int, pattern: Pattern, seed: int) -> list[Scene]:
    """Return the scene with the k-th point of every light in place of the light, for each k."""
    points = [light_points.points_of(light, samples, pattern, seed) for light in scene.lights]
    number = max(len(own) for own in points)
    return [replace(scene, lights=tuple(own[k % len(own)] for own in points)) for k in range(number)]
