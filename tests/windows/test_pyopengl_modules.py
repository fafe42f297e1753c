"""OpenGL.arrays.vbo, GL's types, and OpenGL.GL.shaders in programs that run unchanged."""

from pathlib import Path

import pytest

from softshadow.errors import SoftShadowError
from softshadow.windows import run_script

START = """
import numpy
from OpenGL.GL import *
from OpenGL.GLUT import *
from OpenGL.arrays import vbo

def show():
    glClear(GL_COLOR_BUFFER_BIT)
    draw()
    glutSwapBuffers()

glutInit()
glutInitWindowSize(16, 12)
glutCreateWindow("triangles")
"""
END = """
glutDisplayFunc(show)
glutMainLoop()
"""
BUFFER = """
data = numpy.array([[9, 9, 9, -1, -1, 0], [9, 9, 9, 3, -1, 0], [9, 9, 9, -1, 3, 0]], 'f')
buffer = vbo.VBO(data, usage='GL_STATIC_DRAW')
buffer[1:2] = numpy.array([[9, 9, 9, 3, -1, 0]], 'f')

def draw():
    glColor3f(0, 1, 0)
    with buffer:
        glEnableClientState(GL_VERTEX_ARRAY)
        glVertexPointer(3, GL_FLOAT, 24, buffer + 12)
        glDrawArrays(GL_TRIANGLES, 0, len(buffer))
"""
WHOLE_BUFFER = """
buffer = vbo.VBO(numpy.array([[-1, -1, 0], [3, -1, 0], [-1, 3, 0]], 'f'))

def draw():
    buffer.bind()
    glColor3f(0, 1, 0)
    glEnableClientState(GL_VERTEX_ARRAY)
    glVertexPointerf(buffer)
    glDrawArrays(GL_TRIANGLES, 0, 3)
    buffer.unbind()
"""
C_ARRAYS = """
corners = (GLfloat * 9)(-1, -1, 0, 3, -1, 0, -1, 3, 0)
texels = (GLubyte * 48)(*([0, 255, 0] * 16))
texture = (GLuint * 1)()
glGenTextures(1, texture)
glBindTexture(GL_TEXTURE_2D, texture[0])
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 4, 4, 0, GL_RGB, GL_UNSIGNED_BYTE, texels)
viewport = (GLint * 4)()
glGetIntegerv(GL_VIEWPORT, viewport)
assert list(viewport) == [0, 0, 16, 12]

def draw():
    glEnable(GL_TEXTURE_2D)
    glEnableClientState(GL_VERTEX_ARRAY)
    glVertexPointer(3, GL_FLOAT, 0, corners)
    glDrawArrays(GL_TRIANGLES, 0, 3)
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "program.py"
    path.write_text(text)
    return path


@pytest.mark.parametrize("text", [BUFFER, WHOLE_BUFFER, C_ARRAYS], ids=["vbo", "whole vbo", "ctypes"])
def test_buffer_objects_and_arrays_of_gl_types_are_drawn(tmp_path: Path, text: str) -> None:
    run = run_script(written(tmp_path, START + text + END), frames=1)
    assert (run.image == [0, 255, 0]).all()


def test_a_program_with_shaders_is_told_that_glsl_cannot_be_run(tmp_path: Path) -> None:
    text = "from OpenGL.GL.shaders import compileProgram\n"
    with pytest.raises(SoftShadowError, match="GLSL cannot be run here"):
        run_script(written(tmp_path, text))
