"""glBlitFramebuffer: rectangles from framebuffer to framebuffer, scaled and mirrored.

llvmpipe draws a textured rectangle, and so do we where it is scaled: which of two equally near texels a pixel gets, and
the last bits of a filtered colour, follow from interpolation and sampling in the pipeline. Without scaling, each pixel
gets the texel at its centre. Rows are those in storage: they begin at the top in the window and at the bottom in
framebuffer objects, so a copy between the two is mirrored.

References: GL 4.5 compatibility, sec. 18.3.1; Mesa, main/blit.c, main/image.c and gallium's util/u_blitter.c.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import DEFAULT, Attachment, Framebuffer, Storage
from softshadow.image import FORMATS, Image
from softshadow.pipeline.buffers.copy import convert_color
from softshadow.pipeline.commands import BlitFramebuffer, Draw, Vertices
from softshadow.pipeline.constants import HALF
from softshadow.pixels import LARGEST_UINT, quantized_depth, sampled_depth
from softshadow.state import Scissor, State, TextureUnit, Viewport
from softshadow.texture import Sampler, Texture

DrawFunction = Callable[[Draw, Storage], None]

F32 = np.float32
FARTHEST = 1 << 14  # up to here, a centre that is interpolated in float32 is off by some thousandths of a texel
KEPT = 64  # scaled blits whose texels are kept
Index = Any  # of rows and columns


class Rectangles(NamedTuple):
    """Where a blit reads and writes, in stored rows; `box` (left, first row, right, end row) may be written.

    `cut`: a part was clipped off; `in_texels`: the source is the window, which Mesa reads as a rectangle texture, with
    coordinates that are not divided by the size.
    """

    source: tuple[int, int, int, int]
    target: tuple[int, int, int, int]
    box: tuple[int, int, int, int]
    cut: bool
    in_texels: bool

    @property
    def scaled(self) -> bool:
        """Whether the two rectangles differ in size."""
        (a, b, c, d), (e, f, g, h) = self.source, self.target
        return (abs(c - a), abs(d - b)) != (abs(g - e), abs(h - f))

    @property
    def straight(self) -> bool:
        """Whether pixels are copied one to one: no scaling, no mirroring, nothing cut off."""
        (a, b, c, d), (e, f, g, h) = self.source, self.target
        return not self.cut and (c - a, d - b) == (g - e, h - f)


def blit(command: BlitFramebuffer, storage: Storage, draw: DrawFunction) -> None:
    """Copy the buffers that both framebuffers have; `draw` is `softshadow.pipeline.draw`."""
    source, target = storage.framebuffers[command.read], storage.framebuffers[command.draw]
    rectangles = rectangles_of(command, source, target)
    if rectangles is None:
        return
    if command.mask & gl.GL_COLOR_BUFFER_BIT and source.read_color is not None:
        for image in target.colors:
            _blit_color(source.read_color, image, rectangles, command.filter, draw)
    stencils = (source.stencil, target.stencil) if command.mask & gl.GL_STENCIL_BUFFER_BIT else (None, None)
    if command.mask & gl.GL_DEPTH_BUFFER_BIT and source.depth is not None and target.depth is not None:
        is_32_bit = target.depth.format.largest == LARGEST_UINT  # llvmpipe copies 32 bits as integers (lp_surface.c)
        unchanged = is_32_bit or (rectangles.straight and _depth_is_unchanged(source, target, None not in stencils))
        where, texels = nearest_texels(source.depth, target.depth, rectangles, draw)
        cells = source.depth.read_cells[texels]
        if not unchanged:
            cells = quantized_depth(sampled_depth(cells, source.depth.format), target.depth.format)
        target.depth.view[where] = cells
    source_stencil, target_stencil = stencils
    if source_stencil is not None and target_stencil is not None:
        where, texels = nearest_texels(source_stencil, target_stencil, rectangles, draw)
        target_stencil.view[where] = source_stencil.read_cells[texels]


def _blit_color(source: Image, target: Image, rectangles: Rectangles, texture_filter: int, draw: DrawFunction) -> None:
    if texture_filter == gl.GL_LINEAR and rectangles.scaled:  # without scaling, the blitter does not filter
        texels = source if rectangles.in_texels else source.copy()  # it may draw to itself; padding makes a copy
        draw_image(texels, target, rectangles, gl.GL_LINEAR, draw)
        return
    where, texels = nearest_texels(source, target, rectangles, draw)
    colors = convert_color(source.read_cells[texels], source, target)
    if all(target.format.written):
        target.view[where] = colors
        return
    for channel in np.flatnonzero(target.format.written):
        target.view[..., channel][where] = colors[..., channel]


def _depth_is_unchanged(source: Framebuffer, target: Framebuffer, with_stencil: bool) -> bool:
    """Return whether depth is copied unchanged, as Mesa does where all bits of the target's format are copied.

    Otherwise depth goes through float32.
    """
    if with_stencil and _has_packed_stencil(source) and _has_packed_stencil(target):
        return True
    return not (_has_stencil_bits(target) or _has_packed_stencil(source))


def _has_packed_stencil(target: Framebuffer) -> bool:
    depth, stencil = target.depth, target.stencil
    return target.name == DEFAULT or (depth is not None and stencil is not None and depth.stencil is stencil)


def _has_stencil_bits(target: Framebuffer) -> bool:
    return target.name == DEFAULT or (target.depth is not None and target.depth.stencil is not None)


# -- rectangles --------------------------------------------------------------------------------------------------------
def rectangles_of(command: BlitFramebuffer, source: Framebuffer, target: Framebuffer) -> Rectangles | None:
    """Return the rectangles of a blit after clipping, None where nothing is left."""
    sx0, sy0, sx1, sy1 = command.source
    dx0, dy0, dx1, dy1 = command.target
    (read_width, read_height), (width, height) = source.size, target.size
    left, bottom, right, top = 0, 0, width, height
    if command.scissor.enabled:
        box = command.scissor
        left, bottom = max(left, box.x), max(bottom, box.y)
        right, top = min(right, box.x + box.width), min(top, box.y + box.height)
    columns = _clipped((sx0, sx1), (dx0, dx1), read_width, left, right)
    rows = _clipped((sy0, sy1), (dy0, dy1), read_height, bottom, top)
    if columns is None or rows is None or columns[0] == columns[1] or rows[0] == rows[1]:
        return None
    is_cut = (columns, rows) != ((dx0, dx1), (dy0, dy1))
    if target.flipped:
        dy0, dy1, rows = height - dy0, height - dy1, (height - rows[0], height - rows[1])
    if source.flipped:
        sy0, sy1 = read_height - sy0, read_height - sy1
    if dx0 > dx1:
        dx0, dx1, sx0, sx1 = dx1, dx0, sx1, sx0
    if dy0 > dy1:
        dy0, dy1, sy0, sy1 = dy1, dy0, sy1, sy0
    written_box = (min(columns), min(rows), max(columns), max(rows))
    if min(written_box) < 0:  # Mesa's scissor box has unsigned numbers: this one is beyond all pixels
        return None
    return Rectangles((sx0, sy0, sx1, sy1), (dx0, dy0, dx1, dy1), written_box, is_cut, source.name == DEFAULT)


Span = tuple[int, int]


def _clipped(source: Span, target: Span, read_end: int, first: int, end: int) -> Span | None:
    """Return the rest of the target's span after both are clipped, None for nothing (Mesa, _mesa_clip_blit)."""
    for span, low, high in ((target, first, end), (source, 0, read_end)):
        if span[0] == span[1] or low >= high or max(span) <= low or min(span) >= high:
            return None
    source, target = _cut_above(source, target, end)
    source, target = _cut_below(source, target, first)
    if source[0] == source[1]:  # empty after rounding: outside of the source, Mesa would divide by 0
        inside = source[0] <= read_end and (source[0] >= 0 or target[0] < target[1])
        return target if inside else None
    target, source = _cut_above(target, source, read_end)
    target, source = _cut_below(target, source, 0)
    return target


