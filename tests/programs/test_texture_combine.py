"""GL_COMBINE: functions by example, and random settings of two units against Mesa."""

from typing import Any

import numpy as np
import pytest

from mesa_points import POINTS, fragments_on_mesa, same_bits
from softshadow import gl
from softshadow.gl import texture_combiners
from softshadow.programs.fixed_function import program
from softshadow.programs.texture_combine import Sources, combine
from softshadow.state import Combine
from softshadow.tokens import token_name

# seeds whose arguments cancel or repeat (x + (1 - x) and the like): Mesa's optimiser rearranges such sums
REARRANGED, LAST_BIT = (0, 7, 33, 34), 2.0**-23
PREVIOUS, TEXEL = (0.5, 0.25, 0.75, 0.5), (1.0, 0.5, 0.25, 0.25)


def combined(**fields: Any) -> list[float]:
    """Return the combined colour of a fragment with colour `PREVIOUS` and texel `TEXEL`."""
    previous, texel = np.float32([PREVIOUS]), np.float32([TEXEL])
    sources = Sources(0, {0: texel}, previous, previous, (0.5, 0.5, 0.5, 0.5))
    return [float(c) for c in combine(Combine(**fields), sources)[0]]


def test_functions_of_the_specification():
    assert combined() == [0.5, 0.125, 0.1875, 0.125]
    assert combined(mode_rgb=gl.GL_REPLACE, mode_alpha=gl.GL_REPLACE) == list(TEXEL)
    assert combined(mode_rgb=gl.GL_ADD)[:3] == [1, 0.75, 1]
    assert combined(mode_rgb=gl.GL_ADD_SIGNED)[:3] == [1, 0.25, 0.5]
    assert combined(mode_rgb=gl.GL_SUBTRACT)[:3] == [0.5, 0.25, 0]
    assert combined(mode_rgb=gl.GL_INTERPOLATE)[:3] == [0.75, 0.375, 0.5]
    assert combined(mode_rgb=gl.GL_DOT3_RGB, operands_rgb=(gl.GL_SRC_COLOR,) * 3)[:3] == [0, 0, 0]
    assert combined(mode_rgb=gl.GL_DOT3_RGBA, sources_rgb=(gl.GL_TEXTURE,) * 3) == [1, 1, 1, 1]


def test_scales_are_limited_to_1():
    assert combined(rgb_scale=4.0, alpha_scale=2.0) == [1, 0.5, 0.75, 0.25]


def test_a_unit_without_texture_gives_zeros_to_others():
    assert combined(mode_rgb=gl.GL_REPLACE, sources_rgb=(gl.GL_TEXTURE5,) * 3)[:3] == [0, 0, 0]


def random_settings(rng: np.random.Generator) -> dict[int, float]:
    """Return a random value for every parameter; sources are those of two units."""
    settings: dict[int, float] = {pname: int(rng.choice(v)) for pname, (_, v) in texture_combiners.MODES.items()}
    for pname, (_, _, values) in texture_combiners.ARGUMENTS.items():
        usable = [v for v in values if not gl.GL_TEXTURE1 < v <= gl.GL_TEXTURE7]
        settings[pname] = int(rng.choice(usable))
    for pname in texture_combiners.SCALES:
        settings[pname] = float(rng.choice(texture_combiners.SCALE_VALUES))
    return settings


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(40))
def test_combined_units_are_mesas(seed):
    rng = np.random.default_rng(seed)
    settings = [random_settings(rng), random_settings(rng)]
    cells = rng.integers(0, 256, (2, 8, 8, 4), dtype=np.uint8)
    colors, texcoord = rng.random((POINTS, 4), np.float32), rng.random((POINTS, 4), np.float32)
    texcoord[:, 3] = 1
    constants = rng.random((2, 4)).astype(np.float32)

    def setup(on: Any) -> None:
        for unit in (0, 1):
            on.glActiveTexture(on.GL_TEXTURE0 + unit)
            on.glBindTexture(on.GL_TEXTURE_2D, on.glGenTextures(1))
            on.glTexImage2D(on.GL_TEXTURE_2D, 0, on.GL_RGBA, 8, 8, 0, on.GL_RGBA, on.GL_UNSIGNED_BYTE, cells[unit])
            on.glTexParameteri(on.GL_TEXTURE_2D, on.GL_TEXTURE_MIN_FILTER, on.GL_LINEAR)
            on.glEnable(on.GL_TEXTURE_2D)
            on.glTexEnvi(on.GL_TEXTURE_ENV, on.GL_TEXTURE_ENV_MODE, on.GL_COMBINE)
            on.glTexEnvfv(on.GL_TEXTURE_ENV, on.GL_TEXTURE_ENV_COLOR, constants[unit])
            for pname, value in settings[unit].items():
                on.glTexEnvf(on.GL_TEXTURE_ENV, pname, value)
            on.glMultiTexCoord2f(on.GL_TEXTURE1, 0.3, 0.7)

    theirs = fragments_on_mesa(setup, {"texcoord": texcoord, "color": colors})
    with gl.create_context(8, 8) as context:
        setup(gl)
        textures = {(unit, gl.GL_TEXTURE_2D): context.storage.textures[unit + 1] for unit in (0, 1)}
        fixed_function = program(context.state, textures)
    second = np.broadcast_to(np.float32([0.3, 0.7, 0, 1]), (POINTS, 4))
    ours = np.empty_like(colors)
    # the last columns are for GL_PRIMARY_COLOR
    fixed_function.shade(np.concatenate([colors, texcoord, second, colors], axis=1), {}, ours)
    names = [{token_name(p): v for p, v in each.items()} for each in settings]
    if seed in REARRANGED:
        assert np.abs(ours - theirs).max() <= LAST_BIT, names
    else:
        assert same_bits(ours, theirs), names


@pytest.mark.parametrize("pname", sorted(texture_combiners.COMBINE_PARAMETERS), ids=token_name)
def test_parameters_are_read_back(pname):
    rng = np.random.default_rng(pname)
    with gl.create_context(4, 4):
        value = random_settings(rng)[pname]
        gl.glTexEnvf(gl.GL_TEXTURE_ENV, pname, value)
        assert gl.glGetTexEnvfv(gl.GL_TEXTURE_ENV, pname) == value
        wrong = gl.GL_INVALID_VALUE if pname in texture_combiners.SCALES else gl.GL_INVALID_ENUM
        with pytest.raises(gl.GLError) as error:
            gl.glTexEnvf(gl.GL_TEXTURE_ENV, pname, 3)
        assert error.value.err == wrong
        assert gl.glGetTexEnvfv(gl.GL_TEXTURE_ENV, pname) == value
