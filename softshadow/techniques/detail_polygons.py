"""Own and cast shadows as polygons on the faces of a scene, computed once for every camera.

A face turned away from the light is in shadow as a whole (its *own* shadow). On a face that the light reaches, the
others *cast*: the parts between it and the light are cut out by the pyramid which the two span, and flattened onto the
face. Only faces that the light reaches cast or receive.

References
----------
Atherton, Weiler & Greenberg 1978, "Polygon shadow generation", for shadows as detail polygons.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from softshadow.errors import SceneError
from softshadow.scene import CastingFaces, Light, Scene, SceneObject
from softshadow.scene.plane import FLAT
from softshadow.scene.silhouette import light_distances
from softshadow.techniques.clipping import clip_to_planes, clip_to_planes_with_sources, pyramid_between
from softshadow.techniques.flattened import flattened_points
from softshadow.techniques.lit_faces import LitFaces, lit_faces, reached_faces, turned_triangles
from softshadow.techniques.silhouette_polygons import inside_of_silhouettes

Form = Literal["faces", "silhouettes"]
FORMS: tuple[Form, ...] = ("faces", "silhouettes")

# every casting face is compared with every receiving one: 4096 of each take some seconds
MOST_PAIRS = 1 << 24
# a polygon below this share of its face's area comes from rounding at a common edge, and covers no sample
SLIVER = 1e-12


@dataclass(frozen=True, eq=False)
class DetailPolygons:
    """The shadows of one light on one object; they do not depend on the camera.

    Attributes
    ----------
    own : (O,) int32              faces whose front, as the mesh stores them, is in shadow as a whole
    own_reversed : (R,) int32     faces of open bodies whose back, as the mesh stores them, is in shadow as a whole
    cast : (N, 3, 3) float64      world space; triangles in shadow on faces that the light reaches, counter-clockwise
                                  seen from the light; in the form "faces" those of different casters may overlap
    faces : (N,) int32            the face that each triangle of `cast` lies on, ascending
    casters, caster_faces : (N,) int32   place among the scene's casters, and face, that each triangle is the shadow
                                  of; -1 in the form "silhouettes", whose triangles may be shadows of several
    """

    own: np.ndarray
    own_reversed: np.ndarray
    cast: np.ndarray
    faces: np.ndarray
    casters: np.ndarray
    caster_faces: np.ndarray


def shadow_polygons(scene: Scene, light: Light, form: Form = "faces") -> tuple[DetailPolygons, ...]:
    """Return the shadow polygons of a light, one entry for each object of the scene.

    Parameters
    ----------
    form : "faces"                every casting face is flattened onto every face that it shadows
           "silhouettes"          the silhouettes of the casters are flattened, and their inside is cut into triangles
                                  that do not overlap

    Raises
    ------
    SceneError                    more pairs of casting and receiving faces than `MOST_PAIRS`

    Examples
    --------
    >>> from softshadow import Scene
    >>> scene = Scene.named("boxes")
    >>> floor, cube, *_ = shadow_polygons(scene, scene.lights[0])
    >>> len(floor.own), len(cube.own)  # three sides of the cube are in its own shadow
    (0, 6)
    """
    if form not in FORMS:
        raise ValueError(f"form={form!r}: expected one of {', '.join(FORMS)}")
    casters = [lit_faces(thing, light) for thing in scene.casters]
    reached = [reached_faces(thing, light) for thing in scene.objects]
    pairs = sum(len(faces.facing) + len(faces.reversed) for faces in reached) * sum(len(c.triangles) for c in casters)
    if pairs > MOST_PAIRS:
        raise SceneError(
            f"scene {scene.name}: {pairs} pairs of a casting and a receiving face; expected at most {MOST_PAIRS} "
            "(softshadow.techniques.detail_polygons.MOST_PAIRS), since all are compared; volumes and maps take more"
        )
    return tuple(
        polygons_on(thing, faces, light, casters, form) for thing, faces in zip(scene.objects, reached, strict=True)
    )


def polygons_on(
    thing: SceneObject, reached: CastingFaces, light: Light, casters: Sequence[LitFaces], form: Form
) -> DetailPolygons:
    """Return the shadow polygons on one object."""
    away = light_distances(thing.mesh, light.in_object_space(thing.object_to_world)) <= 0
    own = np.flatnonzero(away & thing.casts).astype(np.int32)
    own_reversed = reached.facing[~thing.mesh.topology.closed_faces[reached.facing] & thing.casts]
    flat = FLAT * float(np.ptp(thing.world_positions, axis=0).max())
    numbers = np.concatenate([reached.facing, reached.reversed])
    on_faces = [cast_on(face, light, casters, form, flat) for face in turned_triangles(thing, reached)]
    faces = np.repeat(numbers, [len(each.polygons) for each in on_faces])
    order = np.argsort(faces, kind="stable")
    cast = np.concatenate([np.zeros((0, 3, 3)), *(each.polygons for each in on_faces)])[order]
    sources = np.concatenate([np.zeros((0, 2), np.int32), *(each.sources for each in on_faces)])[order]
    return DetailPolygons(own, own_reversed, cast, faces[order], *np.ascontiguousarray(sources.T))


class CastPolygons(NamedTuple):
    """Shadow polygons (N, 3, 3) on one face, and the caster and the face of it that each is the shadow of (N, 2)."""

    polygons: np.ndarray
    sources: np.ndarray


def cast_on(face: np.ndarray, light: Light, casters: Sequence[LitFaces], form: Form, flat: float) -> CastPolygons:
    """Return the shadow polygons of the casters on a face (3, 3) that is turned towards the light.

    Faces within a distance of `flat` from the face's plane cast nothing on it: the face itself, and those beside it.
    """
    pyramid = pyramid_between(light.position, face)
    normal = np.cross(face[1] - face[0], face[2] - face[0])
    doubled_area = float(np.linalg.norm(normal))
    plane = pyramid[-1] / doubled_area
    between = [faces_between(caster.triangles, pyramid, flat * doubled_area) for caster in casters]
    met = [caster.triangles[chosen] for caster, chosen in zip(casters, between, strict=True)]
    if form == "silhouettes":
        shading = [caster for caster, triangles in zip(casters, met, strict=True) if len(triangles)]
        polygons = clip_to_planes(inside_of_silhouettes(shading, face, plane, light, flat), pyramid[:-1])
        sources = np.full((len(polygons), 2), -1, np.int32)
    else:
        # the pyramid lies between the face and the light: c1 >= 0 and c2 > 0 hold inside
        clipped, of = clip_to_planes_with_sources(np.concatenate([np.zeros((0, 3, 3)), *met]), pyramid)
        polygons = flattened_points(clipped, plane, light.position)
        numbers = [np.concatenate([c.faces.facing, c.faces.reversed])[i] for c, i in zip(casters, between, strict=True)]
        owners = np.repeat(np.arange(len(casters)), [len(each) for each in numbers])
        sources = np.column_stack([owners, np.concatenate([np.zeros(0, np.int32), *numbers])])[of].astype(np.int32)
    areas = np.linalg.norm(np.cross(polygons[:, 1] - polygons[:, 0], polygons[:, 2] - polygons[:, 0]), axis=1)
    large = areas > SLIVER * doubled_area
    return CastPolygons(polygons[large], sources[large])


def faces_between(triangles: np.ndarray, pyramid: np.ndarray, flat: float) -> np.ndarray:
    """Return which triangles (C,) bool may have a part inside the pyramid and do not lie in its base."""
    heights = triangles @ pyramid[:, :3].T + pyramid[:, 3]
    return ~(heights <= 0).all(axis=1).any(axis=1) & (np.abs(heights[:, :, -1]) > flat).any(axis=1)
