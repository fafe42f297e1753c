/* GLU's quadrics: a sphere, a cone, a disk and a part of one, filled, as lines and as points. */
#include "window.h"

static void draw(void)
{
    static const GLenum styles[] = {GLU_FILL, GLU_LINE, GLU_SILHOUETTE, GLU_POINT};
    GLUquadric *quadric = gluNewQuadric();
    clear(0.1f, 0.3f, 0.2f);
    camera(0, 2, 5);
    light(1, 2, 2, 0);
    gluQuadricDrawStyle(quadric, styles[frame]);
    gluQuadricNormals(quadric, frame ? GLU_FLAT : GLU_SMOOTH);
    glTranslatef(-1.5f, 0, 0);
    gluSphere(quadric, 0.6, 8, 6);
    glTranslatef(1.3f, 0, 0);
    gluCylinder(quadric, 0.5, 0.1, 1, 8, 2);
    glTranslatef(1.3f, 0, 0);
    gluDisk(quadric, 0.2, 0.6, 8, 2);
    gluPartialDisk(quadric, 0.65, 0.9, 8, 1, 30, 200);
    gluDeleteQuadric(quadric);
}

int main(int argc, char **argv)
{
    last_frame = 3;
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
