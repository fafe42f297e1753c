/* Motion blur: several positions of an object, averaged in the accumulation buffer. */
#include "window.h"

static void draw(void)
{
    float gold[] = {0.9f, 0.7f, 0.2f, 1};
    for (int i = 0; i < 4; i++) {
        clear(0.1f, 0.1f, 0.15f);
        camera(0, 0.5, 4);
        light(1, 2, 3, 0);
        glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, gold);
        glTranslatef(-0.6f + 0.3f * i + 0.1f * frame, 0, 0);
        glRotatef(12.0f * i, 0, 1, 0);
        box(0.6f);
        glAccum(i ? GL_ACCUM : GL_LOAD, 0.25f);
    }
    glAccum(GL_RETURN, frame ? 0.8f : 1);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
