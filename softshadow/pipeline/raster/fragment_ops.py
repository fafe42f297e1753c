"""The per-fragment operations: one textbook function in the order of the specification.

The textbook's loops call it with the state as an argument; `fast/fragment_numbers.py` has the same operations as
numbers, for loops over many pixels. Called from Python it explains the history of a pixel.
"""

from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Image
from softshadow.jit import kernel
from softshadow.pipeline.records import ALPHA_FAILED, DEPTH_FAILED, PASSED, SCISSORED, STENCIL_FAILED
from softshadow.state import State

NO_ALPHA = np.int64(0)  # where alpha is not tested; for a literal, `process_fragment` would be compiled a second time

NEVER, LESS, EQUAL, LEQUAL = gl.GL_NEVER, gl.GL_LESS, gl.GL_EQUAL, gl.GL_LEQUAL
GREATER, NOTEQUAL, GEQUAL, ALWAYS = gl.GL_GREATER, gl.GL_NOTEQUAL, gl.GL_GEQUAL, gl.GL_ALWAYS
KEEP, CLEAR, REPLACE, INCR, DECR = gl.GL_KEEP, gl.GL_ZERO, gl.GL_REPLACE, gl.GL_INCR, gl.GL_DECR
INCR_WRAP, DECR_WRAP = gl.GL_INCR_WRAP, gl.GL_DECR_WRAP


class FragmentOps(NamedTuple):
    """The state of the per-fragment operations for one facing, as plain ints.

    Fields of a disabled test have one fixed value, so that equal behaviour is equal state. `alpha_ref` is 0-255,
    `stencil_largest` is ``2**bits - 1``, `depth_largest` the integer that z = 1 becomes (0: depth is kept as z itself).
    """

    alpha_test: int
    alpha_func: int
    stencil_test: int
    stencil_func: int
    sfail: int
    zfail: int
    zpass: int
    stencil_largest: int
    depth_test: int
    depth_func: int
    depth_write: int
    depth_largest: int
    alpha_ref: int
    ref: int
    read_mask: int
    write_mask: int


def fragment_ops(state: State, depth: Image | None, stencil: Image | None, front: bool) -> FragmentOps:
    """Return the per-fragment state of one facing, for a framebuffer with these buffers.

    Without a depth buffer the depth test passes, without a stencil buffer the stencil test; a disabled depth test
    writes no depth (GL 2.1, sec. 4.1.4-4.1.5).
    """
    alpha, face = state.alpha, state.stencil.front if front else state.stencil.back
    alpha_test = alpha.enabled and alpha.func != ALWAYS
    stencil_test = state.stencil.enabled and stencil is not None
    depth_test = state.depth.enabled and depth is not None
    largest = stencil.format.largest if stencil is not None else 0
    stencil_ops = (face.func, face.sfail, face.zfail, face.zpass, largest)
    numbers = (max(0, min(face.ref, largest)), face.read_mask & largest, face.write_mask & largest)
    depth_largest = depth.format.largest if depth is not None else 0
    return FragmentOps(
        *((1, alpha.func) if alpha_test else (0, ALWAYS)),
        *((1, *stencil_ops) if stencil_test else (0, ALWAYS, KEEP, KEEP, KEEP, 0)),
        *((1, state.depth.func, int(state.depth.write)) if depth_test else (0, ALWAYS, 0)),
        depth_largest,
        compared_ref(alpha.ref) if alpha_test else 0,
        *(numbers if stencil_test else (0, 0, 0)),
    )


def compared_ref(ref: float) -> int:
    """Return the byte that the alpha test compares with; NaN becomes 255, as in Mesa."""
    return int(np.rint(np.float32(max(0.0, min(1.0, ref))) * np.float32(255)))


@kernel
def compare(func, a, b):
    """Return whether ``a func b``."""
    if func == NEVER:
        return False
    if func == LESS:
        return a < b
    if func == EQUAL:
        return a == b
    if func == LEQUAL:
        return a <= b
    if func == GREATER:
        return a > b
    if func == NOTEQUAL:
        return a != b
    if func == GEQUAL:
        return a >= b
    return True


@kernel
def stencil_op(op, s, ref, largest):
    """Return the stencil value after an operation; all values are uint8.

    In a kernel compiled for one state, the comparisons of `op` are folded away, and a loop over it is vectorised.
    """
    if op == KEEP:
        return s
    if op == CLEAR:
        return np.uint8(0)
    if op == REPLACE:
        return ref
    if op == INCR:
        return np.uint8(s + np.uint8(s != largest))
    if op == DECR:
        return np.uint8(s - np.uint8(s != np.uint8(0)))
    if op == INCR_WRAP:
        return np.uint8((int(s) + 1) & int(largest))
    if op == DECR_WRAP:
        return np.uint8((int(s) - 1) & int(largest))
    return np.uint8(s ^ largest)


@kernel
def process_fragment(ops, inside_scissor, alpha, z, stored_z, s):
    """Return (verdict, stencil after, depth after) of one fragment.

    Parameters
    ----------
    ops : FragmentOps of the fragment's facing
    inside_scissor : bool
    alpha : int 0-255
    z, stored_z : depth in buffer units
    s : np.uint8, the stored stencil value

    References
    ----------
    GL 2.1, sec. 4.1.2-4.1.5: scissor, alpha, stencil, depth, then the writes.
    """
    if not inside_scissor:
        return SCISSORED, s, stored_z
    if ops.alpha_test and not compare(ops.alpha_func, alpha, ops.alpha_ref):
        return ALPHA_FAILED, s, stored_z
    ref, largest = np.uint8(ops.ref), np.uint8(ops.stencil_largest)
    read, write = np.uint8(ops.read_mask), np.uint8(ops.write_mask)
    stencil_passed = not ops.stencil_test or compare(ops.stencil_func, ref & read, s & read)
    depth_passed = not ops.depth_test or compare(ops.depth_func, z, stored_z)
    if ops.stencil_test:
        after_depth = stencil_op(ops.zpass, s, ref, largest) if depth_passed else stencil_op(ops.zfail, s, ref, largest)
        after = after_depth if stencil_passed else stencil_op(ops.sfail, s, ref, largest)
        s = np.uint8((s & ~write) | (after & write))
    passed = stencil_passed and depth_passed
    if ops.depth_write:
        stored_z = z if passed else stored_z
    return PASSED if passed else DEPTH_FAILED if stencil_passed else STENCIL_FAILED, s, stored_z
