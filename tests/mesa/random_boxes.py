"""Random programs with 1-D and 3-D textures and rectangles: mipmapped, compared, anisotropic, changed in part."""

import numpy as np

from mesa.random_texturing import MODES, texture_matrix
from mesa.random_writer import COMPARISONS, Writer

TARGETS = ["GL_TEXTURE_1D", "GL_TEXTURE_3D", "GL_TEXTURE_RECTANGLE"]
FILTERS = ["GL_NEAREST", "GL_LINEAR"]
MIPMAP_FILTERS = [f"{within}_MIPMAP_{between}" for within in FILTERS for between in ("NEAREST", "LINEAR")]
CLAMPS = ["GL_CLAMP", "GL_CLAMP_TO_EDGE", "GL_CLAMP_TO_BORDER"]
WRAPS = [*CLAMPS, "GL_REPEAT", "GL_REPEAT", "GL_MIRRORED_REPEAT"]
COLORS = ["GL_RGBA8", "GL_RGBA8", "GL_RGB8", "GL_LUMINANCE8", "GL_INTENSITY8", "GL_ALPHA8", "GL_RGBA32F"]
DEPTHS = [f"GL_DEPTH_COMPONENT{kind}" for kind in ("24", "16", "32F")]
SIDES = [1, 2, 3, 4, 5, 7, 8, 9, 16]
LARGEST_ANISOTROPIES = [1.5, 2.0, 2.5, 16.0]


def parameter(writer: Writer, target: str, name: str, value: object) -> None:
    call = "glTexParameterf" if isinstance(value, float) else "glTexParameteri"
    writer.call(call, target, name, value)


def texels_of(writer: Writer, shape: tuple[int, int, int], internal: str) -> tuple[str, str, np.ndarray]:
    """Return format, type and pixels of a (width, height, depth) image."""
    if internal in DEPTHS:
        return "GL_DEPTH_COMPONENT", "GL_FLOAT", writer.rng.random(shape[::-1], dtype=np.float32)
    if writer.chance(0.5):
        return "GL_RGBA", "GL_UNSIGNED_BYTE", writer.rng.integers(0, 256, (*shape[::-1], 4), dtype=np.uint8)
    return "GL_RGBA", "GL_FLOAT", writer.rng.random((*shape[::-1], 4), dtype=np.float32) * np.float32(1.1)


def sides_of(target: str, shape: tuple[int, int, int]) -> tuple[int, ...]:
    """Return the sides that the calls for a target take."""
    return shape[: {"GL_TEXTURE_1D": 1, "GL_TEXTURE_3D": 3}.get(target, 2)]


