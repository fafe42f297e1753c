/* Images without textures: glDrawPixels with zoom and pixel transfer, glCopyPixels, and a bitmap. */
#include "window.h"

static unsigned char image[12 * 12 * 3];

static void draw(void)
{
    static const unsigned char arrow[] = {0x18, 0x18, 0x18, 0x18, 0xFF, 0x7E, 0x3C, 0x18};
    clear(0.4f, 0.3f, 0.2f);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    gluOrtho2D(0, 64, 0, 48);
    glRasterPos2i(3, 4);
    glPixelZoom(1.5f + frame, 1.5f);
    glPixelTransferf(GL_RED_SCALE, frame ? 0.5f : 1);
    glDrawPixels(12, 12, GL_RGB, GL_UNSIGNED_BYTE, image);
    glPixelTransferf(GL_RED_SCALE, 1);
    glPixelZoom(1, frame ? -1 : 1);
    glRasterPos2i(40, 30);
    glCopyPixels(2, 2, 16, 16, GL_COLOR);
    glPixelZoom(1, 1);
    glColor3f(1, 1, 0);
    glRasterPos2i(5, 36);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int i = 0; i < 3; i++)
        glBitmap(8, 8, 0, 0, 10, 1, arrow);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    for (int i = 0; i < 144; i++)
        image[3 * i] = 20 * (i % 12), image[3 * i + 1] = 20 * (i / 12), image[3 * i + 2] = 128;
    glutMainLoop();
}
