"""Scenes: their planes and positions, refused content, and warnings."""

import subprocess
import sys

import numpy as np
import pytest

from softshadow.errors import InsideOutMesh, LightInsideCaster, NonManifoldMesh, OpenMesh, SceneError
from softshadow.scene import Camera, Light, Material, Mesh, Scene, SceneObject, placement, shapes

CAMERA = Camera((3, 3, 5), (0, 0, 0))


def scene_of(mesh: Mesh, light: tuple = (3, 5, 2), **placed: object) -> Scene:
    floor = SceneObject(shapes.floor(), casts=False, receives=True)
    return Scene("test", CAMERA, [Light(light)], [floor, SceneObject(mesh, **placed)])


def test_plane_of_a_receiver_is_in_world_space_with_unit_normal() -> None:
    matrix = placement((1, 2, 3), (90, 1, 0, 0), (2, 3, 4))
    plane = SceneObject(shapes.floor(), matrix).plane
    assert plane == pytest.approx([0, 0, 1, -3], abs=1e-12)  # float64 inverse of a well-conditioned matrix


def test_solid_has_no_plane_and_is_no_receiver() -> None:
    assert SceneObject(shapes.box(), receives=True).plane is None
    scene = scene_of(shapes.box(), receives=True)
    assert [item.name for item in scene.receivers] == ["floor"]
    assert [item.name for item in scene.casters] == ["box"]


def test_equal_positions_stay_equal_in_world_space() -> None:
    mesh = shapes.sphere()
    item = SceneObject(mesh, placement((0.1, 0.2, 0.3), (33, 1, 2, 3), 0.7))
    first = mesh.topology.representatives[mesh.topology.vertex_ids]
    assert (item.world_positions == item.world_positions[first]).all()


@pytest.mark.parametrize(
    ("matrix", "said"),
    [
        (np.diag([-1.0, 1, 1, 1]), "positive determinant"),
        (np.diag([0.0, 1, 1, 1]), "positive determinant"),
        (np.diag([1.0, 1, 1, 2]), "last row 0 0 0 1"),
        (np.eye(3), "4x4"),
        (np.full((4, 4), np.nan), "finite"),
    ],
)
def test_impossible_matrix_is_refused(matrix: np.ndarray, said: str) -> None:
    with pytest.raises(SceneError, match=f"box: object_to_world: .*{said}"):
        SceneObject(shapes.box(), matrix)


def test_scene_needs_lights_and_objects_of_different_names() -> None:
    item, light = SceneObject(shapes.box()), Light((1, 2, 3))
    with pytest.raises(SceneError, match="lights: expected at least one, got none"):
        Scene("test", CAMERA, [], [item])
    with pytest.raises(SceneError, match="objects: expected at least one"):
        Scene("test", CAMERA, [light], [])
    with pytest.raises(SceneError, match="objects: expected different names, got box twice"):
        Scene("test", CAMERA, [light], [item, item])


def test_what_is_no_camera_light_or_object_is_refused_by_name() -> None:
    camera, light, box = Camera((0, 0, 5), (0, 0, 0)), Light((2, 5, 3)), SceneObject(shapes.box())
    with pytest.raises(TypeError, match=r"scene s: lights: expected a list of Light, got Light\('light'"):
        Scene("s", camera, light, [box])
    with pytest.raises(TypeError, match="scene s: objects: expected a list of SceneObject"):
        Scene("s", camera, [light], [shapes.box()])  # type: ignore[list-item]
    with pytest.raises(TypeError, match="scene s: camera=None: expected a Camera"):
        Scene("s", None, [light], [box])
    with pytest.raises(TypeError, match=r"mesh='bunny.obj': expected a Mesh, such as"):
        SceneObject("bunny.obj")


def test_shininess_beyond_gl_is_refused() -> None:
    with pytest.raises(SceneError, match="shininess: expected 0 to 128, got 200"):
        Material(shininess=200)


def test_scene_of_solids_has_no_warnings() -> None:
    assert scene_of(shapes.box(), object_to_world=placement((0, 1, 0))).warnings() == []


def test_open_mesh_is_named() -> None:
    (warning,) = scene_of(shapes.cylinder(capped=False)).warnings()
    assert isinstance(warning, OpenMesh)
    assert "cylinder: the mesh is open, 1 body: 64 boundary edges" in str(warning)


def test_non_manifold_mesh_is_named() -> None:
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, 0]]
    kinds = [type(item) for item in scene_of(Mesh(corners, [[0, 1, 2], [0, 1, 3], [0, 1, 4]])).warnings()]
    assert kinds == [OpenMesh, NonManifoldMesh]


def test_inside_out_mesh_is_named() -> None:
    box = shapes.box()
    (warning,) = scene_of(Mesh(box.positions, box.triangles[:, ::-1], name="sack")).warnings()
    assert isinstance(warning, InsideOutMesh)


@pytest.mark.parametrize(
    ("light", "inside"),
    [
        ((0, 1, 0), False),  # the hole of the torus
        ((0.7, 1, 0), True),
        ((0.7, 1, 0, 0), False),  # a direction is nowhere
        ((0.7, 1.3, 0), False),
    ],
)
def test_light_inside_a_nonconvex_caster_is_detected(light: tuple, inside: bool) -> None:
    warnings = scene_of(shapes.torus(0.7, 0.25), light, object_to_world=placement((0, 1, 0))).warnings()
    assert [type(item) for item in warnings] == [LightInsideCaster] * inside


def test_import_of_scenes_needs_no_heavy_package() -> None:
    code = "import softshadow.scene, sys; print([m for m in ('numba', 'trimesh', 'pydantic') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "[]"
