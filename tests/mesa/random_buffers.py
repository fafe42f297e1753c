"""Random programs with accumulation, queries, blits, float targets and several framebuffers."""

from mesa.random_writer import Writer

ACCUMULATIONS = ["GL_ACCUM", "GL_ACCUM", "GL_LOAD", "GL_ADD", "GL_MULT", "GL_RETURN", "GL_RETURN"]


# -- accumulation ------------------------------------------------------------------------------------------------------
def accumulated(writer: Writer) -> None:
    """Any operations on the accumulation buffer between draws."""
    if writer.chance(0.3):
        writer.fragment_state()
    if writer.chance(0.3):
        writer.call("glClearAccum", *(writer.number(-1, 1) for _ in range(4)))
        writer.call("glClear", "GL_ACCUM_BUFFER_BIT")
    for _ in range(writer.integer(1, 4)):
        value = writer.pick([1.0, 0.5, 0.25, -0.5, writer.number(-2, 2), round(1 / writer.integer(2, 64), 6)])
        writer.call("glAccum", writer.pick(ACCUMULATIONS), value)


def accumulated_lights(writer: Writer) -> None:
    """A soft shadow: the mean of pictures, each with its clears and draws, returned to the window."""
    writer.call("glClear", "GL_ACCUM_BUFFER_BIT")
    count = writer.pick([2, 3, 4, 8, 10])
    for _ in range(count):
        writer.call("glClear", "GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT")
        writer.draw(wild=False)
        writer.call("glAccum", "GL_ACCUM", round(1 / count, 6))
    writer.call("glAccum", "GL_RETURN", 1.0)


# -- queries -----------------------------------------------------------------------------------------------------------
def counted(writer: Writer, wild: bool) -> None:
    """Draws with clears and other state between them in one query or two, read at once or at the end."""
    for number in range(writer.integer(1, 2)):
        target = "GL_SAMPLES_PASSED" if number == 0 else "GL_ANY_SAMPLES_PASSED"
        writer.call("glBeginQuery", target, f"query {number}")
        for _ in range(writer.integer(1, 3)):
            if writer.chance(0.5):
                writer.fragment_state()
            if writer.chance(0.2):
                writer.clear()
            writer.draw(wild)
        writer.call("glEndQuery", target)
        if writer.chance(0.6):
            writer.draw(wild)
        writer.call("glGetQueryObjectuiv", f"query {number}", "GL_QUERY_RESULT")


