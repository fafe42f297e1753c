"""Client memory: how glPixelStore lays out the rows of an image in an array."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.packed_colors import PACKED_COLORS

TYPES: dict[int, type[np.generic]] = {
    gl.GL_UNSIGNED_BYTE: np.uint8,
    gl.GL_BYTE: np.int8,
    gl.GL_UNSIGNED_SHORT: np.uint16,
    gl.GL_SHORT: np.int16,
    gl.GL_UNSIGNED_INT: np.uint32,
    gl.GL_INT: np.int32,
    gl.GL_HALF_FLOAT: np.float16,
    gl.GL_FLOAT: np.float32,
}
# types with a whole pixel per element; GL_FLOAT_32_UNSIGNED_INT_24_8_REV uses 8 bits of the word beside z
PACKED_TYPES: dict[int, np.dtype] = {
    gl.GL_UNSIGNED_INT_24_8: np.dtype(np.uint32),
    gl.GL_FLOAT_32_UNSIGNED_INT_24_8_REV: np.dtype([("depth", np.float32), ("stencil", np.uint32)]),
}
COMPONENTS: dict[int, str] = {
    gl.GL_RED: "R",
    gl.GL_GREEN: "G",
    gl.GL_BLUE: "B",
    gl.GL_ALPHA: "A",
    gl.GL_RG: "RG",
    gl.GL_RGB: "RGB",
    gl.GL_BGR: "BGR",
    gl.GL_RGBA: "RGBA",
    gl.GL_BGRA: "BGRA",
    gl.GL_ABGR_EXT: "ABGR",
    gl.GL_LUMINANCE: "L",
    gl.GL_LUMINANCE_ALPHA: "LA",
    gl.GL_DEPTH_COMPONENT: "Z",
    gl.GL_STENCIL_INDEX: "S",
    gl.GL_COLOR_INDEX: "I",
    gl.GL_DEPTH_STENCIL: "D",
}


def dtype_of(type: int) -> np.dtype:
    """Return the dtype of array elements for a client type, packed or not."""
    if type in PACKED_COLORS:
        return PACKED_COLORS[type].dtype
    return PACKED_TYPES[type] if type in PACKED_TYPES else np.dtype(TYPES[type])


def elements_of(format: int, type: int) -> int:
    """Return the number of array elements of a pixel: one per component, or one of a packed type."""
    return 1 if type in PACKED_COLORS else len(COMPONENTS[format])


@dataclass(frozen=True)
class PixelStore:
    """The state of glPixelStore for one direction (pack or unpack); defaults are GL's initial values.

    `buffer` is the name of the pixel buffer object that images are in, 0 for the client's memory. `image_height` and
    `skip_images` concern three-dimensional images only.
    """

    alignment: int = 4
    row_length: int = 0
    skip_rows: int = 0
    skip_pixels: int = 0
    buffer: int = 0
    swap_bytes: bool = False
    lsb_first: bool = False
    image_height: int = 0
    skip_images: int = 0

    def layout(self, width: int, height: int, pixel: int, aligned: bool, slices: int = 0) -> tuple[int, int, int, int]:
        """Return (first byte, bytes from row to row, from slice to slice, total bytes) of an image.

        `pixel` is the number of bytes per pixel; an image that is not three-dimensional has 0 slices.
        """
        step = (self.row_length or width) * pixel
        if aligned:
            step = -(-step // self.alignment) * self.alignment
        first, slice_step = self.skip_rows * step + self.skip_pixels * pixel, (self.image_height or height) * step
        if slices:
            first += self.skip_images * slice_step
        end = first + (max(slices, 1) - 1) * slice_step + (height - 1) * step + width * pixel
        return first, step, slice_step, end if width and height else 0


def image_view(
    memory: np.ndarray,
    store: PixelStore,
    width: int,
    height: int,
    format: int,
    type: int,
    operation: str,
    slices: int = 0,
) -> np.ndarray:
    """Return a view (height, width, components) of an image in client memory; its dtype may have swapped bytes.

    With 1 slice or more, the image is three-dimensional: (slices, height, width, components).

    Rows have GL's alignment if the memory is large enough for it. Otherwise they are contiguous: PyOpenGL's users pass
    arrays and leave the alignment at 4.

    Raises
    ------
    ValueError
        The memory is too small; the message gives the size needed.
    """
    dtype, components = dtype_of(type), elements_of(format, type)
    shape: tuple[int, ...] = (height, width, components)
    pixel = dtype.itemsize * components
    raw = memory.reshape(-1).view(np.uint8)
    first, step, slice_step, needed = store.layout(width, height, pixel, aligned=True, slices=slices)
    if raw.nbytes < needed:
        first, step, slice_step, needed = store.layout(width, height, pixel, aligned=False, slices=slices)
    if raw.nbytes < needed:
        sides = f"{width} x {height} x {slices}" if slices else f"{width} x {height}"
        raise ValueError(
            f"{operation}: the image has {raw.nbytes} bytes; {sides} pixels of {components} {dtype} need {needed}"
        )
    if store.swap_bytes:
        dtype = dtype.newbyteorder()
    strides: tuple[int, ...] = (step, pixel, dtype.itemsize)
    if slices:
        shape, strides = (slices, *shape), (slice_step, *strides)
    return np.ndarray(shape, dtype, raw, first, strides) if needed else np.empty(shape, dtype)


def stacked(image: np.ndarray) -> np.ndarray:
    """Return an image (height, width, components); the slices of a three-dimensional one lie one above the other."""
    return image.reshape(image.shape[0] * image.shape[1], *image.shape[2:]) if image.ndim == 4 else image


def client_image(
    pixels: Any,
    store: PixelStore,
    width: int,
    height: int,
    format: int,
    type: int,
    operation: str,
    slices: int = 0,
) -> np.ndarray:
    """Return a user's image as (height, width, components) with the dtype of `type`; slices one above the other.

    Arrays and lists of another dtype are converted, as in PyOpenGL, but floats are not truncated to integers.

    Raises
    ------
    TypeError, ValueError
        The pixels are not numbers of this type, or too few.
    """
    dtype = dtype_of(type)
    if isinstance(pixels, bytes | bytearray | memoryview):
        memory = np.frombuffer(pixels, np.uint8)
    else:
        image = np.asarray(pixels)
        if dtype.names and image.dtype != dtype:
            raise TypeError(f"{operation}: pixels are {image.dtype}; type={gl.token_name(type)} takes {dtype} or bytes")
        if not dtype.names and (image.dtype.kind not in "biuf" or (image.dtype.kind == "f" and dtype.kind != "f")):
            raise TypeError(
                f"{operation}: pixels are {image.dtype}; type={gl.token_name(type)} takes {dtype} numbers or bytes"
            )
        memory = np.ascontiguousarray(image, dtype)
    view = image_view(memory, store, width, height, format, type, operation, slices)
    return stacked(view.astype(dtype, copy=False))


def bitmap_rows(bitmap: Any, store: PixelStore, width: int, height: int, operation: str) -> np.ndarray:
    """Return the bits (height, width) of a bitmap in client memory, first row = bottom row; the highest bit is left.

    With GL_UNPACK_LSB_FIRST, the lowest bit is left.

    Raises
    ------
    ValueError
        The memory is too small; the message gives the size needed.
    """
    if isinstance(bitmap, bytes | bytearray | memoryview):
        raw = np.frombuffer(bitmap, np.uint8)
    else:
        raw = np.ascontiguousarray(bitmap, None if isinstance(bitmap, np.ndarray) else np.uint8).reshape(-1)
        raw = raw.view(np.uint8)
    step = -(-(store.row_length or width) // (8 * store.alignment)) * store.alignment
    needed = (store.skip_rows + height - 1) * step + -(-(store.skip_pixels + width) // 8)
    if raw.nbytes < needed:
        raise ValueError(f"{operation}: the bitmap has {raw.nbytes} bytes; {width} x {height} bits need {needed}")
    first = store.skip_rows * step
    rows = np.zeros((height, max(step, -(-(store.skip_pixels + width) // 8))), np.uint8)
    for row in range(height):
        part = raw[first + row * step : first + row * step + rows.shape[1]]
        rows[row, : len(part)] = part
    order: Any = "little" if store.lsb_first else "big"
    bits: np.ndarray = np.unpackbits(rows, axis=1, bitorder=order)[
        :, store.skip_pixels : store.skip_pixels + width
    ].astype(bool)
    return bits


def output_array(
    array: Any,
    store: PixelStore,
    width: int,
    height: int,
    format: int,
    type: int,
    operation: str,
    slices: int = 0,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the array that a read-out returns, and a view (h, w, components) of the image in it, to be written.

    It is the user's `array`; without one, a new array of zeros, (h, w) or (h, w, components). If the image has slices,
    array and view have one more dimension, the first.

    Raises
    ------
    TypeError, ValueError
        The user's array is not writeable, has another dtype, or is too small.
    """
    dtype = dtype_of(type)
    if array is None:
        components = elements_of(format, type)
        shape = (slices, height, width) if slices else (height, width)
        zeros = np.zeros(shape if components == 1 else (*shape, components), dtype)
        view = zeros.reshape(*shape, components)
        return zeros, view.view(dtype.newbyteorder()) if store.swap_bytes else view
    if not isinstance(array, np.ndarray) or array.dtype not in (dtype, np.dtype(np.uint8)):
        received = array.dtype if isinstance(array, np.ndarray) else repr(array)
        raise TypeError(f"{operation}: expected an array of {dtype}, got {received!s:.80}")
    if not array.flags.c_contiguous or not array.flags.writeable:
        raise ValueError(f"{operation}: the array must be C-contiguous and writeable")
    return array, image_view(array, store, width, height, format, type, operation, slices)
