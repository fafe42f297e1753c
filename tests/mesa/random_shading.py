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
