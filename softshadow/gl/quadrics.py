"""GLU's quadrics: spheres, cylinders and disks, drawn in immediate mode.

The shapes are those of `quadric_shapes`. They are kept, because programs draw the same ones again and again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from softshadow.context.arrays import Cache
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
from softshadow.gl.quadric_shapes import Manner, cylinder, disk, slant, sphere
from softshadow.gl.shape_calls import Calls

MOST = 239  # slices and stacks
KEPT_SHAPES, KEPT_BYTES = 4096, 150 << 20  # of the latest shapes


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


def _draw(shape: Callable[..., Calls], quad: GLUquadric, *numbers: float) -> None:
    """Carry out the calls of a shape."""
    manner = quad.manner()
    key = shape, manner, *numbers
    calls: Calls | None = _kept.use(key)
    if calls is None:
        calls = shape(manner, *numbers)
        _kept.put(key, calls, calls.bytes)
    calls.make()


_kept = Cache(KEPT_BYTES, KEPT_SHAPES)


# -- drawing -----------------------------------------------------------------------------------------------------------
def gluSphere(quad: GLUquadric, radius: float, slices: int, stacks: int) -> None:
    """Draw a sphere around the origin, with its poles on the z axis."""
    slices, stacks = min(int(slices), MOST), min(int(stacks), MOST)
    if slices < 2 or stacks < 1 or radius < 0:
        quad.fail(GLU_INVALID_VALUE)
        return
    _draw(sphere, quad, float(radius), slices, stacks)


def gluCylinder(quad: GLUquadric, base: float, top: float, height: float, slices: int, stacks: int) -> None:
    """Draw a cylinder or cone around the z axis, from z = 0 to z = height, without its ends."""
    slices, stacks = min(int(slices), MOST), int(stacks)
    if slices < 2 or stacks < 1 or base < 0 or top < 0 or height < 0:
        quad.fail(GLU_INVALID_VALUE)
        return
    if slant(base, top, height) == 0:
        quad.fail(GLU_INVALID_VALUE)
        return
    _draw(cylinder, quad, float(base), float(top), float(height), slices, stacks)


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
    _draw(disk, quad, float(inner), float(outer), slices, loops, float(start), float(sweep))


__all__ = [*spelled_like_gl(globals()), "GLUquadric"]
