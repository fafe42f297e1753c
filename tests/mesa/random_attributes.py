"""Random programs with secondary colours and fog coordinates, and with attributes between small glBegin/glEnd pairs."""

import numpy as np

from mesa.random_arrays import TYPES
from mesa.random_shading import MATERIALS, fogged, lights
from mesa.random_writer import FACES, Writer

SECONDARY = {
    "b": np.int8, "ub": np.uint8, "s": np.int16, "us": np.uint16, "i": np.int32, "ui": np.uint32, "f": np.float32,
    "d": np.float64,
}  # fmt: skip
POINTERS = ["glVertexPointer", "glSecondaryColorPointer", "glFogCoordPointer"]
QUERIES = ["GL_CURRENT_SECONDARY_COLOR", "GL_CURRENT_FOG_COORD", "GL_FOG_COORD_SRC"]
PUSHED = ["GL_CURRENT_BIT", "GL_FOG_BIT", "GL_ENABLE_BIT", "GL_ALL_ATTRIB_BITS", "GL_FOG_BIT | GL_CURRENT_BIT"]
LIGHTING_BITS = ["GL_LIGHTING_BIT", "GL_CURRENT_BIT", "GL_ENABLE_BIT", "GL_LIGHTING_BIT | GL_CURRENT_BIT"]
SMALL = ["GL_TRIANGLES", "GL_QUADS", "GL_TRIANGLE_FAN", "GL_TRIANGLE_STRIP", "GL_POLYGON", "GL_LINES", "GL_POINTS"]


# -- secondary colours and fog coordinates -----------------------------------------------------------------------------
def summed(writer: Writer) -> None:
    """Fog of both sources, and a colour sum, with lighting and textures or without."""
    fogged(writer)
    writer.call("glFogi", "GL_FOG_COORD_SRC", writer.pick(["GL_FOG_COORD", "GL_FOG_COORD", "GL_FRAGMENT_DEPTH"]))
    writer.switch("GL_COLOR_SUM", 0.7)
    if writer.chance(0.3):
        lights(writer)
        control = writer.pick(["GL_SINGLE_COLOR", "GL_SEPARATE_SPECULAR_COLOR"])
        writer.call("glLightModeli", "GL_LIGHT_MODEL_COLOR_CONTROL", control)
        writer.call("glLightModeli", "GL_LIGHT_MODEL_TWO_SIDE", writer.pick([0, 1]))
    else:
        writer.call("glDisable", "GL_LIGHTING")
        writer.normals = False
    writer.texture_coordinates = 2 if writer.switch("GL_TEXTURE_2D", 0.3) else 0


def textured(writer: Writer) -> None:
    writer.color_texture("texture 0")


def colored(writer: Writer, wild: bool) -> None:
    """Draw with secondary colours and fog coordinates of vertices, from calls, lists or arrays."""
    _current(writer)
    is_pushed = writer.chance(0.2)
    if is_pushed:
        writer.call("glPushAttrib", writer.pick(PUSHED))
        writer.switch("GL_COLOR_SUM", 0.5)
        _current(writer)
    kind = writer.pick(["calls", "calls", "list", "arrays", "buffers"])
    if kind in ("arrays", "buffers"):
        _arrays(writer, wild, kind == "buffers")
    elif kind == "list":
        writer.call("glNewList", 1, "GL_COMPILE")
        _calls(writer, wild, in_list=True)
        writer.call("glEndList")
        for _ in range(writer.integer(1, 2)):
            writer.call("glCallList", 1)
            _current(writer)
    else:
        for _ in range(writer.integer(1, 3)):
            _calls(writer, wild)
    if is_pushed:
        writer.call("glPopAttrib")
    if writer.chance(0.3):
        writer.call("glGetFloatv", writer.pick(QUERIES))


def _current(writer: Writer) -> None:
    """Set some of the current attributes, with calls of all types."""
    if writer.chance(0.5):
        _secondary(writer)
    if writer.chance(0.5):
        _fog_coordinate(writer)


def _secondary(writer: Writer) -> None:
    kind, vector = writer.pick(list(SECONDARY)), writer.chance(0.5)
    dtype = SECONDARY[kind]
    if kind in "fd":
        color = [writer.number(-0.2, 1.2) for _ in range(3)]
    else:
        limits = np.iinfo(dtype)
        color = writer.rng.integers(limits.min, limits.max, 3, dtype, endpoint=True).tolist()
    arguments = (np.array(color, dtype),) if vector else color
    writer.call(f"glSecondaryColor3{kind}{'v' * vector}", *arguments)


def _fog_coordinate(writer: Writer) -> None:
    kind, coordinate = writer.pick(["f", "d"]), writer.number(-3, 8)
    if writer.chance(0.5):
        writer.call(f"glFogCoord{kind}", coordinate)
    else:
        writer.call(f"glFogCoord{kind}v", np.array([coordinate], SECONDARY[kind]))


def _calls(writer: Writer, wild: bool, in_list: bool = False) -> None:
    """Draw 12 vertices; in a list the first one has all attributes: the fault "late colour in a list" is known."""
    mode = writer.pick(writer.primitives)
    writer.call("glBegin", mode)
    for number, vertex in enumerate(writer.vertices(12, wild)):
        all_set = in_list and number == 0
        if all_set or writer.chance(0.5):
            writer.call("glColor4f", *writer.color())
        if all_set or writer.chance(0.4):
            _secondary(writer)
        if all_set or writer.chance(0.4):
            _fog_coordinate(writer)
        if writer.normals and (all_set or writer.chance(0.5)):
            writer.call("glNormal3f", *(writer.number(-1, 1) for _ in range(3)))
        if writer.texture_coordinates and (all_set or writer.chance(0.7)):
            writer.call("glTexCoord2f", writer.number(-1, 2), writer.number(-1, 2))
        writer.call("glVertex4f", *vertex)
    writer.call("glEnd")


