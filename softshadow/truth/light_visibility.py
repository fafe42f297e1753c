"""How much of an area light each point sees: the reference that soft shadows are compared with.

Faces in the shaft between a point and the light are cut out of the light as polygons, which gives the exact area. Where
that takes too many polygons, as behind a fine mesh, rays to samples of the light are cast instead.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal, get_args

import numpy as np

from softshadow.errors import nearest
from softshadow.scene import Disc, Light, SceneObject, Sphere
from softshadow.scene.sample_patterns import square_to_disc, strata
from softshadow.truth.embree import visible_samples
from softshadow.truth.light_kernels import measure_light
from softshadow.truth.light_view import BALL, FLAT, ROUND
from softshadow.truth.ray_cast import casting_faces_between, checked_points, own_leaves
from softshadow.truth.triangle_tree import build_tree

Method = Literal["auto", "exact", "rays", "embree"]
METHODS: tuple[Method, ...] = get_args(Method)
# pieces of the light, and faces before it: with more of them, samples take less time
MOST_PIECES, MOST_FACES = 24, 64
ALL_PIECES = 4096  # with method="exact"; some 1.6 MB per thread
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
    start = checked_points("points", points)
    if method not in METHODS:
        raise ValueError(f"method={method!r}: {nearest(str(method), METHODS)}")
    if isinstance(samples, bool) or not isinstance(samples, int | np.integer) or samples < 1:
        raise ValueError(f"samples={samples!r}: expected a whole number of at least 1")
    if light.shape is None or not casters:
        counts = casting_faces_between(start, light.position, casters, exclude=exclude, viewer=viewer)
        visible = ((counts == 0) & light.shines_on(start)).astype(np.float64)
        return _result(visible, np.ones(len(start), bool), samples)
    tree = build_tree(casters)
    own = own_leaves(exclude, len(start), tree)
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
        measure_light(
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
    columns = round(np.sqrt(samples)) if len(light.shape.corners) > 2 else samples  # those of a segment lie in a row
    return _sample_sets(samples, columns, isinstance(light.shape, Disc | Sphere), seed)


@lru_cache(maxsize=2)  # they are the same for all lights of a kind
def _sample_sets(samples: int, columns: int, is_round: bool, seed: int) -> np.ndarray:
    unit = [strata(samples, columns, each) for each in np.random.default_rng(seed).random((SETS, samples, 2))]
    return np.stack([in_halves(square_to_disc(each) if is_round else 2 * each - 1) for each in unit])


def in_halves(samples: np.ndarray) -> np.ndarray:
    """Return samples (n, 2) so that both halves are compact, and both halves of each half: neighbours come together."""
    if len(samples) < 3:
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
