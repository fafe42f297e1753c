"""States that return are the same objects, so that what was derived from them is found again."""

from math import copysign

import pytest

from softshadow import gl
from softshadow.context.state_groups import PAST


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


def test_a_group_with_parts_that_has_equal_values_again_is_the_same_object(context):
    states = []
    for number in range(6):
        gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, [number % 3, 0.1, 0.2, 1])
        gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, number % 3 == 1)
        states.append(context.state)
    assert [id(state.lighting) for state in states[:3]] == [id(state.lighting) for state in states[3:]]
    assert len({id(state) for state in states}) == 3
    gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, [-0.0, 0.1, 0.2, 1])
    assert copysign(1, context.state.lighting.model_ambient[0]) == -1


def test_only_the_latest_states_are_kept(context):
    first = context.state
    for width in range(2, PAST + 50):
        gl.glLineWidth(width)
        gl.glBindTexture(gl.GL_TEXTURE_2D, width)
        assert context.state.polygon.line_width == width
    gl.glLineWidth(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)
    assert context.state == first
    for group in ("polygon", "units.0", ""):
        assert len(context.groups[group].known) <= PAST
    assert len(context.groups[""].tuples) <= PAST


def test_a_texture_that_returns_gives_the_same_state(context):
    states = []
    for number in range(6):
        gl.glBindTexture(gl.GL_TEXTURE_2D, 1 + number % 3)
        states.append(context.state)
    assert states[:3] == states[3:]
    assert all(a is b and a.units is b.units for a, b in zip(states[:3], states[3:], strict=True))


GROUPS = (gl.GL_ENABLE_BIT, gl.GL_LIGHTING_BIT, gl.GL_STENCIL_BUFFER_BIT, gl.GL_ALL_ATTRIB_BITS)


@pytest.mark.parametrize("bits", GROUPS)
def test_a_popped_state_is_the_pushed_object(context, bits):
    before = context.state
    for _ in range(2):
        gl.glPushAttrib(bits)
        if bits & gl.GL_STENCIL_BUFFER_BIT:
            gl.glStencilFunc(gl.GL_EQUAL, 3, 1)
        if bits & gl.GL_LIGHTING_BIT:
            gl.glShadeModel(gl.GL_FLAT)
        if bits & gl.GL_ENABLE_BIT:
            gl.glEnable(gl.GL_CULL_FACE)
        assert context.state is not before
        gl.glPopAttrib()
        assert context.state is before


def test_samplers_saved_once_are_those_of_every_push(context):
    gl.glBindTexture(gl.GL_TEXTURE_2D, 3)
    for wrap in (gl.GL_CLAMP, gl.GL_CLAMP_TO_EDGE, gl.GL_REPEAT):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S, wrap)
        gl.glPushAttrib(gl.GL_TEXTURE_BIT)
        gl.glPushAttrib(gl.GL_TEXTURE_BIT)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S, gl.GL_MIRRORED_REPEAT)
        gl.glPopAttrib()
        gl.glPopAttrib()
        assert gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S) == wrap


def test_states_of_equal_values_with_other_bits_are_found_side_by_side(context):
    states = []
    for units in (0.0, -0.0) * 3:
        gl.glPolygonOffset(2.0, units)
        states.append(context.state)
    assert len({id(state) for state in states}) == 2
    assert states[0] is states[4]
    assert states[1] is states[5]
