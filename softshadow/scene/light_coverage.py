"""How much of an area light each silhouette edge takes or gives back, seen from a point: exact areas, in float64.

A caster's silhouette is a closed loop. Seen from a point, it covers a part of the light, and this part is a sum over
the edges: with the light's centre c, an edge from p to q covers the sector of the light between the directions of p and
q, less what lies beyond the edge. All sectors together are the whole light as often as the loop goes around c, which is
the hard count H of the shadow volumes. So

    covered = H + sum over the edges of ± (area beyond the edge in its sector) / area of the light

with - where c is on the caster's side of the edge, and the part beyond it is given back. An edge outside the light
contributes nothing. Whether c is on the caster's side has to be decided for H and for the sign by the same expression:
`is_inside`.

A rectangle or a disc is seen on its own plane. A sphere is seen on the plane through its centre perpendicular to the
direction of the point, as a disc that the tangents bound. A segment has no area: an edge takes or gives back the length
from where its image crosses the segment to the segment's end, and all lengths together are the length that is covered.

References
----------
Assarsson & Akenine-Möller 2003, "A geometry-based soft shadow volume algorithm using graphics hardware" (the visibility
of an edge, there from a table).
"""

from typing import NamedTuple

import numpy as np

from softshadow.scene.light_shapes import Disc, LightShape, Rectangle, Segment, Sphere
from softshadow.scene.lights import Light


class LightView(NamedTuple):
    """A light as a point sees it: where u and v are from -1 to 1 the square that contains its outline.

    A segment is where u is from -1 to 1 and v is 0.

    Attributes
    ----------
    u, v : (3,)                  a place x on the light, relative to its centre, has the coordinates u x and v x
    normal : (3,)                unit vector perpendicular to the light's plane, on the point's side
    height : float               distance of the point from this plane
    """

    u: np.ndarray
    v: np.ndarray
    normal: np.ndarray
    height: float


def edge_shares(edges: np.ndarray, light: Light, point: np.ndarray) -> np.ndarray:
    """Return the share of the light that each edge takes (positive) or gives back (negative), (E,) float64.

    A light without a shape has no area: every share is 0. So is it for points within the light or its plane.

    Parameters
    ----------
    edges : (E, 2, 3)            world space, directed as in `silhouette_edges`
    point : (3,)                 world space
    """
    relative = np.asarray(edges, np.float64) - light.position[:3]
    place = np.asarray(point, np.float64) - light.position[:3]
    view = None if light.shape is None else light_view(light.shape, place)
    if view is None:
        return np.zeros(len(relative))
    images = project(relative, view, place)
    if isinstance(light.shape, Segment):
        beyond = lengths_beyond(images)
    else:
        beyond = areas_beyond(images, not isinstance(light.shape, Rectangle))
    return np.where(is_inside(relative, place), -beyond, beyond)


