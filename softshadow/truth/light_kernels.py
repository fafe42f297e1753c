"""The loop over points that look at an area light: kernels that cut faces out of it, or test samples of it.

Both look for faces in the tree of the casters. The cut looks in the shaft from the point to the light. Samples are
tested together while few faces are in the shaft, and else have a ray each, which begins its search near the face that
hid the sample before.
"""

import numpy as np

from softshadow.jit import allocating_kernel, kernel
from softshadow.truth.light_view import (
    FLAT,
    box_meets_ray,
    box_meets_shaft,
    hidden_by_own_face,
    hidden_part,
    place,
    seen_light,
    set_shaft,
)
from softshadow.truth.ray_cast import NONE, in_one_plane
from softshadow.truth.visible_pieces import CORNERS, cut_away, start_pieces, visible_share

TOGETHER = 24  # faces that are tested against all samples; with more of them, rays take less time
LEVELS = 5  # from a face that hides a sample up to the node where the search for the next sample begins
HUGE = 1e300  # in place of an infinite slope


@allocating_kernel
def measure_light(
    points, kind, center, half_u, half_v, own, viewer, corners, boxes, flatness, closed, sets, first, most_pieces,
    most_faces, visible, exact,
):  # fmt: skip
    """Write how much of the light each point sees, and whether this is exact."""
    view, shaft = np.empty((3, 3)), (np.empty(4), np.empty((4, 3)), np.empty((2, 3)))
    functions, work = np.empty((4, 4)), np.empty((3, CORNERS, 2))
    pieces, sizes = np.empty((max(most_pieces, 1), CORNERS, 2)), np.empty(max(most_pieces, 1), np.int64)
    hidden = np.empty(sets.shape[1], np.bool_)
    stack = np.empty(128, np.int64)
    for number in range(len(points)):
        visible[number], exact[number] = 1.0, True
        point = points[number]
        if not seen_light(point, kind, center, half_u, half_v, view):
            continue
        n_pieces = -1
        if most_pieces > 0:
            n_pieces = _cut_faces(
                point, view, shaft, own[number], viewer, corners, boxes, flatness, closed, functions, work, pieces,
                sizes, stack, most_faces,
            )  # fmt: skip
        if n_pieces >= 0:
            visible[number] = visible_share(pieces, sizes, n_pieces, kind != FLAT)
        else:
            visible[number] = _sample_faces(
                point, view, shaft, own[number], viewer, corners, boxes, flatness, closed, functions,
                sets[(first + number) % len(sets)], hidden, stack,
            )  # fmt: skip
            exact[number] = False


@kernel
def _next_face(top, point, view, shaft, own, corners, boxes, flatness, closed, functions, stack):
    """Return the new top of the stack of nodes after the next face that hides something, -1 if there is none."""
    part, planes, bounds = shaft
    first_leaf = len(boxes) // 2
    while top > 0:
        top -= 1
        node = stack[top]
        if not box_meets_shaft(boxes[node], point, planes, bounds):
            continue
        if node < first_leaf:
            stack[top] = 2 * node
            stack[top + 1] = 2 * node + 1
            top += 2
            continue
        face = node - first_leaf
        if not hidden_part(corners[face], point, view, part, closed[face], functions):
            continue
        if own >= 0 and (face == own or in_one_plane(corners[own], corners[face], flatness[own])):
            continue
        return top
    return NONE


@kernel
def _cut_faces(
    point, view, shaft, own, viewer, corners, boxes, flatness, closed, functions, work, pieces, sizes, stack,
    most_faces,
):  # fmt: skip
    """Cut all faces between the point and the light out of the light; return the number of pieces, -1 if too many."""
    part, planes, bounds = shaft
    part[0], part[1], part[2], part[3] = 0.0, 0.0, 1.0, 1.0
    set_shaft(view, part, planes, bounds)
    n_pieces = start_pieces(pieces, sizes)
    if own >= 0 and hidden_by_own_face(corners[own], viewer, point, view, closed[own], functions):
        n_pieces = cut_away(pieces, sizes, n_pieces, functions, 1, work)
    stack[0] = 1
    top = 1
    while n_pieces > 0:
        top = _next_face(top, point, view, shaft, own, corners, boxes, flatness, closed, functions, stack)
        if top == NONE:
            break
        if most_faces == 0:
            return -1
        most_faces -= 1
        n_pieces = cut_away(pieces, sizes, n_pieces, functions, 4, work)
    return n_pieces


