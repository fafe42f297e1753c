"""Penumbra wedges: for each silhouette edge, the part of space from where the edge is seen in front of the light.

Four planes bound the wedge of an edge. Each touches the sphere around the light's centre that contains the light, and
the wedge is on the far side of all four. The construction of the slides, with the names of `PenumbraWedges`:

1. the end that is farther from the light's centre moves towards it until both are equally far: `moved_end`;
2. the planes through the edge that touch the sphere: `front` and `back`;
3. at each end, a plane perpendicular to that of edge and centre touches the sphere: `right` at the moved end, `left` at
   the near end. Of two such planes, it is the one between the sphere and the other end;
4. all four face away from the light: a point is inside if it is in front of all of them.

Only the wedge has the moved end: what an edge hides of the light depends on the edge itself (`light_coverage`). All
edges of one silhouette are seen from the light's centre.

References
----------
Assarsson & Akenine-Möller 2003, "A geometry-based soft shadow volume algorithm using graphics hardware".
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from softshadow.scene.lights import Light
from softshadow.scene.scene import SceneObject
from softshadow.scene.silhouette import silhouette

# relative: a line that comes so near to the sphere has no planes that touch it
NEAR_THE_SPHERE = 1e-9


@dataclass(frozen=True, eq=False)
class SilhouetteEdges:
    """The silhouette edges of casters in world space, each directed as in its casting face.

    Attributes
    ----------
    ends : (E, 2, 3) float64
    casters : (E,) int           index of the caster
    """

    ends: np.ndarray
    casters: np.ndarray


@dataclass(frozen=True, eq=False)
class PenumbraWedges:
    """The wedges of E edges; ``wedges[i]`` is the wedge of one of them, its arrays without the first axis.

    A plane is (a, b, c, d) in world space with unit normal; the wedge is where ``a x + b y + c z + d >= 0``.

    Attributes
    ----------
    near_end : (E, 3) float64    the end that is nearer to the light's centre
    far_end : (E, 3) float64     the other one, before it is moved
    moved_end : (E, 3) float64   the far end, moved towards the centre until it is as near
    front, back : (E, 4) float64     planes through the edge
    right, left : (E, 4) float64     planes at the moved and at the near end
    everywhere : (E,) bool       the edge's line meets the sphere: no plane touches it, and the wedge is all of space
    """

    near_end: np.ndarray
    far_end: np.ndarray
    moved_end: np.ndarray
    front: np.ndarray
    back: np.ndarray
    right: np.ndarray
    left: np.ndarray
    everywhere: np.ndarray

    def __len__(self) -> int:
        return len(self.everywhere)

    def __getitem__(self, index: int) -> "PenumbraWedges":
        return PenumbraWedges(*(getattr(self, field.name)[index] for field in fields(self)))

    @property
    def planes(self) -> np.ndarray:
        """(E, 4, 4) float64: front, back, right, left."""
        return np.stack([self.front, self.back, self.right, self.left], axis=-2)

    def contains(self, points: np.ndarray) -> np.ndarray:
        """Return whether world points (..., 3) are in the wedges, (..., E) bool."""
        distances = np.tensordot(points, self.planes[..., :3], axes=(-1, -1)) + self.planes[..., 3]
        inside: np.ndarray = (distances >= 0).all(axis=-1) | self.everywhere
        return inside


def silhouette_edges(casters: Sequence[SceneObject], light: Light) -> SilhouetteEdges:
    """Return the silhouette edges as the light's centre sees them, caster by caster, repeated by multiplicity.

    For every caster they are in the order of the sides of its shadow volume.
    """
    ends, numbers = [np.zeros((0, 2, 3))], [np.zeros(0, np.int64)]
    for number, caster in enumerate(casters):
        outline = silhouette(caster.mesh, light.in_object_space(caster.object_to_world))
        edges = np.repeat(outline.edges, outline.multiplicity, axis=0)
        ends.append(caster.world_positions[edges])
        numbers.append(np.full(len(edges), number))
    return SilhouetteEdges(np.concatenate(ends), np.concatenate(numbers))


def penumbra_wedges(edges: np.ndarray, center: np.ndarray, radius: float) -> PenumbraWedges:
    """Return the wedges of edges (E, 2, 3) for a light within a sphere; world space."""
    distances = np.linalg.norm(edges - center, axis=2)

    # step 1: the farther end moves to the distance of the nearer one
    order = np.argsort(distances, axis=1, kind="stable")
    near_end, far_end = np.moveaxis(np.take_along_axis(edges, order[:, :, None], axis=1), 1, 0)
    near, far = near_end - center, far_end - center
    near_distance, far_distance = np.sort(distances, axis=1).T
    with np.errstate(divide="ignore", invalid="ignore"):  # an end in the light's centre: the wedge is everywhere
        moved = far * np.where(far_distance > 0, near_distance / far_distance, 0)[:, None]
    along = _unit(moved - near, instead=_perpendicular(near))

    # steps 2 to 4: planes that touch the sphere, facing away from it
    foot = near - (near * along).sum(axis=1, keepdims=True) * along
    everywhere = np.linalg.norm(foot, axis=1) <= radius * (1 + NEAR_THE_SPHERE)
    front, back = _touching(foot, along, radius)
    across = _unit(np.cross(along, moved), instead=along)
    right = _separating(_touching(moved, across, radius), near)
    left = _separating(_touching(near, across, radius), moved)
    planes = np.stack([front, back, right, left])
    planes = np.concatenate([planes, -radius - planes @ center[:, None]], axis=2)
    return PenumbraWedges(near_end, far_end, moved + center, planes[0], planes[1], planes[2], planes[3], everywhere)


def _touching(foot: np.ndarray, along: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the unit normals (E, 3) of both planes through a line that touch the sphere around 0, facing outwards.

    Parameters
    ----------
    foot, along : (E, 3)         the point of the line nearest to 0, and the unit vector along it
    """
    distance = np.linalg.norm(foot, axis=1, keepdims=True)
    outwards = _unit(foot, instead=along)
    with np.errstate(divide="ignore", invalid="ignore"):
        cosine = np.where(distance > radius, radius / distance, 1.0)
    sideways = np.sqrt(1 - cosine**2) * np.cross(along, outwards)
    return cosine * outwards + sideways, cosine * outwards - sideways


