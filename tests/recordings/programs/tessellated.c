/* GLU's tessellator: a star and a square with a hole, by two winding rules, in a display list. */
#include "window.h"

static double star[5][3], outer[4][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                          inner[4][3] = {{-0.4, -0.4, 0}, {0.5, -0.3, 0}, {0.4, 0.5, 0}, {-0.5, 0.3, 0}};

static void contour(GLUtesselator *tess, double (*points)[3], int n)
{
    gluTessBeginContour(tess);
    for (int i = 0; i < n; i++)
        gluTessVertex(tess, points[i], points[i]);
    gluTessEndContour(tess);
}

static void draw(void)
{
    GLUtesselator *tess = gluNewTess();
    gluTessCallback(tess, GLU_TESS_BEGIN, (_GLUfuncptr)glBegin);
    gluTessCallback(tess, GLU_TESS_VERTEX, (_GLUfuncptr)glVertex3dv);
    gluTessCallback(tess, GLU_TESS_END, (_GLUfuncptr)glEnd);
    gluTessProperty(tess, GLU_TESS_WINDING_RULE, frame ? GLU_TESS_WINDING_NONZERO : GLU_TESS_WINDING_ODD);
    glNewList(1, GL_COMPILE);
    gluTessBeginPolygon(tess, NULL);
    contour(tess, star, 5);
    gluTessEndPolygon(tess);
    glTranslatef(2, 0, 0);
    gluTessBeginPolygon(tess, NULL);
    contour(tess, outer, 4);
    contour(tess, inner, 4);
    gluTessEndPolygon(tess);
    glEndList();
    clear(0.9f, 0.8f, 0.7f);
    camera(0, 1, 4);
    glTranslatef(-0.9f, 0, 0);
    glColor3f(0.1f, 0.1f, 0.6f);
    glCallList(1);
    gluDeleteTess(tess);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    for (int i = 0; i < 5; i++)
        star[i][0] = sin(i * 2.5132741), star[i][1] = cos(i * 2.5132741);
    glutMainLoop();
}
