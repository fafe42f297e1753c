/* Point sprites whose size falls with the distance. */
#include "window.h"

static void draw(void)
{
    float attenuation[] = {0.2f, 0, 0.05f};
    clear(0, 0, 0);
    camera(1, 1, 5);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_POINT_SPRITE);
    glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, GL_TRUE);
    glPointParameterfv(GL_POINT_DISTANCE_ATTENUATION, attenuation);
    glPointParameterf(GL_POINT_SIZE_MIN, 3);
    glPointSize(8);
    glBegin(GL_POINTS);
    for (int i = 0; i < 8; i++)
        glVertex3f(i - 3.5f, 0.3f * frame, 2 - i);
    glEnd();
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    checkerboard(8, 4);
    glutMainLoop();
}
