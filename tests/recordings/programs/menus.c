/* GLUT menus: entries are chosen by the program itself; they change colour and shading. */
#include "window.h"

static float color[] = {0.2f, 0.7f, 0.9f, 1};

static void choose_color(int entry)
{
    color[entry] = 1 - color[entry];
}

static void choose_shading(int entry)
{
    glShadeModel(entry ? GL_FLAT : GL_SMOOTH);
}

static void draw(void)
{
    clear(0.2f, 0.1f, 0.1f);
    camera(0.5, 1, 4);
    light(1, 1, 2, 0);
    glMaterialfv(GL_FRONT, GL_DIFFUSE, color);
    torus(0.3f, 0.9f, 8, 12);
    frame == 0 ? choose_color(0) : choose_shading(1);
}

int main(int argc, char **argv)
{
    int shading;
    last_frame = 2;
    open_window(&argc, argv, 64, 48);
    shading = glutCreateMenu(choose_shading);
    glutAddMenuEntry("smooth", 0);
    glutAddMenuEntry("flat", 1);
    glutCreateMenu(choose_color);
    glutAddMenuEntry("red", 0);
    glutAddMenuEntry("green", 1);
    glutAddSubMenu("shading", shading);
    glutAttachMenu(GLUT_RIGHT_BUTTON);
    glutMainLoop();
}
