/* Trees as textured squares that face the camera, cut out by the alpha test, in front of a sky without depth. */
#include "window.h"

static void draw(void)
{
    clear(0, 0, 0);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_TEXTURE_2D);
    glDepthMask(0);
    glBegin(GL_QUADS);
    glColor3f(0.6f, 0.7f, 1), glVertex2f(-1, -1), glVertex2f(1, -1);
    glColor3f(0.1f, 0.2f, 0.7f), glVertex2f(1, 1), glVertex2f(-1, 1);
    glEnd();
    glDepthMask(1);
    camera(0, 1, 6);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_ALPHA_TEST);
    glAlphaFunc(frame ? GL_GEQUAL : GL_GREATER, 0.5f);
    glColor3f(1, 1, 1);
    for (int i = 0; i < 7; i++) {
        float matrix[16];
        glPushMatrix();
        glRotatef(20 * frame, 0, 1, 0);
        glTranslatef(i % 3 - 1.0f, 0, 3.0f - i);
        glGetFloatv(GL_MODELVIEW_MATRIX, matrix);
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++)
                matrix[4 * k + l] = k == l;
        glLoadMatrixf(matrix);
        glBegin(GL_QUADS);
        glTexCoord2f(0, 0), glVertex2f(-0.5f, -0.5f);
        glTexCoord2f(1, 0), glVertex2f(0.5f, -0.5f);
        glTexCoord2f(1, 1), glVertex2f(0.5f, 0.9f);
        glTexCoord2f(0, 1), glVertex2f(-0.5f, 0.9f);
        glEnd();
        glPopMatrix();
    }
}

int main(int argc, char **argv)
{
    unsigned char tree[16 * 16 * 2];
    open_window(&argc, argv, 64, 48);
    for (int i = 0; i < 256; i++) {
        int x = i % 16 - 8, y = i / 16;
        tree[2 * i] = 90 + 8 * y;
        tree[2 * i + 1] = (y < 5 ? abs(x) < 2 : abs(x) < (18 - y) / 2) ? 255 : 0;
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE_ALPHA, 16, 16, 0, GL_LUMINANCE_ALPHA, GL_UNSIGNED_BYTE, tree);
    glutMainLoop();
}
