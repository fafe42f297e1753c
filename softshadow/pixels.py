"""Conversion of pixels between client memory and storage: glTexImage2D, glReadPixels and glGetTexImage.

Bit for bit as in llvmpipe. Two rules of GL may surprise: a float uploaded as depth is truncated, not rounded, and
glReadPixels returns R + G + B as luminance. One rule is Mesa's own: a float of exactly 1 is read as 0 with
GL_UNSIGNED_INT, and as the smallest integer with GL_INT.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from softshadow import tokens as gl
from softshadow.color_values import (
    CHANNEL,
    F32,
    as_rgba,
    color_as_float,
    from_float,
    from_unorm8,
    largest_of,
    packed_to_float,
    packed_to_unorm8,
    sum_of_colors,
    swizzled,
    to_base,
    to_float,
    to_unorm8,
)
from softshadow.encoded_pixels import bytes_of, decoded, encoded, encoded_bytes
from softshadow.image import D32F, Format
from softshadow.jit import read_only
from softshadow.packed_colors import PACKED_COLORS, PackedColor, with_more_bits
from softshadow.packed_floats import SharedExponent
from softshadow.pixel_store import COMPONENTS, PACKED_TYPES, TYPES
from softshadow.pixel_transfer import PixelTransfer
from softshadow.texel_codes import as_halves, cells_of, clamped, codes_of, codes_of_floats

LARGEST_UINT = (1 << 32) - 1
LARGEST_24 = (1 << 24) - 1
LARGEST_SAMPLED = (1 << 23) - 1  # llvmpipe samples the upper 23 bits of 32-bit depth
UNCHANGED = PixelTransfer()
MANY = 1 << 14  # packed pixels; so many of up to 16 bits are converted by a table of all that there can be


def stored_units(units: np.ndarray) -> np.ndarray:
    """Return depth in buffer units as it is stored: 2**32 instead of the largest 32-bit integer."""
    return np.where(units == LARGEST_UINT, np.float64(1 << 32), units)


# -- depth -------------------------------------------------------------------------------------------------------------
def quantized_depth(z: np.ndarray, format: Format) -> np.ndarray:
    """Return float32 z in [0, 1] in buffer units, rounded like a fragment's depth."""
    if not format.largest:
        return z.astype(format.dtype)
    if format.largest == LARGEST_UINT:  # truncated to 31 bits; only z = 1 gives 2**32
        return np.floor(z * F32(1 << 31)) * F32(2)
    return np.rint(z * F32(format.largest))


def sampled_depth(cells: np.ndarray, format: Format) -> np.ndarray:
    """Return depth as a texture lookup reads it, float32: units times the rounded step; of 32 bits the upper 23."""
    if not format.largest:
        return cells.astype(F32)
    if format.largest == LARGEST_UINT:
        return np.minimum(np.floor(cells / 512), LARGEST_SAMPLED).astype(F32) * (F32(1) / F32(LARGEST_SAMPLED))
    return cells * (F32(1) / F32(format.largest))


def depth_as_float(cells: np.ndarray, format: Format) -> np.ndarray:
    """Return depth as glReadPixels reads it, float32: the rounded quotient; of 16 bits, units times rounded step."""
    if not format.largest:
        return cells.astype(F32)
    if format.largest == (1 << 16) - 1:
        return sampled_depth(cells, format)
    if cells.dtype == F32 and format.largest == LARGEST_24:  # both exact in float32, so the quotient is rounded once
        units = np.minimum(cells, F32(LARGEST_24))
        return np.divide(units, F32(LARGEST_24), out=units)
    return (np.minimum(cells.astype(np.float64), format.largest) / format.largest).astype(F32)


def unpack_depth(pixels: np.ndarray, format: Format, transfer: PixelTransfer = UNCHANGED) -> np.ndarray:
    """Return client depth (h, w) of any type, converted to buffer units."""
    if transfer.changes_depth:
        return _truncated_depth(transfer.scaled_depth(_depth_from_client(pixels)), format)
    if pixels.dtype == np.uint16 and format.largest == (1 << 16) - 1:
        return pixels.astype(F32)
    if pixels.dtype == np.uint32 and format.largest == LARGEST_UINT:
        return stored_units(pixels.astype(np.float64))
    if pixels.dtype == np.uint32 and format.largest == (1 << 16) - 1:
        return (pixels >> np.uint32(16)).astype(F32)
    if pixels.dtype == np.uint16 and format.largest == LARGEST_UINT:
        return stored_units(pixels * np.float64((1 << 16) + 1))
    return _truncated_depth(_depth_from_client(pixels), format)


