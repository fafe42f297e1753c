"""Generated mipmaps: special cases by example, and every texel of every level against Mesa."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.pipeline.execute import execute
from softshadow.testing import run_on_mesa

CASES = [(16, 16, 0, 1000), (13, 16, 0, 1000), (7, 9, 0, 2), (64, 48, 1, 1000), (33, 1, 0, 1000), (50, 37, 1, 4)]
# of GL_DEPTH_COMPONENT32 cells keep 24 bits, so that its levels agree with Mesa's to 2**-23 only
FORMATS = (
    "GL_RGBA8", "GL_RGB8", "GL_LUMINANCE8_ALPHA8", "GL_INTENSITY8", "GL_R8", "GL_RGBA32F", "GL_R32F",
    "GL_DEPTH_COMPONENT16", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT32F",
)  # fmt: skip


@pytest.fixture
def context():
    with gl.create_context(8, 8) as context:
        yield context


def define(gl: Any, width: int, height: int, level: int = 0, internal: str = "GL_RGBA8") -> tuple[int, int]:
    """Define a level of random texels; returns the client format and type that read it back."""
    rng = np.random.default_rng([width, height])
    if "DEPTH" in internal:
        formats, data = (gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT), rng.random((height, width), np.float32)
    elif internal.endswith("F"):
        formats, data = (gl.GL_RGBA, gl.GL_FLOAT), rng.normal(size=(height, width, 4)).astype(np.float32)
    else:
        formats, data = (gl.GL_RGBA, gl.GL_UNSIGNED_BYTE), rng.integers(0, 256, (height, width, 4), dtype=np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, level, getattr(gl, internal), width, height, 0, *formats, data)
    return formats


def size_of(level: int) -> tuple[int, int]:
    names = gl.GL_TEXTURE_WIDTH, gl.GL_TEXTURE_HEIGHT
    width, height = (gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, level, name) for name in names)
    return width, height


def all_levels(gl: Any, width: int, height: int, base: int, last: int, internal: str, automatic: bool) -> list[Any]:
    """All generated levels of one texture, read back."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BASE_LEVEL, base)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAX_LEVEL, last)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_GENERATE_MIPMAP, automatic)
    formats = define(gl, width, height, base, internal)
    if not automatic:
        gl.glGenerateMipmap(gl.GL_TEXTURE_2D)
    levels = []
    for level in range(base, base + max(width, height).bit_length() + 1):
        side = gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, level, gl.GL_TEXTURE_WIDTH)
        levels.append(np.array(gl.glGetTexImage(gl.GL_TEXTURE_2D, level, *formats)) if side else None)
    return levels


@pytest.mark.mesa
@pytest.mark.parametrize("case", CASES)
def test_generated_levels_are_mesas(context, case):
    def program(gl: Any) -> list[Any]:
        return [all_levels(gl, *case, internal, bool(i % 2)) for i, internal in enumerate(FORMATS)]  # type: ignore[call-arg]

    for internal, ours, theirs in zip(FORMATS, program(gl), run_on_mesa(program, (8, 8)).returned, strict=True):
        for level, (mine, wanted) in enumerate(zip(ours, theirs, strict=True)):
            assert np.array_equal(mine, wanted), (internal, level)


def test_a_level_of_even_sides_is_the_mean_of_2x2_texels_rounded_up_per_axis(context):
    define(gl, 8, 4)
    gl.glGenerateMipmap(gl.GL_TEXTURE_2D)
    large, small = (gl.glGetTexImage(gl.GL_TEXTURE_2D, n, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE).astype(int) for n in (0, 1))
    rows = (large[:, ::2] + large[:, 1::2] + 1) // 2
    assert ((rows[::2] + rows[1::2] + 1) // 2 == small).all()


def test_all_levels_down_to_one_texel_are_made(context):
    define(gl, 12, 5)
    gl.glGenerateMipmap(gl.GL_TEXTURE_2D)
    assert [size_of(level) for level in range(5)] == [(12, 5), (6, 2), (3, 1), (1, 1), (0, 0)]


def test_automatic_mipmaps_follow_the_base_level(context):
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_GENERATE_MIPMAP, gl.GL_TRUE)
    assert gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, gl.GL_GENERATE_MIPMAP) == 1
    define(gl, 4, 4)
    white = np.full((4, 4, 4), 255, np.uint8)
    gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 4, 4, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, white)
    assert (gl.glGetTexImage(gl.GL_TEXTURE_2D, 2, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE) == 255).all()
    gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, 4, 4)
    assert (gl.glGetTexImage(gl.GL_TEXTURE_2D, 2, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE) == 0).all()


def test_mipmaps_need_a_base_level(context):
    with pytest.raises(gl.GLError, match="glGenerateMipmap: the bound texture needs a base level"):
        gl.glGenerateMipmap(gl.GL_TEXTURE_2D)


def test_replay_makes_the_levels_again(context):
    define(gl, 8, 8)
    gl.glGenerateMipmap(gl.GL_TEXTURE_2D)
    storage = context.frame.fresh_storage()
    for command in context.frame.commands:
        execute(command, storage)
    images = context.storage.textures[0].images
    assert len(images) == 4
    assert all(storage.textures[0].images[key].same_as(image) for key, image in images.items())
