"""The strategies generate all documented kinds of meshes and scenes; a clear error without Hypothesis."""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, find, given, settings

from softshadow.scene import Camera, Mesh, Scene
from softshadow.testing import cast_truth, strategies

FIND = settings(max_examples=300, phases=[Phase.generate], suppress_health_check=list(HealthCheck))


@given(strategies.sheets())
def test_a_sheet_is_open_and_oriented(mesh: Mesh) -> None:
    topology = mesh.topology
    assert topology.boundary_edges
    assert topology.misoriented_edges == topology.nonmanifold_edges == 0


@given(strategies.closed_meshes())
def test_a_closed_mesh_has_no_boundary(mesh: Mesh) -> None:
    assert mesh.topology.closed


def test_soups_have_boundaries_and_edges_of_many_faces() -> None:
    find(strategies.soups(), lambda mesh: mesh.topology.nonmanifold_edges > 0, settings=FIND)
    find(strategies.soups(), lambda mesh: mesh.topology.boundary_edges > 0, settings=FIND)
    find(strategies.soups(), lambda mesh: mesh.topology.misoriented_edges > 0, settings=FIND)


@pytest.mark.parametrize(("kind", "values"), [("point", {1.0}), ("directional", {0.0}), ("any", {0.0, 1.0})])
def test_lights_are_points_or_directions_as_asked(kind: str, values: set[float]) -> None:
    for value in values:
        find(strategies.lights(kind), lambda light, value=value: light[3] == value, settings=FIND)  # type: ignore[arg-type]

    @settings(max_examples=20)
    @given(strategies.lights(kind))  # type: ignore[arg-type]
    def only_these(light: np.ndarray) -> None:
        assert light[3] in values

    only_these()


def test_another_kind_of_light_is_refused() -> None:
    with pytest.raises(ValueError, match="kind: expected one of point, directional, any, got 'spot'"):
        strategies.lights("spot")  # type: ignore[arg-type]


@settings(max_examples=20)
@given(strategies.cameras())
def test_a_camera_looks_down_to_the_middle(camera: Camera) -> None:
    assert camera.eye[1] > camera.target[1]
    assert np.abs(camera.target).max() <= 1.5


@settings(max_examples=20)
@given(strategies.scenes(lights=2))
def test_a_scene_has_what_was_asked_for_and_its_casters_stand_above_the_floor(scene: Scene) -> None:
    assert [light.name for light in scene.lights] == ["light 0", "light 1"]
    assert scene.receivers
    for caster in scene.casters:
        assert np.isclose(np.ptp(caster.mesh.bounds, axis=0).max() * np.cbrt(np.linalg.det(caster.object_to_world)), 1)
        assert caster.world_positions[caster.mesh.triangles, 1].min() > 0


def test_casters_are_of_the_kind_asked_for() -> None:
    @settings(max_examples=10)
    @given(strategies.scenes(casters=strategies.closed_meshes()))
    def closed(scene: Scene) -> None:
        assert all(caster.mesh.topology.closed for caster in scene.casters)

    closed()


def test_without_hypothesis_an_error_says_what_to_install() -> None:
    code = (
        "import sys; sys.modules['hypothesis'] = None\n"
        "import softshadow.testing\n"
        "try:\n    from softshadow.testing import strategies\n"
        "except ModuleNotFoundError as error:\n    print(error)"
    )
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout
    assert "needs Hypothesis: pip install 'softshadow[properties]'" in said


@given(strategies.overlapping_scenes())
def test_slabs_above_each_other_overlap_as_often_as_there_are_slabs(scene):
    truth = cast_truth(scene, (64, 48))
    assert truth.counts[0].max() == len(scene.casters)
    # what writes a 1 in place of the parity is found out in every example
    wrong = (truth.counts[0] & 1) != (truth.counts[0] > 0)
    assert (wrong & ~truth.band()).any()
