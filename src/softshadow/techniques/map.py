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
point light among the casters needs more than one map; `storage` = copy leaves texels beyond the window empty (E62).
"""

import warnings
from typing import Any

import numpy as np

from softshadow.errors import OutsideLightFrustum
from softshadow.scene import Light, Scene
from softshadow.techniques.drawing import (
    added,
    begin_frame,
    column_major,
    draw_mesh,
    draw_objects,
    draw_shapes,
    light_ambient_only,
    light_by,
    object_space,
    read_depth,
    read_stencil,
    set_camera,
    set_material,
    texture_attached,
    title_of,
    visibility_maps,
)
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.technique import Option, Steps

OPTIONS = {
    "map_size": Option(512, int, "texels on a side of the map", minimum=1, maximum=8192),
    "factor": Option(1.0, float, "slope offset: first argument of glPolygonOffset while the map is drawn"),
    "units": Option(1.0, float, "slope offset: second argument of glPolygonOffset while the map is drawn"),
    "bias": Option(
        0.0, float, "constant subtracted from a point's depth before it is compared, of the map's range 0 to 1"
    ),
    "cull": Option(
        "none",
        str,
        "faces left out of the map: those towards the light (front) or away from it (back)",
        choices=("none", "front", "back"),
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


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    map_size: int = 512,
    factor: float = 1.0,
    units: float = 1.0,
    bias: float = 0.0,
    cull: str = "none",
    filter: str = "nearest",
    storage: str = "framebuffer",
) -> Steps:
    """Draw the scene with one shadow map per light; see `OPTIONS`."""
    begin_frame(gl, scene)
    cameras = [light_camera(scene, light) for light in scene.lights]
    warn_of_casters_outside(scene, cameras)

    # pass 1: the depth of the casters, seen from the light
    shadow_maps = []
    for light, camera in zip(scene.lights, cameras, strict=True):
        shadow_map = depth_texture(gl, map_size, gl.GL_LINEAR if filter == "linear" else gl.GL_NEAREST)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(factor, units)
        if cull != "none":
            gl.glEnable(gl.GL_CULL_FACE)
            gl.glCullFace(gl.GL_FRONT if cull == "front" else gl.GL_BACK)
        if storage == "framebuffer":
            draw_into(gl, scene, camera, shadow_map, map_size)
        else:
            draw_and_copy(gl, scene, camera, shadow_map, map_size)
        gl.glDisable(gl.GL_CULL_FACE)
        gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
        shadow_maps.append(shadow_map)
        stored = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
        yield title_of("draw the depth map from the light", scene, light), {title_of("ZS", scene, light): stored}

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
        add_light_through_map(gl, scene, light, camera, shadow_map, bias)
        lit.append(read_stencil(gl, size) != 0)
        unknown = valid & ~camera.sees(points)
        maps = {title_of("unknown", scene, light): unknown}
        yield (
            title_of("add the light where the map is not nearer", scene, light),
            maps | visibility_maps(scene, lit, valid),
        )
    gl.glDeleteTextures(shadow_maps)


def warn_of_casters_outside(scene: Scene, cameras: list[LightCamera]) -> None:
    """Warn of casters that a light's one camera does not see."""
    for light, camera in zip(scene.lights, cameras, strict=True):
        names = [caster.name for caster in scene.casters if not camera.sees(caster.world_positions).all()]
        if names:
            warnings.warn(
                f"light {light.name!r} stands among its casters: its map does not see all of {', '.join(names)}; "
                "their shadows are missing outside the map (a cube of six maps would see them)",
                OutsideLightFrustum,
                stacklevel=3,
            )


# -- pass 1 ------------------------------------------------------------------------------------------------------------


def depth_texture(gl: Any, map_size: int, filtering: int) -> int:
    """Return a bound depth texture that compares r with what it stores and answers in alpha; outside it all is lit."""
    name = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, filtering),
        (gl.GL_TEXTURE_MAG_FILTER, filtering),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_BORDER),  # E47: the edge texel must not smear over the scene
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_BORDER),
        (gl.GL_TEXTURE_COMPARE_MODE, gl.GL_COMPARE_R_TO_TEXTURE),
        (gl.GL_TEXTURE_COMPARE_FUNC, gl.GL_LEQUAL),
        (gl.GL_DEPTH_TEXTURE_MODE, gl.GL_ALPHA),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, (1.0, 1.0, 1.0, 1.0))
    empty = np.ones((map_size, map_size), np.float32)  # what a copy does not reach stays far (E51)
    gl.glTexImage2D(
        gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT24, map_size, map_size, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, empty
    )
    return name


