"""Drawing routines in the style of the Red Book and of extension demos, without GLUT."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

PLANE = (0.0, 1.0, 0.0, 0.0)
LIGHT = (2.0, 4.0, 1.5, 1.0)
CUBE = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
FACES = [
    ((-1, 0, 0), (0, 1, 3, 2)), ((1, 0, 0), (4, 6, 7, 5)), ((0, -1, 0), (0, 4, 5, 1)),
    ((0, 1, 0), (2, 3, 7, 6)), ((0, 0, -1), (0, 2, 6, 4)), ((0, 0, 1), (1, 5, 7, 3)),
]  # fmt: skip


def init(gl: Any, width: int, height: int) -> None:
    gl.glViewport(0, 0, width, height)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    gl.gluPerspective(40.0, width / height, 1.0, 30.0)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    gl.gluLookAt(3.0, 4.0, 8.0, 0.0, 0.5, 0.0, 0.0, 1.0, 0.0)
    gl.glClearColor(0.15, 0.25, 0.45, 0.0)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_CULL_FACE)


def solid_cube(gl: Any, size: float) -> None:
    gl.glPushMatrix()
    gl.glScalef(size / 2, size / 2, size / 2)
    gl.glBegin(gl.GL_QUADS)
    for normal, corners in FACES:
        gl.glNormal3iv(np.array(normal) * 2147483647)
        for corner in corners:
            gl.glVertex3iv(CUBE[corner])
    gl.glEnd()
    gl.glPopMatrix()


def disk(gl: Any, radius: float, slices: int = 12) -> None:
    gl.glBegin(gl.GL_TRIANGLE_FAN)
    gl.glNormal3f(0, 1, 0)
    gl.glVertex3f(0, 0, 0)
    for i in range(slices + 1):
        angle = -2 * math.pi * i / slices
        gl.glVertex3d(radius * math.cos(angle), 0, radius * math.sin(angle))
    gl.glEnd()


def floor(gl: Any) -> None:
    gl.glBegin(gl.GL_QUAD_STRIP)
    for x in range(-3, 4):
        gl.glColor3ub(*((200, 210, 90) if x % 2 else (90, 120, 200)))
        gl.glVertex3i(x, 0, -3)
        gl.glVertex3i(x, 0, 3)
    gl.glEnd()


def casters(gl: Any) -> None:
    gl.glPushMatrix()
    gl.glTranslated(0.3, 1.1, 0.2)
    gl.glRotated(35, 1, 2, 0.5)
    gl.glColor4f(0.8, 0.3, 0.2, 0.7)
    solid_cube(gl, 1.2)
    gl.glPopMatrix()


def shadow_matrix(plane: tuple[float, ...], light: tuple[float, ...]) -> list[list[float]]:
    dot = sum(p * q for p, q in zip(plane, light, strict=True))
    return [[(dot if i == j else 0.0) - light[i] * plane[j] for i in range(4)] for j in range(4)]


def reflection(gl: Any, size: tuple[int, int]) -> None:
    """A mirrored scene inside the floor's stencil, the floor blended over it, then the scene."""
    init(gl, *size)
    gl.glClearStencil(0)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilOp(gl.GL_REPLACE, gl.GL_REPLACE, gl.GL_REPLACE)
    gl.glStencilFunc(gl.GL_ALWAYS, 1, 0xFFFFFFFF)
    gl.glDisable(gl.GL_CULL_FACE)
    disk(gl, 2.5)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glStencilFunc(gl.GL_EQUAL, 1, 0xFFFFFFFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
    gl.glPushMatrix()
    gl.glScalef(1.0, -1.0, 1.0)
    gl.glClipPlane(gl.GL_CLIP_PLANE0, (0.0, 1.0, 0.0, 0.0))
    gl.glEnable(gl.GL_CLIP_PLANE0)
    gl.glEnable(gl.GL_NORMALIZE)
    gl.glEnable(gl.GL_CULL_FACE)
    gl.glCullFace(gl.GL_FRONT)
    casters(gl)
    gl.glDisable(gl.GL_NORMALIZE)
    gl.glDisable(gl.GL_CLIP_PLANE0)
    gl.glCullFace(gl.GL_BACK)
    gl.glPopMatrix()
    gl.glDisable(gl.GL_STENCIL_TEST)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    gl.glColor4f(0.7, 0.0, 0.0, 0.3)
    gl.glDisable(gl.GL_CULL_FACE)
    disk(gl, 2.5)
    gl.glDisable(gl.GL_BLEND)
    casters(gl)
    gl.glFinish()


def planar_shadow(gl: Any, size: tuple[int, int]) -> None:
    """A scene in a display list, drawn again through a shadow matrix, once per pixel by the stencil test."""
    init(gl, *size)
    scene = gl.glGenLists(1)
    gl.glNewList(scene, gl.GL_COMPILE)
    casters(gl)
    gl.glEndList()
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glShadeModel(gl.GL_FLAT)
    floor(gl)
    gl.glPushAttrib(gl.GL_ENABLE_BIT | gl.GL_CURRENT_BIT | gl.GL_POLYGON_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_EQUAL, 0, ~0)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glPolygonOffset(-1.0, -2.0)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_ZERO, gl.GL_SRC_COLOR)
    gl.glPushMatrix()
    gl.glMultMatrixf(shadow_matrix(PLANE, LIGHT))
    gl.glCallList(scene)
    gl.glPopMatrix()
    gl.glPopAttrib()
    gl.glCallLists([scene])
    gl.glDeleteLists(scene, 1)