@kernel
def _sample_faces(point, view, shaft, own, viewer, corners, boxes, flatness, closed, functions, samples, hidden, stack):
    """Return the share of samples that no face between the point and the light hides.

    Each face is tested against all samples if few faces are before the light, else each sample has a ray of its own.
    """
    part, planes, bounds = shaft
    part[0], part[1], part[2], part[3] = 0.0, 0.0, 1.0, 1.0
    set_shaft(view, part, planes, bounds)
    n_samples = n_visible = len(samples)
    hidden[:] = False
    if own >= 0 and hidden_by_own_face(corners[own], viewer, point, view, closed[own], functions):
        functions[1:, 0], functions[1:, 1:] = 1.0, 0.0
        n_visible = _hide(samples, functions, hidden)
    stack[0] = 1
    top = 1
    for _ in range(TOGETHER):
        if n_visible > 0:
            top = _next_face(top, point, view, shaft, own, corners, boxes, flatness, closed, functions, stack)
            if top == NONE:
                return n_visible / n_samples
            n_visible = _hide(samples, functions, hidden)
    near = 1
    for sample in range(n_samples):
        if not hidden[sample]:
            face = _hiding_face(
                point, view, part, samples[sample], own, corners, boxes, flatness, closed, functions, stack, near
            )
            if face != NONE:
                hidden[sample] = True
                n_visible -= 1
                near = max((face + len(boxes) // 2) >> LEVELS, 1)
    return n_visible / n_samples


@kernel
def _hiding_face(point, view, part, sample, own, corners, boxes, flatness, closed, functions, stack, near):
    """Return a face between the point and one sample, -1 for none; the faces below the node `near` are tried first."""
    part[0], part[1], part[2], part[3] = sample[0], sample[1], 0.0, 0.0
    x, y, z = place(view, sample[0], sample[1])
    inverse = (1 / x if x != 0 else HUGE, 1 / y if y != 0 else HUGE, 1 / z if z != 0 else HUGE)
    first_leaf = len(boxes) // 2
    stack[0], stack[1] = 1, near
    top = 2
    while top > 0:
        top -= 1
        node = stack[top]
        if not box_meets_ray(boxes[node], point, inverse):
            continue
        if node < first_leaf:
            stack[top] = 2 * node
            stack[top + 1] = 2 * node + 1
            top += 2
            continue
        face = node - first_leaf
        if (
            hidden_part(corners[face], point, view, part, closed[face], functions)
            and _is_in_all(sample, functions)
            and not (own >= 0 and (face == own or in_one_plane(corners[own], corners[face], flatness[own])))
        ):
            return face
    return NONE


@kernel
def _is_in_all(sample, functions):
    """Return whether all four functions are positive at a sample."""
    for number in range(4):
        k, ka, kb, above = functions[number]
        if not k + ka * sample[0] + kb * sample[1] > above:
            return False
    return True


@kernel
def _hide(samples, functions, hidden):
    """Mark the samples where all four functions are positive as hidden; return how many are not hidden."""
    k0, a0, b0, above0 = functions[0, 0], functions[0, 1], functions[0, 2], functions[0, 3]
    k1, a1, b1, above1 = functions[1, 0], functions[1, 1], functions[1, 2], functions[1, 3]
    k2, a2, b2, above2 = functions[2, 0], functions[2, 1], functions[2, 2], functions[2, 3]
    k3, a3, b3, above3 = functions[3, 0], functions[3, 1], functions[3, 2], functions[3, 3]
    n_visible = 0
    for sample in range(len(samples)):
        a, b = samples[sample, 0], samples[sample, 1]
        is_in = (
            (k0 + a0 * a + b0 * b > above0)
            & (k1 + a1 * a + b1 * b > above1)
            & (k2 + a2 * a + b2 * b > above2)
            & (k3 + a3 * a + b3 * b > above3)
        )
        hidden[sample] |= is_in
        n_visible += not hidden[sample]
    return n_visible
