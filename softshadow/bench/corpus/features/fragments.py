"""Features of the per-fragment operations."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.bench.corpus.features.feature import Feature, feature, setting

BLENDS = {
    "alpha": ("GL_SRC_ALPHA", "GL_ONE_MINUS_SRC_ALPHA"),
    "added": ("GL_ONE", "GL_ONE"),
    "multiplied": ("GL_DST_COLOR", "GL_ZERO"),
    "target-alpha": ("GL_ONE_MINUS_DST_ALPHA", "GL_DST_ALPHA"),
    "constant": ("GL_CONSTANT_COLOR", "GL_ONE_MINUS_CONSTANT_ALPHA"),
}
EQUATIONS = ("FUNC_SUBTRACT", "FUNC_REVERSE_SUBTRACT", "MIN", "MAX")
LOGIC = ("XOR", "INVERT", "OR")
STENCIL_OPS = ("REPLACE", "INCR", "INCR_WRAP", "INVERT")


def _blend(name: str) -> Feature:
    return setting(
        f"blend-{name}", f"blending by {', '.join(BLENDS[name])}", "GL_BLEND", glBlendFunc=BLENDS[name],
        glBlendColor=(0.3, 0.5, 0.7, 0.4),
    )  # fmt: skip


def _equation(name: str) -> Feature:
    return setting(
        f"equation-{name.lower().replace('_', '-')}", f"blending by GL_{name}", "GL_BLEND",
        glBlendEquation=(f"GL_{name}",), glBlendFunc=("GL_ONE", "GL_ONE"),
    )  # fmt: skip


def _stencil(op: str) -> Feature:
    return setting(
        f"stencil-{op.lower().replace('_', '-')}", f"stencil operation GL_{op}", "GL_STENCIL_TEST",
        glStencilFunc=("GL_ALWAYS", 5, 255), glStencilOp=("GL_KEEP", "GL_KEEP", f"GL_{op}"),
    )  # fmt: skip


def stencil_of_both_sides(gl: Any) -> None:
    """Other stencil operations for back faces."""
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 255)
    gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, gl.GL_DECR_WRAP, gl.GL_KEEP)
    gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, gl.GL_INCR_WRAP, gl.GL_KEEP)


def blend_separate(gl: Any) -> None:
    """Blending with other factors for alpha."""
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFuncSeparate(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA, gl.GL_ONE, gl.GL_ZERO)


def polygon_stipple(gl: Any) -> None:
    """A polygon stipple."""
    gl.glEnable(gl.GL_POLYGON_STIPPLE)
    gl.glPolygonStipple(np.tile(np.array([0xAA, 0x55], np.uint8).repeat(4), 16))


FEATURES = (
    *map(_blend, BLENDS),
    *map(_equation, EQUATIONS),
    *map(_stencil, STENCIL_OPS),
    *(
        setting(f"logic-{op.lower()}", f"logic operation GL_{op}", "GL_COLOR_LOGIC_OP", glLogicOp=(f"GL_{op}",))
        for op in LOGIC
    ),
    *map(feature, (stencil_of_both_sides, blend_separate, polygon_stipple)),
    setting("alpha-test", "an alpha test", "GL_ALPHA_TEST", glAlphaFunc=("GL_GREATER", 0.4)),
    setting("scissor", "a scissor box", "GL_SCISSOR_TEST", glScissor=(100, 80, 300, 250)),
    setting("depth-always", "a depth test that always passes", glDepthFunc=("GL_ALWAYS",)),
    setting("depth-lequal", "depth test GL_LEQUAL", glDepthFunc=("GL_LEQUAL",)),
    setting("depth-greater", "depth test GL_GREATER", glDepthFunc=("GL_GREATER",), glClearDepth=(0.0,)),
    setting("depth-not-written", "depths that are not written", glDepthMask=(False,)),
    setting("no-depth-test", "no depth test", glDisable=("GL_DEPTH_TEST",)),
    setting("depth-range", "a small depth range", glDepthRange=(0.25, 0.75)),
    setting("color-mask", "two of four colour channels", glColorMask=(True, False, True, False)),
    setting("no-color", "depths without colours", glColorMask=(False, False, False, False)),
    setting("fog-linear", "linear fog", "GL_FOG", glFogi=("GL_FOG_MODE", "GL_LINEAR"), glFogf=("GL_FOG_END", 5.0)),
    setting("fog-exp", "exponential fog", "GL_FOG", glFogi=("GL_FOG_MODE", "GL_EXP"), glFogf=("GL_FOG_DENSITY", 0.3)),
    setting("fog-exp2", "squared fog", "GL_FOG", glFogi=("GL_FOG_MODE", "GL_EXP2"), glFogf=("GL_FOG_DENSITY", 0.3)),
)  # fmt: skip
