"""Warnings about a scene: input that is legal but will look wrong."""

from collections.abc import Iterator

import numpy as np

from softshadow import errors
from softshadow.scene.mesh import Mesh
from softshadow.scene.scene import Scene, SceneObject

# at this many times its size from the origin, a mesh keeps 14 of float32's 24 bits: 0.1 pixel in a large picture
FAR = 1000
# bits of the window's depth buffer, and the step between two depths, as a share of the casters' size, that shows
DEPTH_BITS, COARSE = 24, 5e-4
# float64 rounding of the volume of a mesh of size 1 that encloses nothing, such as two faces back to back
NO_VOLUME = 1e-12


def scene_warnings(scene: Scene) -> list[errors.Warning]:
    """Return warnings about what leaks, counts wrongly or is too far or too near for float32, without issuing them."""
    warnings = list(scene.notes)
    warnings += _distance_warnings(scene)
    for caster in scene.casters:
        warnings += _mesh_warnings(caster)
        warnings += _inside_out_warnings(caster)
        warnings += _light_warnings(caster, scene)
    return warnings


def _distance_warnings(scene: Scene) -> Iterator[errors.Warning]:
    """Yield what float32 and the depth buffer cannot hold: a scene or a light far away, a camera's near plane."""
    vertices = np.concatenate([thing.world_positions for thing in scene.casters or scene.objects])
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    size, reach = float((high - low).max()), float(np.abs(vertices).max())
    if reach > FAR * size:
        yield errors.FarFromOrigin(
            f"scene {scene.name}: world coordinates up to {reach:g} for casters of size {size:g}: GL's matrices are "
            f"float32 and keep places to {np.spacing(np.float32(reach)):.2g} only; move everything to the origin"
        )
    for light in scene.lights:
        distance = float(np.linalg.norm(light.position[:3] - (low + high) / 2))
        if not light.is_directional and distance > FAR * size:
            yield errors.FarFromOrigin(
                f"{light.name}: the light is {distance:g} away from casters of size {size:g}: float32 cannot tell the "
                f"depths in its shadow maps apart; make it a light at infinity (w = 0)"
            )
    camera = scene.camera
    seen = np.concatenate([thing.world_positions for thing in scene.objects])
    farthest = min(float(((seen - camera.eye) @ -camera.frame[2]).max()), camera.far)
    step = farthest * farthest / (camera.near * (1 << DEPTH_BITS))
    if size > 0 and step > COARSE * size:
        yield errors.CoarseDepth(
            f"scene {scene.name}: with the near plane at {camera.near:g}, two depths at the distance {farthest:.3g} "
            f"differ by {step:.2g} at least: surfaces and shadow volumes nearer to each other are mixed up; move the "
            f"near plane away from the eye"
        )


def _mesh_warnings(caster: SceneObject) -> Iterator[errors.Warning]:
    """Yield what keeps the mesh from being a solid: what is wrong, how often, and the first place in object space."""
    mesh, topology = caster.mesh, caster.mesh.topology
    if topology.boundary_edges:
        from softshadow.scene.boundary import boundary_of  # needs Numba, which scenes of closed meshes do not

        boundary = boundary_of(mesh)
        yield errors.OpenMesh(
            f"{caster.name}: the mesh is {topology.describe()} in {boundary.loops} "
            f"{'loop' if boundary.loops == 1 else 'loops'}, the first at {_text(*boundary.first_edge)}. Every face of "
            f"an open body casts, turned towards the light, and counts go up by one per layer. Volumes that count are "
            f"right; volume-parity and a map of the far faces (cull=front) are wrong"
        )
        if len(boundary.unwelded):
            yield errors.UnweldedMesh(
                f"{caster.name}: {len(boundary.unwelded)} boundary vertices lie next to another one, not at an equal "
                f"position, the first at {_text(boundary.unwelded[0])}. Light may leak between them; merge "
                f"vertices by distance in the program that made the file"
            )
        if len(boundary.t_junctions):
            yield errors.TJunction(
                f"{caster.name}: {len(boundary.t_junctions)} vertices lie within an edge of another face, the first at "
                f"{_text(boundary.t_junctions[0])}. The two sides of such an edge are rounded differently: single "
                f"pixels along it may leak, in surfaces and in volumes; split the edge there, or use a shadow map"
            )
    if topology.nonmanifold_edges:
        yield errors.NonManifoldMesh(
            f"{caster.name}: {topology.nonmanifold_edges} edges have more than two faces, the first at "
            f"{_edge_text(mesh, topology.edge_faces > 2)}. Volumes get as many sides there as the faces need, and "
            f"count correctly, but the body has no inside"
        )
    if topology.misoriented_edges:
        yield errors.MisorientedMesh(
            f"{caster.name}: at {topology.misoriented_edges} edges two faces disagree about the outside, the first at "
            f"{_edge_text(mesh, (topology.edge_faces == 2) & (topology.edge_sums != 0))}. Every face of such a body "
            f"casts, turned towards the light: volumes that count are right, volume-parity is wrong, and triangles "
            f"are drawn inside out, culled or unlit; make normals consistent in the program that made the file"
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
            f"{_text(mesh.positions[mesh.triangles[first, 0]])}. They are not drawn and cast nothing"
        )


def _inside_out_warnings(caster: SceneObject) -> Iterator[errors.Warning]:
    mesh = caster.mesh
    if mesh.topology.closed and mesh.signed_volume < -NO_VOLUME * float(np.ptp(mesh.bounds, axis=0).max()) ** 3:
        yield errors.InsideOutMesh(
            f"{caster.name}: the triangles are clockwise seen from outside. Culling and lighting show the inside, "
            f"and the far side casts instead of the near one"
        )


def _light_warnings(caster: SceneObject, scene: Scene) -> Iterator[errors.Warning]:
    for light in scene.lights:
        if light.is_directional or not caster.mesh.topology.closed_faces.any():
            continue
        if _is_inside(caster.mesh, light.in_object_space(caster.object_to_world)[:3]):
            yield errors.LightInsideCaster(
                f"{light.name}: the light is inside {caster.name}. Faces seen from behind cast no volume, so "
                f"volumes let the light out, while shadow maps and rays keep it in"
            )


def _text(*points: np.ndarray) -> str:
    """Return positions as text: (x, y, z), or (x, y, z) - (x, y, z) for an edge."""
    return " - ".join(f"({', '.join(f'{value:.6g}' for value in point)})" for point in points)


def _edge_text(mesh: Mesh, is_listed: np.ndarray) -> str:
    """Return the end points of the first edge where (E,) `is_listed` is true."""
    topology = mesh.topology
    return _text(*mesh.positions[topology.representatives[topology.edges[np.flatnonzero(is_listed)[0]]]])


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
