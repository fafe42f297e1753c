"""Shadow maps: the depth image of the light, with which the camera's image is compared pixel by pixel.

Seen from the light there are no shadows: its depth buffer holds the distance of the first surface along every ray,
and whatever lies farther along the ray is in shadow. So the casters are drawn once from the light, and each pixel of
the camera's picture is taken to the light's view and compared with the depth stored there. The map is an image: shadow
edges have steps of its texels, and surfaces need some bias not to shadow themselves.

Paper: Williams 1978, "Casting curved shadows on curved surfaces"; in fixed function Segal et al. 1992, "Fast shadows
and lighting effects using texture mapping", and Everitt, Rege & Cebenoyan 2001, "Hardware shadow mapping".
Slides: Andújar, Shadow mapping (setup, pass 1, pass 2); Moldoveanu "umbre 2"; Zimányi & Valient.

The slide's shader decides in one pass; fixed function takes two: the ambient light everywhere, then the light where the
texture's compare function says so, tested as alpha. Points that the light's camera does not see, beside or behind it,
are unknown and count as lit.

Known failures: acne (surfaces shadow themselves) without bias, and single specks of it at creases even with the slope
offset; peter panning (shadows come off their casters) with too much bias; edges have steps as large as a texel; a
point light among the casters needs more than one map (map-cube); `outside` = edge smears the map's edge (E47);
`storage` = copy leaves texels beyond the window empty (E62).

The map stores the nearest surface; or the nearest that is turned away from the light (`surface` = back; Wang & Molnar
1994, "Second-depth shadow mapping"); or the middle between the first and the second surface (midpoint; Woo 1992, "The
shadow depth map revisited"). The latter two need no bias where casters are thick enough, and let light through where
their surfaces meet.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, Any, Literal

from softshadow.scene import Scene
from softshadow.techniques import depth_layers, depth_maps, drawing, map_decisions, map_lookups
from softshadow.techniques.light_camera import light_camera
from softshadow.techniques.map_decisions import DECIDED, LIT
from softshadow.techniques.technique import Steps

# lit from half of the comparisons on; 127.5 would sit between two of the 8-bit values that the alpha test compares
HALF = 127 / 255

Storage = Literal["framebuffer", "copy"]


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    map_size: depth_maps.MapSize = 512,
    map_format: depth_maps.MapFormat = "d24",
    factor: depth_maps.Factor = 1.0,
    units: depth_maps.Units = 1.0,
    bias: depth_maps.Bias = 0.0,
    normal_bias: depth_maps.NormalBias = 0.0,
    outside: depth_maps.Outside = "lit",
    cull: Annotated[
        Literal["none", "front", "back"],
        "faces left out of the map: those towards the light (front) or away from it (back)",
    ] = "none",
    surface: Annotated[
        Literal["front", "back", "midpoint"],
        "what is stored: the nearest surface, the nearest turned away (back), or the middle of first and second",
    ] = "front",
    filter: Annotated[
        Literal["nearest", "linear"], "one comparison, or four weighted ones, lit from a half on"
    ] = "nearest",
    storage: Annotated[Storage, "draw into the texture itself, or into the window and copy"] = "framebuffer",
) -> Steps:
    """Draw the scene with one shadow map per light."""
    drawing.begin_frame(gl, scene)
    cameras = [light_camera(scene, light) for light in scene.lights]
    depth_maps.warn_of_casters_outside(scene, cameras)

    # pass 1: the depth of the casters, seen from the light
    shadow_maps = []
    filtering = gl.GL_LINEAR if filter == "linear" else gl.GL_NEAREST
    for light, camera in zip(scene.lights, cameras, strict=True):
        shadow_map = depth_maps.depth_texture(gl, map_size, filtering, outside, map_format)
        with depth_target(gl, shadow_map, map_size, storage):
            # 1. the camera at the light
            gl.glViewport(0, 0, map_size, map_size)
            gl.glMatrixMode(gl.GL_PROJECTION)
            gl.glLoadIdentity()
            depth_maps.multiply_light_camera(gl, camera)  # gluPerspective (or glOrtho) and gluLookAt
            gl.glMatrixMode(gl.GL_MODELVIEW)
            gl.glLoadIdentity()
            # 2. the casters, depth only
            gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
            gl.glDisable(gl.GL_LIGHTING)
            gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonOffset(factor, units)
            cull_faces(gl, "front" if surface == "back" else cull)
            drawing.draw_shapes(gl, scene.casters)
            gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
        name = drawing.title("ZS first" if surface == "midpoint" else "ZS", scene, light)
        yield (
            drawing.title("draw the depth map from the light", scene, light),
            {name: depth_maps.read_depths(gl, shadow_map)},
        )
        if surface == "midpoint":
            yield from depth_layers.store_midpoint(gl, scene, light, camera, shadow_map, map_size, map_format)
        gl.glDisable(gl.GL_CULL_FACE)
        gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
        shadow_maps.append(shadow_map)

    # pass 2: the camera's picture, first as if all of it were in shadow
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.objects)
    depth = drawing.read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    # then the light, where the map is not nearer
    lit = []
    points = drawing.world_points(scene, depth, size)
    for light, camera, shadow_map in zip(scene.lights, cameras, shadow_maps, strict=True):
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_NOTEQUAL, LIT, DECIDED)  # no pixel gets the light twice
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(gl.GL_GREATER, HALF)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        map_decisions.decide_unseen(gl, scene, light, camera, outside)

        # the comparison: r <= the stored depth, answered in alpha
        gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_map)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_COMPARE_MODE, gl.GL_COMPARE_R_TO_TEXTURE)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_COMPARE_FUNC, gl.GL_LEQUAL)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_DEPTH_TEXTURE_MODE, gl.GL_ALPHA)

        # the texture matrix: world space to the map's s, t and depth r
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glLoadIdentity()
        gl.glTranslated(0.5, 0.5, 0.5 - bias)
        gl.glScaled(0.5, 0.5, 0.5)
        depth_maps.multiply_light_camera(gl, camera)
        gl.glMatrixMode(gl.GL_MODELVIEW)

        drawing.light_by(gl, scene, [light], ambient=False, cones=False)
        with drawing.additive_blending(gl):
            map_lookups.draw_looked_up(gl, scene.objects, normal_bias, shaded=True)
        map_lookups.clear_coordinates(gl)
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glDisable(gl.GL_ALPHA_TEST)
        gl.glDisable(gl.GL_STENCIL_TEST)
        lit.append(drawing.read_stencil(gl, size) == LIT)
        unknown = {drawing.title("unknown", scene, light): valid & depth_maps.unknown(scene, light, camera, points)}
        yield (
            drawing.title("add the light where the map is not nearer", scene, light),
            unknown | drawing.visibility_maps(scene, lit, valid),
        )
    gl.glDeleteTextures(shadow_maps)


@contextmanager
def depth_target(gl: Any, shadow_map: int, map_size: int, storage: Storage) -> Iterator[None]:
    """Draw into the texture itself, or into the window whose depth buffer is then copied, as on the slide."""
    if storage == "framebuffer":
        with drawing.texture_attached(gl, gl.GL_DEPTH_ATTACHMENT, shadow_map):
            yield
    else:
        yield
        gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_map)
        gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, map_size, map_size)


def cull_faces(gl: Any, cull: str) -> None:
    """Leave out the faces towards the light (front) or away from it (back)."""
    if cull != "none":
        gl.glEnable(gl.GL_CULL_FACE)
        gl.glCullFace(gl.GL_FRONT if cull == "front" else gl.GL_BACK)
