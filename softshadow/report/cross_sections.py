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
from softshadow.report.cut import cut_triangles, join_segments
from softshadow.scene import Disc, Light, Rectangle, Scene, SceneObject, Segment
from softshadow.techniques.shadow_volumes import CasterVolume, volumes_of

STRIPS = 160  # of the receivers, each with one shade
NEARLY = 1e-9  # sine of an angle that counts as 0, and the share of the line of sight next to its end that is left out


@dataclass(frozen=True)
class Crossing:
    """Where the line of sight crosses the face of a volume: +1 where it enters, -1 where it leaves.

    Attributes
    ----------
    place : (2,) float64         in the section
    step : int                   +1 or -1
    count : int                  of the volumes that contain the line of sight behind this place
    caster : str                 name
    """

    place: np.ndarray
    step: int
    count: int
    caster: str


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
    flat = _Flat(origin, axes, normal)
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
        _ends(source, flat, middle) if source.position[3] else np.stack([center, center]),
        {thing.name: _outlines(thing, flat) for thing in scene.objects},
        _sides(volumes, flat, center),
        None if eye is None else flat.project(eye),
        None if point is None else flat.project(point),
        () if eye is None or point is None else _crossings(volumes, eye, point, flat),
    )


def visible_share(place: np.ndarray, ends: np.ndarray, blockers: np.ndarray) -> float:
    """Return the share of a line light that a point of the plane sees past blockers, exactly.

    Parameters
    ----------
    place : (2,)
    ends : (2, 2)                of the light; both equal for a point, whose share is 0 or 1
    blockers : (N, 2, 2)         segments
    """
    axis = ends[1] - ends[0]
    if not axis.any():
        axis = 1e-9 * np.array([-(ends[0] - place)[1], (ends[0] - place)[0]])  # a point, as a very short line
        ends = np.stack([ends[0] - axis / 2, ends[0] + axis / 2])
    across = np.array([-axis[1], axis[0]])
    height = float((ends[0] - place) @ across)
    if height == 0 or not len(blockers):
        return 1.0
    # heights of the blockers' ends: 0 at the place, 1 at the light's line; what is not in between hides nothing
    heights = (blockers - place) @ across / height
    hidden = []
    for (a, b), (low, high) in zip(blockers, heights, strict=True):
        if low > high:
            a, b, low, high = b, a, high, low
        if high <= NEARLY or low >= 1 or (high == low and not NEARLY < low < 1):
            continue
        slope = (b - a) / (high - low) if high > low else np.zeros(2)
        first, last = max(low, NEARLY), min(high, 1.0)
        pair = [a + (first - low) * slope, a + (last - low) * slope] if high > low else [a, b]
        levels = [first, last] if high > low else [low, low]
        along = [
            float((place + (end - place) / level - ends[0]) @ axis / (axis @ axis))
            for end, level in zip(pair, levels, strict=True)
        ]
        hidden.append((max(min(along), 0.0), min(max(along), 1.0)))
    covered, reached = 0.0, 0.0
    for start, end in sorted(hidden):
        covered += max(0.0, end - max(start, reached))
        reached = max(reached, end)
    return 1.0 - covered


@dataclass(frozen=True)
class _Flat:
    """The plane of a section."""

    origin: np.ndarray
    axes: np.ndarray
    normal: np.ndarray

    def project(self, points: np.ndarray) -> np.ndarray:
        """Return the coordinates (..., 2) of world points (..., 3)."""
        projected: np.ndarray = (points - self.origin) @ self.axes.T
        return projected

    def cut(self, triangles: np.ndarray) -> np.ndarray:
        """Return the segments (N, 2, 2) in which the plane cuts world triangles (T, 3, 3)."""
        return self.project(cut_triangles(triangles, self.origin, self.normal))


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


def _ends(light: Light, flat: _Flat, middle: np.ndarray) -> np.ndarray:
    """Return the ends (2, 2) of what the plane cuts out of a light; of a sphere its diameter across the view."""
    center, shape = np.zeros(2), light.shape
    if shape is None:
        return np.stack([center, center])
    if isinstance(shape, Segment):
        in_plane = abs(shape.edge @ flat.normal) <= NEARLY * np.linalg.norm(shape.edge)
        return flat.project(light.position[:3] + shape.corners) if in_plane else np.stack([center, center])
    if isinstance(shape, Rectangle | Disc):
        u, v = shape.half_axes
        direction = np.cross(np.cross(u, v), flat.normal)
        if np.linalg.norm(direction) > NEARLY * np.linalg.norm(u) * np.linalg.norm(v):
            direction /= np.linalg.norm(direction)
            a, b = direction @ u / (u @ u), direction @ v / (v @ v)
            half = 1 / max(abs(a), abs(b)) if isinstance(shape, Rectangle) else shape.radius
            return flat.project(light.position[:3] + np.outer([-half, half], direction))
    across = flat.project(middle) @ np.array([[0.0, 1.0], [-1.0, 0.0]])
    half = shape.bounding_radius / np.linalg.norm(across) if across.any() else 0.0
    return np.stack([-half * across, half * across])


