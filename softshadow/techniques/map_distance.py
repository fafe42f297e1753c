"""Distance maps: shadow maps that store how far a caster is from the light, in world units, in place of window depth.

Pass 1 draws the casters from the light, as for every shadow map, with a depth buffer that keeps the nearest surface. A
program writes the distance to the light as the colour of each texel. Pass 2 compares it with a point's own distance.

Slides: Zimányi & Valient (SK:331) say that the pixels of the map hold their distance to the source; a depth buffer
holds window depth (E69). This technique does what the slide says.
Paper: Brabec, Annen & Seidel 2002, "Practical shadow mapping", which argues for depths in equal steps.

Window depth has fine steps near the light's near plane and coarse ones far away, so a constant bias in it is a small
distance near the light and a large one far from it. Here `bias` is the same distance everywhere. For a light at
infinity, distances are measured along its rays, from the plane of the light's camera.

Known failures: those of `map`. A constant cannot follow the slope, and `glPolygonOffset` moves window depth, not the
colours that are compared: without `normal_bias`, surfaces that are steep to the light shadow themselves in stripes
(E49). `normal_bias` is enough for flat faces of any slope, but lets light through where a curved surface turns away
from the light. Shadows are missing within the bias of their casters.
"""

import math
from typing import Annotated, Any

from softshadow.scene import Light, Scene
from softshadow.techniques import depth_maps, drawing, filterable_maps
from softshadow.techniques.light_by_program import draw_lit_by_program
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.map_lookups import clear_coordinates, draw_looked_up
from softshadow.techniques.map_pcf import behind, disc
from softshadow.techniques.technique import Range, Steps
from softshadow.techniques.visibility_buffer import set_uniforms, texture_and_depth_attached

# of a texel's width: half its diagonal, the farthest that a point may be from the sample that it is compared with
HALF_DIAGONAL = math.sqrt(0.5)


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    map_size: depth_maps.MapSize = 512,
    bias: Annotated[
        float | None,
        "subtracted from a point's distance before it is compared, in world units; by default the width of a texel at "
        "the far end of the map",
        Range(0),
    ] = None,
    normal_bias: Annotated[
        float | None,
        "how far a point is moved along its normal before it is looked up, in world units; by default half the "
        "diagonal of a texel at the far end of the map",
    ] = None,
    outside: depth_maps.Outside = "lit",
) -> Steps:
    """Draw the scene with one map of distances per light."""
    drawing.begin_frame(gl, scene)
    cameras = [light_camera(scene, light) for light in scene.lights]
    depth_maps.warn_of_casters_outside(scene, cameras)
    if normal_bias is None:
        normal_bias = HALF_DIAGONAL * max(texel_width(camera, map_size) for camera in cameras)

    # pass 1: the distances of the casters from the light
    maps = []
    for light, camera in zip(scene.lights, cameras, strict=True):
        distances = draw_distances(gl, scene, camera, map_size, outside)
        maps.append(distances)
        yield (
            drawing.title("draw the distances from the light", scene, light),
            {drawing.title("distances", scene, light): filterable_maps.read_texels(gl, distances, 1)[..., 0]},
        )

    # pass 2: the comparison with each point's own distance
    program = gl.program("distance-visibility")

    def look_up(number: int, light: Light, camera: LightCamera) -> None:
        gl.glBindTexture(gl.GL_TEXTURE_2D, maps[number])
        set_light_view(gl, camera)
        subtracted = texel_width(camera, map_size) if bias is None else bias
        set_uniforms(gl, program, parallel=float(camera.parallel), scale=0.5 / camera.half, farthest=camera.far)
        set_uniforms(gl, program, bias=subtracted, behind=behind(light, outside), cone=disc(light, camera))

    shown = ("stored distance", "compared distance")
    yield from draw_lit_by_program(gl, scene, size, cameras, program, look_up, shown, normal_bias)
    gl.glDeleteTextures(maps)


def draw_distances(gl: Any, scene: Scene, camera: LightCamera, map_size: int, outside: depth_maps.Outside) -> int:
    """Return a texture with the distance of the nearest caster in red, and the far distance where there is none."""
    nothing = (camera.far, 0.0, 0.0, 1.0)
    texture = filterable_maps.color_texture(gl, map_size, gl.GL_NEAREST, nothing, outside, "GL_R32F")
    with texture_and_depth_attached(gl, texture, (map_size, map_size)):
        gl.glClearColor(*nothing)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        depth_maps.look_from(gl, camera, map_size)
        gl.glDisable(gl.GL_LIGHTING)
        program = gl.program("light-distance")
        gl.glUseProgram(program)
        set_uniforms(gl, program, parallel=float(camera.parallel))
        set_light_view(gl, camera)
        draw_looked_up(gl, scene.casters)
        gl.glUseProgram(0)
        clear_coordinates(gl)
    return texture


def set_light_view(gl: Any, camera: LightCamera) -> None:
    """Set the texture matrix: world space to the light's view."""
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.gluLookAt(*camera.eye, *camera.target, *camera.up)
    gl.glMatrixMode(gl.GL_MODELVIEW)


def texel_width(camera: LightCamera, map_size: int) -> float:
    """Return the width of a texel in world units, for a point light at the far distance."""
    return 2 * camera.half / map_size * (1.0 if camera.parallel else camera.far)
