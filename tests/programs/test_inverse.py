"""The inverse in float32: it is the inverse, and has Mesa's bits for every kind of matrix."""

from typing import Any

import numpy as np
import pytest

from mesa_points import load, same_bits
from softshadow.programs.inverse import inverse, is_length_preserving
from softshadow.testing import run_on_mesa


def rotation(rng: np.random.Generator) -> np.ndarray:
    """Return a random rotation with a translation, (4, 4) float32."""
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    matrix = np.eye(4)
    matrix[:3, :3] = q * np.sign(np.linalg.det(q))
    matrix[:3, 3] = rng.normal(size=3)
    return matrix.astype(np.float32)


def matrices(seed: int) -> dict[str, np.ndarray]:
    """Return one matrix of each kind."""
    rng = np.random.default_rng(seed)
    affine = np.eye(4, dtype=np.float32)
    affine[:3] = rng.normal(size=(3, 4))
    turned, flat = rotation(rng), np.eye(4, dtype=np.float32)
    flat[:2, :2], flat[:2, 3] = [[0.6, -0.8], [0.8, 0.6]], [3, -2]
    scale = np.diag(np.append(rng.uniform(0.3, 3, 3), 1)).astype(np.float32)
    moved = scale.copy()
    moved[:3, 3] = rng.normal(size=3)
    return {
        "identity": np.eye(4, dtype=np.float32),
        "rotation": turned,
        "rotation about z": flat,
        "scaled rotation": (turned @ scale).astype(np.float32),
        "evenly scaled rotation": (turned @ np.diag(np.float32([2, 2, 2, 1]))).astype(np.float32),
        "scale": scale,
        "scale and translation": moved,
        "affine": affine,
        "general": rng.normal(size=(4, 4)).astype(np.float32),
        "singular": np.zeros((4, 4), np.float32),
    }


KINDS = tuple(matrices(0))


@pytest.mark.parametrize("kind", [k for k in KINDS if k != "singular"])
def test_a_matrix_times_its_inverse_is_the_identity(kind):
    matrix = matrices(3)[kind]
    # float32 rounding times a condition number of up to a hundred
    assert np.allclose(matrix.astype(np.float64) @ inverse(matrix), np.eye(4), atol=1e-4)


def test_a_singular_matrix_answers_the_identity():
    assert (inverse(np.zeros((4, 4), np.float32)) == np.eye(4)).all()


def test_rotations_and_translations_preserve_lengths():
    length_preserving = {kind for kind, matrix in matrices(1).items() if is_length_preserving(matrix)}
    assert length_preserving == {"identity", "rotation", "rotation about z"}


@pytest.mark.mesa
@pytest.mark.parametrize("kind", KINDS)
def test_inverses_are_mesas(kind):
    for seed in range(3):
        matrix = matrices(seed)[kind]

        def program(on: Any, matrix: np.ndarray = matrix) -> np.ndarray:
            load(on, on.GL_MODELVIEW, matrix)
            rows = []
            for unit_plane in np.eye(4, dtype=np.float32):  # the eye plane e_i comes back as row i of the inverse
                on.glTexGenfv(on.GL_S, on.GL_EYE_PLANE, unit_plane)
                rows.append(np.array(on.glGetTexGenfv(on.GL_S, on.GL_EYE_PLANE)))
            return np.array(rows)

        assert same_bits(inverse(matrix), run_on_mesa(program, (8, 8)).returned)
