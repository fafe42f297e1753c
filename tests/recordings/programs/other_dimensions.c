/* Contour lines by a one-dimensional texture, and a solid pattern by a three-dimensional one. */
#include "window.h"

static void draw(void)
{
    float plane[] = {0, 1.5f, 0, 0.25f * frame};
    clear(0.1f, 0.1f, 0.1f);
    camera(1, 1.5, 4);
    light(1, 2, 2, 0);
    glEnable(GL_TEXTURE_1D);
    glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
    glTexGenfv(GL_S, GL_OBJECT_PLANE, plane);
    glEnable(GL_TEXTURE_GEN_S);
    glTranslatef(-0.9f, 0, 0);
    torus(0.3f, 0.6f, 8, 10);
    glDisable(GL_TEXTURE_1D);
    glDisable(GL_TEXTURE_GEN_S);
    glEnable(GL_TEXTURE_3D);
    glTranslatef(1.8f, 0, 0);
    glBegin(GL_TRIANGLE_FAN);
    for (int i = 0; i < 8; i++) {
        float x = cosf(i * 0.8f), y = sinf(i * 0.8f);
        glTexCoord3f(x, y, 0.3f * i);
        glVertex3f(0.8f * x, 0.8f * y, 0);
    }
    glEnd();
    glDisable(GL_TEXTURE_3D);
}

int main(int argc, char **argv)
{
    unsigned char texels[4 * 4 * 4 * 3];
    open_window(&argc, argv, 64, 48);
    for (unsigned i = 0; i < sizeof texels; i++)
        texels[i] = i * 37;
    glTexParameteri(GL_TEXTURE_1D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage1D(GL_TEXTURE_1D, 0, GL_RGB, 16, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage3D(GL_TEXTURE_3D, 0, GL_RGB, 4, 4, 4, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
    glutMainLoop();
}
