"""Shadow volumes in a section: their sides, and where the line of sight crosses their faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow.report.section_plane import SectionPlane
from softshadow.techniques.shadow_volumes import CasterVolume

SURFACE = 1e-9  # share of the line of sight next to its end that is left out


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


def _in_world(volume: CasterVolume, homogeneous: np.ndarray) -> np.ndarray:
    """Return finite homogeneous points (..., 4) of a caster's own space in world space (..., 3)."""
    world = homogeneous.astype(np.float64) @ volume.caster.object_to_world.T
    return np.asarray(world[..., :3] / world[..., 3:])


def sides_of_volumes(volumes: list[CasterVolume], plane: SectionPlane, center: np.ndarray) -> np.ndarray:
    """Return the sides of the volumes in the section (S, 2, 2), each with the end nearer to the light first."""
    found = [np.zeros((0, 2, 2))]
    for volume in volumes:
        quads = _in_world(volume, volume.volume.sides)
        found.append(plane.cut(np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])))
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


def crossings_on_line(
    volumes: list[CasterVolume], eye: np.ndarray, point: np.ndarray, plane: SectionPlane
) -> tuple[Crossing, ...]:
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
        crossings.append(Crossing(plane.project(eye + t * (point - eye)), step, count, name))
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
    crossed = inside & (slope != 0) & (t > 0) & (t < 1 - SURFACE)
    return [(float(t[n]), 1 if slope[n] < 0 else -1) for n in np.flatnonzero(crossed)]
