"""Vertex stage: object space to clip space, and clip space to the window."""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, SMALLEST_NORMAL, ZERO
from softshadow.pipeline.geometry.clip import NEAR_FAR, write_outcodes
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import parts_of, share
from softshadow.state import Viewport

BLOCK = 1024  # vertices; their positions, 48 KB, stay in the cache


def to_clip(model_view_projection: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """Return the clip positions (V, 4) of object positions (V, 4)."""
    clip = np.empty_like(positions)
    transform(model_view_projection, positions, clip)
    return clip


def to_window(clip: np.ndarray, viewport: Viewport, framebuffer_height: int, flipped: bool) -> np.ndarray:
    """Return window x, y, z and 1/w (V, 4) of clip positions (V, 4).

    x and y are in pixels of the stored rows: y grows downwards in a flipped framebuffer (the window), upwards in an
    FBO. z is in the depth range. Vertices with w = 0 become infinite or NaN; clipping removes them.

    References
    ----------
    GL 2.1, sec. 2.11 (coordinate transformations).
    """
    window = np.empty_like(clip)
    write_window(clip, *scale_and_shift(viewport, framebuffer_height, flipped, clip.dtype), window)
    return window


def process_vertices(
    model_view_projection: np.ndarray,
    positions: np.ndarray,
    user_planes: np.ndarray,
    depth_clamp: bool,
    viewport: Viewport,
    framebuffer_height: int,
    flipped: bool,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return `to_clip`, `outcodes` and `to_window` of object positions (V, 4)."""
    clip = scratch(positions.shape, positions.dtype)
    window = scratch(positions.shape, positions.dtype)
    codes = scratch(len(positions), np.int32)
    scale, shift = scale_and_shift(viewport, framebuffer_height, flipped, positions.dtype)
    planes, ignored = user_planes.astype(positions.dtype), NEAR_FAR if depth_clamp else 0

    parts = parts_of(len(positions))

    def process(part: int) -> None:
        process_rows(model_view_projection, positions, planes, ignored, scale, shift, *parts[part], clip, codes, window)

    share(process, len(parts))
    return clip, codes, window


def append_rows(window: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Return `window` with `rows` appended, in pooled memory."""
    joined = scratch((len(window) + len(rows), 4), window.dtype)
    return np.concatenate([window, rows], out=joined)


def scale_and_shift(
    viewport: Viewport, framebuffer_height: int, flipped: bool, dtype: np.dtype
) -> tuple[np.ndarray, np.ndarray]:
    """Return scale and shift (3,) of the viewport transform, from x/w, y/w, z/w to the window."""
    real = dtype.type
    near, far = real(viewport.near), real(viewport.far)
    half_height = viewport.height / 2
    if flipped:
        y_scale, y_shift = -half_height, framebuffer_height - (viewport.y + half_height)
    else:
        y_scale, y_shift = half_height, viewport.y + half_height
    scale = np.array([viewport.width / 2, y_scale, real(0.5) * (far - near)], dtype)
    shift = np.array([viewport.x + viewport.width / 2, y_shift, real(0.5) * (far + near)], dtype)
    return scale, shift


@inlined
def clip_position(matrix, positions, v, out):
    """Write ``matrix @ position`` of vertex `v` to its row of `out` (V, 4), in GL's order of operations.

    Each product and each sum is rounded on its own: ((c0 x + c1 y) + c2 z) + c3 w.
    """
    x, y, z, w = positions[v, 0], positions[v, 1], positions[v, 2], positions[v, 3]
    for i in range(4):
        out[v, i] = ((matrix[i, 0] * x + matrix[i, 1] * y) + matrix[i, 2] * z) + matrix[i, 3] * w


@inlined
def window_position(clip, v, scale, shift, window):
    """Write the window position of vertex `v` to its row of `window` (V, 4)."""
    over_w = ONE / clip[v, 3]
    if abs(over_w) < SMALLEST_NORMAL:
        over_w = ZERO  # llvmpipe flushes denormal results to 0
    for k in range(3):
        window[v, k] = (clip[v, k] * over_w) * scale[k] + shift[k]
    window[v, 3] = over_w


@kernel
def transform(matrix, positions, out):
    """Write the clip position of every vertex to `out`."""
    for v in range(positions.shape[0]):
        clip_position(matrix, positions, v, out)


@kernel
def process_rows(matrix, positions, planes, ignored, scale, shift, begin, stop, clip, codes, window):
    """Write clip position, clip code and window position of the vertices [begin, stop), by blocks."""
    for first in range(begin, stop, BLOCK):
        end = min(first + BLOCK, stop)
        transform(matrix, positions[first:end], clip[first:end])
        write_outcodes(clip[first:end], planes, ignored, codes[first:end])
        write_window(clip[first:end], scale, shift, window[first:end])


@kernel
def write_window(clip, scale, shift, window):
    """Write the window position of every vertex to `window`."""
    for v in range(clip.shape[0]):
        window_position(clip, v, scale, shift, window)
