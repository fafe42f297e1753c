/* A window with a subwindow: an overview, drawn in a context of its own. */
#include "window.h"

static int sub;

static void draw(void)
{
    clear(0.2f, 0.2f, 0.4f);
    camera(0, 1, 4);
    light(1, 1, 1, 0);
    torus(0.3f, 0.8f, 6, 8);
    glutPostWindowRedisplay(sub);
}

static void draw_overview(void)
{
    clear(0.9f, 0.9f, 0.9f);
    glColor3f(0, 0, 0.5f);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glRotatef(10, 0, 0, 1);
    glRectf(-0.6f, -0.6f, 0.6f, 0.6f);
    glutSwapBuffers();
}

int main(int argc, char **argv)
{
    last_frame = 2;
    open_window(&argc, argv, 64, 48);
    sub = glutCreateSubWindow(glutGetWindow(), 40, 28, 20, 16);
    glutDisplayFunc(draw_overview);
    glutMainLoop();
}
