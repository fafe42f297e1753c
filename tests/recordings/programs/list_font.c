/* A font of strokes: a display list for each letter, a word by glCallLists with a list base. */
#include "window.h"

static void letter(char c, const char *strokes)
{
    glNewList(100 + c, GL_COMPILE);
    glBegin(GL_LINE_STRIP);
    for (; *strokes; strokes++)
        glVertex2f((*strokes - '0') % 3 * 0.4f, (*strokes - '0') / 3 * 0.4f);
    glEnd();
    glTranslatef(1.2f, 0, 0);
    glEndList();
}

static void draw(void)
{
    static const unsigned short word[] = {'O', 'N', 'L', 'Z'};
    clear(0, 0, 0.2f);
    camera(0, 0, 5);
    glColor3f(0, 1, 0.5f);
    glListBase(100);
    glTranslatef(-2, 0.5f, 0);
    glPushMatrix();
    glCallLists(4, GL_UNSIGNED_BYTE, "LOZN");
    glPopMatrix();
    glTranslatef(0, -1.2f, 0);
    glCallLists(4 - frame, GL_UNSIGNED_SHORT, word);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    letter('L', "6302");
    letter('O', "02860");
    letter('Z', "6802");
    letter('N', "0628");
    glutMainLoop();
}
