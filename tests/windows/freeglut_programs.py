"""Programs that run unchanged on freeglut and here; they store what they see in the file of their first argument."""

SIZE = 260, 240

# what the programs below share: their window, and `keep`, which stores the pixels drawn so far
HEAD = """
import ctypes
import sys
import numpy as np
from OpenGL.GL import *
from OpenGL.GLUT import *
try:
    from OpenGL.GLUT import glutSolidTeacup, glutStrokeWidthf
except ImportError:  # PyOpenGL does not name them
    from OpenGL.platform import PLATFORM
    glutStrokeWidthf, glutStrokeLengthf = PLATFORM.GLUT.glutStrokeWidthf, PLATFORM.GLUT.glutStrokeLengthf
    glutStrokeWidthf.restype = glutStrokeLengthf.restype = ctypes.c_float
    glutStrokeWidthf.argtypes = [ctypes.c_void_p, ctypes.c_int]
    glutStrokeLengthf.argtypes = [ctypes.c_void_p, ctypes.c_char_p]
    for name in ("Teacup", "Teaspoon"):
        for kind in ("Solid", "Wire"):
            function = getattr(PLATFORM.GLUT, f"glut{kind}{name}")
            function.argtypes, function.restype = [ctypes.c_double], None
            globals()[f"glut{kind}{name}"] = function
WIDTH, HEIGHT = SIZE
BITMAP_FONTS = [
    GLUT_BITMAP_9_BY_15, GLUT_BITMAP_8_BY_13, GLUT_BITMAP_TIMES_ROMAN_10, GLUT_BITMAP_TIMES_ROMAN_24,
    GLUT_BITMAP_HELVETICA_10, GLUT_BITMAP_HELVETICA_12, GLUT_BITMAP_HELVETICA_18,
]
STROKE_FONTS = [GLUT_STROKE_ROMAN, GLUT_STROKE_MONO_ROMAN]
TEXT = b"Hello, World!\\n(second) {line}\\n\\n\\xe4\\xf6 \\x7f fourth\\n"
seen = {}

def start():
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    for mode in (GL_PROJECTION, GL_MODELVIEW):
        glMatrixMode(mode)
        glLoadIdentity()

def keep(name):
    colors = glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE)
    depths = glReadPixels(0, 0, WIDTH, HEIGHT, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT)
    seen[name + " color"] = np.frombuffer(bytes(colors), np.uint8)
    seen[name + " depth"] = np.frombuffer(bytes(depths), np.uint32)

def show(draw):
    def display():
        draw()
        seen["version"] = np.array(glutGet(508))  # GLUT_VERSION, which PyOpenGL does not name
        np.savez(sys.argv[1], **seen)
        glutSwapBuffers()
        glutLeaveMainLoop()
    glutInit(["program"])
    glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH | GLUT_STENCIL)
    glutInitWindowSize(WIDTH, HEIGHT)
    glutCreateWindow(b"freeglut")
    glutDisplayFunc(display)
    glutMainLoop()
""".replace("SIZE", str(SIZE))

