"""Random programs as a course on shadows writes them: random scenes, their shadows by every method.

Each program looks at boxes and triangles above a floor, lit by a light, and draws them in several passes: projected
onto the floor, with shadow volumes counted in the stencil buffer, with a shadow map, one light after the other, or as
the mean of many lights.
"""

import numpy as np

from mesa.random_writer import Writer

FLOOR = 1  # names of the display lists
CASTERS = 2
REACH = 5.0  # half of the floor's side
BOX = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]  # corners: bits z, y, x


def scene(writer: Writer) -> list[np.ndarray]:
    """Write lists of a floor and of casters, a camera and a light; return the casters' polygons, each (k, 3)."""
    polygons: list[np.ndarray] = []
    for _ in range(writer.integer(1, 3)):
        place = np.array([writer.number(-2, 2), writer.number(0.3, 2), writer.number(-2, 2)])
        if writer.chance(0.6):
            size = np.array([writer.number(0.2, 1) for _ in range(3)])
            corners = np.array([[(i >> 2) & 1, (i >> 1) & 1, i & 1] for i in range(8)]) * size + place
            polygons += [corners[list(face)].round(4) for face in BOX]
        else:
            polygons.append((place + writer.rng.uniform(-1, 1, (3, 3))).round(4))
    floor = REACH * np.array([(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)])
    for name, shapes in ((FLOOR, [floor]), (CASTERS, polygons)):
        writer.call("glNewList", name, "GL_COMPILE")
        for shape in shapes:
            polygon(writer, shape)
        writer.call("glEndList")
    return polygons


def polygon(writer: Writer, corners: np.ndarray) -> None:
    """Draw a polygon with its normal and one colour, or one for each corner."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    writer.call("glNormal3f", *(normal / max(np.linalg.norm(normal), 1e-6)).round(4).tolist())
    single = writer.chance(0.5)
    writer.call("glColor4f", *writer.color())
    writer.call("glBegin", "GL_POLYGON")
    for corner in corners.tolist():
        writer.call("glColor4f", *writer.color()) if not single else None
        writer.call("glVertex3f", *corner)
    writer.call("glEnd")


def view(writer: Writer) -> None:
    """Place the camera, and start from empty buffers and the usual state."""
    writer.call("glClearDepth", 1.0)
    writer.call("glClearStencil", 0)
    writer.call("glClear", "GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT")
    writer.call("glMatrixMode", "GL_PROJECTION")
    writer.call("glLoadIdentity")
    if writer.chance(0.8):
        aspect = round(writer.size[0] / writer.size[1], 4)
        writer.call(
            "gluPerspective", writer.number(30, 80), aspect, writer.pick([0.1, 1.0]), writer.pick([20.0, 100.0])
        )
    else:
        writer.call("glOrtho", -4.0, 4.0, -3.0, 3.0, 0.1, 30.0)
    writer.call("glMatrixMode", "GL_MODELVIEW")
    writer.call("glLoadIdentity")
    eye = [writer.number(-6, 6), writer.number(0.5, 6), writer.number(2, 7)]
    writer.call("gluLookAt", *eye, 0.0, 0.5, 0.0, 0.0, 1.0, 0.0)
    writer.call("glEnable", "GL_DEPTH_TEST")
    writer.call("glDepthFunc", writer.pick(["GL_LESS", "GL_LEQUAL"]))


def light_position(writer: Writer) -> list[float]:
    """Return a light above the casters: a point, or a direction."""
    w = writer.pick([1.0, 1.0, 0.0])
    return [writer.number(-3, 3), writer.number(4, 8), writer.number(-3, 3), w]


def lit_pass(writer: Writer, light: list[float], on: bool = True) -> None:
    """Draw everything with the light, or with ambient light only."""
    writer.call("glPushAttrib", "GL_LIGHTING_BIT | GL_ENABLE_BIT")
    for capability in ("GL_LIGHTING", "GL_COLOR_MATERIAL"):
        writer.call("glEnable", capability)
    writer.call("glEnable" if on else "glDisable", "GL_LIGHT0")
    writer.call("glLightfv", "GL_LIGHT0", "GL_POSITION", light)
    everything(writer)
    writer.call("glPopAttrib")


def everything(writer: Writer) -> None:
    writer.call("glCallList", FLOOR)
    writer.call("glCallList", CASTERS)


def flattening(light: list[float]) -> np.ndarray:
    """Return the matrix that projects from the light onto the plane y = 0, in OpenGL's memory order."""
    x, y, z, w = light
    columns = [(y, 0, 0, 0), (-x, 0, -z, -w), (0, 0, y, 0), (0, 0, 0, y)]
    return np.array(columns, np.float64).reshape(-1)