def _outlines(thing: SceneObject, flat: _Flat) -> list[np.ndarray]:
    return join_segments(flat.cut(thing.world_positions[thing.mesh.triangles]))


def _in_world(volume: CasterVolume, homogeneous: np.ndarray) -> np.ndarray:
    """Return finite homogeneous points (..., 4) of a caster's own space in world space (..., 3)."""
    world = homogeneous.astype(np.float64) @ volume.caster.object_to_world.T
    return np.asarray(world[..., :3] / world[..., 3:])


def _sides(volumes: list[CasterVolume], flat: _Flat, center: np.ndarray) -> np.ndarray:
    """Return the sides of the volumes in the section (S, 2, 2), each with the end nearer to the light first."""
    found = [np.zeros((0, 2, 2))]
    for volume in volumes:
        quads = _in_world(volume, volume.volume.sides)
        found.append(flat.cut(np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])))
    segments = np.concatenate(found)
    distances = np.linalg.norm(segments - center, axis=2)
    ordered = np.where((distances[:, 0] <= distances[:, 1])[:, None, None], segments, segments[:, ::-1])
    # each quad was cut as two triangles, so a side comes in two parts: the part behind goes on where the first ends
    return _joined_sides(ordered)


def _joined_sides(parts: np.ndarray) -> np.ndarray:
    """Return the sides without the cuts along the diagonals of their quads."""
    sides = [part.copy() for part in parts]
    joined = True
    while joined:
        joined = False
        for i, a in enumerate(sides):
            size = max(float(np.abs(a).max()), 1.0)
            for j, b in enumerate(sides):
                if i != j and np.abs(a[1] - b[0]).max() <= 1e-7 * size:
                    sides[i] = np.stack([a[0], b[1]])
                    del sides[j]
                    joined = True
                    break
            if joined:
                break
    return np.array(sides).reshape(-1, 2, 2)


def _crossings(volumes: list[CasterVolume], eye: np.ndarray, point: np.ndarray, flat: _Flat) -> tuple[Crossing, ...]:
    """Return where the line of sight crosses faces of volumes, from the eye on, without the surface itself."""
    found: list[tuple[float, int, str]] = []
    for volume in volumes:
        solid, caster = volume.volume, volume.caster
        quads = _in_world(volume, solid.sides)
        positions = np.concatenate(
            [caster.mesh.positions, np.ones((len(caster.mesh.positions), 1), np.float32)], axis=1
        )
        light_cap = np.concatenate([solid.light_cap, solid.light_cap_reversed[:, ::-1]])
        triangles = np.concatenate(
            [
                quads[:, :3],
                quads[:, [0, 2, 3]],
                _in_world(volume, positions[light_cap]),
                _in_world(volume, solid.dark_cap),
            ]
        )
        for t, step in crossings_of(triangles, eye, point):
            found.append((t, step, caster.name))
    crossings, count = [], 0
    for t, step, name in sorted(found):
        count += step
        crossings.append(Crossing(flat.project(eye + t * (point - eye)), step, count, name))
    return tuple(crossings)


def crossings_of(triangles: np.ndarray, start: np.ndarray, end: np.ndarray) -> list[tuple[float, int]]:
    """Return for each triangle (T, 3, 3) that the open segment crosses: where (0 to 1), and +1 from its front, or -1.

    Triangles are counter-clockwise from their front. The last 1e-9 of the segment is left out: there lies the surface
    that it ends on.
    """
    a, b, c = (triangles - start).transpose(1, 0, 2)
    direction = end - start
    volumes = [np.cross(u, v) @ direction for u, v in ((a, b), (b, c), (c, a))]
    normals = np.cross(b - a, c - a)
    slope = normals @ direction
    inside = np.all([v >= 0 for v in volumes], axis=0) | np.all([v <= 0 for v in volumes], axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (normals * a).sum(axis=1) / slope
    crossed = inside & (slope != 0) & (t > 0) & (t < 1 - NEARLY)
    return [(float(t[n]), 1 if slope[n] < 0 else -1) for n in np.flatnonzero(crossed)]