FONTS = (
    HEAD
    + """
def fonts():
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4)
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 7)
    for number, font in enumerate(BITMAP_FONTS):
        start()
        glOrtho(0, WIDTH, 0, HEIGHT, -1, 1)
        glColor3f(1, 0.5, 0.25)
        glRasterPos2f(1, HEIGHT - 20)
        for code in range(1, 256):
            glutBitmapCharacter(font, code)
            if code % 24 == 0:
                glBitmap(0, 0, 0, 0, 1 - int(glGetFloatv(GL_CURRENT_RASTER_POSITION)[0]), -17, None)
        keep(f"characters {number}")
        start()
        glOrtho(0, WIDTH, 0, HEIGHT, -1, 1)
        glRasterPos2f(3, HEIGHT - 30)
        glutBitmapString(font, TEXT)
        seen[f"place {number}"] = np.array(glGetFloatv(GL_CURRENT_RASTER_POSITION))
        keep(f"text {number}")
        seen[f"widths {number}"] = np.array([glutBitmapWidth(font, code) for code in range(-2, 260)])
        codes = (ctypes.c_ubyte * (len(TEXT) + 1))(*TEXT, 0)
        seen[f"sizes {number}"] = np.array([glutBitmapLength(font, codes), glutBitmapHeight(font)])
    store = (GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH)
    seen["store"] = np.array([int(glGetIntegerv(each)) for each in store])
    for number, font in enumerate(STROKE_FONTS):
        start()
        glOrtho(0, 1500, -1600, 130, -1, 1)
        glColor3f(0.3, 0.7, 1)
        for code in range(128):
            glutStrokeCharacter(font, code)
            if code % 14 == 13:
                glTranslatef(-glGetFloatv(GL_MODELVIEW_MATRIX)[3][0], -160, 0)
        seen[f"matrix {number}"] = np.array(glGetFloatv(GL_MODELVIEW_MATRIX))
        keep(f"stroke characters {number}")
        start()
        glOrtho(0, 1500, -1600, 130, -1, 1)
        glutStrokeString(font, TEXT)
        seen[f"matrix of text {number}"] = np.array(glGetFloatv(GL_MODELVIEW_MATRIX))
        keep(f"stroke text {number}")
        seen[f"stroke widths {number}"] = np.array([glutStrokeWidth(font, code) for code in range(-2, 260)])
        seen[f"exact widths {number}"] = np.array([glutStrokeWidthf(font, code) for code in range(-2, 260)])
        codes = (ctypes.c_ubyte * (len(TEXT) + 1))(*TEXT, 0)
        lengths = [glutStrokeLength(font, codes), glutStrokeLengthf(font, TEXT), glutStrokeHeight(font)]
        seen[f"stroke sizes {number}"] = np.array(lengths)
show(fonts)
"""
)

SHAPES = (
    HEAD
    + """
ARGUMENTS = {
    "Sphere": [(1, 12, 7), (0.7, 3, 2), (1.2, 17, 16), (1, 5, 1)], "Cube": [(1,), (1.37,)],
    "Cone": [(0.7, 1.3, 9, 4), (1, 1, 5, 1), (0, 1, 5, 3), (0, 0, 3, 1)],
    "Cylinder": [(0.6, 1.2, 9, 4), (0.8, 0.7, 5, 1)], "Torus": [(0.3, 0.8, 7, 11), (0.2, 0.7, 2, 3), (1, 2, 1, 5)],
    "Teapot": [(0.8,), (1.1,)], "Teacup": [(1.3,), (0.9,)], "Teaspoon": [(1.5,)], "Dodecahedron": [()],
    "Icosahedron": [()], "Octahedron": [()], "Tetrahedron": [()], "RhombicDodecahedron": [()],
    "SierpinskiSponge": [(0, (0, 0, 0), 1), (2, (0.1, -0.2, 0.05), 1.3), (-1, (0, 0, 0), 1)],
}

def shapes():
    for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_TEXTURE_2D):
        glEnable(capability)
    texels = np.random.default_rng(1).integers(0, 256, (8, 8, 3), np.uint8)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST)
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 8, 8, 0, GL_RGB, GL_UNSIGNED_BYTE, texels.tobytes())
    for name, sizes in ARGUMENTS.items():
        for kind in ("Solid", "Wire"):
            for number, arguments in enumerate(sizes):
                start()
                glFrustum(-0.7, 0.7, -0.7, 0.7, 1, 10)
                glTranslatef(0, 0, -3)
                glRotatef(30, 1, 0.3, 0.1)
                globals()[f"glut{kind}{name}"](*arguments)
                keep(f"{kind}{name} {number}")
show(shapes)
"""
)

