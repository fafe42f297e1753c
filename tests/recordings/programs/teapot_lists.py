"""GLUT: a teapot in a display list, drawn solid and as wires, with a reshape function and a timer."""

from OpenGL.GL import *
from OpenGL.GLU import *
from OpenGL.GLUT import *

angle = 0.0


def reshape(width, height):
    glViewport(0, 0, width, height)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(40, width / height, 1, 20)
    glMatrixMode(GL_MODELVIEW)


def display():
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glLoadIdentity()
    gluLookAt(0, 1.5, 4, 0, 0, 0, 0, 1, 0)
    glRotatef(angle, 0, 1, 0)
    glCallList(teapot)
    glTranslatef(0, 1, 0)
    glDisable(GL_LIGHTING)
    glColor3f(1, 1, 1)
    glutWireCube(0.8)
    glEnable(GL_LIGHTING)
    glutSwapBuffers()


def turn(value):
    global angle
    angle += value
    glutPostRedisplay()
    glutTimerFunc(16, turn, value)


glutInit()
glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH)
glutInitWindowSize(64, 48)
glutCreateWindow("teapot")
glEnable(GL_DEPTH_TEST)
glEnable(GL_LIGHTING)
glEnable(GL_LIGHT0)
glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, [0.7, 0.5, 0.3, 1])
teapot = glGenLists(1)
glNewList(teapot, GL_COMPILE)
glutSolidTeapot(0.8)
glEndList()
glutReshapeFunc(reshape)
glutDisplayFunc(display)
glutTimerFunc(16, turn, 12.0)
glutMainLoop()
