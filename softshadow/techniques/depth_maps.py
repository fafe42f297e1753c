"""Pass 1 of every shadow map: the depth of the casters, drawn from the light into a texture.

References: Williams 1978, "Casting curved shadows on curved surfaces"; Segal et al. 1992, "Fast shadows and lighting
effects using texture mapping".
"""

import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Annotated, Any, Literal

import numpy as np

from softshadow.errors import OutsideLightFrustum
from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques import drawing
from softshadow.techniques.light_camera import LightCamera
from softshadow.techniques.technique import Range

MapSize = Annotated[int, "texels on a side of the map", Range(1, 8192)]
Factor = Annotated[float, "slope offset: first argument of glPolygonOffset while the map is drawn"]
Units = Annotated[float, "slope offset: second argument of glPolygonOffset while the map is drawn"]
Bias = Annotated[float, "constant subtracted from a point's depth (0 to 1 in the map) before it is compared"]
NormalBias = Annotated[float, "how far a point is moved along its normal before it is looked up, in world units"]
MapFormat = Annotated[
    Literal["d16", "d24", "d32", "d32f"],
    "how the map stores depths: whole numbers of 16, 24 or 32 bits, or 32-bit floats",
]
Outside = Annotated[
    Literal["lit", "shadow", "edge"],
    "points that the light does not see are lit, in shadow, or as the map's edge texel says",
]


FORMATS = {
    "d16": "GL_DEPTH_COMPONENT16",
    "d24": "GL_DEPTH_COMPONENT24",
    "d32": "GL_DEPTH_COMPONENT32",
    "d32f": "GL_DEPTH_COMPONENT32F",
}


def depth_texture(
    gl: Any, map_size: int, filtering: int, outside: Outside = "lit", map_format: MapFormat = "d24"
) -> int:
    """Return a bound depth texture; points outside it are lit, in shadow, or as its edge texel says."""
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    # E47: with GL_CLAMP_TO_EDGE the edge texels smear over the scene
    wrap = gl.GL_CLAMP_TO_EDGE if outside == "edge" else gl.GL_CLAMP_TO_BORDER
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, filtering),
        (gl.GL_TEXTURE_MAG_FILTER, filtering),
        (gl.GL_TEXTURE_WRAP_S, wrap),
        (gl.GL_TEXTURE_WRAP_T, wrap),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    border = 0.0 if outside == "shadow" else 1.0  # no point is nearer than 0 or farther than 1
    gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, (border,) * 4)
    far = np.ones((map_size, map_size), np.float32)  # texels that a copy does not reach stay far (E51)
    set_depths(gl, far, map_format)
    return name


def set_depths(gl: Any, depths: np.ndarray, map_format: MapFormat = "d24") -> None:
    """Fill the bound texture with depths (n, n) float32."""
    height, width = depths.shape
    stored = internal_format(gl, map_format)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, stored, width, height, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, depths)


def internal_format(gl: Any, map_format: MapFormat) -> int:
    """Return GL's name for the way in which a map stores depths."""
    name: int = getattr(gl, FORMATS[map_format])
    return name


def read_depths(gl: Any, texture: int) -> np.ndarray:
    """Return the depths of a texture, (n, n) float32, first row = bottom; the texture is bound afterwards."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    stored: np.ndarray = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
    return stored


def compare_in_alpha(gl: Any, function: int) -> None:
    """Let lookups of the bound depth texture compare r with the stored depth, and return the result as alpha."""
    for parameter, value in (
        (gl.GL_TEXTURE_COMPARE_MODE, gl.GL_COMPARE_R_TO_TEXTURE),
        (gl.GL_TEXTURE_COMPARE_FUNC, function),
        (gl.GL_DEPTH_TEXTURE_MODE, gl.GL_ALPHA),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)


@contextmanager
def polygon_offset(gl: Any, factor: float, units: float) -> Iterator[None]:
    """Draw polygons with an offset of their depth."""
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glPolygonOffset(factor, units)
    yield
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)


def multiply_light_camera(gl: Any, camera: LightCamera) -> None:
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
    multiply_light_camera(gl, camera)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()


def draw_casters_from(gl: Any, casters: Iterable[SceneObject], camera: LightCamera, map_size: int) -> None:
    """Draw the casters from the light, depth only."""
    look_from(gl, camera, map_size)
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    drawing.draw_shapes(gl, casters)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)


def draw_into(gl: Any, scene: Scene, camera: LightCamera, shadow_map: int, map_size: int) -> None:
    """Draw the map with the texture itself as the depth buffer."""
    with drawing.texture_attached(gl, gl.GL_DEPTH_ATTACHMENT, shadow_map):
        draw_casters_from(gl, scene.casters, camera, map_size)


def unknown(scene: Scene, light: Light, camera: LightCamera, points: np.ndarray) -> np.ndarray:
    """Return which points (h, w, 3) the light may shine on although they lie outside its map."""
    return light.shines_on(points) & ~camera.sees(points)


def warn_of_casters_outside(scene: Scene, cameras: list[LightCamera]) -> None:
    """Warn of casters that the light may shine on but that its single camera does not see."""
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
