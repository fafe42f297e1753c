"""Programs for PyOpenGL as students write them, each in another library of windows."""

GLUT = """
import sys
from OpenGL.GL import *
from OpenGL.GLU import *
from OpenGL.GLUT import *

color = (1.0, 0.0, 0.0)

def display():
    glClear(GL_COLOR_BUFFER_BIT)
    glColor3f(*color)
    glRectf(-0.5, -0.5, 0.5, 0.5)
    glutSwapBuffers()

def keyboard(key, x, y):
    global color
    if key == b"g":
        color = (0.0, 1.0, 0.0)
    glutPostRedisplay()

def special(key, x, y):
    global color
    if key == GLUT_KEY_UP:
        color = (0.0, 0.0, 1.0)
    glutPostRedisplay()

def mouse(button, state, x, y):
    global color
    if state == GLUT_DOWN:
        color = (x / 16, y / 12, 0.0)
        glutPostRedisplay()

glutInit(sys.argv)
glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH)
glutInitWindowSize(16, 12)
glutCreateWindow(b"squares")
glutDisplayFunc(display)
glutKeyboardFunc(keyboard)
glutSpecialFunc(special)
glutMouseFunc(mouse)
glutMainLoop()
"""

SINGLE_BUFFERED = """
from OpenGL.GL import *
from OpenGL.GLUT import *

n = 0

def display():
    glClear(GL_COLOR_BUFFER_BIT)
    glColor3f(n / 4, 0, 0)
    glRectf(-1, -1, 1, 1)
    glFlush()

def timer(value):
    global n
    n += value
    glutPostRedisplay()
    glutTimerFunc(100, timer, value)

glutInit()
glutInitWindowSize(16, 12)
glutCreateWindow("timer")
glutDisplayFunc(display)
glutTimerFunc(100, timer, 1)
glutMainLoop()
"""

PYGAME = """
import pygame
from pygame.locals import *
from OpenGL.GL import *

pygame.init()
pygame.display.set_mode((16, 12), DOUBLEBUF | OPENGL)
red = 1.0
while True:
    for event in pygame.event.get():
        if event.type == pygame.KEYDOWN and event.key == K_g:
            red = 0.0
    glClear(GL_COLOR_BUFFER_BIT)
    glColor3f(red, 1 - red, 0)
    glRectf(-0.5, -0.5, 0.5, 0.5)
    pygame.display.flip()
    pygame.time.wait(10)
"""

GLFW = """
import glfw
from OpenGL.GL import *

def pressed(window, key, code, action, mods):
    global red
    if key == glfw.KEY_G and action == glfw.PRESS:
        red = 0.0

red = 1.0
assert glfw.init()
window = glfw.create_window(16, 12, "squares", None, None)
glfw.make_context_current(window)
glfw.set_key_callback(window, pressed)
while not glfw.window_should_close(window):
    glClear(GL_COLOR_BUFFER_BIT)
    glColor3f(red, 1 - red, 0)
    glRectf(-0.5, -0.5, 0.5, 0.5)
    glfw.swap_buffers(window)
    glfw.poll_events()
glfw.terminate()
"""
