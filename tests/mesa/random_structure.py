"""Random programs with clip planes, scissored clears, display lists, attribute stacks, and targets off the screen."""

from mesa.random_vertices import steep
from mesa.random_writer import Writer

ATTRIBUTES = [
    "GL_ALL_ATTRIB_BITS", "GL_ENABLE_BIT", "GL_DEPTH_BUFFER_BIT", "GL_STENCIL_BUFFER_BIT", "GL_COLOR_BUFFER_BIT",
    "GL_POLYGON_BIT", "GL_VIEWPORT_BIT", "GL_SCISSOR_BIT", "GL_LIGHTING_BIT", "GL_TRANSFORM_BIT", "GL_CURRENT_BIT",
]  # fmt: skip


def clipped(writer: Writer) -> None:
    """User clip planes, given under one modelview matrix and used under it or another."""
    if writer.chance(0.7):
        writer.matrices(rotations=True)
    for number in range(6):
        plane = f"GL_CLIP_PLANE{number}"
        if writer.switch(plane, 0.25):
            equation = [writer.pick([0.0, 1.0, -1.0, writer.number(-1, 1)]) for _ in range(4)]
            writer.call("glClipPlane", plane, equation)
    if writer.chance(0.3):
        writer.call("glTranslatef", writer.number(-1, 1), writer.number(-1, 1), 0.0)
    writer.geometry_state()
    if writer.chance(0.3):
        writer.fragment_state()


def scissored_clears(writer: Writer) -> None:
    """Clears of parts of the planes of a part of the window."""
    writer.fragment_state()
    width, height = writer.size
    writer.switch("GL_SCISSOR_TEST", 0.8)
    for _ in range(writer.integer(1, 3)):
        box = writer.integer(-5, width), writer.integer(-5, height), writer.integer(0, width), writer.integer(0, height)
        writer.call("glScissor", *box)
        writer.call("glClearColor", *writer.color())
        writer.call("glClearDepth", writer.number(-0.2, 1.2))
        writer.call("glClearStencil", writer.integer(-1, 300))
        writer.clear()


# -- lists and stacks --------------------------------------------------------------------------------------------------
def listed(writer: Writer, wild: bool) -> None:
    """A draw and the state before it in a display list, which is carried out once or more, under other state too."""
    name = writer.integer(1, 3)
    writer.colors, writer.color_sizes = 1.0, [4]  # not the fault "late colour in a list" of known_differences.py
    writer.call("glNewList", name, writer.pick(["GL_COMPILE", "GL_COMPILE", "GL_COMPILE_AND_EXECUTE"]))
    for _ in range(writer.integer(1, 2)):
        if writer.chance(0.5):
            writer.depth_state()
        if writer.chance(0.3):
            writer.stencil_state()
        writer.draw(wild)
    writer.call("glEndList")
    for _ in range(writer.integer(1, 3)):
        if writer.chance(0.4):
            writer.geometry_state()
        if writer.chance(0.3):
            writer.call("glTranslatef", writer.number(-0.5, 0.5), writer.number(-0.5, 0.5), 0.0)
        writer.call("glCallList", writer.pick([name, writer.integer(1, 3)]))


def pushed(writer: Writer) -> None:
    """State that is pushed, changed, used and popped; so are matrices."""
    writer.fragment_state()
    writer.call("glPushAttrib", writer.pick(ATTRIBUTES))
    writer.call("glPushMatrix")
    writer.geometry_state()
    if writer.chance(0.5):
        writer.fragment_state()
    writer.call("glTranslatef", writer.number(-0.5, 0.5), writer.number(-0.5, 0.5), 0.0)
    writer.draw(wild=True)
    writer.call("glMatrixMode", "GL_MODELVIEW")
    writer.call("glPopMatrix")
    writer.call("glPopAttrib")
    writer.call("glColor4f", *writer.color())  # not the fault "popped colour" of known_differences.py
    for query in ("GL_DEPTH_FUNC", "GL_STENCIL_REF", "GL_COLOR_WRITEMASK", "GL_VIEWPORT", "GL_CURRENT_COLOR"):
        writer.call("glGetFloatv", query)


# -- off the screen ----------------------------------------------------------------------------------------------------
def offscreen(writer: Writer) -> None:
    """A framebuffer object with textures of colour and depth: fixed point, with stencil or without, or float."""
    width, height = writer.size
    images = [
        ("GL_COLOR_ATTACHMENT0", "GL_RGBA8", "GL_RGBA", "GL_UNSIGNED_BYTE"),
        writer.pick(
            [
                ("GL_DEPTH_ATTACHMENT", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT", "GL_FLOAT"),
                ("GL_DEPTH_ATTACHMENT", "GL_DEPTH_COMPONENT32F", "GL_DEPTH_COMPONENT", "GL_FLOAT"),
                ("GL_DEPTH_STENCIL_ATTACHMENT", "GL_DEPTH24_STENCIL8", "GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8"),
            ]
        ),
    ]
    writer.reads_stencil = images[1][1] == "GL_DEPTH24_STENCIL8"
    writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", "framebuffer 0")
    for number, (attachment, internal, pixel_format, pixel_type) in enumerate(images):
        name = f"texture {number}"
        writer.call("glBindTexture", "GL_TEXTURE_2D", name)
        image = (internal, width, height, 0, pixel_format, pixel_type, None)
        writer.call("glTexImage2D", "GL_TEXTURE_2D", 0, *image)
        writer.call("glFramebufferTexture2D", "GL_FRAMEBUFFER", attachment, "GL_TEXTURE_2D", name, 0)
    writer.call("glBindTexture", "GL_TEXTURE_2D", 0)
    for plane in ("GL_COLOR_BUFFER_BIT", "GL_DEPTH_BUFFER_BIT", "GL_STENCIL_BUFFER_BIT"):
        writer.call("glClear", plane)


def offset(writer: Writer) -> None:
    """Steep triangles under polygon offset, and the rest of the state."""
    if writer.chance(0.6):
        writer.matrices(rotations=True)
    writer.geometry_state()
    if writer.chance(0.5):
        writer.fragment_state()
    writer.call("glEnable", "GL_POLYGON_OFFSET_FILL")
    writer.call("glPolygonOffset", writer.number(-4, 4), writer.pick([0.0, 1.0, -1.0, 1000.0]))
    corners = writer.vertices(3, wild=False)
    writer.call("glBegin", "GL_TRIANGLES")
    for vertex in steep(writer, corners):
        writer.call("glVertex4f", *vertex)
    writer.call("glEnd")


def read_offscreen(writer: Writer) -> None:
    writer.call("glReadPixels", 0, 0, *writer.size, "GL_RGBA", "GL_UNSIGNED_BYTE")
    writer.call("glReadPixels", 0, 0, *writer.size, "GL_DEPTH_COMPONENT", "GL_FLOAT")
