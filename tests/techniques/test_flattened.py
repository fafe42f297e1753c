"""The planar shadow matrix, and what is cut away before it."""

import numpy as np
import pytest
from hypothesis import given

from softshadow import matrices
from softshadow.techniques.flattened import proper_planes
from strategies import coordinates, planes_and_lights

# double precision over products of three numbers up to about 10
ROUNDING = 1e-10


@given(planes_and_lights())
def test_flattening_twice_is_flattening_once(plane_and_light: tuple[np.ndarray, np.ndarray]) -> None:
    plane, light = plane_and_light
    matrix = matrices.planar_shadow(plane, light)
    assert np.allclose(matrix @ matrix, abs(plane @ light) * matrix, rtol=0, atol=ROUNDING * np.abs(matrix).max() ** 2)


@given(planes_and_lights(), coordinates(-2, 2), coordinates(-2, 2), coordinates(-2, 2))
def test_the_shadow_of_a_point_is_on_the_plane_and_on_the_light_ray(plane_and_light, x, y, z) -> None:  # type: ignore[no-untyped-def]
    plane, light = plane_and_light
    point = np.array([x, y, z, 1])
    shadow = matrices.planar_shadow(plane, light) @ point
    assert abs(plane @ shadow) <= ROUNDING * max(1, np.abs(shadow).max())
    # light, point and shadow are collinear: as homogeneous vectors they span two dimensions only
    span = np.linalg.svd(np.array([light, point, shadow]), compute_uv=False)
    assert span[2] <= ROUNDING * max(1, span[0])


@given(planes_and_lights(), coordinates(-2, 2), coordinates(-2, 2), coordinates(-2, 2))
def test_the_shadow_has_positive_w_just_where_a_point_is_before_the_light(plane_and_light, x, y, z) -> None:  # type: ignore[no-untyped-def]
    plane, light = plane_and_light
    point = np.array([x, y, z, 1])
    height, light_height = np.sign(plane @ light) * (plane @ point), abs(plane @ light)
    w = (matrices.planar_shadow(plane, light) @ point)[3]
    assert np.isclose(w, light_height - light[3] * height, rtol=0, atol=ROUNDING)


def test_the_matrices_of_the_slides_are_this_one_up_to_their_sign() -> None:
    x, y, z, a, b, c, d = 2.0, 5.0, 3.0, 0.5, 1.0, -0.25, 0.75
    height = a * x + b * y + c * z + d
    assert height > 0
    at_a_point = np.array(
        [
            [-d - b * y - c * z, x * b, x * c, x * d],
            [y * a, -d - a * x - c * z, y * c, y * d],
            [z * a, z * b, -d - a * x - b * y, z * d],
            [a, b, c, -a * x - b * y - c * z],
        ]
    )
    assert np.allclose(matrices.planar_shadow([a, b, c, d], [x, y, z, 1]), -at_a_point)  # E35
    along_a_direction = np.array(
        [
            [b * y + c * z, -b * x, -c * x, -d * x],
            [-a * y, a * x + c * z, -c * y, -d * y],
            [-a * z, -b * z, a * x + b * y, -d * z],
            [0, 0, 0, a * x + b * y + c * z],
        ]
    )
    assert np.allclose(matrices.planar_shadow([a, b, c, d], [x, y, z, 0]), along_a_direction)  # E36
    onto_the_floor = np.array([[y, -x, 0, 0], [0, 0, 0, 0], [0, -z, y, 0], [0, -1, 0, y]])
    assert np.allclose(matrices.planar_shadow([0, 1, 0, 0], [x, y, z, 1]), onto_the_floor)  # E37


def test_a_light_in_the_plane_has_no_matrix() -> None:
    with pytest.raises(ValueError, match="lies in the plane"):
        matrices.planar_shadow([0, 1, 0, -2], [1, 2, 3, 1])


@given(planes_and_lights(), coordinates(-2, 2), coordinates(-2, 2), coordinates(-2, 2))
def test_a_point_casts_properly_between_plane_and_light(plane_and_light, x, y, z) -> None:  # type: ignore[no-untyped-def]
    plane, light = plane_and_light
    point = np.array([x, y, z, 1.0])
    ratio = (plane @ point) / (plane @ light)  # 0 on the plane, 1 at a point light's height
    proper = (proper_planes(plane, light) @ point >= 0).all()
    if min(abs(ratio), abs(ratio - 1)) > ROUNDING:
        assert proper == (ratio > 0 and (light[3] == 0 or ratio < 1))


def test_points_at_infinity_are_kept_by_the_infinite_projection() -> None:
    projection = matrices.infinite_perspective(40, 4 / 3, 0.5).astype(np.float32)
    for direction in np.random.default_rng(1).normal(size=(100, 3)).astype(np.float32):
        clip = projection @ np.append(direction, np.float32(0))
        assert clip[2] == clip[3]  # z = w: on the far plane, which counts as inside
    near = projection @ np.array([0, 0, -0.5, 1], np.float32)
    assert near[2] == -near[3]
