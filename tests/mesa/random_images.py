"""Random programs about images: internal formats, client formats and types, parts of images, copies, read-outs."""

from typing import Any

import numpy as np

from mesa.random_writer import Writer

INTERNAL_FORMATS = [
    "GL_RGBA", "GL_RGBA8", "GL_RGB", "GL_RGB8", "GL_LUMINANCE", "GL_LUMINANCE8", "GL_LUMINANCE_ALPHA",
    "GL_LUMINANCE8_ALPHA8", "GL_ALPHA", "GL_ALPHA8", "GL_INTENSITY", "GL_INTENSITY8", "GL_RED", "GL_R8", "GL_RG",
    "GL_RG8", "GL_RGBA32F", "GL_RGB32F", "GL_RG32F", "GL_R32F", 1, 2, 3, 4,
]  # fmt: skip
DEPTH_FORMATS = ["GL_DEPTH_COMPONENT", "GL_DEPTH_COMPONENT16", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT32F"]
PIXEL_FORMATS = {
    "GL_RED": 1, "GL_GREEN": 1, "GL_BLUE": 1, "GL_ALPHA": 1, "GL_RG": 2, "GL_RGB": 3, "GL_BGR": 3, "GL_RGBA": 4,
    "GL_BGRA": 4, "GL_ABGR_EXT": 4, "GL_LUMINANCE": 1, "GL_LUMINANCE_ALPHA": 2,
}  # fmt: skip
PIXEL_TYPES = {
    "GL_UNSIGNED_BYTE": np.uint8, "GL_BYTE": np.int8, "GL_UNSIGNED_SHORT": np.uint16, "GL_SHORT": np.int16,
    "GL_UNSIGNED_INT": np.uint32, "GL_INT": np.int32, "GL_FLOAT": np.float32,
}  # fmt: skip
OF_THREE, OF_FOUR, ALIKE = ("GL_RGB",), ("GL_RGBA", "GL_BGRA"), ("GL_RGBA", "GL_BGRA", "GL_ABGR_EXT")
PACKED_KINDS: dict[str, tuple[Any, tuple[str, ...]]] = {  # integers and formats
    "GL_UNSIGNED_BYTE_3_3_2": (np.uint8, OF_THREE), "GL_UNSIGNED_BYTE_2_3_3_REV": (np.uint8, OF_THREE),
    "GL_UNSIGNED_SHORT_5_6_5": (np.uint16, OF_THREE), "GL_UNSIGNED_SHORT_5_6_5_REV": (np.uint16, OF_THREE),
    "GL_UNSIGNED_SHORT_4_4_4_4": (np.uint16, ALIKE), "GL_UNSIGNED_SHORT_4_4_4_4_REV": (np.uint16, ALIKE),
    "GL_UNSIGNED_SHORT_5_5_5_1": (np.uint16, OF_FOUR), "GL_UNSIGNED_SHORT_1_5_5_5_REV": (np.uint16, OF_FOUR),
    "GL_UNSIGNED_INT_8_8_8_8": (np.uint32, ALIKE), "GL_UNSIGNED_INT_8_8_8_8_REV": (np.uint32, ALIKE),
    "GL_UNSIGNED_INT_10_10_10_2": (np.uint32, OF_FOUR), "GL_UNSIGNED_INT_2_10_10_10_REV": (np.uint32, OF_FOUR),
    "GL_UNSIGNED_INT_5_9_9_9_REV": (np.uint32, OF_THREE), "GL_UNSIGNED_INT_10F_11F_11F_REV": (np.uint32, OF_THREE),
}  # fmt: skip
WRAPS = ["GL_REPEAT", "GL_CLAMP_TO_EDGE", "GL_MIRRORED_REPEAT", "GL_CLAMP_TO_BORDER", "GL_CLAMP"]


def client_pixels(writer: Writer, width: int, height: int, components: int, kind: str) -> np.ndarray:
    """Return random pixels of a type: all integers, or floats from a little below 0 to a little above 1."""
    shape = (height, width) if components == 1 else (height, width, components)
    dtype = PIXEL_TYPES[kind]
    if np.dtype(dtype).kind == "f":
        return writer.rng.uniform(-0.1, 1.1, shape).round(4).astype(dtype)
    limits = np.iinfo(dtype)
    return writer.rng.integers(limits.min, limits.max, shape, dtype=dtype, endpoint=True)


def packed_words(rng: np.random.Generator, width: int, height: int, kind: str) -> np.ndarray:
    """Return random pixels (height, width) of a packed type."""
    dtype = PACKED_KINDS[kind][0]
    return rng.integers(0, np.iinfo(dtype).max, (height, width), dtype=dtype, endpoint=True)


def part_of_client_memory(writer: Writer, row: int, rows: int) -> None:
    """Say that images are parts of client images of `row` pixels by `rows`."""
    writer.call("glPixelStorei", "GL_UNPACK_ROW_LENGTH", row)
    writer.call("glPixelStorei", "GL_UNPACK_SKIP_PIXELS", min(1, row))
    writer.call("glPixelStorei", "GL_UNPACK_SKIP_ROWS", min(1, rows))


def uploaded(writer: Writer) -> None:
    """A texture of any format from pixels of any format and type, read back, and the state to draw with it."""
    writer.call("glBindTexture", "GL_TEXTURE_2D", writer.pick(["texture 0", "texture 1"]))
    width, height = writer.integer(1, 17), writer.integer(1, 9)
    _upload(writer, "glTexImage2D", (writer.pick(INTERNAL_FORMATS),), (0,), width, height)
    if writer.chance(0.4):
        x, y = writer.integer(0, width - 1), writer.integer(0, height - 1)
        _upload(writer, "glTexSubImage2D", (x, y), (), writer.integer(0, width - x), writer.integer(0, height - y))
    if writer.chance(0.3):
        _copy(writer, width, height)
    _get(writer)
    writer.sampler(WRAPS)
    writer.call("glTexParameterfv", "GL_TEXTURE_2D", "GL_TEXTURE_BORDER_COLOR", list(writer.color()))
    writer.call("glEnable", "GL_TEXTURE_2D")
    modes = ["GL_MODULATE", "GL_REPLACE", "GL_DECAL", "GL_BLEND", "GL_ADD"]
    writer.call("glTexEnvi", "GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", writer.pick(modes))
    writer.texture_coordinates = 2


def _upload(
    writer: Writer, call: str, place: tuple[Any, ...], border: tuple[int, ...], width: int, height: int
) -> None:
    if writer.chance(0.3):
        row, rows = width + 2, height + 1
        part_of_client_memory(writer, row, rows)
    else:
        row, rows = width, height
    pixel_format, kind = _names(writer)
    if kind in PACKED_KINDS:
        pixels = packed_words(writer.rng, row, rows, kind)
    else:
        pixels = client_pixels(writer, row, rows, PIXEL_FORMATS[pixel_format], kind)
    sides = (width, height, *border)
    writer.call(call, "GL_TEXTURE_2D", 0, *place, *sides, pixel_format, kind, pixels)
    part_of_client_memory(writer, 0, 0)


def _names(writer: Writer) -> tuple[str, str]:
    """Return a format and a type for it, now and then a packed one."""
    if writer.chance(0.2):
        kind = writer.pick(list(PACKED_KINDS))
        return writer.pick(PACKED_KINDS[kind][1]), kind
    return writer.pick(list(PIXEL_FORMATS)), writer.pick(list(PIXEL_TYPES))


def _copy(writer: Writer, width: int, height: int) -> None:
    """Copy a part of the window over the texture; what lies beyond the window GL leaves undefined."""
    x, y = writer.integer(0, writer.size[0] - width), writer.integer(0, writer.size[1] - height)
    if writer.chance(0.5):
        internal = writer.pick([name for name in INTERNAL_FORMATS if isinstance(name, str)])
        writer.call("glCopyTexImage2D", "GL_TEXTURE_2D", 0, internal, x, y, width, height, 0)
    else:
        writer.call("glCopyTexSubImage2D", "GL_TEXTURE_2D", 0, 0, 0, x, y, width, height)


def _get(writer: Writer) -> None:
    for _ in range(writer.integer(1, 3)):
        writer.call("glGetTexImage", "GL_TEXTURE_2D", 0, *_names(writer))


# -- depth -------------------------------------------------------------------------------------------------------------
def uploaded_depth(writer: Writer) -> None:
    """A texture of depths from numbers of any type, or of packed depth and stencil; copied over; compared or seen."""
    writer.call("glBindTexture", "GL_TEXTURE_2D", writer.pick(["texture 0", "texture 1"]))
    width, height = writer.integer(1, 17), writer.integer(1, 9)
    if writer.chance(0.3):
        internal, pixel_format, kind = "GL_DEPTH24_STENCIL8", "GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8"
        pixels = client_pixels(writer, width, height, 1, "GL_UNSIGNED_INT")
    else:
        kind = writer.pick(list(PIXEL_TYPES))
        internal, pixel_format = writer.pick(DEPTH_FORMATS), "GL_DEPTH_COMPONENT"
        if internal == "GL_DEPTH_COMPONENT":  # which would be 32 bits deep
            kind = "GL_FLOAT" if kind == "GL_UNSIGNED_INT" else kind
        pixels = client_pixels(writer, width, height, 1, kind)
    writer.call("glTexImage2D", "GL_TEXTURE_2D", 0, internal, width, height, 0, pixel_format, kind, pixels)
    if writer.chance(0.4):
        x, y = writer.integer(0, writer.size[0] - width), writer.integer(0, writer.size[1] - height)
        if writer.chance(0.5) or internal == "GL_DEPTH24_STENCIL8":
            writer.call("glCopyTexSubImage2D", "GL_TEXTURE_2D", 0, 0, 0, x, y, width, height)
        else:
            writer.call("glCopyTexImage2D", "GL_TEXTURE_2D", 0, internal, x, y, width, height, 0)
    for _ in range(2):
        writer.call("glGetTexImage", "GL_TEXTURE_2D", 0, "GL_DEPTH_COMPONENT", writer.pick(list(PIXEL_TYPES)))
    writer.compare()
    for side in "ST":
        writer.call("glTexParameteri", "GL_TEXTURE_2D", f"GL_TEXTURE_WRAP_{side}", writer.pick(WRAPS))
    writer.call("glTexParameterfv", "GL_TEXTURE_2D", "GL_TEXTURE_BORDER_COLOR", list(writer.color()))
    writer.call("glEnable", "GL_TEXTURE_2D")
    writer.texture_coordinates = 3


# -- read-outs ---------------------------------------------------------------------------------------------------------
def read_out(writer: Writer) -> None:
    """Read rectangles of colour, depth and stencil, inside the window and beyond, in every format and type."""
    for _ in range(writer.integer(2, 6)):
        x, y = writer.integer(-9, writer.size[0]), writer.integer(-9, writer.size[1])
        width, height = writer.integer(1, writer.size[0]), writer.integer(1, writer.size[1])
        planes = ["GL_DEPTH_COMPONENT", "GL_STENCIL_INDEX"]
        pixel_format = writer.pick([*PIXEL_FORMATS, *planes, *planes])
        kind = writer.pick(list(PIXEL_TYPES))
        if writer.chance(0.1):
            pixel_format, kind = "GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8"
        elif writer.chance(0.2):
            pixel_format, kind = _names(writer)
        writer.call("glReadPixels", x, y, width, height, pixel_format, kind)
