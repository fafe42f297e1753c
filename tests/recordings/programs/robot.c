/* A robot arm: nested matrices, one part of the arm in the coordinates of the part before. */
#include "window.h"

static void part(float length)
{
    glPushMatrix();
    glTranslatef(length / 2, 0, 0);
    glScalef(length, 0.4f, 0.5f);
    box(0.5f);
    glPopMatrix();
    glTranslatef(length, 0, 0);
}

static void draw(void)
{
    clear(0.1f, 0.1f, 0.1f);
    camera(0, 0.5, 5);
    light(1, 2, 3, 0);
    glTranslatef(-1.5f, -0.4f, 0);
    for (int i = 0; i < 3; i++) {
        glRotatef(15 + 10.0f * frame, 0, 0.3f * i, 1);
        part(1.2f - 0.2f * i);
    }
    for (int finger = -1; finger <= 1; finger++) {
        glPushMatrix();
        glRotatef(25.0f * finger, 0, 0, 1);
        part(0.4f);
        glPopMatrix();
    }
}

int main(int argc, char **argv)
{
    last_frame = 2;
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
