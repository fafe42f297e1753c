"""Lights, cameras and placements: coordinates in other spaces, and refused arguments."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow.errors import SceneError
from softshadow.scene import Camera, Light, placement
from strategies import lights

angles = st.integers(0, 359)
axes = st.tuples(*[st.integers(-3, 3)] * 3).filter(any)


def test_three_numbers_are_a_point_and_four_are_homogeneous() -> None:
    assert Light((1, 2, 3)).position.tolist() == [1, 2, 3, 1]
    assert Light((2, 4, 6, 2)).position.tolist() == [1, 2, 3, 1]
    assert Light((1, 2, 3, 0)).is_directional


@given(lights(), angles, axes, st.sampled_from([0.25, 1, 40]))
def test_light_in_object_space_transforms_back_to_world_space(
    light: np.ndarray, angle: float, axis: tuple, scale: float
) -> None:
    object_to_world = placement((1, -2, 3), (angle, *axis), scale)
    position = Light(light).in_object_space(object_to_world)
    assert position[3] == Light(light).position[3]  # exactly: a direction must not become a far point
    # a 4x4 product in float64 with entries up to 40
    assert object_to_world @ position == pytest.approx(Light(light).position, abs=1e-12)


def test_spot_shines_within_its_cone_and_other_lights_everywhere() -> None:
    spot = Light((0, 2, 0), axis=(0, -3, 0), cutoff=45)
    assert spot.is_spot
    assert spot.axis is not None
    assert spot.axis.tolist() == [0, -1, 0]
    points = np.array([[0, 0, 0], [1.9, 0, 0], [2.1, 0, 0], [0, 4, 0]])
    assert spot.shines_on(points).tolist() == [True, True, False, False]
    for light in (Light((0, 2, 0)), Light((0, 1, 0, 0))):
        assert not light.is_spot
        assert light.shines_on(points).all()


@pytest.mark.parametrize(
    ("cone", "said"),
    [
        ({"axis": (0, -1, 0)}, "an axis and a cutoff of more than 0 and at most 90"),
        ({"cutoff": 30}, "an axis and a cutoff"),
        ({"axis": (0, -1, 0), "cutoff": 91}, "at most 90 degrees, got"),
        ({"axis": (0, 0, 0), "cutoff": 30}, "axis: expected a direction"),
        ({"axis": (0, -1, 0), "cutoff": 30, "position": (0, 1, 0, 0)}, "a light at infinity has no cone"),
    ],
)
def test_impossible_cone_is_refused(cone: dict[str, object], said: str) -> None:
    with pytest.raises(SceneError, match=f"lamp: .*{said}"):
        Light(**{"position": (0, 2, 0), **cone}, name="lamp")


@pytest.mark.parametrize("position", [(1, 2), (0, 0, 0, 0), (1, 2, 3, -1), (1, np.nan, 3), "above", (1, "b", 2)])
def test_malformed_position_is_named(position: object) -> None:
    with pytest.raises(SceneError, match="lamp: position: expected"):
        Light(position, name="lamp")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"target": (1, 2, 3)}, "eye and target are both"),
        ({"up": (1, 2, 3)}, "up .* is parallel to the view direction"),
        ({"up": (0, 0, 0)}, "up .* is parallel"),
        ({"fov_y": 180}, "fov_y: expected degrees between 0 and 180, got 180"),
        ({"near": 0}, "0 < near < far, got near 0"),
        ({"near": 5, "far": 5}, "0 < near < far"),
        ({"eye": (1, 2)}, "eye: expected 3 finite numbers"),
        ({"far": np.inf}, "far: expected 1 finite numbers"),
    ],
)
def test_impossible_camera_is_named(change: dict, said: str) -> None:
    with pytest.raises(SceneError, match=f"camera: .*{said}"):
        Camera(**{"eye": (1, 2, 3), "target": (0, 0, 0), **change})


def test_near_points_of_the_corners_span_the_field_of_view() -> None:
    camera = Camera((0, 0, 5), (0, 0, 0), fov_y=90, near=2)
    corners = camera.near_points(np.array([[0, 0], [200, 100], [100, 50]], dtype=float), (200, 100))
    assert corners == pytest.approx(np.array([[-4, 2, 3], [4, -2, 3], [0, 0, 3]]))  # top left first: window y down


@given(angles, axes)
def test_placement_turns_without_stretching(angle: float, axis: tuple) -> None:
    rotation = placement(turn=(angle, *axis))[:3, :3]
    assert rotation @ rotation.T == pytest.approx(np.eye(3), abs=1e-14)  # a few float64 roundings
    assert np.linalg.det(rotation) == pytest.approx(1)
    assert rotation @ axis == pytest.approx(axis)


def test_placement_scales_then_turns_then_moves() -> None:
    matrix = placement(move=(10, 0, 0), turn=(90, 0, 0, 1), scale=(2, 1, 1))
    assert matrix @ [1, 0, 0, 1] == pytest.approx([10, 2, 0, 1])


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"scale": 0}, "scale: expected positive"),
        ({"scale": (1, -1, 1)}, "scale: expected positive"),
        ({"turn": (90, 0, 0, 0)}, "turn: expected an axis"),
        ({"move": (1, 2)}, "move: expected 3"),
        ({"turn": "left"}, "turn: expected 4"),
    ],
)
def test_impossible_placement_is_named(arguments: dict, said: str) -> None:
    with pytest.raises(SceneError, match=said):
        placement(**arguments)
