/* The window is made larger, then smaller, in the middle of the program. */
#include "window.h"

static void reshape(int width, int height)
{
    glViewport(0, 0, width, height);
}

static void draw(void)
{
    clear(0.8f, 0.5f, 0.2f);
    camera(0.5, 1, 4);
    light(1, 2, 1, 0);
    box(0.8f);
    if (frame == 1)
        glutReshapeWindow(80, 40);
    if (frame == 3)
        glutReshapeWindow(33, 51);
    glutMainLoopEvent();
}

int main(int argc, char **argv)
{
    last_frame = 5;
    open_window(&argc, argv, 64, 48);
    glutReshapeFunc(reshape);
    glutMainLoop();
}