def set_light_camera(gl: Any, camera: LightCamera) -> None:
    """Multiply the current matrix by the light's projection and view."""
    if camera.parallel:
        gl.glOrtho(-camera.half, camera.half, -camera.half, camera.half, camera.near, camera.far)
    else:
        gl.gluPerspective(camera.fov, 1.0, camera.near, camera.far)
    gl.gluLookAt(*camera.eye, *camera.target, *camera.up)


def draw_casters_from(gl: Any, scene: Scene, camera: LightCamera, map_size: int) -> None:
    """Draw the casters from the light, depth only."""
    gl.glViewport(0, 0, map_size, map_size)
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    set_light_camera(gl, camera)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    gl.glDisable(gl.GL_LIGHTING)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    draw_shapes(gl, scene.casters)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)


def draw_into(gl: Any, scene: Scene, camera: LightCamera, shadow_map: int, map_size: int) -> None:
    """Draw the map with the texture itself as the depth buffer."""
    with texture_attached(gl, gl.GL_DEPTH_ATTACHMENT, shadow_map):
        draw_casters_from(gl, scene, camera, map_size)


def draw_and_copy(gl: Any, scene: Scene, camera: LightCamera, shadow_map: int, map_size: int) -> None:
    """Draw the map in the window and copy its depth buffer into the texture, as on the slide."""
    draw_casters_from(gl, scene, camera, map_size)
    gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_map)
    gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, map_size, map_size)


# -- pass 2 ------------------------------------------------------------------------------------------------------------


def add_light_through_map(
    gl: Any, scene: Scene, light: Light, camera: LightCamera, shadow_map: int, bias: float
) -> None:
    """Add a light where the map does not say shadow, and leave 1 in the stencil buffer there."""
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_NOTEQUAL, 1, 0xFF)  # no pixel gets the light twice
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    gl.glEnable(gl.GL_ALPHA_TEST)
    gl.glAlphaFunc(gl.GL_GREATER, HALF)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
    light_by(gl, scene, [light], ambient=False)
    with added(gl):
        vertices = np.concatenate([thing.world_positions for thing in scene.objects])
        if camera.has_behind(vertices):
            sides = side_texture(gl)
            set_side_coordinates(gl, camera)
            draw_textured(gl, scene)
            gl.glDeleteTextures([sides])
        gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_map)
        set_map_coordinates(gl, camera, bias)
        draw_textured(gl, scene)
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glDisable(gl.GL_TEXTURE_2D)
    gl.glDisable(gl.GL_ALPHA_TEST)
    gl.glDisable(gl.GL_STENCIL_TEST)


def set_map_coordinates(gl: Any, camera: LightCamera, bias: float) -> None:
    """Set the texture matrix: the world to the map's s, t and depth r, the bias taken from r."""
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glTranslated(0.5, 0.5, 0.5 - bias)
    gl.glScaled(0.5, 0.5, 0.5)
    set_light_camera(gl, camera)
    gl.glMatrixMode(gl.GL_MODELVIEW)


def set_side_coordinates(gl: Any, camera: LightCamera) -> None:
    """Set the texture matrix: s below a half for what is beside or behind the light, above for what is before it.

    Without it such points, where q ≤ 0, are divided through to the mirrored place of the map, and may find a shadow
    there.
    """
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
    name = gl.glGenTextures(1)
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


def draw_textured(gl: Any, scene: Scene) -> None:
    """Draw the scene lit, world positions as texture coordinates."""
    for thing in scene.objects:
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glPushMatrix()
        gl.glMultMatrixd(column_major(thing.object_to_world))
        gl.glMatrixMode(gl.GL_MODELVIEW)
        with object_space(gl, thing):
            set_material(gl, thing)
            draw_mesh(gl, thing, shaded=True, texture_coordinates=True)
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glPopMatrix()
        gl.glMatrixMode(gl.GL_MODELVIEW)


def world_points(scene: Scene, depth: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Return the world points (h, w, 3) float64 that the camera sees, from their window depths (first row = bottom)."""
    width, height = size
    camera = scene.camera
    x, y = np.meshgrid(np.arange(width) + 0.5, height - (np.arange(height) + 0.5))  # near_points counts from the top
    near_points = camera.near_points(np.stack([x.ravel(), y.ravel()], axis=1), size)
    # window depth d belongs to the distance n·f / (f - d·(f - n)) along the view, the near rectangle to n
    scale = camera.far / (camera.far - depth.astype(np.float64) * (camera.far - camera.near))
    return camera.eye + scale[..., None] * (near_points - camera.eye).reshape(height, width, 3)