def _cut_above(follows: Span, cut: Span, end: int) -> tuple[Span, Span]:
    (a0, a1), (b0, b1) = follows, cut
    if b1 > end:
        return (a0, a0 + _part(end - b0, b1 - b0, a1 - a0)), (b0, end)
    if b0 > end:
        return (a1 + _part(end - b1, b0 - b1, a0 - a1), a1), (end, b1)
    return follows, cut


def _cut_below(follows: Span, cut: Span, first: int) -> tuple[Span, Span]:
    (a0, a1), (b0, b1) = follows, cut
    if b0 < first:
        return (a0 + _part(first - b0, b1 - b0, a1 - a0), a1), (first, b1)
    if b1 < first:
        return (a0, a1 + _part(first - b1, b0 - b1, a0 - a1)), (b0, first)
    return follows, cut


def _part(cut: int, whole: int, length: int) -> int:
    """Return ``length * cut / whole``, computed in float32 and rounded."""
    return int(F32(cut) / F32(whole) * F32(length) + (HALF if length > 0 else -HALF))


# -- texels of pixels --------------------------------------------------------------------------------------------------
_known: dict[Hashable, tuple[Index, Index]] = {}  # by sizes and rectangles


def nearest_texels(source: Image, target: Image, rectangles: Rectangles, draw: DrawFunction) -> tuple[Index, Index]:
    """Return the index of the pixels of the target that are written, and that of their texels."""
    if not rectangles.scaled and max(map(abs, (*rectangles.source, *rectangles.target))) <= FARTHEST:
        unscaled = unscaled_texels(source, target, rectangles)
        if unscaled is not None:
            return unscaled
    key = source.width, source.height, target.width, target.height, rectangles
    if key in _known:
        return _known[key]
    where, texels = drawn_texels(source, target, rectangles, draw)
    if isinstance(where[0], slice):
        if len(_known) >= KEPT:
            _known.clear()
        _known[key] = where, texels
    return where, texels


