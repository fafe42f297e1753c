/* EGL: a frame whose parts are named by debug groups, some of them nested, with a message in between. */
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <GL/gl.h>
#include <stddef.h>
#include <GL/glext.h>

static void begin(const char *name)
{
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 1, -1, name);
}

int main(void)
{
    static const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8,
                                    EGL_DEPTH_SIZE, 24, EGL_STENCIL_SIZE, 8, EGL_NONE};
    static const EGLint size[] = {EGL_WIDTH, 64, EGL_HEIGHT, 48, EGL_NONE};
    EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    EGLConfig config;
    EGLSurface window;
    EGLint n;
    eglInitialize(display, NULL, NULL);
    eglBindAPI(EGL_OPENGL_API);
    eglChooseConfig(display, wanted, &config, 1, &n);
    window = eglCreatePbufferSurface(display, config, size);
    eglMakeCurrent(display, window, window, eglCreateContext(display, config, EGL_NO_CONTEXT, NULL));
    for (int frame = 0; frame < 2; frame++) {
        begin("sky");
        glClearColor(0.4f, 0.6f, 1, 1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glPopDebugGroup();
        begin("house");
        glColor3f(0.8f, 0.8f, 0.7f);
        glRectf(-0.5f, -0.8f, 0.5f, 0.1f);
        begin("roof");
        glColor3f(0.7f, 0.2f, 0.1f);
        glBegin(GL_TRIANGLES);
        glVertex2f(-0.6f, 0.1f), glVertex2f(0.6f, 0.1f), glVertex2f(0, 0.6f + 0.1f * frame);
        glEnd();
        glPopDebugGroup();
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_MARKER, 3, GL_DEBUG_SEVERITY_NOTIFICATION, -1,
                             "the door is next");
        glColor3f(0.3f, 0.2f, 0.1f);
        glRectf(-0.1f, -0.8f, 0.1f, -0.3f);
        glPopDebugGroup();
        eglSwapBuffers(display, window);
    }
    eglTerminate(display);
}
