"""Draw a technique and keep what tests look at: buffers after each step, maps, warnings, names of the objects drawn."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from softshadow import gl, techniques
from softshadow.scene import Scene

SIZE = (64, 48)


@dataclass
class Drawn:
    """What a technique left; all arrays with row 0 at the bottom."""

    titles: list[str] = field(default_factory=list)
    maps: dict[str, np.ndarray] = field(default_factory=dict)
    color: dict[str, np.ndarray] = field(default_factory=dict)
    depth: dict[str, np.ndarray] = field(default_factory=dict)
    stencil: dict[str, np.ndarray] = field(default_factory=dict)
    objects: dict[str, list[str]] = field(default_factory=dict)
    warnings: list[type] = field(default_factory=list)

    @property
    def image(self) -> np.ndarray:
        return self.color[self.titles[-1]]

    @property
    def shadow(self) -> np.ndarray:
        return self.maps["valid"] & (self.maps["visibility"] < 1)


class Listening:
    """A gl namespace that notes the names of the debug groups, which are the objects drawn."""

    def __init__(self, gl: Any) -> None:
        self.gl = gl
        self.names: list[str] = []

    def __getattr__(self, name: str) -> Any:
        return getattr(self.gl, name)

    def glPushDebugGroup(self, source: int, number: int, length: int, message: str) -> None:
        self.names.append(message)
        self.gl.glPushDebugGroup(source, number, length, message)


def program(gl: Any, name: str, scene: Scene, size: tuple[int, int], options: dict[str, Any]) -> Drawn:
    """Draw with the calls of `gl`; the context must be a fresh one."""
    listening, drawn = Listening(gl), Drawn()
    technique = techniques.get(name)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        for item in technique.steps(listening, scene, size=size, **technique.checked_options(options)):
            title, maps = (item, {}) if isinstance(item, str) else item
            drawn.titles.append(title)
            drawn.maps |= maps
            drawn.color[title] = gl.glReadPixels(0, 0, *size, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
            drawn.depth[title] = gl.glReadPixels(0, 0, *size, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
            drawn.stencil[title] = gl.glReadPixels(0, 0, *size, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
            drawn.objects[title], listening.names = listening.names, []
    drawn.warnings = [one.category for one in caught]
    assert gl.glGetError() == gl.GL_NO_ERROR
    return drawn


def draw(name: str, scene: Scene, size: tuple[int, int] = SIZE, **options: Any) -> Drawn:
    """Draw a technique with softshadow's own pipeline."""
    return run(lambda gl: program(gl, name, scene, size, options), size)


def run(function: Callable[[Any], Any], size: tuple[int, int] = SIZE) -> Any:
    """Call a function with the namespace of a fresh context."""
    with gl.create_context(*size):
        return function(gl)


# -- ray casting -------------------------------------------------------------------------------------------------------


def floor_points(scene: Scene, size: tuple[int, int] = SIZE) -> np.ndarray:
    """Return the points of the plane y = 0 behind the pixels, (h, w, 3), NaN where there is none; row 0 = bottom."""
    width, height = size
    x, y = np.meshgrid(np.arange(width) + 0.5, height - (np.arange(height) + 0.5))
    near = scene.camera.near_points(np.stack([x.ravel(), y.ravel()], axis=1), size).reshape(height, width, 3)
    along = near - scene.camera.eye
    with np.errstate(divide="ignore"):
        t = -scene.camera.eye[1] / along[..., 1]
    points = scene.camera.eye + t[..., None] * along
    points[~(t > 0)] = np.nan
    return points


def faces_between(scene: Scene, points: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Count the casters' faces between points (..., 3) and a homogeneous light; casters closed, so those facing it."""
    count = np.zeros(points.shape[:-1], int)
    towards = light[:3] - light[3] * points
    reach = 1.0 if light[3] else np.inf
    for caster in scene.casters:
        for a, b, c in caster.world_positions[caster.mesh.triangles]:
            normal = np.cross(b - a, c - a)
            slope = towards @ normal
            if (light[:3] - light[3] * a) @ normal <= 0:
                continue
            with np.errstate(divide="ignore", invalid="ignore"):
                t = (a - points) @ normal / slope
                hit = points + t[..., None] * towards
            inside = (t > 0) & (t < reach)
            for u, v in ((a, b), (b, c), (c, a)):
                inside &= (hit - u) @ np.cross(normal, v - u) >= 0
            count += inside
    return count


def off_the_edges(values: np.ndarray, width: int = 1) -> np.ndarray:
    """Return where all pixels within `width` have the same value: off the band where an edge runs."""
    padded = np.pad(values, width, mode="edge")
    rows, columns = values.shape
    around = range(2 * width + 1)
    return np.all([padded[y : y + rows, x : x + columns] == values for y in around for x in around], axis=0)
