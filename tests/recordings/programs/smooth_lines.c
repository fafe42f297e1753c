/* Antialiased lines and points, blended, and polygons with a stipple pattern. */
#include "window.h"

static void draw(void)
{
    unsigned char pattern[128];
    clear(1, 1, 1);
    camera(0, 1, 4);
    for (int i = 0; i < 128; i++)
        pattern[i] = i / 4 & 1 ? 0xAA : 0x33;
    glPolygonStipple(pattern);
    glEnable(GL_POLYGON_STIPPLE);
    glColor3f(0.9f, 0.7f, 0.2f);
    box(0.6f);
    glDisable(GL_POLYGON_STIPPLE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_LINE_SMOOTH);
    glEnable(GL_POINT_SMOOTH);
    glLineWidth(1.5f + frame);
    glPointSize(5);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glColor3f(0, 0, 0.4f);
    torus(0.3f, 0.9f, 4, 8);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glBegin(GL_POINTS);
    for (int i = 0; i < 5; i++)
        glVertex3f(0.4f * i - 0.8f, 0.1f * i, 1);
    glEnd();
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
