/* A wall with a second texture: modulated as a light map, added, and interpolated by GL_COMBINE. */
#include "window.h"

static GLuint wall, spot;

static void corner(float x, float y)
{
    glMultiTexCoord2f(GL_TEXTURE0, 2 * x, 2 * y);
    glMultiTexCoord2f(GL_TEXTURE1, x, y);
    glVertex3f(3 * x - 1.5f, 2 * y - 1, x - 0.5f);
}

static void draw(void)
{
    clear(0, 0, 0);
    camera(0.5, 0.4, 3);
    glActiveTexture(GL_TEXTURE0);
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, wall);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    glActiveTexture(GL_TEXTURE1);
    glEnable(GL_TEXTURE_2D);
    glBindTexture(GL_TEXTURE_2D, spot);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, frame == 0 ? GL_MODULATE : frame == 1 ? GL_ADD : GL_COMBINE);
    glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_INTERPOLATE);
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE0_RGB, GL_PREVIOUS);
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE1_RGB, GL_PRIMARY_COLOR);
    glTexEnvi(GL_TEXTURE_ENV, GL_SOURCE2_RGB, GL_TEXTURE);
    glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND2_RGB, GL_SRC_COLOR);
    glTexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, 2);
    glColor3f(0.1f, 0.5f, 0.2f);
    glBegin(GL_QUADS);
    corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1);
    glEnd();
}

int main(int argc, char **argv)
{
    unsigned char light[64];
    last_frame = 2;
    open_window(&argc, argv, 64, 48);
    wall = checkerboard(16, 4);
    for (int i = 0; i < 64; i++)
        light[i] = 250 - 9 * ((i % 8 - 4) * (i % 8 - 4) + (i / 8 - 4) * (i / 8 - 4)) / 2;
    glGenTextures(1, &spot);
    glBindTexture(GL_TEXTURE_2D, spot);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, 8, 8, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, light);
    glutMainLoop();
}
