"""How much of an area light each point sees: the reference that soft shadows are compared with.

Every point looks at the light through the tree of faces once. Faces in the shaft between the two are cut out of the
light as polygons, which gives the exact area. Where that takes too many polygons, as behind a fine mesh, samples of the
light are tested against the same faces instead, all samples of a point at once.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from softshadow.errors import nearest
from softshadow.jit import kernel
from softshadow.scene import Disc, Light, SceneObject, Sphere
from softshadow.scene.sample_patterns import square_to_disc, strata
from softshadow.truth.embree import visible_samples
from softshadow.truth.light_view import (
    BALL,
    FLAT,
    ROUND,
    box_meets_ray,
    box_meets_shaft,
    hidden_by_own_face,
    hidden_part,
    place,
    seen_light,
    set_shaft,
)
from softshadow.truth.ray_cast import NONE, _in_one_plane, _own_leaves, _points, casting_faces_between
from softshadow.truth.triangle_tree import build_tree
from softshadow.truth.visible_pieces import CORNERS, cut_away, start_pieces, visible_share

Method = Literal["auto", "exact", "rays", "embree"]
METHODS: tuple[Method, ...] = get_args(Method)
# pieces of the light, and faces before it: with more of them, samples take less time
MOST_PIECES, MOST_FACES = 24, 64
ALL_PIECES = 4096  # with method="exact"; some 1.6 MB per thread
# samples that are tested one by one, and faces per sample before a group of samples is halved
FEW, FACES_PER_SAMPLE = 16, 0.25
HALF_AND_MORE = 0.5 + 1e-12  # half a width, widened by more than rounding
HUGE = 1e300  # in place of an infinite slope
# sets of samples, so that neighbouring points have different ones; a prime, so that they do not repeat per column
SETS = 61
CHUNK = 4096  # points that one thread takes at once

UMBRA, PENUMBRA, LIT = range(3)


@dataclass(frozen=True, eq=False)
class LightVisibility:
    """How much of a light each of N points sees.

    Attributes
    ----------
    visible : (N,) float64           share of the light's area, 0 to 1, as it is seen from the point
    standard_error : (N,) float64    of `visible`; 0 where it is exact, else sqrt(V (1 - V) / n): that of n independent
                                     samples, and stratified ones are closer
    exact : (N,) bool                where `visible` is an area or a single ray, not a mean over samples
    method : str                     "exact", "rays", "exact and rays" or "embree"
    samples : int                    number of samples at points that are not exact
    """

    visible: np.ndarray
    standard_error: np.ndarray
    exact: np.ndarray
    method: str
    samples: int


def light_classes(visible: np.ndarray) -> np.ndarray:
    """Return uint8 of the same shape: UMBRA (0) where nothing is visible, LIT (2) where all, else PENUMBRA (1)."""
    classes = np.full(np.shape(visible), PENUMBRA, np.uint8)
    classes[visible == 0] = UMBRA
    classes[visible == 1] = LIT
    return classes


def one_after_the_other(work: Callable[[int], None], n_pieces: int) -> None:
    """Call ``work(0), ..., work(n_pieces - 1)``."""
    for number in range(n_pieces):
        work(number)


def light_visibility(
    points: np.ndarray,
    light: Light,
    casters: Sequence[SceneObject],
    *,
    exclude: tuple[np.ndarray, np.ndarray] | None = None,
    viewer: np.ndarray | None = None,
    samples: int = 256,
    method: Method = "auto",
    seed: int = 0,
    share: Callable[[Callable[[int], None], int], object] = one_after_the_other,
) -> LightVisibility:
    """Return how much of a light each point sees between the casters.

    The rules are those of `casting_faces_between`: faces of closed bodies that face the light, and all faces of open
    bodies. A light without a shape is visible or not. All of a light is visible from inside a sphere, and nothing from
    outside the cone of a spot light.

    Parameters
    ----------
    points : (N, 3) float64      world space
    exclude, viewer              as for `casting_faces_between`
    samples : int                of a point that is not exact: one in each of as many equal parts of the light. There
                                 are 61 random sets of them, and neighbouring points have different ones.
    method : str                 "auto": exact where the faces before the light leave few pieces of it, else rays;
                                 "exact"; "rays"; "embree": rays by Embree in float32, as a check by other code (all
                                 faces of closed bodies count, and a point at a hair's breadth from a face may err)
    seed : int                   of the samples; the same for the same points in the same order
    share : function             calls ``work(0)`` to ``work(n - 1)``; one that uses threads makes it faster

    Returns
    -------
    LightVisibility

    Raises
    ------
    ValueError                   wrong shapes, an unknown method, a number of samples below 1; "exact" where the light
                                 falls into more than 4096 pieces
    ModuleNotFoundError          "embree" without embreex
    """
    start = _points("points", points)
    if method not in METHODS:
        raise ValueError(f"method={method!r}: {nearest(str(method), METHODS)}")
    if isinstance(samples, bool) or not isinstance(samples, int | np.integer) or samples < 1:
        raise ValueError(f"samples={samples!r}: expected a whole number of at least 1")
    if light.shape is None or not casters:
        counts = casting_faces_between(start, light.position, casters, exclude=exclude, viewer=viewer)
        visible = ((counts == 0) & light.shines_on(start)).astype(np.float64)
        return _result(visible, np.ones(len(start), bool), samples)
    tree = build_tree(casters)
    own = _own_leaves(exclude, len(start), tree)
    sets = sample_sets(light, samples, seed)
    if method == "embree":
        visible = visible_samples(start, light, tree, own, viewer, sets)
        return _result(visible, np.zeros(len(start), bool), samples, "embree")
    visible, exact = np.empty(len(start)), np.empty(len(start), bool)
    frame = _frame(light)
    eye = np.full(3, np.nan) if viewer is None else np.asarray(viewer, np.float64)
    limits = {"auto": (MOST_PIECES, MOST_FACES), "exact": (ALL_PIECES, len(tree.corners)), "rays": (0, 0)}
    n_pieces, n_faces = limits[method]

    def measure(chunk: int) -> None:
        part = slice(chunk * CHUNK, (chunk + 1) * CHUNK)
        _measure(
            start[part], *frame, own[part], eye, tree.corners, tree.boxes, tree.flatness, tree.closed, sets,
            chunk * CHUNK, n_pieces, n_faces, visible[part], exact[part],
        )  # fmt: skip

    share(measure, -(-len(start) // CHUNK))
    if method == "exact" and not exact.all():
        raise ValueError(
            f'method="exact": {light.name} falls into more than {ALL_PIECES} visible pieces, seen from '
            f'{int((~exact).sum())} points; expected fewer faces, or method="auto"'
        )
    return _result(visible, exact, samples)


def _result(visible: np.ndarray, exact: np.ndarray, samples: int, method: str = "") -> LightVisibility:
    error = np.where(exact, 0, np.sqrt(visible * (1 - visible) / samples))
    if not method:
        method = "exact" if exact.all() else "exact and rays" if exact.any() else "rays"
    for array in (visible, error, exact):
        array.setflags(write=False)
    return LightVisibility(visible, error, exact, method, samples)


def sample_sets(light: Light, samples: int, seed: int) -> np.ndarray:
    """Return sets (SETS, samples, 2) of stratified places on a light, in its coordinates from -1 to 1."""
    assert light.shape is not None
    is_round = isinstance(light.shape, Disc | Sphere)
    inside = np.random.default_rng(seed).random((SETS, samples, 2))
    columns = round(np.sqrt(samples)) if len(light.shape.corners) > 2 else samples  # those of a segment lie in a row
    unit = [strata(samples, columns, each) for each in inside]
    return np.stack([in_halves(square_to_disc(each) if is_round else 2 * each - 1) for each in unit])


def in_halves(samples: np.ndarray) -> np.ndarray:
    """Return samples (n, 2) in an order in which both halves are compact, and both halves of each half, and so on."""
    if len(samples) <= FEW:
        return samples
    ordered = samples[np.argsort(samples[:, np.ptp(samples, axis=0).argmax()], kind="stable")]
    middle = len(samples) // 2
    return np.concatenate([in_halves(ordered[:middle]), in_halves(ordered[middle:])])


def _frame(light: Light) -> tuple[int, np.ndarray, np.ndarray, np.ndarray]:
    """Return the kind of a light, its centre, u and v; for a sphere u holds the radius."""
    shape = light.shape
    assert shape is not None
    center = np.array(light.position[:3])
    if isinstance(shape, Sphere):
        return BALL, center, np.full(3, shape.radius), np.zeros(3)
    u, v = shape.half_axes
    return ROUND if isinstance(shape, Disc) else FLAT, center, np.array(u), np.array(v)


@kernel
def _measure(
    points, kind, center, half_u, half_v, own, viewer, corners, boxes, flatness, closed, sets, first, most_pieces,
    most_faces, visible, exact,
):  # fmt: skip
    """Write how much of the light each point sees, and whether this is exact."""
    view, shaft = np.empty((3, 3)), (np.empty(4), np.empty((4, 3)), np.empty((2, 3)))
    functions, work = np.empty((4, 4)), np.empty((3, CORNERS, 2))
    pieces, sizes = np.empty((max(most_pieces, 1), CORNERS, 2)), np.empty(max(most_pieces, 1), np.int64)
    hidden = np.empty(sets.shape[1], np.bool_)
    stack, groups = np.empty(128, np.int64), np.empty((64, 2), np.int64)
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
                sets[(first + number) % SETS], hidden, stack, groups,
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
        if own >= 0 and (face == own or _in_one_plane(corners[own], corners[face], flatness[own])):
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
def _sample_faces(
    point, view, shaft, own, viewer, corners, boxes, flatness, closed, functions, samples, hidden, stack, groups
):
    """Return the share of samples that no face between the point and the light hides.

    Many samples are tested together as long as few faces are before them, else halves of them, and few one by one.
    """
    part, planes, bounds = shaft
    hidden[:] = False
    if own >= 0 and hidden_by_own_face(corners[own], viewer, point, view, closed[own], functions):
        functions[1:, 0], functions[1:, 1:] = 1.0, 0.0
        _hide(samples, functions, hidden)
    groups[0, 0], groups[0, 1] = 0, len(samples)
    n_groups = 1
    while n_groups > 0:
        n_groups -= 1
        start, end = groups[n_groups]
        if end - start <= FEW:
            for sample in range(start, end):
                if not hidden[sample]:
                    hidden[sample] = _is_hidden(
                        point, view, part, samples[sample], own, corners, boxes, flatness, closed, functions, stack
                    )
            continue
        _set_part(samples[start:end], part)
        set_shaft(view, part, planes, bounds)
        budget = FACES_PER_SAMPLE * (end - start)
        stack[0] = 1
        top = 1
        while True:
            top = _next_face(top, point, view, shaft, own, corners, boxes, flatness, closed, functions, stack)
            if top == NONE:
                break
            if budget <= 0:
                middle = (start + end) // 2
                groups[n_groups, 0], groups[n_groups, 1] = start, middle
                groups[n_groups + 1, 0], groups[n_groups + 1, 1] = middle, end
                n_groups += 2
                break
            budget -= 1
            if _hide(samples[start:end], functions, hidden[start:end]) == 0:
                break
    n_visible = 0
    for sample in range(len(samples)):
        n_visible += not hidden[sample]
    return n_visible / len(samples)


@kernel
def _set_part(samples, part):
    """Write the smallest part of the light that contains the samples: its middle and its half widths."""
    low_a, high_a, low_b, high_b = samples[0, 0], samples[0, 0], samples[0, 1], samples[0, 1]
    for sample in range(len(samples)):
        a, b = samples[sample, 0], samples[sample, 1]
        low_a, high_a, low_b, high_b = min(low_a, a), max(high_a, a), min(low_b, b), max(high_b, b)
    part[0], part[1], part[2], part[3] = (low_a + high_a) / 2, (low_b + high_b) / 2, high_a - low_a, high_b - low_b
    part[2], part[3] = part[2] * HALF_AND_MORE, part[3] * HALF_AND_MORE


@kernel
def _is_hidden(point, view, part, sample, own, corners, boxes, flatness, closed, functions, stack):
    """Return whether a face lies between the point and one sample."""
    part[0], part[1], part[2], part[3] = sample[0], sample[1], 0.0, 0.0
    x, y, z = place(view, sample[0], sample[1])
    inverse = (1 / x if x != 0 else HUGE, 1 / y if y != 0 else HUGE, 1 / z if z != 0 else HUGE)
    first_leaf = len(boxes) // 2
    stack[0] = 1
    top = 1
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
            and not (own >= 0 and (face == own or _in_one_plane(corners[own], corners[face], flatness[own])))
        ):
            return True
    return False


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