def box(writer: Writer, target: str, name: str) -> tuple[int, int, int]:
    """Bind a texture with one level, with given or with computed levels; return its shape."""
    width, height, depth = (writer.pick(SIDES) for _ in range(3))
    shape = (width, height if target != TARGETS[0] else 1, depth if target == TARGETS[1] else 1)
    internal = writer.pick(DEPTHS) if writer.chance(0.25) and target != TARGETS[1] else writer.pick(COLORS)
    writer.call("glBindTexture", target, name)
    mipmaps = writer.pick(["none", "given", "computed"]) if target != TARGETS[2] else "none"
    if mipmaps == "computed":
        parameter(writer, target, "GL_GENERATE_MIPMAP", "GL_TRUE")
    dimensions = len(sides_of(target, shape))
    for level in range(max(shape).bit_length() if mipmaps == "given" else 1):
        level_shape = tuple(max(side >> level, 1) for side in shape)
        call, sides = f"glTexImage{dimensions}D", sides_of(target, level_shape)
        writer.call(call, target, level, internal, *sides, 0, *texels_of(writer, level_shape, internal))
    if writer.chance(0.3):
        part = tuple(max(side // 2, 1) for side in shape)
        corner = sides_of(target, tuple(side - other for side, other in zip(shape, part, strict=True)))
        call, sides = f"glTexSubImage{dimensions}D", sides_of(target, part)
        writer.call(call, target, 0, *corner, *sides, *texels_of(writer, part, internal))
    sampler(writer, target, mipmaps != "none", internal in DEPTHS)
    return shape


def sampler(writer: Writer, target: str, mipmapped: bool, depths: bool) -> None:
    parameter(writer, target, "GL_TEXTURE_MIN_FILTER", writer.pick(MIPMAP_FILTERS + FILTERS if mipmapped else FILTERS))
    parameter(writer, target, "GL_TEXTURE_MAG_FILTER", writer.pick(FILTERS))
    for axis in "STR":
        wraps = CLAMPS if target == TARGETS[2] else WRAPS
        parameter(writer, target, f"GL_TEXTURE_WRAP_{axis}", writer.pick(wraps))
    if writer.chance(0.5):
        writer.call("glTexParameterfv", target, "GL_TEXTURE_BORDER_COLOR", list(writer.color()))
    if writer.chance(0.2):
        parameter(writer, target, "GL_TEXTURE_LOD_BIAS", writer.number(-2, 2))
    if writer.chance(0.2):
        parameter(writer, target, "GL_TEXTURE_MAX_LOD", writer.number(1, 4))
    if depths and writer.chance(0.5):
        parameter(writer, target, "GL_TEXTURE_COMPARE_MODE", "GL_COMPARE_R_TO_TEXTURE")
        parameter(writer, target, "GL_TEXTURE_COMPARE_FUNC", writer.pick(COMPARISONS))
    elif target != TARGETS[0] and writer.chance(0.3):
        parameter(writer, target, "GL_TEXTURE_MAX_ANISOTROPY_EXT", writer.pick(LARGEST_ANISOTROPIES))


# -- before, between and after the draws -------------------------------------------------------------------------------
def boxes(writer: Writer) -> None:
    """Textures of one target or of all; rectangles and 2-D textures may be enabled at once."""
    if writer.chance(0.3):
        writer.color_texture("texture 0")
        writer.call("glEnable", "GL_TEXTURE_2D")
    for number, target in enumerate(TARGETS):
        box(writer, target, writer.pick([f"texture {number + 1}", 0]))


def boxed(writer: Writer) -> None:
    if writer.chance(0.5):
        writer.matrices(rotations=writer.chance(0.5))
    for target in TARGETS:
        writer.switch(target, 0.5)
    writer.call("glTexEnvi", "GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", writer.pick(["GL_REPLACE", *MODES]))
    for name in "STR":
        if writer.switch(f"GL_TEXTURE_GEN_{name}", 0.3):
            writer.call("glTexGeni", f"GL_{name}", "GL_TEXTURE_GEN_MODE", "GL_OBJECT_LINEAR")
            writer.call("glTexGenfv", f"GL_{name}", "GL_OBJECT_PLANE", [writer.number(-4, 4) for _ in range(4)])
    texture_matrix(writer)
    writer.texture_coordinates = writer.pick([3, 3, 4])


def copied_boxes(writer: Writer) -> None:
    """Copy parts of the framebuffer into textures of one and three dimensions, and read them."""
    x, y = (writer.integer(-3, length) for length in writer.size)
    writer.call("glBindTexture", "GL_TEXTURE_1D", "texture 4")
    writer.call("glCopyTexImage1D", "GL_TEXTURE_1D", 0, writer.pick(["GL_RGBA8", "GL_DEPTH_COMPONENT24"]), x, y, 9, 0)
    writer.call("glBindTexture", "GL_TEXTURE_3D", "texture 5")
    texels = texels_of(writer, (5, 4, 3), "GL_RGBA8")
    writer.call("glTexImage3D", "GL_TEXTURE_3D", 0, "GL_RGBA8", 5, 4, 3, 0, *texels)
    writer.call("glCopyTexSubImage3D", "GL_TEXTURE_3D", 0, 1, 2, writer.integer(0, 2), x, y, 3, 2)
    writer.call("glGetTexImage", "GL_TEXTURE_3D", 0, "GL_RGBA", "GL_UNSIGNED_BYTE")
    for target in ("GL_TEXTURE_1D", "GL_TEXTURE_3D"):
        for query in ("GL_TEXTURE_WIDTH", "GL_TEXTURE_HEIGHT", "GL_TEXTURE_DEPTH", "GL_TEXTURE_DEPTH_SIZE"):
            writer.call("glGetTexLevelParameteriv", target, 0, query)