# -- planar shadows ----------------------------------------------------------------------------------------------------
def planar_shadow(writer: Writer, wild: bool) -> None:
    """Blend the flattened casters onto the floor: with polygon offset, or once a pixel where the stencil has it."""
    scene(writer)
    light = light_position(writer)
    marked, dark = writer.chance(0.6), writer.number(0.2, 0.9)
    if marked:
        writer.call("glEnable", "GL_STENCIL_TEST")
        writer.call("glStencilFunc", "GL_ALWAYS", 1, 255)
        writer.call("glStencilOp", "GL_KEEP", "GL_KEEP", "GL_REPLACE")
    writer.call("glCallList", FLOOR)
    if marked:
        writer.call("glStencilFunc", "GL_EQUAL", 1, 255)
        writer.call("glStencilOp", "GL_KEEP", "GL_KEEP", writer.pick(["GL_ZERO", "GL_INCR"]))
    if writer.chance(0.5):
        writer.call("glDisable", "GL_DEPTH_TEST")
    else:
        writer.call("glEnable", "GL_POLYGON_OFFSET_FILL")
        writer.call("glPolygonOffset", writer.pick([-1.0, 0.0]), writer.pick([-1.0, -4.0]))
    if writer.switch("GL_BLEND", 0.6):
        writer.call("glBlendFunc", "GL_SRC_ALPHA", "GL_ONE_MINUS_SRC_ALPHA")
    flat_color(writer, light, dark)
    for capability in ("GL_BLEND", "GL_POLYGON_OFFSET_FILL", "GL_STENCIL_TEST"):
        writer.call("glDisable", capability)
    writer.call("glEnable", "GL_DEPTH_TEST")
    lit_pass(writer, light, writer.chance(0.7))


def flat_color(writer: Writer, light: list[float], dark: float) -> None:
    """Draw the flattened casters in one colour, that of lighting without lights."""
    writer.call("glEnable", "GL_LIGHTING")
    writer.call("glLightModelfv", "GL_LIGHT_MODEL_AMBIENT", [0.0, 0.0, 0.0, 1.0])
    writer.call("glMaterialfv", "GL_FRONT_AND_BACK", "GL_DIFFUSE", [0.0, 0.0, 0.0, dark])
    writer.call("glPushMatrix")
    writer.call("glMultMatrixd", flattening(light))
    writer.call("glCallList", CASTERS)
    writer.call("glPopMatrix")
    writer.call("glDisable", "GL_LIGHTING")


# -- shadow volumes ----------------------------------------------------------------------------------------------------
def shadow_volumes(writer: Writer, wild: bool) -> None:
    """Count shadow volumes in front of what is seen or behind it, in two passes or in one that has two sides."""
    polygons, light = scene(writer), light_position(writer)
    lit_pass(writer, light, on=False)
    behind = writer.chance(0.5)
    writer.call("glPushAttrib", "GL_ALL_ATTRIB_BITS")
    writer.call("glColorMask", *["GL_FALSE"] * 4)
    writer.call("glDepthMask", "GL_FALSE")
    writer.call("glDepthFunc", "GL_LESS")
    writer.switch("GL_DEPTH_CLAMP", 0.4)
    writer.call("glEnable", "GL_STENCIL_TEST")
    writer.call("glStencilFunc", "GL_ALWAYS", 0, 0xFFFFFFFF)
    up, down = writer.pick([("GL_INCR", "GL_DECR"), ("GL_INCR_WRAP", "GL_DECR_WRAP")])
    first, second = ("GL_BACK", "GL_FRONT") if behind else ("GL_FRONT", "GL_BACK")
    if writer.chance(0.5):
        for face, op in ((first, up), (second, down)):
            ops = ("GL_KEEP", op, "GL_KEEP") if behind else ("GL_KEEP", "GL_KEEP", op)
            writer.call("glStencilOpSeparate", face, *ops)
        volumes(writer, polygons, light)
    else:
        writer.call("glEnable", "GL_CULL_FACE")
        for face, op in ((second, up), (first, down)):
            writer.call("glCullFace", face)
            writer.call("glStencilOp", "GL_KEEP", *((op, "GL_KEEP") if behind else ("GL_KEEP", op)))
            volumes(writer, polygons, light)
    writer.call("glPopAttrib")
    writer.call("glPushAttrib", "GL_STENCIL_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT | GL_ENABLE_BIT")
    writer.call("glEnable", "GL_STENCIL_TEST")
    writer.call("glStencilFunc", "GL_EQUAL", 0, 255)
    writer.call("glStencilOp", *["GL_KEEP"] * 3)
    writer.call("glDepthFunc", writer.pick(["GL_EQUAL", "GL_LEQUAL"]))
    if writer.switch("GL_BLEND", 0.6):
        writer.call("glBlendFunc", "GL_ONE", "GL_ONE")
    lit_pass(writer, light)
    writer.call("glPopAttrib")


