"""Shadow maps that may be filtered like pictures: drawn from the light as colours, blurred, and looked up linearly.

What a filterable map holds is averaged over all that its texels see, so receivers are drawn, too: a shadow's edge is a
mixture of caster and receiver. A receiver that casts no shadow casts one here, if something lies behind it.
"""

from collections.abc import Callable
from typing import Annotated, Any

import numpy as np

from softshadow.scene import Scene
from softshadow.techniques import drawing
from softshadow.techniques.depth_maps import Outside, look_from
from softshadow.techniques.light_camera import LightCamera
from softshadow.techniques.map_lookups import clear_coordinates, draw_looked_up
from softshadow.techniques.technique import Range
from softshadow.techniques.visibility_buffer import set_uniforms, texture_and_depth_attached

Blur = Annotated[int, "radius of the blur: the mean of 2 blur + 1 texels on each axis", Range(0, 64)]
LinearBias = Annotated[float, "constant subtracted from a point's depth, which is linear from 0 (near) to 1 (far)"]

Color = tuple[float, float, float, float]
BLACK = (0.0, 0.0, 0.0, 0.0)


def draw_filterable(
    gl: Any,
    scene: Scene,
    camera: LightCamera,
    map_size: int,
    background: Color,
    outside: Outside,
    use_program: Callable[[], None],
) -> int:
    """Return a float texture of what a program writes for the nearest surfaces.

    Parameters
    ----------
    background : Color           what the program writes at depth 1
    use_program : () -> None     uses the program, and sets its uniforms
    """
    texture = color_texture(gl, map_size, gl.GL_NEAREST, background, outside)
    with texture_and_depth_attached(gl, texture, (map_size, map_size)):
        gl.glClearColor(*background)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        look_from(gl, camera, map_size)
        gl.glDisable(gl.GL_LIGHTING)
        use_program()
        set_linear_coordinates(gl, camera)
        draw_looked_up(gl, [thing for thing in scene.objects if thing.casts or thing.receives])
        gl.glUseProgram(0)
        clear_coordinates(gl)
    return texture


def color_texture(
    gl: Any, map_size: int, filtering: int, background: Color, outside: Outside, stored: str = "GL_RGBA32F"
) -> int:
    """Return a bound float texture; points outside it are lit, in shadow, or as its edge texel says."""
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    wrap = gl.GL_CLAMP_TO_EDGE if outside == "edge" else gl.GL_CLAMP_TO_BORDER
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, filtering),
        (gl.GL_TEXTURE_MAG_FILTER, filtering),
        (gl.GL_TEXTURE_WRAP_S, wrap),
        (gl.GL_TEXTURE_WRAP_T, wrap),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    border = BLACK if outside == "shadow" else background  # nothing is nearer than black
    gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, border)
    internal = getattr(gl, stored)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal, map_size, map_size, 0, gl.GL_RGBA, gl.GL_FLOAT, None)
    return name


def blur(gl: Any, texture: int, map_size: int, radius: int, background: Color, outside: Outside) -> int:
    """Return the blurred texture, with a linear filter; the other one is deleted."""
    program = gl.program("box-blur")
    for s, t in ((1, 0), (0, 1)):
        blurred = color_texture(gl, map_size, gl.GL_NEAREST if s else gl.GL_LINEAR, background, outside)
        with drawing.texture_attached(gl, gl.GL_COLOR_ATTACHMENT0, blurred):
            gl.glViewport(0, 0, map_size, map_size)
            gl.glUseProgram(program)
            set_uniforms(gl, program, radius=radius, stepS=s / map_size, stepT=t / map_size)
            gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
            cover_viewport(gl)
            gl.glUseProgram(0)
        gl.glDeleteTextures([texture])
        texture = blurred
    return texture


def cover_viewport(gl: Any) -> None:
    """Draw a rectangle over the viewport, with texture coordinates from 0 to 1; the matrices become the identity."""
    for mode in (gl.GL_PROJECTION, gl.GL_MODELVIEW):
        gl.glMatrixMode(mode)
        gl.glLoadIdentity()
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glBegin(gl.GL_QUADS)
    for s, t in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)):
        gl.glTexCoord2f(s, t)
        gl.glVertex2f(2 * s - 1, 2 * t - 1)
    gl.glEnd()
    gl.glEnable(gl.GL_DEPTH_TEST)


def read_texels(gl: Any, texture: int, channels: int) -> np.ndarray:
    """Return the first channels of a texture, (n, n, channels) float32, first row = bottom."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    texels: np.ndarray = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_FLOAT)
    return texels[..., :channels]


def set_linear_coordinates(gl: Any, camera: LightCamera) -> None:
    """Set the texture matrix: world space to the map's s, t and q; r, which q does not divide, is the linear depth."""
    scale, depth = 0.5 / camera.half, camera.far - camera.near
    to_map = np.array([[scale, 0, 0, 0], [0, scale, 0, 0], [0, 0, -1 / depth, -camera.near / depth], [0, 0, 0, 0]])
    to_map[(0, 1, 3), 3 if camera.parallel else 2] = (0.5, 0.5, 1) if camera.parallel else (-0.5, -0.5, -1)
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glMultMatrixd(drawing.column_major(to_map))
    gl.gluLookAt(*camera.eye, *camera.target, *camera.up)
    gl.glMatrixMode(gl.GL_MODELVIEW)
