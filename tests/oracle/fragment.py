"""The per-fragment operations for one fragment, written from the specification.

GL 2.1, sec. 4.1.2 (scissor), 4.1.4 (alpha), 4.1.5 (stencil), 4.1.6 (depth). Imports nothing from the pipeline.
"""

import operator

TESTS = {
    "GL_NEVER": lambda a, b: False,
    "GL_LESS": operator.lt,
    "GL_EQUAL": operator.eq,
    "GL_LEQUAL": operator.le,
    "GL_GREATER": operator.gt,
    "GL_NOTEQUAL": operator.ne,
    "GL_GEQUAL": operator.ge,
    "GL_ALWAYS": lambda a, b: True,
}


def stencil_after(op: str, stored: int, ref: int, bits: int) -> int:
    """Return the stencil value after an operation, before the write mask."""
    largest = 2**bits - 1
    return {
        "GL_KEEP": stored,
        "GL_ZERO": 0,
        "GL_REPLACE": ref,
        "GL_INCR": min(stored + 1, largest),
        "GL_DECR": max(stored - 1, 0),
        "GL_INVERT": stored ^ largest,
        "GL_INCR_WRAP": (stored + 1) % (largest + 1),
        "GL_DECR_WRAP": (stored - 1) % (largest + 1),
    }[op]


def fragment(state: dict, alpha: int, z: float, stored_z: float, stored: int) -> tuple[str, int, float]:
    """Return (verdict, stencil, depth) after a fragment.

    `state`: alpha (func, ref) or None; stencil (func, ref, read mask, sfail, zfail, zpass, write mask, bits) or None;
    depth (func, write) or None; scissored bool.
    """
    if state["scissored"]:
        return "scissor", stored, stored_z
    if state["alpha"]:
        func, ref = state["alpha"]
        if not TESTS[func](alpha, ref):
            return "alpha failed", stored, stored_z
    verdict = "passed"
    if state["stencil"]:
        func, ref, read, *_ = state["stencil"]
        bits = state["stencil"][-1]
        ref = min(max(ref, 0), 2**bits - 1)
        if not TESTS[func](ref & read, stored & read):
            verdict = "stencil failed"
    if verdict == "passed" and state["depth"] and not TESTS[state["depth"][0]](z, stored_z):
        verdict = "depth failed"
    if state["stencil"]:
        _, _, _, sfail, zfail, zpass, write, bits = state["stencil"]
        op = {"stencil failed": sfail, "depth failed": zfail, "passed": zpass}[verdict]
        new = stencil_after(op, stored, ref, bits)
        for bit in range(bits):
            if write >> bit & 1:
                stored = (stored & ~(1 << bit)) | (new & (1 << bit))
    if verdict == "passed" and state["depth"] and state["depth"][1]:
        stored_z = z
    return verdict, stored, stored_z