def _truncated_depth(z: np.ndarray, format: Format) -> np.ndarray:
    """Return any float32 z in buffer units: clamped to [0, 1] and truncated, as in an upload."""
    z = np.clip(z, F32(0), F32(1))
    if format.largest == LARGEST_UINT:
        return stored_units(np.floor(z * np.float64(LARGEST_UINT)))
    return np.floor(z * F32(format.largest)) if format.largest else z


def _depth_from_client(pixels: np.ndarray) -> np.ndarray:
    if pixels.dtype.kind == "f":
        return pixels.astype(F32)
    largest = largest_of(pixels.dtype.type)
    if pixels.dtype == np.uint32:
        return (pixels / np.float64(largest)).astype(F32)
    if pixels.dtype == np.uint8:
        return pixels.astype(F32) / F32(largest)
    if pixels.dtype == np.uint16:
        return pixels.astype(F32) * (F32(1) / F32(largest))
    doubled = F32(2) * pixels.astype(F32) + F32(1)
    if pixels.dtype == np.int32:
        return doubled * (F32(1) / F32(2 * largest))
    return np.where(pixels == 0, F32(0), doubled * (F32(1) / F32(2 * largest + 1)))


def pack_depth(
    cells: np.ndarray,
    format: Format,
    dtype: type[np.generic],
    through_float: bool = False,
    transfer: PixelTransfer = UNCHANGED,
) -> np.ndarray:
    """Return depth in buffer units (h, w) as a client type.

    For GL_UNSIGNED_INT, the upper bits of fixed-point depth are repeated below it. glGetTexImage converts 16 and 24
    bits to floats instead (`through_float`).
    """
    exact = not transfer.changes_depth
    if dtype == np.uint32 and format.largest and exact and not (through_float and format.largest < LARGEST_UINT):
        units: np.ndarray = np.minimum(cells, cells.dtype.type(format.largest)).astype(np.uint32)
        if format.largest == (1 << 16) - 1:
            units |= units << np.uint32(16)
        elif format.largest == LARGEST_24:
            highest = units >> np.uint32(16)
            units <<= np.uint32(8)
            units |= highest
        return units
    z = depth_as_float(cells, format)
    if transfer.changes_depth:
        z = transfer.scaled_depth(z)
    if np.dtype(dtype).kind == "f":
        return z.astype(dtype, copy=False)
    largest = largest_of(dtype)
    if dtype == np.uint16:
        return np.rint(z * F32(largest)).astype(dtype)
    if dtype in (np.int8, np.int16):
        return np.trunc(((z * F32(2 * largest + 1)).astype(np.int64) - 1) / 2).astype(dtype)
    return np.floor(z.astype(np.float64) * largest).astype(dtype)


def unpack_stencil(pixels: np.ndarray, transfer: PixelTransfer = UNCHANGED) -> np.ndarray:
    """Return client stencil values (h, w) of any type, uint8."""
    return transfer.uploaded_stencil(pixels.astype(np.int64))


def pack_stencil(cells: np.ndarray, dtype: type[np.generic], transfer: PixelTransfer = UNCHANGED) -> np.ndarray:
    """Return stencil values as a client type; GL_BYTE holds 7 bits."""
    if transfer.changes_stencil:
        cells = transfer.read_stencil(cells)
    return (cells & np.uint8(127) if dtype == np.int8 else cells).astype(dtype)


# -- depth and stencil in one element ----------------------------------------------------------------------------------
def unpack_packed_depth(pixels: np.ndarray, format: Format, transfer: PixelTransfer = UNCHANGED) -> np.ndarray:
    """Return the depth of packed client pixels (h, w) in buffer units; 24-bit depth is copied exactly."""
    if pixels.dtype.names:
        z = pixels["depth"]
        return _truncated_depth(transfer.scaled_depth(z) if transfer.changes_depth else z, format)
    units = (pixels >> np.uint32(8)).astype(F32)
    if transfer.changes_depth:
        return _truncated_depth(transfer.scaled_depth(units * (F32(1) / F32(LARGEST_24))), format)
    return units if format.largest == LARGEST_24 else _truncated_depth(units * (F32(1) / F32(LARGEST_24)), format)


def unpack_packed_stencil(pixels: np.ndarray, transfer: PixelTransfer = UNCHANGED) -> np.ndarray:
    """Return the stencil values of packed client pixels (h, w), uint8."""
    words = pixels["stencil"] if pixels.dtype.names else pixels
    return unpack_stencil(words & np.uint32(255), transfer)