def unscaled_texels(source: Image, target: Image, rectangles: Rectangles) -> tuple[Index, Index] | None:
    """Return what `drawn_texels` returns, as slices, where nothing is scaled; None if some lie outside of the images.

    Mesa's clipping leaves such pixels and texels where a rectangle is clipped on both sides.
    """
    left, first, right, end = rectangles.box
    (x0, y0, x1, y1), (to_x, to_y, _, _) = rectangles.source, rectangles.target
    columns = _texels((left, right), target.width, to_x, (x0, x1), source.width)
    rows = _texels((first, end), target.height, to_y, (y0, y1), source.height)
    return None if columns is None or rows is None else (np.s_[first:end, left:right], (rows, columns))


def _texels(pixels: Span, size: int, to: int, texels: Span, n_texels: int) -> slice | None:
    """Return the texels of pixels on one axis; `to` is the pixel of the first texel, or of the last one if mirrored."""
    (first, end), (start, stop) = pixels, texels
    step = 1 if start < stop else -1
    begin = start + first - to if step > 0 else start - 1 - (first - to)
    last = begin + step * (end - 1 - first)
    if first < 0 or end > size or min(begin, last) < 0 or max(begin, last) >= n_texels:
        return None
    return slice(begin, last + step if last + step >= 0 else None, step)