def shadow_map(gl: Any, size: tuple[int, int]) -> None:
    """A depth texture copied from the window, eye planes for its coordinates, ARB_shadow's comparison, alpha test."""
    width, height = size
    init(gl, width, height)
    light_projection, light_view = np.eye(4), np.eye(4)
    gl.glPushMatrix()
    gl.glLoadIdentity()
    gl.gluPerspective(60.0, 1.0, 1.5, 9.0)
    light_projection = gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)
    gl.glLoadIdentity()
    gl.gluLookAt(*LIGHT[:3], 0, 0, 0, 0, 1, 0)
    light_view = gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)
    gl.glPopMatrix()
    resolution = 32
    texture = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
    gl.glTexImage2D(
        gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT24_ARB, resolution, resolution, 0, gl.GL_DEPTH_COMPONENT,
        gl.GL_UNSIGNED_INT, None,
    )  # fmt: skip
    for name, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR), (gl.GL_TEXTURE_MAG_FILTER, gl.GL_LINEAR),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP), (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP),
        (gl.GL_TEXTURE_COMPARE_MODE_ARB, gl.GL_COMPARE_R_TO_TEXTURE_ARB),
        (gl.GL_TEXTURE_COMPARE_FUNC_ARB, gl.GL_LEQUAL), (gl.GL_DEPTH_TEXTURE_MODE_ARB, gl.GL_INTENSITY),
    ):  # fmt: skip
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, value)
    # 1: from the light
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    for mode, matrix in ((gl.GL_PROJECTION, light_projection), (gl.GL_MODELVIEW, light_view)):
        gl.glMatrixMode(mode)
        gl.glPushMatrix()
        gl.glLoadMatrixf(matrix)
    gl.glViewport(0, 0, resolution, resolution)
    gl.glCullFace(gl.GL_FRONT)
    gl.glColorMask(0, 0, 0, 0)
    casters(gl)
    gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, resolution, resolution)
    gl.glCullFace(gl.GL_BACK)
    gl.glColorMask(1, 1, 1, 1)
    for mode in (gl.GL_PROJECTION, gl.GL_MODELVIEW):
        gl.glMatrixMode(mode)
        gl.glPopMatrix()
    # 2: dim, from the eye
    gl.glViewport(0, 0, width, height)
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
    gl.glDisable(gl.GL_CULL_FACE)
    floor(gl)
    casters(gl)
    # 3: bright where the light reaches
    bias = np.array([0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0.5, 0.5, 0.5, 1], np.float32).reshape(4, 4)
    rows = (np.array(light_view) @ np.array(light_projection) @ bias).T
    for coordinate, capability, row in zip("STRQ", "STRQ", rows, strict=True):
        coordinate_token = getattr(gl, f"GL_{coordinate}")
        gl.glTexGeni(coordinate_token, gl.GL_TEXTURE_GEN_MODE, gl.GL_EYE_LINEAR)
        gl.glTexGenfv(coordinate_token, gl.GL_EYE_PLANE, row)
        gl.glEnable(getattr(gl, f"GL_TEXTURE_GEN_{capability}"))
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glAlphaFunc(gl.GL_GEQUAL, 0.6)
    gl.glEnable(gl.GL_ALPHA_TEST)
    gl.glDepthFunc(gl.GL_LEQUAL)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
    floor(gl)
    casters(gl)


