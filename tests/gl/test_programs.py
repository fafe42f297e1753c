"""Programs and uniforms."""

import numpy as np
import pytest

from softshadow import gl
from softshadow.errors import StateError


@pytest.fixture
def shadow_map():
    with gl.create_context(4, 4):
        program = gl.program("shadow-map")
        gl.glUseProgram(program)
        yield program


def test_a_program_has_one_name(shadow_map):
    assert gl.program("shadow-map") == shadow_map
    assert gl.program("blinn-phong") != shadow_map
    assert gl.glIsProgram(shadow_map)
    assert not gl.glIsProgram(77)


def test_an_unknown_program_is_answered_with_the_nearest(shadow_map):
    with pytest.raises(StateError, match="did you mean 'shadow-map'"):
        gl.program("shadowmap")


def test_a_program_is_used_until_another_is(shadow_map):
    assert gl.glGetIntegerv(gl.GL_CURRENT_PROGRAM) == shadow_map
    gl.glUseProgram(0)
    assert gl.glGetIntegerv(gl.GL_CURRENT_PROGRAM) == 0


def test_uniforms_are_read_back(shadow_map):
    at = {name: gl.glGetUniformLocation(shadow_map, name) for name in ("bias", "ambient", "shadowMap")}
    gl.glUniform1f(at["bias"], 0.1)
    gl.glUniform4fv(at["ambient"], 1, np.float32([1, 2, 3, 4]))
    gl.glUniform1i(at["shadowMap"], 3)
    assert gl.glGetUniformfv(shadow_map, at["bias"]) == np.float32(0.1)
    assert gl.glGetUniformfv(shadow_map, at["ambient"]).tolist() == [1, 2, 3, 4]
    assert gl.glGetUniformiv(shadow_map, at["shadowMap"]) == 3


@pytest.mark.parametrize("transpose", [False, True])
def test_matrices_come_in_column_order(shadow_map, transpose):
    location = gl.glGetUniformLocation(shadow_map, b"lightMatrix")
    matrix = np.arange(16, dtype=np.float32).reshape(4, 4)
    gl.glUniformMatrix4fv(location, 1, transpose, matrix if transpose else matrix.T.copy())
    stored = gl.current().uniforms[shadow_map]["lightMatrix"]
    assert (stored == matrix).all()
    assert (gl.glGetUniformfv(shadow_map, location) == matrix.T).all()


def test_a_uniform_that_no_program_has_is_ignored(shadow_map):
    location = gl.glGetUniformLocation(shadow_map, "nothing")
    assert location == -1
    gl.glUniform3f(location, 1, 2, 3)
    assert gl.glGetError() == gl.GL_NO_ERROR


def test_programs_keep_their_own_uniforms(shadow_map):
    other = gl.program("blinn-phong")
    gl.glUseProgram(other)
    location = gl.glGetUniformLocation(other, "shininess")
    gl.glUniform1f(location, 20)
    gl.glUseProgram(shadow_map)
    assert gl.glGetUniformfv(other, location) == 20


def test_there_is_no_shader_compiler():
    with pytest.raises(AttributeError, match="glCreateShader is not part of this subset of OpenGL"):
        _ = gl.glCreateShader
