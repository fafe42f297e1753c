"""Random programs with textures: environments, generated coordinates, texture matrices, two units, shadow compare."""

import numpy as np

from mesa.random_writer import Writer

COORDINATES = ["S", "T", "R", "Q"]
MODES = ["GL_MODULATE", "GL_REPLACE", "GL_DECAL", "GL_BLEND", "GL_ADD"]


def texture(writer: Writer) -> None:
    """Bind a texture of colours, or one of depths that are compared."""
    writer.color_texture("texture 0") if writer.chance(0.6) else writer.depth_texture("texture 0")


def textured(writer: Writer) -> None:
    if writer.chance(0.2):
        writer.matrices(rotations=False)
    if writer.chance(0.3):
        writer.fragment_state()
    replaced_or_modulated(writer)


def shadowed(writer: Writer) -> None:
    writer.matrices(rotations=False)
    writer.fragment_state()
    replaced_or_modulated(writer)


def replaced_or_modulated(writer: Writer) -> None:
    writer.switch("GL_TEXTURE_2D", 0.9)
    writer.call("glTexEnvi", "GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", writer.pick(["GL_REPLACE", "GL_MODULATE"]))
    writer.texture_coordinates = writer.pick([2, 3, 4])


def copied(writer: Writer) -> None:
    if writer.chance(0.5):
        writer.copy_texture("texture 1")


# -- coordinates -------------------------------------------------------------------------------------------------------
def projected(writer: Writer) -> None:
    """Coordinates from planes in object and eye space, through a texture matrix, divided by q."""
    writer.matrices(rotations=writer.chance(0.5))
    if writer.chance(0.4):
        writer.fragment_state()
    replaced_or_modulated(writer)
    generated_coordinates(writer)
    texture_matrix(writer)


def generated_coordinates(writer: Writer) -> None:
    for name in COORDINATES:
        if not writer.switch(f"GL_TEXTURE_GEN_{name}", 0.6):
            continue
        mode = writer.pick(["GL_OBJECT_LINEAR", "GL_EYE_LINEAR"])
        writer.call("glTexGeni", f"GL_{name}", "GL_TEXTURE_GEN_MODE", mode)
        plane = [writer.number(-1, 1) for _ in range(4)]
        if name == "Q" and writer.chance(0.5):  # no pole of the division in sight
            plane = [0.1 * a for a in plane[:3]] + [2.0]
        writer.call("glTexGenfv", f"GL_{name}", mode.replace("LINEAR", "PLANE"), plane)


def texture_matrix(writer: Writer) -> None:
    writer.call("glMatrixMode", "GL_TEXTURE")
    writer.call("glLoadIdentity")
    if writer.chance(0.5):
        writer.call("glTranslatef", 0.5, 0.5, 0.5)
        writer.call("glScalef", 0.5, writer.number(0.2, 2), 0.5)
        if writer.chance(0.5):
            writer.call("gluPerspective", writer.number(30, 90), 1.0, writer.number(0.1, 2), writer.number(3, 20))
        if writer.chance(0.5):
            writer.call("glRotatef", writer.number(-180, 180), 0.0, writer.pick([0.0, 0.6]), 1.0)
    elif writer.chance(0.3):
        writer.call("glLoadMatrixf", np.round(writer.rng.uniform(-1, 1, 16), 3).astype(np.float32))
    writer.call("glMatrixMode", "GL_MODELVIEW")


# -- two units ---------------------------------------------------------------------------------------------------------
def texture_pair(writer: Writer) -> None:
    texture(writer)
    writer.call("glActiveTexture", "GL_TEXTURE1")
    writer.color_texture("texture 1")
    writer.call("glActiveTexture", "GL_TEXTURE0")


def two_textures(writer: Writer) -> None:
    if writer.chance(0.3):
        writer.matrices(rotations=False)
    if writer.chance(0.3):
        writer.fragment_state()
    for unit in ("GL_TEXTURE1", "GL_TEXTURE0"):
        writer.call("glActiveTexture", unit)
        writer.switch("GL_TEXTURE_2D", 0.8)
        writer.call("glTexEnvi", "GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", writer.pick(MODES))
        writer.call("glTexEnvfv", "GL_TEXTURE_ENV", "GL_TEXTURE_ENV_COLOR", list(writer.color()))
        if writer.chance(0.3):
            generated_coordinates(writer)
    writer.texture_coordinates = writer.pick([2, 3, 4])
    writer.second_coordinates = 2
