/* Shadow volumes: the sides of an extruded square, counted with two-sided stencil operations behind the surfaces. */
#include "window.h"

static const float corners[4][3] = {{-0.5f, 1, -0.5f}, {-0.5f, 1, 0.5f}, {0.5f, 1, 0.5f}, {0.5f, 1, -0.5f}};
static float lamp[] = {0.7f, 2.5f, 0.4f, 1};

static void far_corner(int i)
{
    glVertex4f(corners[i][0] - lamp[0], corners[i][1] - lamp[1], corners[i][2] - lamp[2], 0);
}

static void caster(void)
{
    glBegin(GL_QUADS);
    glNormal3f(0, 1, 0);
    for (int i = 0; i < 4; i++)
        glVertex3fv(corners[i]);
    glEnd();
}

static void volume(void)
{
    caster();
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        int j = (i + 1) % 4;
        glVertex3fv(corners[j]);
        glVertex3fv(corners[i]);
        far_corner(i);
        far_corner(j);
    }
    for (int i = 3; i >= 0; i--)
        far_corner(i);
    glEnd();
}

static void scene(void)
{
    glColor3f(0.8f, 0.8f, 0.7f);
    floor_quad(2.5f, 0, 1);
    glColor3f(0.8f, 0.3f, 0.2f);
    caster();
}

static void draw(void)
{
    lamp[0] = 0.7f - 0.9f * frame;
    clear(0.1f, 0.1f, 0.3f);
    camera(1, 3, 4.5);
    light(lamp[0], lamp[1], lamp[2], 1);
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
    glEnable(GL_COLOR_MATERIAL);
    glDepthFunc(GL_LEQUAL);
    glDisable(GL_LIGHT0);
    scene();
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 0, ~0u);
    glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_DECR_WRAP, GL_KEEP);
    glStencilOpSeparate(GL_BACK, GL_KEEP, GL_INCR_WRAP, GL_KEEP);
    glColorMask(0, 0, 0, 0);
    glDepthMask(0);
    volume();
    glColorMask(1, 1, 1, 1);
    glStencilFunc(GL_EQUAL, 0, ~0u);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glEnable(GL_LIGHT0);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    scene();
    glDisable(GL_BLEND);
    glDisable(GL_STENCIL_TEST);
    glDepthMask(1);
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