def _arrays(writer: Writer, wild: bool, in_buffers: bool) -> None:
    count, enabled = 12, ["GL_VERTEX_ARRAY"]
    _point(writer, "glVertexPointer", (4, "GL_FLOAT"), np.array(writer.vertices(count, wild), np.float32), in_buffers)
    if writer.chance(0.7):
        kind, size = writer.pick(list(TYPES)), writer.pick([3, 3, 4])
        dtype = TYPES[kind]
        if np.dtype(dtype).kind == "f":
            colors = writer.rng.uniform(-0.2, 1.2, (count, size)).astype(dtype)
        else:
            limits = np.iinfo(dtype)
            colors = writer.rng.integers(limits.min, limits.max, (count, size), dtype, endpoint=True)
        _point(writer, "glSecondaryColorPointer", (size, kind), colors, in_buffers)
        enabled.append("GL_SECONDARY_COLOR_ARRAY")
    if writer.chance(0.7):
        kind = writer.pick(["GL_FLOAT", "GL_DOUBLE"])
        coordinates = writer.rng.uniform(-3, 8, count).astype(TYPES[kind])
        _point(writer, "glFogCoordPointer", (kind,), coordinates, in_buffers)
        enabled.append("GL_FOG_COORD_ARRAY")
    for array in enabled:
        writer.call("glEnableClientState", array)
    mode, kind = writer.pick(writer.primitives), writer.integer(0, 3)
    if kind == 0:
        writer.call("glDrawArrays", mode, 0, count)
    elif kind == 1:
        indices = writer.rng.integers(0, count, count, dtype=np.uint16)
        writer.call("glDrawElements", mode, count, "GL_UNSIGNED_SHORT", indices)
    elif kind == 2:
        writer.call("glMultiDrawArrays", mode, np.array([0, 4], np.int32), np.array([4, 8], np.int32), 2)
    else:
        writer.call("glBegin", mode)
        for vertex in range(count):
            writer.call("glArrayElement", vertex)
        writer.call("glEnd")
    for array in enabled:
        writer.call("glDisableClientState", array)
    # what an array set is undefined after drawing with it
    _secondary(writer)
    _fog_coordinate(writer)


def _point(writer: Writer, pointer: str, layout: tuple[object, ...], values: np.ndarray, in_buffer: bool) -> None:
    if not in_buffer:
        writer.call(pointer, *layout, 0, values)
        return
    name = f"buffer {POINTERS.index(pointer)}"
    writer.call("glBindBuffer", "GL_ARRAY_BUFFER", name)
    writer.call("glBufferData", "GL_ARRAY_BUFFER", values.nbytes, values, "GL_STATIC_DRAW")
    writer.call(pointer, *layout, 0, None)
    writer.call("glBindBuffer", "GL_ARRAY_BUFFER", 0)


# -- small pairs -------------------------------------------------------------------------------------------------------
def followed(writer: Writer) -> None:
    """Lighting on or off, with material colours that follow glColor or do not."""
    if not writer.normals:
        lights(writer)
    writer.switch("GL_LIGHTING", 0.7)
    writer.call("glShadeModel", writer.pick(["GL_SMOOTH", "GL_SMOOTH", "GL_FLAT"]))
    if writer.chance(0.5):
        writer.call("glColorMaterial", writer.pick(FACES), writer.pick(MATERIALS))
    writer.switch("GL_COLOR_MATERIAL", 0.5)


def small_pairs(writer: Writer, wild: bool) -> None:
    """Draw pairs of at most eight vertices, with attributes, pushes and pops between them."""
    pushes = 0
    for _ in range(writer.integer(2, 8)):
        for _ in range(writer.integer(0, 3)):
            _attribute(writer)
        if writer.chance(0.2):
            writer.call("glPushAttrib", writer.pick(LIGHTING_BITS))
            pushes += 1
        if writer.chance(0.2):
            writer.switch("GL_COLOR_MATERIAL", 0.5)
        if writer.chance(0.2):
            writer.switch("GL_LIGHTING", 0.6)
        writer.call("glBegin", writer.pick(SMALL))
        for vertex in writer.vertices(writer.integer(1, 8), wild=False):
            if writer.chance(0.3):
                _attribute(writer, inside=True)
            writer.call("glVertex4f", *vertex)
        writer.call("glEnd")
        if pushes and writer.chance(0.4):
            writer.call("glPopAttrib")
            pushes -= 1
        if writer.chance(0.2):
            writer.call("glGetFloatv", "GL_CURRENT_COLOR")
        if writer.chance(0.2):
            writer.call("glGetMaterialfv", writer.pick(FACES[:2]), writer.pick(MATERIALS[:4]))
    for _ in range(pushes):
        writer.call("glPopAttrib")


def _attribute(writer: Writer, inside: bool = False) -> None:
    """Set a colour, normal or material; within pairs no material."""
    kind = writer.integer(0, 3)
    if kind == 0:
        writer.call("glColor4f", *writer.color())
    elif kind == 1:
        writer.call("glNormal3f", *(writer.number(-1, 1) for _ in range(3)))
    elif not inside and kind == 2:
        writer.call("glMaterialfv", writer.pick(FACES), writer.pick(MATERIALS), list(writer.color()))
    elif not inside:
        writer.call("glMaterialf", writer.pick(FACES), "GL_SHININESS", writer.pick([0.0, 1.0, writer.number(0, 128)]))
