"""The GL namespace of programs on Mesa: PyOpenGL's names with the array conventions of `softshadow.gl`.

Only this module imports PyOpenGL. Import it only in a Mesa worker: PyOpenGL selects its platform when it is imported.
Differences from plain PyOpenGL:

- glReadPixels and glGetTexImage return (h, w) or (h, w, channels), first row = bottom row, without row padding, and
  support packed depth and stencil. Uploaded images are read without row padding if they are too small for the padding
  of GL_UNPACK_ALIGNMENT.
- glGen* return a plain int for one name.
- A GL error is raised as GL.GLError, and glGetError still returns its code afterwards, as in `softshadow.gl`.
- `program(name)` compiles the GLSL source of a softshadow program and returns a name for glUseProgram.
"""

import ctypes
import importlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import Any

import numpy as np
import OpenGL
from OpenGL import GL, GLU, contextdata, images, platform
from OpenGL.raw.GL._glgets import _glget_size_mapping as sizes_of_answers
from OpenGL.raw.GL.VERSION import GL_1_0 as raw
from OpenGL.raw.GL.VERSION import GL_1_1 as arrays
from OpenGL.raw.GL.VERSION import GL_1_3 as compressed
from OpenGL.raw.GL.VERSION import GL_1_5 as buffers

from softshadow.mapped_memory import MappedMemory
from softshadow.packed_colors import PACKED_COLORS
from softshadow.pixel_store import PACKED_TYPES, PixelStore
from softshadow.tokens import GL_ABGR_EXT

# missing in PyOpenGL 3.1's image tables; one 32-bit word per pixel, or two
images.TYPE_TO_ARRAYTYPE[GL.GL_UNSIGNED_INT_24_8] = GL.GL_UNSIGNED_INT
for _words in (GL.GL_UNSIGNED_INT_5_9_9_9_REV, GL.GL_UNSIGNED_INT_10F_11F_11F_REV):
    images.TYPE_TO_ARRAYTYPE[_words] = GL.GL_UNSIGNED_INT
    images.TIGHT_PACK_FORMATS[_words] = 3
images.TYPE_TO_ARRAYTYPE[GL.GL_FLOAT_32_UNSIGNED_INT_24_8_REV] = GL.GL_UNSIGNED_BYTE  # passed as bytes
for _color in (GL.GL_CURRENT_SECONDARY_COLOR, GL.GL_CURRENT_RASTER_SECONDARY_COLOR):
    sizes_of_answers[_color] = (4,)  # PyOpenGL has room for one number, so that GL would write behind it


def _context_key(context: Any = None) -> Any:
    """Return what PyOpenGL keeps arrays under: the address of the context, not the pointer that OSMesa returns anew."""
    return ctypes.cast(context or platform.GetCurrentContext(), ctypes.c_void_p).value


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
CHECKED = OpenGL.ERROR_CHECKING  # else calls are PyOpenGL's own, as fast as they can be
STIPPLE_BYTES = 128
LARGEST_PIXEL = 16  # bytes; enough for a read-out whose format or type GL will reject

