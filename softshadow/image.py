"""A plane of pixels or texels: what a buffer of a framebuffer and a level of a texture are made of.

The same `Image` serves as depth attachment and as depth texture, so rendering into a texture copies nothing.
Depth is held in buffer units: integers for fixed-point formats (in float32, exact up to 2**24; of 32 bits in float64,
where 2**32 stands for the largest, as drawing in float32 has it), z itself for float formats.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from threading import Lock
from typing import Any

import numpy as np

from softshadow import tokens as gl

_writing = Lock()
PITCH = 32  # a row is padded to whole chunks of 32 pixels: kernels may run over its end, never into the next row


@dataclass(frozen=True)
class Format:
    """What one cell holds.

    `base` is GL's base internal format, `kind` one of "unorm8", "float", "depth", "stencil"; `largest` is the integer
    that stands for 1.0 in a fixed-point depth format (0 for float depth) and the largest count of a stencil format.
    """

    base: int
    kind: str
    dtype: type[np.generic]
    channels: int
    largest: int = 0

    @property
    def written(self) -> tuple[bool, bool, bool, bool]:
        """Which of RGBA a colour image really has; the others are constant, so that sampling needs no case."""
        count = {gl.GL_RED: 1, gl.GL_RG: 2, gl.GL_RGB: 3}.get(self.base, 4)
        return count > 0, count > 1, count > 2, count > 3


def _unorm8(base: int) -> Format:
    return Format(base, "unorm8", np.uint8, 4, 255)


def _float(base: int) -> Format:
    return Format(base, "float", np.float32, 4)


def _depth(bits: int) -> Format:
    dtype = np.float64 if bits == 32 else np.float32
    return Format(gl.GL_DEPTH_COMPONENT, "depth", dtype, 1, (1 << bits) - 1 if bits else 0)


D24, D32F = _depth(24), _depth(0)
EXACT_DEPTH = Format(gl.GL_DEPTH_COMPONENT, "depth", np.float64, 1)  # unrounded z of the "exact" precision
STENCIL8 = Format(gl.GL_STENCIL_INDEX, "stencil", np.uint8, 1, 255)

FORMATS: dict[int, Format] = {
    1: _unorm8(gl.GL_LUMINANCE),  # GL 1.0 named internal formats by their number of components
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
    gl.GL_RGBA32F: _float(gl.GL_RGBA),
    gl.GL_RGB32F: _float(gl.GL_RGB),
    gl.GL_RG32F: _float(gl.GL_RG),
    gl.GL_R32F: _float(gl.GL_RED),
    gl.GL_DEPTH_COMPONENT: D24,
    gl.GL_DEPTH_COMPONENT16: _depth(16),
    gl.GL_DEPTH_COMPONENT24: D24,
    gl.GL_DEPTH_COMPONENT32: _depth(32),
    gl.GL_DEPTH_COMPONENT32F: D32F,
    gl.GL_DEPTH_STENCIL: D24,  # with a stencil plane beside it, see `Image.new`
    gl.GL_DEPTH24_STENCIL8: D24,
    gl.GL_DEPTH32F_STENCIL8: D32F,
    gl.GL_STENCIL_INDEX: STENCIL8,
    gl.GL_STENCIL_INDEX8: STENCIL8,
}
WITH_STENCIL = (gl.GL_DEPTH_STENCIL, gl.GL_DEPTH24_STENCIL8, gl.GL_DEPTH32F_STENCIL8)


def storage_format(internal_format: int, type: int = gl.GL_FLOAT) -> Format:
    """Return what stores an internal format; unsized depth takes the client's integer size, as in Mesa.

    Raises
    ------
    KeyError
        The internal format is not part of this subset.
    """
    if internal_format == gl.GL_DEPTH_COMPONENT and type in (gl.GL_UNSIGNED_SHORT, gl.GL_UNSIGNED_INT):
        sized = gl.GL_DEPTH_COMPONENT16 if type == gl.GL_UNSIGNED_SHORT else gl.GL_DEPTH_COMPONENT32
        return FORMATS[sized]
    return FORMATS[internal_format]


def padded(height: int, width: int, format: Format) -> np.ndarray:
    """Return a zeroed plane of `height` rows, each padded to a multiple of `PITCH` pixels."""
    pitch = -(-width // PITCH) * PITCH
    shape: tuple[int, ...] = (height, pitch) if format.channels == 1 else (height, pitch, format.channels)
    return np.zeros(shape, format.dtype)


def _has_stencil(format: Format, internal_format: int) -> bool:
    return format.kind == "depth" and internal_format in WITH_STENCIL


@dataclass(eq=False)
class Image:
    """One plane: `cells` is (height, pitch[, channels]), of which the first `width` columns count.

    `internal_format` is the token it was made with, for queries. Packed depth-stencil formats are two planes: the
    stencil values are the image `stencil` of the depth image. `contents` is a name for what the cells hold: of two
    moments at which it is the same name, and not None, the cells are the same. It is lost when the cells are taken,
    which are then the taker's to write to, until the next command.
    """

    format: Format
    width: int
    height: int
    _cells: np.ndarray
    internal_format: int = 0
    stencil: Image | None = None
    contents: Hashable | None = None
    _later: list[tuple[int, np.ndarray]] = field(default_factory=list)  # first row, rows: still to be written

    @property
    def cells(self) -> np.ndarray:
        """The cells, for reading and writing."""
        self.settle()
        self.contents = None
        return self._cells

    def settle(self) -> None:
        """Write what is still to be written."""
        if self._later:
            with _writing:  # several threads may sample one texture
                for first, rows in self._later:
                    self._cells[first : first + len(rows)] = rows
                self._later = []

    def write_later(self, first_row: int, rows: np.ndarray, contents: Hashable) -> None:
        """Write whole rows, when somebody asks for the cells; `contents` is the name for all cells with them.

        `rows` (n, pitch), or what spreads to it, must not change any more.
        """
        if len(rows) == self.height:
            self._later = []  # of what these would write, nothing would be left
        self._later.append((first_row, rows))
        self.contents = contents

    @classmethod
    def new(cls, format: Format, width: int, height: int, internal_format: int = 0) -> Image:
        """Return an image of zeros, with a stencil plane where the internal format has one."""
        width, height = int(width), int(height)  # callers may have NumPy's
        stencil = cls.new(STENCIL8, width, height, internal_format) if _has_stencil(format, internal_format) else None
        cells = padded(height, width, format)
        if format.base in (gl.GL_RED, gl.GL_RG, gl.GL_RGB, gl.GL_LUMINANCE):
            cells[..., 3] = format.largest or 1  # the alpha that such a format is read with
        return cls(format, width, height, cells, internal_format, stencil)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the cells, with the padding."""
        rows, columns = self._cells.shape[:2]
        return rows, columns

    @property
    def view(self) -> np.ndarray:
        """The cells without the padding, (height, width[, channels])."""
        return self.cells[:, : self.width]

    def copy(self) -> Image:
        stencil = self.stencil.copy() if self.stencil else None
        return Image(self.format, self.width, self.height, self.cells.copy(), self.internal_format, stencil)

    def is_laid_out_as(self, other: Image) -> bool:
        """Return whether the other image has the same size and format, and was made with the same internal format."""
        mine = (self.format, self.internal_format, self.width, self.height)
        return mine == (other.format, other.internal_format, other.width, other.height)

    def same_as(self, other: Any) -> bool:
        """Return whether the other image has the same format and, bit for bit, the same cells."""
        return (
            isinstance(other, Image)
            and self.format == other.format
            and self.view.shape == other.view.shape
            and self.view.tobytes() == other.view.tobytes()
            and (self.stencil is None or self.stencil.same_as(other.stencil))
        )
