/* A Bezier surface by evaluators, with normals that GL computes; and a curve. */
#include "window.h"

static float patch[4][4][3];

static void draw(void)
{
    clear(0.2f, 0.2f, 0.2f);
    camera(1, 2.5, 4);
    light(1, 3, 1, 0);
    glEnable(GL_AUTO_NORMAL);
    glMap2f(GL_MAP2_VERTEX_3, 0, 1, 3, 4, 0, 1, 12, 4, &patch[0][0][0]);
    glEnable(GL_MAP2_VERTEX_3);
    glMapGrid2f(6, 0, 1, 6, 0, 1);
    glEvalMesh2(frame ? GL_LINE : GL_FILL, 0, 6, 0, 6);
    glDisable(GL_LIGHTING);
    glColor3f(1, 1, 0);
    glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 4, &patch[frame][0][0]);
    glEnable(GL_MAP1_VERTEX_3);
    glBegin(GL_LINE_STRIP);
    for (int i = 0; i <= 10; i++)
        glEvalCoord1f(i / 10.0f);
    glEnd();
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            patch[i][j][0] = j - 1.5f;
            patch[i][j][1] = (i == 1 || i == 2) && (j == 1 || j == 2) ? 1.5f : 0;
            patch[i][j][2] = 1.5f - i;
        }
    glutMainLoop();
}
