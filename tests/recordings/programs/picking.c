/* Picking by colour: objects are drawn in colours that number them, a pixel is read, and the scene is drawn anew. */
#include "window.h"

static int picked = -1;

static void objects(int numbered)
{
    for (int i = 0; i < 5; i++) {
        if (numbered)
            glColor3ub(i + 1, 0, 0);
        else if (i == picked)
            glColor3f(1, 1, 0);
        else
            glColor3f(0.2f, 0.15f * i, 0.7f);
        glPushMatrix();
        glTranslatef(1.1f * (i - 2), 0.3f * (i & 1), -0.5f * i);
        glRotatef(30.0f * i, 1, 1, 0);
        box(0.4f);
        glPopMatrix();
    }
}

static void draw(void)
{
    unsigned char pixel[4] = {0};
    glEnable(GL_DEPTH_TEST);
    camera(0, 0.5, 5);
    clear(0, 0, 0);
    glDisable(GL_DITHER);
    objects(1);
    glReadPixels(14 + 12 * frame, 24, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    picked = pixel[0] - 1;
    clear(0.5f, 0.5f, 0.5f);
    objects(0);
}

int main(int argc, char **argv)
{
    last_frame = 2;
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
