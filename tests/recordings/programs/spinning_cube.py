"""pygame: a cube of coloured faces that turns; the first lesson of many courses."""

import pygame
from OpenGL.GL import *
from OpenGL.GLU import gluLookAt, gluPerspective
from pygame.locals import DOUBLEBUF, OPENGL

CORNERS = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]

pygame.init()
pygame.display.set_mode((64, 48), DOUBLEBUF | OPENGL)
glMatrixMode(GL_PROJECTION)
gluPerspective(45, 64 / 48, 0.1, 50)
glMatrixMode(GL_MODELVIEW)
gluLookAt(0, 1, 6, 0, 0, 0, 0, 1, 0)
glEnable(GL_DEPTH_TEST)
while True:
    for event in pygame.event.get():
        if event.type == pygame.QUIT:
            raise SystemExit
    glRotatef(7, 3, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glBegin(GL_QUADS)
    for number, face in enumerate(FACES):
        for corner in face:
            glColor3f(number / 6, corner / 8, 0.5)
            glVertex3fv(CORNERS[corner])
    glEnd()
    pygame.display.flip()
    pygame.time.wait(10)
