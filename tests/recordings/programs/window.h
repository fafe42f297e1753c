/* What the programs share: a GLUT window that ends after some frames, a camera, shapes and textures. */
#define GL_GLEXT_PROTOTYPES
#include <GL/freeglut.h>
#include <GL/glext.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int frame, last_frame = 1;
static void draw(void);

static void display(void)
{
    draw();
    glutSwapBuffers();
    if (frame++ == last_frame)
        exit(0);
    glutPostRedisplay();
}

static void open_window(int *argc, char **argv, int width, int height)
{
    glutInit(argc, argv);
    glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGBA | GLUT_ALPHA | GLUT_DEPTH | GLUT_STENCIL | GLUT_ACCUM);
    glutInitWindowSize(width, height);
    glutCreateWindow(argv[0]);
    glutDisplayFunc(display);
}

static inline void camera(double ex, double ey, double ez)
{
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    gluPerspective(45, 64.0 / 48, 1, 20);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    gluLookAt(ex, ey, ez, 0, 0, 0, 0, 1, 0);
}

static inline void clear(float r, float g, float b)
{
    glClearColor(r, g, b, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

static inline void light(float x, float y, float z, float w)
{
    float position[] = {x, y, z, w};
    glLightfv(GL_LIGHT0, GL_POSITION, position);
    glEnable(GL_LIGHT0);
    glEnable(GL_LIGHTING);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_NORMALIZE);
}

static inline void floor_quad(float size, float y, float repeat)
{
    glBegin(GL_QUADS);
    glNormal3f(0, 1, 0);
    glTexCoord2f(0, 0), glVertex3f(-size, y, size);
    glTexCoord2f(repeat, 0), glVertex3f(size, y, size);
    glTexCoord2f(repeat, repeat), glVertex3f(size, y, -size);
    glTexCoord2f(0, repeat), glVertex3f(-size, y, -size);
    glEnd();
}

static inline void box(float s)
{
    static const float normals[6][3] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    glBegin(GL_QUADS);
    for (int side = 0; side < 6; side++) {
        const float *n = normals[side];
        float u[3] = {n[1], n[2], n[0]}, v[3];
        v[0] = n[1] * u[2] - n[2] * u[1], v[1] = n[2] * u[0] - n[0] * u[2], v[2] = n[0] * u[1] - n[1] * u[0];
        glNormal3fv(n);
        for (int corner = 0; corner < 4; corner++) {
            float a = corner == 1 || corner == 2 ? 1 : -1, b = corner > 1 ? 1 : -1;
            glTexCoord2f((a + 1) / 2, (b + 1) / 2);
            glVertex3f(s * (n[0] + a * u[0] + b * v[0]), s * (n[1] + a * u[1] + b * v[1]),
                       s * (n[2] + a * u[2] + b * v[2]));
        }
    }
    glEnd();
}

static inline void torus(float inner, float outer, int sides, int rings)
{
    for (int i = 0; i < rings; i++) {
        glBegin(GL_QUAD_STRIP);
        for (int j = 0; j <= sides; j++)
            for (int k = 0; k < 2; k++) {
                float a = 6.2831853f * (i + k) / rings, b = 6.2831853f * j / sides;
                glNormal3f(cosf(a) * cosf(b), sinf(a) * cosf(b), sinf(b));
                glTexCoord2f((float)(i + k) / rings, (float)j / sides);
                glVertex3f((outer + inner * cosf(b)) * cosf(a), (outer + inner * cosf(b)) * sinf(a), inner * sinf(b));
            }
        glEnd();
    }
}

static inline GLuint checkerboard(int size, int cell)
{
    static unsigned char texels[64 * 64 * 3];
    GLuint name;
    for (int i = 0; i < size * size; i++) {
        int on = (i % size / cell + i / size / cell) & 1;
        texels[3 * i] = on ? 230 : 40, texels[3 * i + 1] = on ? 200 : 90, texels[3 * i + 2] = on ? 60 : 150;
    }
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, size, size, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
    return name;
}
