"""Fog: the fog factor of fragments, and the blend with the fog colour.

References: GL 2.1 sec. 3.10. The exponential is llvmpipe's 2^x (`llvmpipe_math`), with constants folded as in Mesa.
"""

from __future__ import annotations

import math

import numpy as np

from softshadow import tokens as gl
from softshadow.errors import StateError
from softshadow.programs.llvmpipe_math import exp2_of_all
from softshadow.state import Fog

ZERO, ONE = np.float32(0.0), np.float32(1.0)


def exp2(x: np.ndarray) -> np.ndarray:
    """Return two to the power of x, as llvmpipe approximates it."""
    raised = np.empty_like(x)
    exp2_of_all(x, raised)
    return raised


def fog_factor(fog: Fog, distance: np.ndarray) -> np.ndarray:
    """Return the fog factor (N,), the share in [0, 1] of the fragment's own colour, at eye distances (N,)."""
    if fog.mode == gl.GL_LINEAR:
        slope, shift = linear_terms(fog)
        factor = distance * slope + shift
    elif fog.mode == gl.GL_EXP:
        factor = exp2(-(distance * scaled_density(fog)))
    elif fog.mode == gl.GL_EXP2:
        scaled = distance * scaled_density(fog)
        factor = exp2(-(scaled * scaled))
    else:
        raise StateError(f"GL_FOG_MODE is {gl.token_name(fog.mode)}: expected GL_LINEAR, GL_EXP or GL_EXP2")
    share: np.ndarray = np.fmin(np.fmax(factor, ZERO), ONE)
    return share


def linear_terms(fog: Fog) -> tuple[np.float32, np.float32]:
    """Return slope and shift of GL_LINEAR fog, whose factor is ``distance * slope + shift``."""
    slope = ONE if fog.end == fog.start else -ONE / (np.float32(fog.end) - np.float32(fog.start))
    return slope, np.float32(fog.end) * -slope


def scaled_density(fog: Fog) -> np.float32:
    """Return the density of GL_EXP or GL_EXP2 fog, scaled for powers of two."""
    scale = math.log2(math.e) if fog.mode == gl.GL_EXP else 1 / math.sqrt(math.log(2))
    return np.float32(float(np.float32(fog.density)) * scale)  # a product of doubles, as in Mesa (prog_statevars.c)


def apply_fog(fragment: np.ndarray, fog: Fog, distance: np.ndarray) -> None:
    """Blend the fog colour into the RGB of fragments (N, 4) at eye distances (N,); alpha is unchanged."""
    factor = fog_factor(fog, distance)[:, np.newaxis]
    color = np.array(fog.color[:3], np.float32).clip(ZERO, ONE)
    fragment[:, :3] = color * (ONE - factor) + fragment[:, :3] * factor
