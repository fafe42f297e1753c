"""GLU's quadrics: spheres, cylinders and disks, drawn in immediate mode.

A function returns the calls of each shape; those of small shapes are kept, because programs draw the same shapes again
and again.

Coordinates are computed in the precision and order of libGLU's quad.c: tables of sines and cosines in float32, products
with doubles in double precision.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.glu_tokens import (
    GLU_ERROR,
    GLU_FILL,
    GLU_FLAT,
    GLU_INSIDE,
    GLU_INVALID_ENUM,
    GLU_INVALID_VALUE,
    GLU_LINE,
    GLU_NONE,
    GLU_OUTSIDE,
    GLU_POINT,
    GLU_SILHOUETTE,
    GLU_SMOOTH,
)
from softshadow.gl.shape_calls import Calls

F32 = np.float32
MOST = 239  # slices and stacks
KEPT_SHAPES, KEPT_PLACES = 32, 2500  # shapes whose calls are kept, and their largest slices * stacks: below 150 MB
Table = list[float]  # float32 numbers


class Manner(NamedTuple):
    """How a quadric is drawn."""

    normals: int
    has_texture: bool
    orientation: int
    style: int


@dataclass(eq=False)
class GLUquadric:
    """What gluNewQuadric returns: how the shapes are drawn."""

    normals: int = GLU_SMOOTH
    has_texture: bool = False
    orientation: int = GLU_OUTSIDE
    style: int = GLU_FILL
    on_error: Callable[[int], Any] | None = None

    def manner(self) -> Manner:
        """Return how shapes are drawn now."""
        return Manner(self.normals, self.has_texture, self.orientation, self.style)

    def fail(self, code: int) -> None:
        """Tell the error callback, if there is one."""
        if self.on_error is not None:
            self.on_error(code)


def gluNewQuadric() -> GLUquadric:
    """Return a quadric: filled, with smooth normals that point outwards, without texture coordinates."""
    return GLUquadric()


def gluDeleteQuadric(quad: GLUquadric) -> None:
    """Do nothing: Python frees the quadric."""


def gluQuadricCallback(quad: GLUquadric, which: int = GLU_ERROR, function: Callable[[int], Any] | None = None) -> None:
    """Set the function that is called with GLU's error codes."""
    if which != GLU_ERROR:
        raise ValueError(f"gluQuadricCallback(which={which}): expected GLU_ERROR")
    quad.on_error = function


def gluQuadricNormals(quad: GLUquadric, normal: int) -> None:
    """Choose GLU_NONE, GLU_FLAT or GLU_SMOOTH normals."""
    if normal in (GLU_NONE, GLU_FLAT, GLU_SMOOTH):
        quad.normals = int(normal)
    else:
        quad.fail(GLU_INVALID_ENUM)


def gluQuadricTexture(quad: GLUquadric, texture: bool) -> None:
    """Choose whether vertices get texture coordinates."""
    quad.has_texture = bool(texture)


def gluQuadricOrientation(quad: GLUquadric, orientation: int) -> None:
    """Choose whether normals point GLU_OUTSIDE or GLU_INSIDE."""
    if orientation in (GLU_OUTSIDE, GLU_INSIDE):
        quad.orientation = int(orientation)
    else:
        quad.fail(GLU_INVALID_ENUM)


def gluQuadricDrawStyle(quad: GLUquadric, draw: int) -> None:
    """Choose GLU_POINT, GLU_LINE, GLU_FILL or GLU_SILHOUETTE."""
    if draw in (GLU_POINT, GLU_LINE, GLU_FILL, GLU_SILHOUETTE):
        quad.style = int(draw)
    else:
        quad.fail(GLU_INVALID_ENUM)


def _draw(shape: Callable[..., Calls], quad: GLUquadric, places: int, *numbers: float) -> None:
    """Carry out the calls of a shape."""
    make = _kept if places <= KEPT_PLACES else _made
    make(shape, quad.manner(), *numbers).make()


def _made(shape: Callable[..., Calls], manner: Manner, *numbers: float) -> Calls:
    return shape(manner, *numbers)


_kept = lru_cache(KEPT_SHAPES)(_made)


