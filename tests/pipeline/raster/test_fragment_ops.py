"""`process_fragment` agrees with an oracle written from the specification, on random states."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from oracle.fragment import TESTS, fragment
from softshadow import tokens as gl
from softshadow.framebuffer import default_framebuffer
from softshadow.pipeline.raster.fragment_ops import fragment_ops, process_fragment
from softshadow.pipeline.records import VERDICTS
from softshadow.state import State
from strategies import fragment_states

pytestmark = pytest.mark.interpreted


def state_of(spec: dict) -> State:
    """Return the state of the oracle as a `State`."""
    state = State()
    if spec["alpha"]:
        func, ref = spec["alpha"]
        state = replace(state, alpha=replace(state.alpha, enabled=True, func=getattr(gl, func), ref=ref / 255))
    if spec["stencil"]:
        func, ref, read, sfail, zfail, zpass, write, _ = spec["stencil"]
        ops = {name: getattr(gl, op) for name, op in (("sfail", sfail), ("zfail", zfail), ("zpass", zpass))}
        face = replace(state.stencil.front, func=getattr(gl, func), ref=ref, read_mask=read, write_mask=write, **ops)
        state = replace(state, stencil=replace(state.stencil, enabled=True, front=face, back=face))
    if spec["depth"]:
        func, write = spec["depth"]
        state = replace(state, depth=replace(state.depth, enabled=True, func=getattr(gl, func), write=write))
    return state


@given(
    fragment_states(),
    st.integers(0, 255),
    st.integers(0, 3),
    st.integers(0, 3),
    st.integers(0, 255),
)
@example(
    {"scissored": False, "alpha": None, "depth": None,
     "stencil": ("GL_ALWAYS", 7, 1, "GL_KEEP", "GL_KEEP", "GL_REPLACE", 0xFF, 8)},
    0, 0, 0, 0,
)  # fmt: skip
def test_process_fragment_follows_the_specification(spec, alpha, z, stored_z, stored):
    bits = spec["stencil"][-1] if spec["stencil"] else 8
    window = default_framebuffer(1, 1, stencil_bits=bits)
    stored &= 2**bits - 1
    ops = fragment_ops(state_of(spec), window.depth, window.stencil, front=True)
    z, stored_z = np.float32(z), np.float32(stored_z)
    verdict, stencil, depth = process_fragment(ops, not spec["scissored"], alpha, z, stored_z, np.uint8(stored))
    assert (VERDICTS[verdict], int(stencil), float(depth)) == fragment(spec, alpha, z, stored_z, stored)


@pytest.mark.parametrize("func", TESTS)
def test_reference_is_masked_before_it_is_compared(func):
    spec = {"scissored": False, "alpha": None, "depth": None}
    spec["stencil"] = (func, 0xF1, 0x0F, "GL_ZERO", "GL_KEEP", "GL_REPLACE", 0xFF, 8)
    window = default_framebuffer(1, 1)
    ops = fragment_ops(state_of(spec), window.depth, window.stencil, front=True)
    zero = np.float32(0)
    _, stencil, _ = process_fragment(ops, True, 0, zero, zero, np.uint8(0x81))
    # 0xF1 & 0x0F is compared with 0x81 & 0x0F; GL_REPLACE writes the whole reference
    assert stencil == (0xF1 if TESTS[func](1, 1) else 0)


def test_missing_buffers_pass_their_tests_and_are_not_written():
    state = State()
    state = replace(
        state,
        depth=replace(state.depth, enabled=True, func=gl.GL_NEVER),
        stencil=replace(state.stencil, enabled=True, front=replace(state.stencil.front, func=gl.GL_NEVER)),
    )
    ops = fragment_ops(state, None, None, front=True)
    zero = np.float32(0)
    verdict, stencil, depth = process_fragment(ops, True, 0, np.float32(1), zero, np.uint8(5))
    assert (VERDICTS[verdict], stencil, depth) == ("passed", 5, 0)


def test_states_that_behave_alike_are_equal():
    window = default_framebuffer(1, 1)
    off = State()
    other = replace(off, depth=replace(off.depth, func=gl.GL_GREATER), stencil=replace(off.stencil, clear=3))
    other = replace(other, stencil=replace(other.stencil, front=replace(other.stencil.front, zpass=gl.GL_INCR)))
    assert fragment_ops(off, window.depth, window.stencil, True) == fragment_ops(
        other, window.depth, window.stencil, True
    )
