"""The specialized fill is vectorised: its compiled code tests many pixels by one instruction.

A branch in the wrong place, or an index that may be negative, makes the compiler fall back to one pixel at a time, and
nothing but the time would tell. So we look into the machine code for what a vectorised loop over pixels cannot do
without: a comparison of packed depths, and packed arithmetic on stencil values that are bytes.
"""

import platform
import re

import numba
import numpy as np
import pytest

from softshadow import gl
from softshadow.pipeline import use_short_cuts
from softshadow.pipeline.fast import specialize

# of AVX and AVX-512 on registers of 32 or 64 bytes; plain SSE has the same names without the v
PACKED_FLOATS_COMPARED = re.compile(r"\bv?cmp\w*ps\b[^\n]*%[xyz]mm|\bv?(?:min|max)ps\b[^\n]*%[xyz]mm")
PACKED_BYTES_COUNTED = re.compile(r"\bv?p(?:add|sub)b\b[^\n]*%[xyz]mm")

pytestmark = [
    pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="looks at compiled code"),
    pytest.mark.skipif(
        platform.machine() not in ("x86_64", "AMD64"), reason="knows the names of x86's vector instructions only"
    ),
]


def machine_code_of_what_draws(monkeypatch: pytest.MonkeyPatch, draw) -> str:
    """Return the assembly of all fills that a draw is specialized to, compiled anew: the cache has no text of it."""
    compiled: dict = {}
    monkeypatch.setattr(specialize, "compiled", compiled)
    with gl.create_context(64, 48), use_short_cuts("always"):
        draw()
        gl.glFinish()
    assert compiled
    text = ""
    for fill in compiled.values():
        anew = numba.njit(nogil=True, error_model="numpy")(fill.py_func)
        for signature in fill.signatures:
            anew.compile(signature)
        text += "".join(anew.inspect_asm().values())
    return text


def test_a_loop_that_ends_early_has_no_such_instructions():
    @numba.njit
    def first_nearer(depth, stencil, z):
        for i in range(depth.shape[0]):
            if z < depth[i]:
                stencil[i] += 1
                return i
        return -1

    first_nearer(np.zeros(8, np.float32), np.zeros(8, np.uint8), np.float32(1))
    code = "".join(first_nearer.inspect_asm().values())
    assert "first_nearer" in code
    assert not PACKED_FLOATS_COMPARED.search(code)
    assert not PACKED_BYTES_COUNTED.search(code)


def draw_quad() -> None:
    gl.glBegin(gl.GL_QUADS)
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        gl.glVertex3f(x, y, 0.3 * x)
    gl.glEnd()


def test_depths_are_compared_many_at_a_time(monkeypatch):
    def draw() -> None:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glColorMask(False, False, False, False)
        draw_quad()

    assert PACKED_FLOATS_COMPARED.search(machine_code_of_what_draws(monkeypatch, draw))


@pytest.mark.parametrize("operation", ["GL_INCR_WRAP", "GL_DECR"])
def test_stencil_values_are_counted_many_at_a_time(monkeypatch, operation):
    def draw() -> None:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glDepthMask(False)
        gl.glColorMask(False, False, False, False)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 255)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, getattr(gl, operation))
        draw_quad()

    assert PACKED_BYTES_COUNTED.search(machine_code_of_what_draws(monkeypatch, draw))
