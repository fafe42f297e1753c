/* A shadow map of the fixed function: the depth seen from the light, copied, projected and compared. */
#include "window.h"

static float to_light[16];

static void scene(void)
{
    glColor3f(0.8f, 0.8f, 0.6f);
    floor_quad(2, -0.6f, 1);
    glColor3f(0.8f, 0.2f, 0.2f);
    glPushMatrix();
    glRotatef(30, 0, 1, 0);
    box(0.4f);
    glPopMatrix();
}

static void draw(void)
{
    static const GLenum names[] = {GL_S, GL_T, GL_R, GL_Q}, switches[] = {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T,
                                                                          GL_TEXTURE_GEN_R, GL_TEXTURE_GEN_Q};
    glViewport(0, 0, 48, 48);
    clear(0, 0, 0);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_TEXTURE_2D);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    gluPerspective(60, 1, 1, 10);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    gluLookAt(1.5 + frame, 3, 1, 0, 0, 0, 0, 1, 0);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(2, 4);
    scene();
    glDisable(GL_POLYGON_OFFSET_FILL);
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, 48, 48);
    glMatrixMode(GL_TEXTURE);
    glLoadIdentity();
    glTranslatef(0.5f, 0.5f, 0.5f);
    glScalef(0.5f, 0.5f, 0.5f);
    gluPerspective(60, 1, 1, 10);
    gluLookAt(1.5 + frame, 3, 1, 0, 0, 0, 0, 1, 0);
    glGetFloatv(GL_TEXTURE_MATRIX, to_light);
    glLoadIdentity();
    glViewport(0, 0, 64, 48);
    clear(0.3f, 0.4f, 0.6f);
    camera(-1, 2, 4);
    for (int i = 0; i < 4; i++) {
        float row[4] = {to_light[i], to_light[4 + i], to_light[8 + i], to_light[12 + i]};
        glTexGeni(names[i], GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR);
        glTexGenfv(names[i], GL_EYE_PLANE, row);
        glEnable(switches[i]);
    }
    glEnable(GL_TEXTURE_2D);
    scene();
}

int main(int argc, char **argv)
{
    open_window(&argc, argv, 64, 48);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, 48, 48, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glutMainLoop();
}
