"""GL_COMBINE as numbers for a kernel; equals `shade.shading.shade`, see fast/test_span_shading.py.

The kernel is `span_combine.combine_block`. A combine function is some switches: what is computed, whether the result is
clamped, and three arguments. An argument is a source, whether its alpha is taken, and whether it is subtracted from 1.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from softshadow import tokens as gl
from softshadow.programs.texture_combine import INVERTED, UNLIMITED
from softshadow.programs.vertex_color_use import ALPHAS
from softshadow.state import Combine

# switches of a function and, from ARGUMENTS on, of an argument
FUNCTION, IS_CLAMPED, ARGUMENTS, SWITCHES_OF_FUNCTION = 0, 1, 2, 11
SOURCE, TAKES_ALPHA, IS_INVERTED, SWITCHES_OF_ARGUMENT = range(4)
FIRST_ARGUMENT, SECOND_ARGUMENT, THIRD_ARGUMENT = (ARGUMENTS + n * SWITCHES_OF_ARGUMENT for n in range(3))
# sources that are not rows of the block
CONSTANT_COLOR, NO_COLOR = -1, -2
ONLY, PRODUCT, SUM, SIGNED_SUM, DIFFERENCE, MIXTURE, DOT_PRODUCT, SCALED_SUM, SAME = range(9)
FUNCTIONS = {
    gl.GL_REPLACE: ONLY, gl.GL_MODULATE: PRODUCT, gl.GL_ADD: SUM, gl.GL_ADD_SIGNED: SIGNED_SUM,
    gl.GL_SUBTRACT: DIFFERENCE, gl.GL_INTERPOLATE: MIXTURE, gl.GL_DOT3_RGB: DOT_PRODUCT, gl.GL_DOT3_RGBA: DOT_PRODUCT,
}  # fmt: skip


def write_combine(setting: Combine, sources: Mapping[int, int], switches: np.ndarray, scales: np.ndarray) -> None:
    """Write the switches of two functions, for RGB and alpha, and the two scales.

    Parameters
    ----------
    sources : GL source -> the first of the four rows that hold its colours, or `CONSTANT_COLOR`; others have no colour
    """
    rgb, alpha = switches[:SWITCHES_OF_FUNCTION], switches[SWITCHES_OF_FUNCTION:]
    scales[0], scales[1] = setting.rgb_scale, setting.alpha_scale
    _write_function(setting.mode_rgb, setting.sources_rgb, setting.operands_rgb, setting.rgb_scale, sources, rgb)
    if setting.mode_rgb == gl.GL_DOT3_RGBA:
        alpha[FUNCTION], alpha[IS_CLAMPED] = SAME, True
        return
    names = setting.mode_alpha, setting.sources_alpha, setting.operands_alpha
    _write_function(*names, setting.alpha_scale, sources, alpha)


def _write_function(
    mode: int, names: tuple[int, ...], operands: tuple[int, ...], scale: float, sources: Mapping[int, int],
    switches: np.ndarray,
) -> None:  # fmt: skip
    arguments = [
        (sources.get(name, NO_COLOR), operand in ALPHAS, operand in INVERTED)
        for name, operand in zip(names, operands, strict=True)
    ]
    first, second, third = arguments
    function = FUNCTIONS[mode]
    if mode == gl.GL_INTERPOLATE and third[2]:  # with the weight 1 - x the other argument has the weight x
        first, second, third = second, first, (*third[:2], False)
    if function == DOT_PRODUCT and (first[1] or second[1]):  # a scalar is the factor of the other one's sum
        function = SCALED_SUM
        first, second = (first, second) if first[1] else (second, first)
    switches[FUNCTION], switches[IS_CLAMPED] = function, scale != 1 or mode not in UNLIMITED
    switches[ARGUMENTS:SWITCHES_OF_FUNCTION] = (*first, *second, *third)