# -- drawing -----------------------------------------------------------------------------------------------------------
def _tables(angles: Iterable[float], scale: float = 1.0) -> tuple[Table, Table]:
    """Return sines and cosines, times a scale, of angles rounded to float32."""
    rounded = [float(F32(angle)) for angle in angles]
    return ([_f(scale * math.sin(angle)) for angle in rounded], [_f(scale * math.cos(angle)) for angle in rounded])


def _around(n: int, shift: float = 0.0, scale: float = 1.0) -> tuple[Table, Table]:
    """Return the tables of n angles around the axis, and the first one again."""
    sines, cosines = _tables((2 * math.pi * (i - shift) / n for i in range(n)), scale)
    return [*sines, sines[0]], [*cosines, cosines[0]]


def _f(value: float) -> float:
    return float(F32(value))


def _product(a: float, b: float) -> float:
    """Return a product of two float32 numbers, in float32."""
    return float(F32(a) * F32(b))


def _ratio(a: int, b: int) -> float:
    return float(F32(a) / F32(b))


def _both_ways(quad: Manner, n: int) -> Iterator[int]:
    """Return 0 ... n, backwards for GLU_OUTSIDE: so a fan is seen from the right side."""
    return iter(range(n, -1, -1) if quad.orientation == GLU_OUTSIDE else range(n + 1))


def gluSphere(quad: GLUquadric, radius: float, slices: int, stacks: int) -> None:
    """Draw a sphere around the origin, with its poles on the z axis."""
    slices, stacks = min(int(slices), MOST), min(int(stacks), MOST)
    if slices < 2 or stacks < 1 or radius < 0:
        quad.fail(GLU_INVALID_VALUE)
        return
    _draw(_sphere, quad, slices * stacks, float(radius), slices, stacks)


def _sphere(quad: Manner, radius: float, slices: int, stacks: int) -> Calls:
    calls = Calls()
    sign = 1.0 if quad.orientation == GLU_OUTSIDE else -1.0
    sine, cosine = _around(slices)
    flat_sine, flat_cosine = _around(slices, 0.5)
    turns = [math.pi * j / stacks for j in range(stacks + 1)]
    ring, height = _tables(turns, float(radius))
    ring[0] = ring[stacks] = 0.0
    normal_ring, normal_height = _tables(turns, sign)
    flat_ring, flat_height = _tables((math.pi * (j - 0.5) / stacks for j in range(stacks + 1)), sign)
    smooth, flat = quad.normals == GLU_SMOOTH, quad.normals == GLU_FLAT

    def vertex(i: int, j: int) -> None:
        if quad.has_texture:
            calls.coordinates(1 - _ratio(i, slices), 1 - _ratio(j, stacks))
        calls.vertex(_product(ring[j], sine[i]), _product(ring[j], cosine[i]), height[j])

    def normal(s: Table, c: Table, i: int, around: float, z: float) -> None:
        calls.normal(_product(s[i], around), _product(c[i], around), z)

    def cap(j: int, pole: int, flat_j: int, order: Iterable[int], skips: bool) -> None:
        if smooth:
            # libGLU takes this entry for the lower pole, behind its table if there are more stacks than slices
            normal(sine, cosine, pole if pole <= slices else 0, normal_ring[pole], normal_height[pole])
        calls.begin(gl.GL_TRIANGLE_FAN)
        calls.vertex(0.0, 0.0, float(radius) if pole == 0 else -float(radius))
        for i in order:
            if smooth:
                normal(sine, cosine, i, normal_ring[j], normal_height[j])
            elif flat and not (skips and i == slices):
                normal(flat_sine, flat_cosine, i + skips, flat_ring[flat_j], flat_height[flat_j])
            vertex(i, j)
        calls.end()

    if quad.style == GLU_FILL:
        first, end = 0, stacks
        if not quad.has_texture:
            first, end = 1, stacks - 1
            outside = quad.orientation == GLU_OUTSIDE
            backwards, forwards = range(slices, -1, -1), range(slices + 1)
            cap(1, 0, 1, backwards if outside else forwards, outside)
            cap(stacks - 1, stacks, stacks, forwards if outside else backwards, not outside)
        for j in range(first, end):
            one, other = (j + 1, j) if quad.orientation == GLU_OUTSIDE else (j, j + 1)
            calls.begin(gl.GL_QUAD_STRIP)
            for i in range(slices + 1):
                if smooth:
                    normal(sine, cosine, i, normal_ring[one], normal_height[one])
                vertex(i, one)
                if smooth:
                    normal(sine, cosine, i, normal_ring[other], normal_height[other])
                elif flat:
                    normal(flat_sine, flat_cosine, i, flat_ring[j + 1], flat_height[j + 1])
                vertex(i, other)
            calls.end()
        return calls
    if quad.style == GLU_POINT:
        calls.begin(gl.GL_POINTS)
        for j in range(stacks + 1):
            for i in range(slices):
                if smooth:
                    normal(sine, cosine, i, normal_ring[j], normal_height[j])
                vertex(i, j)
        calls.end()
        return calls
    for j in range(1, stacks):
        calls.begin(gl.GL_LINE_STRIP)
        for i in range(slices + 1):
            if smooth:
                normal(sine, cosine, i, normal_ring[j], normal_height[j])
            elif flat:
                normal(flat_sine, flat_cosine, i, normal_ring[j], normal_height[j])
            vertex(i, j)
        calls.end()
    for i in range(slices):
        calls.begin(gl.GL_LINE_STRIP)
        for j in range(stacks + 1):
            if smooth:
                normal(sine, cosine, i, normal_ring[j], normal_height[j])
            elif flat:
                normal(sine, cosine, i, flat_ring[j], flat_height[j])
            vertex(i, j)
        calls.end()
    return calls


