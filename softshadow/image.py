"""Images: the storage of framebuffers, textures and renderbuffers.

An `Image` can be a depth attachment and a depth texture at the same time, so rendering into a texture copies nothing.
Depth is stored in buffer units: integers for fixed-point formats, z itself for float formats. The integers are float32,
exact up to 2**24. 32-bit depth is float64, with 2**32 for the largest integer, since drawing in float32 rounds to it.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from threading import Lock
from typing import Any

import numpy as np

from softshadow import tokens as gl

_writing = Lock()
BLOCK_SIDE = 4  # texels of a block of a compressed image, in both directions
PITCH = 32  # rows are padded to whole chunks of 32 pixels: kernels may write past the width, but not into the next row
DRAWN_ENCODINGS = ("", "half")  # of colours that draws can write, see `Format`
CROWDED = 1024  # pixels: of rows that are multiples of it, the same columns lie in the same few lines of a cache


@dataclass(frozen=True)
class Format:
    """The format of one cell.

    `base` is GL's base internal format, `kind` one of "unorm8", "float", "depth", "stencil". `largest` is the integer
    that represents 1.0 in a fixed-point depth format (0 for float depth), or the largest stencil value. Colours that
    are neither bytes nor single-precision floats have an `encoding` ("unorm", "half" or "srgb") and so many `bits` in
    R, G, B and A, see `texel_codes`; those of signed compressed formats are "snorm", floats in [-1, 1].
    """

    base: int
    kind: str
    dtype: type[np.generic]
    channels: int
    largest: int = 0
    encoding: str = ""
    bits: tuple[int, ...] = ()

    @property
    def is_clamped(self) -> bool:
        """Whether all values that it can store are in [0, 1]."""
        return self.largest > 0 or self.encoding in ("unorm", "srgb")

    @property
    def is_drawn_to(self) -> bool:
        """Whether draws can write colours of this format: bytes, single-precision floats and half floats."""
        return self.kind in ("unorm8", "float") and self.encoding in DRAWN_ENCODINGS

    @property
    def has_few_bits(self) -> bool:
        """Whether its colours have less than 8 bits."""
        return self.kind == "unorm8" and self.encoding != ""

    @property
    def is_array(self) -> bool:
        """Whether Mesa stores the channels as an array of numbers, not as parts of one integer."""
        return set(self.bits) <= {0, 8, 16}

    @property
    def written(self) -> tuple[bool, bool, bool, bool]:
        """Which of the four stored channels the format has; the others keep constant values, which sampling reads."""
        n_channels = {gl.GL_RED: 1, gl.GL_RG: 2, gl.GL_RGB: 3}.get(self.base, 4)
        return n_channels > 0, n_channels > 1, n_channels > 2, n_channels > 3


def _unorm8(base: int) -> Format:
    return Format(base, "unorm8", np.uint8, 4, 255)


CHANNELS = {  # of R, G, B and A that a base format has; luminance and intensity are stored in several
    gl.GL_RGBA: (1, 1, 1, 1),
    gl.GL_RGB: (1, 1, 1, 0),
    gl.GL_RG: (1, 1, 0, 0),
    gl.GL_RED: (1, 0, 0, 0),
    gl.GL_ALPHA: (0, 0, 0, 1),
    gl.GL_LUMINANCE: (1, 1, 1, 0),
    gl.GL_LUMINANCE_ALPHA: (1, 1, 1, 1),
    gl.GL_INTENSITY: (1, 1, 1, 1),
}


def _encoded(base: int, encoding: str, *n_bits: int) -> Format:
    """Return a format with so many bits in each channel, or in R, G, B and A."""
    bits = tuple(has * n for has, n in zip(CHANNELS[base], n_bits * 4 if len(n_bits) == 1 else n_bits, strict=True))
    if encoding == "unorm" and max(bits) < 8:
        return Format(base, "unorm8", np.uint8, 4, 255, encoding, bits)
    return Format(base, "float", np.float32, 4, 0, encoding, bits)


def _float(base: int) -> Format:
    return Format(base, "float", np.float32, 4)


def _depth(bits: int) -> Format:
    dtype = np.float64 if bits == 32 else np.float32
    return Format(gl.GL_DEPTH_COMPONENT, "depth", dtype, 1, (1 << bits) - 1 if bits else 0)


D24, D32F = _depth(24), _depth(0)
EXACT_DEPTH = Format(gl.GL_DEPTH_COMPONENT, "depth", np.float64, 1)  # unrounded z of the "exact" precision
STENCIL8 = Format(gl.GL_STENCIL_INDEX, "stencil", np.uint8, 1, 255)

FORMATS: dict[int, Format] = {
    1: _unorm8(gl.GL_LUMINANCE),  # in GL 1.0 the internal format was the number of components
    2: _unorm8(gl.GL_LUMINANCE_ALPHA),
    3: _unorm8(gl.GL_RGB),
    4: _unorm8(gl.GL_RGBA),
    gl.GL_RGBA: _unorm8(gl.GL_RGBA),
    gl.GL_RGBA8: _unorm8(gl.GL_RGBA),
    gl.GL_RGB: _unorm8(gl.GL_RGB),
    gl.GL_RGB8: _unorm8(gl.GL_RGB),
    gl.GL_RED: _unorm8(gl.GL_RED),
    gl.GL_R8: _unorm8(gl.GL_RED),
    gl.GL_RG: _unorm8(gl.GL_RG),
    gl.GL_RG8: _unorm8(gl.GL_RG),
    gl.GL_ALPHA: _unorm8(gl.GL_ALPHA),
    gl.GL_ALPHA8: _unorm8(gl.GL_ALPHA),
    gl.GL_LUMINANCE: _unorm8(gl.GL_LUMINANCE),
    gl.GL_LUMINANCE8: _unorm8(gl.GL_LUMINANCE),
    gl.GL_LUMINANCE_ALPHA: _unorm8(gl.GL_LUMINANCE_ALPHA),
    gl.GL_LUMINANCE8_ALPHA8: _unorm8(gl.GL_LUMINANCE_ALPHA),
    gl.GL_INTENSITY: _unorm8(gl.GL_INTENSITY),
    gl.GL_INTENSITY8: _unorm8(gl.GL_INTENSITY),
    **{
        name: _unorm8(base)
        for name, base in (
            (gl.GL_ALPHA4, gl.GL_ALPHA),
            (gl.GL_LUMINANCE4, gl.GL_LUMINANCE),
            (gl.GL_INTENSITY4, gl.GL_INTENSITY),
            (gl.GL_LUMINANCE6_ALPHA2, gl.GL_LUMINANCE_ALPHA),
        )
    },
    gl.GL_R3_G3_B2: _encoded(gl.GL_RGB, "unorm", 3, 3, 2, 0),
    gl.GL_RGB4: _encoded(gl.GL_RGB, "unorm", 4),
    gl.GL_RGB5: _encoded(gl.GL_RGB, "unorm", 5),
    gl.GL_RGB565: _encoded(gl.GL_RGB, "unorm", 5, 6, 5, 0),
    gl.GL_RGB10: _encoded(gl.GL_RGB, "unorm", 10),
    gl.GL_RGBA2: _encoded(gl.GL_RGBA, "unorm", 4),
    gl.GL_RGBA4: _encoded(gl.GL_RGBA, "unorm", 4),
    gl.GL_RGB5_A1: _encoded(gl.GL_RGBA, "unorm", 5, 5, 5, 1),
    gl.GL_RGB10_A2: _encoded(gl.GL_RGBA, "unorm", 10, 10, 10, 2),
    gl.GL_LUMINANCE4_ALPHA4: _encoded(gl.GL_LUMINANCE_ALPHA, "unorm", 4),
    **{
        name: _encoded(base, "unorm", 16)
        for name, base in (
            (gl.GL_RGB12, gl.GL_RGB),
            (gl.GL_RGB16, gl.GL_RGB),
            (gl.GL_RGBA12, gl.GL_RGBA),
            (gl.GL_RGBA16, gl.GL_RGBA),
            (gl.GL_R16, gl.GL_RED),
            (gl.GL_RG16, gl.GL_RG),
            (gl.GL_ALPHA12, gl.GL_ALPHA),
            (gl.GL_ALPHA16, gl.GL_ALPHA),
            (gl.GL_LUMINANCE12, gl.GL_LUMINANCE),
            (gl.GL_LUMINANCE16, gl.GL_LUMINANCE),
            (gl.GL_LUMINANCE12_ALPHA4, gl.GL_LUMINANCE_ALPHA),
            (gl.GL_LUMINANCE12_ALPHA12, gl.GL_LUMINANCE_ALPHA),
            (gl.GL_LUMINANCE16_ALPHA16, gl.GL_LUMINANCE_ALPHA),
            (gl.GL_INTENSITY12, gl.GL_INTENSITY),
            (gl.GL_INTENSITY16, gl.GL_INTENSITY),
        )
    },
    **{
        name: _encoded(base, "srgb", 8)
        for name, base in (
            (gl.GL_SRGB, gl.GL_RGB),
            (gl.GL_SRGB8, gl.GL_RGB),
            (gl.GL_SRGB_ALPHA, gl.GL_RGBA),
            (gl.GL_SRGB8_ALPHA8, gl.GL_RGBA),
            (gl.GL_SLUMINANCE, gl.GL_LUMINANCE),
            (gl.GL_SLUMINANCE8, gl.GL_LUMINANCE),
            (gl.GL_SLUMINANCE_ALPHA, gl.GL_LUMINANCE_ALPHA),
            (gl.GL_SLUMINANCE8_ALPHA8, gl.GL_LUMINANCE_ALPHA),
        )
    },
    **{
        name: _encoded(base, "half", 16)
        for name, base in (
            (gl.GL_RGBA16F, gl.GL_RGBA),
            (gl.GL_RGB16F, gl.GL_RGB),
            (gl.GL_RG16F, gl.GL_RG),
            (gl.GL_R16F, gl.GL_RED),
            (gl.GL_ALPHA16F_ARB, gl.GL_ALPHA),
            (gl.GL_LUMINANCE16F_ARB, gl.GL_LUMINANCE),
            (gl.GL_LUMINANCE_ALPHA16F_ARB, gl.GL_LUMINANCE_ALPHA),
            (gl.GL_INTENSITY16F_ARB, gl.GL_INTENSITY),
        )
    },
    gl.GL_ALPHA32F_ARB: _float(gl.GL_ALPHA),
    gl.GL_LUMINANCE32F_ARB: _float(gl.GL_LUMINANCE),
    gl.GL_LUMINANCE_ALPHA32F_ARB: _float(gl.GL_LUMINANCE_ALPHA),
    gl.GL_INTENSITY32F_ARB: _float(gl.GL_INTENSITY),
    gl.GL_RGBA32F: _float(gl.GL_RGBA),
    gl.GL_RGB32F: _float(gl.GL_RGB),
    gl.GL_RG32F: _float(gl.GL_RG),
    gl.GL_R32F: _float(gl.GL_RED),
    gl.GL_DEPTH_COMPONENT: D24,
    gl.GL_DEPTH_COMPONENT16: _depth(16),
    gl.GL_DEPTH_COMPONENT24: D24,
    gl.GL_DEPTH_COMPONENT32: _depth(32),
    gl.GL_DEPTH_COMPONENT32F: D32F,
    gl.GL_DEPTH_STENCIL: D24,  # with a separate stencil image, see `Image.new`
    gl.GL_DEPTH24_STENCIL8: D24,
    gl.GL_DEPTH32F_STENCIL8: D32F,
    gl.GL_STENCIL_INDEX: STENCIL8,
    gl.GL_STENCIL_INDEX8: STENCIL8,
}
WITH_STENCIL = (gl.GL_DEPTH_STENCIL, gl.GL_DEPTH24_STENCIL8, gl.GL_DEPTH32F_STENCIL8)


# what Mesa stores an unsized internal format as, given the client's types: it takes over the pixels unchanged
UNSIZED: dict[int, dict[int, int]] = {
    gl.GL_DEPTH_COMPONENT: {
        gl.GL_UNSIGNED_SHORT: gl.GL_DEPTH_COMPONENT16, gl.GL_UNSIGNED_INT: gl.GL_DEPTH_COMPONENT32,
    },
    gl.GL_RGBA: {
        gl.GL_UNSIGNED_SHORT: gl.GL_RGBA16, gl.GL_UNSIGNED_SHORT_4_4_4_4: gl.GL_RGBA4,
        gl.GL_UNSIGNED_SHORT_4_4_4_4_REV: gl.GL_RGBA4, gl.GL_UNSIGNED_SHORT_5_5_5_1: gl.GL_RGB5_A1,
        gl.GL_UNSIGNED_SHORT_1_5_5_5_REV: gl.GL_RGB5_A1, gl.GL_UNSIGNED_INT_10_10_10_2: gl.GL_RGB10_A2,
        gl.GL_UNSIGNED_INT_2_10_10_10_REV: gl.GL_RGB10_A2,
    },
    gl.GL_RGB: {
        gl.GL_UNSIGNED_BYTE_3_3_2: gl.GL_R3_G3_B2, gl.GL_UNSIGNED_BYTE_2_3_3_REV: gl.GL_R3_G3_B2,
        gl.GL_UNSIGNED_SHORT_5_6_5: gl.GL_RGB565, gl.GL_UNSIGNED_SHORT_5_6_5_REV: gl.GL_RGB565,
        gl.GL_UNSIGNED_SHORT_5_5_5_1: gl.GL_RGB5, gl.GL_UNSIGNED_INT_2_10_10_10_REV: gl.GL_RGB10,
    },
    gl.GL_LUMINANCE: {gl.GL_UNSIGNED_SHORT: gl.GL_LUMINANCE16},
    gl.GL_LUMINANCE_ALPHA: {gl.GL_UNSIGNED_SHORT: gl.GL_LUMINANCE16_ALPHA16},
    gl.GL_ALPHA: {gl.GL_UNSIGNED_SHORT: gl.GL_ALPHA16},
    gl.GL_RED: {gl.GL_UNSIGNED_SHORT: gl.GL_R16},
    gl.GL_RG: {gl.GL_UNSIGNED_SHORT: gl.GL_RG16},
}  # fmt: skip


def storage_format(internal_format: int, type: int = gl.GL_FLOAT, pixel_format: int = gl.GL_NONE) -> Format:
    """Return the format that stores an internal format; an unsized one gets the bits of the client's, as in Mesa.

    Raises
    ------
    KeyError
        The internal format is not part of this subset.
    """
    sized = UNSIZED.get(internal_format, {}).get(type, internal_format)
    if type == gl.GL_UNSIGNED_SHORT and internal_format not in (pixel_format, gl.GL_DEPTH_COMPONENT):
        sized = internal_format
    return FORMATS[sized]


def new_cells(height: int, width: int, format: Format, *, is_zeroed: bool = True) -> np.ndarray:
    """Return cells: `height` rows, each padded to a multiple of `PITCH` pixels, but not of `CROWDED`."""
    pitch = -(-width // PITCH) * PITCH
    pitch += 0 if pitch % CROWDED else PITCH
    shape: tuple[int, ...] = (height, pitch) if format.channels == 1 else (height, pitch, format.channels)
    return np.zeros(shape, format.dtype) if is_zeroed else np.empty(shape, format.dtype)


def _has_stencil(format: Format, internal_format: int) -> bool:
    return format.kind == "depth" and internal_format in WITH_STENCIL


@dataclass(eq=False)
class Image:
    """Cells (height, pitch[, channels]); only the first `width` columns belong to the image.

    The slices of a 3-D image lie one above the other: its cells are (slices * height, pitch[, channels]).
    `internal_format` is the token that the image was created with. A packed depth-stencil format is stored as two
    images: the depth image, and its `stencil`. `version` is a version token: equal tokens, other than None, mean
    identical cells; taking the cells clears it. Whoever takes the cells may write to them until the next command.
    `tile_bounds` is what the fill stage knows about the cells; it is forgotten with them. A compressed image also has
    its `blocks` (rows, columns, bytes), which the cells were decoded from.
    """

    format: Format
    width: int
    height: int
    _cells: np.ndarray
    internal_format: int = 0
    stencil: Image | None = None
    version: Hashable | None = None
    tile_bounds: Any = None
    _pending_rows: list[tuple[int, np.ndarray]] = field(default_factory=list)  # (first row, rows)
    slices: int = 1
    blocks: np.ndarray | None = None

    @property
    def cells(self) -> np.ndarray:
        """The cells, for reading and writing."""
        self.write_pending()
        self.version = self.tile_bounds = None
        return self._cells

    @property
    def read_cells(self) -> np.ndarray:
        """The cells, for reading only: version token and tile bounds stay."""
        self.write_pending()
        return self._cells

    def write_pending(self) -> None:
        """Write the rows that `write_later` has stored."""
        if self._pending_rows:
            with _writing:  # several threads may sample one texture
                for first, rows in self._pending_rows:
                    cells = self._cells if rows.ndim == self._cells.ndim else self._cells.view(rows.dtype)[..., 0]
                    cells[first : first + len(rows)] = rows
                self._pending_rows = []

    def write_later(self, first_row: int, rows: np.ndarray, version: Hashable) -> None:
        """Store whole rows, to be written when the cells are taken; `version` is the token of all cells after that.

        `rows` (n, pitch), or an array broadcast to this shape, must not change afterwards. Pixels of four bytes are
        numbers of 32 bits.
        """
        if len(rows) == self.height:
            self._pending_rows = []  # all cells would be overwritten
        self._pending_rows.append((first_row, rows))
        self.version, self.tile_bounds = version, None

    @classmethod
    def new(
        cls,
        format: Format,
        width: int,
        height: int,
        internal_format: int = 0,
        slices: int = 1,
        pixels: np.ndarray | None = None,
    ) -> Image:
        """Return an image of pixels (slices * height, width[, channels]) or zeros, and one of stencil values with it.

        That is of zeros, and only there if the internal format has one.
        """
        width, height, slices = int(width), int(height), int(slices)  # they may be NumPy integers
        stencil = cls.new(STENCIL8, width, height, internal_format) if _has_stencil(format, internal_format) else None
        cells = new_cells(height * slices, width, format, is_zeroed=pixels is None)
        padding = cells
        if pixels is not None:
            cells[:, :width], padding = pixels, cells[:, width:]
            padding[:] = 0
        if format.base in (gl.GL_RED, gl.GL_RG, gl.GL_RGB, gl.GL_LUMINANCE):
            padding[..., 3] = format.largest or 1  # formats without alpha are read with alpha 1
        return cls(format, width, height, cells, internal_format, stencil, slices=slices)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the cells, padding included."""
        rows, columns = self._cells.shape[:2]
        return rows, columns

    @property
    def view(self) -> np.ndarray:
        """The cells without the padding, (height, width[, channels]); of a 3-D image all slices as they lie."""
        return self.cells[:, : self.width]

    def copy(self) -> Image:
        """Return a copy with cells of its own."""
        stencil = self.stencil.copy() if self.stencil else None
        image = Image(
            self.format, self.width, self.height, self.cells.copy(), self.internal_format, stencil, slices=self.slices
        )
        image.blocks = None if self.blocks is None else self.blocks.copy()
        return image

    @property
    def layout(self) -> tuple[Format, int, int, int, int]:
        """The format, the internal format, and how many columns, rows and slices there are."""
        return self.format, self.internal_format, self.width, self.height, self.slices

    def same_as(self, other: Any) -> bool:
        """Return whether the other image has the same format, and the same cells bit for bit."""
        return (
            isinstance(other, Image)
            and self.format == other.format
            and self.view.shape == other.view.shape
            and self.view.tobytes() == other.view.tobytes()
            and (self.stencil is None or self.stencil.same_as(other.stencil))
        )
