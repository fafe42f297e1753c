/* Text of GLUT's bitmap fonts over a scene, placed by glRasterPos and glWindowPos. */
#include "window.h"

static void draw(void)
{
    clear(0.1f, 0.1f, 0.4f);
    camera(0, 0.5, 4);
    glColor3f(0.8f, 0.4f, 0.1f);
    box(0.5f);
    glColor3f(1, 1, 1);
    glRasterPos3f(-1, 0.6f, 0.2f * frame);
    for (const char *c = "Frame"; *c; c++)
        glutBitmapCharacter(GLUT_BITMAP_HELVETICA_10, *c);
    glColor3f(1, 1, 0);
    glWindowPos2i(20 + 3 * frame, 6);
    glutBitmapCharacter(GLUT_BITMAP_8_BY_13, '0' + frame);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
