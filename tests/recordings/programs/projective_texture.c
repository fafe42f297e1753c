/* A slide projector: eye-linear texture coordinates, projected by the texture matrix. */
#include "window.h"

static void draw(void)
{
    static const GLenum names[] = {GL_S, GL_T, GL_R, GL_Q}, switches[] = {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T,
                                                                          GL_TEXTURE_GEN_R, GL_TEXTURE_GEN_Q};
    clear(0.1f, 0.2f, 0.1f);
    camera(2, 2, 4);
    light(1, 4, 2, 0);
    glEnable(GL_TEXTURE_2D);
    for (int i = 0; i < 4; i++) {
        float plane[4] = {i == 0, i == 1, i == 2, i == 3};
        glTexGeni(names[i], GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR);
        glTexGenfv(names[i], GL_EYE_PLANE, plane);
        glEnable(switches[i]);
    }
    glMatrixMode(GL_TEXTURE);
    glLoadIdentity();
    glTranslatef(0.5f, 0.5f, 0);
    glScalef(0.5f, 0.5f, 1);
    gluPerspective(50, 1, 1, 10);
    gluLookAt(0.5 * frame, 3, 1, 0, 0, 0, 0, 0, -1);
    glMatrixMode(GL_MODELVIEW);
    floor_quad(2, -0.5f, 1);
    box(0.5f);
}

int main(int argc, char **argv)
{
    float border[] = {0.9f, 0.9f, 0.9f, 1};
    open_window(&argc, argv, 64, 48);
    checkerboard(16, 4);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
    glutMainLoop();
}
