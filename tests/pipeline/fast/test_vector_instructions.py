"""The specialized fill is vectorised: its machine code tests many pixels with one instruction.

With a branch in the wrong place, or an index that may be negative, the compiler falls back to one pixel at a time, and
only timings would show it. So the machine code is searched for instructions that every vectorised loop over pixels has:
comparisons of packed depths, and packed arithmetic on stencil values, which are bytes.
"""

import platform
import re

import numba
import numpy as np
import pytest

from softshadow import gl
from softshadow.pipeline import use_short_cuts
from softshadow.pipeline.fast import specialize

# in AVX and AVX-512, with registers of 32 or 64 bytes; SSE has the same names without the v
PACKED_FLOATS_COMPARED = re.compile(r"\bv?cmp\w*ps\b[^\n]*%[xyz]mm|\bv?(?:min|max)ps\b[^\n]*%[xyz]mm")
PACKED_BYTES_COUNTED = re.compile(r"\bv?p(?:add|sub)b\b[^\n]*%[xyz]mm")

pytestmark = [
    pytest.mark.skipif(bool(vars(numba.config)["DISABLE_JIT"]), reason="looks at compiled code"),
    pytest.mark.skipif(
        platform.machine() not in ("x86_64", "AMD64"), reason="knows the names of x86's vector instructions only"
    ),
]


def machine_code_of_fills(monkeypatch: pytest.MonkeyPatch, draw) -> str:
    """Return the assembly of the specialized fills of a draw, recompiled since the cache has no text of it."""
    kernels: dict = {}
    monkeypatch.setattr(specialize, "compiled", kernels)
    with gl.create_context(64, 48), use_short_cuts("always"):
        draw()
        gl.glFinish()
    assert kernels
    text = ""
    for fill in kernels.values():
        recompiled = numba.njit(nogil=True, error_model="numpy")(fill.py_func)
        for signature in fill.signatures:
            recompiled.compile(signature)
        text += "".join(recompiled.inspect_asm().values())
    return text


def test_a_loop_that_ends_early_has_no_packed_instructions():
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

    assert PACKED_FLOATS_COMPARED.search(machine_code_of_fills(monkeypatch, draw))


@pytest.mark.parametrize("operation", ["GL_INCR_WRAP", pytest.param("GL_DECR", marks=pytest.mark.slow)])
def test_stencil_values_are_counted_many_at_a_time(monkeypatch, operation):
    def draw() -> None:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glDepthMask(False)
        gl.glColorMask(False, False, False, False)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 255)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, getattr(gl, operation))
        draw_quad()

    assert PACKED_BYTES_COUNTED.search(machine_code_of_fills(monkeypatch, draw))
