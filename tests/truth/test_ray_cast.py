"""The oracle: casting faces are counted, shared edges once, the own plane never, in agreement with Embree."""

import time

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from paths import shared_file
from softshadow.scene import Mesh, Scene, SceneObject, placement, shapes
from softshadow.testing.strategies import SOLIDS
from softshadow.truth import casting_faces_between, first_faces
from softshadow.truth.triangle_tree import build_tree
from strategies import closed_meshes, lights, open_meshes

LIGHT = np.array([0.0, 10, 0, 1])
SUN = np.array([0.0, 1, 0, 0])


def brute_force(points: np.ndarray, light: np.ndarray, mesh: Mesh) -> np.ndarray:
    """Return the counts by Moeller & Trumbore 1997: every point against every face, without a rule for edges."""
    a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(float) for i in range(3))
    counts = np.zeros(len(points), dtype=int)
    for index, point in enumerate(points):
        direction = light[:3] - light[3] * point
        across = np.cross(direction, c - a)
        determinant = ((b - a) * across).sum(axis=1)
        usable = determinant != 0
        scale = 1 / np.where(usable, determinant, 1)
        u = ((point - a) * across).sum(axis=1) * scale
        second = np.cross(point - a, b - a)
        v = (second * direction).sum(axis=1) * scale
        t = ((c - a) * second).sum(axis=1) * scale
        hit = usable & (u > 0) & (v > 0) & (u + v < 1) & (t > 0) & ((t < 1) | (light[3] == 0))
        hit &= ~mesh.topology.closed_faces | ((mesh.face_normals * direction).sum(axis=1) > 0)
        counts[index] = hit.sum()
    return counts


@pytest.mark.interpreted
def test_point_under_a_box_counts_its_top() -> None:
    box = SceneObject(shapes.box(), placement((0, 2, 0)))
    points = np.array([[0.1, 0, 0.2], [3.0, 0, 0], [0.1, 2, 0.2], [0.1, 4, 0.2], [0.1, 20, 0.2]])
    for light in (LIGHT, SUN):
        assert casting_faces_between(points, light, [box]).tolist() == [1, 0, 1, 0, 0]
    assert casting_faces_between(points, SUN, [box], faces="all").tolist() == [2, 0, 1, 0, 0]
    assert casting_faces_between(points, SUN, [box], faces="front").tolist() == [1, 0, 1, 0, 0]
    assert casting_faces_between(points, LIGHT, [box], faces="all").tolist() == [2, 0, 1, 0, 0]
    below = np.array([0.0, -5, 0, 1])
    assert casting_faces_between(points, below, [box]).tolist() == [0, 0, 1, 1, 1]


@pytest.mark.interpreted
def test_open_caster_counts_every_face() -> None:
    tube = SceneObject(shapes.cylinder(capped=False), placement(turn=(90, 1, 0, 0)))
    point = np.array([[0.05, -3, 0.0]])
    assert casting_faces_between(point, LIGHT, [tube]).tolist() == [2]
    assert casting_faces_between(point, LIGHT, [tube], faces="front").tolist() == [1]


def test_no_caster_counts_nothing() -> None:
    assert casting_faces_between(np.zeros((2, 3)), LIGHT, []).tolist() == [0, 0]


@pytest.mark.interpreted
def test_segment_through_a_shared_edge_crosses_one_face() -> None:
    """Rays straight up through a subdivided floor: through edges, and through vertices where six faces meet."""
    grid = SceneObject(shapes.floor(4, cells=4), placement((0, 1, 0)))
    edges = np.array([[0.5, 0, 0.25], [0.25, 0, 1], [0.25, 0, 0.75], [-0.7, 0, -0.3]])
    assert casting_faces_between(edges, SUN, [grid]).tolist() == [1, 1, 1, 1]


@given(closed_meshes(), lights())
def test_segment_along_an_edge_enters_a_closed_mesh_as_often_as_it_leaves(mesh: Mesh, light: np.ndarray) -> None:
    """From far outside to a light far outside, a segment crosses as many fronts as backs, also along edges."""
    assume(light[:3].any())
    far = np.array([*(100 * light[:3] + [0.5, 0.25, 0.125]), 1.0])
    middles = mesh.positions[mesh.triangles].mean(axis=1)[:8].astype(float)
    points = middles - far[:3]
    caster = [SceneObject(mesh)]
    everything = casting_faces_between(points, far, caster, faces="all")
    front = casting_faces_between(points, far, caster, faces="front")
    assert (everything == 2 * front).all()


corner_weights = st.tuples(*[st.integers(0, 4)] * 3).filter(any)