def motion_blur(gl: Any, size: tuple[int, int]) -> None:
    """Five positions of a cube, averaged in the accumulation buffer."""
    init(gl, *size)
    gl.glClearAccum(0.0, 0.0, 0.0, 0.0)
    gl.glClear(gl.GL_ACCUM_BUFFER_BIT)
    for frame in range(5):
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glPushMatrix()
        gl.glRotatef(6.0 * frame, 0.0, 1.0, 0.0)
        floor(gl)
        gl.glTranslatef(0.15 * frame, 0.0, 0.0)
        casters(gl)
        gl.glPopMatrix()
        gl.glAccum(gl.GL_ACCUM, 1.0 / 5)
    gl.glAccum(gl.GL_RETURN, 1.0)


def multitexture(gl: Any, size: tuple[int, int]) -> None:
    """A checkerboard under a light map on two ARB units, the second added by GL_COMBINE."""
    init(gl, *size)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    row, column = np.mgrid[:16, :16]
    checks = np.repeat((((row // 4) ^ (column // 4)) & 1)[..., None] * 255, 3, 2).astype(np.uint8)
    spot = np.clip(255 - 4 * ((row - 8) ** 2 + (column - 8) ** 2), 0, 255).astype(np.uint8)
    textures = gl.glGenTextures(2)
    gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
    for unit, (form, image) in enumerate(((gl.GL_RGB, checks), (gl.GL_LUMINANCE, spot))):
        gl.glActiveTextureARB(gl.GL_TEXTURE0_ARB + unit)
        gl.glBindTexture(gl.GL_TEXTURE_2D, textures[unit])
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, form, 16, 16, 0, form, gl.GL_UNSIGNED_BYTE, image)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR if unit else gl.GL_NEAREST)
        gl.glTexParameterf(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE if unit else gl.GL_REPEAT)
        gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_COMBINE_ARB)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_COMBINE_RGB_ARB, gl.GL_ADD_SIGNED_ARB)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_SOURCE1_RGB_ARB, gl.GL_PREVIOUS_ARB)
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glTranslatef(0.1, -0.05, 0)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glBegin(gl.GL_QUADS)
    for x, z in ((-3, -3), (-3, 3), (3, 3), (3, -3)):
        gl.glMultiTexCoord2fARB(gl.GL_TEXTURE0_ARB, x, z)
        gl.glMultiTexCoord2fvARB(gl.GL_TEXTURE1_ARB, [x / 6 + 0.5, z / 6 + 0.5])
        gl.glVertex3f(x, 0, z)
    gl.glEnd()
    gl.glActiveTextureARB(gl.GL_TEXTURE1_ARB)
    gl.glDisable(gl.GL_TEXTURE_2D)
    casters(gl)


