"""Texture units: environment and generated coordinates."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.testing import run_on_mesa


@pytest.fixture
def context():
    with gl.create_context(4, 4) as context:
        yield context


def test_units_have_their_own_bindings_and_environments(context):
    gl.glActiveTexture(gl.GL_TEXTURE1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_DECAL)
    gl.glActiveTexture(gl.GL_TEXTURE0)
    assert gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D) == 0
    assert gl.glGetTexEnviv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE) == gl.GL_MODULATE
    assert context.state.units[1].env_mode == gl.GL_DECAL


def test_the_environment_colour_is_queried_clamped(context):
    gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, (0.25, 2, -1, 0.5))
    assert gl.glGetTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR).tolist() == [0.25, 1, 0, 0.5]


def test_planes_are_read_back(context):
    gl.glTexGeni(gl.GL_S, gl.GL_TEXTURE_GEN_MODE, gl.GL_OBJECT_LINEAR)
    gl.glTexGenfv(gl.GL_S, gl.GL_OBJECT_PLANE, [1, 2, 3, 4])
    assert gl.glGetTexGeniv(gl.GL_S, gl.GL_TEXTURE_GEN_MODE) == gl.GL_OBJECT_LINEAR
    assert gl.glGetTexGenfv(gl.GL_S, gl.GL_OBJECT_PLANE).tolist() == [1, 2, 3, 4]


def test_an_eye_plane_moves_with_the_modelview_matrix(context):
    gl.glTranslatef(0, 0, -5)
    gl.glTexGenfv(gl.GL_R, gl.GL_EYE_PLANE, [0, 0, 1, 2])
    assert gl.glGetTexGenfv(gl.GL_R, gl.GL_EYE_PLANE).tolist() == [0, 0, 1, 7]


def eye_planes(gl: Any) -> np.ndarray:
    """Eye planes set under one loaded matrix; a second would inherit from the first on Mesa."""
    rng = np.random.default_rng(4)
    gl.glLoadMatrixf(rng.normal(size=16).astype(np.float32))
    planes = []
    for plane in rng.normal(size=(20, 4)).astype(np.float32):
        gl.glTexGenfv(gl.GL_Q, gl.GL_EYE_PLANE, plane)
        planes.append(np.array(gl.glGetTexGenfv(gl.GL_Q, gl.GL_EYE_PLANE)))
    return np.array(planes)


@pytest.mark.mesa
def test_eye_planes_are_mesas(context):
    assert (eye_planes(gl) == run_on_mesa(eye_planes, (4, 4)).returned).all()
