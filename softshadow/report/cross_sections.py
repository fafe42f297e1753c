"""A scene cut by a plane through a light, as on the blackboard: light, casters, receivers, volumes and wedges in 2-D.

Cut by a plane that contains the light's centre, a shadow volume is the 2-D volume of the cut caster. If the plane also
contains the eye and the point that a pixel shows, the line of sight lies in it, and the counts along it are those of
the stencil buffer.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from softshadow.errors import nearest
from softshadow.inspection.hard_truth import seen_faces
from softshadow.inspection.words import percent
from softshadow.report.cut import join_segments
from softshadow.report.section_plane import NEARLY, SectionPlane, ends_of_light, visible_share
from softshadow.report.section_volumes import Crossing, crossings_on_line, sides_of_volumes
from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques.shadow_volumes import volumes_of

STRIPS = 160  # of the receivers, each with one shade


@dataclass(frozen=True, eq=False, repr=False)
class CrossSection:
    """A section through a scene. Its coordinates are world units: x to the right, y upwards.

    Attributes
    ----------
    scene : Scene
    light : Light
    origin : (3,) float64        of the coordinates, world space: the light's centre
    axes : (2, 3) float64        the directions x and y in world space
    center : (2,) float64        the light's centre; for a light at infinity a point far away on the way to it
    ends : (2, 2) float64        the ends of what the section cuts out of the light; twice its centre for a point
    outlines : dict              by object: polylines, each (N, 2) float64; closed ones repeat their first point
    sides : (S, 2, 2) float64    the sides of the hard volumes, each from the silhouette to the far end
    eye, point : (2,) or None    of the pixel
    crossings : tuple            of the line of sight with the volumes, from the eye on
    """

    scene: Scene
    light: Light
    origin: np.ndarray
    axes: np.ndarray
    center: np.ndarray
    ends: np.ndarray
    outlines: dict[str, list[np.ndarray]]
    sides: np.ndarray
    eye: np.ndarray | None
    point: np.ndarray | None
    crossings: tuple[Crossing, ...]

    def __repr__(self) -> str:
        steps = " ".join(f"{crossing.step:+d}" for crossing in self.crossings)
        sight = "" if self.point is None else f", line of sight: {steps or 'no crossing'}"
        return f"CrossSection(scene {self.scene.name!r}, light {self.light.name!r}{sight})"

    @property
    def wedges(self) -> np.ndarray:
        """(S, 3, 2) float64: the silhouette point of each side, and where the lines from the light's ends go behind it.

        Between the two lines a part of the light is visible past this silhouette point.
        """
        near, reach = self.sides[:, 0], np.linalg.norm(self.sides[:, 1] - self.sides[:, 0], axis=1)
        behind = near[:, None] - self.ends[None]
        behind *= reach[:, None, None] / np.linalg.norm(behind, axis=2, keepdims=True)
        return np.concatenate([near[:, None], near[:, None] + behind], axis=1)

    def strips(self, name: str) -> list[tuple[np.ndarray, float]]:
        """Return the outline of an object in short pieces (2, 2), each with the share of the light that it sees."""
        blockers = [
            np.stack([line[:-1], line[1:]], axis=1)
            for thing in self.scene.casters
            if thing.name != name
            for line in self.outlines.get(thing.name, [])
        ]
        segments = np.concatenate(blockers) if blockers else np.zeros((0, 2, 2))
        pieces = []
        for line in self.outlines.get(name, []):
            for a, b in pairwise(line):
                places = a + np.linspace(0, 1, STRIPS + 1)[:, None] * (b - a)
                for start, end in pairwise(places):
                    pieces.append((np.stack([start, end]), visible_share((start + end) / 2, self.ends, segments)))
        return pieces

    def describe(self) -> str:
        """Return what the section shows, in words: casters, sides of volumes, how much is in shadow, the counts."""
        casters = ", ".join(thing.name for thing in self.scene.casters)
        parts = [
            f"Section of scene {self.scene.name} through {self.light.name}: casters {casters}",
            f"{len(self.sides)} sides of shadow volumes",
        ]
        parts += [f"{thing.name}: {self._light_on(thing.name)}" for thing in self.scene.receivers]
        if self.crossings:
            steps = ", ".join(f"{crossing.step:+d} = {crossing.count}" for crossing in self.crossings)
            sides = "1 side" if len(self.crossings) == 1 else f"{len(self.crossings)} sides"
            parts.append(f"the line of sight crosses {sides}: {steps}")
        elif self.point is not None:
            parts.append("the line of sight crosses no side")
        return "; ".join(parts) + "."

    def _light_on(self, name: str) -> str:
        """Return in words how much of an object's outline is in shadow."""
        pieces = self.strips(name)
        lengths = np.array([np.linalg.norm(end - start) for (start, end), _ in pieces])
        shares = np.array([share for _, share in pieces])
        if not lengths.sum():
            return "not cut"
        dark, partly = (
            float(lengths[which].sum() / lengths.sum()) for which in (shares <= 0, (shares > 0) & (shares < 1))
        )
        return f"{percent(dark)} in shadow" + (f", {percent(partly)} in part" if partly else "")

    if TYPE_CHECKING:
        # softshadow.report attaches this: its module imports this one

        def _repr_svg_(self, /) -> tuple[str, dict[str, str]]: ...


