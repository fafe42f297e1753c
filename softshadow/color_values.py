"""Colours of client pixels as numbers of another type, and as RGBA: bytes and floats, bit for bit as in Mesa."""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.jit import kernel, read_only
from softshadow.packed_colors import PackedColor, with_more_bits
from softshadow.pixel_store import COMPONENTS
from softshadow.texel_codes import clamped

F32 = np.float32
LARGE = 1 << 18  # bytes of an image from which calling a kernel pays
CHANNEL = {"R": 0, "G": 1, "B": 2, "A": 3}


def largest_of(dtype: type[np.generic]) -> int:
    """Return the integer that represents 1 in a client type."""
    kind = np.dtype(dtype)
    return int(1 << (8 * kind.itemsize - (kind.kind == "i"))) - 1


def to_base(rgba: np.ndarray, base: int) -> np.ndarray:
    """Return RGBA (..., 4) as sampling reads it in a base internal format (GL 2.1, table 3.15)."""
    one = 255 if rgba.dtype == np.uint8 else 1
    sources = {
        gl.GL_RGBA: "RGBA",
        gl.GL_RGB: "RGB1",
        gl.GL_RG: "RG01",
        gl.GL_RED: "R001",
        gl.GL_ALPHA: "000A",
        gl.GL_LUMINANCE: "RRR1",
        gl.GL_LUMINANCE_ALPHA: "RRRA",
        gl.GL_INTENSITY: "RRRR",
    }[base]
    return swizzled(rgba, sources, one)


def swizzled(rgba: np.ndarray, sources: str, one: int) -> np.ndarray:
    """Return RGBA pixels with other channels: each source is a letter of RGBA, 0 or 1; `one` is the number for 1."""
    if sources == "RGBA":
        return rgba
    out = np.empty((*rgba.shape[:-1], len(sources)), rgba.dtype)
    if sources == "RGB" and rgba.dtype == np.uint8 and rgba.ndim == 3 and rgba.size >= LARGE:
        copy_rgb(read_only(rgba), out)
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


def as_rgba(values: np.ndarray, pixel_format: int, one: int) -> np.ndarray:
    """Return the components of client pixels (h, w, n) as RGBA (h, w, 4)."""
    rgba = np.zeros((*values.shape[:2], 4), values.dtype)
    rgba[..., 3] = one
    for component, name in enumerate(COMPONENTS[pixel_format]):
        for channel in "RGB" if name == "L" else name:
            rgba[..., CHANNEL[channel]] = values[..., component]
    return rgba


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
    """Return numbers of any client type as bytes: 255 for 1."""
    if values.dtype.kind == "f":
        return np.rint(clamped(values.astype(F32)) * F32(255)).astype(np.uint8)
    largest = largest_of(values.dtype.type)
    positive = np.maximum(values, 0).astype(np.uint64)
    return ((positive * np.uint64(255) + np.uint64(largest // 2)) // np.uint64(largest)).astype(np.uint8)


def to_float(values: np.ndarray) -> np.ndarray:
    """Return numbers of any client type as float32: integers in [-1, 1]."""
    if values.dtype.kind == "f":
        return values.astype(F32)
    return np.maximum(values.astype(F32) * (F32(1) / F32(largest_of(values.dtype.type))), F32(-1))


def color_as_float(cells: np.ndarray) -> np.ndarray:
    """Return the cells of a colour image as float32."""
    return to_float(cells)


def from_unorm8(values: np.ndarray, dtype: type[np.generic]) -> np.ndarray:
    """Return bytes as numbers of a client type."""
    if dtype == np.uint8:
        return values
    if np.dtype(dtype).kind == "f":
        return to_float(values).astype(dtype)
    return ((values.astype(np.int64) * largest_of(dtype) + 127) // 255).astype(dtype)


def from_float(values: np.ndarray, dtype: type[np.generic]) -> np.ndarray:
    """Return floats as numbers of a client type; integers are clamped to what the type can hold, and 0 for NaN."""
    if np.dtype(dtype).kind == "f":
        return values.astype(dtype)
    values = np.where(np.isnan(values), F32(0), values)
    largest = largest_of(dtype)
    low = F32(-1) if np.dtype(dtype).kind == "i" else F32(0)
    # 2**32 - 1 is not a float32: 1 gives 2**32, which wraps around to 0 in 32 bits
    scaled = np.rint(np.clip(values, low, F32(1)) * F32(largest)).astype(np.int64).astype(dtype)
    return np.where(values > F32(1), dtype(largest), scaled) if np.dtype(dtype).kind == "i" else scaled