@pytest.mark.interpreted
@given(st.sampled_from(sorted(SOLIDS)), st.integers(0, 1000), corner_weights, corner_weights)
@example("ball", 3, (1, 0, 0), (1, 1, 1))
def test_segment_in_the_plane_of_a_face_enters_a_closed_mesh_as_often_as_it_leaves(
    name: str, number: int, one: tuple[int, ...], other: tuple[int, ...]
) -> None:
    """Whole numbers, so that the ray runs in the plane of a face exactly, through its edges or its corners."""
    solid = SOLIDS[name]
    mesh = Mesh(np.rint(20 * solid.positions), solid.triangles)
    a, b, c = mesh.positions[mesh.triangles[number % len(mesh.triangles)]].astype(np.float64)
    ways = [weights @ np.array([a, b, c]) * sum(others) for weights, others in ((one, other), (other, one))]
    toward = ways[1] - ways[0]
    assume(toward.any())
    start, direction = (a - 64 * toward)[None], np.array([*toward, 0.0])
    everything, front = (
        int(casting_faces_between(start, direction, [SceneObject(mesh)], faces=faces)[0]) for faces in ("all", "front")
    )
    assert everything == 2 * front


grid_points = st.lists(st.tuples(*[st.integers(-32, 32)] * 3), min_size=1, max_size=20)


@given(st.one_of(closed_meshes(), open_meshes()), lights(), grid_points)
def test_counts_equal_those_of_brute_force(mesh: Mesh, light: np.ndarray, points: list) -> None:
    # point and light lie off the grid of the vertices, so that no segment hits an edge or ends on a face
    light = np.add(light, [0.0031, 0.0017, 0.0043, 0])
    start = np.add(np.array(points) / 8, [0.0123456789, 0.0217171717, 0.0371313131])
    counts = casting_faces_between(start, light, [SceneObject(mesh)])
    assert (counts == brute_force(start, light, mesh)).all()


def test_counts_of_several_casters_add() -> None:
    scene = Scene.named("overlapping")
    points = np.random.default_rng(1).uniform([-2, 0, -2], [2, 0.5, 2], (200, 3))
    light = scene.lights[0].position
    together = casting_faces_between(points, light, scene.casters)
    assert together.max() == 2
    assert (together == sum(casting_faces_between(points, light, [item]) for item in scene.casters)).all()


@pytest.mark.interpreted
def test_own_face_and_faces_in_its_plane_do_not_count() -> None:
    """Rounding may put a point below its own face, and below neighbouring faces in the same plane."""
    floor = SceneObject(shapes.floor(4, cells=8), placement((0, 1, 0), (33, 1, 2, 3)))
    corners = floor.world_positions[floor.mesh.triangles]
    sunk = corners.mean(axis=1) - 1e-7 * floor.plane[:3]
    numbers = np.arange(len(sunk))
    light = np.append(np.add(floor.plane[:3], [0.3, 0.2, 0.1]), 0)
    assert casting_faces_between(sunk, light, [floor]).tolist() == [1] * len(sunk)
    assert casting_faces_between(sunk, light, [floor], exclude=(0 * numbers, numbers)).tolist() == [0] * len(sunk)
    assert casting_faces_between(sunk, light, [floor], exclude=(0 * numbers - 1, numbers)).tolist() == [1] * len(sunk)


def test_lit_side_of_a_sphere_is_lit_and_its_dark_side_counts_one() -> None:
    ball = SceneObject(shapes.sphere(1, 24, 12))
    triangles = np.arange(len(ball.mesh.triangles))
    points = ball.world_positions[ball.mesh.triangles].mean(axis=1)
    counts = casting_faces_between(points, LIGHT, [ball], exclude=(0 * triangles, triangles))
    facing = ((LIGHT[:3] - points) * ball.mesh.face_normals).sum(axis=1)
    assert (counts == (facing < 0)).all()


@pytest.mark.interpreted
def test_open_face_seen_from_behind_is_in_its_own_shadow() -> None:
    sheet = [SceneObject(shapes.floor(2), placement((0, 1, 0)))]
    point, own = np.array([[0.1, 1, 0.3]]), (np.array([0]), np.array([0]))
    below, above = np.array([0.0, -3, 0]), np.array([0.0, 5, 0])
    assert casting_faces_between(point, SUN, sheet, exclude=own, viewer=below).tolist() == [1]
    assert casting_faces_between(point, SUN, sheet, exclude=own, viewer=above).tolist() == [0]
    assert casting_faces_between(point, -SUN, sheet, exclude=own, viewer=above).tolist() == [1]
    assert casting_faces_between(point, SUN, sheet, exclude=own).tolist() == [0]
    assert casting_faces_between(point, SUN, sheet, viewer=below).tolist() == [0]


