/* A torus cut open by clip planes, with the cut drawn where the stencil parity is odd. */
#include "window.h"

static void draw(void)
{
    double plane[] = {0.4, -0.3 * frame, -1, 0.2}, second[] = {1, 0, 0, 0.6};
    clear(0.3f, 0.3f, 0.3f);
    camera(0, 1.5, 4);
    light(1, 2, 3, 0);
    glClipPlane(GL_CLIP_PLANE0, plane);
    glClipPlane(GL_CLIP_PLANE1, second);
    glEnable(GL_CLIP_PLANE0);
    if (frame)
        glEnable(GL_CLIP_PLANE1);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 0, 1);
    glStencilOp(GL_INVERT, GL_INVERT, GL_INVERT);
    torus(0.4f, 0.9f, 10, 12);
    glDisable(GL_CLIP_PLANE0);
    glDisable(GL_CLIP_PLANE1);
    glDisable(GL_LIGHTING);
    glDisable(GL_DEPTH_TEST);
    glStencilFunc(GL_EQUAL, 1, 1);
    glColor3f(0.9f, 0.3f, 0.1f);
    glLoadIdentity();
    glTranslatef(0, 0, -2);
    glRectf(-2, -2, 2, 2);
    glDisable(GL_STENCIL_TEST);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
