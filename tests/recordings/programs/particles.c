/* A fountain of blended points, whose state is advanced by a small generator of random numbers. */
#include "window.h"

static unsigned seed = 1;
static float place[60][3], speed[60][3];

static float noise(void)
{
    seed = seed * 1103515245u + 12345u;
    return (seed >> 16 & 1023) / 1023.0f;
}

static void draw(void)
{
    clear(0, 0, 0.05f);
    camera(0, 1, 4);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE);
    glPointSize(1 + 2 * frame);
    glBegin(GL_POINTS);
    for (int i = 0; i < 60; i++) {
        for (int k = 0; k < 3; k++)
            place[i][k] += 0.25f * speed[i][k];
        speed[i][1] -= 0.15f;
        glColor4f(1, 0.4f + 0.2f * frame, 0.2f, 0.5f);
        glVertex3fv(place[i]);
    }
    glEnd();
}

int main(int argc, char **argv)
{
    last_frame = 2;
    open_window(&argc, argv, 64, 48);
    for (int i = 0; i < 60; i++) {
        speed[i][0] = noise() - 0.5f;
        speed[i][1] = 1.2f + noise();
        speed[i][2] = noise() - 0.5f;
        place[i][1] = -1;
    }
    glutMainLoop();
}
