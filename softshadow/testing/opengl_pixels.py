"""Images between a program and Mesa, with the array conventions of `softshadow.gl`; PyOpenGL's have others."""

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from OpenGL import GL, images
from OpenGL.raw.GL.VERSION import GL_1_0 as raw
from OpenGL.raw.GL.VERSION import GL_1_3 as compressed

from softshadow.packed_colors import PACKED_COLORS
from softshadow.pixel_store import PACKED_TYPES, PixelStore
from softshadow.tokens import GL_ABGR_EXT

# missing in PyOpenGL 3.1's image tables; one 32-bit word per pixel, or two
images.TYPE_TO_ARRAYTYPE[GL.GL_UNSIGNED_INT_24_8] = GL.GL_UNSIGNED_INT
for _words in (GL.GL_UNSIGNED_INT_5_9_9_9_REV, GL.GL_UNSIGNED_INT_10F_11F_11F_REV):
    images.TYPE_TO_ARRAYTYPE[_words] = GL.GL_UNSIGNED_INT
    images.TIGHT_PACK_FORMATS[_words] = 3
images.TYPE_TO_ARRAYTYPE[GL.GL_FLOAT_32_UNSIGNED_INT_24_8_REV] = GL.GL_UNSIGNED_BYTE  # passed as bytes

CHANNELS = {
    **dict.fromkeys((GL.GL_RED, GL.GL_GREEN, GL.GL_BLUE, GL.GL_ALPHA, GL.GL_LUMINANCE), 1),
    **dict.fromkeys((GL.GL_DEPTH_COMPONENT, GL.GL_STENCIL_INDEX, GL.GL_DEPTH_STENCIL), 1),
    **dict.fromkeys((GL.GL_LUMINANCE_ALPHA, GL.GL_RG), 2),
    **dict.fromkeys((GL.GL_RGB, GL.GL_BGR), 3),
    **dict.fromkeys((GL.GL_RGBA, GL.GL_BGRA, GL_ABGR_EXT), 4),
}
DTYPES: dict[int, Any] = {
    GL.GL_UNSIGNED_BYTE: np.uint8,
    GL.GL_BYTE: np.int8,
    GL.GL_UNSIGNED_SHORT: np.uint16,
    GL.GL_SHORT: np.int16,
    GL.GL_UNSIGNED_INT: np.uint32,
    GL.GL_INT: np.int32,
    GL.GL_HALF_FLOAT: np.float16,
    GL.GL_FLOAT: np.float32,
    **PACKED_TYPES,
    **{kind: packed.dtype for kind, packed in PACKED_COLORS.items()},
}
STIPPLE_BYTES = 128
LARGEST_PIXEL = 16  # bytes; enough for a read-out whose format or type GL will reject


def is_bound(target: int) -> bool:
    """Return whether a buffer object is bound, by the name that asks for it."""
    return bool(GL.glGetIntegerv(target))


def _elements(pixel_format: int, pixel_type: int) -> tuple[int | None, Any]:
    """Return how many numbers a pixel has, and their dtype; None for what is not known."""
    channels = CHANNELS.get(pixel_format)
    return channels if pixel_type not in PACKED_COLORS or channels is None else 1, DTYPES.get(pixel_type)


def _image(width: int, height: int, pixel_format: int, pixel_type: int) -> np.ndarray:
    """Return an image for a read-out; large enough for any pixel if GL will reject the format and type."""
    channels, dtype = _elements(pixel_format, pixel_type)
    if channels is None or dtype is None:
        return np.zeros(max(0, width) * max(0, height) * LARGEST_PIXEL, np.uint8)
    shape = (max(0, height), max(0, width))
    return np.zeros(shape if channels == 1 else (*shape, channels), dtype)


def _checked(array: np.ndarray, expected: np.ndarray, call: str) -> np.ndarray:
    if not isinstance(array, np.ndarray) or array.dtype != expected.dtype or array.size != expected.size:
        raise ValueError(f"{call}: array must be {expected.dtype} with shape {expected.shape}, got {array!r:.80}")
    if not array.flags.c_contiguous or not array.flags.writeable:
        raise ValueError(f"{call}: array must be C-contiguous and writeable")
    return array


