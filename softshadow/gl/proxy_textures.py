"""Proxy textures: whether a texture of some size and format could be made, without making it.

References: GL 2.1, sec. 3.8.11.
"""

from __future__ import annotations

import numpy as np

from softshadow.context import Context
from softshadow.gl.texture_problems import Shape
from softshadow.image import STENCIL8, WITH_STENCIL, Format, Image


def define_proxy(
    context: Context, target: int, level: int, stored: Format | None, internal_format: int, shape: Shape
) -> None:
    """Set a level of a proxy texture; without a format, there can be no such texture, and the level is undefined."""
    if stored is None:
        context.proxies.pop((target, level), None)
        return
    width, height, slices = shape
    nothing = np.zeros((0, 0, 4), stored.dtype)
    stencil = None
    if internal_format in WITH_STENCIL:
        stencil = Image(STENCIL8, width, height, nothing[..., 0], slices=slices)
    context.proxies[target, level] = Image(stored, width, height, nothing, internal_format, stencil, slices=slices)