# -- framebuffer objects -----------------------------------------------------------------------------------------------
COLORS = ["GL_RGBA8", "GL_RGBA8", "GL_RGBA32F", "GL_R32F", "GL_RGB", "GL_RG8", "GL_RGBA16F"]
FLOAT_COLORS = ["GL_RGBA32F", "GL_RGBA32F", "GL_R32F", "GL_RG32F", "GL_RGBA16F", "GL_RG16F"]
DEPTHS = ["GL_DEPTH24_STENCIL8", "GL_DEPTH24_STENCIL8", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT16"]
IMAGES = {
    "GL_DEPTH24_STENCIL8": ("GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8"),
    "GL_DEPTH_COMPONENT16": ("GL_DEPTH_COMPONENT", "GL_UNSIGNED_SHORT"),
    "GL_DEPTH_COMPONENT24": ("GL_DEPTH_COMPONENT", "GL_FLOAT"),
    "GL_DEPTH_COMPONENT32F": ("GL_DEPTH_COMPONENT", "GL_FLOAT"),
}


def framebuffer(writer: Writer, number: int, color: str, depth: str) -> None:
    """Make a framebuffer object of the window's size, bound and cleared; images are textures or renderbuffers."""
    writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", f"framebuffer {number}")
    both = depth == "GL_DEPTH24_STENCIL8"
    _attach(writer, f"{2 * number}", "GL_COLOR_ATTACHMENT0", color)
    _attach(writer, f"{2 * number + 1}", "GL_DEPTH_STENCIL_ATTACHMENT" if both else "GL_DEPTH_ATTACHMENT", depth)
    writer.reads_stencil = both
    writer.call("glCheckFramebufferStatus", "GL_FRAMEBUFFER")
    writer.call("glClear", "GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT")


def _attach(writer: Writer, number: str, attachment: str, internal: str) -> None:
    if writer.chance(0.5):
        name = f"renderbuffer {number}"
        writer.call("glBindRenderbuffer", "GL_RENDERBUFFER", name)
        writer.call("glRenderbufferStorage", "GL_RENDERBUFFER", internal, *writer.size)
        writer.call("glFramebufferRenderbuffer", "GL_FRAMEBUFFER", attachment, "GL_RENDERBUFFER", name)
    else:
        name = f"texture {number}"
        pixels = IMAGES.get(internal, ("GL_RGBA", "GL_UNSIGNED_BYTE"))
        writer.call("glBindTexture", "GL_TEXTURE_2D", name)
        writer.call("glTexImage2D", "GL_TEXTURE_2D", 0, internal, *writer.size, 0, *pixels, None)
        for side in ("MIN", "MAG"):
            writer.call("glTexParameteri", "GL_TEXTURE_2D", f"GL_TEXTURE_{side}_FILTER", "GL_NEAREST")
        writer.call("glFramebufferTexture2D", "GL_FRAMEBUFFER", attachment, "GL_TEXTURE_2D", name, 0)
        writer.call("glBindTexture", "GL_TEXTURE_2D", 0)


def float_target(writer: Writer) -> None:
    framebuffer(writer, 0, writer.pick(FLOAT_COLORS), writer.pick(DEPTHS))


def blended_floats(writer: Writer) -> None:
    """Blending, masks and alpha test on colours that are not rounded."""
    if writer.chance(0.3):
        writer.matrices(rotations=False)
    writer.fragment_state()
    if writer.switch("GL_BLEND", 0.7):
        writer.blend_state()
        writer.call("glBlendColor", *writer.color())
    if writer.chance(0.3):
        writer.call("glClearColor", *(writer.number(-1, 2) for _ in range(4)))
        writer.call("glClear", "GL_COLOR_BUFFER_BIT")


def read_target(writer: Writer) -> None:
    for pixels in (("GL_RGBA", "GL_FLOAT"), ("GL_RGBA", "GL_UNSIGNED_BYTE"), ("GL_DEPTH_COMPONENT", "GL_FLOAT")):
        writer.call("glReadPixels", 0, 0, *writer.size, *pixels)
    if writer.reads_stencil:
        writer.call("glReadPixels", 0, 0, *writer.size, "GL_STENCIL_INDEX", "GL_UNSIGNED_BYTE")


def several_framebuffers(writer: Writer) -> None:
    depth = writer.pick(DEPTHS)
    for number in range(2):
        framebuffer(writer, number, writer.pick(COLORS), depth)


def switched(writer: Writer) -> None:
    """Draw into one of several framebuffers; now and then copy rectangles between them, of one size or mirrored."""
    if writer.chance(0.3):
        writer.matrices(rotations=False)
    writer.fragment_state()
    if writer.chance(0.5):
        _blit(writer)
    writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", writer.pick([0, "framebuffer 0", "framebuffer 1"]))


def _blit(writer: Writer) -> None:
    read, drawn = writer.pick([["framebuffer 0", "framebuffer 1"], ["framebuffer 1", "framebuffer 0"]])
    writer.call("glBindFramebuffer", "GL_READ_FRAMEBUFFER", read)
    writer.call("glBindFramebuffer", "GL_DRAW_FRAMEBUFFER", drawn)
    width, height = writer.integer(1, writer.size[0]), writer.integer(1, writer.size[1])
    boxes = []
    for flips in (False, True):
        left, bottom = writer.integer(-5, writer.size[0]), writer.integer(-5, writer.size[1])
        x, y = [left, left + width], [bottom, bottom + height]
        if flips and writer.chance(0.3):
            x.reverse()
        if flips and writer.chance(0.3):
            y.reverse()
        boxes += [x[0], y[0], x[1], y[1]]
    planes = ["GL_COLOR_BUFFER_BIT", "GL_DEPTH_BUFFER_BIT", "GL_STENCIL_BUFFER_BIT"]
    mask = " | ".join(plane for plane in planes if writer.chance(0.7)) or planes[0]
    filters = ["GL_NEAREST"] if mask != planes[0] else ["GL_NEAREST", "GL_LINEAR"]
    writer.call("glBlitFramebuffer", *boxes, mask, writer.pick(filters))


def read_framebuffers(writer: Writer) -> None:
    stencil = writer.reads_stencil
    for number in range(2):
        writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", f"framebuffer {number}")
        read_target(writer)
    writer.reads_stencil = stencil
