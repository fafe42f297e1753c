/* Occlusion queries: a box is drawn in a colour that depends on whether its bounding box would be seen. */
#include "window.h"

static void draw(void)
{
    GLuint query, samples = 0;
    clear(0.3f, 0.3f, 0.3f);
    camera(0, 1, 5);
    glEnable(GL_DEPTH_TEST);
    glColor3f(0.3f, 0.3f, 0.8f);
    box(0.7f);
    glGenQueries(1, &query);
    for (int i = 0; i < 3; i++) {
        glPushMatrix();
        glTranslatef(i - 1.0f + 0.2f * frame, 0.1f, -1.5f);
        glColorMask(0, 0, 0, 0);
        glDepthMask(0);
        glBeginQuery(GL_SAMPLES_PASSED, query);
        box(0.3f);
        glEndQuery(GL_SAMPLES_PASSED);
        glColorMask(1, 1, 1, 1);
        glDepthMask(1);
        glGetQueryObjectuiv(query, GL_QUERY_RESULT, &samples);
        glColor3f(samples > 0, samples > 60, 0);
        box(0.3f);
        glPopMatrix();
    }
    glDeleteQueries(1, &query);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