def _separating(normals: tuple[np.ndarray, np.ndarray], other_end: np.ndarray) -> np.ndarray:
    """Return the normals (E, 3) of those planes of each two that have the other end in front of them."""
    one, two = normals
    chosen = (one * other_end).sum(axis=1) >= (two * other_end).sum(axis=1)
    return np.where(chosen[:, None], one, two)


def _unit(vectors: np.ndarray, instead: np.ndarray) -> np.ndarray:
    """Return vectors (E, 3) scaled to length 1, and others instead of those of length 0."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(lengths > 0, vectors / lengths, instead)


def _perpendicular(vectors: np.ndarray) -> np.ndarray:
    """Return unit vectors (E, 3), each perpendicular to one of the vectors."""
    axes = np.eye(3)[np.abs(vectors).argmin(axis=1)]
    sideways = np.cross(vectors, axes)
    return sideways / np.maximum(np.linalg.norm(sideways, axis=1, keepdims=True), np.finfo(float).tiny)


# -- for drawing -------------------------------------------------------------------------------------------------------

# counter-clockwise from outside, by the names of the corners: where the planes meet, or far out on their common rays
TRIANGLES = (
    ("moved", "near", "front left"),
    ("moved", "front left", "front right"),
    ("near", "moved", "back right"),
    ("near", "back right", "back left"),
    ("moved", "front right", "back right"),
    ("near", "back left", "front left"),
    ("front left", "back left", "back right"),
    ("front left", "back right", "front right"),
)


def wedge_polyhedra(wedges: PenumbraWedges) -> tuple[np.ndarray, np.ndarray]:
    """Return the closed surfaces of wedges as triangles; their far ends are at infinity, as those of shadow volumes.

    Returns
    -------
    (T, 3, 4) float32            homogeneous, world space, counter-clockwise from outside
    (T,) int                     the wedge that each triangle belongs to
    """
    front, back, right, left = (plane[:, :3] for plane in (wedges.front, wedges.back, wedges.right, wedges.left))
    corners = {
        "near": np.column_stack([wedges.near_end, np.ones(len(wedges))]),
        "moved": np.column_stack([wedges.moved_end, np.ones(len(wedges))]),
        "front right": _ray(front, right, back),
        "back right": _ray(back, right, front),
        "front left": _ray(front, left, back),
        "back left": _ray(back, left, front),
    }
    surfaces = np.stack([np.stack([corners[name] for name in names], axis=1) for names in TRIANGLES], axis=1)
    bounded, unbounded = np.flatnonzero(~wedges.everywhere), np.flatnonzero(wedges.everywhere)
    triangles = [surfaces[bounded].reshape(-1, 3, 4), np.tile(SKY, (len(unbounded), 1, 1))]
    owners = [np.repeat(bounded, len(TRIANGLES)), np.repeat(unbounded, len(SKY))]
    return np.concatenate(triangles).astype(np.float32), np.concatenate(owners)


def _ray(normal: np.ndarray, other: np.ndarray, third: np.ndarray) -> np.ndarray:
    """Return the points at infinity (E, 4) in which two planes meet, in front of a third."""
    direction = np.cross(normal, other)
    direction *= np.where((direction * third).sum(axis=1) < 0, -1, 1)[:, None]
    return np.column_stack([_unit(direction, instead=normal), np.zeros(len(direction))])


def _box_at_infinity() -> np.ndarray:
    """Return the triangles (12, 3, 4) of a box around all of space, counter-clockwise from outside."""
    triangles = []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            square = np.zeros((4, 4))
            square[:, axis] = sign
            square[:, (axis + 1) % 3] = np.array([-1, 1, 1, -1]) * sign
            square[:, (axis + 2) % 3] = [-1, -1, 1, 1]
            triangles += [square[[0, 1, 2]], square[[0, 2, 3]]]
    return np.array(triangles)


SKY = _box_at_infinity()