# PyOpenGL defines names with a suffix in a module for each extension
EXTENSIONS = (
    "ARB.multitexture", "ARB.occlusion_query", "ARB.draw_buffers", "ARB.texture_cube_map", "ARB.texture_border_clamp",
    "ARB.texture_mirrored_repeat", "ARB.texture_env_combine", "ARB.texture_env_dot3", "ARB.depth_texture",
    "ARB.shadow", "ARB.texture_float", "ARB.transpose_matrix", "ARB.multisample", "ARB.vertex_buffer_object",
    "EXT.framebuffer_object", "EXT.framebuffer_blit", "EXT.packed_depth_stencil", "EXT.stencil_two_side",
    "EXT.stencil_wrap", "EXT.blend_color", "EXT.blend_minmax", "EXT.blend_subtract", "EXT.blend_func_separate",
    "EXT.blend_equation_separate", "EXT.bgra", "EXT.texture", "EXT.texture_object", "EXT.copy_texture",
    "EXT.subtexture", "EXT.texture_cube_map", "EXT.texture_lod_bias", "EXT.texture_env_combine", "EXT.vertex_array",
    "EXT.separate_specular_color", "EXT.rescale_normal", "EXT.draw_range_elements", "EXT.multi_draw_arrays",
    "NV.depth_clamp", "ATI.separate_stencil", "ATI.draw_buffers", "SGIS.texture_edge_clamp", "SGIS.generate_mipmap",
    "SGIS.texture_border_clamp", "SGIS.texture_lod", "SGIX.depth_texture", "IBM.texture_mirrored_repeat",
    "NV.conditional_render", "ARB.texture_rectangle", "NV.texture_rectangle", "EXT.texture3D",
    "EXT.texture_filter_anisotropic", "EXT.abgr", "ARB.point_parameters", "EXT.point_parameters", "ARB.point_sprite",
    "ARB.window_pos", "ARB.pixel_buffer_object", "EXT.pixel_buffer_object", "ARB.half_float_pixel",
    "ARB.shader_objects", "ARB.vertex_shader", "ARB.vertex_program", "EXT.secondary_color", "EXT.fog_coord",
    "EXT.texture_compression_rgtc",
    "ARB.fragment_shader", "ARB.texture_compression", "EXT.packed_pixels", "EXT.provoking_vertex", "NV.point_sprite",
    "NV.texgen_reflection", "NV.half_float", "NV.packed_depth_stencil", "EXT.texture_sRGB",
    "ARB.vertex_program", "EXT.secondary_color", "EXT.fog_coord",
    "EXT.texture_compression_s3tc", "EXT.texture_compression_latc", "EXT.texture_shared_exponent", "EXT.packed_float",
)  # fmt: skip

_current: "MesaGL | None" = None


def current() -> "MesaGL":
    """Return the namespace of the current context; RuntimeError if there is none."""
    if _current is None:
        raise RuntimeError("no Mesa context is current")
    return _current


class MesaGL:
    """All functions and tokens of GL and GLU, for one context.

    Parameters
    ----------
    raise_errors : bool          False: a GL error is only recorded, as in plain GL

    Attributes
    ----------
    errors : list of (name of the call, GL error code), in order
    """

    def __init__(self, raise_errors: bool = True) -> None:
        self.errors: list[tuple[str, int]] = []
        self._raise_errors = raise_errors
        self._pending = GL.GL_NO_ERROR
        self._programs: dict[str, int] = {}

    def make_current(self) -> None:
        """Make this the namespace that `current` returns; its context must be current already."""
        global _current
        _current = self

    def __getattr__(self, name: str) -> Any:
        value = OWN.get(name) if CHECKED else None
        if value is None:
            module = GLU if name.startswith(("glu", "GLU_")) else GL
            value = getattr(module, name, None)
        if value is None:
            value = _of_extension(name)
        if value is None:
            raise AttributeError(f"OpenGL has no {name}")
        if CHECKED and callable(value) and name.startswith("gl"):
            value = self._recorded(name, value)
        setattr(self, name, value)  # later accesses do not call __getattr__
        return value

    def _recorded(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any, **named: Any) -> Any:
            try:
                return function(*arguments, **named)
            except GL.GLError as error:
                self.errors.append((name, int(error.err)))
                self._pending = self._pending or int(error.err)
                if self._raise_errors:
                    raise
                return None

        return call

    def glGetError(self) -> int:
        """Return the first error code since the last call, including errors that PyOpenGL has raised."""
        code, self._pending = self._pending or int(GL.glGetError()), GL.GL_NO_ERROR
        return code

    def describe_primitives(self, part: str, *details: Any) -> None:
        """Do nothing: descriptions of primitives are for pixel histories, and change no pixel."""

    def program(self, name: str) -> int:
        """Return a GL program compiled from the GLSL of the softshadow program `name`, once per context."""
        if name not in self._programs:
            from softshadow import programs  # loads kernels that most GL programs do not need

            program = programs.get(name)
            self._programs[name] = link_program(name, program.glsl_vertex, program.glsl_fragment)
        return self._programs[name]


