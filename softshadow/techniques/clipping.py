"""Clip triangles against planes, in double precision, before anything is projected.

Fixed-function OpenGL has glClipPlane for this. Here the cut polygons are data, which a reader and a test can look at.
"""

import numpy as np


def clip_triangles(triangles: np.ndarray, plane: np.ndarray) -> np.ndarray:
    """Return the parts of the triangles on the positive side of a plane, see `clip_with_sources`."""
    return clip_with_sources(triangles, plane)[0]


def clip_with_sources(triangles: np.ndarray, plane: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the parts of the triangles on the positive side of a plane, as triangles of the same orientation.

    Parameters
    ----------
    triangles : (T, 3, 3) float64
    plane : (4,)                 a, b, c, d: its positive side is a·x + b·y + c·z + d ≥ 0

    Returns
    -------
    (U, 3, 3) float64            U ≤ 2·T; two triangles with a common edge have the same cut point on it, bit for bit
    (U,) int                     which triangle each is a part of

    References
    ----------
    Sutherland & Hodgman 1974, "Reentrant polygon clipping".
    """
    distance = triangles @ plane[:3] + plane[3]
    inside = distance >= 0
    corners_inside = inside.sum(axis=1)
    pieces, sources = [triangles[corners_inside == 3]], [np.flatnonzero(corners_inside == 3)]
    for number in (1, 2):
        cut = corners_inside == number
        if not cut.any():
            continue
        # rotate the corners so that the single one, inside or outside, comes first
        single = np.argmax(inside[cut] == (number == 1), axis=1)
        order = (single[:, None] + np.arange(3)) % 3
        corner = np.take_along_axis(triangles[cut], order[:, :, None], axis=1)
        height = np.take_along_axis(distance[cut], order, axis=1)
        first, second, third = corner[:, 0], corner[:, 1], corner[:, 2]
        if number == 1:
            to_second = _crossing(first, height[:, 0], second, height[:, 1])
            to_third = _crossing(first, height[:, 0], third, height[:, 2])
            pieces.append(np.stack([first, to_second, to_third], axis=1))
            sources.append(np.flatnonzero(cut))
        else:
            from_second = _crossing(second, height[:, 1], first, height[:, 0])
            from_third = _crossing(third, height[:, 2], first, height[:, 0])
            pieces.append(np.stack([from_second, second, third], axis=1))
            pieces.append(np.stack([from_second, third, from_third], axis=1))
            sources += [np.flatnonzero(cut)] * 2
    return np.concatenate(pieces), np.concatenate(sources)


def _crossing(inner: np.ndarray, above: np.ndarray, outer: np.ndarray, below: np.ndarray) -> np.ndarray:
    """Return where edges cross the plane, computed from the inner end so that both triangles of an edge agree."""
    return inner + (above / (above - below))[:, None] * (outer - inner)


def clip_to_planes(triangles: np.ndarray, planes: np.ndarray) -> np.ndarray:
    """Return the parts of the triangles on the positive side of every plane (K, 4)."""
    return clip_to_planes_with_sources(triangles, planes)[0]


def clip_to_planes_with_sources(triangles: np.ndarray, planes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the parts (U, 3, 3) on the positive side of every plane (K, 4), and the triangle of each (U,)."""
    sources = np.arange(len(triangles))
    for plane in planes:
        triangles, of = clip_with_sources(triangles, plane)
        sources = sources[of]
    return triangles, sources


def clip_segments(segments: np.ndarray, plane: np.ndarray) -> np.ndarray:
    """Return the parts of directed segments (S, 2, 3) on the positive side of a plane (4,)."""
    distance = segments @ plane[:3] + plane[3]
    inside = distance >= 0
    start, end = segments[:, 0], segments[:, 1]
    leaves, enters = inside[:, 0] & ~inside[:, 1], ~inside[:, 0] & inside[:, 1]
    clipped = segments.copy()
    clipped[leaves, 1] = _crossing(start[leaves], distance[leaves, 0], end[leaves], distance[leaves, 1])
    clipped[enters, 0] = _crossing(end[enters], distance[enters, 1], start[enters], distance[enters, 0])
    return clipped[inside.any(axis=1)]


def cuts(triangles: np.ndarray, plane: np.ndarray) -> np.ndarray:
    """Return the segments (S, 2, 3) in which a plane cuts triangles (T, 3, 3).

    They close the outlines of the clipped triangles: each runs from the point where the outline leaves the positive
    side to the point where it returns.
    """
    distance = triangles @ plane[:3] + plane[3]
    inside = distance >= 0
    cut = np.flatnonzero(inside.any(axis=1) & ~inside.all(axis=1))
    following = np.roll(inside[cut], -1, axis=1)
    leaves, returns = np.argmax(inside[cut] & ~following, axis=1), np.argmax(~inside[cut] & following, axis=1)

    def crossing(inner: np.ndarray, outer: np.ndarray) -> np.ndarray:
        return _crossing(triangles[cut, inner], distance[cut, inner], triangles[cut, outer], distance[cut, outer])

    return np.stack([crossing(leaves, (leaves + 1) % 3), crossing((returns + 1) % 3, returns)], axis=1)


def pyramid_between(light: np.ndarray, polygon: np.ndarray) -> np.ndarray:
    """Return the planes that bound all segments from a light to the points of a convex polygon.

    Parameters
    ----------
    light : (4,)                 homogeneous; w = 0 gives the prism of the rays towards the light
    polygon : (N, 3)             corners in order, the first three not in line

    Returns
    -------
    (N + 1, 4) float64           the sides and the polygon's own plane, positive inside
    """
    center = polygon.mean(axis=0)
    position, w = light[:3], light[3]
    planes = []
    # of the planes through the edges and the light; the direction to it is position - w·a, for w = 0 as well
    normals = np.cross(np.roll(polygon, -1, axis=0) - polygon, position - w * polygon)
    for a, normal in zip(polygon, normals, strict=True):
        normal *= 1.0 if normal @ (center - a) >= 0 else -1.0
        planes.append([*normal, -normal @ a])
    normal = np.cross(polygon[1] - polygon[0], polygon[2] - polygon[1])
    normal *= 1.0 if normal @ (position - w * center) >= 0 else -1.0
    planes.append([*normal, -normal @ center])
    return np.array(planes)
