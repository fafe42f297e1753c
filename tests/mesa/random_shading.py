"""Random programs with lighting and fog."""

from mesa.random_writer import FACES, Writer

MATERIALS = ["GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR", "GL_EMISSION", "GL_AMBIENT_AND_DIFFUSE"]


def lights(writer: Writer) -> None:
    """Place one to three lights: points, directions and spots."""
    writer.normals = True
    writer.call("glEnable", "GL_LIGHTING")
    for number in range(writer.integer(1, 3)):
        light = f"GL_LIGHT{number}"
        writer.call("glEnable", light)
        place = [writer.number(-4, 4) for _ in range(3)]
        writer.call("glLightfv", light, "GL_POSITION", [*place, writer.pick([0.0, 1.0, 1.0, 0.5])])
        for parameter in ("GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR"):
            if writer.chance(0.7):
                writer.call("glLightfv", light, parameter, list(writer.color()))
        if writer.chance(0.4):
            writer.call("glLightf", light, "GL_LINEAR_ATTENUATION", writer.number(0, 1))
            writer.call("glLightf", light, "GL_QUADRATIC_ATTENUATION", writer.pick([0.0, writer.number(0, 0.5)]))
        if writer.chance(0.3):
            writer.call("glLightfv", light, "GL_SPOT_DIRECTION", [-a for a in place])
            writer.call("glLightf", light, "GL_SPOT_CUTOFF", writer.number(5, 90))
            writer.call("glLightf", light, "GL_SPOT_EXPONENT", writer.pick([0.0, 1.0, writer.number(0, 128)]))


def lit(writer: Writer) -> None:
    writer.matrices(rotations=writer.chance(0.5))
    writer.call("glShadeModel", writer.pick(["GL_SMOOTH", "GL_SMOOTH", "GL_FLAT"]))
    writer.call("glFrontFace", writer.pick(["GL_CCW", "GL_CW"]))
    writer.depth_state()
    if writer.chance(0.3):
        writer.fragment_state()
    writer.switch("GL_NORMALIZE", 0.5)
    writer.switch("GL_RESCALE_NORMAL", 0.2)
    writer.call("glLightModeli", "GL_LIGHT_MODEL_TWO_SIDE", writer.pick([0, 1]))
    writer.call("glLightModeli", "GL_LIGHT_MODEL_LOCAL_VIEWER", writer.pick([0, 1]))
    color_control = writer.pick(["GL_SINGLE_COLOR", "GL_SEPARATE_SPECULAR_COLOR"])
    writer.call("glLightModeli", "GL_LIGHT_MODEL_COLOR_CONTROL", color_control)
    writer.call("glLightModelfv", "GL_LIGHT_MODEL_AMBIENT", list(writer.color()))
    if writer.switch("GL_COLOR_MATERIAL", 0.4):
        writer.call("glColorMaterial", writer.pick(FACES), writer.pick(MATERIALS))
    for _ in range(writer.integer(0, 4)):
        writer.call("glMaterialfv", writer.pick(FACES), writer.pick(MATERIALS), list(writer.color()))
    writer.call("glMaterialf", writer.pick(FACES), "GL_SHININESS", writer.pick([0.0, 1.0, 16.0, writer.number(0, 128)]))


def fogged(writer: Writer) -> None:
    writer.matrices(rotations=writer.chance(0.5))
    writer.geometry_state()
    if writer.chance(0.3):
        writer.fragment_state()
    writer.switch("GL_FOG", 0.9)
    writer.call("glFogi", "GL_FOG_MODE", writer.pick(["GL_LINEAR", "GL_EXP", "GL_EXP2"]))
    writer.call("glFogf", "GL_FOG_DENSITY", writer.pick([0.1, 1.0, writer.number(0, 2)]))
    writer.call("glFogf", "GL_FOG_START", writer.number(-1, 5))
    writer.call("glFogf", "GL_FOG_END", writer.number(1, 12))
    writer.call("glFogfv", "GL_FOG_COLOR", list(writer.color()))


# -- the whole of lighting ---------------------------------------------------------------------------------------------
def many_lights(writer: Writer) -> None:
    """Up to eight lights, placed under modelview matrices of their own, with every parameter."""
    writer.normals = True
    writer.call("glEnable", "GL_LIGHTING")
    for number in range(writer.integer(3, 8)):
        light = f"GL_LIGHT{number}"
        writer.switch(light, 0.8)
        writer.call("glPushMatrix")
        writer.call("glRotatef", writer.number(-180, 180), *writer.pick([(0.0, 1.0, 0.0), (0.3, -0.5, 0.8)]))
        writer.call("glTranslatef", *(writer.number(-2, 2) for _ in range(3)))
        place = [writer.number(-3, 3) for _ in range(3)]
        writer.call("glLightfv", light, "GL_POSITION", [*place, writer.pick([0.0, 1.0, 2.0])])
        for parameter in ("GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR"):
            writer.call("glLightfv", light, parameter, [writer.number(-0.2, 0.8) for _ in range(4)])
        writer.call("glLightf", light, "GL_CONSTANT_ATTENUATION", writer.number(0.2, 2))
        writer.call("glLightf", light, "GL_LINEAR_ATTENUATION", writer.pick([0.0, writer.number(0, 1)]))
        writer.call("glLightf", light, "GL_QUADRATIC_ATTENUATION", writer.pick([0.0, writer.number(0, 0.5)]))
        if writer.chance(0.4):
            direction = [-a + writer.number(-0.5, 0.5) for a in place]
            writer.call("glLightfv", light, "GL_SPOT_DIRECTION", direction)
            writer.call("glLightf", light, "GL_SPOT_CUTOFF", writer.pick([0.0, 90.0, 180.0, writer.number(5, 90)]))
            writer.call("glLightf", light, "GL_SPOT_EXPONENT", writer.pick([0.0, 1.0, 2.5, writer.number(0, 128)]))
        writer.call("glPopMatrix")


def with_materials(writer: Writer, wild: bool) -> None:
    """Vertices between which normals and colours change, and on one-sided surfaces materials."""
    changing = writer.chance(0.5)
    if changing:
        writer.call("glLightModeli", "GL_LIGHT_MODEL_TWO_SIDE", 0)
    mode = writer.pick(writer.primitives)
    writer.call("glBegin", mode)
    for vertex in writer.vertices(12, wild):
        if changing and writer.chance(0.4):
            writer.call("glMaterialfv", "GL_FRONT_AND_BACK", writer.pick(MATERIALS), list(writer.color()))
        if changing and writer.chance(0.2):
            writer.call("glMaterialf", "GL_FRONT_AND_BACK", "GL_SHININESS", writer.number(0, 128))
        if writer.chance(0.5):
            writer.call("glNormal3f", *(writer.number(-1, 1) for _ in range(3)))
        if writer.chance(0.5):
            writer.call("glColor4f", *writer.color())
        writer.call("glVertex4f", *vertex)
    writer.call("glEnd")