@contextmanager
def _restored_alignment() -> Iterator[None]:
    """Restore the alignments after a transfer; PyOpenGL's upload functions also change the pack alignment."""
    before = [(name, int(GL.glGetIntegerv(name))) for name in (GL.GL_PACK_ALIGNMENT, GL.GL_UNPACK_ALIGNMENT)]
    try:
        yield
    finally:
        for name, value in before:
            GL.glPixelStorei(name, value)


def glReadPixels(
    x: int, y: int, width: int, height: int, format: int, type: int, array: Any = None
) -> np.ndarray | None:
    """Return the pixels of a rectangle of the read buffer, first row = bottom row, or fill `array` with them."""
    if is_bound(GL.GL_PIXEL_PACK_BUFFER_BINDING):
        raw.glReadPixels(x, y, width, height, format, type, ctypes.c_void_p(array or 0))
        return None
    expected = _image(width, height, format, type)
    out = expected if array is None else _checked(array, expected, "glReadPixels")
    with _restored_alignment():
        GL.glPixelStorei(GL.GL_PACK_ALIGNMENT, 1)
        raw.glReadPixels(x, y, width, height, format, type, ctypes.c_void_p(out.ctypes.data))
    return out


def glGetTexImage(target: int, level: int, format: int, type: int, array: Any = None) -> np.ndarray | None:
    """Return a texture's level, first row = the row of t = 0, or fill `array` with it."""
    if is_bound(GL.GL_PIXEL_PACK_BUFFER_BINDING):
        raw.glGetTexImage(target, level, format, type, ctypes.c_void_p(array or 0))
        return None
    width = GL.glGetTexLevelParameteriv(target, level, GL.GL_TEXTURE_WIDTH)
    height = GL.glGetTexLevelParameteriv(target, level, GL.GL_TEXTURE_HEIGHT)
    expected = _image(int(width), int(height), format, type)
    if target == GL.GL_TEXTURE_3D:
        depth = int(GL.glGetTexLevelParameteriv(target, level, GL.GL_TEXTURE_DEPTH))
        expected = np.zeros((depth, *expected.shape), expected.dtype)
    out = expected if array is None else _checked(array, expected, "glGetTexImage")
    with _restored_alignment():
        GL.glPixelStorei(GL.GL_PACK_ALIGNMENT, 1)
        raw.glGetTexImage(target, level, format, type, ctypes.c_void_p(out.ctypes.data))
    return out


def glGetPolygonStipple(mask: np.ndarray | None = None) -> np.ndarray:
    """Return the polygon stipple, 128 bytes, or fill `mask` with it; PyOpenGL's function fails."""
    out = np.zeros(STIPPLE_BYTES, np.uint8) if mask is None else mask
    raw.glGetPolygonStipple(out.ctypes.data_as(ctypes.POINTER(ctypes.c_ubyte)))
    return out


def _compressed_upload(name: str, image_at: int) -> Callable[..., Any]:
    """Return an upload of compressed images; the image is argument `image_at`, with or without its number of bytes."""
    raw_function = getattr(compressed, name)

    def upload(*arguments: Any) -> None:
        image = arguments[-1]
        n_bytes = arguments[image_at] if len(arguments) > image_at + 1 else np.asarray(image).nbytes
        kept = np.ascontiguousarray(image) if isinstance(image, np.ndarray) else None
        address = image if kept is None else ctypes.c_void_p(kept.ctypes.data)
        raw_function(*arguments[:image_at], n_bytes, address)

    return upload


def glGetCompressedTexImage(target: int, level: int, img: Any = None) -> np.ndarray | None:
    """Return the blocks of a texture's level; PyOpenGL's function fails."""
    if is_bound(GL.GL_PIXEL_PACK_BUFFER_BINDING):
        compressed.glGetCompressedTexImage(target, level, ctypes.c_void_p(img or 0))
        return None
    is_compressed = GL.glGetTexLevelParameteriv(target, level, GL.GL_TEXTURE_COMPRESSED)
    n_bytes = (
        int(GL.glGetTexLevelParameteriv(target, level, GL.GL_TEXTURE_COMPRESSED_IMAGE_SIZE)) if is_compressed else 0
    )
    out = np.zeros(max(n_bytes, 1), np.uint8)
    compressed.glGetCompressedTexImage(target, level, ctypes.c_void_p(out.ctypes.data))
    return out[:n_bytes]


