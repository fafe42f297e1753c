"""Soft shadows by many shadow maps: one map for each of several points of the light.

A point of the scene sees as much of the light as the share of the light's points that it sees, and each of these points
has a shadow map of its own. With enough points the result is that of an area light, as far as the maps' texels allow.

Paper: none of its own; Haeberli & Akeley 1990, "The accumulation buffer: hardware support for high-quality rendering",
first summed pictures under shadows of light points.
Slides: Zimányi & Valient, Mäkké tiene (sampling the light); Andújar, Shadow mapping.

Known failures: n points give n + 1 shades, and with few of them the penumbra is a pile of hard shadows (banding), most
of all with the corners alone; jittered points turn bands into noise. All failures of shadow maps are here, too, each
averaged over the points: acne becomes a veil, and points that no map sees are unknown. The time grows with the number
of points.

Most of it is not for the comparisons but for drawing the picture again. So with many points, one pass compares with the
maps of eight, one in each texture unit, and adds up how many are not nearer: the sums are the same.
"""

from dataclasses import replace
from functools import partial
from typing import Annotated, Any

import numpy as np

from softshadow.scene import Scene
from softshadow.techniques import depth_maps, drawing, light_points
from softshadow.techniques.light_camera import LightCamera, camera_around, caster_vertices
from softshadow.techniques.map_lookups import set_maps
from softshadow.techniques.map_pcf import behind, disc
from softshadow.techniques.technique import Range, Steps
from softshadow.techniques.unseen_points import unseen_points
from softshadow.techniques.visibility_buffer import (
    bind_with_depth,
    delete_framebuffer,
    fill_visibility,
    set_uniforms,
    visibility_texture,
)

MOST = 8  # maps that one pass compares with: so many texture units there are
FEW_POINTS = 16  # up to these, each point has a step of its own


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    samples: light_points.Samples = 9,
    pattern: light_points.LightPattern = "grid",
    seed: light_points.Seed = 0,
    map_size: depth_maps.MapSize = 512,
    map_format: depth_maps.MapFormat = "d24",
    factor: depth_maps.Factor = 1.0,
    units: depth_maps.Units = 1.0,
    bias: depth_maps.Bias = 0.0,
    normal_bias: depth_maps.NormalBias = 0.0,
    outside: depth_maps.Outside = "lit",
    together: Annotated[
        int | None, "maps that one pass compares with; by default 8, but 1 for up to 16 points", Range(1, MOST)
    ] = None,
) -> Steps:
    """Draw the scene with a shadow map for each point of each light."""
    # 1. the camera's picture as if all of it were in shadow, and the depth of what is visible
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.objects)
    depth = drawing.read_depth(gl, size)
    valid = depth < 1
    points = drawing.world_points(scene, depth, size)
    yield "draw the scene without the light"

    shares, vertices = [], caster_vertices(scene)
    for light in scene.lights:
        lamps = light_points.points_of(light, samples, pattern, seed)
        at_once = min(together or (MOST if len(lamps) > FEW_POINTS else 1), len(lamps))
        maps = [depth_maps.depth_texture(gl, map_size, gl.GL_NEAREST, outside, map_format) for _ in range(at_once)]
        visibility = visibility_texture(gl, size)
        framebuffer, depths = bind_with_depth(gl, visibility, size)
        program = gl.program("map-visibility" if at_once == 1 else "map-visibility-8")
        seen = np.zeros(depth.shape, np.float32)
        cameras: list[LightCamera] = []
        for first in range(0, len(lamps), at_once):
            group = [camera_around(vertices, lamp) for lamp in lamps[first : first + at_once]]
            if not cameras:
                depth_maps.warn_of_casters_outside(replace(scene, lights=(lamps[0],)), group[:1])
            cameras += group

            # 2. the depth of the casters, seen from the point
            with depth_maps.polygon_offset(gl, factor, units):
                for shadow_map, camera in zip(maps, group, strict=False):
                    depth_maps.draw_into(gl, scene, camera, shadow_map, map_size)

            # 3. compared with the depth of what the camera sees
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
            numbers = {"bias": bias, "behind": behind(light, outside)}
            if at_once == 1:
                numbers |= {"side": float(map_size), "radius": 0, "cone": disc(light, group[0])}
            else:
                numbers |= {"maps": len(group)} | {f"shadowMap{unit}": unit for unit in range(len(group))}
            look_up = partial(look_up_maps, gl, program, maps[: len(group)], group, numbers)
            fill_visibility(gl, scene, size, program, look_up, normal_bias, len(group))
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
            gl.glBindTexture(gl.GL_TEXTURE_2D, visibility)
            visible = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_ALPHA, gl.GL_FLOAT)
            seen = seen + np.where(valid, visible, np.float32(len(group)))
            words = light_points.words_for(first, len(cameras), len(lamps))
            yield (
                drawing.title(f"compare with the map{'s' * (len(group) > 1)} of {words}", scene, light),
                {
                    drawing.title("ZS", scene, light): depth_maps.read_depths(gl, maps[len(group) - 1]),
                    drawing.title("points seen", scene, light): seen,
                },
            )
        delete_framebuffer(gl, framebuffer, depths)
        gl.glDeleteTextures([*maps, visibility])
        unknown = light.shines_on(points) & unseen_points(cameras, points, valid)

        # 4. as much of the light as the share of its points that are seen
        shares.append(light_points.add_mean(gl, scene, size, light, seen, len(cameras)))
        yield (
            light_points.finish_title(scene, light),
            {drawing.title("unknown", scene, light): unknown} | drawing.visibility_maps(scene, shares, valid),
        )


def look_up_maps(gl: Any, program: int, maps: list[int], cameras: list[LightCamera], numbers: dict[str, float]) -> None:
    """Bind the maps, and set the texture matrices and the uniforms of the program in use."""
    set_maps(gl, maps, cameras, 0.0)
    set_uniforms(gl, program, **numbers)
