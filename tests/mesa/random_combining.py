"""Random programs with GL_COMBINE on two texture units."""

from mesa.random_images import WRAPS
from mesa.random_texturing import texture_matrix
from mesa.random_writer import Writer

FUNCTIONS = ["GL_REPLACE", "GL_MODULATE", "GL_ADD", "GL_ADD_SIGNED", "GL_INTERPOLATE", "GL_SUBTRACT"]
DOT_PRODUCTS = ["GL_DOT3_RGB", "GL_DOT3_RGBA"]
SOURCES = ["GL_TEXTURE", "GL_TEXTURE", "GL_CONSTANT", "GL_PRIMARY_COLOR", "GL_PREVIOUS", "GL_TEXTURE0", "GL_TEXTURE1"]
OPERANDS_ALPHA = ["GL_SRC_ALPHA", "GL_ONE_MINUS_SRC_ALPHA"]
OPERANDS_RGB = ["GL_SRC_COLOR", "GL_ONE_MINUS_SRC_COLOR", *OPERANDS_ALPHA]


def two_images(writer: Writer) -> None:
    """Bind a texture of colours to each of two units; both are drawn with."""
    for unit in range(2):
        writer.call("glActiveTexture", f"GL_TEXTURE{unit}")
        writer.color_texture(f"texture {unit}")
        writer.sampler(WRAPS)
        writer.call("glTexParameterfv", "GL_TEXTURE_2D", "GL_TEXTURE_BORDER_COLOR", list(writer.color()))
        writer.call("glEnable", "GL_TEXTURE_2D")


def combined(writer: Writer) -> None:
    if writer.chance(0.3):
        writer.matrices(rotations=False)
    if writer.chance(0.3):
        writer.fragment_state()
    for unit in range(2):
        writer.call("glActiveTexture", f"GL_TEXTURE{unit}")
        _environment(writer)
        if writer.chance(0.3):
            texture_matrix(writer)
    writer.texture_coordinates = writer.pick([2, 3, 4])
    writer.second_coordinates = 2


def _environment(writer: Writer) -> None:
    def choose(parameter: str, values: list[str]) -> None:
        writer.call("glTexEnvi", "GL_TEXTURE_ENV", parameter, writer.pick(values))

    choose("GL_TEXTURE_ENV_MODE", ["GL_COMBINE", "GL_COMBINE", "GL_COMBINE", "GL_MODULATE", "GL_REPLACE"])
    choose("GL_COMBINE_RGB", FUNCTIONS + DOT_PRODUCTS)
    choose("GL_COMBINE_ALPHA", FUNCTIONS)
    for argument in range(3):
        choose(f"GL_SOURCE{argument}_RGB", SOURCES)
        choose(f"GL_SOURCE{argument}_ALPHA", SOURCES)
        choose(f"GL_OPERAND{argument}_RGB", OPERANDS_RGB)
        choose(f"GL_OPERAND{argument}_ALPHA", OPERANDS_ALPHA)
    for scale in ("GL_RGB_SCALE", "GL_ALPHA_SCALE"):
        writer.call("glTexEnvf", "GL_TEXTURE_ENV", scale, writer.pick([1.0, 1.0, 2.0, 4.0]))
    writer.call("glTexEnvfv", "GL_TEXTURE_ENV", "GL_TEXTURE_ENV_COLOR", list(writer.color()))
