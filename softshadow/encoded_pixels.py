"""Client pixels as colours of other than 8 bits, and back: by integers where Mesa converts so, else by floats.

References: texstore.c, texgetimage.c and format_utils.c of Mesa 22.3 (`_mesa_format_convert`).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from softshadow import tokens as gl
from softshadow.color_values import (
    CHANNEL,
    F32,
    as_rgba,
    from_float,
    packed_to_float,
    packed_to_unorm8,
    to_base,
    to_float,
    to_unorm8,
)
from softshadow.image import Format
from softshadow.jit import kernel, read_only
from softshadow.packed_colors import PACKED_COLORS, PackedColor
from softshadow.pixel_store import COMPONENTS
from softshadow.texel_codes import (
    as_floats,
    as_halves,
    cells_of,
    codes_of,
    codes_of_bytes,
    codes_of_floats,
    codes_of_integers,
    resized,
    rounded_up,
)


def bytes_of(format: Format) -> Format:
    """Return the format of bytes with the same channels."""
    return Format(format.base, "unorm8", np.uint8, 4, 255)


def encoded_bytes(cells: np.ndarray, format: Format) -> np.ndarray:
    """Return the cells of a format of bytes as those of one with codes."""
    encoded = np.empty(cells.shape, format.dtype)
    look_up_channels(
        read_only(np.ascontiguousarray(cells).reshape(-1, 4)), _cells_of_bytes(format), encoded.reshape(-1, 4)
    )
    return encoded


@lru_cache(maxsize=64)
def _cells_of_bytes(format: Format) -> np.ndarray:
    """Return the cells (256, 4) of all bytes in each channel."""
    return cells_of(codes_of_bytes(np.repeat(np.arange(256)[:, None], 4, axis=1), format), format)


@kernel
def look_up_channels(numbers: np.ndarray, table: np.ndarray, out: np.ndarray) -> None:
    """Write rows (n, 4) of a table at the numbers (n, 4) of each channel."""
    for n in range(numbers.shape[0]):
        for c in range(4):
            out[n, c] = table[numbers[n, c], c]


DIRECT = {  # clients' pixels that Mesa packs at once: RGBA in bytes
    gl.GL_UNSIGNED_BYTE: gl.GL_RGBA, gl.GL_UNSIGNED_INT_8_8_8_8_REV: gl.GL_RGBA,
    gl.GL_UNSIGNED_INT_8_8_8_8: gl.GL_ABGR_EXT,
}  # fmt: skip


def encoded(pixels: np.ndarray, pixel_format: int, format: Format, type: int) -> np.ndarray:
    """Return client colours (h, w, components) as the cells (h, w, 4) of a format with codes, or of half floats."""
    packed = PACKED_COLORS.get(type)
    is_bytes = packed is not None and bool((packed.largest == 255).all())
    if packed is not None and is_bytes:
        pixels = packed.split(pixels[..., 0]).astype(np.uint8)
    is_direct = (pixels.dtype == np.uint8 and DIRECT.get(type) == pixel_format) or (
        pixels.dtype == F32 and pixel_format == gl.GL_RGBA
    )
    is_packed = packed is not None and not is_bytes
    if format.has_few_bits and not (is_direct and pixels.dtype == F32):
        values = packed_to_unorm8(pixels, packed) if packed is not None and is_packed else to_unorm8(pixels)
        return encoded_bytes(as_rgba(values, pixel_format, 255, format.base), format)
    if format.encoding == "unorm" and not is_packed and pixels.dtype.kind in "ui":
        n_bits = pixels.dtype.itemsize * 8 - (pixels.dtype.kind == "i")
        if format.is_array or is_direct:
            positive = pixels if pixels.dtype.kind == "u" else np.maximum(pixels, 0)
            rgba = to_base(as_rgba(positive, pixel_format, (1 << n_bits) - 1), format.base)
            if format.bits == (n_bits, n_bits, n_bits, n_bits) and format.dtype == F32:
                return as_floats(rgba, n_bits)
            return cells_of(codes_of_integers(rgba, n_bits, format), format)
    floats = packed_to_float(pixels, packed) if packed is not None and is_packed else to_float(pixels)
    rgba = to_base(as_rgba(floats, pixel_format, 1), format.base)
    if format.encoding == "half":
        return as_halves(rgba, truncated=is_direct or is_packed)
    return cells_of(codes_of_floats(rgba, format, is_direct or is_packed), format)


def decoded(cells: np.ndarray, format: Format, pixel_format: int, kind: type[np.generic] | PackedColor) -> np.ndarray:
    """Return the cells of a format with codes as client pixels: where Mesa can, without floats on the way."""
    if isinstance(kind, PackedColor) and kind.small_floats is not None:
        floats = decoded(cells, format, pixel_format, F32)
        return kind.small_floats.words(floats)[..., np.newaxis]
    codes, names = codes_of(cells, format), COMPONENTS[pixel_format]
    sources = {gl.GL_LUMINANCE: "R001", gl.GL_INTENSITY: "R001", gl.GL_LUMINANCE_ALPHA: "R00A"}.get(format.base, "RGBA")
    parts = []
    for part, name in enumerate(names.replace("L", "R")):
        source = sources[CHANNEL[name]]
        n_bits = format.bits[CHANNEL[source]] if source in CHANNEL else 0
        if n_bits == 0:  # a constant
            is_one = source == "1" or name == "A"
            n_bits, values = 1, np.full(codes.shape[:2], int(is_one))
        else:
            values = codes[..., CHANNEL[source]]
        parts.append(decoded_part(values, n_bits, format, kind, part, "L" in names))
    if isinstance(kind, PackedColor):
        return kind.join(np.stack(parts, axis=-1))[..., np.newaxis]
    return np.stack(parts, axis=-1)


def decoded_part(
    values: np.ndarray, n_bits: int, format: Format, kind: type[np.generic] | PackedColor, part: int, is_sum: bool
) -> np.ndarray:
    """Return one channel of codes as the numbers of a client type, or as part of a packed type."""
    if isinstance(kind, PackedColor):
        wanted = kind.fields[part][1]
        if max(n for _, n in kind.fields) <= 8:
            return resized(resized(values, n_bits, 8), 8, wanted)
        return rounded_up(as_floats(values, n_bits), wanted)
    dtype = np.dtype(kind)
    if dtype.kind == "f" or (is_sum and dtype.kind == "u"):
        return from_float(as_floats(values, n_bits), kind)
    if format.is_array or kind == np.uint8:
        return resized(values, n_bits, dtype.itemsize * 8 - (dtype.kind == "i")).astype(kind)
    return from_float(as_floats(values, n_bits), kind)
