/* Bump mapping by GL_DOT3_RGB: normals in a texture, the direction to the light in the colour. */
#include "window.h"

static void draw(void)
{
    clear(0, 0, 0);
    camera(0.3, 0.3, 2.8);
    glEnable(GL_TEXTURE_2D);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
    glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, frame == 2 ? GL_DOT3_RGBA : GL_DOT3_RGB);
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_RGB, GL_TEXTURE);
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE1_RGB, GL_PRIMARY_COLOR);
    glColor3f(0.5f + 0.35f * cosf(frame * 2), 0.5f + 0.35f * sinf(frame * 2), 0.8f);
    glRotatef(10, 1, 1, 0);
    glBegin(GL_QUADS);
    glTexCoord2f(0, 0), glVertex2f(-1, -1), glTexCoord2f(2, 0), glVertex2f(1, -1);
    glTexCoord2f(2, 2), glVertex2f(1, 1), glTexCoord2f(0, 2), glVertex2f(-1, 1);
    glEnd();
}

int main(int argc, char **argv)
{
    unsigned char normals[16 * 16 * 3];
    last_frame = 2;
    open_window(&argc, argv, 64, 48);
    for (int i = 0; i < 256; i++) {
        float x = (i % 16 - 7.5f) / 9, y = (i / 16 - 7.5f) / 9, z = sqrtf(fmaxf(0.05f, 1 - x * x - y * y));
        normals[3 * i] = 128 + 127 * x, normals[3 * i + 1] = 128 + 127 * y, normals[3 * i + 2] = 128 + 127 * z;
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 16, 16, 0, GL_RGB, GL_UNSIGNED_BYTE, normals);
    glutMainLoop();
}
