"""What techniques build to find shadows, in world space: silhouettes, shadow volumes, light frusta, penumbra wedges.

Volumes and wedges that reach to infinity have vertices with w = 0, the directions of their edges. No file format has
such vertices, so they are cut: each is replaced by the point of its edge at a stated distance from the light.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, Protocol, get_args

import numpy as np

from softshadow.errors import StateError, nearest
from softshadow.inspection import Steps
from softshadow.scene import Light, Scene, SceneObject
from softshadow.scene.penumbra_wedge import TRIANGLES, penumbra_wedges, silhouette_edges, wedge_polyhedra
from softshadow.scene.silhouette import silhouette
from softshadow.scene.topology import weld
from softshadow.space.geometry_record import ShadowGeometry
from softshadow.space.markers import marker, shape_of_light
from softshadow.space.pieces import Color, Edges, Surface, surface
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.map_cube import FACES, face_camera
from softshadow.techniques.shadow_volumes import CasterVolume, Generator, Reach, scene_reach, volumes_of

Part = Literal["silhouette", "volume", "frustum", "wedges"]
PARTS: tuple[Part, ...] = get_args(Part)
LIGHT_COLOR: Color = (0.72, 0.53, 0.04, 1.0)
SILHOUETTE: Color = (0.84, 0.37, 0.0, 1.0)
VOLUME: Color = (0.12, 0.31, 0.61, 0.18)
WEDGE: Color = (0.80, 0.47, 0.65, 0.13)
FRUSTUM: Color = (0.72, 0.53, 0.04, 0.12)
# a cut this much farther than the cap's faces bend towards the light is enough; a face all around the light would need
# any distance
FARTHEST_CUT = 4.0


class DrawnRun(Protocol):
    """What the geometry of a run depends on; a `Run` is one, and so is the record of its page."""

    @property
    def technique(self) -> str:
        """Its name."""
        ...

    @property
    def scene(self) -> Scene | None:
        """What was drawn; None for a recorded program."""
        ...

    @property
    def options(self) -> Mapping[str, Any]:
        """Every option of the technique."""
        ...

    @property
    def steps(self) -> Steps:
        """The recorded steps."""
        ...


def scene_of(run: DrawnRun) -> Scene:
    """Return the scene of a run.

    Raises
    ------
    StateError                   the run is the recording of a program, which has none
    """
    if run.scene is None:
        raise StateError(f"this run is a {run.technique} of a program: it has no scene with lights and shadows")
    return run.scene


def shadow_geometry(
    scene: Scene | str,
    light: str | None = None,
    *,
    parts: Sequence[Part] = ("silhouette", "volume"),
    generator: Generator = "silhouette",
    cap: Literal["infinite", "finite"] = "infinite",
    reach: Reach = None,
    distance: float | None = None,
) -> ShadowGeometry:
    """Return the objects and lights of a scene, and what techniques build from them, as named surfaces and edges.

    Edge i of a silhouette is that of side i of the volume, triangles 2i and 2i + 1 of its sides; an edge with a
    multiplicity has as many sides.

    Parameters
    ----------
    scene : Scene or str         a scene, or a name of `scene_names`
    light : str                  name; all lights by default
    parts : sequence of str      "silhouette", "volume" (sides and caps), "frustum" (what the light's map covers),
                                 "wedges" (of area lights)
    generator, cap, reach :      of the volumes, as in `volume-zfail`
    distance : float             from the light, where volumes and wedges are cut that reach to infinity; for a light at
                                 infinity, behind each vertex. By default beyond everything in the scene.

    Raises
    ------
    ValueError                   there is no such light or part, or the distance is not positive

    Examples
    --------
    >>> import softshadow as ss
    >>> geometry = ss.shadow_geometry("boxes")
    >>> geometry.names[-3:]
    ['volume/light/block/sides', 'volume/light/block/light cap', 'volume/light/block/dark cap']
    """
    scene = Scene.named(scene) if isinstance(scene, str) else scene
    for part in parts:
        if part not in PARTS:
            raise ValueError(f"parts: {part!r}: {nearest(part, PARTS)}")
    if distance is not None and not distance > 0:
        raise ValueError(f"distance={distance!r}: expected a positive number")
    pieces: list[Surface | Edges] = [object_surface(thing) for thing in scene.objects]
    distances = {}
    for source in [light_named(scene, light)] if light is not None else scene.lights:
        cut = distance or cut_distance(scene, source)
        distances[source.name] = cut
        pieces.append(light_surface(scene, source))
        if "frustum" in parts:
            pieces.append(frustum(f"frustum/{source.name}", light_camera(scene, source)))
        volumes = volumes_of(scene, source, generator, cap, reach)
        for volume in volumes:
            if "silhouette" in parts:
                pieces.append(silhouette_piece(volume.caster, source))
            if "volume" in parts:
                pieces += volume_surfaces(volume, source, cut)
        if "wedges" in parts and source.shape is not None:
            pieces += wedge_surfaces(scene, source, cut)
    return ShadowGeometry(scene.name, tuple(pieces), distances)


def geometry_of_run(run: DrawnRun, light: str | None = None, distance: float | None = None) -> ShadowGeometry:
    """Return what the technique of a run builds; see `shadow_geometry`."""
    options, scene = run.options, scene_of(run)
    own: dict[str, Any] = {name: options[name] for name in ("generator", "cap", "reach") if name in options}
    geometry = shadow_geometry(scene, light, parts=parts_of(run.technique), distance=distance, **own)
    if run.technique != "map-cube":
        return geometry
    lights = scene.lights if light is None else [light_named(scene, light)]
    return geometry.with_pieces(
        frustum(f"frustum/{source.name}/{name}", face_camera(scene, source, index))
        for source in lights
        for index, (name, _, _) in enumerate(FACES)
    )


def parts_of(technique: str) -> tuple[Part, ...]:
    """Return which parts a technique draws or computes with; of lights that are sampled, those of their centres."""
    if technique == "volume-wedges":
        return ("silhouette", "volume", "wedges")
    if technique.startswith("volume"):
        return ("silhouette", "volume")
    if technique == "map-silhouette":
        return ("silhouette", "frustum")
    if technique == "map-cube":
        return ()
    return ("frustum",) if technique.startswith("map") else ("silhouette",)


def light_named(scene: Scene, name: str) -> Light:
    """Return a light of a scene."""
    for light in scene.lights:
        if light.name == name:
            return light
    raise ValueError(f"light={name!r}: {nearest(name, [light.name for light in scene.lights])}")


# -- pieces ------------------------------------------------------------------------------------------------------------
def object_surface(thing: SceneObject) -> Surface:
    """Return the mesh of an object; "caster/NAME" if it casts shadows, else "receiver/NAME" or "object/NAME"."""
    kind = "receiver" if thing.receives else "caster" if thing.casts else "object"
    red, green, blue = (float(value) for value in thing.material.color)
    return Surface(
        f"{kind}/{thing.name}", thing.world_positions.astype(np.float32), thing.mesh.triangles, (red, green, blue, 1.0)
    )


def light_surface(scene: Scene, light: Light) -> Surface:
    """Return an area light's shape, or a small marker; that of a light at infinity stands above the scene."""
    vertices = np.concatenate([thing.world_positions for thing in scene.objects])
    size = float(np.ptp(vertices, axis=0).max())
    if light.shape is not None:
        return surface(f"light/{light.name}", shape_of_light(light), LIGHT_COLOR)
    place = light.position[:3]
    if light.is_directional:
        place = (vertices.min(axis=0) + vertices.max(axis=0)) / 2 + 0.75 * size * place / np.linalg.norm(place)
    return surface(f"light/{light.name}", marker(place, 0.02 * size), LIGHT_COLOR, position=light.position.tolist())


def silhouette_piece(caster: SceneObject, light: Light) -> Edges:
    """Return the silhouette of a caster, with the vertices of the mesh that each edge joins."""
    outline = silhouette(caster.mesh, light.in_object_space(caster.object_to_world))
    return Edges(
        f"silhouette/{light.name}/{caster.name}",
        caster.world_positions[outline.edges].astype(np.float32),
        SILHOUETTE,
        {"vertices": outline.edges.tolist(), "multiplicity": outline.multiplicity.tolist()},
    )


def volume_surfaces(item: CasterVolume, light: Light, cut: float) -> list[Surface]:
    """Return sides, light cap and dark cap of a volume, which close it; cut where it reaches to infinity.

    For a light at infinity, an infinite volume has no dark cap: its sides meet in one point. A "cut" closes it instead.
    """
    volume, caster = item.volume, item.caster
    mesh = caster.mesh
    # sides come as coordinates: a number for each different position makes sides and caps share their vertices
    ids, first = weld(np.concatenate([mesh.positions, volume.sides[:, 0, :3], volume.sides[:, 1, :3]]))
    n, sides = len(mesh.positions), len(volume.sides)
    near = caster.world_positions[first]
    if len(volume.far_vertices) and volume.far_vertices[0, 3]:
        far = _placed(volume.far_vertices[first].astype(np.float64), caster)
    else:
        far = cut_at(near, light, cut)
    v, u = ids[n : n + sides], ids[n + sides :]
    behind = len(near)
    quads = np.stack([v, u, behind + u, behind + v], axis=1)
    facing, turned = ids[volume.light_cap], ids[volume.light_cap_reversed]
    positions = np.concatenate([near, far])
    one_far_point = volume.sides.shape[1] == 3
    start = f"volume/{light.name}/{caster.name}"
    dark = behind + np.concatenate([facing[:, ::-1], turned])
    return [
        surface(
            f"{start}/sides", positions[quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)], VOLUME, sides=sides, distance=cut
        ),
        surface(f"{start}/light cap", positions[np.concatenate([facing, turned[:, ::-1]])], VOLUME),
        surface(f"{start}/{'cut' if one_far_point else 'dark cap'}", positions[dark], VOLUME, drawn=not one_far_point),
    ]


