/* Picking by the selection buffer: names, hits, and the picked object in another colour. */
#include "window.h"

static GLuint hits[64];
static unsigned picked;

static void objects(GLenum mode)
{
    for (unsigned i = 1; i <= 4; i++) {
        if (mode == GL_SELECT)
            glLoadName(i);
        glColor3f(i == picked, 0.25f * i, 0.5f);
        glPushMatrix();
        glTranslatef(i - 2.5f, 0, -0.3f * i);
        box(0.4f);
        glPopMatrix();
    }
}

static void draw(void)
{
    GLint viewport[] = {0, 0, 64, 48};
    double matrix[16];
    int n;
    glEnable(GL_DEPTH_TEST);
    glSelectBuffer(64, hits);
    glRenderMode(GL_SELECT);
    glInitNames();
    glPushName(0);
    camera(0, 1, 5);
    glMatrixMode(GL_PROJECTION);
    glGetDoublev(GL_PROJECTION_MATRIX, matrix);
    glLoadIdentity();
    gluPickMatrix(20 + 15 * frame, 24, 5, 5, viewport);
    glMultMatrixd(matrix);
    glMatrixMode(GL_MODELVIEW);
    objects(GL_SELECT);
    n = glRenderMode(GL_RENDER);
    picked = n > 0 ? hits[3] : 0;
    clear(0.8f, 0.8f, 0.8f);
    camera(0, 1, 5);
    objects(GL_RENDER);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
