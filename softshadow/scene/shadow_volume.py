"""The shadow volume of one mesh and one light: light cap, sides and dark cap, closed to the last bit.

Made in the object's own space, to be drawn under the object's own modelview matrix. The light cap is the mesh's own
triangles over the mesh's own vertices, unchanged in order: its depth is the surface's depth bit for bit, so that under
GL_LESS it never passes over the surface that it lies on.

References
----------
Crow 1977, "Shadow algorithms for computer graphics"; Bergeron 1986, "A general version of Crow's shadow volumes";
Everitt & Kilgard 2002, "Practical and robust stenciled shadow volumes" (far vertices at infinity).
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from softshadow.scene.mesh import Mesh
from softshadow.scene.silhouette import (
    CastingFaces,
    casting_faces,
    homogeneous_light,
    light_distances,
    silhouette_of,
)

Generator = Literal["silhouette", "per-polygon"]
GENERATORS: tuple[Generator, ...] = ("silhouette", "per-polygon")

# far vertices further out than this would leave no room for a float32 matrix product; only a face that is edge-on
# to the light within 1e-25 of the reach asks for more, and such a face covers no sample
FARTHEST = 1e25


@dataclass(frozen=True, eq=False)
class ShadowVolume:
    """Polygons whose directed edges cancel: every edge is run along as often as against. All arrays are read-only.

    Attributes
    ----------
    light_cap : (C, 3) int32             rows of the mesh's triangles, to be drawn with the mesh's own positions
    light_cap_reversed : (R, 3) int32    the same, to be drawn under glFrontFace(GL_CW)
    sides : (S, 4, 4) float32            homogeneous quads v, u, u_far, v_far, counter-clockwise from outside;
                                         (S, 3, 4) triangles where the far two are one point at infinity
    far_vertices : (V, 4) float32        where the volume ends behind each vertex of the mesh. The dark cap is the light
                                         cap's triangles over these, seen from the other side; (0, 4) where there is
                                         none: without caps, and where all of them are one point at infinity
    """

    light_cap: np.ndarray
    light_cap_reversed: np.ndarray
    sides: np.ndarray
    far_vertices: np.ndarray

    def __post_init__(self) -> None:
        for array in (self.light_cap, self.light_cap_reversed, self.sides, self.far_vertices):
            array.setflags(write=False)

    @property
    def dark_cap(self) -> np.ndarray:
        """(C + R, 3, 4) float32: the dark cap's triangles, counter-clockwise from outside; none where not needed."""
        if not len(self.far_vertices):
            return np.zeros((0, 3, 4), np.float32)
        return self.far_vertices[np.concatenate([self.light_cap[:, ::-1], self.light_cap_reversed])]


def shadow_volume(
    mesh: Mesh,
    light: np.ndarray,
    *,
    generator: Generator = "silhouette",
    extrusion: Literal["infinite"] | float = "infinite",
    caps: bool = True,
) -> ShadowVolume:
    """Return the volume behind the mesh as seen from the light.

    Parameters
    ----------
    light : (4,) float64          homogeneous, object space, w >= 0; w = 0 is a direction towards the light
    generator : str               "silhouette": sides only at the silhouette, once per multiplicity;
                                  "per-polygon": every casting face makes a volume of its own
    extrusion : "infinite" or R   R: every point nearer to the light than R (object space) that is in shadow lies in the
                                  volume; for a directional light, every point within R behind the mesh
    caps : bool                   without caps both cap arrays are empty

    Raises
    ------
    ValueError                    unknown generator, a reach that is not positive and finite, a malformed light
    """
    if generator not in GENERATORS:
        raise ValueError(f"generator: expected one of {', '.join(GENERATORS)}, got {generator!r}")
    light = homogeneous_light(light)
    faces = casting_faces(mesh, light)
    far = _far_vertices(mesh, light, faces, extrusion)
    u, v = (_polygon_edges(mesh, faces) if generator == "per-polygon" else _silhouette_edges(mesh, faces)).T
    one_far_point = bool(light[3] == 0) and extrusion == "infinite"
    corners = [_near(mesh, v), _near(mesh, u), far[u]] + ([] if one_far_point else [far[v]])
    sides = np.stack(corners, axis=1)
    if not caps:
        nothing = np.zeros((0, 3), dtype=np.int32)
        return ShadowVolume(nothing, nothing, sides, far[:0])
    far_vertices = far[:0] if one_far_point else far
    return ShadowVolume(mesh.triangles[faces.kept], mesh.triangles[faces.reversed], sides, far_vertices)


def _near(mesh: Mesh, vertices: np.ndarray) -> np.ndarray:
    """Return (N, 4) float32: vertices of the mesh as homogeneous points."""
    near = np.ones((len(vertices), 4), dtype=np.float32)
    near[:, :3] = mesh.positions[vertices]
    return near


def _polygon_edges(mesh: Mesh, faces: CastingFaces) -> np.ndarray:
    """Return (3 (C + R), 2): the edges of the casting faces, all counter-clockwise seen from the light."""
    triangles = np.concatenate([mesh.triangles[faces.kept], mesh.triangles[faces.reversed][:, ::-1]])
    return np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)


def _silhouette_edges(mesh: Mesh, faces: CastingFaces) -> np.ndarray:
    found = silhouette_of(mesh, faces)
    return np.repeat(found.edges, found.multiplicity, axis=0)


def _far_vertices(
    mesh: Mesh, light: np.ndarray, faces: CastingFaces, extrusion: Literal["infinite"] | float
) -> np.ndarray:
    """Return (V, 4) float32: where each vertex goes; one function of the position, so that sides and cap meet."""
    positions = mesh.positions.astype(np.float64)
    away = positions - light[:3] if light[3] else np.broadcast_to(-light[:3], positions.shape)
    far = np.zeros((len(positions), 4), dtype=np.float32)
    if isinstance(extrusion, str):
        if extrusion != "infinite":
            raise ValueError(f"extrusion: expected 'infinite' or a reach (a positive number), got {extrusion!r}")
        far[:, :3] = away  # (u - L, 0), or (-D, 0)
        return far
    reach = float(extrusion)
    if not 0 < reach < FARTHEST:
        raise ValueError(f"extrusion: expected 'infinite' or a reach between 0 and {FARTHEST:g}, got {extrusion!r}")
    if light[3]:
        moved = light[:3] + _scale(mesh, light, faces, reach) * away
    else:
        moved = positions + reach * away / np.linalg.norm(light[:3])
    far[:, :3] = moved
    far[:, 3] = 1
    return far


def _scale(mesh: Mesh, light: np.ndarray, faces: CastingFaces, reach: float) -> float:
    """Return k: scaled about the light by k, the plane of every casting face is at least `reach` from the light.

    Moving each vertex by the same length instead leaves the middle of a near face behind: 8.7 where 20 was asked for.
    """
    used = np.concatenate([faces.kept, faces.reversed])
    if not len(used):
        return 1.0
    distance = np.abs(light_distances(mesh, light)[used]) / mesh.doubled_areas[used]
    largest = np.abs(mesh.bounds - light[:3]).max()
    return float(min(max(reach / distance.min(), 1.0), FARTHEST / largest))
