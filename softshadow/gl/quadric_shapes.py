"""The strips of GLU's quadrics: spheres, cylinders and disks, by their styles.

Coordinates are computed in the precision and order of libGLU's quad.c: tables of sines and cosines in float32, products
with doubles in double precision.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.gl.glu_tokens import (
    GLU_FILL,
    GLU_FLAT,
    GLU_LINE,
    GLU_NONE,
    GLU_OUTSIDE,
    GLU_POINT,
    GLU_SMOOTH,
)
from softshadow.gl.shape_calls import Calls
from softshadow.gl.shape_strips import Changes

F32 = np.float32
KEPT_TABLES = 64  # and spheres, but for their radii
NO_NORMALS = np.empty((0, 3))


class Manner(NamedTuple):
    """How a quadric is drawn."""

    normals: int
    has_texture: bool
    orientation: int
    style: int


class Around(NamedTuple):
    """Sines and cosines of angles, float32 (n,)."""

    sines: np.ndarray
    cosines: np.ndarray

    def at(self, i: Any, radius: Any, z: Any) -> np.ndarray:
        """Return the points (m, 3) float64 at angles, with float32 radii and heights."""
        x = self.sines[i] * radius
        points = np.empty((*x.shape, 3))
        points[..., 0], points[..., 1], points[..., 2] = x, self.cosines[i] * radius, z
        return points


class Tables(NamedTuple):
    """Sines and cosines of angles rounded to float32: float64 (n,)."""

    sines: np.ndarray
    cosines: np.ndarray

    def scaled(self, scale: float = 1.0) -> Around:
        """Return them times a scale, rounded to float32."""
        return Around((scale * self.sines).astype(F32), (scale * self.cosines).astype(F32))


def _tables(angles: Iterable[float]) -> Tables:
    rounded = [float(F32(angle)) for angle in angles]
    return Tables(*[np.array([function(angle) for angle in rounded]) for function in (math.sin, math.cos)])


@lru_cache(KEPT_TABLES)
def _circle(n: int, shift: float = 0.0) -> Tables:
    """Return the tables of n angles around the axis, and the first one again."""
    return Tables(*[np.append(each, each[0]) for each in _tables(2 * math.pi * (i - shift) / n for i in range(n))])


@lru_cache(KEPT_TABLES)
def _turns(stacks: int, shift: float = 0.0) -> Tables:
    """Return the tables of the angles from pole to pole."""
    return _tables(math.pi * (j - shift) / stacks for j in range(stacks + 1))


def _ratio(a: Any, b: int) -> np.ndarray:
    """Return a quotient of integers in float32."""
    return np.asarray(a, F32) / F32(b)


def _each(values: np.ndarray, first: int = 0) -> Changes:
    """Return the changes of an attribute before each vertex from the first on."""
    return Changes(np.arange(first, first + len(values)), values)


class Part(NamedTuple):
    """A strip of a sphere of any radius.

    `normal` is set before it, `i` and `j` count its vertices around and along the axis; `tip` is -1 or 1 for a fan
    around a pole, which comes first, else 0.
    """

    normal: tuple[float, ...]
    mode: int
    i: Any
    j: Any
    tip: float
    changes: dict[str, Changes]


def sphere(quad: Manner, radius: float, slices: int, stacks: int) -> Calls:
    """Return the calls of gluSphere."""
    calls, around = Calls(), _circle(slices).scaled()
    ring, height = _turns(stacks).scaled(radius)
    ring[0] = ring[stacks] = 0.0
    for part in _sphere_parts(quad, slices, stacks):
        if part.normal:
            calls.set("normal", *part.normal)
        positions = around.at(part.i, ring[part.j], height[part.j])
        if part.tip:
            positions = np.concatenate([[[0.0, 0.0, part.tip * radius]], positions])
        calls.strip(part.mode, positions, **part.changes)
    return calls


@lru_cache(KEPT_TABLES)
def _sphere_parts(quad: Manner, slices: int, stacks: int) -> list[Part]:
    parts, outside = list[Part](), quad.orientation == GLU_OUTSIDE
    sign = 1.0 if outside else -1.0
    smooth, flat = quad.normals == GLU_SMOOTH, quad.normals == GLU_FLAT
    around, flat_around = _circle(slices).scaled(), _circle(slices, 0.5).scaled()
    (ring, height), (flat_ring, flat_height) = _turns(stacks).scaled(sign), _turns(stacks, 0.5).scaled(sign)
    every, down = np.arange(slices + 1), np.arange(stacks + 1)

    def strip(mode: int, i: Any, j: Any, **changes: Changes) -> None:
        if quad.has_texture:
            s, t = np.broadcast_arrays(1 - _ratio(i, slices).astype(float), 1 - _ratio(j, stacks).astype(float))
            changes["texcoord0"] = _each(np.stack([s, t], axis=1))
        parts.append(Part((), mode, i, j, 0.0, changes))

    def with_normals(mode: int, i: Any, j: Any, flat_normals: np.ndarray) -> None:
        """Add a strip with a normal before each vertex."""
        if smooth or flat:
            strip(mode, i, j, normal=_each(around.at(i, ring[j], height[j]) if smooth else flat_normals))
        else:
            strip(mode, i, j)

    def cap(j: int, pole: int, flat_j: int, order: np.ndarray, skips: bool) -> None:
        before: tuple[float, ...] = ()
        changes: dict[str, Changes] = {}
        if smooth:
            # libGLU takes this entry for the lower pole, behind its table if there are more stacks than slices
            before = tuple(around.at(pole if pole <= slices else 0, ring[pole], height[pole]).tolist())
            changes["normal"] = _each(around.at(order, ring[j], height[j]), 1)
        elif flat:
            places = np.flatnonzero(~(skips & (order == slices)))
            values = flat_around.at(order[places] + skips, flat_ring[flat_j], flat_height[flat_j])
            changes["normal"] = Changes(places + 1, values)
        parts.append(Part(before, gl.GL_TRIANGLE_FAN, order, j, 1.0 if pole == 0 else -1.0, changes))

    if quad.style == GLU_FILL:
        first, end = 0, stacks
        if not quad.has_texture:
            first, end = 1, stacks - 1
            cap(1, 0, 1, every[::-1] if outside else every, outside)
            cap(stacks - 1, stacks, stacks, every if outside else every[::-1], not outside)
        both = np.repeat(every, 2)
        for j in range(first, end):
            pair = np.tile((j + 1, j) if outside else (j, j + 1), slices + 1)
            if flat:
                values = flat_around.at(every, flat_ring[j + 1], flat_height[j + 1])
                strip(gl.GL_QUAD_STRIP, both, pair, normal=Changes(2 * every + 1, values))
            else:
                with_normals(gl.GL_QUAD_STRIP, both, pair, NO_NORMALS)
    elif quad.style == GLU_POINT:
        columns, rows = np.tile(every[:-1], stacks + 1), np.repeat(down, slices)
        if flat:
            strip(gl.GL_POINTS, columns, rows)
        else:
            with_normals(gl.GL_POINTS, columns, rows, NO_NORMALS)
    else:
        for j in range(1, stacks):
            with_normals(gl.GL_LINE_STRIP, every, j, flat_around.at(every, ring[j], height[j]))
        for i in range(slices):
            with_normals(gl.GL_LINE_STRIP, i, down, around.at(i, flat_ring, flat_height))
    return parts


def slant(base: float, top: float, height: float) -> np.float32:
    """Return the length of the side of a cone."""
    delta = F32(base - top)
    return F32(math.sqrt(float(F32(delta * delta)) + height * height))


def cylinder(quad: Manner, base: float, top: float, height: float, slices: int, stacks: int) -> Calls:
    """Return the calls of gluCylinder."""
    calls = Calls()
    delta, length = F32(base - top), slant(base, top, height)
    sign = 1.0 if quad.orientation == GLU_OUTSIDE else -1.0
    normal_z, ratio = F32(delta / length), float(F32(height / float(length)))
    around = _circle(slices).scaled()
    smooth, flat = _circle(slices).scaled(sign * ratio), _circle(slices, 0.5).scaled(sign * ratio)
    sides = flat if quad.normals == GLU_FLAT else smooth
    every, up = np.arange(slices + 1), np.arange(stacks + 1)

    def strip(mode: int, i: Any, j: Any, places: np.ndarray | None = None, sides: Around = sides) -> None:
        """Draw a strip with normals before the vertices at `places`."""
        i, j = np.broadcast_arrays(i, j)
        radius = (base - (delta * _ratio(j, stacks)).astype(float)).astype(F32)
        changes: dict[str, Changes] = {}
        if places is not None and quad.normals != GLU_NONE:
            changes["normal"] = Changes(places, sides.at(i[places], F32(1), normal_z))
        if quad.has_texture:
            coordinates = np.stack([1 - _ratio(i, slices).astype(float), _ratio(j, stacks).astype(float)], axis=1)
            changes["texcoord0"] = _each(coordinates)
        calls.strip(mode, around.at(i, radius, (j * height / stacks).astype(F32)), **changes)

    if quad.style == GLU_FILL:
        for j in range(stacks):
            pair = (j, j + 1) if quad.orientation == GLU_OUTSIDE else (j + 1, j)
            strip(gl.GL_QUAD_STRIP, np.repeat(every, 2), np.tile(pair, slices + 1), 2 * every)
        return calls
    if quad.style == GLU_POINT:
        columns, rows = np.repeat(every[:-1], stacks + 1), np.tile(up, slices)
        strip(gl.GL_POINTS, columns, rows, every[:-1] * (stacks + 1), smooth)
        return calls
    for j in (*(range(1, stacks) if quad.style == GLU_LINE else ()), 0, stacks):
        strip(gl.GL_LINE_STRIP, every, j, every)
    for i in range(slices):
        if quad.normals != GLU_NONE:
            calls.set("normal", *smooth.at(i, F32(1), F32(0)).tolist())
        strip(gl.GL_LINE_STRIP, i, up)
    return calls


def disk(quad: Manner, inner: float, outer: float, slices: int, loops: int, start: float, sweep: float) -> Calls:
    """Return the calls of gluPartialDisk."""
    calls, outside = Calls(), quad.orientation == GLU_OUTSIDE
    is_whole = sweep == 360
    delta, offset = F32(outer - inner), float(F32(start / 180.0 * math.pi))
    around = _tables(offset + (math.pi * sweep / 180.0) * i / slices for i in range(slices + 1)).scaled()
    if is_whole:
        for table in around:
            table[slices] = table[0]
    if quad.normals != GLU_NONE:
        calls.set("normal", 0.0, 0.0, 1.0 if outside else -1.0)
    every, across = np.arange(slices + 1), np.arange(loops + 1)

    def strip(mode: int, i: Any, j: Any, tip: bool = False, precise: bool = False) -> None:
        """Draw a strip, after its middle if it is a fan around `tip`; `precise`: with the radius not rounded."""
        i, j = np.broadcast_arrays(i, j)
        radius = (outer - (delta * _ratio(j, loops)).astype(float)).astype(F32)
        positions, changes = around.at(i, np.float64(outer) if precise else radius, F32(0)), {}
        if quad.has_texture:
            scale = (radius.astype(float) / outer / 2).astype(F32)
            coordinates = (around.at(i, scale, F32(0))[:, :2] + 0.5).astype(F32).astype(float)
            changes["texcoord0"] = _each(np.concatenate([[(0.5, 0.5)], coordinates]) if tip else coordinates)
        calls.strip(mode, np.concatenate([np.zeros((1, 3)), positions]) if tip else positions, **changes)

    if quad.style == GLU_FILL:
        rings = loops
        if inner == 0:
            rings = loops - 1
            strip(gl.GL_TRIANGLE_FAN, every[::-1] if outside else every, loops - 1, tip=True)
        for j in range(rings):
            pair = (j, j + 1) if outside else (j + 1, j)
            strip(gl.GL_QUAD_STRIP, np.repeat(every, 2), np.tile(pair, slices + 1))
        return calls
    spokes = range(slices if is_whole else slices + 1)
    if quad.style == GLU_POINT:
        strip(gl.GL_POINTS, np.repeat(np.array(spokes), loops + 1), np.tile(across, len(spokes)))
    elif quad.style == GLU_LINE and inner == outer:
        strip(gl.GL_LINE_STRIP, every, 0, precise=True)
    elif quad.style == GLU_LINE:
        for j in range(loops + 1):
            strip(gl.GL_LINE_STRIP, every, j)
        for i in spokes:
            strip(gl.GL_LINE_STRIP, i, across)
    else:
        for i in () if is_whole else (0, slices):
            strip(gl.GL_LINE_STRIP, i, across)
        for j in (0,) if inner == outer else (0, loops):
            strip(gl.GL_LINE_STRIP, every, j)
    return calls


__all__ = ["Manner", "cylinder", "disk", "slant", "sphere"]
