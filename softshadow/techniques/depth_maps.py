"""Pass 1 of every shadow map: the depth of the casters, drawn from the light into a texture.

References: Williams 1978, "Casting curved shadows on curved surfaces"; Segal et al. 1992, "Fast shadows and lighting
effects using texture mapping".
"""

import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from softshadow.errors import OutsideLightFrustum
from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques.drawing import draw_shapes, texture_attached
from softshadow.techniques.light_camera import LightCamera
from softshadow.techniques.technique import Option

OPTIONS = {
    "map_size": Option(512, int, "texels on a side of the map", minimum=1, maximum=8192),
    "units": Option(1.0, float, "slope offset: second argument of glPolygonOffset while the map is drawn"),
    "bias": Option(
        0.0, float, "constant subtracted from a point's depth before it is compared, of the map's range 0 to 1"
    ),
    "normal_bias": Option(
        0.0, float, "how far a point is moved along its normal before it is looked up, in world units"
    ),
    "outside": Option(
        "lit",
        str,
        "what the light does not see is lit, is in shadow, or is as the map's edge texel says",
        choices=("lit", "shadow", "edge"),
    ),
}


def depth_texture(gl: Any, map_size: int, filtering: int, outside: str = "lit") -> int:
    """Return a bound depth texture; outside it all is lit, in shadow, or as its edge texel says."""
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    # E47: by default the edge texel does not smear over the scene
    wrap = gl.GL_CLAMP_TO_EDGE if outside == "edge" else gl.GL_CLAMP_TO_BORDER
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, filtering),
        (gl.GL_TEXTURE_MAG_FILTER, filtering),
        (gl.GL_TEXTURE_WRAP_S, wrap),
        (gl.GL_TEXTURE_WRAP_T, wrap),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    border = 0.0 if outside == "shadow" else 1.0  # nothing is nearer than 0, or farther than 1
    gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, (border,) * 4)
    set_depths(gl, np.ones((map_size, map_size), np.float32))  # what a copy does not reach stays far (E51)
    return name


def set_depths(gl: Any, depths: np.ndarray) -> None:
    """Fill the bound texture with depths (n, n) float32."""
    height, width = depths.shape
    gl.glTexImage2D(
        gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT24, width, height, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, depths
    )


def read_depths(gl: Any, texture: int) -> np.ndarray:
    """Return what a depth texture holds, (n, n) float32, first row = bottom; it is bound afterwards."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    stored: np.ndarray = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
    return stored


def compare_in_alpha(gl: Any, function: int) -> None:
    """Let lookups of the bound depth texture compare r with what is stored, and answer in alpha."""
    for parameter, value in (
        (gl.GL_TEXTURE_COMPARE_MODE, gl.GL_COMPARE_R_TO_TEXTURE),
        (gl.GL_TEXTURE_COMPARE_FUNC, function),
        (gl.GL_DEPTH_TEXTURE_MODE, gl.GL_ALPHA),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)


@contextmanager
def offset_and_culled(gl: Any, factor: float, units: float, cull: str = "none") -> Iterator[None]:
    """Draw with polygon offset, and without the faces towards the light (front) or away from it (back)."""
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glPolygonOffset(factor, units)
    if cull != "none":
        gl.glEnable(gl.GL_CULL_FACE)
        gl.glCullFace(gl.GL_FRONT if cull == "front" else gl.GL_BACK)
    yield
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)


def set_light_camera(gl: Any, camera: LightCamera) -> None:
    """Multiply the current matrix by the light's projection and view."""
    if camera.parallel:
        gl.glOrtho(-camera.half, camera.half, -camera.half, camera.half, camera.near, camera.far)
    else:
        gl.gluPerspective(camera.fov, 1.0, camera.near, camera.far)
    gl.gluLookAt(*camera.eye, *camera.target, *camera.up)


def look_from(gl: Any, camera: LightCamera, map_size: int) -> None:
    """Set viewport and matrices for a map."""
    gl.glViewport(0, 0, map_size, map_size)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    set_light_camera(gl, camera)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()


def draw_casters_from(gl: Any, casters: Iterable[SceneObject], camera: LightCamera, map_size: int) -> None:
    """Draw the casters from the light, depth only."""
    look_from(gl, camera, map_size)
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    draw_shapes(gl, casters)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)


def draw_into(gl: Any, scene: Scene, camera: LightCamera, shadow_map: int, map_size: int) -> None:
    """Draw the map with the texture itself as the depth buffer."""
    with texture_attached(gl, gl.GL_DEPTH_ATTACHMENT, shadow_map):
        draw_casters_from(gl, scene.casters, camera, map_size)


def draw_and_copy(gl: Any, scene: Scene, camera: LightCamera, shadow_map: int, map_size: int) -> None:
    """Draw the map in the window and copy its depth buffer into the texture, as on the slide."""
    draw_casters_from(gl, scene.casters, camera, map_size)
    gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_map)
    gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, map_size, map_size)


def unknown(scene: Scene, light: Light, camera: LightCamera, points: np.ndarray) -> np.ndarray:
    """Return which points (h, w, 3) a light may shine on and its map does not hold."""
    return light.shines_on(points) & ~camera.sees(points)


def warn_of_casters_outside(scene: Scene, cameras: list[LightCamera]) -> None:
    """Warn of casters that a light's one camera does not see, though its light may reach them."""
    for light, camera in zip(scene.lights, cameras, strict=True):
        names = [
            caster.name
            for caster in scene.casters
            if (light.shines_on(caster.world_positions) & ~camera.sees(caster.world_positions)).any()
        ]
        if names:
            warnings.warn(
                f"light {light.name!r} stands among its casters: its map does not see all of {', '.join(names)}; "
                "their shadows are missing outside the map (map-cube has six maps, which see them)",
                OutsideLightFrustum,
                stacklevel=3,
            )
