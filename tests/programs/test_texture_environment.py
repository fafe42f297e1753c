"""Texture environments: GL's tables by example, and all modes and formats against Mesa."""

from typing import Any

import numpy as np
import pytest

from mesa_points import POINTS, fragments_on_mesa, same_bits
from softshadow import tokens as gl
from softshadow.image import FORMATS, Image
from softshadow.programs import sampling
from softshadow.programs.texture_environment import MODES, apply_environment
from softshadow.texture import Sampler, Texture
from softshadow.tokens import token_name

FORMAT_NAMES = ("RGBA8", "RGB8", "ALPHA8", "LUMINANCE8", "LUMINANCE8_ALPHA8", "INTENSITY8", "R8", "RG8")
ENVIRONMENT = (0.125, 0.25, 0.5, 0.75)


def combined(mode: int, base: int, texel: tuple[float, ...] = (0.5, 0.25, 0.125, 0.5)) -> list[float]:
    """Return the colour of a fragment (0.8, 0.4, 0.2, 0.5) after the environment."""
    fragment = np.array([[0.8, 0.4, 0.2, 0.5]], np.float32)
    apply_environment(fragment, np.array([texel], np.float32), mode, base, ENVIRONMENT)
    return [round(float(c), 6) for c in fragment[0]]


def test_tables_of_the_specification():
    assert combined(gl.GL_REPLACE, gl.GL_RGBA) == [0.5, 0.25, 0.125, 0.5]
    assert combined(gl.GL_REPLACE, gl.GL_RGB, (0.5, 0.25, 0.125, 1)) == [0.5, 0.25, 0.125, 0.5]
    assert combined(gl.GL_REPLACE, gl.GL_ALPHA, (0, 0, 0, 0.25)) == [0.8, 0.4, 0.2, 0.25]
    assert combined(gl.GL_MODULATE, gl.GL_RGBA) == [0.4, 0.1, 0.025, 0.25]
    assert combined(gl.GL_MODULATE, gl.GL_LUMINANCE, (0.5, 0.5, 0.5, 1)) == [0.4, 0.2, 0.1, 0.5]
    assert combined(gl.GL_DECAL, gl.GL_RGBA) == [0.65, 0.325, 0.1625, 0.5]
    assert combined(gl.GL_BLEND, gl.GL_RGB) == [0.4625, 0.3625, 0.2375, 0.5]
    assert combined(gl.GL_ADD, gl.GL_RGBA) == [1.0, 0.65, 0.325, 0.25]
    assert combined(gl.GL_ADD, gl.GL_INTENSITY, (0.3,) * 4) == [1.0, 0.7, 0.5, 0.8]


@pytest.mark.mesa
@pytest.mark.parametrize("mode", MODES, ids=token_name)
@pytest.mark.parametrize("name", FORMAT_NAMES)
def test_environments_are_mesas(name, mode):
    rng = np.random.default_rng(11)
    cells = rng.integers(0, 256, (8, 8, 4), dtype=np.uint8)
    colors, texcoord = rng.random((POINTS, 4), np.float32), rng.random((POINTS, 4), np.float32)
    texcoord[:, 3] = 1
    internal = getattr(gl, f"GL_{name}")

    def setup(on: Any) -> None:
        on.glBindTexture(on.GL_TEXTURE_2D, on.glGenTextures(1))
        on.glTexImage2D(on.GL_TEXTURE_2D, 0, internal, 8, 8, 0, on.GL_RGBA, on.GL_UNSIGNED_BYTE, cells)
        on.glTexParameteri(on.GL_TEXTURE_2D, on.GL_TEXTURE_MIN_FILTER, on.GL_LINEAR)
        on.glEnable(on.GL_TEXTURE_2D)
        on.glTexEnvi(on.GL_TEXTURE_ENV, on.GL_TEXTURE_ENV_MODE, mode)
        on.glTexEnvfv(on.GL_TEXTURE_ENV, on.GL_TEXTURE_ENV_COLOR, ENVIRONMENT)

    image = Image.new(FORMATS[internal], 8, 8)
    image.view[:] = cells
    texture = Texture(1, gl.GL_TEXTURE_2D, Sampler(min_filter=gl.GL_LINEAR), {(0, 0): image})
    texel, ours = np.empty_like(colors), colors.copy()
    sampling.sample(texture, sampling.project(texcoord), texel)
    apply_environment(ours, texel, mode, sampling.base_format(texture), ENVIRONMENT)
    assert same_bits(ours, fragments_on_mesa(setup, {"texcoord": texcoord, "color": colors}))
