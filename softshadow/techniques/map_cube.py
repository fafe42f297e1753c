"""Shadow maps for a light among its casters: six of them, one to each side, as the faces of a cube map.

One map looks in one direction and holds less than half of what is round a point. Six views of 90 degrees, along the
axes both ways, divide all directions among them. The vector from the light to a point is the coordinate in the cube
map: its largest component selects the face, and is the distance along that face's view.

Paper: Gerasimov 2004, "Omnidirectional shadow mapping", in GPU Gems; the idea is in Williams 1978, "Casting curved
shadows on curved surfaces".
Slides: Andújar, Shadow mapping (one frustum or several, E55); Zimányi & Valient.

Known failures: those of one map, with six times the draws; a light at infinity has no cube round it. A lookup never
leaves its face, so neighbouring faces meet without a gap, but texels span a wider angle in the middle of a face than
at its edge.
"""

import warnings
from typing import Any

import numpy as np

from softshadow.errors import OutsideLightFrustum, SceneError
from softshadow.scene import Light, Scene
from softshadow.techniques import depth_maps, drawing
from softshadow.techniques.clipping import clip_to_planes
from softshadow.techniques.light_camera import MARGIN, NEAREST, LightCamera
from softshadow.techniques.technique import Steps
from softshadow.techniques.visibility_buffer import add_light_times, draw_visibility, set_uniforms

# view and up of the faces, seen from inside, in the order of their names in GL; the directions in which texture
# coordinates grow on a face are those of GL 2.1, table 3.21
FACES = (
    ("+x", (1, 0, 0), (0, -1, 0)),
    ("-x", (-1, 0, 0), (0, -1, 0)),
    ("+y", (0, 1, 0), (0, 0, 1)),
    ("-y", (0, -1, 0), (0, 0, -1)),
    ("+z", (0, 0, 1), (0, -1, 0)),
    ("-z", (0, 0, -1), (0, -1, 0)),
)
NO_CONE = -2.0  # less than any cosine
# across all casters: with fewer texels a shadow is hardly more than a few squares; and the size of the casters as a
# share of their distance: where they are nearer, it is the size of the map that is small
FEW_TEXELS, DISTANT = 24, 0.1


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
) -> Steps:
    """Draw the scene with six shadow maps per light.

    Raises
    ------
    SceneError                   a light at infinity
    """
    drawing.begin_frame(gl, scene)
    for light in scene.lights:
        if light.is_directional:
            raise SceneError(
                f"light {light.name!r} is at infinity; map-cube expected point lights (map takes directions)"
            )
        warn_of_distances(scene, light, map_size)

    # pass 1: the depth of the casters, seen from the light to each of six sides
    cube_maps = []
    for light in scene.lights:
        cube_map, maps = cube_texture(gl, map_size, map_format), {}
        for index, (name, _, _) in enumerate(FACES):
            face = gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X + index
            with (
                depth_maps.polygon_offset(gl, factor, units),
                drawing.texture_attached(gl, gl.GL_DEPTH_ATTACHMENT, cube_map, target=face),
            ):
                depth_maps.draw_casters_from(gl, scene.casters, face_camera(scene, light, index), map_size)
            stored = gl.glGetTexImage(face, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
            maps[drawing.title(f"ZS {name}", scene, light)] = stored
        cube_maps.append(cube_map)
        yield drawing.title("draw six depth maps from the light", scene, light), maps

    # pass 2: the camera's picture, first as if all of it were in shadow
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.objects)
    valid = drawing.read_depth(gl, size) < 1
    yield "draw the scene without the light"

    # then whether each pixel sees the light, and the light there
    lit = []
    program = gl.program("cube-visibility")
    for light, cube_map in zip(scene.lights, cube_maps, strict=True):

        def look_up(light: Light = light, cube_map: int = cube_map) -> None:
            gl.glBindTexture(gl.GL_TEXTURE_CUBE_MAP, cube_map)
            set_vector_from(gl, light)
            set_uniforms(gl, program, bias=bias, **depth_of_distance(scene, light), **cone(light))

        visibility, values = draw_visibility(gl, scene, size, program, look_up, normal_bias)
        lit.append(values[..., 3])
        yield drawing.title("compare with the map that each point is in", scene, light)

        add_light_times(gl, scene, size, light, visibility)
        gl.glDeleteTextures([visibility])
        yield (
            drawing.title("add the light where the map is not nearer", scene, light),
            drawing.visibility_maps(scene, lit, valid),
        )
    gl.glDeleteTextures(cube_maps)


