"""OpenGL's spelling: functions and tokens named and called as in PyOpenGL's ``OpenGL.GL`` and ``OpenGL.GLU``.

The package checks arguments and replaces state; what draws is `softshadow.pipeline`. Everything works on this thread's
current context::

    from softshadow import gl
    gl.create_context(64, 48)
    gl.glEnable(gl.GL_DEPTH_TEST)

References: GL 2.1 specification; the surface and its conventions: docs/exactness.md.
"""

from __future__ import annotations

from typing import Any

from softshadow.context import Context, current, make_current
from softshadow.gl.drawing import (
    glBegin,
    glClientActiveTexture,
    glColor3d,
    glColor3dv,
    glColor3f,
    glColor3fv,
    glColor3ub,
    glColor3ubv,
    glColor4d,
    glColor4dv,
    glColor4f,
    glColor4fv,
    glColor4ub,
    glColor4ubv,
    glColorPointer,
    glDisableClientState,
    glDrawArrays,
    glDrawElements,
    glEnableClientState,
    glEnd,
    glMultiTexCoord2f,
    glMultiTexCoord3f,
    glMultiTexCoord4f,
    glNormal3d,
    glNormal3dv,
    glNormal3f,
    glNormal3fv,
    glNormalPointer,
    glPopDebugGroup,
    glPushDebugGroup,
    glRectd,
    glRectf,
    glRecti,
    glTexCoord1d,
    glTexCoord1f,
    glTexCoord2d,
    glTexCoord2f,
    glTexCoord2fv,
    glTexCoord3d,
    glTexCoord3f,
    glTexCoord3fv,
    glTexCoord4d,
    glTexCoord4f,
    glTexCoord4fv,
    glTexCoordPointer,
    glVertex2d,
    glVertex2dv,
    glVertex2f,
    glVertex2fv,
    glVertex2i,
    glVertex2iv,
    glVertex3d,
    glVertex3dv,
    glVertex3f,
    glVertex3fv,
    glVertex3i,
    glVertex3iv,
    glVertex4d,
    glVertex4dv,
    glVertex4f,
    glVertex4fv,
    glVertex4i,
    glVertex4iv,
    glVertexPointer,
)
from softshadow.gl.errors import (
    GLError,
    glGetError,
)
from softshadow.gl.fragment_state import (
    glAlphaFunc,
    glBlendColor,
    glBlendEquation,
    glBlendEquationSeparate,
    glBlendFunc,
    glBlendFuncSeparate,
    glClear,
    glClearColor,
    glClearDepth,
    glClearStencil,
    glColorMask,
    glCullFace,
    glDepthFunc,
    glDepthMask,
    glDepthRange,
    glDisable,
    glEnable,
    glFinish,
    glFlush,
    glFrontFace,
    glHint,
    glIsEnabled,
    glLineWidth,
    glLogicOp,
    glPointSize,
    glPolygonMode,
    glPolygonOffset,
    glScissor,
    glStencilFunc,
    glStencilFuncSeparate,
    glStencilMask,
    glStencilMaskSeparate,
    glStencilOp,
    glStencilOpSeparate,
    glViewport,
)
from softshadow.gl.framebuffers import (
    glBindFramebuffer,
    glBindRenderbuffer,
    glCheckFramebufferStatus,
    glDeleteFramebuffers,
    glDeleteRenderbuffers,
    glDrawBuffer,
    glDrawBuffers,
    glFramebufferRenderbuffer,
    glFramebufferTexture2D,
    glGenFramebuffers,
    glGenRenderbuffers,
    glGetFramebufferAttachmentParameteriv,
    glIsFramebuffer,
    glIsRenderbuffer,
    glReadBuffer,
    glRenderbufferStorage,
)
from softshadow.gl.lighting import (
    glColorMaterial,
    glFogf,
    glFogfv,
    glFogi,
    glFogiv,
    glGetLightfv,
    glGetMaterialfv,
    glLightf,
    glLightfv,
    glLighti,
    glLightiv,
    glLightModelf,
    glLightModelfv,
    glLightModeli,
    glLightModeliv,
    glMaterialf,
    glMaterialfv,
    glMateriali,
    glMaterialiv,
    glShadeModel,
)
from softshadow.gl.pixels import (
    glPixelStoref,
    glPixelStorei,
    glReadPixels,
)
from softshadow.gl.programs import (
    glGetUniformfv,
    glGetUniformiv,
    glGetUniformLocation,
    glIsProgram,
    glUniform1f,
    glUniform1fv,
    glUniform1i,
    glUniform1iv,
    glUniform2f,
    glUniform2fv,
    glUniform2i,
    glUniform3f,
    glUniform3fv,
    glUniform3i,
    glUniform4f,
    glUniform4fv,
    glUniform4i,
    glUniformMatrix4fv,
    glUseProgram,
    program,
)
from softshadow.gl.queries import (
    glGetBooleanv,
    glGetDoublev,
    glGetFloatv,
    glGetIntegerv,
    glGetString,
)
from softshadow.gl.texture_images import (
    glCopyTexImage2D,
    glCopyTexSubImage2D,
    glGetTexImage,
    glGetTexLevelParameterfv,
    glGetTexLevelParameteriv,
    glTexImage2D,
    glTexSubImage2D,
)
from softshadow.gl.texture_units import (
    glActiveTexture,
    glGetTexEnvfv,
    glGetTexEnviv,
    glGetTexGendv,
    glGetTexGenfv,
    glGetTexGeniv,
    glTexEnvf,
    glTexEnvfv,
    glTexEnvi,
    glTexEnviv,
    glTexGend,
    glTexGendv,
    glTexGenf,
    glTexGenfv,
    glTexGeni,
    glTexGeniv,
)
from softshadow.gl.textures import (
    glBindTexture,
    glDeleteTextures,
    glGenTextures,
    glGetTexParameterfv,
    glGetTexParameteriv,
    glIsTexture,
    glTexParameterf,
    glTexParameterfv,
    glTexParameteri,
    glTexParameteriv,
)
from softshadow.gl.transforms import (
    glFrustum,
    glLoadIdentity,
    glLoadMatrixd,
    glLoadMatrixf,
    glMatrixMode,
    glMultMatrixd,
    glMultMatrixf,
    glOrtho,
    glPopMatrix,
    glPushMatrix,
    glRotated,
    glRotatef,
    glScaled,
    glScalef,
    glTranslated,
    glTranslatef,
    gluLookAt,
    gluOrtho2D,
    gluPerspective,
    gluProject,
    gluUnProject,
)
from softshadow.tokens import *


