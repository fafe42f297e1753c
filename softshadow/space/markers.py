"""Small shapes that mark lights, the eye and crossings."""

from __future__ import annotations

import numpy as np

from softshadow.scene import Light, Rectangle, Segment, Sphere

AROUND = 24  # corners of a disc's outline
# an octahedron round 0, counter-clockwise from outside
OCTAHEDRON = np.array(
    [
        [[x, 0, 0], [0, y, 0], [0, 0, z]][:: 1 if x * y * z > 0 else -1]
        for x in (-1, 1)
        for y in (-1, 1)
        for z in (-1, 1)
    ],
    float,
)


def marker(place: np.ndarray, radius: float) -> np.ndarray:
    """Return a small ball round a point, (32, 3, 3): an octahedron divided once."""
    a, b, c = OCTAHEDRON.transpose(1, 0, 2)
    ab, bc, ca = (_unit(p + q) for p, q in ((a, b), (b, c), (c, a)))
    quarters = [np.stack(corners, axis=1) for corners in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    ball: np.ndarray = place + radius * np.concatenate(quarters)
    return ball


def _unit(vectors: np.ndarray) -> np.ndarray:
    unit: np.ndarray = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return unit


def shape_of_light(light: Light) -> np.ndarray:
    """Return the surface of an area light as triangles (T, 3, 3); of a segment a very thin one."""
    shape, center = light.shape, light.position[:3]
    assert shape is not None
    if isinstance(shape, Sphere):
        return marker(center, shape.bounding_radius)
    if isinstance(shape, Segment):
        a, b = light.corners
        across = np.cross(b - a, np.eye(3)[np.abs(b - a).argmin()])
        across *= 0.01 * np.linalg.norm(b - a) / np.linalg.norm(across)
        corners = np.array([a - across, a + across, b + across, b - across])
    elif isinstance(shape, Rectangle):
        u, v = shape.half_axes
        corners = center + np.array([-u - v, u - v, u + v, -u + v])
    else:
        angles = 2 * np.pi * np.arange(AROUND) / AROUND
        u, v = shape.half_axes
        corners = center + np.cos(angles)[:, None] * u + np.sin(angles)[:, None] * v
    numbers = np.arange(1, len(corners) - 1)
    return corners[np.stack([np.zeros_like(numbers), numbers, numbers + 1], axis=1)]
