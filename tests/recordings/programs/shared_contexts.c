/* EGL: a loader's context makes a texture and a display list; the window's context, which shares them, draws both. */
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <GL/gl.h>
#include <stddef.h>

int main(void)
{
    static const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8,
                                    EGL_DEPTH_SIZE, 24, EGL_STENCIL_SIZE, 8, EGL_NONE};
    static const EGLint size[] = {EGL_WIDTH, 64, EGL_HEIGHT, 48, EGL_NONE};
    static const unsigned char texels[] = "\377\0\0\377\0\377\0\377\0\0\377\377\377\377\0\200";
    EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    EGLConfig config;
    EGLSurface window, other;
    EGLContext drawing, loading;
    GLuint texture;
    EGLint n;
    eglInitialize(display, NULL, NULL);
    eglBindAPI(EGL_OPENGL_API);
    eglChooseConfig(display, wanted, &config, 1, &n);
    window = eglCreatePbufferSurface(display, config, size);
    other = eglCreatePbufferSurface(display, config, size);
    drawing = eglCreateContext(display, config, EGL_NO_CONTEXT, NULL);
    loading = eglCreateContext(display, config, drawing, NULL);
    for (int frame = 0; frame < 3; frame++) {
        eglMakeCurrent(display, other, other, loading);
        if (frame == 0) {
            glGenTextures(1, &texture);
            glBindTexture(GL_TEXTURE_2D, texture);
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
            glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
        } else
            glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, texels + 4 * frame);
        glNewList(7, GL_COMPILE);
        glBegin(GL_TRIANGLES);
        glTexCoord2f(0, 0), glVertex2f(-0.8f, -0.8f);
        glTexCoord2f(3, 0), glVertex2f(0.8f, -0.6f);
        glTexCoord2f(0, 3), glVertex2f(-0.2f + 0.3f * frame, 0.9f);
        glEnd();
        glEndList();
        glFinish();
        eglMakeCurrent(display, window, window, drawing);
        glClearColor(0.2f, 0.2f * frame, 0.3f, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        glEnable(GL_TEXTURE_2D);
        glBindTexture(GL_TEXTURE_2D, texture);
        glCallList(7);
        eglSwapBuffers(display, window);
    }
    eglTerminate(display);
}
