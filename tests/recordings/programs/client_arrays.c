/* Arrays in the program's memory: interleaved, indexed, element by element, and changed between two draws. */
#include "window.h"

static float interleaved[4][6] = {{1, 0, 0, -1, -1, 0}, {0, 1, 0, 1, -1, 0}, {0, 0, 1, 1, 1, 0}, {1, 1, 0, -1, 1, 0}};
static const unsigned short order[] = {0, 1, 2, 0, 2, 3};

static void draw(void)
{
    static double places[] = {-0.3, -0.3, 0.3, -0.3, 0, 0.4};
    static signed char colors[] = {127, 0, 0, 127, 127, 0, 0, 0, 127};
    clear(0.2f, 0.2f, 0.2f);
    camera(0, 0.4, 4);
    glInterleavedArrays(GL_C3F_V3F, 0, interleaved);
    glDrawRangeElements(GL_TRIANGLES, 0, 3, 6, GL_UNSIGNED_SHORT, order);
    interleaved[2][4] += 0.3f;
    glTranslatef(0.5f, 0, 0.5f);
    glBegin(GL_LINE_LOOP);
    for (int i = 0; i < 4; i++)
        glArrayElement(i);
    glEnd();
    glColorPointer(3, GL_BYTE, 0, colors);
    glVertexPointer(2, GL_DOUBLE, 0, places);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisableClientState(GL_COLOR_ARRAY);
    glDisableClientState(GL_VERTEX_ARRAY);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
