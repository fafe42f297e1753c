/* Gears in display lists that turn. */
#include "window.h"

static GLuint lists;

static void gear(float inner, float outer, float width, int teeth)
{
    float step = 6.2831853f / teeth / 4;
    for (int side = -1; side <= 1; side += 2) {
        glNormal3f(0, 0, side);
        glBegin(GL_QUAD_STRIP);
        for (int i = 0; i <= teeth * 2; i++) {
            float angle = i * 2 * step, edge = i & 1 ? outer : outer - 0.15f;
            glVertex3f(inner * cosf(angle), inner * sinf(angle), side * width);
            glVertex3f(edge * cosf(angle), edge * sinf(angle), side * width);
        }
        glEnd();
    }
    glShadeModel(GL_FLAT);
    glBegin(GL_QUAD_STRIP);
    for (int i = 0; i <= teeth * 2; i++) {
        float angle = i * 2 * step, edge = i & 1 ? outer : outer - 0.15f;
        glNormal3f(cosf(angle), sinf(angle), 0);
        glVertex3f(edge * cosf(angle), edge * sinf(angle), width);
        glVertex3f(edge * cosf(angle), edge * sinf(angle), -width);
    }
    glEnd();
    glShadeModel(GL_SMOOTH);
}

static void draw(void)
{
    clear(0, 0, 0);
    camera(1.2, 1.4, 5);
    light(5, 5, 10, 0);
    glEnable(GL_CULL_FACE);
    for (int i = 0; i < 3; i++) {
        glPushMatrix();
        glTranslatef(i - 1.0f, i == 1 ? 0.8f : -0.5f, 0);
        glRotatef(frame * (i == 1 ? -12.0f : 9.0f), 0, 0, 1);
        glCallList(lists + i);
        glPopMatrix();
    }
}

int main(int argc, char **argv)
{
    static const float colors[3][4] = {{0.8f, 0.1f, 0, 1}, {0, 0.8f, 0.2f, 1}, {0.2f, 0.2f, 1, 1}};
    last_frame = 2;
    open_window(&argc, argv, 64, 48);
    lists = glGenLists(3);
    for (int i = 0; i < 3; i++) {
        glNewList(lists + i, GL_COMPILE);
        glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, colors[i]);
        gear(0.2f, 0.9f - 0.1f * i, 0.2f, 8 + 2 * i);
        glEndList();
    }
    glutMainLoop();
}
