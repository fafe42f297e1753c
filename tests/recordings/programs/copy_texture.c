/* A feedback tunnel: each frame's picture is copied into a texture that the next frame draws a little smaller. */
#include "window.h"

static void draw(void)
{
    clear(0.1f, 0.1f * frame, 0.2f);
    camera(0, 0, 3);
    glEnable(GL_TEXTURE_2D);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_DECAL);
    glColor3f(1, 1, 1);
    glPushMatrix();
    glRotatef(15.0f * frame, 0, 0, 1);
    box(0.8f);
    glPopMatrix();
    glDisable(GL_TEXTURE_2D);
    glColor3f(1, 0.2f * frame, 0);
    glRectf(-1.2f, 0.7f, -0.5f, 1);
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 16, 8, 32, 32);
}

int main(int argc, char **argv)
{
    last_frame = 3;
    open_window(&argc, argv, 64, 48);
    checkerboard(32, 8);
    glutMainLoop();
}
