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
"""

from dataclasses import replace
from typing import Any

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.techniques import depth_maps, drawing, light_points
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.map_lookups import set_map_coordinates
from softshadow.techniques.map_pcf import behind, disc
from softshadow.techniques.technique import Steps
from softshadow.techniques.visibility_buffer import draw_visibility, set_uniforms


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    samples: light_points.Samples = 9,
    pattern: light_points.LightPattern = "grid",
    seed: light_points.Seed = 0,
    map_size: depth_maps.MapSize = 512,
    factor: depth_maps.Factor = 1.0,
    units: depth_maps.Units = 1.0,
    bias: depth_maps.Bias = 0.0,
    normal_bias: depth_maps.NormalBias = 0.0,
    outside: depth_maps.Outside = "lit",
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

    shares = []
    program = gl.program("map-visibility")
    for light in scene.lights:
        shadow_map = depth_maps.depth_texture(gl, map_size, gl.GL_NEAREST, outside)
        seen, n_points, unknown = np.zeros(depth.shape, np.float64), 0, np.zeros(depth.shape, bool)
        for with_point, point, words in light_points.lit_from_points(scene, light, samples, pattern, seed):
            camera = light_camera(with_point, point)
            if not n_points:
                depth_maps.warn_of_casters_outside(replace(scene, lights=(point,)), [camera])
            # 2. the depth of the casters, seen from the point
            with depth_maps.polygon_offset(gl, factor, units):
                depth_maps.draw_into(gl, with_point, camera, shadow_map, map_size)

            # 3. compared with the depth of what the camera sees
            def look_up(point: Light = point, camera: LightCamera = camera, shadow_map: int = shadow_map) -> None:
                gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_map)
                set_map_coordinates(gl, camera, 0.0)
                set_uniforms(gl, program, side=float(map_size), radius=0, bias=bias)
                set_uniforms(gl, program, behind=behind(point, outside), cone=disc(point, camera))

            visibility, values = draw_visibility(gl, scene, size, program, look_up, normal_bias)
            gl.glDeleteTextures([visibility])
            seen += values[..., 3]
            n_points += 1
            unknown |= valid & depth_maps.unknown(with_point, point, camera, points)
            yield (
                drawing.title(f"compare with the map of {words}", scene, light),
                {
                    drawing.title("ZS", scene, light): depth_maps.read_depths(gl, shadow_map),
                    drawing.title("points seen", scene, light): seen.astype(np.float32),
                },
            )
        gl.glDeleteTextures([shadow_map])

        # 4. as much of the light as the share of its points that are seen
        shares.append(light_points.add_mean(gl, scene, size, light, seen, n_points))
        yield (
            light_points.finish_title(scene, light),
            {drawing.title("unknown", scene, light): unknown} | drawing.visibility_maps(scene, shares, valid),
        )