def cross_section(
    scene: Scene | str,
    pixel: tuple[int, int] | None = None,
    size: tuple[int, int] = (640, 480),
    light: str | None = None,
) -> CrossSection:
    """Return a section through a light and the middle of the casters, or through a light, the eye and a pixel.

    Without a pixel the section is vertical. A notebook displays it; `save_svg` writes it to a file.

    Parameters
    ----------
    scene : Scene or str         a scene, or a name of `scene_names`
    pixel : (x, y)               x from the left, y from the top, of a picture of this `size`
    light : str                  name; the first one by default

    Raises
    ------
    ValueError                   the pixel is outside the picture or shows no surface, or there is no such light

    Examples
    --------
    >>> import softshadow as ss
    >>> section = ss.cross_section("boxes", pixel=(432, 233))
    >>> [crossing.step for crossing in section.crossings]
    [1]
    """
    scene = Scene.named(scene) if isinstance(scene, str) else scene
    source = _light_of(scene, light)
    middle = _middle(scene)
    eye = point = None
    if pixel is not None:
        eye, point = scene.camera.eye, _seen_point(scene, pixel, size)
        normal = np.cross(point - eye, source.position[:3] - source.position[3] * eye)
        if np.linalg.norm(normal) <= NEARLY * np.linalg.norm(point - eye) * np.linalg.norm(source.position[:3]):
            normal = np.cross(
                point - eye, scene.camera.frame[1]
            )  # the light is on the line of sight: any plane will do
    else:
        towards = middle - source.position[:3] if source.position[3] else -source.position[:3]
        normal = np.cross((0.0, 1.0, 0.0), towards)
        if np.linalg.norm(normal) <= NEARLY * np.linalg.norm(towards):
            normal = np.cross((0.0, 1.0, 0.0), scene.camera.frame[0])
    normal = normal / np.linalg.norm(normal)
    origin = source.position[:3] if source.position[3] else (middle if point is None else point)
    axes = _axes(normal, scene)
    plane = SectionPlane(origin, axes, normal)
    volumes = volumes_of(scene, source, cap="finite")
    spread = 10 * float(np.ptp(np.concatenate([thing.world_positions for thing in scene.objects]), axis=0).max())
    far_center = axes @ source.position[:3] * spread / np.linalg.norm(source.position[:3])
    center = np.zeros(2) if source.position[3] else far_center
    return CrossSection(
        scene,
        source,
        origin,
        axes,
        center,
        ends_of_light(source, plane, middle) if source.position[3] else np.stack([center, center]),
        {thing.name: _outlines(thing, plane) for thing in scene.objects},
        sides_of_volumes(volumes, plane, center),
        None if eye is None else plane.project(eye),
        None if point is None else plane.project(point),
        () if eye is None or point is None else crossings_on_line(volumes, eye, point, plane),
    )


def _light_of(scene: Scene, name: str | None) -> Light:
    if name is None:
        return scene.lights[0]
    for light in scene.lights:
        if light.name == name:
            return light
    raise ValueError(f"light={name!r}: {nearest(name, [light.name for light in scene.lights])}")


def _middle(scene: Scene) -> np.ndarray:
    things = scene.casters or scene.objects
    vertices = np.concatenate([thing.world_positions for thing in things if not thing.receives] or
                              [thing.world_positions for thing in things])  # fmt: skip
    return np.asarray((vertices.min(axis=0) + vertices.max(axis=0)) / 2)


def _seen_point(scene: Scene, pixel: tuple[int, int], size: tuple[int, int]) -> np.ndarray:
    x, y = pixel
    if not (0 <= x < size[0] and 0 <= y < size[1]):
        raise ValueError(f"pixel={pixel}: expected x from 0 to {size[0] - 1} and y from 0 to {size[1] - 1}")
    objects, _, points = seen_faces(scene, size)
    if objects[y * size[0] + x] < 0:
        raise ValueError(f"pixel={pixel}: no surface is seen there")
    return np.asarray(points[y * size[0] + x])


def _axes(normal: np.ndarray, scene: Scene) -> np.ndarray:
    """Return the directions x and y (2, 3) of a section: y as far upwards as possible, x to the camera's right."""
    up = np.array([0.0, 1.0, 0.0]) if abs(normal[1]) < 0.99 else scene.camera.frame[1]
    y = up - (up @ normal) * normal
    y /= np.linalg.norm(y)
    x = np.cross(y, normal)
    return np.stack([x if x @ scene.camera.frame[0] >= 0 else -x, y])


def _outlines(thing: SceneObject, plane: SectionPlane) -> list[np.ndarray]:
    return join_segments(plane.cut(thing.world_positions[thing.mesh.triangles]))