def gluCylinder(quad: GLUquadric, base: float, top: float, height: float, slices: int, stacks: int) -> None:
    """Draw a cylinder or cone around the z axis, from z = 0 to z = height, without its ends."""
    slices, stacks = min(int(slices), MOST), int(stacks)
    if slices < 2 or stacks < 1 or base < 0 or top < 0 or height < 0:
        quad.fail(GLU_INVALID_VALUE)
        return
    if _slant(base, top, height) == 0:
        quad.fail(GLU_INVALID_VALUE)
        return
    _draw(_cylinder, quad, slices * stacks, float(base), float(top), float(height), slices, stacks)


def _slant(base: float, top: float, height: float) -> np.float32:
    delta = F32(base - top)
    return F32(math.sqrt(float(F32(delta * delta)) + height * height))


def _cylinder(quad: Manner, base: float, top: float, height: float, slices: int, stacks: int) -> Calls:
    calls = Calls()
    delta, length = F32(base - top), _slant(base, top, height)
    sign = 1.0 if quad.orientation == GLU_OUTSIDE else -1.0
    normal_z, ratio = float(delta / length), _f(height / float(length))
    sine, cosine = _around(slices)
    smooth_tables, flat_tables = _around(slices, 0.0, sign * ratio), _around(slices, 0.5, sign * ratio)
    tables = flat_tables if quad.normals == GLU_FLAT else smooth_tables

    def normal(i: int, tables: tuple[Table, Table], z: float) -> None:
        if quad.normals != GLU_NONE:
            calls.normal(tables[0][i], tables[1][i], z)

    def vertex(i: int, j: int) -> None:
        radius = _f(base - float(delta * F32(_ratio(j, stacks))))
        if quad.has_texture:
            calls.coordinates(1 - _ratio(i, slices), _ratio(j, stacks))
        calls.vertex(_product(radius, sine[i]), _product(radius, cosine[i]), _f(j * height / stacks))

    if quad.style == GLU_FILL:
        for j in range(stacks):
            pair = (j, j + 1) if quad.orientation == GLU_OUTSIDE else (j + 1, j)
            calls.begin(gl.GL_QUAD_STRIP)
            for i in range(slices + 1):
                normal(i, tables, normal_z)
                for each in pair:
                    vertex(i, each)
            calls.end()
        return calls
    if quad.style == GLU_POINT:
        calls.begin(gl.GL_POINTS)
        for i in range(slices):
            normal(i, smooth_tables, normal_z)
            for j in range(stacks + 1):
                vertex(i, j)
        calls.end()
        return calls
    rings = [*(range(1, stacks) if quad.style == GLU_LINE else ()), 0, stacks]
    for j in rings:
        calls.begin(gl.GL_LINE_STRIP)
        for i in range(slices + 1):
            normal(i, tables, normal_z)
            vertex(i, j)
        calls.end()
    for i in range(slices):
        normal(i, smooth_tables, 0.0)
        calls.begin(gl.GL_LINE_STRIP)
        for j in range(stacks + 1):
            vertex(i, j)
        calls.end()
    return calls


