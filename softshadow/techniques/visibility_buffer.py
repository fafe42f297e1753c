"""Visibility in a buffer of its own: a program writes, as a float, how much of the light each pixel sees.

The light is then added as in the other techniques, times this buffer, which covers the window as a texture.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.techniques import drawing
from softshadow.techniques.map_lookups import clear_coordinates, draw_looked_up


def upload_visibility(gl: Any, visibility: np.ndarray) -> int:
    """Return a bound texture whose texels have a visibility (h, w) float32, first row = bottom, in all channels."""
    height, width = visibility.shape
    return visibility_texture(gl, (width, height), np.repeat(visibility[..., None], 4, axis=2))


def visibility_texture(gl: Any, size: tuple[int, int], texels: np.ndarray | None = None) -> int:
    """Return a bound float texture of the window's size, with texels (h, w, 4) float32 if they are given."""
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_EDGE),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA32F, *size, 0, gl.GL_RGBA, gl.GL_FLOAT, texels)
    return name


def draw_visibility(
    gl: Any, scene: Scene, size: tuple[int, int], program: int, look_up: Callable[[], None], normal_bias: float = 0.0
) -> tuple[int, np.ndarray]:
    """Return a texture that a program has filled, and its texels as (h, w, 4) float32.

    Parameters
    ----------
    look_up : () -> None         binds the program's textures, sets its uniforms and the texture matrix
    """
    visibility = visibility_texture(gl, size)
    with texture_and_depth_attached(gl, visibility, size):
        fill_visibility(gl, scene, size, program, look_up, normal_bias)
    gl.glBindTexture(gl.GL_TEXTURE_2D, visibility)
    return visibility, gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_FLOAT)


def fill_visibility(
    gl: Any,
    scene: Scene,
    size: tuple[int, int],
    program: int,
    look_up: Callable[[], None],
    normal_bias: float = 0.0,
    units: int = 1,
) -> None:
    """Clear the bound framebuffer, and let a program draw the scene into it.

    The arguments are those of `draw_visibility`; `look_up` binds textures in the first `units` texture units.
    """
    gl.glClearColor(1.0, 1.0, 1.0, 1.0)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    drawing.set_camera(gl, scene.camera, size)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glUseProgram(program)
    look_up()
    draw_looked_up(gl, scene.objects, normal_bias, units=units)
    gl.glUseProgram(0)
    clear_coordinates(gl, units)


@contextmanager
def texture_and_depth_attached(gl: Any, texture: int, size: tuple[int, int]) -> Iterator[None]:
    """Draw into a colour texture, with a depth buffer of its own."""
    framebuffer, depths = bind_with_depth(gl, texture, size)
    yield
    delete_framebuffer(gl, framebuffer, depths)


def bind_with_depth(gl: Any, texture: int, size: tuple[int, int]) -> tuple[int, int]:
    """Bind a new framebuffer object with a colour texture; return it and the renderbuffer of its depths."""
    framebuffer, depths = gl.glGenFramebuffers(1), gl.glGenRenderbuffers(1)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, depths)
    gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH_COMPONENT24, *size)
    gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_RENDERBUFFER, depths)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
    return framebuffer, depths


def delete_framebuffer(gl: Any, framebuffer: int, depths: int) -> None:
    """Bind the window, and delete a framebuffer object and its renderbuffer."""
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    gl.glDeleteFramebuffers(1, [framebuffer])
    gl.glDeleteRenderbuffers(1, [depths])


def add_light_times(
    gl: Any, scene: Scene, size: tuple[int, int], light: Light, visibility: int, far: str = "finite"
) -> None:
    """Add a light times the alpha of a visibility texture, looked up at each pixel's place in the window.

    `far` is that of the depths in the depth buffer (`drawing.set_camera`).
    """
    drawing.set_camera(gl, scene.camera, size, far)
    drawing.light_by(gl, scene, [light], ambient=False, cones=False)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glBindTexture(gl.GL_TEXTURE_2D, visibility)
    for parameter, value in (
        (gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE),
        (gl.GL_COMBINE_RGB, gl.GL_MODULATE),
        (gl.GL_SOURCE0_RGB, gl.GL_PRIMARY_COLOR),
        (gl.GL_OPERAND0_RGB, gl.GL_SRC_COLOR),
        (gl.GL_SOURCE1_RGB, gl.GL_TEXTURE),
        (gl.GL_OPERAND1_RGB, gl.GL_SRC_ALPHA),
    ):
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, parameter, value)
    set_window_coordinates(gl, scene, size)
    with drawing.additive_blending(gl):
        draw_looked_up(gl, scene.objects, shaded=True)
    clear_coordinates(gl)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
    gl.glDisable(gl.GL_TEXTURE_2D)


def set_window_coordinates(gl: Any, scene: Scene, size: tuple[int, int]) -> None:
    """Set the texture matrix: world space to the window, whose width and height are 1."""
    camera = scene.camera
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glTranslated(0.5, 0.5, 0.5)
    gl.glScaled(0.5, 0.5, 0.5)
    gl.gluPerspective(camera.fov_y, size[0] / size[1], camera.near, camera.far)
    gl.gluLookAt(*camera.eye, *camera.target, *camera.up)
    gl.glMatrixMode(gl.GL_MODELVIEW)


def set_uniforms(gl: Any, program: int, **values: float | tuple[float, ...]) -> None:
    """Set uniforms of the program in use; their types are float, int or vec3."""
    for name, value in values.items():
        location = gl.glGetUniformLocation(program, name)
        if isinstance(value, tuple):
            gl.glUniform3f(location, *value)
        elif isinstance(value, int):
            gl.glUniform1i(location, value)
        else:
            gl.glUniform1f(location, value)
