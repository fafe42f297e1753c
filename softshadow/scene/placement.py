"""Matrices that place an object in the world: scaled, turned, then moved."""

from collections.abc import Sequence

import numpy as np

from softshadow.errors import SceneError
from softshadow.scene.validate import validate_numbers


def placement(
    move: Sequence[float] = (0, 0, 0),
    turn: Sequence[float] = (0, 0, 1, 0),
    scale: float | Sequence[float] = 1,
) -> np.ndarray:
    """Return (4, 4) float64 `object_to_world`: glTranslate(move) · glRotate(turn) · glScale(scale).

    Parameters
    ----------
    move : x, y, z
    turn : angle, x, y, z       degrees, counter-clockwise about the axis
    scale : one or three        positive: a reflection would turn every face inside out

    Raises
    ------
    SceneError                  not finite, an axis of length 0, a scale that is not positive
    """
    factors = validate_numbers("scale", np.broadcast_to(scale, 3) if np.ndim(scale) == 0 else scale, 3)
    if (factors <= 0).any():
        raise SceneError(f"scale: expected positive factors, got {scale!r}")
    angle, *axis = validate_numbers("turn", turn, 4)
    length = float(np.linalg.norm(axis))
    if length == 0:
        raise SceneError(f"turn: expected an axis of a length other than 0, got {turn!r}")
    x, y, z = np.array(axis) / length
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    radians = np.radians(angle)
    rotation = np.eye(3) + np.sin(radians) * cross + (1 - np.cos(radians)) * cross @ cross  # Rodrigues
    matrix = np.eye(4)
    matrix[:3, :3] = rotation * factors
    matrix[:3, 3] = validate_numbers("move", move, 3)
    return matrix


def transform_points(points: np.ndarray, linear: np.ndarray) -> np.ndarray:
    """Return points (N, 3) transformed by a 3x3 matrix.

    Computed column by column, so that equal points stay equal to the last bit; `@` works in blocks and may round them
    differently.
    """
    return points[:, :1] * linear[:, 0] + points[:, 1:2] * linear[:, 1] + points[:, 2:3] * linear[:, 2]
