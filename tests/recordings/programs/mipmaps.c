/* A floor to the horizon with every filter for minification; the levels are built by GLU, or by GL itself. */
#include "window.h"

static void draw(void)
{
    static const GLint filters[] = {GL_NEAREST, GL_LINEAR_MIPMAP_NEAREST, GL_NEAREST_MIPMAP_LINEAR,
                                    GL_LINEAR_MIPMAP_LINEAR};
    clear(0.4f, 0.6f, 0.9f);
    camera(0, 0.7, 5);
    glEnable(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filters[frame]);
    glTexEnvf(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, frame == 3 ? 0.7f : 0);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    floor_quad(9, -0.4f, 16);
}

int main(int argc, char **argv)
{
    static const unsigned char levels[16][3] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 0}};
    unsigned char texels[16 * 16 * 3];
    last_frame = 3;
    open_window(&argc, argv, 64, 48);
    for (int i = 0; i < 256; i++)
        memcpy(texels + 3 * i, levels[(i / 4 + i / 64) & 3], 3);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gluBuild2DMipmaps(GL_TEXTURE_2D, GL_RGB, 16, 16, GL_RGB, GL_UNSIGNED_BYTE, texels);
    glutMainLoop();
}
