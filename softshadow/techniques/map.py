"""Shadow maps: a depth image from the light, compared with while the camera's image is drawn.

Seen from the light there are no shadows: its depth buffer holds the distance of the first surface along every ray,
and whatever lies farther on the ray is in shadow. So the casters are drawn once from the light, and every pixel of
the camera's picture is taken to the light's view and compared with what is stored there. The map is an image: shadows
have the size of its texels, and surfaces need some bias not to shadow themselves.

Paper: Williams 1978, "Casting curved shadows on curved surfaces"; in fixed function Segal et al. 1992, "Fast shadows
and lighting effects using texture mapping", and Everitt, Rege & Cebenoyan 2001, "Hardware shadow mapping".
Slides: Andújar, Shadow mapping (setup, pass 1, pass 2); Moldoveanu "umbre 2"; Zimányi & Valient.

What the slide's shader decides in one pass takes two here: ambient light everywhere, then the light where the
texture's compare function says so, tested as alpha. Points that the light's camera does not see, beside or behind it,
are unknown and count as lit.

Known failures: acne (surfaces shadow themselves) without bias, and single specks of it at creases even with the slope
offset, peter panning (shadows come off their casters) with too much of it; edges have steps as large as a texel; a
point light among the casters needs more than one map (map-cube); `outside` = edge smears the map's edge (E47);
`storage` = copy leaves texels beyond the window empty (E62).

What the map stores is the nearest surface; the nearest that looks away from the light (`surface` = back; Wang & Molnar
1994, "Second-depth shadow mapping"); or the middle between the first and the second surface (midpoint; Woo 1992, "The
shadow depth map revisited"). The latter two need no bias where casters are thick enough, and let light through where
their surfaces meet.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.scene.lights import WIDEST_CONE
from softshadow.techniques import depth_maps
from softshadow.techniques.depth_layers import second_layer, store_midpoint
from softshadow.techniques.depth_maps import (
    compare_in_alpha,
    depth_texture,
    draw_and_copy,
    draw_into,
    offset_and_culled,
    read_depths,
    unknown,
    warn_of_casters_outside,
)
from softshadow.techniques.drawing import (
    added,
    begin_frame,
    column_major,
    draw_objects,
    light_ambient_only,
    light_by,
    read_depth,
    read_stencil,
    set_camera,
    title_of,
    visibility_maps,
    world_points,
)
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.map_lookups import clear_coordinates, draw_looked_up, set_map_coordinates
from softshadow.techniques.technique import Option, Steps

OPTIONS = depth_maps.OPTIONS | {
    "factor": Option(1.0, float, "slope offset: first argument of glPolygonOffset while the map is drawn"),
    "cull": Option(
        "none",
        str,
        "faces left out of the map: those towards the light (front) or away from it (back)",
        choices=("none", "front", "back"),
    ),
    "surface": Option(
        "front",
        str,
        "what is stored: the nearest surface, the nearest that looks away (back), or the middle of first and second",
        choices=("front", "back", "midpoint"),
    ),
    "filter": Option(
        "nearest", str, "one comparison, or four weighted ones that a half decides", choices=("nearest", "linear")
    ),
    "storage": Option(
        "framebuffer", str, "draw into the texture itself, or in the window and copy", choices=("framebuffer", "copy")
    ),
}

# lit from half of the comparisons on; 127.5 would sit between two of the 8-bit values that the alpha test compares
HALF = 127 / 255
LIT, DARK, DECIDED = 1, 3, 1  # in the stencil buffer; the bit that both have
# the disc of a spot light: texels on a side, how much wider than the cone it is, and how soft its rim, in texels
DISC, WIDER, RIM = 256, 1.1, 4


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
    outside: str = "lit",
    cull: str = "none",
    surface: str = "front",
    filter: str = "nearest",
    storage: str = "framebuffer",
) -> Steps:
    """Draw the scene with one shadow map per light; see `OPTIONS`."""
    begin_frame(gl, scene)
    cameras = [light_camera(scene, light) for light in scene.lights]
    warn_of_casters_outside(scene, cameras)

    # pass 1: the depth of the casters, seen from the light
    shadow_maps = []
    draw_map = draw_into if storage == "framebuffer" else draw_and_copy
    for light, camera in zip(scene.lights, cameras, strict=True):
        shadow_map = depth_texture(gl, map_size, gl.GL_LINEAR if filter == "linear" else gl.GL_NEAREST, outside)
        with offset_and_culled(gl, factor, units, "front" if surface == "back" else cull):
            draw_map(gl, scene, camera, shadow_map, map_size)
            stored = read_depths(gl, shadow_map)
            name = "ZS first" if surface == "midpoint" else "ZS"
            yield title_of("draw the depth map from the light", scene, light), {title_of(name, scene, light): stored}
            if surface == "midpoint":
                second = second_layer(gl, scene, camera, shadow_map, map_size)
                stored = read_depths(gl, second)
                yield title_of("draw what is behind it", scene, light), {title_of("ZS second", scene, light): stored}
        if surface == "midpoint":
            stored = store_midpoint(gl, shadow_map, second)
            gl.glDeleteTextures([second])
            yield title_of("take the middle", scene, light), {title_of("ZS midpoint", scene, light): stored}
        shadow_maps.append(shadow_map)

    # pass 2: the camera's picture, first as if all were in shadow
    begin_frame(gl, scene)
    set_camera(gl, scene.camera, size)
    light_ambient_only(gl, scene)
    draw_objects(gl, scene.objects)
    depth = read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    # then the light, where the map does not say shadow
    lit = []
    points = world_points(scene, depth, size)
    for light, camera, shadow_map in zip(scene.lights, cameras, shadow_maps, strict=True):
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        begin_decisions(gl)
        if light.is_spot:
            decide_outside_cone(gl, scene, light, camera)
        elif outside != "edge":
            decide_behind(gl, scene, light, camera, outside)
        add_light_through_map(gl, scene, light, camera, shadow_map, bias, normal_bias)
        end_decisions(gl)
        lit.append(read_stencil(gl, size) == LIT)
        maps = {title_of("unknown", scene, light): valid & unknown(scene, light, camera, points)}
        yield (
            title_of("add the light where the map is not nearer", scene, light),
            maps | visibility_maps(scene, lit, valid),
        )
    gl.glDeleteTextures(shadow_maps)


# -- pass 2 ------------------------------------------------------------------------------------------------------------


def begin_decisions(gl: Any) -> None:
    """Let the following draws decide pixels, each once, where a texture's alpha is more than a half."""
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_NOTEQUAL, LIT, DECIDED)  # no pixel gets the light twice
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    gl.glEnable(gl.GL_ALPHA_TEST)
    gl.glAlphaFunc(gl.GL_GREATER, HALF)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)