def pack_depth_stencil(
    depth: np.ndarray, stencil: np.ndarray, format: Format, type: int, transfer: PixelTransfer = UNCHANGED
) -> np.ndarray:
    """Return depth in buffer units and stencil values (h, w) as a packed client type.

    24-bit depth is copied exactly; a float is scaled in its own precision, then truncated to 24 bits.
    """
    if transfer.changes_stencil:
        stencil = transfer.read_stencil(stencil)
    if transfer.changes_depth:
        depth, format = transfer.scaled_depth(depth_as_float(depth, format)), D32F
    if type == gl.GL_UNSIGNED_INT_24_8:
        units = depth if format.largest == LARGEST_24 else depth * depth.dtype.type(LARGEST_24)
        return units.astype(np.uint32) << np.uint32(8) | stencil
    packed = np.zeros(depth.shape, PACKED_TYPES[type])
    packed["depth"], packed["stencil"] = depth_as_float(depth, format), stencil
    return packed


# -- colour ------------------------------------------------------------------------------------------------------------
def unpack_color(
    pixels: np.ndarray,
    pixel_format: int,
    format: Format,
    type: int = gl.GL_NONE,
    transfer: PixelTransfer = UNCHANGED,
) -> np.ndarray:
    """Return client colours (h, w, components) as the cells (h, w, 4) of an image of colours.

    `type` is that of packed pixels, one element per pixel; others are known by their dtype. Colour indices become
    colours by the tables of glPixelMap.
    """
    if type in PACKED_COLORS and pixels.itemsize <= 2 and pixels.size >= MANY and not transfer.through_floats:
        return _cells_of_words(pixel_format, format, type).take(pixels[..., 0], axis=0)
    return _converted_color(pixels, pixel_format, format, type, transfer)


@lru_cache(maxsize=8)
def _cells_of_words(pixel_format: int, format: Format, type: int) -> np.ndarray:
    """Return the cells of all packed pixels of 8 or 16 bits, by their numbers: (256, 4) or (65536, 4)."""
    dtype = PACKED_COLORS[type].dtype
    words = np.arange(np.iinfo(dtype).max + 1, dtype=dtype)
    cells = _converted_color(words[:, np.newaxis, np.newaxis], pixel_format, format, type, UNCHANGED)
    return read_only(cells[:, 0])


def _converted_color(
    pixels: np.ndarray, pixel_format: int, format: Format, type: int, transfer: PixelTransfer
) -> np.ndarray:
    if format.encoding == "srgb":
        return encoded_bytes(_converted_color(pixels, pixel_format, bytes_of(format), type, transfer), format)
    if pixel_format == gl.GL_COLOR_INDEX:
        indices = pixels[..., 0].astype(np.int64) & LARGEST_UINT
        colors = to_unorm8(transfer.indexed_color(transfer.shifted(indices)))  # as in Mesa, whatever the format
        return _converted_color(colors, gl.GL_RGBA, format, gl.GL_UNSIGNED_BYTE, UNCHANGED)
    packed = PACKED_COLORS.get(type)
    if transfer.through_floats:
        floats = packed_to_float(pixels, packed) if packed else to_float(pixels)
        return to_cells(transfer.color(as_rgba(floats, pixel_format, 1)), format)
    if format.encoding:
        return encoded(pixels, pixel_format, format, type)
    if format.kind == "unorm8":
        values, one = packed_to_unorm8(pixels, packed) if packed else to_unorm8(pixels), 255
    else:
        values, one = packed_to_float(pixels, packed) if packed else to_float(pixels), 1
    return as_rgba(values, pixel_format, one, format.base)


def to_cells(rgba: np.ndarray, format: Format) -> np.ndarray:
    """Return float colours (h, w, 4) as the cells of an image of colours."""
    if format.encoding == "srgb":
        return encoded_bytes(to_base(to_unorm8(rgba), format.base), format)
    if format.encoding == "half":
        return to_base(as_halves(rgba, truncated=True), format.base)
    if format.encoding:
        return cells_of(codes_of_floats(to_base(rgba, format.base), format, is_direct=True), format)
    return to_base(to_unorm8(rgba) if format.kind == "unorm8" else rgba, format.base)


def client_kind(type: int) -> type[np.generic] | PackedColor:
    """Return what client pixels of a type are made of: numbers, or packed colours."""
    return PACKED_COLORS[type] if type in PACKED_COLORS else TYPES[type]


