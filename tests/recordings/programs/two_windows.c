/* Two windows with a context each; they swap in turns. */
#include "window.h"

static int second;

static void draw(void)
{
    clear(0.4f, 0.1f, 0.1f);
    camera(0, 1, 4);
    glColor3f(1, 0.8f, 0.1f * frame);
    box(0.6f);
    glutPostWindowRedisplay(second);
}

static void draw_second(void)
{
    clear(0.1f, 0.4f, 0.1f);
    glColor3f(0.2f * frame, 1, 1);
    glRectf(-0.5f, -0.5f, 0.2f, 0.7f);
    glutSwapBuffers();
}

int main(int argc, char **argv)
{
    last_frame = 3;
    open_window(&argc, argv, 64, 48);
    glutInitWindowSize(40, 30);
    second = glutCreateWindow("second");
    glutDisplayFunc(draw_second);
    glutMainLoop();
}
