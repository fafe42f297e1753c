"""Random programs with cube maps: of colours and depths, mipmapped, seamless, drawn into and copied into.

They generate coordinates in the modes that go with cube maps, and bias the level of detail by texture and by unit.
"""

import numpy as np

from mesa.random_texturing import MODES, texture_matrix
from mesa.random_writer import COMPARISONS, Writer

FACES = [f"GL_TEXTURE_CUBE_MAP_{sign}_{axis}" for axis in "XYZ" for sign in ("POSITIVE", "NEGATIVE")]
FILTERS = ["GL_NEAREST", "GL_LINEAR"]
MIPMAP_FILTERS = [f"{within}_MIPMAP_{between}" for within in FILTERS for between in ("NEAREST", "LINEAR")]
WRAPS = ["GL_REPEAT", "GL_CLAMP_TO_EDGE", "GL_MIRRORED_REPEAT", "GL_CLAMP_TO_BORDER", "GL_CLAMP"]
COLORS = ["GL_RGBA8", "GL_RGBA8", "GL_RGB8", "GL_LUMINANCE8", "GL_INTENSITY8", "GL_ALPHA8", "GL_RGBA32F"]
DEPTHS = [f"GL_DEPTH_COMPONENT{kind}" for kind in ("24", "16", "32", "32F")]
GENERATED = ["GL_REFLECTION_MAP", "GL_NORMAL_MAP", "GL_SPHERE_MAP", "GL_OBJECT_LINEAR", "GL_EYE_LINEAR"]


def parameter(writer: Writer, name: str, value: object) -> None:
    call = "glTexParameterf" if isinstance(value, float) else "glTexParameteri"
    writer.call(call, "GL_TEXTURE_CUBE_MAP", name, value)


def cube(writer: Writer, name: str) -> None:
    """Bind a cube map; it may be incomplete."""
    side, internal = writer.pick([1, 2, 3, 4, 7, 8, 16]), writer.pick(COLORS if writer.chance(0.7) else DEPTHS)
    writer.call("glBindTexture", "GL_TEXTURE_CUBE_MAP", name)
    mipmaps = writer.pick(["none", "given", "generated"])
    if mipmaps == "generated" and writer.chance(0.5):
        parameter(writer, "GL_GENERATE_MIPMAP", "GL_TRUE")
    missing = writer.pick(FACES) if writer.chance(0.05) else ""
    for face in FACES:
        if face != missing:
            levels = side.bit_length() if mipmaps == "given" else 1
            for level in range(levels):
                image(writer, face, level, internal, max(side >> level, 1))
    if mipmaps == "generated" and not missing:
        writer.call("glGenerateMipmap", "GL_TEXTURE_CUBE_MAP")
    mipmapped = mipmaps != "none" or writer.chance(0.05)
    parameter(writer, "GL_TEXTURE_MIN_FILTER", writer.pick(MIPMAP_FILTERS + FILTERS if mipmapped else FILTERS))
    parameter(writer, "GL_TEXTURE_MAG_FILTER", writer.pick(FILTERS))
    sampler(writer, side)
    if internal in DEPTHS:
        comparison(writer)


def image(writer: Writer, face: str, level: int, internal: str, side: int) -> None:
    if internal in DEPTHS:
        texels = writer.rng.random((side, side), dtype=np.float32)
        layout = ("GL_DEPTH_COMPONENT", "GL_FLOAT")
    else:
        texels = writer.rng.integers(0, 256, (side, side, 4), dtype=np.uint8)
        layout = ("GL_RGBA", "GL_UNSIGNED_BYTE")
    writer.call("glTexImage2D", face, level, internal, side, side, 0, *layout, texels)


def sampler(writer: Writer, side: int) -> None:
    for axis in "STR":
        if writer.chance(0.7):
            parameter(writer, f"GL_TEXTURE_WRAP_{axis}", writer.pick(WRAPS))
    if writer.chance(0.3):
        writer.call("glTexParameterfv", "GL_TEXTURE_CUBE_MAP", "GL_TEXTURE_BORDER_COLOR", list(writer.color()))
    if writer.chance(0.2):
        parameter(writer, "GL_TEXTURE_BASE_LEVEL", writer.integer(0, 1))
    if writer.chance(0.2):
        parameter(writer, "GL_TEXTURE_MAX_LEVEL", writer.integer(1, max(side.bit_length() - 1, 1)))
    if writer.chance(0.2):
        parameter(writer, "GL_TEXTURE_MIN_LOD", writer.number(-1, 2))
    if writer.chance(0.2):
        parameter(writer, "GL_TEXTURE_MAX_LOD", writer.number(2, 4))
    if writer.chance(0.2):
        parameter(writer, "GL_TEXTURE_LOD_BIAS", writer.number(-3, 3))
    if writer.chance(0.2):
        parameter(writer, "GL_TEXTURE_CUBE_MAP_SEAMLESS", 1)


def comparison(writer: Writer) -> None:
    if writer.chance(0.5):
        parameter(writer, "GL_TEXTURE_COMPARE_MODE", "GL_COMPARE_R_TO_TEXTURE")
        parameter(writer, "GL_TEXTURE_COMPARE_FUNC", writer.pick(COMPARISONS))
    parameter(writer, "GL_DEPTH_TEXTURE_MODE", writer.pick(["GL_LUMINANCE", "GL_INTENSITY", "GL_ALPHA"]))


