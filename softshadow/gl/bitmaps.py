"""glBitmap: a pattern of pixels at the raster position, as the text of GLUT draws it.

A bitmap becomes a draw: a quad for each run of set bits in a row. So it goes through the same tests as any other
fragment, and the history of a pixel shows it. The bitmaps of a text are one draw.

References: GL 2.1, sec. 3.7; drawpix.c and st_cb_bitmap.c of Mesa 22.3.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, cast

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, RasterPosition, current
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.conversions import single, singles
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.framebuffers import can_draw
from softshadow.gl.pixel_memory import source
from softshadow.gl.raster_draws import (
    EDGES,
    KEPT_VERTICES,
    MARGIN,
    MOST_VERTICES,
    colors_of,
    draw_at,
    indices_of,
    near_positions,
    packed,
    positions,
    raster_vertices,
    texcoords_of,
)
from softshadow.gl.render_modes import is_rendered
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.pixel_store import PixelStore, bitmap_rows

KEPT_PLACES = 64  # of a character, where it has been drawn
KEPT_BYTES = 512  # of a bitmap up to which it may be a character, which is drawn again
ROUNDING = single(0.0001)  # of Mesa: so much below a whole number is still that number


class PixelQuads:
    """Quads between whole pixels, such as the runs of set bits of a character, to be drawn at several places.

    Attributes
    ----------
    quads : (N, 4) int           left, bottom, right, top
    n_vertices, has_bits : 4 N, whether there are quads
    is_small : bool              whether it may be a character
    x, y : (4 N,) int            of the corners in Mesa's order; only of a small one
    """

    __slots__ = ("_bounds", "_placed", "has_bits", "is_small", "n_vertices", "quads", "x", "y")

    def __init__(self, quads: np.ndarray) -> None:
        self.quads, self.n_vertices, self.has_bits = quads, 4 * len(quads), len(quads) > 0
        self.is_small = 0 < self.n_vertices <= KEPT_VERTICES
        if self.is_small:
            self.x, self.y = (quads[:, EDGES[:, axis]].reshape(-1).astype(np.intp) for axis in (0, 1))
        if self.has_bits:
            self._bounds = *quads[:, :2].min(axis=0).tolist(), *quads[:, 2:].max(axis=0).tolist()
        self._placed: dict[tuple[Any, ...], Vertices] = {}  # the latest, by place and size of the framebuffer

    def vertices(self, left: int, bottom: int, size: tuple[int, int], raster: RasterPosition, real: Any) -> Vertices:
        """Return the corners of the quads so many pixels from the corner; the same object if a text is drawn again."""
        place, n = (left, bottom, size, real), self.n_vertices
        before = self._placed.get(place)
        color, texcoords = colors_of(raster, n, real), texcoords_of(raster, n, real)
        if before is not None and before.color is color and before.texcoords is texcoords:
            return before
        position = self._positions(left, bottom, size, real) if before is None else before.position
        vertices = raster_vertices(position, color, texcoords)
        if self.is_small:
            if len(self._placed) >= KEPT_PLACES:
                self._placed.clear()
            self._placed[place] = vertices
        return vertices

    def _positions(self, left: int, bottom: int, size: tuple[int, int], real: Any) -> np.ndarray:
        """Return the corners (4 N, 4) in normalized device coordinates."""
        if not (self.is_small and self.is_near(left, bottom, size)):
            return positions(self.quads + np.array([left, bottom, left, bottom]), size, real)
        return near_positions(self.x + left, self.y + bottom, size, real)

    def is_near(self, left: int, bottom: int, size: tuple[int, int]) -> bool:
        """Return whether the tables of coordinates reach far enough."""
        x0, y0, x1, y1 = self._bounds
        is_after_start = left + x0 >= -MARGIN and bottom + y0 >= -MARGIN
        return is_after_start and left + x1 <= size[0] + MARGIN and bottom + y1 <= size[1] + MARGIN

    def is_outside(self, left: int, bottom: int, size: tuple[int, int]) -> bool:
        """Return whether all quads, of which there is one at least, are outside of a framebuffer."""
        x0, y0, x1, y1 = self._bounds
        return left + x1 <= 0 or bottom + y1 <= 0 or left + x0 >= size[0] or bottom + y0 >= size[1]


class Text:
    """Small bitmaps in a row, with nothing between them that a draw depends on, to be one draw.

    Parameters
    ----------
    context : Context
    pixels, left, bottom         the first one, and its place

    Attributes
    ----------
    size : (width, height) of the framebuffer, in pixels
    """

    def __init__(self, context: Context, pixels: PixelQuads, left: int, bottom: int) -> None:
        self._first, self._real = draw_of_pixels(context, pixels, left, bottom), cast(Any, context.real)
        self._raster, self._labels = context.current.raster, context.labels.copy()
        self.size = context.objects.framebuffers[self._first.state.draw_framebuffer].size
        self._parts, self._n_vertices = [(pixels, left, bottom)], pixels.n_vertices
        self._are_near = pixels.is_near(left, bottom, self.size)

    def add(self, context: Context, pixels: PixelQuads, left: int, bottom: int) -> bool:
        """Add a bitmap; return False, and do nothing, if it must be a draw of its own."""
        raster, n_vertices = context.current.raster, self._n_vertices + pixels.n_vertices
        if not self._is_alike(raster) or context.labels != self._labels:
            return False
        if n_vertices > MOST_VERTICES or not (self._are_near and pixels.is_near(left, bottom, self.size)):
            return False
        self._parts.append((pixels, left, bottom))
        self._n_vertices = n_vertices
        return True

    def _is_alike(self, raster: RasterPosition) -> bool:
        """Return whether a raster position has the depth, colour and texture coordinates of the first one."""
        first = self._raster
        if raster.window[2] != first.window[2]:
            return False
        if raster.color is first.color and raster.texcoords is first.texcoords:
            return True
        if packed(raster.color, *raster.texcoords) != packed(first.color, *first.texcoords):
            return False
        self._raster = raster  # is compared with those that follow, which are often the same
        return True

    def command(self) -> Draw:
        """Return the draw of all bitmaps."""
        if len(self._parts) == 1:
            return self._first
        pixels, lefts, bottoms = zip(*self._parts, strict=True)
        counts = [each.n_vertices for each in pixels]
        x = np.concatenate([each.x for each in pixels]) + np.repeat(lefts, counts)
        y = np.concatenate([each.y for each in pixels]) + np.repeat(bottoms, counts)
        position = near_positions(x, y, self.size, self._real)
        n, raster, real = len(position), self._raster, self._real
        vertices = raster_vertices(position, colors_of(raster, n, real), texcoords_of(raster, n, real))
        return self._first._replace(vertices=vertices, indices=indices_of(len(position)))


def draw_of_pixels(context: Context, pixels: PixelQuads, left: int, bottom: int) -> Draw:
    """Return a draw of quads in the colour and at the depth of the raster position, so many pixels from the corner."""
    state, real = context.state, cast(Any, context.real)
    size = context.objects.framebuffers[state.draw_framebuffer].size
    return draw_at(context, state, size, pixels.vertices(left, bottom, size, context.current.raster, real))


def glBitmap(
    width: int, height: int, xorig: float, yorig: float, xmove: float, ymove: float, bitmap: Any = None
) -> None:
    """Draw the set bits of a bitmap in the raster colour, then move the raster position.

    Parameters
    ----------
    width, height : int          in pixels
    xorig, yorig : float         the place of the raster position in the bitmap
    xmove, ymove : float         added to the raster position, in pixels
    bitmap : bytes or array      rows from bottom to top, eight pixels a byte, as glPixelStore says; None draws nothing

    Raises
    ------
    GLError
        GL_INVALID_VALUE for a negative size; GL_INVALID_FRAMEBUFFER_OPERATION without a complete framebuffer.
    ValueError
        The bitmap has too few bytes.
    """
    context, pixels = current(), None
    store = context.unpack_store
    if (bitmap is not None or store.buffer) and width > 0 and height > 0:  # read now, also for a display list
        bytes_of_row = -(-(store.row_length or width) // (8 * store.alignment)) * store.alignment
        bitmap = source(context, bitmap, (store.skip_rows + int(height)) * bytes_of_row, 1, "glBitmap")
        if bitmap is None:
            return
        content = bitmap.tobytes() if isinstance(bitmap, np.ndarray) else bitmap
        are_kept = isinstance(content, bytes) and len(content) <= KEPT_BYTES
        pixels = (_kept_pixels if are_kept else _pixels)(content, context.unpack_store, int(width), int(height))
    xorig, yorig, xmove, ymove = singles((xorig, yorig, xmove, ymove))
    _bitmap(width, height, xorig, yorig, xmove, ymove, pixels)


@in_lists
def _bitmap(
    width: int, height: int, xorig: float, yorig: float, xmove: float, ymove: float, pixels: PixelQuads | None
) -> None:
    context = outside_begin("glBitmap")
    if context is None:
        return
    context.flush_vertices()  # Mesa does so whatever follows
    if width < 0 or height < 0:
        fail(gl.GL_INVALID_VALUE, "glBitmap", f"width={width}, height={height}: expected 0 or more")
        return
    (x, y, z, w), valid, distance, color, secondary, texcoords = context.current.raster
    if not valid:
        return
    if not can_draw(context, "glBitmap"):
        return
    # each sum of two numbers in single precision is rounded once
    if is_rendered(context, gl.GL_BITMAP_TOKEN) and pixels is not None and pixels.has_bits:
        left, bottom = singles((x + ROUNDING, y + ROUNDING))
        left, bottom = singles((left - xorig, bottom - yorig))
        _draw(context, pixels, math.floor(left), math.floor(bottom))
    window = *singles((x + xmove, y + ymove)), z, w
    context.current.raster = RasterPosition(window, True, distance, color, secondary, texcoords)


def _draw(context: Context, pixels: PixelQuads, left: int, bottom: int) -> None:
    """Draw a bitmap, a small one together with those that follow; one outside of the window has no fragments."""
    text = context.stream.text if isinstance(context.stream.text, Text) else None
    if pixels.is_outside(left, bottom, text.size if text is not None else _size_of_target(context)):
        return
    if text is not None and text.add(context, pixels, left, bottom):
        return
    context.flush()
    if pixels.is_small and context.stream.gate is None:
        context.stream.text, context.ready = Text(context, pixels, left, bottom), False
    else:
        context.execute(draw_of_pixels(context, pixels, left, bottom))


def _size_of_target(context: Context) -> tuple[int, int]:
    """Return the size of the framebuffer that is drawn to."""
    return context.objects.framebuffers[context.groups[""].fields["draw_framebuffer"]].size


def runs(bits: np.ndarray) -> np.ndarray:
    """Return (left, bottom, right, top) of each run of set bits in a row, (N, 4) integers.

    Examples
    --------
    >>> runs(np.array([[True, True, False, True]])).tolist()
    [[0, 0, 2, 1], [3, 0, 4, 1]]
    """
    padded = np.zeros((len(bits), bits.shape[1] + 2), np.int8)
    padded[:, 1:-1] = bits
    steps = np.diff(padded, axis=1)
    row, begin = np.nonzero(steps == 1)
    end = np.nonzero(steps == -1)[1]
    return np.stack([begin, row, end, row + 1], axis=1)


def _pixels(bitmap: Any, store: PixelStore, width: int, height: int) -> PixelQuads:
    return PixelQuads(runs(bitmap_rows(bitmap, store, width, height, "glBitmap")))


_kept_pixels = lru_cache(256)(_pixels)  # those of the characters of a text


__all__ = spelled_like_gl(globals())
