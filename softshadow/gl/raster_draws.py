"""Draws of quads in window coordinates, in the colour and at the depth of the raster position.

glBitmap (`bitmaps`), glDrawPixels and glCopyPixels (`window_quads`) become such draws. What they have in common is
kept: text is made of many small ones.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from functools import lru_cache
from typing import Any, NamedTuple, cast

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, RasterPosition
from softshadow.framebuffer import DEFAULT
from softshadow.frozen import evolve, remembered
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.state import ClipPlanes, Cull, Polygon, State, Viewport

# the unit square in the order of Mesa's vertices; for images in framebuffer objects it counts rows from the top
CORNERS = np.array([[0, 1], [1, 1], [1, 0], [0, 0]])
CORNERS_FROM_TOP = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
EDGES = 2 * CORNERS + [0, 1]  # of left, bottom, right, top: x and y of each corner
TRIANGLES = np.array([0, 1, 2, 0, 2, 3])  # a fan, as in Mesa
MARGIN = 256  # pixels outside the window in which characters and rectangles often begin or end
KEPT_VERTICES = 1024  # of a draw; a character has some hundred
MOST_VERTICES = 1 << 14  # of a text: some hundred characters


def raster_vertices(position: np.ndarray, color: np.ndarray, texcoords: tuple[np.ndarray, ...]) -> Vertices:
    """Return vertices from arrays, which become read-only."""
    position.flags.writeable = False
    n = len(position)
    return Vertices(position, color, _for(n, _normals)(_room(n), position.dtype.type)[:n], texcoords)


def draw_at(
    context: Context,
    state: State,
    size: tuple[int, int],
    vertices: Vertices,
    clamps: bool = False,
    shown_at: tuple[int, int, int, int] | None = None,
) -> Draw:
    """Return a draw of quads at the depth of the raster position.

    Of the state, that of fragments applies; that of vertices and triangles is replaced.
    """
    real, n = cast(Any, context.real), len(vertices.position)
    return _blank_draw(real, len(vertices.texcoords))._replace(
        state=_without_vertex_stages(state, _whole(size), state.draw_framebuffer == DEFAULT, clamps),
        vertices=vertices,
        indices=indices_of(n),
        projection=_projection(context.current.raster.window[2], real),
        label="/".join(context.labels) if context.labels else "",
        shown_at=shown_at,
    )


def positions(quads: np.ndarray, size: tuple[int, int], real: Any) -> np.ndarray:
    """Return the corners (4 N, 4) of quads (N, 4) in pixels, in normalized device coordinates."""
    position = np.ones((len(quads), 4, 4), real)
    position[:, :, :2] = normalized(quads, size * 2, real)[:, EDGES]
    position[:, :, 2] = 0  # the projection adds the depth: in Mesa, fog is that of the distance 0
    return position.reshape(-1, 4)


def corners(x0: float, y0: float, x1: float, y1: float, size: tuple[int, int], real: Any) -> np.ndarray:
    """Return the corners (4, 4) of one quad, as `positions` does."""
    low, high = min(x0, y0, x1, y1), max(x0 - size[0], x1 - size[0], y0 - size[1], y1 - size[1])
    are_whole = x0.is_integer() and y0.is_integer() and x1.is_integer() and y1.is_integer()
    if not (are_whole and low >= -MARGIN and high <= MARGIN):
        return positions(np.array([[x0, y0, x1, y1]], np.float32), size, real)
    # as `near_positions`, which would take 4 us longer for arrays of four numbers
    left, right, bottom, top = int(x0) + MARGIN, int(x1) + MARGIN, int(y0) + MARGIN, int(y1) + MARGIN
    x, y = _coordinates(size[0], real), _coordinates(size[1], real)
    position = np.zeros((4, 4), real)
    position[:, 0] = x[left], x[right], x[right], x[left]
    position[:, 1] = y[top], y[top], y[bottom], y[bottom]
    position[:, 3] = 1
    return position


def near_positions(x: np.ndarray, y: np.ndarray, size: tuple[int, int], real: Any) -> np.ndarray:
    """Return corners (N, 4) in normalized device coordinates, of x and y in pixels not far outside of the window."""
    position = np.zeros((len(x), 4), real)
    position[:, 0] = _coordinates(size[0], real)[x + MARGIN]
    position[:, 1] = _coordinates(size[1], real)[y + MARGIN]
    position[:, 3] = 1
    return position


@lru_cache(16)
def _coordinates(side: int, real: Any) -> np.ndarray:
    """Return normalized device coordinates of the edges of pixels, from `MARGIN` before the window to as many after."""
    return normalized(np.arange(-MARGIN, side + MARGIN + 1), side, real)


def normalized(pixels: np.ndarray, size: Any, real: Any) -> np.ndarray:
    """Return normalized device coordinates of edges of pixels."""
    normalized = pixels.astype(real)
    normalized /= np.array(size, real)
    normalized *= real(2)
    normalized -= real(1)
    return normalized


# -- what is kept ------------------------------------------------------------------------------------------------------
def _for(n: int, kept: Any) -> Any:
    """Return a function that keeps its results; for more than so many vertices, one that does not."""
    return kept if n <= MOST_VERTICES else kept.__wrapped__


def _room(n: int) -> int:
    """Return for how many vertices arrays are kept of which `n` vertices have the first rows."""
    return 1 << (n - 1).bit_length() if KEPT_VERTICES < n <= MOST_VERTICES else n


class _LatestTexcoords(NamedTuple):
    """The texture coordinates of a raster position, and arrays of them.

    `arrays` by the number of vertices, `of_quads` by whether the quad is drawn to the window.
    """

    texcoords: tuple[tuple[float, ...], ...]
    real: Any
    arrays: dict[int, tuple[np.ndarray, ...]]
    of_quads: dict[bool, tuple[np.ndarray, ...]]


_latest_texcoords: list[_LatestTexcoords] = []  # at most one


def colors_of(raster: RasterPosition, n: int, real: Any) -> np.ndarray:
    """Return n equal colours: an array, since Mesa interpolates them."""
    return _equal_rows(raster.color, n, real)


def texcoords_of(raster: RasterPosition, n: int, real: Any) -> tuple[np.ndarray, ...]:
    """Return n equal texture coordinates of each unit, as arrays; a text has the same ones throughout."""
    latest = _latest_of(raster, real)
    arrays = latest.arrays.get(n)
    if arrays is None:
        arrays = tuple([_equal_rows(value, n, real) for value in raster.texcoords])
        if n <= KEPT_VERTICES:
            latest.arrays[n] = arrays
    return arrays


def texcoords_of_quad(raster: RasterPosition, in_window: bool, real: Any) -> tuple[np.ndarray, ...]:
    """Return the texture coordinates of a quad that shows the whole texture of unit 0; rows are those of Mesa's quad.

    Its rectangles share the arrays, as long as the raster position keeps its texture coordinates.
    """
    latest = _latest_of(raster, real)
    arrays = latest.of_quads.get(in_window)
    if arrays is None:
        first, *others = texcoords_of(raster, 4, real)
        first = first.copy()
        first[:, :2] = CORNERS if in_window else CORNERS_FROM_TOP
        first.flags.writeable = False
        arrays = latest.of_quads[in_window] = first, *others
    return arrays


def _latest_of(raster: RasterPosition, real: Any) -> _LatestTexcoords:
    latest = _latest_texcoords[:]
    if not latest or latest[0].texcoords is not raster.texcoords or latest[0].real is not real:
        latest = [_LatestTexcoords(raster.texcoords, real, {}, {})]
        _latest_texcoords[:] = latest
    return latest[0]


def packed(*values: Sequence[float]) -> bytes:
    """Return numbers as a key that tells -0 from 0."""
    return b"".join([struct.pack(f"{len(value)}d", *value) for value in values])


def _equal_rows(value: Sequence[float], n: int, real: Any) -> np.ndarray:
    rows: np.ndarray = _for(n, _kept_rows)(packed(value), _room(n), real)
    return rows if len(rows) == n else rows[:n]


@lru_cache(256)
def _kept_rows(numbers: bytes, n: int, real: Any) -> np.ndarray:
    return _repeated(np.frombuffer(numbers), n, real)


@lru_cache(256)
def _normals(n: int, real: Any) -> np.ndarray:
    return _repeated((0, 0, 1), n, real)


def _repeated(value: Any, n: int, real: Any) -> np.ndarray:
    rows = np.empty((n, len(value)), real)
    rows[:] = value
    rows.setflags(write=False)
    return rows


def indices_of(n_vertices: int) -> np.ndarray:
    """Return the indices of the triangles of quads."""
    indices: np.ndarray = _for(n_vertices, _indices)(_room(n_vertices) // 4)
    return indices[: n_vertices // 4 * len(TRIANGLES)]


@lru_cache(256)
def _indices(n_quads: int) -> np.ndarray:
    indices = (np.arange(0, 4 * n_quads, 4)[:, np.newaxis] + TRIANGLES).reshape(-1).astype(np.int32)
    indices.setflags(write=False)
    return indices


@lru_cache(16)
def _blank_draw(real: Any, n_units: int) -> Draw:
    """Return a draw of triangles under identity matrices, with one texture matrix per unit."""
    nothing, identity = np.empty((0, 4), real), np.eye(4, dtype=real)
    identity.setflags(write=False)
    vertices = Vertices(nothing, nothing, nothing[:, :3], (nothing,) * n_units)
    return Draw(State(), gl.GL_TRIANGLES, vertices, None, identity, identity, (identity,) * n_units, modelview_kind=0)


@lru_cache(256)
def _projection(depth: float, real: Any) -> np.ndarray:
    """Return the matrix that moves z = 0 to a depth of the window."""
    projection = np.eye(4)
    projection[2, 3] = real(depth) * real(2) - real(1)
    projection = projection.astype(real)
    projection.setflags(write=False)
    return projection


@lru_cache(16)
def _whole(size: tuple[int, int]) -> Viewport:
    """Return the viewport of a whole framebuffer; the same object for the same size."""
    return Viewport(0, 0, *size)


@remembered
def _without_vertex_stages(state: State, viewport: Viewport, in_window: bool, clamps: bool) -> State:
    """Return the state with all that concerns vertices and triangles as in the initial state, except depth clamping."""
    return evolve(
        state,
        viewport=viewport,
        cull=Cull(front_face=gl.GL_CW if in_window else gl.GL_CCW),  # as in Mesa, for the stencil test of two sides
        polygon=Polygon(upper_edges=state.polygon.upper_edges),
        lighting=evolve(state.lighting, enabled=False),
        clip_planes=ClipPlanes(),
        depth=evolve(state.depth, clamp=clamps),
        units=tuple(evolve(unit, gen=tuple(evolve(each, enabled=False) for each in unit.gen)) for unit in state.units),
        program=0,
    )
