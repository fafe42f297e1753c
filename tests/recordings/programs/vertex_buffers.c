/* Buffer objects: a wave, rewritten each frame by glMapBuffer, with indices in a buffer, and glMultiDrawArrays. */
#include "window.h"

static GLuint buffers[2];

static void draw(void)
{
    float *place;
    clear(0.1f, 0.2f, 0.2f);
    camera(0, 2, 4);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    place = glMapBuffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY);
    for (int i = 0; i < 64; i++) {
        *place++ = 0.4f * (i % 8) - 1.4f;
        *place++ = 0.3f * sinf(i * 0.8f + frame);
        *place++ = 0.4f * (i / 8) - 1.4f;
    }
    glUnmapBuffer(GL_ARRAY_BUFFER);
    glVertexPointer(3, GL_FLOAT, 0, NULL);
    glEnableClientState(GL_VERTEX_ARRAY);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    glEnable(GL_DEPTH_TEST);
    for (int row = 0; row < 7; row++) {
        glColor3f(0.1f * row, 0.8f, 1 - 0.1f * row);
        glDrawElements(GL_QUAD_STRIP, 16, GL_UNSIGNED_BYTE, (char *)0 + 16 * row);
    }
    glColor3f(1, 1, 1);
    glMultiDrawArrays(GL_LINE_STRIP, (GLint[]){0, 24, 56}, (GLsizei[]){8, 8, 8}, 3);
}

int main(int argc, char **argv)
{
    unsigned char indices[7 * 16];
    last_frame = 2;
    open_window(&argc, argv, 64, 48);
    for (int i = 0; i < 7 * 16; i++)
        indices[i] = i / 16 * 8 + i % 16 / 2 + (i & 1) * 8;
    glGenBuffers(2, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, 64 * 12, NULL, GL_DYNAMIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof indices, indices, GL_STATIC_DRAW);
    glutMainLoop();
}