def pack_color(
    cells: np.ndarray,
    format: Format,
    pixel_format: int,
    kind: type[np.generic] | PackedColor,
    from_framebuffer: bool = False,
    transfer: PixelTransfer = UNCHANGED,
) -> np.ndarray:
    """Return colour cells (h, w, 4) as client pixels (h, w, components), or (h, w, 1) of a packed type.

    Luminance and intensity are read as (L, 0, 0, A), sRGB without being decoded. With `from_framebuffer`, luminance is
    R + G + B, and colours are clamped to [0, 1] before conversion to integers. Texture colours are clamped for unsigned
    types only, where luminance is converted to floats first; the alpha of a format without alpha is the largest
    integer.
    """
    if format.encoding == "srgb":
        cells, format = codes_of(cells, format).astype(np.uint8), bytes_of(format)
        cells = to_base(cells, format.base)
    elif format.encoding == "unorm":
        return decoded(cells, format, pixel_format, kind)
    one = 255 if format.kind == "unorm8" else 1
    base = {gl.GL_LUMINANCE: "R001", gl.GL_INTENSITY: "R001", gl.GL_LUMINANCE_ALPHA: "R00A"}.get(format.base, "RGBA")
    rgba = swizzled(cells, base, one)
    names = COMPONENTS[pixel_format]
    sign = ("u" if kind.small_floats is None else "f") if isinstance(kind, PackedColor) else np.dtype(kind).kind
    sums = from_framebuffer and "L" in names and format.base in (gl.GL_RG, gl.GL_RGB, gl.GL_RGBA)
    is_shared = isinstance(kind, PackedColor) and isinstance(kind.small_floats, SharedExponent)  # clamped in Mesa only
    is_clamped = from_framebuffer and (sign != "f" or is_shared) and format.kind != "unorm8"
    if transfer.through_floats:
        rgba, one = transfer.color(color_as_float(rgba)), 1
        is_clamped = is_clamped or (sums and format.kind == "unorm8")
    if is_clamped:
        rgba = np.clip(rgba, F32(0), F32(1))
    if sums:
        total = sum_of_colors(rgba)
        if is_clamped or format.kind == "unorm8":
            np.clip(total, F32(0), F32(1), out=total)
        rgba = np.stack([total, color_as_float(rgba[..., 3])] if "A" in names else [total], axis=-1)
    elif "L" in names and sign == "u" and not from_framebuffer:
        rgba, one = color_as_float(rgba), 1
    chosen = rgba if sums else swizzled(rgba, names.replace("L", "R"), one)
    if isinstance(kind, PackedColor):
        return _packed(chosen, kind, format)
    if chosen.dtype == np.uint8:
        return from_unorm8(chosen, kind)
    pixels = from_float(chosen, kind)
    if sign == "i" and not from_framebuffer and (base[3] == "1" or not format.written[3]):
        pixels[..., [name == "A" for name in names]] = largest_of(kind)
    return pixels


def pack_color_into(
    pixels: np.ndarray,
    cells: np.ndarray,
    format: Format,
    pixel_format: int,
    kind: type[np.generic] | PackedColor,
    from_framebuffer: bool = False,
    transfer: PixelTransfer = UNCHANGED,
) -> None:
    """Write what `pack_color` returns to client memory; bytes become floats there, without an array between."""
    names = COMPONENTS[pixel_format]
    of_bytes = format.kind == "unorm8" and format.base == gl.GL_RGBA and not format.encoding
    if kind is np.uint8 and of_bytes and names == "RGBA" and not transfer.through_floats:
        pixels[...] = cells
    elif kind is not F32 or not of_bytes or "L" in names or transfer.through_floats or pixels.dtype != F32:
        pixels[...] = pack_color(cells, format, pixel_format, kind, from_framebuffer, transfer)
    elif names == "RGBA":
        to_float(cells, pixels)
    else:
        for part, name in enumerate(names):
            to_float(cells[..., CHANNEL[name]], pixels[..., part])


def _packed(values: np.ndarray, packed: PackedColor, format: Format) -> np.ndarray:
    """Return components (h, w, n), bytes or floats, as packed pixels (h, w, 1)."""
    if packed.small_floats is not None:
        return packed.small_floats.words(color_as_float(values))[..., np.newaxis]
    components = np.empty(values.shape, np.int64)
    of_bytes, floats = values.dtype == np.uint8, color_as_float(values)
    for part, (largest, (_, n_bits)) in enumerate(zip(packed.largest.tolist(), packed.fields, strict=True)):
        if of_bytes and n_bits <= 8:
            components[..., part] = (values[..., part].astype(np.int64) * largest + 127) // 255
        elif of_bytes and format.base == gl.GL_RGBA:  # Mesa converts such bytes without floats
            components[..., part] = with_more_bits(values[..., part].astype(np.int64), 8, n_bits)
        else:
            components[..., part] = np.rint(clamped(floats[..., part]) * F32(largest))
    return packed.join(components)[..., np.newaxis]