def is_inside(edges: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Return whether the point is on the caster's side of the planes of edges and centre, (E,) bool.

    Both arguments are relative to the light's centre.
    """
    inside: np.ndarray = np.cross(edges[:, 0], edges[:, 1]) @ point < 0
    return inside


def light_view(shape: LightShape, point: np.ndarray) -> LightView | None:
    """Return how a point relative to the light's centre sees it; None if it sees no area."""
    if isinstance(shape, Sphere):
        distance = float(np.linalg.norm(point))
        if distance <= shape.radius:
            return None
        normal = point / distance
        outline = shape.radius * distance / np.sqrt(distance**2 - shape.radius**2)
        u = np.cross(np.eye(3)[np.abs(normal).argmin()], normal)
        u /= np.linalg.norm(u)
        return LightView(u / outline, np.cross(normal, u) / outline, normal, distance)
    u, v, normal = flat_axes(shape)
    if isinstance(shape, Segment):
        sideways = point - (point @ u) / (u @ u) * u
        height = float(np.linalg.norm(sideways))
        if height == 0:
            return None
        normal = sideways / height
        return LightView(u, np.cross(normal, u), normal, height)
    height = float(normal @ point)
    if height == 0:
        return None
    return LightView(u, v, normal, height) if height > 0 else LightView(u, v, -normal, -height)


def flat_axes(shape: Rectangle | Disc | Segment) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return u, v and the unit normal of a light as in `LightView`; for a segment, v and the normal are 0."""
    half_u, half_v = shape.half_axes
    u = half_u / (half_u @ half_u)
    if isinstance(shape, Segment):
        return u, np.zeros(3), np.zeros(3)
    normal = np.cross(half_u, half_v)
    return u, half_v / (half_v @ half_v), normal / np.linalg.norm(normal)


def project(edges: np.ndarray, view: LightView, point: np.ndarray) -> np.ndarray:
    """Return the images of edges (E, 2, 3) on the light's plane, homogeneous: u, v, w, and the height above the plane.

    The image is what the point sees where it looks at the light: an end at the point's height is at infinity, w = 0. An
    end below the light's plane is beyond the light and hides nothing.
    """
    heights = edges @ view.normal
    images = [(edges @ axis) * view.height - (point @ axis) * heights for axis in (view.u, view.v)]
    return np.stack([*images, view.height - heights, heights], axis=-1)


def lengths_beyond(images: np.ndarray) -> np.ndarray:
    """Return the length of a segment beyond each edge in its sector, (E,) from 0 to 1/2, in lengths of the segment.

    Of two edges that meet on the segment, one crosses it there.

    Parameters
    ----------
    images : (E, 2, 4)           as `project` returns them
    """
    v = images[..., 1]
    with np.errstate(divide="ignore", invalid="ignore"):  # what does not cross is left out at the end
        # where an edge crosses v = 0 is the mean of its ends with these weights
        u, _, w, height = (np.abs(v[:, ::-1, None]) * images).sum(axis=1).T
        length = (1 - np.abs(u / w)) / 2
    crosses = ((v[:, 0] < 0) != (v[:, 1] < 0)) & (w > 0) & (height >= 0)
    return np.where(crosses, np.maximum(length, 0), 0)


def areas_beyond(images: np.ndarray, is_round: bool) -> np.ndarray:
    """Return the area beyond each edge in its sector, (E,) from 0 to 1/2, in units of the light's area.

    Parameters
    ----------
    images : (E, 2, 4)           as `project` returns them
    is_round : bool              whether the light is the disc in the square, or all of it
    """
    u, v, w, height = np.moveaxis(images, -1, 0)
    first, last = clip_parameters([height, w - u, w + u, w - v, w + v])
    with np.errstate(all="ignore"):  # what is outside is left out at the end
        points = [images[:, 0] + t[:, None] * (images[:, 1] - images[:, 0]) for t in (first, last)]
        p, q = (point[:, :2] / point[:, 2:3] for point in points)
        if is_round:
            p, q, first, last = clip_to_disc(p, q, first, last)
        doubled_triangle = np.abs(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0])
        if is_round:
            area = np.arctan2(doubled_triangle, (p * q).sum(axis=1)) - doubled_triangle
            share = area / (2 * np.pi)
        else:
            between = np.abs(square_angle(p) - square_angle(q))
            share = (np.minimum(between, 8 - between) - doubled_triangle) / 8
    return np.where((first < last) & np.isfinite(share), np.maximum(share, 0), 0)


def clip_parameters(functions: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Return from where to where, 0 to 1, each edge has no negative value of linear functions (E, 2) at its ends."""
    first, last = np.zeros(len(functions[0])), np.ones(len(functions[0]))
    for start, end in np.moveaxis(np.array(functions), 2, 1):
        with np.errstate(divide="ignore", invalid="ignore"):
            zero = start / (start - end)
        first = np.where(start < 0, np.where(end < 0, 2, np.maximum(first, zero)), first)
        last = np.where(end < 0, np.minimum(last, zero), last)
    return first, last


def clip_to_disc(
    p: np.ndarray, q: np.ndarray, first: np.ndarray, last: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return segments p q (E, 2) cut off at the unit circle, and first > last for those outside it."""
    along = q - p
    square = (along**2).sum(axis=1)
    middle = -(p * along).sum(axis=1) / square
    half = np.sqrt(middle**2 - ((p**2).sum(axis=1) - 1) / square)  # not a number outside the circle
    begin, end = np.maximum(middle - half, 0), np.minimum(middle + half, 1)
    is_in = (begin < end) & (first < last)
    return p + begin[:, None] * along, p + end[:, None] * along, np.where(is_in, 0, 2), np.ones(len(p))


def square_angle(points: np.ndarray) -> np.ndarray:
    """Return the length (E,), from -1 to 7, along the square's outline to the direction of points (E, 2).

    It takes the place of an angle: a sector of the square has half the length of its outline as its area.
    """
    x, y = points.T
    on_the_sides = np.where(x >= 0, 0.0, 4.0) + y / x
    on_the_ends = np.where(y >= 0, 2.0, 6.0) - x / y
    return np.where(np.abs(x) >= np.abs(y), on_the_sides, on_the_ends)
