"""Colours of client pixels as numbers of another type, and as RGBA: bytes and floats, bit for bit as in Mesa."""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.jit import kernel, read_only
from softshadow.packed_colors import PackedColor, with_more_bits
from softshadow.pixel_store import COMPONENTS
from softshadow.texel_codes import clamped

F32 = np.float32
ZERO, ONE, LARGEST_BYTE = F32(0), F32(1), F32(255)
GREEN, BLUE, UPPERMOST = np.uint32(8), np.uint32(16), np.uint32(24)  # bits below the byte of a channel
OPAQUE, TRANSPARENT = np.uint32(255 << 24), np.uint32(0)
LARGE = 1 << 18  # bytes of an image from which calling a kernel pays
CHANNEL = {"R": 0, "G": 1, "B": 2, "A": 3}
SOURCES = {  # of the channels in a base internal format (GL 2.1, table 3.15)
    gl.GL_RGBA: "RGBA",
    gl.GL_RGB: "RGB1",
    gl.GL_RG: "RG01",
    gl.GL_RED: "R001",
    gl.GL_ALPHA: "000A",
    gl.GL_LUMINANCE: "RRR1",
    gl.GL_LUMINANCE_ALPHA: "RRRA",
    gl.GL_INTENSITY: "RRRR",
}


def largest_of(dtype: type[np.generic]) -> int:
    """Return the integer that represents 1 in a client type."""
    kind = np.dtype(dtype)
    return int(1 << (8 * kind.itemsize - (kind.kind == "i"))) - 1


def to_base(rgba: np.ndarray, base: int) -> np.ndarray:
    """Return RGBA (..., 4) as sampling reads it in a base internal format."""
    return swizzled(rgba, SOURCES[base], 255 if rgba.dtype == np.uint8 else 1)


def swizzled(rgba: np.ndarray, sources: str, one: int) -> np.ndarray:
    """Return RGBA pixels with other channels: each source is a letter of RGBA, 0 or 1; `one` is the number for 1."""
    if sources == "RGBA":
        return rgba
    out = np.empty((*rgba.shape[:-1], len(sources)), rgba.dtype)
    if sources == "RGB":
        if rgba.dtype == np.uint8 and rgba.ndim == 3 and rgba.size >= LARGE:
            copy_rgb(read_only(rgba), out)
        else:
            out[...] = rgba[..., :3]
        return out
    for channel, source in enumerate(sources):
        out[..., channel] = rgba[..., CHANNEL[source]] if source in CHANNEL else one * int(source)
    return out


@kernel
def copy_rgb(rgba: np.ndarray, rgb: np.ndarray) -> None:
    """Write the first three channels of pixels (h, w, 4) to (h, w, 3); NumPy would take one channel after the other."""
    for y in range(rgba.shape[0]):
        for x in range(rgba.shape[1]):
            j, i = np.uint64(y), np.uint64(x)
            rgb[j, i, 0], rgb[j, i, 1], rgb[j, i, 2] = rgba[j, i, 0], rgba[j, i, 1], rgba[j, i, 2]


def as_rgba(values: np.ndarray, pixel_format: int, one: int, base: int = gl.GL_RGBA) -> np.ndarray:
    """Return the components of client pixels (h, w, n) as RGBA (h, w, 4): the same array if nothing changes.

    With `base`, as sampling reads them in this base internal format.
    """
    names, sources = COMPONENTS[pixel_format], SOURCES[base]
    if names == sources:
        return values
    known = {channel: names.find("L" if "L" in names and channel != "A" else channel) for channel in CHANNEL}
    known |= {"0": -1, "1": -1}
    places = [known[source] for source in sources]
    is_opaque = sources[3] == "1" or (sources[3] == "A" and known["A"] < 0)
    if values.dtype == np.uint8 and values.flags.c_contiguous and 4 * values.size >= LARGE * len(names):
        rgba, rest = np.empty((*values.shape[:2], 4), np.uint8), OPAQUE if is_opaque else TRANSPARENT
        write_rgba(read_only(values.reshape(-1)), len(names), *places, rest, rgba.reshape(-1).view(np.uint32))
        return rgba
    rgba = np.zeros((*values.shape[:2], 4), values.dtype)
    rgba[..., 3] = one if is_opaque else 0
    for channel, place in enumerate(places):
        if place >= 0:
            rgba[..., channel] = values[..., place]
    return rgba


@kernel
def write_rgba(
    values: np.ndarray,
    step: int,
    red: int,
    green: int,
    blue: int,
    alpha: int,
    rest: np.uint32,
    pixels: np.ndarray,
) -> None:
    """Write bytes (step * n,) as RGBA pixels (n,) of 32 bits.

    The colours are the places of the channels in a pixel, negative for those that it has not: they are as in `rest`.
    """
    for i in range(pixels.shape[0]):
        first, pixel = i * step, rest
        if alpha >= 0:
            pixel = np.uint32(values[np.uint64(first + alpha)]) << UPPERMOST
        if red >= 0:
            pixel |= np.uint32(values[np.uint64(first + red)])
        if green >= 0:
            pixel |= np.uint32(values[np.uint64(first + green)]) << GREEN
        if blue >= 0:
            pixel |= np.uint32(values[np.uint64(first + blue)]) << BLUE
        pixels[np.uint64(i)] = pixel


