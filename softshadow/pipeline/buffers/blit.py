"""glBlitFramebuffer: rectangles from framebuffer to framebuffer, scaled and mirrored.

llvmpipe draws a textured rectangle, so the same is done here: what texel a pixel gets where two are as near as each
other, and the last bits of a mixture, are those of the pipeline's own interpolation and sampling. Both framebuffers are
taken as they are stored: the window's rows are counted from the top, and a copy between it and an object is mirrored.

References: GL 4.5 compatibility, sec. 18.3.1; Mesa, main/blit.c, main/image.c and gallium's util/u_blitter.c.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import DEFAULT, Attachment, Framebuffer, Storage
from softshadow.image import FORMATS, Image
from softshadow.pipeline.buffers.copy import convert_color
from softshadow.pipeline.commands import BlitFramebuffer, Draw, Vertices
from softshadow.pixels import LARGEST_UINT, quantized_depth, sampled_depth
from softshadow.state import Scissor, State, TextureUnit, Viewport
from softshadow.texture import Sampler, Texture

DrawFunction = Callable[[Draw, Storage], None]

F32 = np.float32
HALF = F32(0.5)


class Rectangles(NamedTuple):
    """Where a blit reads and writes, in stored rows; `box` (left, first row, right, end row) is what may be written.

    `in_texels` says that the source is the window, which Mesa reads as a rectangle texture: its coordinates are not
    divided by the size.
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
        """Whether every pixel is copied as it is: no scaling, no mirroring, nothing cut off."""
        (a, b, c, d), (e, f, g, h) = self.source, self.target
        return not self.cut and (c - a, d - b) == (g - e, h - f)


def blit(command: BlitFramebuffer, storage: Storage, draw: DrawFunction) -> None:
    """Copy the buffers that both framebuffers have; `draw` is `softshadow.pipeline.draw`."""
    read, drawn = storage.framebuffers[command.read], storage.framebuffers[command.draw]
    rectangles = rectangles_of(command, read, drawn)
    if rectangles is None:
        return
    if command.mask & gl.GL_COLOR_BUFFER_BIT and read.read_color is not None:
        for target in drawn.colors:
            _blit_color(read.read_color.copy(), target, rectangles, command.filter, draw)
    depth = command.mask & gl.GL_DEPTH_BUFFER_BIT and read.depth is not None and drawn.depth is not None
    stencil = command.mask & gl.GL_STENCIL_BUFFER_BIT and read.stencil is not None and drawn.stencil is not None
    if depth and read.depth is not None and drawn.depth is not None:
        whole = drawn.depth.format.largest == LARGEST_UINT  # llvmpipe copies 32 bits as integers (lp_surface.c)
        plain = whole or (rectangles.straight and _copies_depth(read, drawn, bool(stencil)))
        where, texels = nearest_texels(read.depth, drawn.depth, rectangles, draw)
        cells = read.depth.view[texels]
        through = cells if plain else quantized_depth(sampled_depth(cells, read.depth.format), drawn.depth.format)
        drawn.depth.view[where] = through
    if stencil and read.stencil is not None and drawn.stencil is not None:
        where, texels = nearest_texels(read.stencil, drawn.stencil, rectangles, draw)
        drawn.stencil.view[where] = read.stencil.view[texels]


def _blit_color(source: Image, target: Image, rectangles: Rectangles, texture_filter: int, draw: DrawFunction) -> None:
    if texture_filter == gl.GL_LINEAR and rectangles.scaled:  # the blitter filters nothing else
        draw_image(source, target, rectangles, gl.GL_LINEAR, draw)
    else:
        where, texels = nearest_texels(source, target, rectangles, draw)
        made = convert_color(source.view[texels], source, target)
        for channel in np.flatnonzero(target.format.written):
            target.view[..., channel][where] = made[..., channel]


def _copies_depth(read: Framebuffer, drawn: Framebuffer, with_stencil: bool) -> bool:
    """Return whether depth is copied in memory; else it goes through float32.

    Mesa does so where everything that the target's format holds is copied.
    """
    return (with_stencil and _packed(read) and _packed(drawn)) or not (_has_stencil_bits(drawn) or _packed(read))


