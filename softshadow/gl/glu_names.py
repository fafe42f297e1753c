"""GLU's strings: names of errors, its version and extensions."""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.glu_tokens import GLU_EXTENSIONS, GLU_VERSION

VERSION, EXTENSIONS = b"1.3", b"GLU_EXT_nurbs_tessellator GLU_EXT_object_space_tess "
ERRORS = {
    gl.GL_NO_ERROR: b"no error", gl.GL_INVALID_ENUM: b"invalid enumerant", gl.GL_INVALID_VALUE: b"invalid value",
    gl.GL_INVALID_OPERATION: b"invalid operation", gl.GL_STACK_OVERFLOW: b"stack overflow",
    gl.GL_STACK_UNDERFLOW: b"stack underflow", gl.GL_OUT_OF_MEMORY: b"out of memory",
    gl.GL_INVALID_FRAMEBUFFER_OPERATION: b"invalid framebuffer operation", 0x8031: b"table too large",
    100900: b"invalid enumerant", 100901: b"invalid value", 100902: b"out of memory",
    100903: b"incompatible gl version", 100904: b"invalid operation",
    100151: b"gluTessBeginPolygon() must precede a gluTessEndPolygon()",
    100152: b"gluTessBeginContour() must precede a gluTessEndContour()",
    100153: b"gluTessEndPolygon() must follow a gluTessBeginPolygon()",
    100154: b"gluTessEndContour() must follow a gluTessBeginContour()",
    100155: b"a coordinate is too large", 100156: b"need combine callback",
}  # fmt: skip


def gluErrorString(error: int) -> bytes | None:
    """Return the text of an error code of GL or GLU; None for other numbers."""
    return ERRORS.get(int(error))


def gluGetString(name: int) -> bytes | None:
    """Return GLU's version (GLU_VERSION) or extensions (GLU_EXTENSIONS); None for other names."""
    return {GLU_VERSION: VERSION, GLU_EXTENSIONS: EXTENSIONS}.get(int(name))


def gluCheckExtension(extName: bytes | str, extString: bytes | str) -> bool:
    """Return whether a name is one of the words of a list of extensions."""
    name, names = (text.encode() if isinstance(text, str) else text for text in (extName, extString))
    return name in names.split(b" ")


__all__ = spelled_like_gl(globals())