def drawn_texels(source: Image, target: Image, rectangles: Rectangles, draw: DrawFunction) -> tuple[Index, Index]:
    """Return the pixels and texels of `nearest_texels` by drawing the numbers of the texels.

    They are slices and one number per row and column, where that is enough.
    """
    texel_numbers = Image.new(FORMATS[gl.GL_RGBA32F], source.width, source.height)
    texel_numbers.view[..., 0], texel_numbers.view[..., 1] = np.arange(source.height)[:, None], np.arange(source.width)
    looked_up = Image.new(FORMATS[gl.GL_RGBA32F], target.width, target.height)
    looked_up.view[...] = -1
    draw_image(texel_numbers, looked_up, rectangles, gl.GL_NEAREST, draw)
    left, first, right, end = np.maximum(rectangles.box, 0).tolist()  # rounding may clip to a box beside the buffer
    rows, columns = (looked_up.view[first:end, left:right, channel] for channel in (0, 1))
    if rows.size and (rows >= 0).all() and (rows == rows[:, :1]).all() and (columns == columns[:1]).all():
        return np.s_[first:end, left:right], np.ix_(rows[:, 0].astype(np.intp), columns[0].astype(np.intp))
    where = np.nonzero(looked_up.view[..., 0] >= 0)
    rows, columns = (looked_up.view[where][:, channel].astype(np.intp) for channel in (0, 1))
    return where, (rows, columns)


# -- drawing -----------------------------------------------------------------------------------------------------------
def draw_image(source: Image, target: Image, rectangles: Rectangles, texture_filter: int, draw: DrawFunction) -> None:
    """Draw an image as a textured rectangle: a fan of two triangles, in the order of gallium's blitter."""
    if rectangles.in_texels:
        source = _padded(source)
    left, first, right, end = rectangles.box
    edge = gl.GL_CLAMP_TO_EDGE
    sampler = Sampler(min_filter=texture_filter, mag_filter=texture_filter, wrap_s=edge, wrap_t=edge)
    texture = Texture(1, gl.GL_TEXTURE_2D, sampler, {(0, 0): source})
    framebuffer = Framebuffer(1, {gl.GL_COLOR_ATTACHMENT0: Attachment(target)})
    state = State()
    unit = TextureUnit(enabled_2d=True, bound_2d=1, env_mode=gl.GL_REPLACE)
    state = replace(
        state,
        draw_framebuffer=1,
        viewport=Viewport(width=target.width, height=target.height),
        scissor=Scissor(True, left, first, right - left, end - first),
        units=(unit, *state.units[1:]),
    )
    x0, y0, x1, y1 = _spread(rectangles.target, target, F32(2), F32(1))
    s0, t0, s1, t1 = _spread(rectangles.source, source, F32(1), F32(0))
    identity, ones = np.eye(4, dtype=F32), np.broadcast_to(F32(1), (4, 4))
    vertices = Vertices(
        np.array([(x, y, 0, 1) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))], F32),
        ones,
        ones[:, :3],
        (np.array([(s, t, 0, 1) for s, t in ((s0, t0), (s1, t0), (s1, t1), (s0, t1))], F32),)
        + (ones,) * (len(state.units) - 1),
    )
    matrices = (identity, identity, (identity,) * len(state.units))
    command = Draw(state, gl.GL_TRIANGLE_FAN, vertices, None, *matrices, linear=True)
    draw(command, Storage({1: framebuffer}, {1: texture}))


def _padded(image: Image) -> Image:
    """Return an image with its last texels repeated until the sizes are powers of two.

    Dividing by such a size and multiplying by it is exact, so coordinates in texels keep all bits.
    """
    width, height = (1 << (size - 1).bit_length() for size in (image.width, image.height))
    padded = Image.new(image.format, width, height, image.internal_format)
    view = padded.view
    view[: image.height, : image.width] = image.view
    view[: image.height, image.width :] = image.view[:, -1:]
    view[image.height :] = view[image.height - 1]
    return padded


def _spread(corners: tuple[int, int, int, int], image: Image, scale: np.float32, shift: np.float32) -> list[np.float32]:
    sizes = (image.width, image.height) * 2
    return [F32(at) / F32(size) * scale - shift for at, size in zip(corners, sizes, strict=True)]
