"""GL's types as PyOpenGL's programs use them, for arrays in C's form: (GLfloat * 16)()."""

from __future__ import annotations

import ctypes

C_TYPES = {
    "GLbitfield": ctypes.c_uint, "GLboolean": ctypes.c_ubyte, "GLbyte": ctypes.c_byte, "GLchar": ctypes.c_char,
    "GLclampd": ctypes.c_double, "GLclampf": ctypes.c_float, "GLdouble": ctypes.c_double, "GLenum": ctypes.c_uint,
    "GLfloat": ctypes.c_float, "GLint": ctypes.c_int, "GLintptr": ctypes.c_ssize_t, "GLshort": ctypes.c_short,
    "GLsizei": ctypes.c_int, "GLsizeiptr": ctypes.c_ssize_t, "GLubyte": ctypes.c_ubyte, "GLuint": ctypes.c_uint,
    "GLushort": ctypes.c_ushort, "GLvoid": None, "GLvoidp": ctypes.c_void_p,
}  # fmt: skip
