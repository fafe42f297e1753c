"""Proxy textures: whether a texture of some size and format could be made, without making it.

References: GL 2.1, sec. 3.8.11.
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.framebuffer import LARGEST_SIDE
from softshadow.image import STENCIL8, WITH_STENCIL, Format, Image

PROXIES = (gl.GL_PROXY_TEXTURE_2D, gl.GL_PROXY_TEXTURE_CUBE_MAP)
LARGEST_BYTES = 1 << 30  # of a texture, in llvmpipe


def define_proxy(
    context: Context, target: int, level: int, stored: Format, internal_format: int, width: int, height: int
) -> None:
    """Set a level of a proxy texture; if a texture cannot have it, the level becomes undefined."""
    largest = LARGEST_SIDE >> level
    pixel = np.dtype(stored.dtype).itemsize * stored.channels
    faces = 6 if target == gl.GL_PROXY_TEXTURE_CUBE_MAP else 1
    fits = width <= largest and height <= largest and faces * width * height * pixel <= LARGEST_BYTES
    fits = fits and (faces == 1 or width == height)
    if not fits:
        context.proxies.pop((target, level), None)
        return
    nothing = np.zeros((0, 0, 4), stored.dtype)
    stencil = Image(STENCIL8, width, height, nothing[..., 0]) if internal_format in WITH_STENCIL else None
    context.proxies[target, level] = Image(stored, width, height, nothing, internal_format, stencil)
