/* Rows of materials: ambient, diffuse, specular with growing shininess, emission, and colours that set materials. */
#include "window.h"

static void draw(void)
{
    float none[] = {0, 0, 0, 1}, blue[] = {0.1f, 0.4f, 0.8f, 1}, white[] = {1, 1, 1, 1}, glow[] = {0.3f, 0.2f, 0, 0};
    clear(0, 0.1f, 0.1f);
    camera(0, 0, 6);
    light(0, 3, 2, 0);
    for (int i = 0; i < 6; i++) {
        glMaterialfv(GL_FRONT, GL_AMBIENT, i % 3 == 1 ? blue : none);
        glMaterialfv(GL_FRONT, GL_DIFFUSE, blue);
        glMaterialfv(GL_FRONT, GL_SPECULAR, i ? white : none);
        glMaterialf(GL_FRONT, GL_SHININESS, 20.0f * i);
        glMaterialfv(GL_FRONT, GL_EMISSION, i == 5 ? glow : none);
        if (i == 4) {
            glColorMaterial(GL_FRONT, frame ? GL_AMBIENT_AND_DIFFUSE : GL_SPECULAR);
            glEnable(GL_COLOR_MATERIAL);
            glColor3f(0.9f, 0.3f, 0.5f);
        }
        glPushMatrix();
        glTranslatef(1.8f * (i % 3) - 1.8f, i < 3 ? 0.9f : -0.9f, 0);
        glRotatef(40, 1, 1, 0);
        torus(0.2f, 0.5f, 8, 10);
        glPopMatrix();
        glDisable(GL_COLOR_MATERIAL);
    }
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
