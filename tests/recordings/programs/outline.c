/* Cartoon outlines: the object marks the stencil buffer, then thick lines are drawn around it only. */
#include "window.h"

static void draw(void)
{
    clear(0.9f, 0.9f, 1);
    camera(0, 1, 3.5);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 3, 7);
    glStencilOp(GL_KEEP, GL_REPLACE, GL_REPLACE);
    glRotatef(30.0f * frame, 1, 1, 0);
    light(1, 1, 1, 0);
    glShadeModel(GL_FLAT);
    box(0.7f);
    glStencilFunc(GL_NOTEQUAL, 3, 7);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glDisable(GL_LIGHTING);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glLineWidth(frame ? 4 : 3);
    glColor3f(0, 0, 0);
    box(0.7f);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glDisable(GL_STENCIL_TEST);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
