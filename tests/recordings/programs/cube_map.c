/* A box that reflects a cube map with six plain sides and a border between them. */
#include "window.h"

static void draw(void)
{
    static const GLenum names[] = {GL_S, GL_T, GL_R}, switches[] = {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T,
                                                                    GL_TEXTURE_GEN_R};
    clear(0.2f, 0.2f, 0.2f);
    camera(1, 1, 3.5);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_TEXTURE_CUBE_MAP);
    for (int i = 0; i < 3; i++) {
        glTexGeni(names[i], GL_TEXTURE_GEN_MODE, frame ? GL_NORMAL_MAP : GL_REFLECTION_MAP);
        glEnable(switches[i]);
    }
    glRotatef(20.0f * frame, 1, 1, 0);
    torus(0.4f, 0.8f, 10, 12);
}

int main(int argc, char **argv)
{
    unsigned char side[8 * 8 * 3];
    open_window(&argc, argv, 64, 48);
    for (int face = 0; face < 6; face++) {
        for (int i = 0; i < 64; i++) {
            int edge = i % 8 == 0 || i % 8 == 7 || i / 8 == 0 || i / 8 == 7;
            for (int k = 0; k < 3; k++)
                side[3 * i + k] = edge ? 20 : ((face + 1) >> k & 1) * 200 + 4 * (i % 8);
        }
        glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGB8, 8, 8, 0, GL_RGB, GL_UNSIGNED_BYTE, side);
    }
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glutMainLoop();
}
