"""GL's matrices: what they map where in double precision, and Mesa's bits in single precision."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given

from softshadow import gl, matrices
from softshadow.testing import run_on_mesa
from strategies import axes_and_angles, cameras

CLOSE = 1e-12  # float64 rounding of a handful of operations on numbers up to about 10
CASES = 40  # random matrices of each maker, for each start


@given(axes_and_angles())
def test_rotation_keeps_lengths_and_its_axis(turn):
    angle, axis = turn
    matrix = matrices.rotation(angle, *axis, real=np.float64)
    np.testing.assert_allclose(matrix @ matrix.T, np.eye(4), atol=CLOSE)
    np.testing.assert_allclose(matrix[:3, :3] @ axis, axis, atol=CLOSE * 10)


@given(axes_and_angles())
def test_rotations_about_one_axis_add_their_angles(turn):
    angle, axis = turn
    first, second = (matrices.rotation(a, *axis, real=np.float64) for a in (angle, 30))
    both = matrices.rotation(angle + 30, *axis, real=np.float64)
    np.testing.assert_allclose(matrices.multiply(first, second), both, atol=CLOSE)


@given(cameras())
def test_view_puts_the_eye_at_the_origin_and_the_centre_on_the_negative_z_axis(camera):
    eye, center, up = camera
    view = matrices.look_at(np.eye(4), eye, center, up)
    np.testing.assert_allclose(view @ [*eye, 1], [0, 0, 0, 1], atol=CLOSE * 100)
    seen = view @ [*center, 1]
    distance = np.linalg.norm(np.subtract(center, eye))
    np.testing.assert_allclose(seen, [0, 0, -distance, 1], atol=CLOSE * 100)


@pytest.mark.parametrize("real", [np.float32, np.float64])
def test_frustum_and_box_become_the_clip_cube(real):
    box = (-2, 1, -1, 3, 0.5, 8)
    left, right, bottom, top, near, far = box
    corners = {(left, bottom, -near): (-1, -1, -1), (right, top, -near): (1, 1, -1)}
    for corner, expected in (*corners.items(), ((left, top, -far), (-1, 1, 1))):
        clip = matrices.ortho(*box, real=real) @ np.array([*corner, 1], real)
        np.testing.assert_allclose(clip, [*expected, 1], atol=1e-6)
    for corner, expected in corners.items():
        clip = matrices.frustum(*box, real=real) @ np.array([*corner, 1], real)
        np.testing.assert_allclose(clip[:3] / clip[3], expected, atol=1e-6)


def test_perspective_is_a_symmetric_frustum():
    top = 0.5 * np.tan(np.radians(30))
    frustum = matrices.frustum(-top * 1.5, top * 1.5, -top, top, 0.5, 20, real=np.float64)
    np.testing.assert_allclose(matrices.perspective(60, 1.5, 0.5, 20, real=np.float64), frustum, atol=CLOSE)


def starts(namespace: Any, rng: np.random.Generator, kind: int) -> None:
    """Make a current matrix: the identity, one made of turns and scales, or a loaded one."""
    namespace.glLoadIdentity()
    if kind == 1:
        namespace.glTranslatef(*rng.uniform(-3, 3, 3).tolist())
        namespace.glRotatef(*rng.uniform(-90, 90, 4).tolist())
        namespace.glScalef(*rng.uniform(-3, 3, 3).tolist())
    elif kind == 2:
        namespace.glLoadMatrixf(rng.uniform(-3, 3, 16).astype(np.float32))


MAKERS = {
    "glRotatef": lambda rng: (rng.uniform(-400, 400), *rng.uniform(-3, 3, 3)),
    "glRotated": lambda rng: (rng.uniform(-400, 400), *np.eye(3)[rng.integers(3)] * rng.uniform(-3, 3)),
    "glScalef": lambda rng: rng.uniform(-3, 3, 3),
    "glTranslated": lambda rng: rng.uniform(-3, 3, 3),
    "glOrtho": lambda rng: rng.uniform(-3, 3, 6),
    "glFrustum": lambda rng: (*rng.uniform(-3, 3, 4), *rng.uniform(0.01, 9, 2)),
    "gluPerspective": lambda rng: (rng.uniform(1, 170), *rng.uniform(0.01, 9, 3)),
    "gluLookAt": lambda rng: rng.uniform(-3, 3, 9),
    "gluOrtho2D": lambda rng: rng.uniform(-3, 3, 4),
    "glMultMatrixf": lambda rng: (rng.uniform(-3, 3, 16).astype(np.float32),),
    "glMultMatrixd": lambda rng: (rng.uniform(-3, 3, 16),),
}


@pytest.mark.mesa
@pytest.mark.parametrize("maker", MAKERS)
def test_made_matrices_have_the_bits_of_mesa(maker):
    def program(namespace: Any) -> np.ndarray:
        rng, results = np.random.default_rng(5), []
        for case in range(3 * CASES):
            starts(namespace, rng, case % 3)
            arguments = MAKERS[maker](rng)
            getattr(namespace, maker)(*(a if isinstance(a, np.ndarray) else float(a) for a in arguments))
            results.append(np.array(namespace.glGetFloatv(namespace.GL_MODELVIEW_MATRIX)))
        return np.array(results)

    with gl.create_context(4, 4):
        ours = program(gl)
    assert ours.tobytes() == run_on_mesa(program, (4, 4)).returned.tobytes()


def test_a_receiver_seen_from_a_light_fills_the_clip_volume():
    """Points between the plane and the light land where their ray meets the receiver; others are clipped."""
    random = np.random.default_rng(1997)
    for _ in range(200):
        axes, _ = np.linalg.qr(random.normal(size=(3, 3)))
        corner, lengths = random.normal(size=3), random.uniform(0.5, 2, 2)
        plane = np.append(axes[2], -axes[2] @ corner) * random.choice([-1, 1])
        to_receiver = np.zeros((4, 4))
        to_receiver[3, 3] = 1
        for row in range(2):
            to_receiver[row] = np.append(axes[row], -axes[row] @ corner) / lengths[row]
        height = random.uniform(1, 5)
        light = np.append(corner + random.normal(size=2) @ axes[:2] + height * axes[2], 1)
        view = matrices.receiver_view(to_receiver, plane, light, 1.0)
        on_plane, t = random.uniform(0, 1, 2), random.uniform(-0.2, 1.2)
        target = corner + on_plane * lengths @ axes[:2]
        clip = view @ np.append(target + t * (light[:3] - target), 1)
        # the numbers are of the size 10, and are multiplied a few times
        assert clip[3] == pytest.approx(1 - t, abs=1e-11)
        assert clip[:2] == pytest.approx((2 * on_plane - 1) * clip[3], abs=1e-11)
        assert (abs(clip[2]) <= clip[3] + 1e-11) == (0 <= t <= 1 - matrices.LEAST_W)
        distant = matrices.receiver_view(to_receiver, plane, np.append(axes[2] + 0.3 * axes[0], 0), 2.0)
        above = distant @ np.append(target + t * (axes[2] + 0.3 * axes[0]), 1)
        assert above == pytest.approx(np.array([*(2 * on_plane - 1), 2 * t / 2.0 - 1, 1]), abs=1e-11)
