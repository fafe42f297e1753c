"""Texture environments: the texture functions that combine texel and fragment colour, by mode and base format.

References: GL 2.1 sec. 3.8.13, tables 3.22 and 3.23. In cases that the tables leave undefined (GL_DECAL with formats
other than RGB and RGBA) the fragment's colour is unchanged, as in Mesa.
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl

ZERO, ONE = np.float32(0.0), np.float32(1.0)
WITHOUT_ALPHA = (gl.GL_LUMINANCE, gl.GL_RED, gl.GL_RG, gl.GL_RGB)
MODES = (gl.GL_MODULATE, gl.GL_REPLACE, gl.GL_DECAL, gl.GL_BLEND, gl.GL_ADD)


def mix(a: np.ndarray, b: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return a (1 - weight) + b weight."""
    mixed: np.ndarray = b * weight + a * (ONE - weight)
    return mixed


def saturated(values: np.ndarray) -> np.ndarray:
    """Return values clamped to [0, 1], NaN as 0; as `filtering.clamp_to_unit`."""
    clamped: np.ndarray = np.where(values > ZERO, np.minimum(values, ONE), ZERO)
    return clamped


def apply_environment(
    fragment: np.ndarray, texel: np.ndarray, mode: int, base: int, env_color: tuple[float, float, float, float]
) -> None:
    """Apply a texture function to the fragments' RGBA (N, 4), in place, with the texels' RGBA (N, 4)."""
    constant = np.array(env_color, fragment.dtype).clip(ZERO, ONE)
    rgb, alpha = fragment[:, :3], fragment[:, 3]
    texel_rgb, texel_alpha = texel[:, :3], texel[:, 3]
    has_color, has_alpha = base != gl.GL_ALPHA, base not in WITHOUT_ALPHA
    if mode == gl.GL_REPLACE:
        if has_color:
            rgb[:] = texel_rgb
        if has_alpha:
            alpha[:] = texel_alpha
    elif mode == gl.GL_DECAL:
        if base in (gl.GL_RGB, gl.GL_RED, gl.GL_RG):
            rgb[:] = texel_rgb
        elif base == gl.GL_RGBA:
            rgb[:] = mix(rgb, texel_rgb, texel[:, 3:])
    else:
        if has_color:
            if mode == gl.GL_MODULATE:
                rgb *= texel_rgb
            elif mode == gl.GL_ADD:
                rgb[:] = saturated(rgb + texel_rgb)
            else:
                rgb[:] = mix(rgb, constant[:3], texel_rgb)
        if has_alpha:
            if base == gl.GL_INTENSITY and mode == gl.GL_ADD:
                alpha[:] = saturated(alpha + texel_alpha)
            elif base == gl.GL_INTENSITY and mode == gl.GL_BLEND:
                alpha[:] = mix(alpha, constant[3], texel_alpha)
            else:
                alpha *= texel_alpha
