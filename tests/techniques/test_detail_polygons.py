"""Own and cast shadows as polygons on faces, compared with rays from the faces to the light."""

from collections.abc import Iterator
from dataclasses import replace
from unittest import mock

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softshadow.errors import SceneError
from softshadow.scene import Camera, Light, Mesh, Scene, SceneObject, placement, shapes
from softshadow.techniques import detail_polygons
from softshadow.techniques.detail_polygons import DetailPolygons, shadow_polygons
from softshadow.techniques.lit_faces import reached_faces, turned_triangles
from softshadow.techniques.plane_sweep import triangulate_nonzero
from softshadow.truth import casting_faces_between
from strategies import floor_scenes

# a point as near as that to an edge of a polygon, in shares of a face, is on neither side for sure: both are in double
# precision, but corners rounded to float32 lie as far from their face's plane as scene.plane.FLAT
BAND = 1e-5
# areas in shares of the face's: what is cut away by SLIVER, THIN and NEAREST together stays below
ROUNDING = 1e-5

FLOOR = SceneObject(shapes.floor(8), casts=False, receives=True, name="floor")
SCENE = Scene("test", Camera((3, 4, 5), (0, 0, 0), near=1, far=30), (Light((-2.5, 5, 1)),), (FLOOR,))
CROSSING = SceneObject(shapes.box(1), placement((0, 0.2, 0), (30, 1, 2, 3)), name="crossing")
RING = SceneObject(shapes.torus(0.7, 0.25, 8, 6), placement((0.5, 1.2, 0.3), (60, 1, 0, 0)), name="ring")
SHEET = SceneObject(shapes.floor(1), placement((0, 1, 0), (40, 1, 0, 1)), name="sheet")


def faces_of(scene: Scene, details: tuple[DetailPolygons, ...]) -> Iterator[tuple[int, int, np.ndarray, np.ndarray]]:
    """Yield object, face, corners (3, 3) as the light sees them and polygons (N, 3, 3) of every face it reaches."""
    for number, (thing, found) in enumerate(zip(scene.objects, details, strict=True)):
        reached = reached_faces(thing, scene.lights[0])
        for face, corners in zip(
            np.append(reached.facing, reached.reversed), turned_triangles(thing, reached), strict=True
        ):
            yield number, int(face), corners, found.cast[found.faces == face]


def barycentric(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return the coordinates (P, N, 3) of points in triangles, along the triangles' planes."""
    a, u, v = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normal = np.cross(u, v)
    squared = (normal**2).sum(axis=1)
    w = points[:, None] - a
    s = (np.cross(w, v) * normal).sum(axis=2) / squared
    t = (np.cross(u, w) * normal).sum(axis=2) / squared
    return np.stack([1 - s - t, s, t], axis=2)


def in_shadow(scene: Scene, points: np.ndarray, number: int, face: int) -> np.ndarray:
    """Return by rays which points of a face the light does not reach."""
    thing = scene.objects[number]
    caster = next((k for k, each in enumerate(scene.casters) if each is thing), -1)
    exclude = (np.full(len(points), caster), np.full(len(points), face))
    return casting_faces_between(points, scene.lights[0].position, scene.casters, exclude=exclude) > 0


def flat_areas(triangles: np.ndarray) -> float:
    return float(
        np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1).sum() / 2
    )