def cube_texture(gl: Any, map_size: int, map_format: depth_maps.MapFormat) -> int:
    """Return a bound cube map of depths, all 1."""
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_CUBE_MAP, name)
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_EDGE),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_CUBE_MAP, parameter, value)
    stored = depth_maps.internal_format(gl, map_format)
    far = np.ones((map_size, map_size), np.float32)
    for index in range(len(FACES)):
        gl.glTexImage2D(
            gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X + index, 0, stored, map_size, map_size, 0,
            gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, far,
        )  # fmt: skip
    return name


def face_camera(scene: Scene, light: Light, index: int) -> LightCamera:
    """Return the camera of one face: 90 degrees, with the same near and far on all sides."""
    eye, (_, forward, up) = light.position[:3], FACES[index]
    near, far = near_and_far(scene, light)
    return LightCamera(eye, eye + np.array(forward, float), np.array(up, float), 1.0, near, far, parallel=False)


def near_and_far(scene: Scene, light: Light) -> tuple[float, float]:
    """Return near and far: far just beyond the farthest caster, near as small as the precision of depths allows."""
    vertices = np.concatenate([thing.world_positions for thing in scene.casters or scene.objects])
    far = MARGIN * float(np.abs(vertices - light.position[:3]).max())
    return NEAREST * far, far


def warn_of_distances(scene: Scene, light: Light, map_size: int) -> None:
    """Warn of casters so far from the light that they cover few texels, or so near that the near plane cuts them."""
    vertices = np.concatenate([thing.world_positions for thing in scene.casters or scene.objects])
    size = float(np.ptp(vertices, axis=0).max())
    distance = float(np.linalg.norm((vertices.min(axis=0) + vertices.max(axis=0)) / 2 - light.position[:3]))
    texels = map_size / 2 * size / max(distance, size)
    if texels < FEW_TEXELS and size < DISTANT * distance:
        warnings.warn(
            f"light {light.name!r}: all casters together cover about {texels:.2g} texels of a face of its cube map; "
            "the technique map frames them with the whole map",
            OutsideLightFrustum,
            stacklevel=3,
        )
    near, _ = near_and_far(scene, light)
    planes = [
        np.append(-sign * axis, near + sign * axis @ light.position[:3]) for axis in np.eye(3) for sign in (-1, 1)
    ]
    names = [
        caster.name
        for caster in scene.casters
        if len(clip_to_planes(caster.world_positions[caster.mesh.triangles], np.array(planes)))
    ]
    if names:
        warnings.warn(
            f"light {light.name!r}: {', '.join(names)} comes nearer to it than {near:.3g}, where its maps begin: what "
            "is nearer casts no shadow; move the light away from it",
            OutsideLightFrustum,
            stacklevel=3,
        )


def depth_of_distance(scene: Scene, light: Light) -> dict[str, float]:
    """Return the uniforms for the window depth at a distance z along a face's view, f/(f-n) - nf/(f-n) / z."""
    near, far = near_and_far(scene, light)
    return {"farthest": far / (far - near), "nearness": near * far / (far - near)}


def cone(light: Light) -> dict[str, float | tuple[float, ...]]:
    """Return the uniforms of a spot light's cone; for other lights every point is inside."""
    if light.axis is None:
        return {"axis": (0.0, 0.0, 0.0), "cosine": NO_CONE}
    return {"axis": tuple(map(float, light.axis)), "cosine": float(np.cos(np.radians(light.cutoff)))}


def set_vector_from(gl: Any, light: Light) -> None:
    """Set the texture matrix: world space to the vector from the light."""
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glTranslated(*(-light.position[:3]))
    gl.glMatrixMode(gl.GL_MODELVIEW)
