"""Random programs about rectangles of pixels, drawn, copied and read under pixel transfer, or in buffer objects."""

import numpy as np

from mesa.random_images import PACKED_KINDS, PIXEL_FORMATS, PIXEL_TYPES, client_pixels, packed_words
from mesa.random_writer import Writer

SCALES = ["RED", "GREEN", "BLUE", "ALPHA", "DEPTH"]
PLAIN_TYPES = [kind for kind in PIXEL_TYPES if kind not in ("GL_INT", "GL_UNSIGNED_INT")]  # at 1 Mesa overflows
PLANES = {"GL_COLOR": "GL_RGBA", "GL_DEPTH": "GL_DEPTH_COMPONENT", "GL_STENCIL": "GL_STENCIL_INDEX"}
UNPACK, PACK = "GL_PIXEL_UNPACK_BUFFER", "GL_PIXEL_PACK_BUFFER"


def transferred(writer: Writer) -> None:
    """The state of fragments and of pixel transfer, and rectangles that are drawn, copied and read.

    Under GL_MAP_COLOR nothing is cut off: what Mesa takes for blue and alpha depends on the rest of the image.
    """
    mapped = writer.chance(0.2)
    if mapped:
        writer.call("glDisable", "GL_SCISSOR_TEST")
    elif writer.chance(0.6):
        writer.fragment_state()
    transfer(writer)
    writer.call("glPixelTransferi", "GL_MAP_COLOR", int(mapped))
    for _ in range(writer.integer(1, 3)):
        zooms = [1.0, 1.0, 2.0, -1.0, writer.number(-2.7, 2.7)]
        writer.call("glPixelZoom", writer.pick(zooms), writer.pick(zooms))
        place = [writer.integer(0, size - 1) for size in writer.size]
        writer.call("glWindowPos2i", *([2, 3] if mapped else place))
        rectangle = drawn if writer.chance(0.7) else copied
        rectangle(writer)
    if writer.chance(0.5):
        read(writer)


def transfer(writer: Writer) -> None:
    """Some scales and biases, shift and offset; maps where nothing but Mesa's own errors is read from them."""
    for name in SCALES:
        if writer.chance(0.3):
            writer.call("glPixelTransferf", f"GL_{name}_SCALE", writer.pick([1.0, writer.number(-0.5, 2)]))
            writer.call("glPixelTransferf", f"GL_{name}_BIAS", writer.pick([0.0, writer.number(-0.5, 0.5)]))
    if writer.chance(0.2):
        writer.call("glPixelTransferi", "GL_INDEX_SHIFT", writer.integer(-2, 2))
        writer.call("glPixelTransferi", "GL_INDEX_OFFSET", writer.integer(-20, 20))
    if writer.chance(0.3):
        size = writer.pick([1, 2, 8, 256])
        writer.call("glPixelMapfv", "GL_PIXEL_MAP_S_TO_S", size, whole(writer, size, 255))
        writer.call("glPixelTransferi", "GL_MAP_STENCIL", writer.integer(0, 1))
    for channel in "RGBA":
        if writer.chance(0.2):
            size, name = writer.integer(2, 256), f"GL_PIXEL_MAP_{channel}_TO_{channel}"
            writer.call("glPixelMapfv", name, size, writer.rng.uniform(-0.1, 1.1, size).astype(np.float32))
            writer.call("glGetPixelMapfv", name)


def whole(writer: Writer, size: int, largest: int) -> np.ndarray:
    """Return a table of whole numbers."""
    return writer.rng.integers(0, largest + 1, size).astype(np.float32)


def drawn(writer: Writer) -> None:
    """Draw a rectangle of colours, packed or not, of depths, or of stencil values; now and then out of a buffer."""
    width, height = writer.integer(1, 20), writer.integer(1, 12)
    kind, pixel_format = writer.pick(list(PIXEL_TYPES)), writer.pick(list(PIXEL_FORMATS))
    if writer.chance(0.3):
        kind = writer.pick(list(PACKED_KINDS))
        pixel_format = writer.pick(PACKED_KINDS[kind][1])
        pixels = packed_words(writer.rng, width, height, kind)
    elif writer.chance(0.4):
        pixel_format = writer.pick(["GL_DEPTH_COMPONENT", "GL_STENCIL_INDEX"])
        pixels = client_pixels(writer, width, height, 1, kind)
        if pixel_format == "GL_STENCIL_INDEX":
            pixels = writer.rng.integers(0, 127, (height, width)).astype(PIXEL_TYPES[kind])
    else:
        pixels = client_pixels(writer, width, height, PIXEL_FORMATS[pixel_format], kind)
    if writer.chance(0.2) and pixels[0].nbytes % 4 == 0:  # rows in buffer objects are aligned
        writer.call("glBindBuffer", UNPACK, "buffer 0")
        writer.call("glBufferData", UNPACK, pixels.nbytes, pixels, "GL_STREAM_DRAW")
        writer.call("glDrawPixels", width, height, pixel_format, kind, 0)
        writer.call("glBindBuffer", UNPACK, 0)
    else:
        writer.call("glDrawPixels", width, height, pixel_format, kind, pixels)


def copied(writer: Writer) -> None:
    """Copy a rectangle that lies in the window: what lies outside is undefined."""
    width, height = writer.integer(1, 20), writer.integer(1, 12)
    x, y = writer.integer(0, writer.size[0] - width), writer.integer(0, writer.size[1] - height)
    writer.call("glCopyPixels", x, y, width, height, writer.pick([*PLANES, "GL_DEPTH_STENCIL"]))


def read(writer: Writer) -> None:
    """Read a rectangle in any format and type; now and then into a buffer object."""
    kind, pixel_format = writer.pick(PLAIN_TYPES), writer.pick([*PIXEL_FORMATS, "GL_DEPTH_COMPONENT"])
    if writer.chance(0.3):
        kind = writer.pick(list(PACKED_KINDS))
        pixel_format = writer.pick(PACKED_KINDS[kind][1])
    if writer.chance(0.2):
        writer.call("glBindBuffer", PACK, "buffer 1")
        writer.call("glBufferData", PACK, 8 * 8 * 16, np.zeros(8 * 8 * 16, np.uint8), "GL_STREAM_READ")
        writer.call("glReadPixels", 3, 2, 8, 8, pixel_format, kind, 0)
        writer.call("glGetBufferSubData", PACK, 0, 8 * 8 * 4)
        writer.call("glBindBuffer", PACK, 0)
    else:
        writer.call("glReadPixels", 3, 2, 8, 8, pixel_format, kind)