# calls only: nothing is read
CALLS = (
    HEAD
    + """
def calls():
    for font in BITMAP_FONTS:
        for code in range(256):
            glutBitmapCharacter(font, code)
        glutBitmapString(font, TEXT)
        glutBitmapString(font, b"")
    for font in STROKE_FONTS:
        for code in range(256):
            glutStrokeCharacter(font, code)
        glutStrokeString(font, TEXT)
    for kind in ("Solid", "Wire"):
        for name in ("Cube", "Teapot", "Teacup", "Teaspoon"):
            globals()[f"glut{kind}{name}"](1.3)
        for name in ("Dodecahedron", "Icosahedron", "Octahedron", "Tetrahedron", "RhombicDodecahedron"):
            globals()[f"glut{kind}{name}"]()
        for name in ("Sphere", "Cone", "Cylinder", "Torus"):
            sizes = (0.7,) if name == "Sphere" else (0.4, 1.1)
            for counts in ((3, 2), (7, 5), (12, 16)):
                globals()[f"glut{kind}{name}"](*sizes, *counts)
        globals()[f"glut{kind}SierpinskiSponge"](2, (0.1, 0.2, 0.3), 1.1)
show(calls)
"""
)

# writes every callback to a file; on freeglut, it makes the events itself by the X server's extension XTEST
CALLBACKS = """
import ctypes
import sys
from OpenGL.GL import *
from OpenGL.GLUT import *

path, events, last = sys.argv[1], eval(sys.argv[2]), int(sys.argv[3])
frame = 0
if events:
    x11, xtst = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXtst.so.6")
    x11.XOpenDisplay.restype, x11.XStringToKeysym.restype = ctypes.c_void_p, ctypes.c_ulong
    server = ctypes.c_void_p(x11.XOpenDisplay(None))

def write(*words):
    with open(path, "a") as log:
        print(*words, file=log)

def key(name, is_down):
    symbol = ctypes.c_ulong(x11.XStringToKeysym(name.encode()))
    xtst.XTestFakeKeyEvent(server, x11.XKeysymToKeycode(server, symbol), is_down, ctypes.c_ulong(0))

def button(number, is_down):
    xtst.XTestFakeButtonEvent(server, number, is_down, ctypes.c_ulong(0))

def move(x, y):
    left, top = glutGet(GLUT_WINDOW_X), glutGet(GLUT_WINDOW_Y)
    xtst.XTestFakeMotionEvent(server, -1, left + x, top + y, ctypes.c_ulong(0))

def act(kind, *what):
    if kind == "keys":
        for name in what:
            key(name, 1)
        for name in reversed(what):
            key(name, 0)
    if kind in ("move", "click", "drag"):
        move(*what[:2])
    if kind in ("click", "wheel", "drag"):
        button(what[-1], 1)
        if kind == "drag":
            move(*what[2:4])
        button(what[-1], 0)
    x11.XSync(server, 0)

def display():
    global frame
    frame += 1
    write("display", frame)
    glutSwapBuffers()
    if frame >= last:
        glutLeaveMainLoop()
    elif events:
        act(*events.pop(0))

def input_callback(name):
    def call(*arguments):
        write(name, *arguments, "modifiers", glutGetModifiers())
        glutPostRedisplay()
    return call

def callback(name):
    return lambda *arguments: write(name, *arguments)

glutInit(["program"])
glutInitDisplayMode(GLUT_DOUBLE | GLUT_DEPTH)
glutInitWindowPosition(20, 30)
glutInitWindowSize(100, 80)
glutCreateWindow(b"callbacks")
glutDisplayFunc(display)
for name in ("Keyboard", "KeyboardUp", "Special", "SpecialUp", "Mouse", "Motion", "PassiveMotion", "MouseWheel"):
    if name != "MouseWheel" or last > 5:
        globals()[f"glut{name}Func"](input_callback(name))
for name in ("Entry", "Visibility", "Reshape"):
    globals()[f"glut{name}Func"](callback(name))
glutTimerFunc(0, callback("Timer"), 7)
glutMainLoop()
"""
