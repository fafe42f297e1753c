"""What is legal but surprising about a scene, said before the picture surprises."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from softshadow import errors
from softshadow.scene.mesh import Mesh

if TYPE_CHECKING:
    from softshadow.scene.scene import Scene, SceneObject

# at a thousand times its size a mesh has 14 of float32's 24 bits left: a tenth of a pixel in a large picture
FAR = 1000
# float64 rounding of a volume of nothing, of a mesh of size 1: faces back to back have no inside to be turned out
NO_VOLUME = 1e-12


def surprises(scene: "Scene") -> Iterator[errors.Warning]:
    """Yield a named warning for whatever makes a caster leak or count oddly, and for each light inside a caster."""
    for caster in scene.casters:
        yield from leaks(caster)
        mesh = caster.mesh
        if mesh.topology.closed and mesh.signed_volume < -NO_VOLUME * float(np.ptp(mesh.bounds, axis=0).max()) ** 3:
            yield errors.InsideOutMesh(
                f"{caster.name}: the triangles run clockwise seen from outside. Culling and lighting show the inside, "
                f"and the far side casts instead of the near one"
            )
        for light in scene.lights:
            if light.is_directional or not mesh.topology.closed_faces.any():
                continue
            if _is_inside(mesh, light.in_object_space(caster.object_to_world)[:3]):
                yield errors.LightInsideCaster(
                    f"{light.name}: the light is inside {caster.name}. Faces seen from behind cast no volume, so "
                    f"volumes let the light out, while shadow maps and rays keep it in"
                )


def leaks(caster: "SceneObject") -> Iterator[errors.Warning]:
    """Yield what keeps the caster from being a solid: what, how many, where the first is (object space), what copes."""
    mesh, topology = caster.mesh, caster.mesh.topology
    if topology.boundary_edges:
        boundary = mesh.boundary
        yield errors.OpenMesh(
            f"{caster.name}: the mesh is {topology.describe()} in {boundary.loops} "
            f"{'loop' if boundary.loops == 1 else 'loops'}, the first at {place(*boundary.first_edge)}. Every face of "
            f"an open body casts, turned towards the light, and counts go up by one per layer. Volumes count right, "
            f"volume-parity and a map of the far faces (cull=front) do not cope"
        )
        if len(boundary.unwelded):
            yield errors.UnweldedMesh(
                f"{caster.name}: {len(boundary.unwelded)} boundary vertices lie next to another one, not at an equal "
                f"position, the first at {place(boundary.unwelded[0])}. Light may come through between them; merge "
                f"vertices by distance in the program that made the file"
            )
        if len(boundary.t_junctions):
            yield errors.TJunction(
                f"{caster.name}: {len(boundary.t_junctions)} vertices lie within an edge of another face, the first at "
                f"{place(boundary.t_junctions[0])}. The two sides of such an edge are rounded apart: single pixels in "
                f"line with it may leak, in surfaces and volumes; split the edge there, or use a map"
            )
    if topology.nonmanifold_edges:
        yield errors.NonManifoldMesh(
            f"{caster.name}: {topology.nonmanifold_edges} edges have more than two faces, the first at "
            f"{_edge_place(mesh, topology.edge_faces > 2)}. Volumes have as many sides there as are needed and count "
            f"right, but the body has no inside"
        )
    if topology.misoriented_edges:
        yield errors.MisorientedMesh(
            f"{caster.name}: at {topology.misoriented_edges} edges two faces disagree about the outside, the first at "
            f"{_edge_place(mesh, (topology.edge_faces == 2) & (topology.edge_sums != 0))}. Every face of such a body "
            f"casts, turned towards the light: volumes that count cope, volume-parity does not, and triangles are "
            f"drawn inside out, culled or unlit; make normals consistent in the program that made the file"
        )
    size, reach = float(np.ptp(mesh.bounds, axis=0).max()), float(np.abs(mesh.bounds).max())
    if reach > FAR * size:
        yield errors.FarFromOrigin(
            f"{caster.name}: coordinates up to {reach:g} for a mesh of size {size:g}: float32 keeps its shape to "
            f"{np.spacing(np.float32(reach)):.2g} only, and pixels near edges are wrong; move it to the origin in the "
            f"program that made the file"
        )
    flat = mesh.doubled_areas == 0
    if flat.any():
        first = int(np.flatnonzero(flat)[0])
        yield errors.DegenerateFaces(
            f"{caster.name}: {int(flat.sum())} of {len(flat)} triangles have no area, the first is triangle {first} at "
            f"{place(mesh.positions[mesh.triangles[first, 0]])}. They are not seen and cast nothing"
        )


def place(*points: np.ndarray) -> str:
    """Return positions as text: (x, y, z), or (x, y, z) - (x, y, z) for an edge."""
    return " - ".join(f"({', '.join(f'{value:.6g}' for value in point)})" for point in points)


def _edge_place(mesh: Mesh, which: np.ndarray) -> str:
    topology = mesh.topology
    return place(*mesh.positions[topology.representatives[topology.edges[np.flatnonzero(which)[0]]]])


def _is_inside(mesh: Mesh, point: np.ndarray) -> bool:
    """Return whether the closed bodies of a mesh wind around the point.

    The sum of the solid angles of all faces (Van Oosterom & Strackee 1983, eq. 8) is 4 pi times the winding number.
    """
    low, high = mesh.bounds
    if (point <= low).any() or (point >= high).any():
        return False
    solid = mesh.triangles[mesh.topology.closed_faces]
    a, b, c = (mesh.positions[solid[:, corner]] - point for corner in range(3))
    la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
    triple = (a * np.cross(b, c)).sum(axis=1)
    below = la * lb * lc + (a * b).sum(axis=1) * lc + (b * c).sum(axis=1) * la + (c * a).sum(axis=1) * lb
    winding = np.arctan2(triple, below).sum() / (2 * np.pi)
    return bool(abs(winding) > 0.5)