def constructive_geometry(gl: Any, size: tuple[int, int]) -> None:
    """A cube minus another one by counting their faces in the stencil buffer (red book, chapter 14)."""
    init(gl, *size)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    a = (lambda: gl.glColor3f(0.9, 0.8, 0.2), 0.0, 2.0)
    b = (lambda: gl.glColor3f(0.2, 0.6, 0.9), 0.9, 1.4)

    def draw(solid: tuple[Callable[[], None], float, float]) -> None:
        gl.glPushMatrix()
        gl.glTranslatef(solid[1], solid[1] + 0.2, solid[1])
        gl.glRotatef(20, 0, 1, 0)
        solid[0]()
        solid_cube(gl, solid[2])
        gl.glPopMatrix()

    def inside(first: Any, second: Any, face: int, test: int) -> None:
        """Draw the faces of the first solid that lie inside, or outside, the second."""
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glColorMask(0, 0, 0, 0)
        gl.glCullFace(face)
        draw(first)
        gl.glDepthMask(gl.GL_FALSE)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 0)
        for cull, op in ((gl.GL_BACK, gl.GL_INCR), (gl.GL_FRONT, gl.GL_DECR)):
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, op)
            gl.glCullFace(cull)
            draw(second)
        gl.glDepthMask(gl.GL_TRUE)
        gl.glColorMask(1, 1, 1, 1)
        gl.glStencilFunc(test, 0, 1)
        gl.glDisable(gl.GL_DEPTH_TEST)
        gl.glCullFace(face)
        draw(first)
        gl.glDisable(gl.GL_STENCIL_TEST)

    inside(b, a, gl.GL_FRONT, gl.GL_NOTEQUAL)
    gl.glColorMask(0, 0, 0, 0)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glDepthFunc(gl.GL_ALWAYS)
    gl.glCullFace(gl.GL_BACK)
    draw(a)
    gl.glDepthFunc(gl.GL_LESS)
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    inside(a, b, gl.GL_BACK, gl.GL_EQUAL)


def lit_volume(gl: Any, size: tuple[int, int]) -> None:
    """A lit scene in vertex arrays, its shadow volume counted with EXT_stencil_two_side, lit again where it is 0."""
    init(gl, *size)
    for pname, value in ((gl.GL_POSITION, LIGHT), (gl.GL_DIFFUSE, (0.9, 0.9, 0.8, 1)), (gl.GL_SPECULAR, (1, 1, 1, 1))):
        gl.glLightfv(gl.GL_LIGHT0, pname, value)
    gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, (0.3, 0.3, 0.4, 1.0))
    gl.glEnable(gl.GL_LIGHTING)
    gl.glColorMaterial(gl.GL_FRONT_AND_BACK, gl.GL_AMBIENT_AND_DIFFUSE)
    gl.glEnable(gl.GL_COLOR_MATERIAL)

    def scene() -> None:
        gl.glNormal3f(0, 1, 0)
        gl.glFrontFace(gl.GL_CW)
        floor(gl)
        gl.glFrontFace(gl.GL_CCW)
        casters(gl)

    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    scene()
    gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glColorMask(0, 0, 0, 0)
    gl.glDepthMask(0)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glEnable(gl.GL_STENCIL_TEST_TWO_SIDE_EXT)
    for face, op in ((gl.GL_BACK, gl.GL_DECR_WRAP_EXT), (gl.GL_FRONT, gl.GL_INCR_WRAP_EXT)):
        gl.glActiveStencilFaceEXT(face)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, op)
        gl.glStencilMask(~0)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, ~0)
    near = np.array([[-0.4, 1.2, -0.3], [0.7, 1.0, -0.4], [0.4, 1.3, 0.6]], np.float32)
    light = np.array(LIGHT[:3], np.float32)
    far = np.hstack([near - light, np.zeros((3, 1), np.float32)])
    corners = np.vstack([np.hstack([near, np.ones((3, 1), np.float32)]), far])
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(4, gl.GL_FLOAT, 0, corners)
    gl.glDrawElements(gl.GL_QUADS, 12, gl.GL_UNSIGNED_INT, [0, 3, 4, 1, 1, 4, 5, 2, 2, 5, 3, 0])
    gl.glDisableClientState(gl.GL_VERTEX_ARRAY)
    gl.glPopAttrib()
    gl.glEnable(gl.GL_LIGHT0)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_EQUAL, 0, ~0)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
    gl.glDepthFunc(gl.GL_EQUAL)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
    scene()


PASTED = {
    program.__name__: program
    for program in (
        reflection, planar_shadow, shadow_map, motion_blur, multitexture, constructive_geometry, lit_volume,
    )
}  # fmt: skip
