"""What is known to differ from Mesa, by name; the list may only shrink, and a test asserts that each still occurs.

`KNOWN` is what a comparison may meet: it differs in colours only. `FAULTS` are programs in which Mesa leaves the
specification; random programs do not contain them, and nothing that differs is excused by them. Where stencil, depth
or coverage differ, it is a fault of one side: it is mended here, or it stands in `FAULTS`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from mesa.gl_calls import Call

CORNERS = [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.7)]


@dataclass(frozen=True)
class KnownDifference:
    """A difference from Mesa.

    Attributes
    ----------
    name, what, why : str        what differs, and the reason
    largest : int                measured, in steps of an 8-bit channel; 255 where another colour comes out
    program : callable           ``program(gl)``, the smallest that shows it
    occurs_in : callable         whether calls contain what brings it about; never, in a fault
    """

    name: str
    what: str
    why: str
    largest: int
    program: Callable[[Any], Any]
    occurs_in: Callable[[list[Call]], bool] = lambda calls: False


def back_colors(gl: Any) -> None:
    for capability in ("GL_LIGHTING", "GL_LIGHT0", "GL_COLOR_MATERIAL"):
        gl.glEnable(getattr(gl, capability))
    gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1)
    gl.glMaterialf(gl.GL_FRONT_AND_BACK, gl.GL_SHININESS, 8)
    gl.glColorMaterial(gl.GL_BACK, gl.GL_AMBIENT)
    gl.glBegin(gl.GL_TRIANGLES)
    gl.glColor3f(0.25, 0.5, 0.75)
    for corner in CORNERS[2::-1]:
        gl.glVertex2f(*corner)
    gl.glEnd()


def no_place(gl: Any) -> None:
    gl.glBegin(gl.GL_TRIANGLES)
    gl.glVertex4f(0.0, 0.0, 0.0, 0.0)
    gl.glVertex2f(-0.4, -0.2)
    gl.glVertex2f(-0.9, -0.8)
    gl.glEnd()


def rectangle_and_level_triangle(gl: Any) -> list[Any]:
    """The colours of an object of 150 x 150 pixels."""
    side = 150
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, gl.glGenRenderbuffers(1))
    gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_RGBA8, side, side)
    gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_RENDERBUFFER, 1)
    gl.glViewport(0, 0, side, side)
    left, bottom, right, top = -0.7, -0.83, 0.91, 0.77
    corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
    gl.glBegin(gl.GL_TRIANGLES)
    for index in (1, 2, 3, 0, 3, 1, 0, 1, 1):
        gl.glColor3f(0.25 * index, 0.5, 1 - 0.25 * index)
        gl.glVertex2f(*corners[index])
    gl.glEnd()
    return [gl.glReadPixels(0, 0, side, side, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)]


def shiny_backs(gl: Any) -> None:
    for capability in ("GL_LIGHTING", "GL_LIGHT0"):
        gl.glEnable(getattr(gl, capability))
    gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, 1)
    gl.glMaterialf(gl.GL_FRONT_AND_BACK, gl.GL_SHININESS, 8)
    gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, (0.0, 0.0, -2.0, 0.0))
    gl.glBegin(gl.GL_TRIANGLES)
    for corner in CORNERS[2::-1]:
        gl.glMaterialfv(gl.GL_BACK, gl.GL_DIFFUSE, (0.75, 0.5, 0.25, 1.0))
        gl.glVertex2f(*corner)
    gl.glEnd()


def triangle(gl: Any, mode: int, corners: list[tuple[float, float]]) -> None:
    gl.glBegin(mode)
    for corner in corners:
        gl.glVertex2f(*corner)
    gl.glEnd()


def late_color(gl: Any) -> None:
    gl.glNewList(1, gl.GL_COMPILE)
    gl.glBegin(gl.GL_TRIANGLE_STRIP)
    for index, corner in enumerate(CORNERS[:3]):
        if index == 1:
            gl.glColor3f(0.25, 0.5, 0.75)
        gl.glVertex2f(*corner)
    gl.glEnd()
    gl.glEndList()
    gl.glCallList(1)


def follows_back_only(calls: list[Call]) -> bool:
    two_sided = ("glLightModeli", ("GL_LIGHT_MODEL_TWO_SIDE", 1)) in calls
    follows = any(name == "glColorMaterial" and values[0] == "GL_BACK" for name, values in calls)
    return two_sided and follows and not all(is_plain(*call) for call in calls)


def gives_back_only(calls: list[Call]) -> bool:
    """Whether a back material changes inside glBegin and the front's does not, which GL_FRONT colour material holds."""
    two_sided = ("glLightModeli", ("GL_LIGHT_MODEL_TWO_SIDE", 1)) in calls
    faces = {"GL_BACK"}
    inside = given = False
    for name, values in calls:
        if name == "glColorMaterial" and values[0] == "GL_FRONT":
            faces.add("GL_FRONT_AND_BACK")
        inside = name == "glBegin" or (inside and name != "glEnd")
        given = given or (inside and name.startswith("glMaterial") and values[0] in faces)
    return two_sided and given and not all(is_plain(*call) for call in calls)