def _of_extension(name: str) -> Any:
    """Return a name from one of the extensions that `softshadow.gl` supports, or None."""
    for extension in EXTENSIONS:
        value = getattr(importlib.import_module(f"OpenGL.GL.{extension}"), name, None)
        if value is not None:
            return value
    return None


def link_program(name: str, vertex_source: str, fragment_source: str) -> int:
    """Return a linked GL program; ValueError with the compiler's log if a source does not compile."""
    program = GL.glCreateProgram()
    for kind, label, source in (
        (GL.GL_VERTEX_SHADER, "vertex", vertex_source),
        (GL.GL_FRAGMENT_SHADER, "fragment", fragment_source),
    ):
        shader = GL.glCreateShader(kind)
        GL.glShaderSource(shader, source)
        GL.glCompileShader(shader)
        if not GL.glGetShaderiv(shader, GL.GL_COMPILE_STATUS):
            raise ValueError(f"program {name!r}, {label} shader:\n{_text(GL.glGetShaderInfoLog(shader))}")
        GL.glAttachShader(program, shader)
    GL.glLinkProgram(program)
    if not GL.glGetProgramiv(program, GL.GL_LINK_STATUS):
        raise ValueError(f"program {name!r} does not link:\n{_text(GL.glGetProgramInfoLog(program))}")
    return int(program)


def _text(log: bytes | str) -> str:
    return log.decode(errors="replace") if isinstance(log, bytes) else log


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
    if _bound(GL.GL_PIXEL_PACK_BUFFER_BINDING):
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
    if _bound(GL.GL_PIXEL_PACK_BUFFER_BINDING):
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
    if _bound(GL.GL_PIXEL_PACK_BUFFER_BINDING):
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
            if not _bound(GL.GL_PIXEL_UNPACK_BUFFER_BINDING) and not _has_padding(
                arguments[size_at : size_at + dimensions], *arguments[-3:]
            ):
                GL.glPixelStorei(GL.GL_UNPACK_ALIGNMENT, 1)
            image = arguments[-1]
            if _bound(GL.GL_PIXEL_UNPACK_BUFFER_BINDING):
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