def _placed(homogeneous: np.ndarray, caster: SceneObject) -> np.ndarray:
    """Return points (N, 4) of a caster's own space, w = 1, in world space (N, 3)."""
    placed: np.ndarray = (homogeneous @ caster.object_to_world.T)[:, :3]
    return placed


def frustum(name: str, camera: LightCamera) -> Surface:
    """Return what a camera of a light sees, from its near to its far plane, as a closed box."""
    right, up, forward = camera.frame
    corners = []
    for depth in (camera.near, camera.far):
        half = camera.half * (1.0 if camera.parallel else depth)
        middle = camera.eye + depth * forward
        corners += [middle + half * (x * right + y * up) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    quads = [(0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]
    triangles = np.array([triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))])
    return surface(name, np.array(corners)[triangles], FRUSTUM, near=camera.near, far=camera.far)


def wedge_surfaces(scene: Scene, light: Light, cut: float) -> Iterator[Surface]:
    """Yield the penumbra wedges of each caster, eight triangles for each silhouette edge.

    Wedges that are all of space have no surface; their number is in the notes.
    """
    assert light.shape is not None
    edges = silhouette_edges(scene.casters, light)
    starts = ["near" if name.endswith("left") else "moved" for names in TRIANGLES for name in names]
    at_near = np.array([name == "near" for name in starts]).reshape(-1, 3)
    for number, caster in enumerate(scene.casters):
        wedges = penumbra_wedges(edges.ends[edges.casters == number], light.position[:3], light.shape.bounding_radius)
        bounded = wedges[np.flatnonzero(~wedges.everywhere)]  # type: ignore[index]  # any index of an array
        corners = wedge_polyhedra(bounded)[0].astype(np.float64).reshape(-1, len(TRIANGLES), 3, 4)
        # a corner at infinity is on the ray from one of the edge's ends
        ends = np.where(at_near[..., None], bounded.near_end[:, None, None], bounded.moved_end[:, None, None])
        to_light = ends - light.position[:3]
        at_infinity = corners[..., 3:] == 0
        along = (to_light * corners[..., :3]).sum(axis=-1, keepdims=True)
        reach = -along + np.sqrt(np.maximum(along**2 + cut**2 - (to_light**2).sum(axis=-1, keepdims=True), 0))
        placed = np.where(at_infinity, ends + reach * corners[..., :3], corners[..., :3])
        name = f"wedges/{light.name}/{caster.name}"
        everywhere = int(wedges.everywhere.sum())
        yield surface(name, placed.reshape(-1, 3, 3), WEDGE, wedges=len(bounded), everywhere=everywhere)


