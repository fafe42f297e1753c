"""Random programs whose depth and stencil values share an image: 24 bits or a float, beside 8."""

import numpy as np

from mesa.random_structure import offset
from mesa.random_writer import Writer

PACKED = {
    "GL_DEPTH32F_STENCIL8": "GL_FLOAT_32_UNSIGNED_INT_24_8_REV",
    "GL_DEPTH24_STENCIL8": "GL_UNSIGNED_INT_24_8",
}
FORMATS = ["GL_DEPTH32F_STENCIL8", "GL_DEPTH32F_STENCIL8", "GL_DEPTH24_STENCIL8"]
DEPTH, STENCIL = "GL_DEPTH_ATTACHMENT", "GL_STENCIL_ATTACHMENT"
POINTS = [["GL_DEPTH_STENCIL_ATTACHMENT"], [DEPTH, STENCIL], [STENCIL, DEPTH]]
DEPTH_TYPES = ["GL_FLOAT", "GL_UNSIGNED_INT", "GL_UNSIGNED_SHORT", "GL_UNSIGNED_BYTE", "GL_INT", "GL_HALF_FLOAT"]
COPY = (16, 8)  # size of the texture that is copied into


def packed_targets(writer: Writer) -> None:
    """Two framebuffer objects whose depth and stencil buffers have one format, and a texture to copy into."""
    internal = writer.pick(FORMATS)
    for number in range(2):
        writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", f"framebuffer {number}")
        writer.call("glBindRenderbuffer", "GL_RENDERBUFFER", f"renderbuffer {2 * number}")
        writer.call("glRenderbufferStorage", "GL_RENDERBUFFER", "GL_RGBA8", *writer.size)
        color = ("GL_COLOR_ATTACHMENT0", "GL_RENDERBUFFER", f"renderbuffer {2 * number}")
        writer.call("glFramebufferRenderbuffer", "GL_FRAMEBUFFER", *color)
        _attach_packed(writer, number, internal)
        for name in ("GL_DEPTH_BITS", "GL_STENCIL_BITS"):
            writer.call("glGetIntegerv", name)
        writer.call("glCheckFramebufferStatus", "GL_FRAMEBUFFER")
        writer.call("glClear", "GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT")
    writer.call("glBindTexture", "GL_TEXTURE_2D", "texture 2")
    copied = writer.pick(list(PACKED))
    writer.call("glTexImage2D", "GL_TEXTURE_2D", 0, copied, *COPY, 0, "GL_DEPTH_STENCIL", PACKED[copied], None)
    writer.call("glBindTexture", "GL_TEXTURE_2D", 0)


def _attach_packed(writer: Writer, number: int, internal: str) -> None:
    """Attach a renderbuffer or an uploaded texture to both points of the bound object, now and then to one."""
    points = writer.pick(POINTS) if writer.chance(0.9) else [DEPTH]
    if writer.chance(0.5):
        name = f"renderbuffer {2 * number + 1}"
        writer.call("glBindRenderbuffer", "GL_RENDERBUFFER", name)
        writer.call("glRenderbufferStorage", "GL_RENDERBUFFER", internal, *writer.size)
        for size in ("DEPTH", "STENCIL", "RED"):
            writer.call("glGetRenderbufferParameteriv", "GL_RENDERBUFFER", f"GL_RENDERBUFFER_{size}_SIZE")
        for point in points:
            writer.call("glFramebufferRenderbuffer", "GL_FRAMEBUFFER", point, "GL_RENDERBUFFER", name)
    else:
        name, kind = f"texture {number}", writer.pick(list(PACKED.values()))
        writer.call("glBindTexture", "GL_TEXTURE_2D", name)
        image = (internal, *writer.size, 0, "GL_DEPTH_STENCIL", kind, _packed_pixels(writer, kind))
        writer.call("glTexImage2D", "GL_TEXTURE_2D", 0, *image)
        for point in points:
            writer.call("glFramebufferTexture2D", "GL_FRAMEBUFFER", point, "GL_TEXTURE_2D", name, 0)
        writer.call("glBindTexture", "GL_TEXTURE_2D", 0)
    if points == [DEPTH]:
        writer.reads_stencil = False