def create_context(
    width: int,
    height: int,
    depth_format: str = "d24",
    stencil_bits: int = 8,
    precision: str = "mesa",
    polygon_offset_slope: str = "max",
    polygon_offset_unit: str = "mesa",
    raise_errors: bool = True,
) -> Context:
    """Make a context in GL's initial state and make it this thread's current one.

    In a ``with`` statement the context before it comes back at the end.

    Parameters
    ----------
    width, height : int, pixels, 1 to 16384
    depth_format : "d24" (24-bit integers) or "d32f" (float32)
    stencil_bits : 1 to 8; counters saturate at ``2**stencil_bits - 1``
    precision : "mesa" (float32, the bits of llvmpipe) or "exact" (float64, depth not rounded)
    polygon_offset_slope : "max", "length" or "slide" (no absolute value, as printed on the slide)
    polygon_offset_unit : "mesa" (a unit is two steps of fixed-point depth) or "spec" (one)
    raise_errors : raise `GLError` besides recording the error for glGetError

    Raises
    ------
    ValueError
        An argument is not one of these.

    Examples
    --------
    >>> from softshadow import gl
    >>> with gl.create_context(4, 3):
    ...     gl.glClearStencil(2)
    ...     gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    ...     gl.glReadPixels(0, 0, 4, 1, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
    array([[2, 2, 2, 2]], dtype=uint8)
    """
    offset = (polygon_offset_slope, polygon_offset_unit)
    context = Context(width, height, depth_format, stencil_bits, precision, *offset, raise_errors)
    context.before = make_current(context)
    return context


def __getattr__(name: str) -> Any:
    if name.startswith(("gl", "GL_")):
        raise AttributeError(f"{name} is not part of this subset of OpenGL", name=name, obj=None)
    raise AttributeError(f"module 'softshadow.gl' has no attribute {name!r}", name=name)
