/* One image in many formats: packed pixels, BGRA, alpha, intensity, rows with skips, and a part replaced. */
#include "window.h"

static const struct {
    GLint internal;
    GLenum format, type;
} kinds[] = {{GL_RGB, GL_RGB, GL_UNSIGNED_SHORT_5_6_5},   {GL_RGBA, GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4},
             {GL_RGBA, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV}, {GL_RGB5_A1, GL_BGRA, GL_UNSIGNED_SHORT_1_5_5_5_REV},
             {GL_ALPHA, GL_ALPHA, GL_UNSIGNED_BYTE},      {GL_INTENSITY8, GL_LUMINANCE, GL_UNSIGNED_BYTE},
             {GL_LUMINANCE8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE}, {GL_RGBA4, GL_RGBA, GL_FLOAT}};

static void draw(void)
{
    static float data[400];
    unsigned *words = (unsigned *)data;
    clear(0.3f, 0.3f, 0.3f);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    gluOrtho2D(0, 4, 0, 2);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, frame ? GL_LINEAR : GL_NEAREST);
    for (int k = 0; k < 8; k++) {
        for (int i = 0; i < 400; i++)
            if (kinds[k].type == GL_FLOAT)
                data[i] = (i % 17) / 16.0f;
            else
                words[i] = 0x9E3779B9u * (i + 1);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1 << (k & 3));
        glPixelStorei(GL_UNPACK_ROW_LENGTH, frame ? 9 : 0);
        glPixelStorei(GL_UNPACK_SKIP_PIXELS, frame);
        glTexImage2D(GL_TEXTURE_2D, 0, kinds[k].internal, 8, 8, 0, kinds[k].format, kinds[k].type, data);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 2, 1, 3, 4, kinds[k].format, kinds[k].type, data + 1);
        glColor4f(1, 0.9f, 0.8f, 0.9f);
        glPushMatrix();
        glTranslatef(k % 4, k / 4, 0);
        glBegin(GL_QUADS);
        glTexCoord2f(0, 0), glVertex2f(0.05f, 0.05f), glTexCoord2f(1, 0), glVertex2f(0.95f, 0.05f);
        glTexCoord2f(1, 1), glVertex2f(0.95f, 0.95f), glTexCoord2f(0, 1), glVertex2f(0.05f, 0.95f);
        glEnd();
        glPopMatrix();
    }
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
