/* A mirror: the stencil buffer marks the floor, the reflected scene is drawn there, a clip plane keeps it below. */
#include "window.h"

static void scene(void)
{
    glPushMatrix();
    glTranslatef(0, 0.8f, 0);
    glRotatef(25.0f * frame, 0, 1, 0);
    torus(0.25f, 0.55f, 8, 10);
    glPopMatrix();
}

static void draw(void)
{
    double above[] = {0, 1, 0, 0};
    float red[] = {0.9f, 0.2f, 0.1f, 1};
    clear(0.1f, 0.1f, 0.2f);
    camera(1.5, 2.2, 4);
    light(2, 3, 1, 1);
    glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, red);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 1, ~0u);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glColorMask(0, 0, 0, 0);
    glDepthMask(0);
    floor_quad(1.4f, 0, 1);
    glColorMask(1, 1, 1, 1);
    glDepthMask(1);
    glStencilFunc(GL_EQUAL, 1, ~0u);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glPushMatrix();
    glScalef(1, -1, 1);
    light(2, 3, 1, 1);
    glClipPlane(GL_CLIP_PLANE0, above);
    glEnable(GL_CLIP_PLANE0);
    glFrontFace(GL_CW);
    scene();
    glFrontFace(GL_CCW);
    glDisable(GL_CLIP_PLANE0);
    glPopMatrix();
    glDisable(GL_STENCIL_TEST);
    light(2, 3, 1, 1);
    glDisable(GL_LIGHTING);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glColor4f(0.6f, 0.7f, 0.6f, 0.45f);
    floor_quad(1.4f, 0, 1);
    glDisable(GL_BLEND);
    glEnable(GL_LIGHTING);
    scene();
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glutMainLoop();
}