def end_decisions(gl: Any) -> None:
    """Set the state back."""
    clear_coordinates(gl)
    gl.glDisable(gl.GL_TEXTURE_2D)
    gl.glDisable(gl.GL_ALPHA_TEST)
    gl.glDisable(gl.GL_STENCIL_TEST)


def add_light_through_map(
    gl: Any, scene: Scene, light: Light, camera: LightCamera, shadow_map: int, bias: float, normal_bias: float
) -> None:
    """Add a light where the map does not say shadow, and leave 1 in the stencil buffer there."""
    light_by(gl, scene, [light], ambient=False, cones=False)
    gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_map)
    compare_in_alpha(gl, gl.GL_LEQUAL)
    set_map_coordinates(gl, camera, bias)
    with added(gl):
        draw_looked_up(gl, scene.objects, normal_bias, shaded=True)


def decide_behind(gl: Any, scene: Scene, light: Light, camera: LightCamera, outside: str) -> None:
    """Decide what is beside or behind the light, where q ≤ 0.

    It would be divided through to the mirrored place of the map, and might find a shadow there.
    """
    vertices = np.concatenate([thing.world_positions for thing in scene.objects])
    if camera.has_behind(vertices):
        sides = side_texture(gl)
        set_side_coordinates(gl, camera)
        if outside == "lit":
            light_by(gl, scene, [light], ambient=False, cones=False)
            with added(gl):
                draw_looked_up(gl, scene.objects, shaded=True)
        else:
            darken(gl, scene)
        gl.glDeleteTextures([sides])


def decide_outside_cone(gl: Any, scene: Scene, light: Light, camera: LightCamera) -> None:
    """Leave a spot light's light away behind it and outside the disc that its cone is in its map."""
    sides = side_texture(gl)
    set_side_coordinates(gl, camera)
    darken(gl, scene)
    gl.glDeleteTextures([sides])
    if light.cutoff < WIDEST_CONE:
        disc = disc_texture(gl)
        set_map_coordinates(gl, replace(camera, half=WIDER * float(np.tan(np.radians(light.cutoff)))), 0.0)
        darken(gl, scene)
        gl.glDeleteTextures([disc])


def darken(gl: Any, scene: Scene) -> None:
    """Decide pixels to be dark: no colour is added, and their stencil is no longer undecided."""
    gl.glDisable(gl.GL_LIGHTING)
    gl.glStencilFunc(gl.GL_NOTEQUAL, DARK, DECIDED)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    with added(gl):
        draw_looked_up(gl, scene.objects)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glStencilFunc(gl.GL_NOTEQUAL, LIT, DECIDED)


def set_side_coordinates(gl: Any, camera: LightCamera) -> None:
    """Set the texture matrix: s below a half for what is beside or behind the light, above for what is before it."""
    forward = camera.frame[2]
    matrix = np.zeros((4, 4))
    matrix[0] = [*forward, 0.5 - forward @ camera.eye]
    matrix[1, 3] = 0.5
    matrix[3, 3] = 1
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glMultMatrixd(column_major(matrix))
    gl.glMatrixMode(gl.GL_MODELVIEW)


def side_texture(gl: Any) -> int:
    """Return a bound texture of two texels: alpha 1 on the left, behind the light, and 0 on the right, before it."""
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_EDGE),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    texels = np.array([[[255, 255, 255, 255], [255, 255, 255, 0]]], np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 2, 1, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    return name


def disc_texture(gl: Any) -> int:
    """Return a bound texture with alpha less than a half in the disc of a cone, and more outside it.

    Alpha grows with the distance from the rim, so that linear filtering finds the rim to a fraction of a texel.
    """
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_LINEAR),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_EDGE),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    centres = np.arange(DISC) + 0.5 - DISC / 2
    beyond_rim = np.hypot(centres[:, None], centres) - DISC / 2 / WIDER
    texels = np.full((DISC, DISC, 4), 255, np.uint8)
    texels[..., 3] = np.rint(255 * np.clip(0.5 + beyond_rim / RIM, 0, 1))
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, DISC, DISC, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    return name
