"""Where images come from and go to: the client's memory, or a pixel buffer object.

References: GL 2.1, sec. 3.6.1, 4.3.2; pbo.c of Mesa 22.3.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.context import BufferObject, Context
from softshadow.gl.buffers import offset_of, own_content
from softshadow.gl.errors import fail
from softshadow.gl.pixel_formats import pixels_problem
from softshadow.pixel_store import (
    PixelStore,
    bitmap_rows,
    client_image,
    dtype_of,
    elements_of,
    image_view,
    output_array,
    stacked,
)


class UnpackedImage(NamedTuple):
    """An image (h, w, components) that a display list has read from memory when it was compiled; slices are stacked."""

    image: np.ndarray


def image_for_list(
    context: Context, pixels: Any, width: int, height: int, slices: int, format: int, type: int, operation: str
) -> Any:
    """Return pixels as they are; while a display list is compiled, what they are now, as an `UnpackedImage`."""
    is_none = pixels is None and not context.unpack_store.buffer
    if (
        context.compiled_list is None
        or is_none
        or pixels_problem(format, type)
        or min(width, height) <= 0
        or slices < 0
    ):
        return pixels
    image = image_source(context, pixels, int(width), int(height), int(slices), format, type, operation)
    return None if image is None else UnpackedImage(image.copy())


def image_source(
    context: Context, pixels: Any, width: int, height: int, slices: int, format: int, type: int, operation: str
) -> np.ndarray | None:
    """Return an image (h, w, components) of the client or of the bound buffer object; None after an error of GL.

    The slices of a three-dimensional image lie one above the other; any other image has 0 slices.
    """
    store = context.unpack_store
    if isinstance(pixels, UnpackedImage):
        return pixels.image
    if type == gl.GL_BITMAP:
        return _bits(context, pixels, width, height * max(slices, 1), format, operation)
    if not store.buffer:
        return client_image(pixels, store, width, height, format, type, operation, slices)
    dtype = dtype_of(type)
    needed = store.layout(width, height, dtype.itemsize * elements_of(format, type), aligned=True, slices=slices)[-1]
    memory = source(context, pixels, needed, _unit(dtype), operation)
    if memory is None:
        return None
    view = image_view(memory, store, width, height, format, type, operation, slices)
    return stacked(view.astype(dtype, copy=False))


def _bits(context: Context, bitmap: Any, width: int, height: int, format: int, operation: str) -> np.ndarray | None:
    """Return a bitmap as indices (h, w, 1) uint8, 0 and 1; None after an error of GL.

    Of colour indices Mesa reads one row directly after the other, without their padding.
    """
    store = context.unpack_store
    bytes_of_row = -(-(store.row_length or width) // (8 * store.alignment)) * store.alignment
    memory = source(context, bitmap, (store.skip_rows + height) * bytes_of_row, 1, operation)
    if memory is None:
        return None
    rows = bitmap_rows(memory, store, width, height, operation)
    if format == gl.GL_COLOR_INDEX:
        raw = np.frombuffer(memory, np.uint8) if isinstance(memory, bytes | bytearray) else np.asarray(memory, np.uint8)
        first = 8 * store.skip_rows * bytes_of_row + store.skip_pixels
        order: Any = "little" if store.lsb_first else "big"
        bits = np.unpackbits(raw.reshape(-1), bitorder=order)[first : first + width * height]
        rows = bits.reshape(height, width)
    return rows[..., np.newaxis].astype(np.uint8)


def image_destination(
    context: Context, array: Any, width: int, height: int, slices: int, format: int, type: int, operation: str
) -> tuple[Any, np.ndarray] | None:
    """Return (what a read-out returns, a view (h, w, components) of the image in it); None after an error of GL.

    The view of a three-dimensional image is (slices, h, w, components); any other image has 0 slices.
    """
    store = context.pack_store
    if not store.buffer:
        return output_array(array, store, width, height, format, type, operation, slices)
    dtype = dtype_of(type)
    needed = store.layout(width, height, dtype.itemsize * elements_of(format, type), aligned=True, slices=slices)[-1]
    bound = _accessed(context, store, array, needed, _unit(dtype), operation)
    if bound is None:
        return None
    content = own_content(context, bound)
    return None, image_view(content[offset_of(array) :], store, width, height, format, type, operation, slices)


def source(context: Context, values: Any, n_bytes: int, unit: int, operation: str) -> Any:
    """Return the client's values, or the bytes of the bound buffer object from an offset on; None after an error."""
    store = context.unpack_store
    if not store.buffer:
        return values
    bound = _accessed(context, store, values, n_bytes, unit, operation)
    return None if bound is None else bound.content[offset_of(values) :]


def destination(context: Context, values: Any, answer: np.ndarray, operation: str) -> Any:
    """Return an answer; an array of the client is filled, or the bound buffer object, which nothing is returned for."""
    store = context.pack_store
    if store.buffer:
        bound = _accessed(context, store, values, answer.nbytes, answer.itemsize, operation)
        if bound is not None:
            offset = offset_of(values)
            own_content(context, bound)[offset : offset + answer.nbytes] = answer.view(np.uint8)
        return None
    if values is not None:
        np.asarray(values).reshape(-1)[: len(answer)] = answer
    return answer


def _unit(dtype: np.dtype) -> int:
    """Return what offsets must be multiples of: the size of a number."""
    return 4 if dtype.names else dtype.itemsize


def _accessed(
    context: Context, store: PixelStore, pointer: Any, n_bytes: int, unit: int, operation: str
) -> BufferObject | None:
    """Return a pixel buffer object whose bytes from an offset on can be used, or None after an error of GL."""
    bound, offset = context.buffers[store.buffer], offset_of(pointer)
    problem = None
    if bound.mapping is not None:
        problem = f"buffer {store.buffer} is mapped: call glUnmapBuffer first"
    elif offset < 0 or offset + n_bytes > len(bound.content):
        problem = f"offset={offset}: buffer {store.buffer} has {len(bound.content)} bytes, {n_bytes} are needed there"
    elif offset % unit:
        problem = f"offset={offset}: expected a multiple of {unit}, the size of a number"
    if problem:
        fail(gl.GL_INVALID_OPERATION, operation, problem)
        return None
    return bound
