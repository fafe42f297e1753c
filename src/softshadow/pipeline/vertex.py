"""Vertex stage: object space to clip space, and clip space to the window."""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.constants import SMALLEST_NORMAL
from softshadow.state import Viewport


@kernel
def transform(matrix, positions, out):
    """Write ``matrix @ position`` for each row of `positions` (V, 4) into `out` (V, 4), in GL's order of operations.

    Each product and each sum is rounded on its own: ((c0 x + c1 y) + c2 z) + c3 w.
    """
    for v in range(positions.shape[0]):
        x, y, z, w = positions[v, 0], positions[v, 1], positions[v, 2], positions[v, 3]
        for i in range(4):
            out[v, i] = ((matrix[i, 0] * x + matrix[i, 1] * y) + matrix[i, 2] * z) + matrix[i, 3] * w


def to_clip(model_view_projection: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """Return the clip positions (V, 4) of object positions (V, 4)."""
    clip = np.empty_like(positions)
    transform(model_view_projection, positions, clip)
    return clip


def to_window(clip: np.ndarray, viewport: Viewport, framebuffer_height: int, flipped: bool) -> np.ndarray:
    """Return window x, y, z and 1/w (V, 4) of clip positions (V, 4).

    x and y are in pixels of the stored rows: y grows downwards in a flipped framebuffer (the window), upwards in an
    FBO. z is in the depth range. Vertices with w = 0 become infinite or NaN; no triangle that is left after clipping
    has one.

    References
    ----------
    GL 2.1, sec. 2.11 (coordinate transformations).
    """
    real = clip.dtype.type
    near, far = real(viewport.near), real(viewport.far)
    half_height = viewport.height / 2
    if flipped:
        y_scale, y_shift = -half_height, framebuffer_height - (viewport.y + half_height)
    else:
        y_scale, y_shift = half_height, viewport.y + half_height
    scale = np.array([viewport.width / 2, y_scale, real(0.5) * (far - near)], clip.dtype)
    shift = np.array([viewport.x + viewport.width / 2, y_shift, real(0.5) * (far + near)], clip.dtype)
    window = np.empty_like(clip)
    over_w = real(1) / clip[:, 3]
    window[:, 3] = np.where(abs(over_w) < SMALLEST_NORMAL, real(0), over_w)  # llvmpipe flushes denormal results to 0
    window[:, :3] = (clip[:, :3] * window[:, 3:]) * scale + shift
    return window
