"""What is legal but surprising about a scene, said before the picture surprises."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from softshadow import errors
from softshadow.scene.mesh import Mesh

if TYPE_CHECKING:
    from softshadow.scene.scene import Scene


def surprises(scene: "Scene") -> Iterator[errors.Warning]:
    """Yield a named warning for each caster that is open or non-manifold, and for each light inside a caster."""
    for caster in scene.casters:
        topology = caster.mesh.topology
        if topology.boundary_edges:
            yield errors.OpenMesh(
                f"{caster.name}: the mesh is {topology.describe()}. Every face casts, turned towards the light: "
                f"counts go up by one per layer, so parity fails, and a shadow map of the far faces has holes"
            )
        if topology.nonmanifold_edges:
            yield errors.NonManifoldMesh(
                f"{caster.name}: {topology.nonmanifold_edges} edges have more than two faces, or two that disagree "
                f"about the outside. Volumes stay closed, but triangles may be drawn inside out: culled or unlit"
            )
        if topology.closed and caster.mesh.signed_volume < 0:
            yield errors.InsideOutMesh(
                f"{caster.name}: the triangles run clockwise seen from outside. Culling and lighting show the inside, "
                f"and the far side casts instead of the near one"
            )
        for light in scene.lights:
            if light.is_directional or not topology.closed:
                continue
            if _is_inside(caster.mesh, light.in_object_space(caster.object_to_world)[:3]):
                yield errors.LightInsideCaster(
                    f"{light.name}: the light is inside {caster.name}. Faces seen from behind cast no volume, so "
                    f"volumes let the light out, while shadow maps and rays keep it in"
                )


def _is_inside(mesh: Mesh, point: np.ndarray) -> bool:
    """Return whether a closed mesh winds around the point.

    The sum of the solid angles of all faces (Van Oosterom & Strackee 1983, eq. 8) is 4 pi times the winding number.
    """
    low, high = mesh.bounds
    if (point <= low).any() or (point >= high).any():
        return False
    a, b, c = (mesh.positions[mesh.triangles[:, corner]] - point for corner in range(3))
    la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
    triple = (a * np.cross(b, c)).sum(axis=1)
    below = la * lb * lc + (a * b).sum(axis=1) * lc + (b * c).sum(axis=1) * la + (c * a).sum(axis=1) * lb
    winding = np.arctan2(triple, below).sum() / (2 * np.pi)
    return bool(abs(winding) > 0.5)
