"""Colours in formats of other than 8 bits: the integers that Mesa stores, and what its sampler reads of them.

A code is the integer of a channel. Cells hold what the sampler reads: codes of up to 8 bits as bytes with their upper
bits repeated, codes of more bits as floats in [0, 1], half floats as floats, and sRGB decoded as floats. Decoding loses
nothing, so that glGetTexImage finds the codes again.

References: format_utils.h, format_utils.c and u_format_pack.py of Mesa 22.3; lp_bld_format_srgb.c for sRGB.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from softshadow.image import Format
from softshadow.packed_colors import with_more_bits

F32 = np.float32
LARGEST_HALF = F32(65504)


def resized(codes: np.ndarray, n_bits: int, wanted: int) -> np.ndarray:
    """Return integers of some bits with another number of bits, int64: rounded, or their upper bits are repeated.

    Examples
    --------
    >>> resized(np.array([0, 3, 255]), 8, 5).tolist(), resized(np.array([3, 31]), 5, 8).tolist()
    ([0, 0, 31], [24, 255])
    """
    codes = codes.astype(np.int64)
    if wanted >= n_bits:
        return with_more_bits(codes, n_bits, wanted)
    rounded: np.ndarray = (codes * ((1 << wanted) - 1) + (1 << (n_bits - 1)) - 1) // ((1 << n_bits) - 1)
    return rounded


def clamped(values: np.ndarray) -> np.ndarray:
    """Return floats clamped to [0, 1]; NaN becomes 0."""
    with np.errstate(invalid="ignore"):
        return np.where(values > 0, np.minimum(values, F32(1)), F32(0))


def rounded_up(values: np.ndarray, n_bits: int) -> np.ndarray:
    """Return the codes of floats, clamped to [0, 1]; halves are rounded up, after a sum in single precision."""
    scaled = clamped(values) * F32((1 << n_bits) - 1)
    return np.floor(scaled + F32(0.5)).astype(np.int64)


def rounded_to_even(values: np.ndarray, n_bits: int) -> np.ndarray:
    """Return the codes of floats, clamped to [0, 1]; halves are rounded to the even code."""
    return np.rint(clamped(values) * F32((1 << n_bits) - 1)).astype(np.int64)


def as_floats(codes: np.ndarray, n_bits: int) -> np.ndarray:
    """Return codes as float32 in [0, 1]: times the rounded step."""
    floats: np.ndarray = codes.astype(F32) * (F32(1) / F32((1 << n_bits) - 1))
    return floats


def as_halves(values: np.ndarray, truncated: bool) -> np.ndarray:
    """Return floats with the precision of half floats, float32: rounded to even, or truncated."""
    with np.errstate(all="ignore"):
        halves = values.astype(np.float16)
        if truncated:
            too_large = np.abs(halves.astype(F32)) > np.abs(values)
            halves = np.where(too_large, np.nextafter(halves, np.float16(0)), halves)
    return halves.astype(F32)


def srgb_table() -> np.ndarray:
    """Return the linear values (256,) float32 that llvmpipe decodes sRGB bytes to: a polynomial of third degree."""
    x = np.arange(256, dtype=F32)
    byte = F32(255)
    constant, linear = F32(0.0023), F32(0.0030) / byte
    square, cubic = F32(0.6935) / (byte * byte), F32(0.3012) / (byte * byte * byte)
    squared = x * x
    curve = (cubic * squared + linear) * x + (square * squared + constant)
    return np.where(x <= 15, x * (F32(1) / (F32(12.6) * byte)), curve)


SRGB = srgb_table()


def srgb_codes(linear: np.ndarray) -> np.ndarray:
    """Return linear values in [0, 1] as sRGB bytes, int64, by llvmpipe's approximation.

    llvmpipe takes the processor's approximate reciprocal square roots, so that a byte in a thousand differs by one.
    """
    byte, x = F32(255), clamped(linear)
    root = np.sqrt(x)
    power = np.sqrt(np.sqrt(root * x))  # x ** 0.375
    first, second = F32(float(F32(0.675)) * 1.0622 * 255), F32(float(F32(0.325)) * 1.0622 * 255)
    curve = first * power + (second * root + F32(-0.0620) * byte)
    return np.rint(np.where(x <= F32(0.0031308), x * (F32(12.92) * byte), curve)).astype(np.int64)


def codes_of(cells: np.ndarray, format: Format) -> np.ndarray:
    """Return the codes (..., 4) int64 of the cells of a format with codes; 0 for channels that it does not have."""
    codes = np.zeros(cells.shape, np.int64)
    for channel, n_bits in enumerate(format.bits):
        if n_bits == 0:
            continue
        values = cells[..., channel]
        if format.encoding == "srgb" and channel < 3:
            codes[..., channel] = np.searchsorted(SRGB, values).clip(0, 255)
        elif cells.dtype == np.uint8:
            codes[..., channel] = values >> (8 - n_bits)
        else:
            codes[..., channel] = rounded_to_even(values, n_bits)
    return codes


def cells_of(codes: np.ndarray, format: Format) -> np.ndarray:
    """Return the cells (..., 4) of codes; channels that the format does not have are 0, alpha is 1."""
    cells = np.zeros(codes.shape, format.dtype)
    cells[..., 3] = 255 if format.dtype == np.uint8 else 1
    for channel, n_bits in enumerate(format.bits):
        if n_bits == 0:
            continue
        values = codes[..., channel]
        if format.encoding == "srgb" and channel < 3:
            cells[..., channel] = SRGB[values]
        elif format.dtype == np.uint8:
            cells[..., channel] = resized(values, n_bits, 8)
        else:
            cells[..., channel] = as_floats(values, n_bits)
    return cells


def codes_of_bytes(rgba: np.ndarray, format: Format) -> np.ndarray:
    """Return bytes (..., 4) as codes."""
    return codes_of_integers(rgba, 8, format)


def codes_of_integers(rgba: np.ndarray, n_bits: int, format: Format) -> np.ndarray:
    """Return integers (..., 4) of some bits as codes."""
    return _each(rgba, format, lambda values, wanted: resized(values, n_bits, wanted))


def codes_of_floats(rgba: np.ndarray, format: Format, is_direct: bool) -> np.ndarray:
    """Return floats (..., 4) as codes.

    `is_direct`: they are single-precision RGBA, which Mesa packs at once. Others become bytes or 16-bit integers first,
    where the format fits.
    """
    if not is_direct and format.has_few_bits:
        return _each(rgba, format, lambda values, n_bits: resized(rounded_to_even(values, 8), 8, n_bits))
    is_array = not is_direct and format.is_array
    return _each(rgba, format, rounded_to_even if is_array else rounded_up)


def drawn_cells(rgba: np.ndarray, format: Format) -> np.ndarray:
    """Return floats (..., 4) as the cells that Mesa's copies and mipmaps make of them, which llvmpipe draws.

    It rounds to 8 or 16 bits first, and drops lower bits from these; sRGB is not encoded. Halves are truncated.
    """
    if not format.encoding:
        return rgba
    if format.encoding == "half":
        return as_halves(rgba, truncated=True)
    whole = 16 if max(format.bits) > 8 else 8

    def dropped(values: np.ndarray, n_bits: int) -> np.ndarray:
        codes, rest = rounded_to_even(values, whole), whole - n_bits
        if n_bits == 4 or rest == 0:
            return resized(codes, whole, n_bits)
        if rest <= n_bits or n_bits == 1:
            return codes >> rest
        return ((codes >> n_bits) * ((1 << n_bits) - 1) + (1 << (rest - 1))) >> rest

    return cells_of(_each(rgba, format, dropped), format)


def _each(rgba: np.ndarray, format: Format, convert: Callable[[np.ndarray, int], np.ndarray]) -> np.ndarray:
    codes = np.zeros(rgba.shape, np.int64)
    for channel, n_bits in enumerate(format.bits):
        if n_bits:
            codes[..., channel] = convert(rgba[..., channel], n_bits)
    return codes