def volumes(writer: Writer, polygons: list[np.ndarray], light: list[float]) -> None:
    """Draw the volume of every polygon, away from the light, to infinity: sides, the polygon, and its far image."""
    position = np.array(light)
    for corners in polygons:
        near = np.hstack([corners, np.ones((len(corners), 1))])
        far = near * position[3] - position
        far[:, 3] = 0
        away = (
            np.cross(corners[1] - corners[0], corners[2] - corners[0]) @ (position[:3] - position[3] * corners[0]) < 0
        )
        if away:
            near, far = near[::-1], far[::-1]
        sides = np.stack([near, far], axis=1).reshape(-1, 4)
        _vertices(writer, "GL_POLYGON", near)
        _vertices(writer, "GL_POLYGON", far[::-1])
        _vertices(writer, "GL_QUAD_STRIP", np.vstack([sides, sides[:2]]))


def _vertices(writer: Writer, mode: str, vertices: np.ndarray) -> None:
    writer.call("glBegin", mode)
    for vertex in vertices.round(4).tolist():
        writer.call("glVertex4f", *vertex)
    writer.call("glEnd")


# -- shadow maps -------------------------------------------------------------------------------------------------------
def shadow_mapped(writer: Writer, wild: bool) -> None:
    """Depth as the light sees it, drawn off the screen or copied from the window, then compared in the lit pass."""
    scene(writer)
    light = light_position(writer)
    side = 32
    writer.call("glBindTexture", "GL_TEXTURE_2D", "texture 0")
    kind = writer.pick(
        ["GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT16", "GL_DEPTH_COMPONENT32F"]
    )
    writer.call("glTexImage2D", "GL_TEXTURE_2D", 0, kind, side, side, 0, "GL_DEPTH_COMPONENT", "GL_UNSIGNED_BYTE", None)
    writer.sampler(["GL_CLAMP_TO_EDGE", "GL_CLAMP_TO_BORDER", "GL_CLAMP"])
    for name, value in (
        ("GL_TEXTURE_COMPARE_MODE", "GL_COMPARE_R_TO_TEXTURE"),
        ("GL_TEXTURE_COMPARE_FUNC", writer.pick(["GL_LEQUAL", "GL_LESS", "GL_GEQUAL"])),
        ("GL_DEPTH_TEXTURE_MODE", writer.pick(["GL_INTENSITY", "GL_LUMINANCE", "GL_ALPHA"])),
    ):
        writer.call("glTexParameteri", "GL_TEXTURE_2D", name, value)
    angle = writer.number(60, 110)
    copied = writer.chance(0.5) and min(writer.size) >= side
    if not copied:
        writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", "framebuffer 0")
        writer.call("glFramebufferTexture2D", "GL_FRAMEBUFFER", "GL_DEPTH_ATTACHMENT", "GL_TEXTURE_2D", "texture 0", 0)
        writer.call("glDrawBuffer", "GL_NONE")
        writer.call("glReadBuffer", "GL_NONE")
    _map_pass(writer, light, angle, side)
    if copied:
        writer.call("glCopyTexSubImage2D", "GL_TEXTURE_2D", 0, 0, 0, 0, 0, side, side)
    writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", 0)
    writer.call("glViewport", 0, 0, *writer.size)
    writer.call("glClear", "GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT")
    _projected_coordinates(writer, light, angle)
    writer.call("glEnable", "GL_TEXTURE_2D")
    if writer.switch("GL_ALPHA_TEST", 0.3):
        writer.call("glAlphaFunc", "GL_GEQUAL", 0.6)
    lit_pass(writer, light)
    for capability in ("GL_TEXTURE_2D", "GL_ALPHA_TEST", *(f"GL_TEXTURE_GEN_{name}" for name in "STRQ")):
        writer.call("glDisable", capability)