def _without_row_padding(function: Callable[..., Any], size_at: int, dimensions: int = 2) -> Callable[..., Any]:
    """Return an upload function that reads images without row padding if they are too small to have it.

    `size_at` is the index of the width among the arguments; format, type and image are the last three.
    """

    def upload(*arguments: Any) -> Any:
        with _restored_alignment():
            if not is_bound(GL.GL_PIXEL_UNPACK_BUFFER_BINDING) and not _has_padding(
                arguments[size_at : size_at + dimensions], *arguments[-3:]
            ):
                GL.glPixelStorei(GL.GL_UNPACK_ALIGNMENT, 1)
            image = arguments[-1]
            if is_bound(GL.GL_PIXEL_UNPACK_BUFFER_BINDING):
                return function(*arguments[:-1], ctypes.c_void_p(image or 0))
            if isinstance(image, np.ndarray) and image.dtype.names:
                return function(*arguments[:-1], np.frombuffer(image.tobytes(), np.uint8))
            return function(*arguments)

    return upload


def _has_padding(shape: tuple[int, ...], pixel_format: int, pixel_type: int, image: Any) -> bool:
    """Return whether an image is large enough for rows padded to GL_UNPACK_ALIGNMENT."""
    channels, dtype = _elements(pixel_format, pixel_type)
    if channels is None or dtype is None or not isinstance(image, np.ndarray):
        return False
    names = ("ALIGNMENT", "ROW_LENGTH", "SKIP_ROWS", "SKIP_PIXELS", "IMAGE_HEIGHT", "SKIP_IMAGES")
    alignment, row_length, skip_rows, skip_pixels, image_height, skip_images = (
        int(GL.glGetIntegerv(getattr(GL, f"GL_UNPACK_{name}"))) for name in names
    )
    store = PixelStore(
        alignment, row_length, skip_rows, skip_pixels, image_height=image_height, skip_images=skip_images
    )
    slices = shape[2] if len(shape) > 2 else 0
    width, height = (*shape, 1)[:2]
    pixel = channels * np.dtype(dtype).itemsize
    needed = store.layout(width, height, pixel, aligned=True, slices=slices)[-1]
    return image.size * np.dtype(dtype).itemsize >= needed


PIXEL_CALLS: dict[str, Callable[..., Any]] = {
    "glGetPolygonStipple": glGetPolygonStipple,
    "glGetPolygonStippleub": glGetPolygonStipple,
    "glReadPixels": glReadPixels,
    "glGetTexImage": glGetTexImage,
    "glGetCompressedTexImage": glGetCompressedTexImage,
    **{f"glCompressedTexImage{n}D": _compressed_upload(f"glCompressedTexImage{n}D", 4 + n) for n in (1, 2, 3)},
    **{
        f"glCompressedTexSubImage{n}D": _compressed_upload(f"glCompressedTexSubImage{n}D", 3 + 2 * n) for n in (1, 2, 3)
    },
    "glTexImage1D": _without_row_padding(GL.glTexImage1D, size_at=3, dimensions=1),
    "glTexImage3D": _without_row_padding(GL.glTexImage3D, size_at=3, dimensions=3),
    "glTexSubImage1D": _without_row_padding(GL.glTexSubImage1D, size_at=3, dimensions=1),
    "glTexSubImage3D": _without_row_padding(GL.glTexSubImage3D, size_at=5, dimensions=3),
    "glTexImage2D": _without_row_padding(GL.glTexImage2D, size_at=3),
    "glTexSubImage2D": _without_row_padding(GL.glTexSubImage2D, size_at=4),
    "glDrawPixels": _without_row_padding(GL.glDrawPixels, size_at=0),
}
