/* A red-cyan picture: the eyes one after the other, each with its colours only; depth ranges divide the buffer. */
#include "window.h"

static void draw(void)
{
    clear(0, 0, 0);
    for (int eye = -1; eye <= 1; eye += 2) {
        glColorMask(eye < 0, eye > 0, eye > 0, 1);
        glDepthRange(eye < 0 ? 0.5 : 0, eye < 0 ? 1 : 0.5);
        camera(0.15 * eye + 0.5, 0.7, 4);
        light(1, 1, 1, 0);
        glRotatef(20.0f * frame, 0, 1, 0);
        torus(0.3f, 0.8f, 8, 10);
    }
    glColorMask(1, 1, 1, 1);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
