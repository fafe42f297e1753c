"""States that return are the same objects, so that what was derived from them is found again."""

from math import copysign

import pytest

from softshadow import gl


@pytest.fixture
def context():
    with gl.create_context(8, 6) as context:
        yield context


def test_a_state_that_returns_is_the_same_object(context):
    states = []
    for number in range(6):
        (gl.glEnable if number % 2 else gl.glDisable)(gl.GL_BLEND)
        gl.glDepthFunc(gl.GL_LEQUAL if number % 2 else gl.GL_LESS)
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_DIFFUSE, [number % 2, 0, 0, 1])
        states.append(context.state)
    assert len({id(state) for state in states}) == 2
    assert states[0] is states[2]
    assert states[0] != states[1]


def test_a_state_with_other_bits_is_another_one(context):
    states = []
    for units in (0.0, -0.0, 0.0):
        gl.glPolygonOffset(1.0, units)
        states.append(context.state)
        assert copysign(1, states[-1].polygon.units) == copysign(1, units)
    assert states[0].polygon is not states[1].polygon
    assert states[0].polygon is states[2].polygon


def test_only_the_latest_states_are_kept(context):
    first = context.state
    for width in range(2, 100):
        gl.glLineWidth(width)
        assert context.state.polygon.line_width == width
    gl.glLineWidth(1)
    assert context.state == first
    assert len(context.groups["polygon"].past) < 20