# -- the cut -----------------------------------------------------------------------------------------------------------
def cut_at(points: np.ndarray, light: Light, distance: float) -> np.ndarray:
    """Return where the lines from a light through points (N, 3) are `distance` from it, or behind the points."""
    if light.is_directional:
        return np.asarray(points - distance * light.position[:3] / np.linalg.norm(light.position[:3]))
    from_light = points - light.position[:3]
    lengths = np.sqrt((from_light**2).sum(axis=1, keepdims=True))
    return np.asarray(light.position[:3] + from_light * (np.maximum(distance, lengths) / lengths))


def cut_distance(scene: Scene, light: Light) -> float:
    """Return a distance that leaves everything in the scene before the cut.

    The corners of a dark cap are all as far from the light, but its faces are flat and come nearer in their middle.
    """
    reach = scene_reach(scene, light)
    if light.is_directional or not scene.casters:
        return reach
    nearest_face = 1.0
    for caster in scene.casters:
        directions = caster.world_positions[caster.mesh.triangles] - light.position[:3]
        directions /= np.linalg.norm(directions, axis=2, keepdims=True)
        inner = [directions.mean(axis=1), *((directions[:, i] + directions[:, i - 1]) / 2 for i in range(3))]
        nearest_face = min(nearest_face, *(float(np.linalg.norm(each, axis=1).min()) for each in inner))
    return reach / max(nearest_face, 1 / FARTHEST_CUT)