def is_plain(name: str, values: tuple[Any, ...]) -> bool:
    """Whether a call leaves lights directional and without highlights of their own: there Mesa's result is modelled."""
    positional = name.startswith("glLight") and values[1:2] == ("GL_POSITION",) and values[2][3] != 0
    shiny = name.startswith("glMaterial") and values[1:2] == ("GL_SHININESS",) and values[2] != 0
    separate = name.startswith("glLightModel") and values[0] == "GL_LIGHT_MODEL_COLOR_CONTROL"
    return not (positional or shiny or separate)


KNOWN = (
    KnownDifference(
        "unwritten registers",
        "green and blue of back faces in two-sided lighting, glColor inside glBegin, where glColorMaterial has GL_BACK "
        "alone and a light is positional or makes highlights",
        "Mesa reads registers that it has not written; what is in them depends on its compiler, not on the program",
        255,
        back_colors,
        follows_back_only,
    ),
    KnownDifference(
        "shiny backs",
        "green and blue of back faces in two-sided lighting, glMaterial inside glBegin for GL_BACK alone (or for both "
        "faces under glColorMaterial of GL_FRONT), where a light makes highlights",
        "as for unwritten registers: Mesa writes such products in red only",
        255,
        shiny_backs,
        gives_back_only,
    ),
)
FAULTS = (
    KnownDifference(
        "no place in the window",
        "a triangle with a vertex that is not outside any clip plane and has window coordinates beyond 2^23 or none: "
        "at (0, 0, 0, 0) or (inf, inf, inf, inf), or made with w = 0 by clipping an edge from w = -1e15, or between "
        "w = 1e-30 and w = 3e38",
        "Mesa's integers of 1/256 pixel overflow, and it fills parts of the window, or nothing; here the triangle is "
        "left out where its corners are not finite",
        255,
        no_place,
    ),
    KnownDifference(
        "rectangle and a level triangle",
        "colours and texture coordinates of three triangles drawn at once, the first two of which make a rectangle and "
        "the last is level in the window, in two of the orders of their corners",
        "Mesa draws the rectangle with the plane of its first triangle; here each triangle has its own",
        242,
        rectangle_and_level_triangle,
    ),
    KnownDifference(
        "late colour in a list",
        "a primitive in a display list that gives its first colour, normal or coordinate after its first vertex",
        "Mesa gives vertices the wrong colours or loses them, and with GL_COMPILE_AND_EXECUTE takes the calls that "
        "follow for the inside of the primitive",
        255,
        late_color,
    ),
)


def explanation(calls: list[Call], buffers: tuple[str, ...]) -> str:
    """Return the name of the known difference that explains why colours differ, or "": nothing else is excused."""
    colors_only = all(buffer == "color" or buffer.startswith("returned") for buffer in buffers)
    names = (known.name for known in KNOWN if colors_only and known.occurs_in(calls))
    return next(names, "")
