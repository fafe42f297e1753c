/* A planar shadow: the object flattened by a matrix, blended once per pixel thanks to the stencil buffer. */
#include "window.h"

static void object(void)
{
    glPushMatrix();
    glRotatef(30 + 20.0f * frame, 0, 1, 0);
    torus(0.2f, 0.5f, 6, 10);
    glPopMatrix();
}

static void draw(void)
{
    float l[] = {1, 3, 1, 1}, h = 0.7f;
    float flatten[16] = {l[1] + h, 0, 0, 0, -l[0], -h, -l[2], -1, 0, 0, l[1] + h, 0, -h * l[0], -h * l[1], -h * l[2], l[1]};
    clear(0.5f, 0.6f, 0.7f);
    camera(1, 2, 4);
    light(l[0], l[1], l[2], 1);
    floor_quad(1.8f, -h, 1);
    glDisable(GL_LIGHTING);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_EQUAL, 0, 1);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-1, -1);
    glColor3f(0.4f, 0.4f, 0.4f);
    glPushMatrix();
    glMultMatrixf(flatten);
    object();
    glPopMatrix();
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_BLEND);
    glDisable(GL_STENCIL_TEST);
    light(l[0], l[1], l[2], 1);
    object();
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
