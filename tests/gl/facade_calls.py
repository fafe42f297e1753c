"""A valid call of every function of `softshadow.gl`, and calls of it with wrong arguments.

Arguments are data: tokens by name, objects by what `World` calls them ("@texture"), everything else as it is.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from gl.more_facade_calls import MORE_CALLS

BYTES = np.zeros((4, 4, 4), np.uint8)
CORNERS = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], np.float32)
INDICES = np.array([0, 1, 2], np.uint32)
ANSWER = np.zeros(4, np.float32)
TABLE, UINTS, USHORTS = (np.array([0, 1, 1, 0]).astype(kind) for kind in (np.float32, np.uint32, np.uint16))
MATRIX = [float(number) for number in (2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1)]
TEXELS = ("GL_RGBA", "GL_UNSIGNED_BYTE")

SINGLE: dict[str, tuple[Any, ...]] = {
    "glAccum": ("GL_LOAD", 1.0), "glArrayElement": (1,), "glBindBuffer": ("GL_ARRAY_BUFFER", "@buffer"),
    "glBufferData": ("GL_ELEMENT_ARRAY_BUFFER", 12, INDICES, "GL_STATIC_DRAW"),
    "glBufferSubData": ("GL_ELEMENT_ARRAY_BUFFER", 4, 4, INDICES), "glDeleteBuffers": (1, ["@buffer"]),
    "glMapBuffer": ("GL_ELEMENT_ARRAY_BUFFER", "GL_READ_WRITE"), "glUnmapBuffer": ("GL_ELEMENT_ARRAY_BUFFER",),
    "glMapBufferRange": ("GL_ELEMENT_ARRAY_BUFFER", 0, 8, "GL_MAP_READ_BIT"),
    "glFlushMappedBufferRange": ("GL_ELEMENT_ARRAY_BUFFER", 0, 4),
    "glGetBufferPointerv": ("GL_ELEMENT_ARRAY_BUFFER", "GL_BUFFER_MAP_POINTER"),
    "glPixelTransferf": ("GL_RED_SCALE", 0.5), "glPixelTransferi": ("GL_MAP_COLOR", 1),
    "glPixelMapfv": ("GL_PIXEL_MAP_R_TO_R", 4, TABLE), "glPixelMapuiv": ("GL_PIXEL_MAP_S_TO_S", 4, UINTS),
    "glPixelMapusv": ("GL_PIXEL_MAP_I_TO_A", 4, USHORTS), "glGetPixelMapfv": ("GL_PIXEL_MAP_R_TO_R",),
    "glGetPixelMapuiv": ("GL_PIXEL_MAP_R_TO_R",), "glGetPixelMapusv": ("GL_PIXEL_MAP_R_TO_R",),
    "glDrawElementsub": ("GL_TRIANGLES", INDICES), "glDrawElementsui": ("GL_TRIANGLES", INDICES),
    "glDrawElementsus": ("GL_TRIANGLES", INDICES),
    "glDrawRangeElements": ("GL_TRIANGLES", 0, 2, 3, "GL_UNSIGNED_INT", INDICES), "glGenBuffers": (2,),
    "glGetBufferParameteriv": ("GL_ELEMENT_ARRAY_BUFFER", "GL_BUFFER_SIZE"),
    "glGetBufferSubData": ("GL_ELEMENT_ARRAY_BUFFER", 0, 4),
    "glGetRenderbufferParameteriv": ("GL_RENDERBUFFER", "GL_RENDERBUFFER_WIDTH"),
    "glInterleavedArrays": ("GL_C4UB_V3F", 0, np.zeros(48, np.uint8)), "glIsBuffer": ("@buffer",),
    "glMultiDrawArrays": ("GL_TRIANGLES", np.array([0, 1], np.int32), np.array([3, 2], np.int32), 2),
    "glMultiDrawElements": ("GL_TRIANGLES", np.array([3, 3], np.int32), "GL_UNSIGNED_INT", [INDICES, INDICES], 2),
    "glSampleCoverage": (0.5, True),
    "glPopClientAttrib": (), "glPushClientAttrib": ("GL_CLIENT_VERTEX_ARRAY_BIT",),
    "glColor": (0.5, 0.25, 0.75), "glVertex": (0.5, 0.25, 0.75), "glRasterPos": (0.5, 0.25, 0.75),
    "glMaterial": ("GL_FRONT", "GL_DIFFUSE", [1, 0, 1, 0]),
    "glTexParameter": ("GL_TEXTURE_2D", "GL_TEXTURE_MIN_FILTER", "GL_NEAREST"),
 "glActiveStencilFaceEXT": ("GL_BACK",),
    "glStencilFuncSeparateATI": ("GL_LESS", "GL_EQUAL", 2, 15),
    "glActiveTexture": ("GL_TEXTURE1",), "glAlphaFunc": ("GL_LESS", 0.5),
    "glBitmap": (8, 4, 0.0, 0.0, 2.0, 0.0, bytes(32)), "glPixelZoom": (2.0, -1.5),
    "glCopyPixels": (0, 0, 4, 4, "GL_COLOR"), "glDrawPixels": (4, 4, *TEXELS, BYTES),
    "glBegin": ("GL_QUADS",), "glBeginQuery": ("GL_SAMPLES_PASSED", "@query"),
    "glBindFramebuffer": ("GL_FRAMEBUFFER", "@framebuffer"), "glBindRenderbuffer": ("GL_RENDERBUFFER", "@renderbuffer"),
    "glBindTexture": ("GL_TEXTURE_2D", "@texture"), "glBlendColor": (0.1, 0.2, 0.3, 0.4),
    "glBlendEquation": ("GL_MIN",),
    "glBlendEquationSeparate": ("GL_MIN", "GL_FUNC_ADD"), "glBlendFunc": ("GL_SRC_ALPHA", "GL_ONE_MINUS_SRC_ALPHA"),
    "glBlendFuncSeparate": ("GL_ONE", "GL_SRC_COLOR", "GL_DST_ALPHA", "GL_SRC_ALPHA"),
    "glBlitFramebuffer": (0, 0, 2, 2, 4, 4, 6, 6, "GL_COLOR_BUFFER_BIT", "GL_NEAREST"), "glCallList": (1,),
    "glCallLists": ([1, 2],), "glCheckFramebufferStatus": ("GL_FRAMEBUFFER",), "glClear": ("GL_COLOR_BUFFER_BIT",),
    "glClearAccum": (0.1, 0.2, 0.3, 0.4), "glClearColor": (0.1, 0.2, 0.3, 0.4), "glClearDepth": (0.5,),
    "glClearStencil": (3,), "glClientActiveTexture": ("GL_TEXTURE1",), "glClipPlane": ("GL_CLIP_PLANE1", [1, 2, 3, 4]),
    "glColorMask": (1, 0, 1, 0), "glColorMaterial": ("GL_FRONT", "GL_SPECULAR"),
    "glColorPointer": (3, "GL_FLOAT", 0, CORNERS),
    "glCopyTexImage1D": ("GL_TEXTURE_1D", 0, "GL_RGBA8", 0, 0, 2, 0),
    "glCopyTexSubImage1D": ("GL_TEXTURE_1D", 0, 1, 0, 0, 1),
    "glCopyTexSubImage3D": ("GL_TEXTURE_3D", 0, 1, 1, 0, 0, 0, 1, 1),
    "glCopyTexImage2D": ("GL_TEXTURE_2D", 0, "GL_RGBA8", 0, 0, 2, 2, 0),
    "glCopyTexSubImage2D": ("GL_TEXTURE_2D", 0, 1, 1, 0, 0, 2, 2), "glCullFace": ("GL_FRONT",),
    "glDeleteFramebuffers": (1, ["@framebuffer"]), "glDeleteLists": (1, 1), "glDeleteQueries": (1, ["@query"]),
    "glDeleteRenderbuffers": (1, ["@renderbuffer"]), "glDeleteTextures": (1, ["@texture"]),
    "glDepthFunc": ("GL_GREATER",), "glDepthMask": (False,), "glDepthRange": (0.25, 0.75), "glDisable": ("GL_DITHER",),
    "glDisableClientState": ("GL_COLOR_ARRAY",), "glDrawArrays": ("GL_TRIANGLES", 0, 3), "glDrawBuffer": ("GL_NONE",),
    "glDrawBuffers": (1, ["GL_NONE"]), "glDrawElements": ("GL_TRIANGLES", 3, "GL_UNSIGNED_INT", INDICES),
    "glEnable": ("GL_BLEND",), "glEnableClientState": ("GL_NORMAL_ARRAY",), "glEnd": (), "glEndList": (),
    "glEndQuery": ("GL_SAMPLES_PASSED",), "glFinish": (), "glFlush": (),
    "glFramebufferRenderbuffer": ("GL_FRAMEBUFFER", "GL_DEPTH_ATTACHMENT", "GL_RENDERBUFFER", "@renderbuffer"),
    "glFramebufferTexture2D": ("GL_FRAMEBUFFER", "GL_COLOR_ATTACHMENT0", "GL_TEXTURE_2D", "@texture", 0),
    "glFrontFace": ("GL_CW",), "glFrustum": (-1, 1, -2, 2, 1, 10), "glGenFramebuffers": (2,), "glGenLists": (2,),
    "glGenQueries": (2,), "glGenRenderbuffers": (2,), "glGenTextures": (2,), "glGenerateMipmap": ("GL_TEXTURE_2D",),
    "glGetBooleanv": ("GL_DEPTH_TEST",), "glGetClipPlane": ("GL_CLIP_PLANE1",), "glGetDoublev": ("GL_DEPTH_RANGE",),
    "glGetError": (), "glGetFloatv": ("GL_LINE_WIDTH",), "glGetIntegerv": ("GL_VIEWPORT",),
    "glGetFramebufferAttachmentParameteriv": (
        "GL_FRAMEBUFFER", "GL_COLOR_ATTACHMENT0", "GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME",
    ),
    "glGetQueryObjectiv": ("@query", "GL_QUERY_RESULT"), "glGetQueryObjectuiv": ("@query", "GL_QUERY_RESULT"),
    "glGetQueryiv": ("GL_SAMPLES_PASSED", "GL_CURRENT_QUERY"), "glGetString": ("GL_VERSION",),
    "glGetTexImage": ("GL_TEXTURE_2D", 0, *TEXELS), "glGetUniformLocation": ("@program", "bias"),
    "glGetUniformfv": ("@program", "@bias", ANSWER), "glGetUniformiv": ("@program", "@bias", np.zeros(4, np.int32)),
    "glHint": ("GL_FOG_HINT", "GL_NICEST"), "glIsEnabled": ("GL_BLEND",), "glIsFramebuffer": ("@framebuffer",),
    "glIsList": (1,), "glIsProgram": ("@program",), "glIsQuery": ("@query",), "glIsRenderbuffer": ("@renderbuffer",),
    "glIsTexture": ("@texture",), "glLineWidth": (2.0,), "glListBase": (7,), "glLoadIdentity": (),
    "glLogicOp": ("GL_XOR",), "glMatrixMode": ("GL_TEXTURE",), "glNewList": (3, "GL_COMPILE_AND_EXECUTE"),
    "glNormalPointer": ("GL_FLOAT", 0, CORNERS), "glOrtho": (-1, 1, -2, 2, -3, 3), "glPointSize": (2.0,),
    "glPointParameterf": ("GL_POINT_SIZE_MIN", 2.0),
    "glPointParameteri": ("GL_POINT_SPRITE_COORD_ORIGIN", "GL_LOWER_LEFT"),
    "glPointParameterfv": ("GL_POINT_DISTANCE_ATTENUATION", [1.0, 0.5, 0.25]),
    "glPointParameteriv": ("GL_POINT_DISTANCE_ATTENUATION", [1, 0, 2]),
    "glLineStipple": (3, 0x1234), "glPolygonStipple": (bytes(128),), "glGetPolygonStipple": (),

    "glPolygonMode": ("GL_FRONT_AND_BACK", "GL_LINE"), "glPolygonOffset": (1.0, 2.0), "glPopAttrib": (),
    "glPopDebugGroup": (), "glPopMatrix": (), "glPushAttrib": ("GL_FOG_BIT",),
    "glPushDebugGroup": ("GL_DEBUG_SOURCE_APPLICATION", 0, -1, b"floor"), "glPushMatrix": (),
    "glReadBuffer": ("GL_BACK",), "glReadPixels": (0, 0, 2, 2, *TEXELS),
    "glRenderbufferStorage": ("GL_RENDERBUFFER", "GL_RGBA8", 4, 4), "glRotated": (30.0, 1, 2, 3),
    "glScissor": (1, 2, 3, 4), "glShadeModel": ("GL_FLAT",), "glStencilFunc": ("GL_EQUAL", 1, 255),
    "glStencilFuncSeparate": ("GL_BACK", "GL_EQUAL", 1, 255), "glStencilMask": (7,),
    "glStencilMaskSeparate": ("GL_BACK", 7), "glStencilOp": ("GL_INCR", "GL_KEEP", "GL_ZERO"),
    "glStencilOpSeparate": ("GL_BACK", "GL_INCR", "GL_KEEP", "GL_ZERO"),
    "glTexCoordPointer": (2, "GL_FLOAT", 0, CORNERS),
    "glTexImage1D": ("GL_TEXTURE_1D", 0, "GL_RGBA8", 4, 0, *TEXELS, BYTES),
    "glTexImage2D": ("GL_TEXTURE_2D", 0, "GL_RGBA8", 4, 4, 0, *TEXELS, BYTES),
    "glTexImage3D": ("GL_TEXTURE_3D", 0, "GL_RGBA8", 2, 2, 1, 0, *TEXELS, BYTES),
    "glTexSubImage1D": ("GL_TEXTURE_1D", 0, 1, 2, *TEXELS, BYTES),
    "glTexSubImage3D": ("GL_TEXTURE_3D", 0, 1, 1, 0, 1, 1, 1, *TEXELS, BYTES),
    "glTexSubImage2D": ("GL_TEXTURE_2D", 0, 1, 1, 2, 2, *TEXELS, BYTES), "glUseProgram": ("@program",),
    "glUniformMatrix4fv": ("@lightMatrix", 1, False, MATRIX), "glVertexPointer": (3, "GL_FLOAT", 0, CORNERS),
    "glViewport": (1, 2, 3, 4), "gluLookAt": (1, 2, 3, 0, 0, 0, 0, 1, 0), "gluOrtho2D": (-1, 1, -2, 2),
    "gluPerspective": (60.0, 1.5, 1, 10), "gluProject": (0.1, 0.2, 0.3), "gluUnProject": (1.0, 2.0, 0.5),
}  # fmt: skip


def families() -> dict[str, tuple[Any, ...]]:
    """The calls that come in several types: vertices and what they carry, parameters by name."""
    calls: dict[str, tuple[Any, ...]] = {}
    whole, real = (1, 2, 3, 4), (0.5, 0.25, -0.75, 1.0)
    for name, lengths, types in (
        ("glVertex", (2, 3, 4), "dfis"), ("glRasterPos", (2, 3, 4), "dfis"), ("glWindowPos", (2, 3), "dfis"),
        ("glTexCoord", (1, 2, 3, 4), "dfis"), ("glNormal", (3,), "bdfis"),
        ("glColor", (3, 4), ("b", "d", "f", "i", "s", "ub", "ui", "us")),
    ):  # fmt: skip
        for length in lengths:
            for kind in types:
                numbers = (real if kind in "df" else whole)[:length]
                calls |= {f"{name}{length}{kind}": numbers, f"{name}{length}{kind}v": (list(numbers),)}
    calls |= {
        f"glMulti{name[2:]}": ("GL_TEXTURE1", *values)
        for name, values in calls.items()
        if name.startswith("glTexCoord")
    }
    for name, types in (("Vertex", "dfis"), ("Normal", "bdfis"), ("TexCoord", "dfis")):
        calls |= {f"gl{name}Pointer{kind}": (CORNERS,) for kind in types}
    calls |= {f"glColorPointer{kind}": (CORNERS,) for kind in ("b", "d", "f", "i", "s", "ub", "ui", "us")}
    for kind in "dfis":
        calls |= {f"glRect{kind}": (0, 0, 1, 1), f"glRect{kind}v": ([0, 0], [1, 1])}
    for kind in "df":
        calls |= {
            f"glLoadMatrix{kind}": (MATRIX,), f"glMultMatrix{kind}": (MATRIX,), f"glRotate{kind}": (30.0, 1, 2, 3),
            f"glLoadTransposeMatrix{kind}": (MATRIX,), f"glMultTransposeMatrix{kind}": (MATRIX,),
            f"glScale{kind}": (1, 2, 3), f"glTranslate{kind}": (1, 2, 3),
        }  # fmt: skip
    for kind in "fi":
        calls |= {
            f"glFog{kind}": ("GL_FOG_START", 2), f"glFog{kind}v": ("GL_FOG_COLOR", [1, 0, 1, 0]),
            f"glLight{kind}": ("GL_LIGHT1", "GL_SPOT_EXPONENT", 2),
            f"glLight{kind}v": ("GL_LIGHT1", "GL_DIFFUSE", [1, 0, 1, 0]),
            f"glLightModel{kind}": ("GL_LIGHT_MODEL_TWO_SIDE", 1),
            f"glLightModel{kind}v": ("GL_LIGHT_MODEL_AMBIENT", [1, 0, 1, 0]),
            f"glMaterial{kind}": ("GL_FRONT", "GL_SHININESS", 2),
            f"glMaterial{kind}v": ("GL_FRONT", "GL_DIFFUSE", [1, 0, 1, 0]),
            f"glPixelStore{kind}": ("GL_PACK_ALIGNMENT", 2),
            f"glTexEnv{kind}": ("GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", "GL_REPLACE"),
            f"glTexEnv{kind}v": ("GL_TEXTURE_ENV", "GL_TEXTURE_ENV_COLOR", [1, 0, 1, 0]),
            f"glTexParameter{kind}": ("GL_TEXTURE_2D", "GL_TEXTURE_MIN_FILTER", "GL_NEAREST"),
            f"glTexParameter{kind}v": ("GL_TEXTURE_2D", "GL_TEXTURE_BORDER_COLOR", [1, 0, 1, 0]),
            f"glGetLight{kind}v": ("GL_LIGHT1", "GL_DIFFUSE"), f"glGetMaterial{kind}v": ("GL_BACK", "GL_DIFFUSE"),
            f"glGetTexEnv{kind}v": ("GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE"),
            f"glGetTexParameter{kind}v": ("GL_TEXTURE_2D", "GL_TEXTURE_WRAP_S"),
            f"glGetTexLevelParameter{kind}v": ("GL_TEXTURE_2D", 0, "GL_TEXTURE_WIDTH"),
        }  # fmt: skip
    for kind in "dfi":
        calls |= {
            f"glTexGen{kind}": ("GL_S", "GL_TEXTURE_GEN_MODE", "GL_OBJECT_LINEAR"),
            f"glTexGen{kind}v": ("GL_S", "GL_EYE_PLANE", [1, 0, 1, 0]),
            f"glGetTexGen{kind}v": ("GL_S", "GL_OBJECT_PLANE"),
        }
    for length in (1, 2, 3, 4):
        calls[f"glUniform{length}f"] = ("@ambient", *real[:length])
        calls[f"glUniform{length}i"] = ("@shadowMap", *(1,) * length)
        calls[f"glUniform{length}fv"] = ("@ambient", 1, list(real[:length]))
        calls[f"glUniform{length}iv"] = ("@shadowMap", 1, [1] * length)
    return calls


CALLS = {**SINGLE, **families(), **MORE_CALLS}
NAMED_AGAIN = {  # spellings that are PyOpenGL's own: the same function
    "glGetBoolean": "glGetBooleanv", "glGetDouble": "glGetDoublev", "glGetFloat": "glGetFloatv",
    "glGetInteger": "glGetIntegerv", "glClearDepthf": "glClearDepth", "glDepthRangef": "glDepthRange",
    "glGetPolygonStippleub": "glGetPolygonStipple",
    "glRotate": "glRotated", "glTranslate": "glTranslated", "glScale": "glScaled", "glLight": "glLightfv",
    "glTexCoord": "glTexCoord2d", "glNormal": "glNormal3d", "glStencilOpSeparateATI": "glStencilOpSeparate",
}  # fmt: skip


@dataclass(frozen=True)
class World:
    """Names of what `prepare` makes."""

    names: dict[str, Any]

    def values(self, gl: Any, arguments: tuple[Any, ...]) -> list[Any]:
        """Return arguments with tokens and objects looked up."""
        return [self._value(gl, argument) for argument in arguments]

    def _value(self, gl: Any, argument: Any) -> Any:
        if isinstance(argument, list):
            return [self._value(gl, item) for item in argument]
        if not isinstance(argument, str):
            return argument
        return self.names[argument] if argument.startswith("@") else getattr(gl, argument, argument)


def prepare(gl: Any) -> World:
    """Bind a 4 x 4 texture; make a framebuffer object around another one, a renderbuffer, an ended query, a list."""
    texture, attached = (int(name) for name in gl.glGenTextures(2))
    for name in (attached, texture):
        gl.glBindTexture(gl.GL_TEXTURE_2D, name)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, *(0, gl.GL_RGBA8, 4, 4, 0), gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, BYTES)
    framebuffer, renderbuffer = int(gl.glGenFramebuffers(1)), int(gl.glGenRenderbuffers(1))
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, renderbuffer)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, attached, 0)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    buffer = int(gl.glGenBuffers(1))
    gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, buffer)
    gl.glBufferData(gl.GL_ELEMENT_ARRAY_BUFFER, 12, INDICES, gl.GL_DYNAMIC_DRAW)
    gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, 0)
    query = int(gl.glGenQueries(1))
    gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
    gl.glEndQuery(gl.GL_SAMPLES_PASSED)
    gl.glGenLists(2)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, CORNERS)
    program = gl.program("shadow-map")
    gl.glUseProgram(program)
    uniforms = {f"@{name}": gl.glGetUniformLocation(program, name) for name in ("bias", "ambient", "shadowMap")}
    uniforms["@lightMatrix"] = gl.glGetUniformLocation(program, "lightMatrix")
    gl.glUseProgram(0)
    objects = {
        "texture": texture,
        "framebuffer": framebuffer,
        "renderbuffer": renderbuffer,
        "query": query,
        "buffer": buffer,
        "quadric": gl.gluNewQuadric(),
        "old_quadric": gl.gluNewQuadric(),
    }
    return World({f"@{name}": value for name, value in objects.items()} | uniforms | {"@program": program})


# numbers that GL takes for right ones, and then reads memory that is not the array's, or what there is more of in Mesa
LEFT_OUT = {
    "glArrayElement": (-1, 40, 99999), "glBufferData": (40, 99999), "glDrawArrays": (-1, 40, 99999),
    "glDrawElements": (40, 99999), "glDrawRangeElements": (40, 99999), "glMultiDrawArrays": (40, 99999),
    "glMultiDrawElements": (40, 99999), "glPrioritizeTextures": (40, 99999),
    "glIndexPointer": (99999,), "glFogCoordPointer": (99999,), "glSecondaryColorPointer": (99999,),
    "glTexImage1D": (40,), "glTexImage2D": (40,), "glTexImage3D": (40,), "glUniform1i": (40,),
    "glInterleavedArrays": (99999,), "glBitmap": (40, 99999),
    "glDrawPixels": (40, 99999), "glCopyPixels": (99999,), "glPixelMapfv": (40,), "glPixelMapuiv": (40,),
    "glPixelMapusv": (40,), "gluSphere": (99999,), "gluCylinder": (99999,), "gluDisk": (99999,),
    "gluPartialDisk": (99999,),
}  # fmt: skip


def wrong_values(name: str, argument: Any) -> tuple[Any, ...]:
    """What stands in for a right argument: tokens of other groups, names and numbers out of any range."""
    if isinstance(argument, str):
        if argument.endswith("quadric"):
            return ()
        return (9999,) if argument.startswith("@") else (0x9999, 3, "GL_LESS", "GL_RGBA", 0xFFFFFFFF)
    if isinstance(argument, bool) or not isinstance(argument, int | float):
        return ()
    wrong = (-1, 40, 99999) if isinstance(argument, int) else (-1.0, 2000.0)
    return tuple(number for number in wrong if number not in LEFT_OUT.get(name, ()))


def attempts(name: str) -> Iterator[tuple[Any, ...]]:
    """The right arguments of a call, then each argument wrong by itself, then each pair of them."""
    arguments = CALLS[name]
    yield arguments
    wrong = [wrong_values(name, argument) for argument in arguments]
    for i, values in enumerate(wrong):
        for value in values:
            yield (*arguments[:i], value, *arguments[i + 1 :])
    for i, first in enumerate(wrong):
        for j, second in enumerate(wrong[i + 1 :], i + 1):
            if first and second:
                yield (*arguments[:i], first[0], *arguments[i + 1 : j], second[0], *arguments[j + 1 :])