def _packed_pixels(writer: Writer, kind: str) -> np.ndarray:
    """Return an image of the window's size for a packed type; floats reach beyond [0, 1]."""
    shape = writer.size[::-1]
    words = writer.rng.integers(0, 2**32, shape, dtype=np.uint32)
    if kind == "GL_UNSIGNED_INT_24_8":
        return words
    pixels = np.zeros(shape, [("depth", np.float32), ("stencil", np.uint32)])
    pixels["depth"] = writer.rng.uniform(-0.2, 1.2, shape)
    pixels["stencil"] = words & 255
    return pixels


def packed_state(writer: Writer) -> None:
    """Stencil, depth and polygon offset in one object or the other; clears, copies and blits between them."""
    writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", writer.pick(["framebuffer 0", "framebuffer 1"]))
    if writer.chance(0.3):
        offset(writer)
    writer.fragment_state()
    if writer.chance(0.5):
        writer.switch("GL_CULL_FACE", 0.2)
        writer.call("glFrontFace", writer.pick(["GL_CCW", "GL_CW"]))
    if writer.chance(0.4):
        writer.call("glClearDepth", writer.pick([0.0, 1.0, writer.number(0, 1)]))
        writer.call("glClearStencil", writer.integer(0, 300))
        planes = ["GL_DEPTH_BUFFER_BIT", "GL_STENCIL_BUFFER_BIT", "GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT"]
        writer.call("glClear", writer.pick(planes))
    if writer.reads_stencil and writer.chance(0.4):
        _copy(writer)
    if writer.chance(0.4):
        _blit_planes(writer)


def _copy(writer: Writer) -> None:
    x, y = (writer.integer(-4, size) for size in writer.size)
    writer.call("glBindTexture", "GL_TEXTURE_2D", "texture 2")
    writer.call("glCopyTexSubImage2D", "GL_TEXTURE_2D", 0, 0, 0, x, y, *COPY)
    for kind in PACKED.values():
        writer.call("glGetTexImage", "GL_TEXTURE_2D", 0, "GL_DEPTH_STENCIL", kind)
    writer.call("glGetTexImage", "GL_TEXTURE_2D", 0, "GL_DEPTH_COMPONENT", writer.pick(DEPTH_TYPES))
    writer.call("glBindTexture", "GL_TEXTURE_2D", 0)


def _blit_planes(writer: Writer) -> None:
    """Copy depth, stencil or both between the objects: the whole, or rectangles of any sizes."""
    names = ["framebuffer 0", "framebuffer 1"]
    read, drawn = names if writer.chance(0.5) else names[::-1]
    writer.call("glBindFramebuffer", "GL_READ_FRAMEBUFFER", read)
    writer.call("glBindFramebuffer", "GL_DRAW_FRAMEBUFFER", drawn)
    width, height = writer.size
    source, target = (
        [writer.integer(-5, width), writer.integer(-5, height), writer.integer(0, width), writer.integer(0, height)]
        for _ in range(2)
    )
    target = writer.pick([source, target])
    if writer.chance(0.2):
        source = target = [0, 0, width, height]
    mask = writer.pick(["GL_DEPTH_BUFFER_BIT", "GL_STENCIL_BUFFER_BIT", "GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT"])
    writer.call("glBlitFramebuffer", *source, *target, mask, "GL_NEAREST")
    writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", drawn)


def read_packed(writer: Writer) -> None:
    """Read the planes of both objects, each alone and packed."""
    for number in range(2):
        writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", f"framebuffer {number}")
        reads = [("GL_RGBA", "GL_UNSIGNED_BYTE"), ("GL_DEPTH_COMPONENT", "GL_FLOAT")]
        reads.append(("GL_DEPTH_COMPONENT", writer.pick(DEPTH_TYPES)))
        if writer.reads_stencil:
            reads += [("GL_STENCIL_INDEX", "GL_UNSIGNED_BYTE")] + [
                ("GL_DEPTH_STENCIL", kind) for kind in PACKED.values()
            ]
        for pixels in reads:
            writer.call("glReadPixels", 0, 0, *writer.size, *pixels)
