"""The round shapes of GLUT: sphere, cone, cylinder and torus, in float32 with the vertices of freeglut 3.4."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from softshadow import gl
from softshadow.windows.glut.drawing import Shape, Surface, count, draw_lines, draw_strips, indices, kept

F32 = np.float32
DOWN, UP = (0.0, 0.0, -1.0), (0.0, 0.0, 1.0)


@lru_cache(32)
def _circle(n: int, turn: int = 2) -> np.ndarray:
    """Return cosines and sines of n angles from 0 on, a full circle or, for turn 1, a half; clockwise for a negative n.

    The angles are float32, their sines are rounded from float64.
    """
    angle = F32(turn) * F32(math.pi) / F32(n)
    angles = [float(angle * F32(step)) for step in range(1, abs(n))]
    return np.array([(1.0, 0.0), *((math.cos(each), math.sin(each)) for each in angles)], F32)


def _ring(slices: int, circle: np.ndarray, radius: Any, z: Any) -> np.ndarray:
    """Return the positions (slices, 3) of a circle around the z axis."""
    return np.column_stack([circle[:, 0] * radius, circle[:, 1] * radius, np.full(slices, z, F32)])


def _disc(slices: int, normal: tuple[float, float, float]) -> np.ndarray:
    return np.full((slices, 3), normal, F32)


def _closed(first: int, slices: int) -> np.ndarray:
    """Return the indices of a ring, with the first one again at its end."""
    return first + np.arange(slices + 1) % slices


def _strip(left: np.ndarray | int, right: np.ndarray | int) -> np.ndarray:
    """Return the indices of a strip between two rings, or between a ring and a pole."""
    return np.stack(np.broadcast_arrays(left, right), axis=1).ravel()


def _counts(call: str, names: Sequence[str], values: Sequence[Any]) -> list[int]:
    return [count(call, name, value) for name, value in zip(names, values, strict=True)]


def draw_sphere(solid: bool, radius: Any, slices: Any, stacks: Any) -> None:
    """Draw a sphere around the origin, with its poles on the z axis."""
    call = "glutSolidSphere" if solid else "glutWireSphere"
    slices, stacks = _counts(call, ("slices", "stacks"), (slices, stacks))
    if slices < 1 or stacks < 2:
        return
    shape = _sphere(solid, F32(radius), slices, stacks)
    if solid:
        draw_strips(shape)
    else:
        draw_lines(shape, gl.GL_LINE_STRIP)


@kept
def _sphere(solid: bool, radius: np.float32, slices: int, stacks: int) -> Shape:
    unit = _unit_sphere(solid, slices, stacks)
    return unit._replace(surface=Surface(unit.surface.normals * radius, unit.surface.normals))


@kept
def _unit_sphere(solid: bool, slices: int, stacks: int) -> Shape:
    around, down = _circle(-slices), _circle(stacks, 1)
    rings = [_ring(slices, around, down[stack, 1], down[stack, 0]) for stack in range(1, stacks)]
    normals = np.concatenate([np.array([UP], F32), *rings, np.array([DOWN], F32)])
    surface, last = Surface(normals, normals), len(normals) - 1
    firsts = range(1, last, slices)
    if solid:
        closed = [_closed(first, slices) for first in firsts]
        middle = [_strip(below, above) for above, below in itertools.pairwise(closed)]
        return Shape(surface, indices([_strip(closed[0], 0), *middle, _strip(last, closed[-1])]))
    meridians = [[0, *range(1 + slice, last, slices), last] for slice in range(slices)]
    parallels = [range(first, first + slices) for first in firsts]
    return Shape(surface, indices(meridians), indices(parallels))


def draw_cone(solid: bool, base: Any, height: Any, slices: Any, stacks: Any) -> None:
    """Draw a cone along the z axis, from its base at 0 to its tip."""
    call = "glutSolidCone" if solid else "glutWireCone"
    slices, stacks = _counts(call, ("slices", "stacks"), (slices, stacks))
    if slices >= 1 and stacks >= 1:
        _draw_sides(solid, _cone(solid, F32(base), F32(height), slices, stacks))


@kept
def _cone(solid: bool, base: np.float32, height: np.float32, slices: int, stacks: int) -> Shape:
    circle = _circle(-slices)
    with np.errstate(all="ignore"):  # a cone without size has no normals
        length = np.sqrt(np.float64(height * height + base * base))
        cosine, sine = F32(height / length), F32(base / length)
        z_step, radius_step = height / F32(stacks), base / F32(stacks)
        z, radius = F32(0), base
        rings = [np.zeros((1, 3), F32), _ring(slices, circle, radius, z)]
        for _ in range(stacks + 1):
            rings.append(_ring(slices, circle, radius, z))
            z, radius = z + z_step, radius - radius_step
        normals = [_disc(slices + 1, DOWN), *[_ring(slices, circle, cosine, sine)] * (stacks + 1)]
    surface = Surface(np.concatenate(rings), np.concatenate(normals))
    if solid:
        return Shape(surface, indices(_strips_of_sides(slices, stacks)))
    return Shape(surface, *_lines_of_sides(slices, stacks, stacks))


def draw_cylinder(solid: bool, radius: Any, height: Any, slices: Any, stacks: Any) -> None:
    """Draw a cylinder along the z axis, from 0 to its height."""
    call = "glutSolidCylinder" if solid else "glutWireCylinder"
    slices, stacks = _counts(call, ("slices", "stacks"), (slices, stacks))
    if slices >= 1 and stacks >= 1:
        _draw_sides(solid, _cylinder(solid, F32(radius), F32(height), slices, stacks))


@kept
def _cylinder(solid: bool, radius: np.float32, height: np.float32, slices: int, stacks: int) -> Shape:
    circle, step = _circle(-slices), height / F32(stacks)
    z = F32(0)
    rings = [np.zeros((1, 3), F32), _ring(slices, circle, radius, z)]
    for _ in range(stacks + 1):
        rings.append(_ring(slices, circle, radius, z))
        z = z + step
    rings += [_ring(slices, circle, radius, z - step), np.array([(0, 0, height)], F32)]
    sides = [_ring(slices, circle, F32(1), F32(0))] * (stacks + 1)
    surface = Surface(np.concatenate(rings), np.concatenate([_disc(slices + 1, DOWN), *sides, _disc(slices + 1, UP)]))
    if solid:
        top = _strip(_closed(1 + (stacks + 2) * slices, slices), len(surface.positions) - 1)
        return Shape(surface, indices([*_strips_of_sides(slices, stacks), top]))
    return Shape(surface, *_lines_of_sides(slices, stacks, stacks + 1))


def _draw_sides(solid: bool, shape: Shape) -> None:
    if solid:
        draw_strips(shape)
    else:
        draw_lines(shape, gl.GL_LINES)


def _strips_of_sides(slices: int, stacks: int) -> list[np.ndarray]:
    """Return the strips of the disc around vertex 0 and of the sides above; the disc's ring is there twice."""
    rings = [_closed(1 + number * slices, slices) for number in range(1, stacks + 2)]
    return [_strip(0, _closed(1, slices)), *(_strip(*pair) for pair in itertools.pairwise(rings))]