def covered(corners: np.ndarray, polygons: np.ndarray, lit: bool) -> np.ndarray:
    """Return triangles that cover, once, the polygons on a face, or with `lit` the rest of it."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    axis = int(np.abs(normal).argmax())
    plane = [(axis + 1) % 3, (axis + 2) % 3]
    loops = polygons[:, :, plane]
    chain = np.stack([loops, np.roll(loops, -1, axis=1)], axis=2).reshape(-1, 2, 2)
    low, high = corners[:, plane[1]].min(), corners[:, plane[1]].max()
    once = triangulate_nonzero(chain, low, high)
    if lit:
        # around the face once, and around what is covered once against it
        loops = np.concatenate([corners[None][:, :, plane], once[:, ::-1] if normal[axis] > 0 else once])
        once = triangulate_nonzero(np.stack([loops, np.roll(loops, -1, axis=1)], axis=2).reshape(-1, 2, 2), low, high)
    in_space = np.empty((len(once), 3, 3))
    in_space[:, :, plane] = once
    in_space[:, :, axis] = ((normal @ corners[0]) - once @ normal[plane]) / normal[axis]
    return in_space


scenes = st.one_of(
    floor_scenes(),
    st.permutations([CROSSING, RING, SHEET]).map(lambda things: replace(SCENE, objects=(FLOOR, *things[:2]))),
)


@settings(max_examples=12)
@given(scenes, st.sampled_from(detail_polygons.FORMS), st.integers(0, 10**6))
def test_a_point_is_in_a_polygon_of_its_face_just_where_the_ray_to_the_light_is_blocked(scene, form, seed) -> None:  # type: ignore[no-untyped-def]
    random, compared = np.random.default_rng(seed), 0
    for number, face, corners, polygons in faces_of(scene, shadow_polygons(scene, scene.lights[0], form)):
        points = random.dirichlet((1, 1, 1), 12) @ corners
        inside = barycentric(points, polygons).min(axis=2)
        size = np.sqrt(flat_areas(corners[None]))
        # the smallest coordinate times the height of the triangle is the distance from its nearest edge
        heights = [
            2 * flat_areas(one[None]) / np.linalg.norm(one - np.roll(one, 1, axis=0), axis=1).max() for one in polygons
        ]
        surely = (np.abs(inside) * np.array(heights) > BAND * size).all(axis=1)
        expected = in_shadow(scene, points, number, face)
        assert ((inside > 0).any(axis=1) == expected)[surely].all()
        compared += surely.sum()
    assert compared


@settings(max_examples=6)
@given(scenes)
def test_shadow_and_light_make_up_a_face_and_both_forms_have_the_same_union(scene: Scene) -> None:
    forms = [list(faces_of(scene, shadow_polygons(scene, scene.lights[0], form))) for form in detail_polygons.FORMS]
    for (number, face, corners, by_faces), (*_, by_silhouettes) in zip(*forms, strict=True):
        area = flat_areas(corners[None])
        union, light = covered(corners, by_faces, lit=False), covered(corners, by_faces, lit=True)
        assert flat_areas(union) == pytest.approx(flat_areas(by_silhouettes), abs=ROUNDING * area)
        assert flat_areas(union) + flat_areas(light) == pytest.approx(area, abs=ROUNDING * area)
        large = light[[flat_areas(one[None]) > ROUNDING * area for one in light]]
        assert not in_shadow(scene, large.mean(axis=1), number, face).any()


@pytest.mark.parametrize("form", detail_polygons.FORMS)
def test_polygons_are_the_same_for_every_camera(form: str) -> None:
    scene = replace(SCENE, objects=(FLOOR, RING, CROSSING))
    moved = replace(scene, camera=Camera((-2, 1, 4), (0.3, 1, 0), near=0.1, far=9))
    for one, other in zip(
        shadow_polygons(scene, scene.lights[0], form), shadow_polygons(moved, moved.lights[0], form), strict=True
    ):
        for key in ("own", "own_reversed", "cast", "faces"):
            assert getattr(one, key).tobytes() == getattr(other, key).tobytes()


def test_faces_that_look_away_are_in_their_own_shadow_and_receive_nothing() -> None:
    scene = replace(SCENE, objects=(FLOOR, RING))
    floor, ring = shadow_polygons(scene, scene.lights[0])
    assert not len(floor.own)
    assert len(ring.own) + len(reached_faces(RING, scene.lights[0]).facing) == len(RING.mesh.triangles)
    assert not np.isin(ring.faces, ring.own).any()
    for face in ring.own:
        middle = RING.world_positions[RING.mesh.triangles[face]].mean(axis=0)
        assert in_shadow(scene, middle[None], 1, int(face)).all()


def test_an_open_sheet_is_dark_on_one_side_and_lets_nothing_through() -> None:
    scene = replace(SCENE, objects=(FLOOR, SHEET))
    floor, sheet = shadow_polygons(scene, scene.lights[0])
    assert (len(sheet.own), len(sheet.own_reversed)) in ((0, 2), (2, 0))
    assert len(floor.cast)
    below = replace(scene, lights=(Light((0, -5, 0)),))
    floor, turned = shadow_polygons(below, below.lights[0])
    assert (len(turned.own), len(turned.own_reversed)) == (len(sheet.own_reversed), len(sheet.own))
    # the floor casts nothing, so it lets the light through to the sheet
    assert not len(turned.cast)
    assert not len(floor.own)


def test_what_is_behind_the_receiver_or_behind_the_light_casts_nothing() -> None:
    behind = SceneObject(shapes.box(0.5), placement((-2.5, 6, 1)), name="behind the light")
    below = SceneObject(shapes.box(0.5), placement((0, -1, 0)), name="below the floor")
    for form in detail_polygons.FORMS:
        floor, *_ = shadow_polygons(replace(SCENE, objects=(FLOOR, behind, below)), SCENE.lights[0], form)  # type: ignore[arg-type]
        assert not len(floor.cast)


def test_polygons_of_a_face_do_not_overlap_when_they_come_from_silhouettes() -> None:
    scene = replace(SCENE, objects=(FLOOR, RING, CROSSING))
    for _, _, corners, polygons in faces_of(scene, shadow_polygons(scene, scene.lights[0], "silhouettes")):
        once = covered(corners, polygons, lit=False)
        assert flat_areas(polygons) == pytest.approx(flat_areas(once), abs=ROUNDING * flat_areas(corners[None]))


def test_too_many_pairs_of_faces_are_refused_with_the_limit() -> None:
    scene = replace(SCENE, objects=(FLOOR, RING))
    with mock.patch.object(detail_polygons, "MOST_PAIRS", 100), pytest.raises(SceneError, match="expected at most 100"):
        shadow_polygons(scene, scene.lights[0])


def test_an_unknown_form_is_named() -> None:
    with pytest.raises(ValueError, match="form='loops': expected one of faces, silhouettes"):
        shadow_polygons(SCENE, SCENE.lights[0], "loops")  # type: ignore[arg-type]


def test_a_face_without_area_neither_casts_nor_receives() -> None:
    flat = Mesh([(0, 1, 0), (1, 1, 0), (2, 1, 0), (0, 1, 1), (1, 1, 1)], [(0, 1, 2), (0, 3, 4)], name="partly flat")
    scene = replace(SCENE, objects=(FLOOR, SceneObject(flat, name="partly flat")))
    floor, _ = shadow_polygons(scene, scene.lights[0])
    assert np.isfinite(floor.cast).all()
    assert len(floor.cast)
