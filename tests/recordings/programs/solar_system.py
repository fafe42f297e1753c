"""GLUT: a sun, a planet and its moon in nested matrices; keys advance the day."""

import sys

from OpenGL.GL import *
from OpenGL.GLU import *
from OpenGL.GLUT import *

day = 0


def display():
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glColor3f(1, 0.9, 0.2)
    glDisable(GL_LIGHTING)
    glutSolidSphere(0.6, 12, 8)
    glEnable(GL_LIGHTING)
    glPushMatrix()
    glRotatef(20 * day, 0, 1, 0)
    glTranslatef(1.6, 0, 0)
    glColor3f(0.2, 0.4, 1)
    glutSolidSphere(0.25, 10, 6)
    glRotatef(60 * day, 0, 1, 0)
    glTranslatef(0.5, 0, 0)
    glColor3f(0.7, 0.7, 0.7)
    glutSolidSphere(0.1, 8, 5)
    glPopMatrix()
    glutSwapBuffers()


def keyboard(key, x, y):
    global day
    if key == b"d":
        day += 1
    glutPostRedisplay()


glutInit(sys.argv)
glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH)
glutInitWindowSize(64, 48)
glutCreateWindow(b"planets")
glEnable(GL_DEPTH_TEST)
glEnable(GL_LIGHT0)
glLightfv(GL_LIGHT0, GL_POSITION, (0, 0, 0, 1))
glEnable(GL_COLOR_MATERIAL)
glMatrixMode(GL_PROJECTION)
gluPerspective(50, 64 / 48, 1, 20)
glMatrixMode(GL_MODELVIEW)
gluLookAt(0, 2, 4, 0, 0, 0, 0, 1, 0)
glutDisplayFunc(display)
glutKeyboardFunc(keyboard)
glutMainLoop()
