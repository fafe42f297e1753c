"""The slides' matrices are one matrix; what they leave open is its sign."""

import numpy as np
import pytest

from softshadow import matrices
from softshadow.listings.projection import along_direction, along_rays, from_origin, from_point, onto_ground

ROUNDING = 1e-14  # of float64: a handful of products and sums of numbers below 10
PLANE = np.array([0.5, 2.0, -1.0, 3.0])
LIGHT = np.array([2.0, 5.0, 1.5])
POINT, DIRECTION = np.array([*LIGHT, 1.0]), np.array([*LIGHT, 0.0])


def translation(way):
    matrix = np.eye(4)
    matrix[:3, 3] = way
    return matrix


def sign(plane, light):
    """Return the sign that `planar_shadow` gives the plane."""
    return np.sign(np.asarray(plane) @ light)


def test_e35_matrix_of_a_point_is_minus_the_shadow_matrix():
    expected = -sign(PLANE, POINT) * matrices.planar_shadow(PLANE, POINT)
    np.testing.assert_allclose(from_point(PLANE, LIGHT), expected, rtol=ROUNDING)
    assert (from_point(PLANE, LIGHT) @ [0, 1, 0, 1])[3] < 0  # a caster between light and plane: clipped


def test_matrix_of_a_point_is_the_one_of_the_origin_between_two_translations():
    """The plane's d becomes d + a x + b y + c z when the light is moved to the origin (CA:376)."""
    moved = [*PLANE[:3], PLANE @ POINT]
    product = translation(LIGHT) @ from_origin(moved) @ translation(-LIGHT)
    np.testing.assert_allclose(product, from_point(PLANE, LIGHT), rtol=ROUNDING)


@pytest.mark.parametrize("towards", [1.0, -1.0])
def test_e36_matrix_of_a_direction_keeps_casters_if_it_points_towards_the_light(towards):
    expected = sign(PLANE, DIRECTION) * matrices.planar_shadow(PLANE, DIRECTION)
    np.testing.assert_allclose(along_direction(PLANE, towards * LIGHT), towards * expected, rtol=ROUNDING)
    assert (along_direction(PLANE, towards * LIGHT) @ [0, 1, 0, 1])[3] * towards > 0


def test_e37_matrix_onto_the_ground_has_the_right_sign():
    expected = matrices.planar_shadow(np.array([0.0, 1.0, 0.0, 0.0]), POINT)
    np.testing.assert_array_equal(onto_ground(LIGHT), expected)


def test_e21_rays_end_where_the_matrix_puts_a_vertex_whatever_side_it_is_on():
    points = np.array([[0.0, 1.0, 0.0], [0.0, 7.0, 1.0], [1.0, -2.0, 0.0]])  # between, above the lamp, below the ground
    homogeneous = np.column_stack([points, np.ones(3)]) @ onto_ground(LIGHT).T
    np.testing.assert_allclose(along_rays(points, LIGHT), homogeneous[:, :3] / homogeneous[:, 3:], atol=ROUNDING)
    assert (np.sign(homogeneous[:, 3]) == [1, -1, 1]).all()  # GL clips the second of them and not the third
