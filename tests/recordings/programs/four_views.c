/* An editor's four views: viewports with scissored clears, three of them parallel projections as wires. */
#include "window.h"

static void draw(void)
{
    clear(0, 0, 0);
    glEnable(GL_SCISSOR_TEST);
    for (int view = 0; view < 4; view++) {
        int x = view % 2 * 33, y = view / 2 * 25;
        glViewport(x, y, 31, 23);
        glScissor(x, y, 31, 23);
        clear(0.2f * view, 0.3f, 0.5f);
        if (view == 3) {
            camera(2, 2, 3);
            glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
            light(1, 2, 3, 0);
        } else {
            glMatrixMode(GL_PROJECTION);
            glLoadIdentity();
            glOrtho(-1.5, 1.5, -1.2, 1.2, -5, 5);
            glMatrixMode(GL_MODELVIEW);
            glLoadIdentity();
            glRotatef(90, view == 0, view == 1, view == 2);
            glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
            glDisable(GL_LIGHTING);
        }
        glRotatef(30 + 15.0f * frame, 1, 1, 0);
        box(0.6f);
    }
    glDisable(GL_SCISSOR_TEST);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