def packed_to_unorm8(words: np.ndarray, packed: PackedColor) -> np.ndarray:
    """Return packed pixels (h, w, 1) as bytes (h, w, n)."""
    if packed.small_floats is not None:
        return to_unorm8(packed.small_floats.floats(words[..., 0]))
    components = packed.split(words[..., 0])
    for part, (_, n_bits) in enumerate(packed.fields):
        values = components[..., part]
        more = (values * 255 + 511) // 1023 if n_bits > 8 else with_more_bits(values, n_bits, 8)
        components[..., part] = more
    return components.astype(np.uint8)


def packed_to_float(words: np.ndarray, packed: PackedColor) -> np.ndarray:
    """Return packed pixels (h, w, 1) as float32 (h, w, n)."""
    if packed.small_floats is not None:
        return packed.small_floats.floats(words[..., 0])
    floats: np.ndarray = packed.split(words[..., 0]).astype(F32) * (F32(1) / packed.largest.astype(F32))
    return floats


def to_unorm8(values: np.ndarray) -> np.ndarray:
    """Return numbers of any client type as bytes: 255 for 1; bytes are returned as they are."""
    if values.dtype.kind == "f":
        if values.dtype == F32 and values.nbytes >= LARGE and values.flags.c_contiguous:
            nearest = np.empty(values.shape, np.uint8)
            write_bytes(read_only(values.reshape(-1)), nearest.reshape(-1))
            return nearest
        return np.rint(clamped(values.astype(F32)) * F32(255)).astype(np.uint8)
    if values.dtype == np.uint8:
        return values
    largest, wide = largest_of(values.dtype.type), np.uint32 if values.dtype.itemsize < 4 else np.uint64
    positive = np.maximum(values, 0).astype(wide)
    return ((positive * wide(255) + wide(largest // 2)) // wide(largest)).astype(np.uint8)


@kernel
def write_bytes(floats: np.ndarray, nearest: np.ndarray) -> None:
    """Write floats (n,) as bytes, clamped to [0, 1]; NaN becomes 0."""
    for i in range(floats.shape[0]):
        value = floats[i] if floats[i] > ZERO else ZERO
        nearest[i] = np.int32(np.rint((value if value < ONE else ONE) * LARGEST_BYTE))


def to_float(values: np.ndarray, out: np.ndarray | None = None) -> np.ndarray:
    """Return numbers of any client type as float32: integers in [-1, 1]; float32 is returned as it is.

    Integers are written to `out` if it is given.
    """
    if values.dtype.kind == "f":
        return values.astype(F32, copy=False)
    step = F32(1) / F32(largest_of(values.dtype.type))
    floats: np.ndarray = np.multiply(values, step, out=out, dtype=F32, casting="unsafe")
    return floats if values.dtype.kind == "u" else np.maximum(floats, F32(-1), out=floats)


def color_as_float(cells: np.ndarray) -> np.ndarray:
    """Return the cells of a colour image as float32."""
    return to_float(cells)


def sum_of_colors(rgba: np.ndarray) -> np.ndarray:
    """Return red + green + blue of pixels (h, w, 4) as float32 (h, w)."""
    if rgba.dtype == np.uint8 and rgba.ndim == 3 and rgba.size >= LARGE:
        total = np.empty(rgba.shape[:2], F32)
        write_sums(read_only(rgba), F32(1) / F32(255), total)
        return total
    red, green, blue = (color_as_float(rgba[..., channel]) for channel in range(3))
    total = red + green
    total += blue
    return total


@kernel
def write_sums(rgba: np.ndarray, step: np.float32, total: np.ndarray) -> None:
    """Write the sum of the first three channels (h, w, 4), each times a step, to (h, w)."""
    for y in range(rgba.shape[0]):
        for x in range(rgba.shape[1]):
            j, i = np.uint64(y), np.uint64(x)
            red, green, blue = F32(rgba[j, i, 0]) * step, F32(rgba[j, i, 1]) * step, F32(rgba[j, i, 2]) * step
            total[j, i] = red + green + blue


def from_unorm8(values: np.ndarray, dtype: type[np.generic]) -> np.ndarray:
    """Return bytes as numbers of a client type."""
    if dtype == np.uint8:
        return values
    if np.dtype(dtype).kind == "f":
        return to_float(values).astype(dtype, copy=False)
    return ((values.astype(np.int64) * largest_of(dtype) + 127) // 255).astype(dtype)


def from_float(values: np.ndarray, dtype: type[np.generic]) -> np.ndarray:
    """Return floats as numbers of a client type; integers are clamped to what the type can hold, and 0 for NaN."""
    if np.dtype(dtype).kind == "f":
        return values.astype(dtype, copy=False)
    if dtype == np.uint8:
        return to_unorm8(values)
    values = np.where(np.isnan(values), F32(0), values)
    largest = largest_of(dtype)
    low = F32(-1) if np.dtype(dtype).kind == "i" else F32(0)
    # 2**32 - 1 is not a float32: 1 gives 2**32, which wraps around to 0 in 32 bits
    scaled = np.rint(np.clip(values, low, F32(1)) * F32(largest)).astype(np.int64).astype(dtype)
    return np.where(values > F32(1), dtype(largest), scaled) if np.dtype(dtype).kind == "i" else scaled
