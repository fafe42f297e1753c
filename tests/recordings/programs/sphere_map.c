/* A chrome torus: sphere-mapped reflections, with a separate specular colour. */
#include "window.h"

static void draw(void)
{
    float white[] = {1, 1, 1, 1};
    clear(0.5f, 0.5f, 0.6f);
    camera(0, 1, 4);
    light(2, 2, 2, 0);
    glMaterialfv(GL_FRONT, GL_SPECULAR, white);
    glMaterialf(GL_FRONT, GL_SHININESS, 20);
    glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, frame ? GL_SEPARATE_SPECULAR_COLOR : GL_SINGLE_COLOR);
    glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP);
    glTexGeni(GL_T, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP);
    glEnable(GL_TEXTURE_GEN_S);
    glEnable(GL_TEXTURE_GEN_T);
    glEnable(GL_TEXTURE_2D);
    glRotatef(25.0f * frame, 1, 0, 0);
    torus(0.35f, 0.9f, 10, 14);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    checkerboard(16, 2);
    glutMainLoop();
}
