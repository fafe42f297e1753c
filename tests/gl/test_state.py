"""State that is set can be read back, as on Mesa, after any calls, right or wrong."""

import numpy as np
import pytest
from hypothesis import given, settings

from gl.gl_state import make, same, state_of
from mesa.gl_calls import Call
from softshadow import gl
from softshadow.testing import run_on_mesa
from strategies import state_calls

SIZE = (10, 8)
# attributes come back only where a vertex has taken them along (tests/mesa/test_attribute_stack.py)
GIVEN = ("glColor3", "glColor4", "glNormal", "glTexCoord", "glMultiTexCoord", "glMaterial")


def checked(name: str, *arguments, reads: dict[str, object]) -> tuple:
    return pytest.param(name, arguments, reads, id=name)


SETTERS = [
    checked("glDepthFunc", "GL_GREATER", reads={"GL_DEPTH_FUNC": gl.GL_GREATER}),
    checked("glDepthMask", "GL_FALSE", reads={"GL_DEPTH_WRITEMASK": 0}),
    checked("glClearDepth", 0.25, reads={"GL_DEPTH_CLEAR_VALUE": 0.25}),
    checked("glDepthRange", 0.25, 1.5, reads={"GL_DEPTH_RANGE": (0.25, 1.0)}),
    checked("glAlphaFunc", "GL_LESS", 0.5, reads={"GL_ALPHA_TEST_FUNC": gl.GL_LESS, "GL_ALPHA_TEST_REF": 0.5}),
    checked(
        "glStencilFunc", "GL_EQUAL", 300, 0x3F,
        reads={"GL_STENCIL_FUNC": gl.GL_EQUAL, "GL_STENCIL_BACK_REF": 255, "GL_STENCIL_VALUE_MASK": 0x3F},
    ),
    checked(
        "glStencilOpSeparate", "GL_BACK", "GL_KEEP", "GL_INCR_WRAP", "GL_ZERO",
        reads={"GL_STENCIL_BACK_PASS_DEPTH_FAIL": gl.GL_INCR_WRAP, "GL_STENCIL_PASS_DEPTH_FAIL": gl.GL_KEEP},
    ),
    checked("glStencilMaskSeparate", "GL_BACK", 7, reads={"GL_STENCIL_BACK_WRITEMASK": 7, "GL_STENCIL_WRITEMASK": 255}),
    checked("glClearStencil", 3, reads={"GL_STENCIL_CLEAR_VALUE": 3}),
    checked("glColorMask", 1, 0, 0, 1, reads={"GL_COLOR_WRITEMASK": (1, 0, 0, 1)}),
    checked("glClearColor", 0.5, 2.0, 0.0, 1.0, reads={"GL_COLOR_CLEAR_VALUE": (0.5, 1.0, 0.0, 1.0)}),
    checked("glBlendFunc", "GL_SRC_ALPHA", "GL_ONE", reads={"GL_BLEND_SRC": gl.GL_SRC_ALPHA, "GL_BLEND_DST_ALPHA": 1}),
    checked("glBlendEquation", "GL_MIN", reads={"GL_BLEND_EQUATION_ALPHA": gl.GL_MIN}),
    checked("glLogicOp", "GL_XOR", reads={"GL_LOGIC_OP_MODE": gl.GL_XOR}),
    checked("glCullFace", "GL_FRONT", reads={"GL_CULL_FACE_MODE": gl.GL_FRONT}),
    checked("glFrontFace", "GL_CW", reads={"GL_FRONT_FACE": gl.GL_CW}),
    checked("glPolygonMode", "GL_BACK", "GL_LINE", reads={"GL_POLYGON_MODE": (gl.GL_FILL, gl.GL_LINE)}),
    checked("glPolygonOffset", 1.5, -2, reads={"GL_POLYGON_OFFSET_FACTOR": 1.5, "GL_POLYGON_OFFSET_UNITS": -2}),
    checked("glLineWidth", 2.5, reads={"GL_LINE_WIDTH": 2.5}),
    checked("glPointSize", 3, reads={"GL_POINT_SIZE": 3}),
    checked("glViewport", 1, -2, 3, 4, reads={"GL_VIEWPORT": (1, -2, 3, 4)}),
    checked("glScissor", 1, 2, 3, 4, reads={"GL_SCISSOR_BOX": (1, 2, 3, 4)}),
    checked("glShadeModel", "GL_FLAT", reads={"GL_SHADE_MODEL": gl.GL_FLAT}),
    checked("glHint", "GL_FOG_HINT", "GL_NICEST", reads={"GL_FOG_HINT": gl.GL_NICEST}),
    checked("glMatrixMode", "GL_PROJECTION", reads={"GL_MATRIX_MODE": gl.GL_PROJECTION}),
    checked("glColor4ub", 255, 0, 51, 255, reads={"GL_CURRENT_COLOR": (1, 0, np.float32(0.2), 1)}),
    checked("glTexCoord3f", 1, 2, 3, reads={"GL_CURRENT_TEXTURE_COORDS": (1, 2, 3, 1)}),
]  # fmt: skip


@pytest.mark.parametrize(("name", "arguments", "reads"), SETTERS)
def test_what_is_set_is_read_back(name, arguments, reads):
    with gl.create_context(*SIZE):
        assert make(gl, [(name, arguments)]) == [gl.GL_NO_ERROR]
        for query, expected in reads.items():
            np.testing.assert_array_equal(gl.glGetDoublev(getattr(gl, query)), expected)


@settings(max_examples=60)
@given(state_calls())
def test_popping_all_attributes_brings_all_state_back(calls: list[Call]):
    # what is no attribute: matrices, client state, seamless cube maps, the depth of the stack itself
    not_popped = ("MATRIX)", "STACK_DEPTH)", "CLIENT_ACTIVE_TEXTURE)", "CUBE_MAP_SEAMLESS)")
    with gl.create_context(*SIZE, raise_errors=False):
        calls = [call for call in calls if "Attrib" not in call[0] and not call[0].startswith(GIVEN)]
        gl.glActiveTexture(gl.GL_TEXTURE1)
        before = state_of(gl)
        gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
        make(gl, calls)
        gl.glPopAttrib()
        after = state_of(gl)
        changed = [name for name in before if not same(before[name], after[name]) and not name.endswith(not_popped)]
        assert changed == []


@settings(max_examples=60)
@given(state_calls())
def test_failed_call_changes_nothing(calls: list[Call]):
    with gl.create_context(*SIZE, raise_errors=False):
        for name, arguments in calls:
            before = state_of(gl)
            if make(gl, [(name, arguments)]) != [gl.GL_NO_ERROR]:
                after = state_of(gl)
                assert [key for key in before if not same(before[key], after[key])] == []


@pytest.mark.mesa
@settings(max_examples=25)
@given(state_calls())
def test_states_and_error_codes_are_those_of_mesa(calls: list[Call]):
    def program(namespace):
        return make(namespace, calls), state_of(namespace)

    with gl.create_context(*SIZE):
        our_codes, ours = program(gl)
    their_codes, theirs = run_on_mesa(program, SIZE).returned
    assert list(zip(calls, our_codes, strict=True)) == list(zip(calls, their_codes, strict=True))
    assert [(name, ours[name], theirs[name]) for name in ours if not same(ours[name], theirs[name])] == []
