"""How a point sees an area light and the faces in front of it: kernels on the light's own coordinates (a, b).

The light is every ``center + a u + b v`` with a and b from -1 to 1, or in the unit disc around 0. Seen from the point,
the direction to a place of the light is linear in (a, b), and so is the function of an edge that tells on which side of
it the ray passes. A face therefore hides the part of the light where four linear functions are positive: one per edge,
and one for the plane, which must be crossed before the light is reached. Nothing is projected or divided, so faces may
lie anywhere, also beyond the light or behind the point. Two faces with a common edge have exactly opposite functions
for it.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.truth.ray_cast import cross, difference, dot, is_turned_inside

FLAT, ROUND, BALL = range(3)  # parallelogram (also without a height, a segment), disc, sphere
# a place on an edge counts as inside if its function is greater than this: 0, or the largest number below
ABOVE_0, FROM_0 = 0.0, -5e-324


@kernel
def seen_light(point, kind, center, half_u, half_v, view):
    """Write centre, u and v (3, 3) of the light relative to a point; return False for a point inside a ball.

    A ball is seen as the disc of its outline, perpendicular to the ray to its centre.
    """
    for axis in range(3):
        view[0, axis] = center[axis] - point[axis]
        view[1, axis] = half_u[axis]
        view[2, axis] = half_v[axis]
    if kind != BALL:
        return True
    radius = half_u[0]
    square = dot(view[0], view[0])
    if square <= radius * radius:
        return False
    outline = radius * np.sqrt(square / (square - radius * radius))
    smallest = 0
    for axis in range(1, 3):
        if abs(view[0, axis]) < abs(view[0, smallest]):
            smallest = axis
    across = (
        1.0 if smallest == 0 else 0.0,
        1.0 if smallest == 1 else 0.0,
        1.0 if smallest == 2 else 0.0,
    )
    u = cross(across, view[0])
    v = cross(view[0], u)
    scale_u, scale_v = outline / np.sqrt(dot(u, u)), outline / np.sqrt(dot(v, v))
    for axis in range(3):
        view[1, axis] = u[axis] * scale_u
        view[2, axis] = v[axis] * scale_v
    return True


@kernel
def set_shaft(view, part, planes, bounds):
    """Write the planes (4, 3) and the bounding box (2, 3) of the pyramid from the point to a part of the light.

    The point is 0; a place is outside if its product with a plane's normal is negative. `part` is (middle a, middle b,
    half width in a, half width in b).
    """
    c0 = place(view, part[0] - part[2], part[1] - part[3])
    c1 = place(view, part[0] + part[2], part[1] - part[3])
    c2 = place(view, part[0] + part[2], part[1] + part[3])
    c3 = place(view, part[0] - part[2], part[1] + part[3])
    middle = place(view, part[0], part[1])
    for axis in range(3):
        bounds[0, axis] = min(0.0, c0[axis], c1[axis], c2[axis], c3[axis])
        bounds[1, axis] = max(0.0, c0[axis], c1[axis], c2[axis], c3[axis])
    _set_plane(c0, c1, middle, planes[0])
    _set_plane(c1, c2, middle, planes[1])
    _set_plane(c2, c3, middle, planes[2])
    _set_plane(c3, c0, middle, planes[3])


@kernel
def _set_plane(a, b, inside, plane):
    """Write the normal of the plane through 0, a and b, turned towards `inside`."""
    normal = cross(a, b)
    sign = 1.0 if dot(normal, inside) >= 0 else -1.0
    for axis in range(3):
        plane[axis] = sign * normal[axis]


@kernel
def place(view, a, b):
    """Return a place of the light, relative to the point."""
    return (
        view[0, 0] + a * view[1, 0] + b * view[2, 0],
        view[0, 1] + a * view[1, 1] + b * view[2, 1],
        view[0, 2] + a * view[1, 2] + b * view[2, 2],
    )


@kernel
def box_meets_shaft(box, point, planes, bounds):
    """Return False if a box surely lies outside the shaft of a point."""
    for axis in range(3):
        if box[1, axis] - point[axis] < bounds[0, axis] or box[0, axis] - point[axis] > bounds[1, axis]:
            return False  # an empty box, too: its low corner is at infinity
    for side in range(4):
        farthest = 0.0
        for axis in range(3):
            low = planes[side, axis] * (box[0, axis] - point[axis])
            high = planes[side, axis] * (box[1, axis] - point[axis])
            farthest += max(low, high)
        if farthest < 0:
            return False
    return True


@kernel
def box_meets_ray(box, point, inverse):
    """Return False if a box surely lies off the segment from a point along a direction.

    `inverse` is 1 / direction, and huge instead of infinite, so that a product with 0 is 0.
    """
    if box[0, 0] > box[1, 0]:
        return False  # empty
    near, far = 0.0, 1.0
    for axis in range(3):
        first = (box[0, axis] - point[axis]) * inverse[axis]
        second = (box[1, axis] - point[axis]) * inverse[axis]
        near = max(near, min(first, second))
        far = min(far, max(first, second))
    return near <= far


@kernel
def hidden_part(corners, point, view, part, closed, functions):
    """Write the linear functions (4, 4) of what a face hides of the light; return whether it may meet a part of it.

    A row is (k, ka, kb, above): the place (a, b) is on the hidden side where ``k + ka a + kb b > above``. The face of a
    closed body hides the light only if it faces the light.
    """
    a = difference(corners[0], point)
    b = difference(corners[1], point)
    c = difference(corners[2], point)
    normal = cross(difference(b, a), difference(c, a))
    height = dot(normal, a)
    if height == 0 or (closed and height < 0):
        return False
    sign = 1.0 if height > 0 else -1.0
    if not (
        _set_edge(a, b, sign, view, part, functions[0])
        and _set_edge(b, c, sign, view, part, functions[1])
        and _set_edge(c, a, sign, view, part, functions[2])
    ):
        return False
    _set_function(normal, sign, view, functions[3])
    functions[3, 0] -= sign * height  # the face is nearer than the light
    functions[3, 3] = ABOVE_0
    return _largest(functions[3], part) > 0


@kernel
def _set_edge(a, b, sign, view, part, function):
    """Write the function of an edge; return whether it is positive somewhere on the part.

    A ray through the edge itself passes on the side that `ray_cast` gives it to.
    """
    normal = cross(a, b)
    _set_function(normal, sign, view, function)
    function[3] = FROM_0 if (sign > 0) == is_turned_inside(normal, a, b) else ABOVE_0
    return _largest(function, part) >= 0


@kernel
def _set_function(normal, sign, view, function):
    """Write the product of a normal with the directions to the light, times a sign."""
    for term in range(3):
        function[term] = sign * (normal[0] * view[term, 0] + normal[1] * view[term, 1] + normal[2] * view[term, 2])


@kernel
def _largest(function, part):
    """Return the largest value of a linear function on a part of the light."""
    middle = function[0] + function[1] * part[0] + function[2] * part[1]
    return middle + abs(function[1]) * part[2] + abs(function[2]) * part[3]


@kernel
def hidden_by_own_face(corners, viewer, point, view, closed, functions):
    """Write the function (first row) of the part of the light that a point's own face hides; return whether it does.

    It does where the light is on the other side of the face than the viewer.
    """
    normal = cross(difference(corners[1], corners[0]), difference(corners[2], corners[0]))
    to_viewer = dot(normal, difference(viewer, point))
    if not (to_viewer < 0 or (to_viewer > 0 and not closed)):  # no viewer is NaN
        return False
    _set_function(normal, -1.0 if to_viewer > 0 else 1.0, view, functions[0])
    functions[0, 3] = ABOVE_0
    return functions[0, 0] + abs(functions[0, 1]) + abs(functions[0, 2]) > 0
