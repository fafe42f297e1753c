/* Transparent squares from back to front and in the wrong order; other blend equations and a constant colour. */
#include "window.h"

static void square(int i)
{
    static const float colors[3][4] = {{1, 0, 0, 0.5f}, {0, 1, 0, 0.6f}, {0, 0.3f, 1, 0.4f}};
    glColor4fv(colors[i]);
    glPushMatrix();
    glTranslatef(0.4f * i - 0.4f, 0.2f * i - 0.2f, 0.5f * i);
    glRectf(-0.7f, -0.7f, 0.7f, 0.7f);
    glPopMatrix();
}

static void draw(void)
{
    static const GLenum equations[] = {GL_FUNC_ADD, GL_FUNC_ADD, GL_FUNC_REVERSE_SUBTRACT, GL_MAX, GL_FUNC_ADD};
    clear(0.6f, 0.6f, 0.5f);
    camera(0, 0, 4);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquationSeparate(equations[frame], GL_FUNC_ADD);
    glBlendColor(0.2f, 0.8f, 0.5f, 0.3f);
    if (frame == 4)
        glBlendFuncSeparate(GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_ALPHA, GL_ONE, GL_DST_ALPHA);
    else
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    for (int i = 0; i < 3; i++)
        square(frame == 1 ? 2 - i : i);
}

int main(int argc, char **argv)
{
    last_frame = 4;
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
