"""pygame and NumPy: a room with a texture made by arithmetic, fog, and a window that blends."""

import numpy as np
import pygame
from OpenGL.GL import *
from OpenGL.GLU import gluPerspective

pygame.init()
pygame.display.set_mode((64, 48), pygame.OPENGL | pygame.DOUBLEBUF)
u, v = np.meshgrid(np.arange(32), np.arange(32))
bricks = np.where((v % 8 == 0) | ((u + v // 8 * 8) % 16 == 0), 200, 120).astype(np.uint8)
image = np.dstack([bricks, bricks // 2, bricks // 3])
texture = glGenTextures(1)
glBindTexture(GL_TEXTURE_2D, texture)
glPixelStorei(GL_UNPACK_ALIGNMENT, 1)
glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR)
glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE)
glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 32, 32, 0, GL_RGB, GL_UNSIGNED_BYTE, image)
glEnable(GL_DEPTH_TEST)
glEnable(GL_FOG)
glFogi(GL_FOG_MODE, GL_EXP)
glFogf(GL_FOG_DENSITY, 0.12)
glFogfv(GL_FOG_COLOR, (0.3, 0.3, 0.4, 1))
glClearColor(0.3, 0.3, 0.4, 1)
step = 0
while True:
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(60, 64 / 48, 0.5, 30)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(0, -0.2, -1 + 0.4 * step)
    glEnable(GL_TEXTURE_2D)
    glColor3f(1, 1, 1)
    glBegin(GL_QUADS)
    for side in (-2, 2):
        for s, t, y, z in ((0, 0, -1, 0), (4, 0, -1, -9), (4, 1, 1, -9), (0, 1, 1, 0)):
            glTexCoord2f(s, t)
            glVertex3f(side, y, z)
    glEnd()
    glDisable(GL_TEXTURE_2D)
    glEnable(GL_BLEND)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glColor4f(0.5, 0.8, 1, 0.4)
    glBegin(GL_TRIANGLE_FAN)
    for x, y in ((-1, -0.7), (1, -0.7), (1.2, 0.8), (-0.8, 0.6)):
        glVertex3f(x, y, -5)
    glEnd()
    glDisable(GL_BLEND)
    pygame.display.flip()
    step += 1
