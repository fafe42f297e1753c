"""The shadow volume of one mesh and one light: light cap, sides and dark cap, which fit together exactly.

It is built in object space, to be drawn with the object's own modelview matrix. The light cap consists of the mesh's
own triangles and vertices in the same order. Its depth therefore equals the surface's depth bit for bit, and with
GL_LESS it never passes on the surface itself.

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

# limit of far vertices, so that products with a matrix stay within float32; only a face that is edge-on to the light
# to within 1e-25 of the reach would need more, and such a face covers no sample
FARTHEST = 1e25


@dataclass(frozen=True, eq=False)
class ShadowVolume:
    """A closed volume: each edge occurs equally often in both directions. All arrays are read-only.

    Attributes
    ----------
    light_cap : (C, 3) int32             triangles of the mesh, to be drawn with the mesh's positions
    light_cap_reversed : (R, 3) int32    the same, to be drawn with glFrontFace(GL_CW)
    sides : (S, 4, 4) float32            homogeneous quads v, u, u_far, v_far, counter-clockwise from outside; or
                                         (S, 3, 4) triangles, if all far vertices are one point at infinity
    far_vertices : (V, 4) float32        the end of the volume behind each vertex of the mesh. The dark cap is the light
                                         cap over these vertices, reversed. (0, 4) without caps, and if all of them are
                                         one point at infinity
    side_feature, side_numbers : (S,) int32   the "edge" of the mesh's topology that each side begins at, or the "face"
                                         whose volume it bounds
    cap_faces, cap_faces_reversed : (C,), (R,) int32   the faces of the mesh that the triangles of the caps are
    """

    light_cap: np.ndarray
    light_cap_reversed: np.ndarray
    sides: np.ndarray
    far_vertices: np.ndarray
    side_feature: str
    side_numbers: np.ndarray
    cap_faces: np.ndarray
    cap_faces_reversed: np.ndarray

    def __post_init__(self) -> None:
        for array in (self.light_cap, self.light_cap_reversed, self.sides, self.far_vertices):
            array.setflags(write=False)

    @property
    def dark_cap(self) -> np.ndarray:
        """(C + R, 3, 4) float32: the triangles of the dark cap, counter-clockwise from outside; (0, 3, 4) if none."""
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
    """Return the shadow volume: what lies behind the mesh as seen from the light.

    Parameters
    ----------
    light : (4,) float64          homogeneous, object space, w >= 0; w = 0 is a direction towards the light
    generator : str               "silhouette": sides at the silhouette edges only, repeated by multiplicity;
                                  "per-polygon": a volume for each casting face
    extrusion : "infinite" or R   R: the volume contains every shadowed point nearer to the light than R (object space);
                                  for a directional light, every one within R behind the mesh
    caps : bool                   without caps, both light caps and `far_vertices` are empty

    Raises
    ------
    ValueError                    unknown generator, an extrusion that is not positive and finite, a malformed light
    """
    if generator not in GENERATORS:
        raise ValueError(f"generator: expected one of {', '.join(GENERATORS)}, got {generator!r}")
    light = homogeneous_light(light)
    faces = casting_faces(mesh, light)
    far = _far_vertices(mesh, light, faces, extrusion)
    if generator == "per-polygon":
        edges, of = _polygon_edges(mesh, faces), ("face", np.repeat(np.concatenate([faces.facing, faces.reversed]), 3))
    else:
        outline = silhouette_of(mesh, faces)
        edges = np.repeat(outline.edges, outline.multiplicity, axis=0)
        of = ("edge", np.repeat(outline.numbers, outline.multiplicity))
    u, v = edges.T
    one_far_point = bool(light[3] == 0) and extrusion == "infinite"
    corners = [_near(mesh, v), _near(mesh, u), far[u]] + ([] if one_far_point else [far[v]])
    sides = np.stack(corners, axis=1)
    if not caps:
        no_cap = np.zeros((0, 3), dtype=np.int32)
        return ShadowVolume(no_cap, no_cap, sides, far[:0], *of, faces.facing[:0], faces.reversed[:0])
    far_vertices = far[:0] if one_far_point else far
    caps_of = mesh.triangles.take(faces.facing, axis=0), mesh.triangles.take(faces.reversed, axis=0)
    return ShadowVolume(*caps_of, sides, far_vertices, *of, faces.facing, faces.reversed)


def _near(mesh: Mesh, vertices: np.ndarray) -> np.ndarray:
    """Return (N, 4) float32: the listed vertices of the mesh as homogeneous points."""
    near = np.ones((len(vertices), 4), dtype=np.float32)
    near[:, :3] = mesh.positions[vertices]
    return near


def _polygon_edges(mesh: Mesh, faces: CastingFaces) -> np.ndarray:
    """Return (3 (C + R), 2): the edges of the casting faces, counter-clockwise as seen from the light."""
    triangles = np.concatenate([mesh.triangles[faces.facing], mesh.triangles[faces.reversed][:, ::-1]])
    return np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)


def _far_vertices(
    mesh: Mesh, light: np.ndarray, faces: CastingFaces, extrusion: Literal["infinite"] | float
) -> np.ndarray:
    """Return (V, 4) float32: the far vertices, each a function of its position only, so that sides and cap meet."""
    far = np.empty((len(mesh.positions), 4), dtype=np.float32)
    if isinstance(extrusion, str):
        if extrusion != "infinite":
            raise ValueError(f"extrusion: expected 'infinite' or a reach (a positive number), got {extrusion!r}")
        if light[3]:
            from softshadow.scene.face_kernels import write_directions

            write_directions(mesh.positions, light[:3], far)  # (u - L, 0)
        else:
            far[:] = *-light[:3], 0  # (-D, 0)
        return far
    positions = mesh.positions.astype(np.float64)
    from_light = positions - light[:3] if light[3] else np.broadcast_to(-light[:3], positions.shape)
    reach = float(extrusion)
    if not 0 < reach < FARTHEST:
        raise ValueError(f"extrusion: expected 'infinite' or a reach between 0 and {FARTHEST:g}, got {extrusion!r}")
    if light[3]:
        moved = light[:3] + _scale(mesh, light, faces, reach) * from_light
    else:
        moved = positions + reach * from_light / np.linalg.norm(light[:3])
    far[:, :3] = moved
    far[:, 3] = 1
    return far


def _scale(mesh: Mesh, light: np.ndarray, faces: CastingFaces, reach: float) -> float:
    """Return the factor that, as a scale about the light, moves every casting face's plane to at least `reach` from it.

    Moving each vertex to the distance `reach` is not enough: the middle of a near face came to 8.7 instead of 20.
    """
    casting = np.concatenate([faces.facing, faces.reversed])
    if not len(casting):
        return 1.0
    distance = np.abs(light_distances(mesh, light)[casting]) / mesh.doubled_areas[casting]
    largest = np.abs(mesh.bounds - light[:3]).max()
    return float(min(max(reach / distance.min(), 1.0), FARTHEST / largest))
