/* An open cylinder, lit on both sides with two materials, by a spot light with attenuation and a local viewer. */
#include "window.h"

static void draw(void)
{
    float inside[] = {0.1f, 0.5f, 0.8f, 1}, outside[] = {0.8f, 0.5f, 0.1f, 1}, down[] = {0, -1, -0.2f};
    clear(0, 0, 0);
    camera(1, 2, 3);
    light(0.4f * frame, 2, 1, 1);
    glLightfv(GL_LIGHT0, GL_SPOT_DIRECTION, down);
    glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, 50);
    glLightf(GL_LIGHT0, GL_SPOT_EXPONENT, 4);
    glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, 0.2f);
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
    glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, frame);
    glMaterialfv(GL_FRONT, GL_DIFFUSE, outside);
    glMaterialfv(GL_BACK, GL_DIFFUSE, inside);
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, outside);
    glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 12);
    glBegin(GL_QUAD_STRIP);
    for (int i = 0; i <= 16; i++) {
        float a = 0.32f * i;
        glNormal3f(cosf(a), 0, sinf(a));
        glVertex3f(cosf(a), -0.6f, sinf(a));
        glVertex3f(cosf(a), 0.6f, sinf(a));
    }
    glEnd();
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
