"""Cube map coordinates: the face that a direction hits, the position on it, and its derivatives.

A direction (s, t, r) hits the face of its largest component; the position on the face is a pair of 2-D coordinates.
Neighbouring pixels may hit different faces, so differences are taken between directions and projected onto the pixel's
own face.

References: GL 2.1 sec. 3.8.6 (table 3.21); lp_build_cube_lookup of Mesa 22.3.
"""

from __future__ import annotations

import numpy as np

from softshadow.jit import kernel

ZERO, ONE, HALF = np.float32(0.0), np.float32(1.0), np.float32(0.5)
X, Y, Z = 0, 1, 2


@kernel
def major_axis(s, t, r):
    """Return the axis of the largest component; among equal ones z wins over y, and y over x."""
    larger = abs(s) if abs(s) > abs(t) else abs(t)
    if abs(r) >= larger:
        return Z
    return X if abs(s) > abs(t) else Y


@kernel
def component(axis, s, t, r):
    """Return the component of (s, t, r) along an axis."""
    return s if axis == X else (t if axis == Y else r)


@kernel
def across(axis, negative, s, t, r):
    """Return the other two components, in the orientation of the face's axes."""
    if axis == X:
        return r if negative else -r, -t
    if axis == Y:
        return s, -r if negative else r
    return -s if negative else s, -t


def on_faces(coordinates: np.ndarray, by_reciprocal: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return the face (N,) of each direction, 0 to 5 from +x to -z, and the position on it (N, 3): s, t, reference.

    coordinates (N, 3) or (N, 4): s, t, r and the reference. With `by_reciprocal` the direction is multiplied by the
    reciprocal of its largest component instead of divided by it: llvmpipe does so if it computes a level of detail.
    """
    faces, places = np.empty(len(coordinates), np.int8), np.empty((len(coordinates), 3), coordinates.dtype)
    with np.errstate(all="ignore"):
        project_onto_faces(coordinates, by_reciprocal, faces, places)
    return faces, places


def squared_texels_per_pixel(coordinates: np.ndarray, size: int) -> np.ndarray:
    """Return each pixel's larger squared step (N,), in texels, to the next column or row of its 2x2 block."""
    squared = np.empty(len(coordinates), coordinates.dtype)
    with np.errstate(all="ignore"):
        write_squared_steps(coordinates, coordinates.dtype.type(size), squared)
    return squared


@kernel
def project_onto_faces(coordinates, by_reciprocal, faces, places):
    """Write faces (N,) and positions (N, 3) of directions, see `on_faces`."""
    for n in range(len(coordinates)):
        s, t, r = coordinates[n, 0], coordinates[n, 1], coordinates[n, 2]
        axis = major_axis(s, t, r)
        major = component(axis, s, t, r)
        negative = np.signbit(major)
        if by_reciprocal:
            scale = abs(HALF * (ONE / major))
        else:
            scale = HALF / abs(major) if abs(major) > ZERO else ZERO
        a, b = across(axis, negative, s, t, r)
        faces[n] = 2 * axis + (1 if negative else 0)
        places[n, 0] = a * scale + HALF
        places[n, 1] = b * scale + HALF
        places[n, 2] = coordinates[n, 3] if coordinates.shape[1] > 3 else ZERO


@kernel
def squared_step(axis, negative, direction, left, right, size):
    """Return the squared length, in texels, of the step from `left` to `right` on the face of `direction`."""
    s, t, r = direction
    reciprocal = ONE / component(axis, s, t, r)
    ds, dt, dr = right[0] - left[0], right[1] - left[1], right[2] - left[2]
    a, b = across(axis, negative, s, t, r)
    da, db = across(axis, negative, ds, dt, dr)
    major = component(axis, ds, dt, dr) * reciprocal
    u = size * ((da - major * a) * (HALF * reciprocal))
    v = size * ((db - major * b) * (HALF * reciprocal))
    return u * u + v * v


@kernel
def write_squared_steps(coordinates, size, out):
    """Write each pixel's larger squared step, to the next column or the next row, to `out` (N,)."""
    for n in range(len(coordinates)):
        direction = coordinates[n, 0], coordinates[n, 1], coordinates[n, 2]
        axis = major_axis(direction[0], direction[1], direction[2])
        negative = np.signbit(component(axis, direction[0], direction[1], direction[2]))
        row, column = n - n % 2, n - n % 4 + n % 2
        x = squared_step(axis, negative, direction, coordinates[row], coordinates[row + 1], size)
        y = squared_step(axis, negative, direction, coordinates[column], coordinates[column + 2], size)
        larger = x if x > y else y
        out[n] = larger if np.isfinite(larger) else ZERO
