/* Fog: the three formulas in three frames, then by fog coordinates. */
#include "window.h"

static void draw(void)
{
    static const GLint modes[] = {GL_LINEAR, GL_EXP, GL_EXP2, GL_LINEAR};
    float color[] = {0.7f, 0.75f, 0.8f, 1};
    clear(color[0], color[1], color[2]);
    camera(0, 2, 6);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_FOG);
    glFogi(GL_FOG_MODE, modes[frame]);
    glFogfv(GL_FOG_COLOR, color);
    glFogf(GL_FOG_START, 3);
    glFogf(GL_FOG_END, 11);
    glFogf(GL_FOG_DENSITY, 0.15f);
    glHint(GL_FOG_HINT, frame & 1 ? GL_NICEST : GL_FASTEST);
    glFogi(GL_FOG_COORDINATE_SOURCE, frame == 3 ? GL_FOG_COORDINATE : GL_FRAGMENT_DEPTH);
    for (int i = 0; i < 6; i++) {
        glColor3f(1 - i * 0.15f, 0.2f + 0.1f * i, 0.1f);
        glFogCoordf(2.0f + 1.5f * i);
        glPushMatrix();
        glTranslatef(i - 2.5f, 0, 3.0f - 1.8f * i);
        glRotatef(20.0f * i, 0, 1, 0);
        box(0.45f);
        glPopMatrix();
    }
}

int main(int argc, char **argv)
{
    last_frame = 3;
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
