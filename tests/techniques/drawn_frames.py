"""Draw a technique and keep what tests look at: buffers after each step, maps, warnings, names of the objects drawn."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from softshadow import gl, techniques
from softshadow.scene import Scene
from softshadow.truth import casting_faces_between, first_faces

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
        for item in technique.steps(listening, scene, size=size, **technique.validate_options(options)):
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


def draw(name: str, scene: Scene, size: tuple[int, int] = SIZE, precision: str = "mesa", **options: Any) -> Drawn:
    """Draw a technique with softshadow's own pipeline."""
    return in_context(lambda gl: program(gl, name, scene, size, options), size, precision)


def in_context(function: Callable[[Any], Any], size: tuple[int, int] = SIZE, precision: str = "mesa") -> Any:
    """Call a function with the namespace of a fresh context."""
    with gl.create_context(*size, precision=precision):
        return function(gl)


def begin_count(gl: Any) -> None:
    """Let draws change the stencil buffer alone, as in step 2 of the shadow volumes."""
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glEnable(gl.GL_CULL_FACE)
    gl.glDepthMask(gl.GL_FALSE)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)


# -- ray casting -------------------------------------------------------------------------------------------------------


@dataclass
class Truth:
    """What rays say about each pixel of a picture, row 0 at the bottom.

    objects (h, w): number of the object that is seen, -1 for none; points (h, w, 3) where; counts (h, w): casting faces
    between the point and each light, one array per light. A sheet seen from its dark side counts itself.
    """

    objects: np.ndarray
    points: np.ndarray
    counts: list[np.ndarray]

    def sure(self, index: int = 0, width: int = 1) -> np.ndarray:
        """Return where neither the object nor the count changes within `width` pixels."""
        seen = off_the_edges(self.objects, width) & (self.objects >= 0)
        return seen & off_the_edges(self.counts[index], width)


def cast_rays(scene: Scene, size: tuple[int, int] = SIZE) -> Truth:
    """Cast a ray through each pixel centre, and from where it ends to each light."""
    width, height = size
    x, y = np.meshgrid(np.arange(width) + 0.5, height - (np.arange(height) + 0.5))
    start = scene.camera.near_points(np.stack([x.ravel(), y.ravel()], axis=1), size)
    along = start - scene.camera.eye
    objects, triangles, distances = first_faces(start, along, scene.objects)
    points = start + np.where(objects >= 0, distances, 0)[:, None] * along
    casters = [next((k for k, c in enumerate(scene.casters) if c is thing), -1) for thing in scene.objects]
    own = np.array([*casters, -1])[objects]
    counts = [
        casting_faces_between(points, light.position, scene.casters, exclude=(own, triangles))
        + seen_from_the_dark_side(scene, light.position, own, triangles, along)
        for light in scene.lights
    ]
    shape = (height, width)
    return Truth(objects.reshape(shape), points.reshape(*shape, 3), [count.reshape(shape) for count in counts])


def seen_from_the_dark_side(
    scene: Scene, light: np.ndarray, casters: np.ndarray, triangles: np.ndarray, along: np.ndarray
) -> np.ndarray:
    """Return whether the ray `along` ends at a face of an open body whose other side looks to the light."""
    dark = np.zeros(len(along), bool)
    for number, caster in enumerate(scene.casters):
        on_it = casters == number
        a, b, c = caster.world_positions[caster.mesh.triangles[triangles[on_it]]].transpose(1, 0, 2)
        normal = np.cross(b - a, c - a)
        to_light = ((light[:3] - light[3] * a) * normal).sum(axis=1)
        is_open = ~caster.mesh.topology.closed_faces[triangles[on_it]]
        dark[on_it] = is_open & (to_light * (along[on_it] * normal).sum(axis=1) > 0)
    return dark


def off_the_edges(values: np.ndarray, width: int = 1) -> np.ndarray:
    """Return where all pixels within `width` have the same value: off the band where an edge runs."""
    padded = np.pad(values, width, mode="edge")
    rows, columns = values.shape
    around = range(2 * width + 1)
    return np.all([padded[y : y + rows, x : x + columns] == values for y in around for x in around], axis=0)
