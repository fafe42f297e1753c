/* Lines of several widths, strips and loops, dashed by stipple patterns, and points of several sizes. */
#include "window.h"

static void draw(void)
{
    clear(0, 0, 0);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    gluOrtho2D(0, 64, 0, 48);
    for (int i = 0; i < 6; i++) {
        glColor3f(1, 0.15f * i, 1 - 0.15f * i);
        glLineWidth(1 + (frame ? i % 3 : 0));
        if (i & 1)
            glEnable(GL_LINE_STIPPLE);
        else
            glDisable(GL_LINE_STIPPLE);
        glLineStipple(1 + i / 2, 0x1C47);
        glBegin(i < 2 ? GL_LINES : i < 4 ? GL_LINE_STRIP : GL_LINE_LOOP);
        for (int k = 0; k < 4; k++)
            glVertex2f(3.3f + 15.1f * k + i, 4.2f + 7.0f * i + 5.0f * (k & 1));
        glEnd();
        glPointSize(1 + i);
        glBegin(GL_POINTS);
        glVertex2f(60, 4 + 7.5f * i);
        glEnd();
    }
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