def test_dark_side_of_a_closed_caster_does_not_count_itself() -> None:
    ball = SceneObject(shapes.sphere(1, 24, 12))
    triangles = np.arange(len(ball.mesh.triangles))
    points = ball.world_positions[ball.mesh.triangles].mean(axis=1)
    own = 0 * triangles, triangles
    far_away = np.array([5.0, -30, 7])
    plain = casting_faces_between(points, LIGHT, [ball], exclude=own)
    seen = ((far_away - points) * ball.mesh.face_normals).sum(axis=1) > 0
    assert (casting_faces_between(points, LIGHT, [ball], exclude=own, viewer=far_away)[seen] == plain[seen]).all()


def test_first_face_of_a_ray_is_the_nearest() -> None:
    scene = Scene.named("boxes")
    eye = np.broadcast_to(scene.camera.eye, (1, 3))
    objects, triangles, distances = first_faces(eye, scene.camera.target - eye, scene.objects)
    point = eye[0] + distances[0] * (scene.camera.target - eye)[0]
    nearest = scene.objects[objects[0]]
    corner = nearest.world_positions[nearest.mesh.triangles[triangles[0]]]
    normal = np.cross(corner[1] - corner[0], corner[2] - corner[0])
    assert abs((point - corner[0]) @ normal) < 1e-12  # float64 rounding at a distance of 6
    assert first_faces(eye, np.array([[0.0, 1, 0]]), scene.objects)[0].tolist() == [-1]


def test_tree_holds_every_triangle_once() -> None:
    objects = Scene.named("room").objects
    tree = build_tree(objects)
    assert sorted(zip(tree.objects.tolist(), tree.triangles.tolist(), strict=True)) == [
        (index, triangle) for index, item in enumerate(objects) for triangle in range(len(item.mesh.triangles))
    ]
    leaves = len(tree.boxes) // 2
    assert (tree.boxes[1, 0] <= tree.corners.reshape(-1, 3)).all()
    assert (tree.boxes[leaves : leaves + len(tree.corners), 1] >= tree.corners.max(axis=1)).all()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"points": np.zeros(3)}, r"points: expected shape \(N, 3\), got \(3,\)"),
        ({"light": np.zeros(3)}, "light: expected four numbers"),
        ({"faces": "back"}, "faces: expected one of casting, all, front, got 'back'"),
        ({"exclude": (np.zeros(1, int), np.zeros(1, int))}, r"exclude: expected two arrays of shape \(2,\)"),
    ],
)
def test_misuse_names_the_argument(arguments: dict, said: str) -> None:
    complete = {"points": np.zeros((2, 3)), "light": LIGHT, "casters": [SceneObject(shapes.box())], **arguments}
    with pytest.raises(ValueError, match=said):
        casting_faces_between(**complete)


@pytest.mark.parametrize("name", ["stanford-bunny.obj", "teapot.obj", "Duck.glb"])
def test_shadows_agree_with_embree(name: str) -> None:
    embree = pytest.importorskip("embreex.rtcore_scene")
    triangle_mesh = pytest.importorskip("embreex.mesh_construction")
    scene = Scene.from_mesh(shared_file(f"meshes/{name}"))
    light = scene.lights[0].position[:3]
    caster = scene.casters[0]
    embree_scene = embree.EmbreeScene()
    corners = caster.world_positions[caster.mesh.triangles].astype(np.float32)
    triangle_mesh.TriangleMesh(embree_scene, corners)

    points = np.random.default_rng(2).uniform([-3, 0, -3], [3, 0, 3], (3000, 3)).astype(np.float32)
    # from the light to the floor; the caster stands above it, so a hit is always before the point
    origins = np.tile(light.astype(np.float32), (len(points), 1))
    hit = embree_scene.run(origins, (points - light).astype(np.float32)) >= 0
    shadowed = casting_faces_between(points.astype(np.float64), scene.lights[0].position, [caster], faces="all") > 0
    assert shadowed.sum() > 100
    # Embree's rays are float32: a few of 3000 pass an outline on the other side
    assert (hit != shadowed).sum() <= 6


def test_bunny_is_counted_quickly() -> None:
    """69 451 faces and 64 x 48 points take 0.1 s with the tree; the bound is loose."""
    scene = Scene.from_mesh(shared_file("meshes/stanford-bunny.obj"))
    points = np.random.default_rng(3).uniform([-2, 0, -2], [2, 0, 2], (64 * 48, 3))
    light = scene.lights[0].position
    casting_faces_between(points[:1], light, scene.casters)
    start = time.perf_counter()
    casting_faces_between(points, light, scene.casters)
    assert time.perf_counter() - start < 3
