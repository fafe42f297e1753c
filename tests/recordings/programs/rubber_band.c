/* A rubber band: a rectangle drawn and removed with exclusive-or, in a window with one buffer; glFlush ends frames. */
#include "window.h"

static void band(int size)
{
    glEnable(GL_COLOR_LOGIC_OP);
    glLogicOp(GL_XOR);
    glColor3f(1, 1, 1);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glRecti(5, 5, 10 + size, 8 + size);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glDisable(GL_COLOR_LOGIC_OP);
}

static void draw(void)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    gluOrtho2D(0, 64, 0, 48);
    if (frame == 0) {
        clear(0.2f, 0.4f, 0.6f);
        glColor3f(0.8f, 0.6f, 0.1f);
        glRectf(20, 10, 50, 40);
    } else
        band(10 * frame - 10);
    if (frame < 3)
        band(10 * frame);
    glFlush();
    if (frame++ == 3)
        exit(0);
    glutPostRedisplay();
}

int main(int argc, char **argv)
{
    glutInit(&argc, argv);
    glutInitDisplayMode(GLUT_SINGLE | GLUT_RGB | GLUT_DEPTH | GLUT_STENCIL);
    glutInitWindowSize(64, 48);
    glutCreateWindow(argv[0]);
    glutDisplayFunc(draw);
    glutMainLoop();
}
