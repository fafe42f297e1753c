"""glfw and NumPy: a height field as a triangle strip in vertex arrays, lit from the side."""

import glfw
import numpy as np
from OpenGL.GL import *
from OpenGL.GLU import gluLookAt, gluPerspective

N = 14
x, z = np.meshgrid(np.linspace(-2, 2, N), np.linspace(-2, 2, N))

glfw.init()
window = glfw.create_window(64, 48, "waves", None, None)
glfw.make_context_current(window)
glEnable(GL_DEPTH_TEST)
glEnable(GL_LIGHTING)
glEnable(GL_LIGHT0)
glEnable(GL_NORMALIZE)
glLightfv(GL_LIGHT0, GL_POSITION, [1.0, 1.0, 0.3, 0.0])
glMatrixMode(GL_PROJECTION)
gluPerspective(45, 64 / 48, 1, 20)
glMatrixMode(GL_MODELVIEW)
gluLookAt(1, 3, 4, 0, 0, 0, 0, 1, 0)
glEnableClientState(GL_VERTEX_ARRAY)
glEnableClientState(GL_NORMAL_ARRAY)
frame = 0
while not glfw.window_should_close(window):
    y = 0.3 * np.sin(2 * x + frame) * np.cos(1.5 * z)
    slope_x = 0.6 * np.cos(2 * x + frame) * np.cos(1.5 * z)
    slope_z = -0.45 * np.sin(2 * x + frame) * np.sin(1.5 * z)
    points = np.dstack([x, y, z]).astype(np.float32)
    normals = np.dstack([-slope_x, np.ones_like(y), -slope_z]).astype(np.float32)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glVertexPointer(3, GL_FLOAT, 0, points)
    glNormalPointer(GL_FLOAT, 0, normals)
    for row in range(N - 1):
        first = np.arange(row * N, row * N + N)
        strip = np.stack([first, first + N], axis=1).ravel().astype(np.uint16)
        glDrawElements(GL_TRIANGLE_STRIP, len(strip), GL_UNSIGNED_SHORT, strip)
    glfw.swap_buffers(window)
    glfw.poll_events()
    frame += 1
