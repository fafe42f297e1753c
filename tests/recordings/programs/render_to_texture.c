/* A turning box, drawn into a texture by a framebuffer object with a depth buffer, on the sides of a larger one. */
#include "window.h"

static GLuint target, texture;

static void draw(void)
{
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, target);
    glViewport(0, 0, 32, 32);
    clear(0.8f, 0.8f, 0.3f);
    camera(1, 1.5, 3);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_TEXTURE_2D);
    light(1, 2, 3, 0);
    glRotatef(30.0f + 20 * frame, 0, 1, 0);
    box(0.6f);
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, 0);
    glViewport(0, 0, 64, 48);
    glDisable(GL_LIGHTING);
    glEnable(GL_TEXTURE_2D);
    clear(0.2f, 0.3f, 0.4f);
    camera(1.5, 1, 2.5);
    glRotatef(-20.0f * frame, 0, 1, 0);
    box(0.7f);
}

int main(int argc, char **argv)
{
    GLuint depth;
    open_window(&argc, argv, 64, 48);
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 32, 32, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glGenRenderbuffersEXT(1, &depth);
    glBindRenderbufferEXT(GL_RENDERBUFFER_EXT, depth);
    glRenderbufferStorageEXT(GL_RENDERBUFFER_EXT, GL_DEPTH_COMPONENT24, 32, 32);
    glGenFramebuffersEXT(1, &target);
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, target);
    glFramebufferTexture2DEXT(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_TEXTURE_2D, texture, 0);
    glFramebufferRenderbufferEXT(GL_FRAMEBUFFER_EXT, GL_DEPTH_ATTACHMENT_EXT, GL_RENDERBUFFER_EXT, depth);
    if (glCheckFramebufferStatusEXT(GL_FRAMEBUFFER_EXT) != GL_FRAMEBUFFER_COMPLETE_EXT)
        return 1;
    glutMainLoop();
}
