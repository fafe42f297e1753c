"""The slides' projection matrices as printed: they project points onto a plane, away from a light.

All are the matrix S(Λ) = (π·Λ) I − Λ πᵀ of `softshadow.matrices.planar_shadow`, up to a sign that the slides do not
mention. GL clips everything with w <= 0, so with the wrong sign there is no shadow.
"""

from collections.abc import Sequence

import numpy as np


def from_origin(plane: Sequence[float]) -> np.ndarray:
    """Return the matrix of CA:369: onto the plane (a, b, c, d), the light at the origin."""
    a, b, c, d = plane
    return np.array([[-d, 0, 0, 0], [0, -d, 0, 0], [0, 0, -d, 0], [a, b, c, 0]], np.float64)


def from_point(plane: Sequence[float], light: Sequence[float]) -> np.ndarray:
    """Return the matrix of CA:378-383: the light at a point. It is −S(Λ).

    E35: so w is negative for casters if the light is on the plane's positive side; the plane has to be negated.
    """
    a, b, c, d = plane
    x, y, z = light[:3]
    return np.array(
        [
            [-d - b * y - c * z, x * b, x * c, x * d],
            [y * a, -d - a * x - c * z, y * c, y * d],
            [z * a, z * b, -d - a * x - b * y, z * d],
            [a, b, c, -a * x - b * y - c * z],
        ],
        np.float64,
    )


def along_direction(plane: Sequence[float], direction: Sequence[float]) -> np.ndarray:
    """Return the matrix of CA:391-396: a light at infinity. It is +S(D).

    E36: so w is the dot product of normal and direction, and the direction has to point towards the light.
    """
    a, b, c, d = plane
    x, y, z = direction[:3]
    return np.array(
        [
            [b * y + c * z, -b * x, -c * x, -d * x],
            [-a * y, a * x + c * z, -c * y, -d * y],
            [-a * z, -b * z, a * x + b * y, -d * z],
            [0, 0, 0, a * x + b * y + c * z],
        ],
        np.float64,
    )


def onto_ground(light: Sequence[float]) -> np.ndarray:
    """Return the matrix of SK:153: onto y = 0, the light at a point. It is +S(Λ), with the right sign (E37)."""
    x, y, z = light[:3]
    return np.array([[y, -x, 0, 0], [0, 0, 0, 0], [0, -z, y, 0], [0, -1, 0, y]], np.float64)


def along_rays(positions: np.ndarray, light: Sequence[float]) -> np.ndarray:
    """Return positions (V, 3) flattened onto y = 0 by the ray form of SK:143-145, divided here instead of by GL.

    E21: vertices above the light (t < 0) and below the ground (0 < t < 1) are projected as well.
    """
    lamp = np.asarray(light[:3], np.float64)
    t = lamp[1] / (lamp[1] - positions[:, 1:2])  # t = l_y / (l_y − v_y)
    return lamp + t * (positions - lamp)  # p = l + t (v − l)
