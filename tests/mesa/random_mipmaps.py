"""Random programs with mipmaps: all filters, levels made by GL or given, and which of them may be used."""

import numpy as np

from mesa.random_writer import Writer

MIN_FILTERS = [
    "GL_NEAREST", "GL_LINEAR", "GL_NEAREST_MIPMAP_NEAREST", "GL_LINEAR_MIPMAP_NEAREST", "GL_NEAREST_MIPMAP_LINEAR",
    "GL_LINEAR_MIPMAP_LINEAR",
]  # fmt: skip
SIDES = [1, 2, 3, 5, 8, 16, 16, 21, 32, 64]


def levels(writer: Writer) -> None:
    """Define a texture of several levels."""
    writer.call("glBindTexture", "GL_TEXTURE_2D", "texture 0")
    writer.call("glEnable", "GL_TEXTURE_2D")
    width, height = writer.pick(SIDES), writer.pick(SIDES)
    internal = writer.pick(["GL_RGBA8", "GL_RGBA8", "GL_RGB", "GL_LUMINANCE", "GL_ALPHA", "GL_RGBA32F"])
    way = writer.pick(["generate", "given", "followed"])
    if way == "followed":
        writer.call("glTexParameteri", "GL_TEXTURE_2D", "GL_GENERATE_MIPMAP", 1)
    for level in range(max(width, height).bit_length() if way == "given" else 1):
        _level(writer, level, internal, max(1, width >> level), max(1, height >> level))
    if way == "generate":
        writer.call("glGenerateMipmap", "GL_TEXTURE_2D")
    for level in range(max(width, height).bit_length()):
        if writer.chance(0.3):
            writer.call("glGetTexImage", "GL_TEXTURE_2D", level, "GL_RGBA", "GL_UNSIGNED_BYTE")


def _level(writer: Writer, level: int, internal: str, width: int, height: int) -> None:
    texels = writer.rng.integers(0, 256, (height, width, 4), dtype=np.uint8)
    image = (internal, width, height, 0, "GL_RGBA", "GL_UNSIGNED_BYTE", texels)
    writer.call("glTexImage2D", "GL_TEXTURE_2D", level, *image)


def minified(writer: Writer) -> None:
    """Choose how levels are used, and how small the texture shall become."""
    if writer.chance(0.4):
        writer.matrices(rotations=writer.chance(0.5))
    if writer.chance(0.2):
        writer.fragment_state()
    base = writer.pick([0, 0, 0, 1, 2])
    parameters = {
        "GL_TEXTURE_MIN_FILTER": writer.pick(MIN_FILTERS),
        "GL_TEXTURE_MAG_FILTER": writer.pick(["GL_NEAREST", "GL_LINEAR"]),
        "GL_TEXTURE_WRAP_S": writer.pick(["GL_REPEAT", "GL_CLAMP_TO_EDGE", "GL_MIRRORED_REPEAT"]),
        "GL_TEXTURE_WRAP_T": writer.pick(["GL_REPEAT", "GL_CLAMP_TO_EDGE", "GL_CLAMP_TO_BORDER"]),
        "GL_TEXTURE_BASE_LEVEL": base,
        "GL_TEXTURE_MAX_LEVEL": writer.pick([1000, 1000, base, base + 2]),
    }
    for name, value in parameters.items():
        writer.call("glTexParameteri", "GL_TEXTURE_2D", name, value)
    if writer.chance(0.3):
        writer.call("glTexParameterf", "GL_TEXTURE_2D", "GL_TEXTURE_MIN_LOD", writer.number(-2, 3))
        writer.call("glTexParameterf", "GL_TEXTURE_2D", "GL_TEXTURE_MAX_LOD", writer.number(0, 6))
    writer.call(
        "glTexParameterf", "GL_TEXTURE_2D", "GL_TEXTURE_LOD_BIAS", writer.pick([0.0, 0.0, writer.number(-2, 2)])
    )
    writer.call("glTexEnvi", "GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", writer.pick(["GL_REPLACE", "GL_MODULATE"]))
    writer.call("glMatrixMode", "GL_TEXTURE")
    writer.call("glLoadIdentity")
    repeats = writer.pick([0.1, 0.5, 1.0, 2.0, 7.0])
    writer.call("glScalef", repeats, writer.pick([repeats, 0.3]), 1.0)
    writer.call("glMatrixMode", "GL_MODELVIEW")
    writer.texture_coordinates = writer.pick([2, 2, 4])
