/* Hidden lines: filled polygons are moved back by an offset, then their edges are drawn; backs are drawn as points. */
#include "window.h"

static void draw(void)
{
    clear(1, 1, 1);
    camera(1, 1.5, 3.5);
    glEnable(GL_DEPTH_TEST);
    glRotatef(20.0f * frame, 0, 1, 0);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glColor3f(0.9f, 0.9f, 0.7f);
    torus(0.35f, 0.9f, 6, 9);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glPolygonMode(GL_FRONT, GL_LINE);
    glPolygonMode(GL_BACK, frame == 2 ? GL_POINT : GL_LINE);
    glColor3f(0.1f, 0.1f, 0.5f);
    torus(0.35f, 0.9f, 6, 9);
}

int main(int argc, char **argv)
{
    last_frame = 2;
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
