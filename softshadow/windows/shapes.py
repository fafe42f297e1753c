"""The shapes of GLUT, solid or as lines: spheres, cubes, cones, tori and regular polyhedra."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any

import numpy as np

from softshadow import gl

Point = Sequence[float] | np.ndarray
Corner = tuple[Point, Point]  # normal, position
PHI = (1 + math.sqrt(5)) / 2


def draw_corners(mode: int, corners: Iterable[Corner]) -> None:
    """Draw a primitive from normals and positions."""
    gl.glBegin(mode)
    for normal, position in corners:
        gl.glNormal3d(*map(float, normal))
        gl.glVertex3d(*map(float, position))
    gl.glEnd()


# -- surfaces with two parameters --------------------------------------------------------------------------------------
def draw_grid(rows: Sequence[Sequence[Corner]], solid: bool) -> None:
    """Draw a grid of corners as strips of quads, or as the lines of both directions."""
    if solid:
        for low, high in itertools.pairwise(rows):
            draw_corners(gl.GL_QUAD_STRIP, [corner for pair in zip(high, low, strict=True) for corner in pair])
        return
    for line in (*rows, *zip(*rows, strict=True)):
        draw_corners(gl.GL_LINE_STRIP, line)


def _sphere(solid: bool, radius: float, slices: int, stacks: int) -> None:
    rows = []
    for stack in range(int(stacks) + 1):
        latitude = math.pi * (stack / stacks - 0.5)
        ring = []
        for slice in range(int(slices) + 1):
            longitude = 2 * math.pi * slice / slices
            normal = (
                math.cos(latitude) * math.cos(longitude),
                math.cos(latitude) * math.sin(longitude),
                math.sin(latitude),
            )
            ring.append((normal, [radius * each for each in normal]))
        rows.append(ring)
    draw_grid(rows, solid)


def _cone(solid: bool, base: float, height: float, slices: int, stacks: int) -> None:
    length = math.hypot(base, height) or 1.0
    rows = []
    for stack in range(int(stacks) + 1):
        z = height * stack / stacks
        radius = base * (1 - stack / stacks)
        ring = []
        for slice in range(int(slices) + 1):
            x, y = math.cos(2 * math.pi * slice / slices), math.sin(2 * math.pi * slice / slices)
            ring.append(((x * height / length, y * height / length, base / length), (radius * x, radius * y, z)))
        rows.append(ring)
    draw_grid(rows, solid)
    if solid:
        down = (0.0, 0.0, -1.0)
        draw_corners(gl.GL_POLYGON, [(down, position) for _, position in reversed(rows[0][:-1])])


def _torus(solid: bool, inner: float, outer: float, sides: int, rings: int) -> None:
    rows = []
    for side in range(int(sides) + 1):
        around = 2 * math.pi * side / sides
        row = []
        for ring in range(int(rings) + 1):
            along = 2 * math.pi * ring / rings
            x, y = math.cos(along), math.sin(along)
            normal = (x * math.cos(around), y * math.cos(around), math.sin(around))
            radius = outer + inner * math.cos(around)
            row.append((normal, (radius * x, radius * y, inner * math.sin(around))))
        rows.append(row)
    draw_grid(rows, solid)


# -- polyhedra ---------------------------------------------------------------------------------------------------------
def _hull_faces(points: np.ndarray) -> list[list[int]]:
    """Return the faces of a convex polyhedron around the origin, each counterclockwise seen from outside."""
    faces: dict[tuple[int, ...], list[int]] = {}
    n = len(points)
    for a in range(n):
        for b in range(a + 1, n):
            for c in range(b + 1, n):
                normal = np.cross(points[b] - points[a], points[c] - points[a])
                length = np.linalg.norm(normal)
                if length < 1e-9:
                    continue
                normal = normal / length
                distance = float(normal @ points[a])
                normal, distance = (normal, distance) if distance > 0 else (-normal, -distance)
                heights = points @ normal - distance
                if distance < 1e-9 or heights.max() > 1e-6:
                    continue
                on_face = np.flatnonzero(heights > -1e-6)
                key = tuple(on_face.tolist())
                if key not in faces:
                    faces[key] = _around(points, key, normal)
    return list(faces.values())


def _around(points: np.ndarray, face: Sequence[int], normal: np.ndarray) -> list[int]:
    middle = points[list(face)].mean(axis=0)
    right = points[face[0]] - middle
    up = np.cross(normal, right)
    return sorted(
        face, key=lambda corner: math.atan2((points[corner] - middle) @ up, (points[corner] - middle) @ right)
    )


def _signs(*coordinates: float) -> list[tuple[float, ...]]:
    points: list[tuple[float, ...]] = [()]
    for value in coordinates:
        points = [(*point, sign * value) for point in points for sign in ((1, -1) if value else (1,))]
    return points


def _turned(points: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
    """Return points with their coordinates moved round by none, one and two places."""
    return [(*point[shift:], *point[:shift]) for shift in range(3) for point in points]


POLYHEDRA = {
    "Tetrahedron": [(1.0, 1.0, 1.0), (-1.0, 1.0, -1.0), (1.0, -1.0, -1.0), (-1.0, -1.0, 1.0)],
    "Octahedron": _turned(_signs(1.0, 0.0, 0.0)),
    "Dodecahedron": [*_signs(1.0, 1.0, 1.0), *_turned(_signs(0.0, 1 / PHI, PHI))],
    "Icosahedron": _turned(_signs(0.0, 1.0, PHI)),
}
RADII = {"Tetrahedron": 1.0, "Octahedron": 1.0, "Dodecahedron": math.sqrt(3), "Icosahedron": 1.0}


def _polyhedron(name: str, solid: bool) -> None:
    points = np.array(POLYHEDRA[name], np.float64)
    points *= RADII[name] / np.linalg.norm(points[0])
    _faces(points, solid)


def _cube(solid: bool, size: float) -> None:
    _faces(np.array(_signs(1.0, 1.0, 1.0)) * (size / 2), solid)


def _faces(points: np.ndarray, solid: bool) -> None:
    for face in _hull_faces(points):
        normal = points[face].mean(axis=0)
        normal /= np.linalg.norm(normal)
        draw_corners(gl.GL_POLYGON if solid else gl.GL_LINE_LOOP, [(normal, points[corner]) for corner in face])


def _named() -> dict[str, Callable[..., Any]]:
    shapes: dict[str, Callable[..., Any]] = {}
    for kind, solid in (("Solid", True), ("Wire", False)):
        for name, draw in (("Sphere", _sphere), ("Cone", _cone), ("Torus", _torus), ("Cube", _cube)):
            shapes[f"glut{kind}{name}"] = partial(draw, solid)
        for name in POLYHEDRA:
            shapes[f"glut{kind}{name}"] = partial(_polyhedron, name, solid)
    return shapes


SHAPES = _named()
