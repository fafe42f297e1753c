"""GL_COMBINE: a texture environment defined by sources, operands, a function and a scale, as in Mesa.

References: GL 2.1 sec. 3.8.13, tables 3.24 to 3.27 (and the crossbar: a source may be another unit's texture);
ff_fragment_shader.cpp of Mesa 22.3 (order of operations, and which results are clamped to [0, 1]).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from softshadow import tokens as gl
from softshadow.programs.texture_environment import saturated
from softshadow.state import Combine

ZERO, HALF, ONE, TWO = np.float32(0.0), np.float32(0.5), np.float32(1.0), np.float32(2.0)
ARGUMENTS = {gl.GL_REPLACE: 1, gl.GL_INTERPOLATE: 3}  # other functions take two
UNLIMITED = (gl.GL_REPLACE, gl.GL_MODULATE, gl.GL_INTERPOLATE)
INVERTED = (gl.GL_ONE_MINUS_SRC_COLOR, gl.GL_ONE_MINUS_SRC_ALPHA)


@dataclass(frozen=True)
class Sources:
    """The colours (N, 4) that the sources of a unit can be; `texels` by unit, zeros for a unit without texture."""

    unit: int
    texels: Mapping[int, np.ndarray]
    primary: np.ndarray
    previous: np.ndarray
    constant: tuple[float, float, float, float]

    def color(self, source: int) -> np.ndarray:
        """Return the colours (n, 4) of a source such as GL_PREVIOUS."""
        if source == gl.GL_PREVIOUS:
            return self.previous
        if source == gl.GL_PRIMARY_COLOR:
            return self.primary
        if source == gl.GL_CONSTANT:
            return np.array([self.constant], self.previous.dtype).clip(ZERO, ONE)
        unit = self.unit if source == gl.GL_TEXTURE else source - gl.GL_TEXTURE0
        return self.texels[unit] if unit in self.texels else np.zeros((1, 4), self.previous.dtype)


def combine(setting: Combine, sources: Sources) -> np.ndarray:
    """Return the combined colours (N, 4) of a unit."""
    out = np.empty_like(sources.previous)
    rgba = setting.mode_rgb == gl.GL_DOT3_RGBA
    rgb = _arguments(setting.sources_rgb, setting.operands_rgb, sources, slice(0, 3), setting.mode_rgb)
    value = _function(setting.mode_rgb, rgb)
    out[:, :3] = _scale(value, setting.rgb_scale, setting.mode_rgb)
    if rgba:
        out[:, 3:] = _scale(value, setting.alpha_scale, setting.mode_rgb)
        return out
    alpha = _arguments(setting.sources_alpha, setting.operands_alpha, sources, slice(3, 4), setting.mode_alpha)
    out[:, 3:] = _scale(_function(setting.mode_alpha, alpha), setting.alpha_scale, setting.mode_alpha)
    return out


def _arguments(
    names: tuple[int, ...], operands: tuple[int, ...], sources: Sources, channels: slice, mode: int
) -> list[np.ndarray]:
    arguments: list[np.ndarray] = []
    for name, operand in list(zip(names, operands, strict=True))[: ARGUMENTS.get(mode, 2)]:
        color = sources.color(name)
        value = color[:, 3:] if operand in (gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA) else color[:, channels]
        if mode == gl.GL_ADD_SIGNED and not arguments:  # Mesa subtracts 1/2 from the first argument, before the sum
            arguments.append(HALF - value if operand in INVERTED else value - HALF)
        else:
            arguments.append(ONE - value if operand in INVERTED else value)
    if mode == gl.GL_INTERPOLATE:  # one minus the weight; for the weight 1 - x this is x itself
        arguments.append(value if operand in INVERTED else ONE - value)
    return arguments


def _function(mode: int, arguments: list[np.ndarray]) -> np.ndarray:
    a, *rest = arguments
    if mode == gl.GL_REPLACE:
        return a
    b = rest[0]
    if mode == gl.GL_MODULATE:
        return a * b
    if mode in (gl.GL_ADD, gl.GL_ADD_SIGNED):
        return a + b
    if mode == gl.GL_SUBTRACT:
        return a - b
    if mode == gl.GL_INTERPOLATE:
        return a * rest[1] + b * rest[2]
    a, b = a * TWO - ONE, b * TWO - ONE
    if a.shape[1] == 1 or b.shape[1] == 1:  # Mesa factors out a scalar
        factor, other = (a, b) if a.shape[1] == 1 else (b, a)
        x, y, z = (other[:, c : c + 1] for c in ((0, 1, 2) if other.shape[1] == 3 else (0, 0, 0)))
        return factor * ((z + y) + x)
    return ((a[:, 2:] * b[:, 2:]) + a[:, 1:2] * b[:, 1:2]) + a[:, :1] * b[:, :1]


def _scale(value: np.ndarray, scale: float, mode: int) -> np.ndarray:
    if scale != 1:
        return saturated(value * np.float32(scale))
    return value if mode in UNLIMITED else saturated(value)
