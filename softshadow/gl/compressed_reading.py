"""Compressed images read as pixels: Mesa draws them to a format of the client's bits, and reads that.

References: st_GetTexSubImage in st_cb_texture.c of Mesa 22.3; texgetimage.c for what cannot be drawn (LATC2).
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.color_values import color_as_float, swizzled, to_unorm8
from softshadow.compression import COMPRESSED, read_back
from softshadow.encoded_pixels import bytes_of, decoded
from softshadow.image import Format, Image
from softshadow.packed_colors import PackedColor
from softshadow.pixel_store import COMPONENTS
from softshadow.pixels import client_kind, pack_color
from softshadow.texel_codes import as_halves, codes_of, drawn_cells

OF_32_BITS = (np.uint32, np.int32)
HALF_FLOATS = (gl.GL_RGBA, gl.GL_RG, gl.GL_RED, gl.GL_ALPHA, gl.GL_LUMINANCE, gl.GL_LUMINANCE_ALPHA)  # drawn to
RGBA_FLOATS = Format(gl.GL_RGBA, "float", np.float32, 4)
LUMINANCES = {gl.GL_LUMINANCE: "R001", gl.GL_INTENSITY: "R001", gl.GL_LUMINANCE_ALPHA: "R00A"}


def compressed_pixels(image: Image, pixel_format: int, type: int) -> np.ndarray:
    """Return the colours of a compressed image as client pixels (h, w, components), or (h, w, 1) of a packed type."""
    kind, compressed = client_kind(type), COMPRESSED[image.internal_format]
    is_small = isinstance(kind, PackedColor) and kind.small_floats is None and max(n for _, n in kind.fields) <= 8
    if compressed.decode_to_read is not None:
        assert image.blocks is not None
        floats = read_back(image.blocks, compressed, image.width, image.height)
        cells, stored = (to_unorm8(floats), bytes_of(image.format)) if is_small else (floats, floats_of(image.format))
        return pack_color(cells, stored, pixel_format, kind)
    cells, stored = image.view, image.format
    if stored.encoding == "srgb":
        cells, stored = codes_of(cells, stored).astype(np.uint8), bytes_of(stored)
        if stored.base == gl.GL_RGB:
            cells[..., 3] = 255
    rgba = swizzled(color_as_float(cells), LUMINANCES.get(stored.base, "RGBA"), 1)
    if kind in OF_32_BITS:
        return pack_color(rgba, RGBA_FLOATS, pixel_format, kind)
    if kind == np.float16:
        return pack_color(as_halves(rgba, pixel_format in HALF_FLOATS), RGBA_FLOATS, pixel_format, kind)
    if isinstance(kind, PackedColor) and kind.small_floats is None:
        drawn = _format_of(pixel_format, kind)
        return decoded(drawn_cells(rgba, drawn), drawn, pixel_format, kind)
    return pack_color(cells, stored, pixel_format, kind)


def floats_of(stored: Format) -> Format:
    """Return the format of floats with the same channels."""
    return Format(stored.base, "float", np.float32, 4)


def _format_of(pixel_format: int, kind: PackedColor) -> Format:
    """Return the format with the bits of packed pixels."""
    bits = dict(zip(COMPONENTS[pixel_format], (n_bits for _, n_bits in kind.fields), strict=True))
    in_order = tuple(bits.get(name, 0) for name in "RGBA")
    base = gl.GL_RGBA if bits.get("A") else gl.GL_RGB
    if max(in_order) < 8:
        return Format(base, "unorm8", np.uint8, 4, 255, "unorm", in_order)
    return Format(base, "float", np.float32, 4, 0, "unorm", in_order)
