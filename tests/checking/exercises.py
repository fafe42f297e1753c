"""An exercise with two checks, and a right submission."""

EXERCISE = '''"""A red square

Draw a red square from -0.5 to 0.5 over a blue background.
"""
from softshadow.checking import Check

size = (16, 8)
checks = [
    Check("picture", points=3, hint="Is the colour set before glRectf?"),
    Check("depth", buffers=("depth",)),
]


def expected(gl):
    gl.glClearColor(0, 0, 1, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    gl.glColor3f(1, 0, 0)
    gl.glRectf(-0.5, -0.5, 0.5, 0.5)
'''
RIGHT = """def program(gl):
    gl.glClearColor(0, 0, 1, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    gl.glColor3f(1, 0, 0)
    gl.glRectf(-0.5, -0.5, 0.5, 0.5)
"""

# the same as RIGHT, for PyOpenGL; the window is of another size, which the check replaces
SCRIPT = """from OpenGL.GL import *
from OpenGL.GLUT import *

def display():
    glClearColor(0, 0, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT)
    glColor3f(1, 0, 0)
    glRectf(-0.5, -0.5, 0.5, 0.5)
    glutSwapBuffers()

glutInit()
glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH)
glutInitWindowSize(300, 200)
glutCreateWindow("square")
glutDisplayFunc(display)
glutMainLoop()
"""