def _map_pass(writer: Writer, light: list[float], angle: float, side: int) -> None:
    writer.call("glPushAttrib", "GL_VIEWPORT_BIT | GL_POLYGON_BIT | GL_ENABLE_BIT | GL_COLOR_BUFFER_BIT")
    writer.call("glViewport", 0, 0, side, side)
    writer.call("glClear", "GL_DEPTH_BUFFER_BIT")
    writer.call("glColorMask", *["GL_FALSE"] * 4)
    if writer.switch("GL_POLYGON_OFFSET_FILL", 0.7):
        writer.call("glPolygonOffset", writer.pick([1.0, 1.1, 2.0]), writer.pick([1.0, 4.0]))
    if writer.switch("GL_CULL_FACE", 0.3):
        writer.call("glCullFace", "GL_FRONT")
    for mode in ("GL_PROJECTION", "GL_MODELVIEW"):
        writer.call("glMatrixMode", mode)
        writer.call("glPushMatrix")
        writer.call("glLoadIdentity")
        _light_camera(writer, light, angle, mode)
    everything(writer)
    for mode in ("GL_PROJECTION", "GL_MODELVIEW"):
        writer.call("glMatrixMode", mode)
        writer.call("glPopMatrix")
    writer.call("glPopAttrib")


def _light_camera(writer: Writer, light: list[float], angle: float, mode: str) -> None:
    if mode == "GL_MODELVIEW":
        writer.call("gluLookAt", *light[:3], 0.0, 0.0, 0.0, 0.0, 0.1, 1.0)
    elif light[3]:
        writer.call("gluPerspective", angle, 1.0, 1.0, 20.0)
    else:
        writer.call("glOrtho", -4.0, 4.0, -4.0, 4.0, 1.0, 20.0)


def _projected_coordinates(writer: Writer, light: list[float], angle: float) -> None:
    """Let eye coordinates go through the light's camera: as the texture matrix, planes being those of the identity."""
    for number, name in enumerate("STRQ"):
        writer.call("glTexGeni", f"GL_{name}", "GL_TEXTURE_GEN_MODE", "GL_EYE_LINEAR")
        writer.call("glTexGenfv", f"GL_{name}", "GL_EYE_PLANE", [float(i == number) for i in range(4)])
        writer.call("glEnable", f"GL_TEXTURE_GEN_{name}")
    writer.call("glMatrixMode", "GL_TEXTURE")
    writer.call("glLoadIdentity")
    writer.call("glTranslatef", 0.5, 0.5, 0.5)
    writer.call("glScalef", 0.5, 0.5, 0.5)
    for mode in ("GL_PROJECTION", "GL_MODELVIEW"):
        _light_camera(writer, light, angle, mode)
    writer.call("glMatrixMode", "GL_MODELVIEW")


# -- many lights -------------------------------------------------------------------------------------------------------
def lights_one_by_one(writer: Writer, wild: bool) -> None:
    """An ambient pass, then one of each light, added where the depth is that of the first."""
    scene(writer)
    lit_pass(writer, light_position(writer), on=False)
    writer.call("glPushAttrib", "GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT | GL_ENABLE_BIT | GL_SCISSOR_BIT")
    writer.call("glDepthFunc", "GL_EQUAL")
    writer.call("glDepthMask", "GL_FALSE")
    writer.call("glEnable", "GL_BLEND")
    writer.call(
        "glBlendFunc", *writer.pick([("GL_ONE", "GL_ONE"), ("GL_SRC_ALPHA", "GL_ONE"), ("GL_DST_COLOR", "GL_ONE")])
    )
    for _ in range(writer.integer(1, 3)):
        writer.call("glLightfv", "GL_LIGHT0", "GL_DIFFUSE", list(writer.color()))
        if writer.switch("GL_SCISSOR_TEST", 0.3):
            box = writer.integer(0, writer.size[0] // 2), writer.integer(0, writer.size[1] // 2)
            writer.call("glScissor", *box, *box)
        lit_pass(writer, light_position(writer))
    writer.call("glPopAttrib")


def soft_shadow(writer: Writer, wild: bool) -> None:
    """The mean of pictures with hard planar shadows, from lights around one place."""
    scene(writer)
    middle, count = light_position(writer), writer.integer(2, 5)
    for number in range(count):
        light = [middle[0] + 0.3 * number, middle[1], middle[2] - 0.2 * number, middle[3]]
        writer.call("glClear", "GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT")
        lit_pass(writer, light)
        writer.call("glDisable", "GL_DEPTH_TEST")
        flat_color(writer, light, 1.0)
        writer.call("glEnable", "GL_DEPTH_TEST")
        writer.call("glAccum", "GL_LOAD" if number == 0 else "GL_ACCUM", round(1 / count, 6))
    writer.call("glAccum", "GL_RETURN", 1.0)
