/* Draws what a recording has to carry: client arrays, buffer objects, a mapped buffer, textures, lists, a resize.
 *
 *     gcc -DGL_GLEXT_PROTOTYPES -o arrays_and_lists arrays_and_lists.c -lglut -lGL
 *     apitrace trace ./arrays_and_lists && apitrace repack --brotli arrays_and_lists.trace small.trace
 */
#include <GL/glut.h>
#include <stdlib.h>
#include <string.h>
#include <GL/glext.h>
static int frame = 0;
static GLuint buffer, indices, texture, list;
static const GLfloat positions[] = {-1, -1, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0};
static const GLubyte colors[] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0, 255};
static const GLushort quad[] = {0, 1, 2, 0, 2, 3};
static void init(void) {
    GLubyte image[5 * 3 * 3];
    int i;
    for (i = 0; i < (int)sizeof image; i++) image[i] = (GLubyte)(i * 37);
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 5, 3, 0, GL_RGB, GL_UNSIGNED_BYTE, image);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, sizeof positions, NULL, GL_STATIC_DRAW);
    memcpy(glMapBuffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY), positions, sizeof positions);
    glUnmapBuffer(GL_ARRAY_BUFFER);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glGenBuffers(1, &indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof quad, quad, GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    list = glGenLists(1);
    glNewList(list, GL_COMPILE);
    glBegin(GL_TRIANGLES);
    glColor3f(1, 0, 1); glVertex3f(0, 0, .5f);
    glColor3f(0, 1, 1); glVertex3f(1, 0, .5f);
    glColor3f(1, 1, 0); glVertex3f(1, 1, .5f);
    glEnd();
    glEndList();
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 1, 255);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
}
static void reshape(int w, int h) { glViewport(0, 0, w, h); }
static void display(void) {
    glClearColor(.2f, .2f, .1f * frame, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glRotatef(5.f * frame, 0, 0, 1);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glVertexPointer(3, GL_FLOAT, 0, positions);
    glColorPointer(4, GL_UNSIGNED_BYTE, 0, colors);
    glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, quad);
    glTranslatef(0, 1, -.1f);
    glDisableClientState(GL_COLOR_ARRAY);
    glColor3f(.5f, .5f, .5f);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glVertexPointer(3, GL_FLOAT, 12, (void *)0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, (void *)0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glDisableClientState(GL_VERTEX_ARRAY);
    glLoadIdentity();
    glCallList(list);
    glEnable(GL_TEXTURE_2D);
    glBegin(GL_QUADS);
    glColor3f(1, 1, 1);
    glTexCoord2f(0, 0); glVertex3f(0, -1, 0);
    glTexCoord2f(1, 0); glVertex3f(1, -1, 0);
    glTexCoord2f(1, 1); glVertex3f(1, 0, 0);
    glTexCoord2f(0, 1); glVertex3f(0, 0, 0);
    glEnd();
    glDisable(GL_TEXTURE_2D);
    glutSwapBuffers();
    if (++frame == 2) glutReshapeWindow(80, 64);
    if (frame == 4) exit(0);
}
static void idle(void) { glutPostRedisplay(); }
int main(int argc, char **argv) {
    glutInit(&argc, argv);
    glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH | GLUT_STENCIL);
    glutInitWindowSize(64, 48);
    glutCreateWindow("arrays and lists");
    init();
    glutDisplayFunc(display);
    glutReshapeFunc(reshape);
    glutIdleFunc(idle);
    glutMainLoop();
    return 0;
}
