"""Shadow maps for a light among its casters: six of them, one to each side, as the faces of a cube map.

One map looks one way and holds less than half of what is round a point. Six views of 90 degrees, along the axes both
ways, divide all directions between them. The way from the light to a point is the cube map's coordinate: its largest
component names the face, and is the distance along that face's view.

Paper: Gerasimov 2004, "Omnidirectional shadow mapping", in GPU Gems; the idea is in Williams 1978, "Casting curved
shadows on curved surfaces".
Slides: Andújar, Shadow mapping (one frustum or several, E55); Zimányi & Valient.

Known failures: those of one map, six times the draws; a light at infinity has no inside. A lookup never leaves its
face, so neighbouring faces meet without a gap, but texels are wider in angle in the middle of a face than at its edge.
"""

from typing import Any

import numpy as np

from softshadow.errors import SceneError
from softshadow.scene import Light, Scene
from softshadow.techniques import depth_maps
from softshadow.techniques.depth_maps import draw_casters_from, offset_and_culled
from softshadow.techniques.drawing import (
    begin_frame,
    draw_objects,
    light_ambient_only,
    read_depth,
    set_camera,
    texture_attached,
    title_of,
    visibility_maps,
)
from softshadow.techniques.light_camera import MARGIN, NEAREST, LightCamera
from softshadow.techniques.technique import Option, Steps
from softshadow.techniques.visibility_buffer import add_light_times, draw_visibility, set_uniforms

OPTIONS = {name: depth_maps.OPTIONS[name] for name in ("map_size", "units", "bias", "normal_bias")} | {
    "factor": Option(1.0, float, "slope offset: first argument of glPolygonOffset while the maps are drawn"),
}

# view and up of the faces in the order of their names in GL: where texture coordinates grow on a face (GL 2.1, table
# 3.21), seen from inside
FACES = (
    ("+x", (1, 0, 0), (0, -1, 0)),
    ("-x", (-1, 0, 0), (0, -1, 0)),
    ("+y", (0, 1, 0), (0, 0, 1)),
    ("-y", (0, -1, 0), (0, 0, -1)),
    ("+z", (0, 0, 1), (0, -1, 0)),
    ("-z", (0, 0, -1), (0, -1, 0)),
)
NO_CONE = -2.0  # less than any cosine


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    map_size: int = 512,
    factor: float = 1.0,
    units: float = 1.0,
    bias: float = 0.0,
    normal_bias: float = 0.0,
) -> Steps:
    """Draw the scene with six shadow maps per light; see `OPTIONS`.

    Raises
    ------
    SceneError                   a light at infinity
    """
    begin_frame(gl, scene)
    for light in scene.lights:
        if light.is_directional:
            raise SceneError(f"{light.name}: is a light at infinity; map-cube expected points (map takes directions)")

    # pass 1: the depth of the casters, seen from the light to all six sides
    cube_maps = []
    for light in scene.lights:
        cube_map, maps = cube_texture(gl, map_size), {}
        for index, (name, _, _) in enumerate(FACES):
            face = gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X + index
            with (
                offset_and_culled(gl, factor, units),
                texture_attached(gl, gl.GL_DEPTH_ATTACHMENT, cube_map, target=face),
            ):
                draw_casters_from(gl, scene.casters, face_camera(scene, light, index), map_size)
            maps[title_of(f"ZS {name}", scene, light)] = gl.glGetTexImage(face, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
        cube_maps.append(cube_map)
        yield title_of("draw six depth maps from the light", scene, light), maps

    # pass 2: the camera's picture, first as if all were in shadow
    begin_frame(gl, scene)
    set_camera(gl, scene.camera, size)
    light_ambient_only(gl, scene)
    draw_objects(gl, scene.objects)
    valid = read_depth(gl, size) < 1
    yield "draw the scene without the light"

    # then whether each pixel sees the light, and the light there
    seen = []
    program = gl.program("cube-visibility")
    for light, cube_map in zip(scene.lights, cube_maps, strict=True):

        def look_up(light: Light = light, cube_map: int = cube_map) -> None:
            gl.glBindTexture(gl.GL_TEXTURE_CUBE_MAP, cube_map)
            set_way_from(gl, light)
            set_uniforms(gl, program, bias=bias, **depth_of_distance(scene, light), **cone(light))

        visibility, values = draw_visibility(gl, scene, size, program, look_up, normal_bias)
        seen.append(values[..., 3])
        yield title_of("compare with the map that each point is in", scene, light)

        add_light_times(gl, scene, size, light, visibility)
        gl.glDeleteTextures([visibility])
        yield title_of("add the light where the map is not nearer", scene, light), visibility_maps(scene, seen, valid)
    gl.glDeleteTextures(cube_maps)


def cube_texture(gl: Any, map_size: int) -> int:
    """Return a bound cube map of depths, still without contents."""
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_CUBE_MAP, name)
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_EDGE),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_CUBE_MAP, parameter, value)
    far = np.ones((map_size, map_size), np.float32)
    for index in range(len(FACES)):
        gl.glTexImage2D(
            gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X + index, 0, gl.GL_DEPTH_COMPONENT24, map_size, map_size, 0,
            gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, far,
        )  # fmt: skip
    return name


def face_camera(scene: Scene, light: Light, index: int) -> LightCamera:
    """Return the camera of one face: 90 degrees, the same planes to all sides."""
    eye, (_, forward, up) = light.position[:3], FACES[index]
    near, far = near_and_far(scene, light)
    return LightCamera(eye, eye + np.array(forward, float), np.array(up, float), 1.0, near, far, parallel=False)


def near_and_far(scene: Scene, light: Light) -> tuple[float, float]:
    """Return the planes: far beyond the farthest caster, near as near as the depths allow, for faces are near, too."""
    vertices = np.concatenate([thing.world_positions for thing in scene.casters or scene.objects])
    far = MARGIN * float(np.abs(vertices - light.position[:3]).max())
    return NEAREST * far, far


def depth_of_distance(scene: Scene, light: Light) -> dict[str, float]:
    """Return the uniforms that make a window depth of the distance z along a face's view: f/(f-n) - nf/(f-n) / z."""
    near, far = near_and_far(scene, light)
    return {"farthest": far / (far - near), "nearness": near * far / (far - near)}


def cone(light: Light) -> dict[str, float | tuple[float, ...]]:
    """Return the uniforms of a spot light's cone; other lights have none."""
    if light.axis is None:
        return {"axis": (0.0, 0.0, 0.0), "cosine": NO_CONE}
    return {"axis": tuple(map(float, light.axis)), "cosine": float(np.cos(np.radians(light.cutoff)))}


def set_way_from(gl: Any, light: Light) -> None:
    """Set the texture matrix: the world to the way from the light."""
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glTranslated(*(-light.position[:3]))
    gl.glMatrixMode(gl.GL_MODELVIEW)