def gluDisk(quad: GLUquadric, inner: float, outer: float, slices: int, loops: int) -> None:
    """Draw a disk in the plane z = 0, with a hole of radius `inner`."""
    gluPartialDisk(quad, inner, outer, slices, loops, 0.0, 360.0)


def gluPartialDisk(
    quad: GLUquadric, inner: float, outer: float, slices: int, loops: int, start: float, sweep: float
) -> None:
    """Draw a part of a disk: angles in degrees, clockwise from the y axis."""
    slices, loops = min(int(slices), MOST), int(loops)
    if slices < 2 or loops < 1 or outer <= 0 or inner < 0 or inner > outer:
        quad.fail(GLU_INVALID_VALUE)
        return
    sweep = 360.0 if abs(sweep) > 360 else sweep
    if sweep < 0:
        start, sweep = start + sweep, -sweep
    _draw(_disk, quad, slices * loops, float(inner), float(outer), slices, loops, float(start), float(sweep))


def _disk(quad: Manner, inner: float, outer: float, slices: int, loops: int, start: float, sweep: float) -> Calls:
    calls = Calls()
    is_whole = sweep == 360
    delta, offset = F32(outer - inner), _f(start / 180.0 * math.pi)
    sine, cosine = _tables(offset + (math.pi * sweep / 180.0) * i / slices for i in range(slices + 1))
    if is_whole:
        sine[slices], cosine[slices] = sine[0], cosine[0]
    if quad.normals != GLU_NONE:
        calls.normal(0.0, 0.0, 1.0 if quad.orientation == GLU_OUTSIDE else -1.0)

    def vertex(i: int, j: int) -> None:
        radius = _f(outer - float(delta * F32(_ratio(j, loops))))
        if quad.has_texture:
            scale = _f(radius / outer / 2)
            calls.coordinates(_f(_product(scale, sine[i]) + 0.5), _f(_product(scale, cosine[i]) + 0.5))
        calls.vertex(_product(radius, sine[i]), _product(radius, cosine[i]), 0.0)

    def strip(places: Iterable[tuple[int, int]]) -> None:
        calls.begin(gl.GL_LINE_STRIP)
        for i, j in places:
            vertex(i, j)
        calls.end()

    if quad.style == GLU_FILL:
        rings = loops
        if inner == 0:
            rings = loops - 1
            calls.begin(gl.GL_TRIANGLE_FAN)
            if quad.has_texture:
                calls.coordinates(0.5, 0.5)
            calls.vertex(0.0, 0.0, 0.0)
            for i in _both_ways(quad, slices):
                vertex(i, loops - 1)
            calls.end()
        for j in range(rings):
            calls.begin(gl.GL_QUAD_STRIP)
            for i in range(slices + 1):
                for each in (j, j + 1) if quad.orientation == GLU_OUTSIDE else (j + 1, j):
                    vertex(i, each)
            calls.end()
        return calls
    spokes = range(slices if is_whole else slices + 1)
    if quad.style == GLU_POINT:
        calls.begin(gl.GL_POINTS)
        for i in spokes:
            for j in range(loops + 1):
                vertex(i, j)
        calls.end()
    elif quad.style == GLU_LINE:
        for j in range(1 if inner == outer else loops + 1):
            strip((i, j) for i in range(slices + 1))
        for i in () if inner == outer else spokes:
            strip((i, j) for j in range(loops + 1))
    else:
        for i in () if is_whole else (0, slices):
            strip((i, j) for j in range(loops + 1))
        for j in (0,) if inner == outer else (0, loops):
            strip((i, j) for i in range(slices + 1))
    return calls


__all__ = [*spelled_like_gl(globals()), "GLUquadric"]
