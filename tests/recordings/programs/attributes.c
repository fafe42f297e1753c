/* Nested groups of attributes: each level changes something and gives it back. */
#include "window.h"

static void level(int depth)
{
    if (depth == 0)
        return;
    glPushAttrib(depth & 1 ? GL_ALL_ATTRIB_BITS : GL_ENABLE_BIT | GL_CURRENT_BIT | GL_POLYGON_BIT | GL_LIGHTING_BIT);
    glColor3f(0.2f * depth, 1 - 0.2f * depth, 0.5f);
    glPolygonMode(GL_FRONT, depth & 1 ? GL_LINE : GL_FILL);
    if (depth == 2)
        glDisable(GL_LIGHTING);
    glPushMatrix();
    glTranslatef(0.5f * depth - 1.3f, 0.2f * depth - 0.5f, 0);
    box(0.3f);
    glTranslatef(0, -0.3f, 0.3f);
    level(depth - 1);
    glPopMatrix();
    glPopAttrib();
    glRectf(-1.2f + 0.4f * depth, 0.7f, -1 + 0.4f * depth, 0.9f);
}

static void draw(void)
{
    clear(0.3f, 0.2f, 0.3f);
    camera(0, 0.5, 4);
    light(1, 2, 1, 0);
    glEnable(GL_COLOR_MATERIAL);
    glColor3f(1, 1, 1);
    level(3 + frame);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
