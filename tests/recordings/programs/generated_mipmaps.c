/* Levels that GL generates, limited by base and maximum level, and clamped levels of detail. */
#include "window.h"

static void draw(void)
{
    clear(0.2f, 0.2f, 0.2f);
    camera(0, 0.9, 4);
    glEnable(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, frame == 1);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, frame == 1 ? 2 : 1000);
    glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_LOD, frame == 2 ? 1.5f : 1000);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, frame == 2 ? GL_MIRRORED_REPEAT : GL_REPEAT);
    floor_quad(6, -0.5f, 9);
}

int main(int argc, char **argv)
{
    last_frame = 2;
    open_window(&argc, argv, 64, 48);
    glGenTextures(1, (GLuint[1]){0});
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
    checkerboard(16, 4);
    glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 3, 3, 2, 2, GL_RGB, GL_UNSIGNED_BYTE, "\377\0\0\377\377\0\0\377\377\0\0\377");
    glutMainLoop();
}
