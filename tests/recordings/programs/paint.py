"""GLUT with one buffer: clicks leave squares; nothing is cleared between frames."""

from OpenGL.GL import *
from OpenGL.GLU import gluOrtho2D
from OpenGL.GLUT import *

clicks = []


def display():
    if not clicks:
        glClear(GL_COLOR_BUFFER_BIT)
    for number, (x, y) in enumerate(clicks[-1:]):
        glColor3f(0.9, 0.3 * len(clicks), 0.2 + 0.1 * number)
        glRectf(x - 4, y - 4, x + 4, y + 4)
    glFlush()


def mouse(button, state, x, y):
    if button == GLUT_LEFT_BUTTON and state == GLUT_DOWN:
        clicks.append((x, 48 - y))
        glutPostRedisplay()


glutInit()
glutInitDisplayMode(GLUT_SINGLE | GLUT_RGB)
glutInitWindowSize(64, 48)
glutCreateWindow("paint")
glClearColor(0.1, 0.1, 0.3, 1)
gluOrtho2D(0, 64, 0, 48)
glutDisplayFunc(display)
glutMouseFunc(mouse)
glutMainLoop()