def _lines_of_sides(slices: int, stacks: int, n_loops: int) -> tuple[np.ndarray, np.ndarray]:
    lines = [number for slice in range(slices) for number in (1 + slice + slices, 1 + slice + (stacks + 1) * slices)]
    loops = [range(1 + number * slices, 1 + (number + 1) * slices) for number in range(1, n_loops + 1)]
    return indices([lines]), indices(loops)


def draw_torus(solid: bool, inner: Any, outer: Any, sides: Any, rings: Any) -> None:
    """Draw a torus around the z axis: a circle of radius `inner`, moved along one of radius `outer`."""
    call = "glutSolidTorus" if solid else "glutWireTorus"
    sides, rings = _counts(call, ("sides", "rings"), (sides, rings))
    if sides < 2 or rings < 2:
        return
    shape = _torus(solid, F32(inner), F32(outer), sides, rings)
    if solid:
        draw_strips(shape)
    else:
        draw_lines(shape, gl.GL_LINE_LOOP)


@kept
def _torus(solid: bool, inner: np.float32, outer: np.float32, sides: int, rings: int) -> Shape:
    along, around = _circle(rings), _circle(-sides)
    z = np.broadcast_to(around[:, 1], (rings, sides))
    normals = np.stack([along[:, :1] * around[:, 0], along[:, 1:] * around[:, 0], z], axis=-1)
    reach = outer + around[:, 0] * inner
    positions = np.stack([along[:, :1] * reach, along[:, 1:] * reach, z * inner], axis=-1)
    surface, grid = Surface(*_rows(positions, normals)), np.arange(rings * sides).reshape(rings, sides)
    if solid:
        closed = np.concatenate([grid, grid[:1]])
        strips = [_strip(closed[:, side], closed[:, (side + 1) % sides]) for side in range(sides)]
        return Shape(surface, indices(strips))
    return Shape(surface, indices(grid), indices(grid.T))


def _rows(*grids: np.ndarray) -> list[np.ndarray]:
    """Return arrays (..., 3) as copies (n, 3)."""
    return [grid.reshape(-1, 3).copy() for grid in grids]