def _with_plain_names(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a glGen* function that returns an int for one name, an array for several."""

    def generate(n: int) -> Any:
        names = np.atleast_1d(function(n))
        return int(names[0]) if n == 1 else names

    return generate


def _with_unknown_names(function: Callable[..., Any], ctype: Any) -> Callable[..., Any]:
    """Return a glGet* function that passes names unknown to PyOpenGL on to GL, which rejects them."""
    raw_function = getattr(raw, function.__name__, None) or function

    def get(name: int) -> Any:
        try:
            return function(name)
        except KeyError:
            return raw_function(name, (ctype * LARGEST_PIXEL)())

    return get


def _under_one_key(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a call that finds what an earlier one has stored for its context, such as the array of glSelectBuffer.

    For other calls a key that is new each time is right: a vertex array must stay in memory though the call for another
    texture unit gives one of the same name.
    """

    @wraps(function)
    def call(*arguments: Any) -> Any:
        before = contextdata.getContext
        contextdata.getContext = _context_key
        try:
            return function(*arguments)
        finally:
            contextdata.getContext = before

    return call


def _bound(target: int) -> bool:
    return bool(GL.glGetIntegerv(target))


def _mapped(address: Any, n_bytes: int) -> MappedMemory | None:
    """Return mapped bytes at an address as `softshadow.gl` does."""
    if not address:
        return None
    return MappedMemory.of(np.ctypeslib.as_array((ctypes.c_uint8 * n_bytes).from_address(int(address))))


def glMapBuffer(target: int, access: int) -> MappedMemory | None:
    """Return all bytes of a buffer object."""
    address = GL.glMapBuffer(target, access)
    return _mapped(address, glGetBufferParameteriv(target, GL.GL_BUFFER_SIZE))


def glMapBufferRange(target: int, offset: int, length: int, access: int) -> MappedMemory | None:
    """Return a range of bytes of a buffer object."""
    return _mapped(GL.glMapBufferRange(target, offset, length, access), length)


def glGetBufferSubData(target: int, offset: int, size: int) -> np.ndarray:
    """Return bytes of a buffer object."""
    out = np.zeros(size, np.uint8)
    buffers.glGetBufferSubData(target, offset, size, ctypes.c_void_p(out.ctypes.data))
    return out


def glGetBufferParameteriv(target: int, pname: int) -> int:
    """Return a property of a buffer object."""
    out = (ctypes.c_int * 2)()
    buffers.glGetBufferParameteriv(target, pname, out)
    return int(out[0])


def glEdgeFlagPointer(stride: int, pointer: Any) -> None:
    """Set the array of edge flags from bytes; PyOpenGL 3.1 would make 16-bit numbers of them."""
    if isinstance(pointer, np.ndarray | list | tuple | bytes):
        flags = np.frombuffer(pointer, np.uint8) if isinstance(pointer, bytes) else np.asarray(pointer, np.uint8)
        _kept_flags[:] = [np.ascontiguousarray(flags)]  # GL reads them at the next draw
        pointer = ctypes.c_void_p(_kept_flags[0].ctypes.data)
    arrays.glEdgeFlagPointer(stride, pointer)


_kept_flags: list[np.ndarray] = []
_kept_arrays: dict[str, np.ndarray] = {}


def _keeping(name: str) -> Callable[..., None]:
    """Return a pointer call that keeps its array in memory until the next one; PyOpenGL 3.1 forgets it."""
    point = getattr(GL, name)

    def call(*arguments: Any) -> None:
        *layout, pointer = arguments
        if isinstance(pointer, np.ndarray | list | tuple):
            _kept_arrays[name] = np.ascontiguousarray(pointer, {**DTYPES, GL.GL_DOUBLE: np.float64}.get(layout[-2]))
            pointer = ctypes.c_void_p(_kept_arrays[name].ctypes.data)
        point(*layout, pointer)

    return call


def glMultiDrawElements(mode: int, count: Any, type: int, indices: Any, drawcount: int) -> None:
    """Draw from several arrays of indices; PyOpenGL takes their addresses only."""
    kept = [
        np.ascontiguousarray(place, DTYPES.get(type)) if isinstance(place, np.ndarray | list) else place
        for place in indices
    ]
    places = [place.ctypes.data if isinstance(place, np.ndarray) else place for place in kept]
    GL.glMultiDrawElements(
        mode, np.asarray(count, np.int32), type, (ctypes.c_void_p * max(len(places), 1))(*places), drawcount
    )


OWN: dict[str, Callable[..., Any]] = {
    "glEdgeFlagPointer": glEdgeFlagPointer,
    **{name: _keeping(name) for name in ("glSecondaryColorPointer", "glFogCoordPointer")},
    "glMultiDrawElements": glMultiDrawElements,
    **{name: _under_one_key(getattr(GL, name)) for name in ("glRenderMode", "glSelectBuffer", "glFeedbackBuffer")},
    "glGetPolygonStipple": glGetPolygonStipple,
    "glGetPolygonStippleub": glGetPolygonStipple,
    "glReadPixels": glReadPixels,
    "glMapBuffer": glMapBuffer,
    "glMapBufferRange": glMapBufferRange,
    "glGetBufferSubData": glGetBufferSubData,
    "glGetBufferParameteriv": glGetBufferParameteriv,
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
    **{
        name: _with_plain_names(getattr(GL, name))
        for name in ("glGenTextures", "glGenFramebuffers", "glGenRenderbuffers", "glGenBuffers", "glGenQueries")
    },
    **{
        name: _with_unknown_names(getattr(GL, name), ctype)
        for name, ctype in (
            ("glGetBooleanv", ctypes.c_ubyte),
            ("glGetIntegerv", ctypes.c_int),
            ("glGetFloatv", ctypes.c_float),
            ("glGetDoublev", ctypes.c_double),
        )
    },
}
