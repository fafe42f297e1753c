"""Whether the fragments of the fixed function take the colour of the vertices, or textures replace it.

Mesa's fragment programs have no input that they do not use. It shows in how llvmpipe cuts quads: along the other
diagonal where an input is flat (lp_setup_vbuf.c).
"""

from __future__ import annotations

from collections.abc import Sequence

from softshadow import tokens as gl
from softshadow.programs.texture_combine import ARGUMENTS
from softshadow.programs.texture_environment import WITHOUT_ALPHA
from softshadow.state import Combine, TextureUnit

RGB, ALPHA = "rgb", "alpha"
COLOR = frozenset((RGB, ALPHA))
ALPHAS = (gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)


def uses_color(units: Sequence[tuple[TextureUnit, int]]) -> bool:
    """Return whether the colour that comes out of the units depends on the one that goes in.

    Parameters
    ----------
    units : what the units in use are set to, and the base formats of their textures, in the order of texturing
    """
    needed = COLOR
    for setting, base in reversed(units):
        if setting.env_mode == gl.GL_COMBINE:
            taken = [each for part in needed for each in _combined(setting.combine, part)]
            if any(source == gl.GL_PRIMARY_COLOR for source, _ in taken):
                return True
            needed = frozenset(part for source, part in taken if source == gl.GL_PREVIOUS)
        elif setting.env_mode == gl.GL_REPLACE:
            replaced = {RGB: base != gl.GL_ALPHA, ALPHA: base not in WITHOUT_ALPHA}
            needed = frozenset(part for part in needed if not replaced[part])
    return bool(needed)


def _combined(combine: Combine, part: str) -> list[tuple[int, str]]:
    """Return what GL_COMBINE takes for a part of its result: sources, and which part of each."""
    if part == ALPHA and combine.mode_rgb != gl.GL_DOT3_RGBA:
        return [(source, ALPHA) for source in combine.sources_alpha[: ARGUMENTS.get(combine.mode_alpha, 2)]]
    arguments = zip(combine.sources_rgb, combine.operands_rgb, strict=True)
    taken = [(source, ALPHA if operand in ALPHAS else RGB) for source, operand in arguments]
    return taken[: ARGUMENTS.get(combine.mode_rgb, 2)]