def _packed(target: Framebuffer) -> bool:
    depth, stencil = target.depth, target.stencil
    return target.name == DEFAULT or (depth is not None and stencil is not None and depth.stencil is stencil)


def _has_stencil_bits(target: Framebuffer) -> bool:
    return target.name == DEFAULT or (target.depth is not None and target.depth.stencil is not None)


# -- where -------------------------------------------------------------------------------------------------------------
def rectangles_of(command: BlitFramebuffer, read: Framebuffer, drawn: Framebuffer) -> Rectangles | None:
    """Return the rectangles of a blit, None where nothing is left of them."""
    sx0, sy0, sx1, sy1 = command.source
    dx0, dy0, dx1, dy1 = command.target
    (read_width, read_height), (width, height) = read.size, drawn.size
    left, bottom, right, top = 0, 0, width, height
    if command.scissor.enabled:
        box = command.scissor
        left, bottom = max(left, box.x), max(bottom, box.y)
        right, top = min(right, box.x + box.width), min(top, box.y + box.height)
    columns = _clipped((sx0, sx1), (dx0, dx1), read_width, left, right)
    rows = _clipped((sy0, sy1), (dy0, dy1), read_height, bottom, top)
    if columns is None or rows is None:
        return None
    cut = (columns, rows) != ((dx0, dx1), (dy0, dy1))
    if drawn.flipped:
        dy0, dy1, rows = height - dy0, height - dy1, (height - rows[0], height - rows[1])
    if read.flipped:
        sy0, sy1 = read_height - sy0, read_height - sy1
    if dx0 > dx1:
        dx0, dx1, sx0, sx1 = dx1, dx0, sx1, sx0
    if dy0 > dy1:
        dy0, dy1, sy0, sy1 = dy1, dy0, sy1, sy0
    box_of = (min(columns), min(rows), max(columns), max(rows))
    return Rectangles((sx0, sy0, sx1, sy1), (dx0, dy0, dx1, dy1), box_of, cut, read.name == DEFAULT)


Span = tuple[int, int]


def _clipped(source: Span, target: Span, read_end: int, first: int, end: int) -> Span | None:
    """Return what is left of the target's span when both are clipped (Mesa, _mesa_clip_blit)."""
    for span, low, high in ((target, first, end), (source, 0, read_end)):
        if span[0] == span[1] or low >= high or max(span) <= low or min(span) >= high:
            return None
    source, target = _cut_above(source, target, end)
    source, target = _cut_below(source, target, first)
    if source[0] == source[1]:  # rounded to nothing: no more is cut off, and outside of the source Mesa divides by 0
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
    """Return the rounded part of a length that belongs to the part `cut` of `whole`, in float32."""
    return int(F32(cut) / F32(whole) * F32(length) + (HALF if length > 0 else -HALF))


# -- drawing -----------------------------------------------------------------------------------------------------------
def nearest_texels(source: Image, target: Image, rectangles: Rectangles, draw: DrawFunction) -> tuple[tuple, tuple]:
    """Return which pixels (rows, columns) of the target are written, and the texels (rows, columns) they get."""
    numbers = Image.new(FORMATS[gl.GL_RGBA32F], source.width, source.height)
    numbers.view[..., 0], numbers.view[..., 1] = np.arange(source.height)[:, None], np.arange(source.width)
    made = Image.new(FORMATS[gl.GL_RGBA32F], target.width, target.height)
    made.view[...] = -1
    draw_image(numbers, made, rectangles, gl.GL_NEAREST, draw)
    where = np.nonzero(made.view[..., 0] >= 0)
    rows, columns = (made.view[where][:, channel].astype(np.intp) for channel in (0, 1))
    return where, (rows, columns)


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

    Dividing by such a size and multiplying by it loses no bit, so that coordinates are what they are in texels.
    """
    width, height = (1 << (size - 1).bit_length() for size in (image.width, image.height))
    made = Image.new(image.format, width, height, image.internal_format)
    made.view[...] = np.pad(image.view, ((0, height - image.height), (0, width - image.width), (0, 0)), "edge")
    return made


def _spread(corners: tuple[int, int, int, int], image: Image, scale: np.float32, shift: np.float32) -> list[np.float32]:
    sizes = (image.width, image.height) * 2
    return [F32(at) / F32(size) * scale - shift for at, size in zip(corners, sizes, strict=True)]
