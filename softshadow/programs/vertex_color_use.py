"""Whether the fixed function's fragments depend on the vertex colour, or textures replace it.

Mesa's fragment programs have no unused inputs. This is visible because llvmpipe splits quads along the other diagonal
if an input is flat (lp_setup_vbuf.c).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from softshadow import tokens as gl
from softshadow.programs.texture_combine import ARGUMENTS
from softshadow.programs.texture_environment import WITHOUT_ALPHA
from softshadow.state import Combine, TextureUnit

RGB, ALPHA = "rgb", "alpha"
COLOR = frozenset((RGB, ALPHA))
ALPHAS = (gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)


class ColorUses(NamedTuple):
    """Whether the output colour depends on the vertex colour as GL_PREVIOUS, and as GL_PRIMARY_COLOR."""

    carried: bool
    by_name: bool


def vertex_color_uses(units: Sequence[tuple[TextureUnit, int]]) -> ColorUses:
    """Return how the output colour depends on the vertex colour.

    Parameters
    ----------
    units : settings of the units in use, with the base formats of their textures, in the order of texturing
    """
    needed, by_name = COLOR, False
    for setting, base in reversed(units):
        if setting.env_mode == gl.GL_COMBINE:
            inputs = [each for part in needed for each in _combine_inputs(setting.combine, part)]
            by_name |= any(source == gl.GL_PRIMARY_COLOR for source, _ in inputs)
            needed = frozenset(part for source, part in inputs if source == gl.GL_PREVIOUS)
        elif setting.env_mode == gl.GL_REPLACE:
            replaced = {RGB: base != gl.GL_ALPHA, ALPHA: base not in WITHOUT_ALPHA}
            needed = frozenset(part for part in needed if not replaced[part])
    return ColorUses(bool(needed), by_name)


def _combine_inputs(combine: Combine, part: str) -> list[tuple[int, str]]:
    """Return the inputs of GL_COMBINE for one part of its result: pairs of a source and the part it uses."""
    if part == ALPHA and combine.mode_rgb != gl.GL_DOT3_RGBA:
        return [(source, ALPHA) for source in combine.sources_alpha[: ARGUMENTS.get(combine.mode_alpha, 2)]]
    arguments = zip(combine.sources_rgb, combine.operands_rgb, strict=True)
    inputs = [(source, ALPHA if operand in ALPHAS else RGB) for source, operand in arguments]
    return inputs[: ARGUMENTS.get(combine.mode_rgb, 2)]