# -- before, between and after the draws -------------------------------------------------------------------------------
def cubes(writer: Writer) -> None:
    """One or two units with cube maps, the first one with a 2-D texture, too; perhaps faces that are drawn into."""
    writer.normals = True
    if writer.chance(0.3):
        writer.color_texture("texture 0")
        writer.call("glEnable", "GL_TEXTURE_2D")
    if writer.chance(0.3):
        writer.call("glActiveTexture", "GL_TEXTURE1")
        cube(writer, "texture 1")
        writer.call("glEnable", "GL_TEXTURE_CUBE_MAP")
        writer.call("glTexEnvi", "GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", writer.pick(MODES))
        writer.call("glActiveTexture", "GL_TEXTURE0")
        writer.second_coordinates = 2
    cube(writer, "texture 2")
    if writer.chance(0.3):
        drawn_faces(writer, "texture 3")


def drawn_faces(writer: Writer, name: str) -> None:
    """Draw into the faces of a cube map of colours or depths, and leave it bound."""
    side, depths = writer.pick([8, 16, 20]), writer.chance(0.5)
    internal = "GL_DEPTH_COMPONENT24" if depths else "GL_RGBA8"
    layout = ("GL_DEPTH_COMPONENT", "GL_FLOAT") if depths else ("GL_RGBA", "GL_UNSIGNED_BYTE")
    writer.call("glBindTexture", "GL_TEXTURE_CUBE_MAP", name)
    for face in FACES:
        writer.call("glTexImage2D", face, 0, internal, side, side, 0, *layout, None)
    writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", "framebuffer 0")
    writer.call("glViewport", 0, 0, side, side)
    if depths:
        writer.call("glDrawBuffer", "GL_NONE")
        writer.call("glReadBuffer", "GL_NONE")
    for face in FACES:
        attachment = "GL_DEPTH_ATTACHMENT" if depths else "GL_COLOR_ATTACHMENT0"
        writer.call("glFramebufferTexture2D", "GL_FRAMEBUFFER", attachment, face, name, 0)
        writer.call("glClear", "GL_DEPTH_BUFFER_BIT" if depths else "GL_COLOR_BUFFER_BIT")
        if writer.chance(0.6):
            if depths:
                writer.depth_state()
            writer.draw(wild=False)
    writer.call("glCheckFramebufferStatus", "GL_FRAMEBUFFER")
    writer.call("glBindFramebuffer", "GL_FRAMEBUFFER", 0)
    writer.call("glViewport", 0, 0, *writer.size)
    writer.call("glGetTexImage", writer.pick(FACES), 0, *layout)
    writer.call("glGenerateMipmap", "GL_TEXTURE_CUBE_MAP")
    parameter(writer, "GL_TEXTURE_MIN_FILTER", writer.pick(MIPMAP_FILTERS + FILTERS))
    parameter(writer, "GL_TEXTURE_MAG_FILTER", writer.pick(FILTERS))
    if depths:
        comparison(writer)


def mapped(writer: Writer) -> None:
    if writer.chance(0.6):
        writer.matrices(rotations=writer.chance(0.5))
    if writer.chance(0.2):
        writer.fragment_state()
    writer.switch("GL_TEXTURE_CUBE_MAP", 0.9)
    writer.switch("GL_TEXTURE_CUBE_MAP_SEAMLESS", 0.4)
    writer.switch("GL_NORMALIZE", 0.3)
    writer.switch("GL_RESCALE_NORMAL", 0.2)
    writer.call("glTexEnvi", "GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", writer.pick(["GL_REPLACE", *MODES]))
    writer.call(
        "glTexEnvf", "GL_TEXTURE_FILTER_CONTROL", "GL_TEXTURE_LOD_BIAS", writer.pick([0.0, writer.number(-2, 4)])
    )
    directions(writer)
    texture_matrix(writer)
    writer.texture_coordinates = writer.pick([3, 3, 4])


def directions(writer: Writer) -> None:
    """Generate s, t and r all alike, or each on its own."""
    alike = writer.pick(GENERATED[:2]) if writer.chance(0.4) else ""
    for number, name in enumerate("STR"):
        if writer.switch(f"GL_TEXTURE_GEN_{name}", 1.0 if alike else 0.3):
            mode = alike or writer.pick([mode for mode in GENERATED if number < 2 or mode != "GL_SPHERE_MAP"])
            writer.call("glTexGeni", f"GL_{name}", "GL_TEXTURE_GEN_MODE", mode)
            if mode.endswith("LINEAR"):
                plane = [writer.number(-1, 1) for _ in range(4)]
                writer.call("glTexGenfv", f"GL_{name}", mode.replace("LINEAR", "PLANE"), plane)


def copied_faces(writer: Writer) -> None:
    """Copy parts of the framebuffer into a face of a new cube map, and draw with it; look at what it is."""
    side, internal = 16, writer.pick(["GL_RGBA8", "GL_DEPTH_COMPONENT24"])
    layout = ("GL_DEPTH_COMPONENT", "GL_FLOAT") if internal in DEPTHS else ("GL_RGBA", "GL_UNSIGNED_BYTE")
    writer.call("glBindTexture", "GL_TEXTURE_CUBE_MAP", writer.pick(["texture 4", 0]))
    for face in FACES:
        corner = [writer.integer(0, length - side) for length in writer.size]
        if writer.chance(0.5):
            writer.call("glCopyTexImage2D", face, 0, internal, *corner, side, side, 0)
        else:
            image(writer, face, 0, internal, side)
            writer.call("glCopyTexSubImage2D", face, 0, 2, 3, *corner, side - 4, side - 5)
    for name in ("GL_TEXTURE_MIN_FILTER", "GL_TEXTURE_MAG_FILTER"):
        parameter(writer, name, writer.pick(FILTERS))
    face = writer.pick(FACES)
    writer.call("glGetTexImage", face, 0, *layout)
    for query in ("GL_TEXTURE_WIDTH", "GL_TEXTURE_RED_SIZE", "GL_TEXTURE_DEPTH_SIZE"):
        writer.call("glGetTexLevelParameteriv", face, 0, query)
    writer.draw(wild=False)
