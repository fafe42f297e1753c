"""The compressed internal formats: their blocks, and what a texture stores instead of them.

A texture keeps the blocks as they are, and has decoded cells, which are what llvmpipe's lookups read of the blocks.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from softshadow import tokens as gl
from softshadow.compression.alpha_blocks import channel, channel_as_read
from softshadow.compression.alpha_encoding import channel_blocks
from softshadow.compression.color_blocks import colors
from softshadow.compression.color_encoding import LARGEST_TRANSPARENT, color_blocks
from softshadow.image import BLOCK_SIDE, Format
from softshadow.texel_codes import SRGB

CHUNK = 1 << 14  # blocks that are decoded at a time
STEP_OF_SIGNED, STEP_OF_UNSIGNED = np.float32(1) / np.float32(127), np.float32(1) / np.float32(255)


Encode = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class CompressedFormat:
    """A compressed format.

    `block_bytes` is the size of a block, `stored` the format of the decoded cells, `approximate_bits` what queries
    return as the number of bits of each channel that there is. `decode` returns the channels (..., 16, 4) of blocks
    (..., block_bytes): bytes, or signed numbers. `decode_to_read` does so for glGetTexImage, where Mesa does not read
    what llvmpipe's lookups read. `encode` returns the blocks (N, block_bytes) of texels (N, 16, 4), 0 to 255, of which
    the image has those that are valid (N, 16); None if this package does not compress pixels to the format.
    """

    block_bytes: int
    stored: Format
    approximate_bits: int
    decode: Callable[[np.ndarray], np.ndarray]
    encode: Encode | None = None
    decode_to_read: Callable[[np.ndarray], np.ndarray] | None = None

    def blocks(self, width: int, height: int) -> tuple[int, int]:
        """Return rows and columns of the blocks of an image."""
        return -(-height // BLOCK_SIDE), -(-width // BLOCK_SIDE)

    def size(self, width: int, height: int) -> int:
        """Return the number of bytes of an image."""
        rows, columns = self.blocks(width, height)
        return rows * columns * self.block_bytes


def _unorm8(base: int) -> Format:
    return Format(base, "unorm8", np.uint8, 4, 255)


def _srgb(base: int) -> Format:
    return Format(base, "float", np.float32, 4, 0, "srgb", (8, 8, 8, 8 if base == gl.GL_RGBA else 0))


def _signed(base: int) -> Format:
    return Format(base, "float", np.float32, 4, 0, "snorm")


def _dxt1(has_alpha: bool) -> Callable[[np.ndarray], np.ndarray]:
    def decode(blocks: np.ndarray) -> np.ndarray:
        rgb, transparent = colors(blocks, has_three=True)
        return _with_alpha(rgb, np.where(transparent & has_alpha, 0, 255))

    return decode


def _dxt3(blocks: np.ndarray) -> np.ndarray:
    nibbles = blocks[..., :8, np.newaxis].astype(np.int64) >> np.array([0, 4]) & 15
    rgb, _ = colors(blocks[..., 8:], has_three=False)
    return _with_alpha(rgb, nibbles.reshape(*blocks.shape[:-1], BLOCK_SIDE**2) * 17)


def _dxt5(blocks: np.ndarray) -> np.ndarray:
    rgb, _ = colors(blocks[..., 8:], has_three=False)
    return _with_alpha(rgb, channel(blocks[..., :8]))


def _with_alpha(rgb: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    return np.concatenate([rgb, alpha[..., np.newaxis]], axis=-1)


def _channels(
    places: str, is_signed: bool, numbers_of: Callable[[np.ndarray, bool], np.ndarray] = channel
) -> Callable[[np.ndarray], np.ndarray]:
    """Return a decoder of one or two channels; each letter of RGBA is the first (x) or second one (y), 0 or 1."""

    def decode(blocks: np.ndarray) -> np.ndarray:
        halves = {name: blocks[..., 8 * n : 8 * n + 8] for n, name in enumerate("xy") if name in places}
        numbers = {name: numbers_of(half, is_signed) for name, half in halves.items()}
        zeros = np.zeros_like(numbers["x"])
        constants = {"0": zeros, "1": zeros + (127 if is_signed else 255)}
        return np.stack([(numbers | constants)[name] for name in places], axis=-1)

    return decode


def _encode_dxt1(has_alpha: bool) -> Encode:
    def encode(texels: np.ndarray, valid: np.ndarray) -> np.ndarray:
        transparent = (texels[..., 3] <= LARGEST_TRANSPARENT) & has_alpha
        return color_blocks(texels[..., :3], valid, transparent, is_dxt1=True)

    return encode


def _encode_dxt3(texels: np.ndarray, valid: np.ndarray) -> np.ndarray:
    nibbles = np.where(valid, texels[..., 3] >> 4, 0)
    alpha = (nibbles[:, ::2] | nibbles[:, 1::2] << 4).astype(np.uint8)
    return np.concatenate([alpha, _colors_of_four(texels, valid)], axis=1)


def _encode_dxt5(texels: np.ndarray, valid: np.ndarray) -> np.ndarray:
    return np.concatenate(
        [channel_blocks(texels[..., 3], valid, is_alpha=True), _colors_of_four(texels, valid)], axis=1
    )


def _colors_of_four(texels: np.ndarray, valid: np.ndarray) -> np.ndarray:
    return color_blocks(texels[..., :3], valid, np.zeros_like(valid), is_dxt1=False)


def _encode_channels(*places: int) -> Encode:
    def encode(texels: np.ndarray, valid: np.ndarray) -> np.ndarray:
        return np.concatenate([channel_blocks(texels[..., place], valid) for place in places], axis=1)

    return encode


ENCODED_PLACES = {gl.GL_RED: (0,), gl.GL_RG: (0, 1), gl.GL_LUMINANCE: (0,), gl.GL_LUMINANCE_ALPHA: (0, 3)}


def _of_s3tc(
    block_bytes: int, base: int, decode: Callable[[np.ndarray], np.ndarray], is_srgb: bool, encode: Encode
) -> CompressedFormat:
    return CompressedFormat(block_bytes, _srgb(base) if is_srgb else _unorm8(base), 4, decode, encode)


def _of_channels(block_bytes: int, base: int, places: str, is_signed: bool) -> CompressedFormat:
    stored = _signed(base) if is_signed else _unorm8(base)
    to_read = _channels(places, is_signed, channel_as_read) if base == gl.GL_LUMINANCE_ALPHA else None
    encode = None if is_signed else _encode_channels(*ENCODED_PLACES[base])
    return CompressedFormat(block_bytes, stored, 8, _channels(places, is_signed), encode, to_read)


COMPRESSED: dict[int, CompressedFormat] = {
    gl.GL_COMPRESSED_RGB_S3TC_DXT1_EXT: _of_s3tc(8, gl.GL_RGB, _dxt1(False), False, _encode_dxt1(False)),
    gl.GL_COMPRESSED_RGBA_S3TC_DXT1_EXT: _of_s3tc(8, gl.GL_RGBA, _dxt1(True), False, _encode_dxt1(True)),
    gl.GL_COMPRESSED_RGBA_S3TC_DXT3_EXT: _of_s3tc(16, gl.GL_RGBA, _dxt3, False, _encode_dxt3),
    gl.GL_COMPRESSED_RGBA_S3TC_DXT5_EXT: _of_s3tc(16, gl.GL_RGBA, _dxt5, False, _encode_dxt5),
    gl.GL_COMPRESSED_SRGB_S3TC_DXT1_EXT: _of_s3tc(8, gl.GL_RGB, _dxt1(False), True, _encode_dxt1(False)),
    gl.GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT: _of_s3tc(8, gl.GL_RGBA, _dxt1(True), True, _encode_dxt1(True)),
    gl.GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT: _of_s3tc(16, gl.GL_RGBA, _dxt3, True, _encode_dxt3),
    gl.GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT: _of_s3tc(16, gl.GL_RGBA, _dxt5, True, _encode_dxt5),
    gl.GL_COMPRESSED_RED_RGTC1: _of_channels(8, gl.GL_RED, "x001", False),
    gl.GL_COMPRESSED_SIGNED_RED_RGTC1: _of_channels(8, gl.GL_RED, "x001", True),
    gl.GL_COMPRESSED_RG_RGTC2: _of_channels(16, gl.GL_RG, "xy01", False),
    gl.GL_COMPRESSED_SIGNED_RG_RGTC2: _of_channels(16, gl.GL_RG, "xy01", True),
    gl.GL_COMPRESSED_LUMINANCE_LATC1_EXT: _of_channels(8, gl.GL_LUMINANCE, "xxx1", False),
    gl.GL_COMPRESSED_SIGNED_LUMINANCE_LATC1_EXT: _of_channels(8, gl.GL_LUMINANCE, "xxx1", True),
    gl.GL_COMPRESSED_LUMINANCE_ALPHA_LATC2_EXT: _of_channels(16, gl.GL_LUMINANCE_ALPHA, "xxxy", False),
    gl.GL_COMPRESSED_SIGNED_LUMINANCE_ALPHA_LATC2_EXT: _of_channels(16, gl.GL_LUMINANCE_ALPHA, "xxxy", True),
    gl.GL_COMPRESSED_LUMINANCE_ALPHA_3DC_ATI: _of_channels(16, gl.GL_LUMINANCE_ALPHA, "xxxy", False),
}

# what Mesa stores images in that are to be compressed in some way, of all but one dimension; the others as they are
CHOSEN = {
    gl.GL_COMPRESSED_RGB: gl.GL_COMPRESSED_RGB_S3TC_DXT1_EXT,
    gl.GL_COMPRESSED_RGBA: gl.GL_COMPRESSED_RGBA_S3TC_DXT5_EXT,
    gl.GL_COMPRESSED_SRGB: gl.GL_COMPRESSED_SRGB_S3TC_DXT1_EXT,
    gl.GL_COMPRESSED_SRGB_ALPHA: gl.GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT,
    gl.GL_COMPRESSED_RED: gl.GL_COMPRESSED_RED_RGTC1,
    gl.GL_COMPRESSED_RG: gl.GL_COMPRESSED_RG_RGTC2,
    gl.GL_COMPRESSED_LUMINANCE: gl.GL_COMPRESSED_LUMINANCE_LATC1_EXT,
    gl.GL_COMPRESSED_LUMINANCE_ALPHA: gl.GL_COMPRESSED_LUMINANCE_ALPHA_LATC2_EXT,
}
UNCOMPRESSED = {
    gl.GL_COMPRESSED_ALPHA: gl.GL_ALPHA,
    gl.GL_COMPRESSED_INTENSITY: gl.GL_INTENSITY,
    gl.GL_COMPRESSED_SLUMINANCE: gl.GL_SLUMINANCE,
    gl.GL_COMPRESSED_SLUMINANCE_ALPHA: gl.GL_SLUMINANCE_ALPHA,
    gl.GL_COMPRESSED_RGB: gl.GL_RGB,
    gl.GL_COMPRESSED_RGBA: gl.GL_RGBA,
    gl.GL_COMPRESSED_SRGB: gl.GL_SRGB,
    gl.GL_COMPRESSED_SRGB_ALPHA: gl.GL_SRGB_ALPHA,
    gl.GL_COMPRESSED_RED: gl.GL_RED,
    gl.GL_COMPRESSED_RG: gl.GL_RG,
    gl.GL_COMPRESSED_LUMINANCE: gl.GL_LUMINANCE,
    gl.GL_COMPRESSED_LUMINANCE_ALPHA: gl.GL_LUMINANCE_ALPHA,
}
# those that queries return: the others suit some images only
FOR_ANY_IMAGE = (
    gl.GL_COMPRESSED_RGB_S3TC_DXT1_EXT, gl.GL_COMPRESSED_RGBA_S3TC_DXT3_EXT, gl.GL_COMPRESSED_RGBA_S3TC_DXT5_EXT,
)  # fmt: skip


def decoded(blocks: np.ndarray, format: CompressedFormat, width: int, height: int) -> np.ndarray:
    """Return the cells (height, width, 4) of blocks (rows, columns, block_bytes) uint8."""
    return _decoded(blocks, width, height, format.decode, format.stored)


def chosen_format(internal_format: int, dimensions: int) -> int:
    """Return the internal format that Mesa stores images in; it is another one for GL_COMPRESSED_RGB and the like."""
    chosen = CHOSEN.get(internal_format) if dimensions > 1 else None
    return chosen or UNCOMPRESSED.get(internal_format, internal_format)


def encoded(cells: np.ndarray, format: CompressedFormat) -> np.ndarray:
    """Return the blocks (rows, columns, block_bytes) uint8 of colours (height, width, 4) uint8."""
    assert format.encode is not None
    height, width = cells.shape[:2]
    rows, columns = format.blocks(width, height)
    padded = np.zeros((rows * BLOCK_SIDE, columns * BLOCK_SIDE, 5), np.uint8)
    padded[:height, :width, :4], padded[:height, :width, 4] = cells, 1
    texels = padded.reshape(rows, BLOCK_SIDE, columns, BLOCK_SIDE, 5).swapaxes(1, 2)
    texels = texels.reshape(rows * columns, BLOCK_SIDE**2, 5)
    blocks = np.empty((rows * columns, format.block_bytes), np.uint8)
    for first in range(0, len(blocks), CHUNK):
        part = texels[first : first + CHUNK].astype(np.int64)
        blocks[first : first + CHUNK] = format.encode(part[..., :4], part[..., 4] > 0)
    return blocks.reshape(rows, columns, format.block_bytes)


def read_back(blocks: np.ndarray, format: CompressedFormat, width: int, height: int) -> np.ndarray:
    """Return the colours that glGetTexImage reads of a format with `decode_to_read`, float32, as those of `decoded`."""
    assert format.decode_to_read is not None
    cells = _decoded(blocks, width, height, format.decode_to_read, format.stored)
    return cells / np.float32(255) if cells.dtype == np.uint8 else cells


def _decoded(
    blocks: np.ndarray, width: int, height: int, decode: Callable[[np.ndarray], np.ndarray], stored: Format
) -> np.ndarray:
    rows, columns = blocks.shape[:2]
    cells = np.empty((rows, BLOCK_SIDE, columns * BLOCK_SIDE, 4), stored.dtype)
    step = max(CHUNK // max(columns, 1), 1)
    for row in range(0, rows, step):
        part = blocks[row : row + step]
        texels = decode(part).reshape(*part.shape[:2], BLOCK_SIDE, BLOCK_SIDE, 4).swapaxes(1, 2)
        cells[row : row + step] = _stored(texels, stored).reshape(len(part), BLOCK_SIDE, -1, 4)
    return cells.reshape(rows * BLOCK_SIDE, columns * BLOCK_SIDE, 4)[:height, :width]


def _stored(texels: np.ndarray, stored: Format) -> np.ndarray:
    """Return decoded channels as the cells of a format."""
    if stored.kind == "unorm8":
        return texels.astype(np.uint8)
    if stored.encoding == "srgb":
        alpha = texels[..., 3:].astype(np.float32) * STEP_OF_UNSIGNED
        return np.concatenate([SRGB[texels[..., :3]], alpha], axis=-1)
    return np.maximum(texels.astype(np.float32) * STEP_OF_SIGNED, np.float32(-1))
