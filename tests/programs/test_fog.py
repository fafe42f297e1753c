"""Fog: examples of the three modes, and comparison of fragments with Mesa, bit for bit."""

import math
from typing import Any

import numpy as np
import pytest

from mesa_points import POINTS, fragments_on_mesa, load, pixel_centers, same_bits
from softshadow import tokens as gl
from softshadow.errors import StateError
from softshadow.programs import VertexInputs, fixed_function
from softshadow.programs.fog import fog_factor
from softshadow.state import Fog, State


def factor(fog: Fog, distance: float) -> float:
    return float(fog_factor(fog, np.float32([distance]))[0])


def test_modes_of_the_specification():
    linear = Fog(True, gl.GL_LINEAR, start=1.0, end=5.0)
    assert [factor(linear, d) for d in (0, 1, 3, 5, 9)] == [1, 1, 0.5, 0, 0]
    # the polynomial of 2^x is good to about 1e-6
    assert factor(Fog(True, gl.GL_EXP, density=0.5), 3.0) == pytest.approx(math.exp(-1.5), rel=1e-5)
    assert factor(Fog(True, gl.GL_EXP2, density=0.5), 3.0) == pytest.approx(math.exp(-(1.5**2)), rel=1e-5)


def test_an_unknown_mode_is_named():
    with pytest.raises(StateError, match="GL_FOG_MODE is GL_LESS"):
        factor(Fog(True, gl.GL_LESS), 1.0)


@pytest.mark.mesa
@pytest.mark.parametrize("density", [0.25, 0.15, 0.14])  # the last two are scaled to other floats by single precision
@pytest.mark.parametrize("mode", [gl.GL_LINEAR, gl.GL_EXP, gl.GL_EXP2], ids=gl.token_name)
def test_fogged_fragments_are_mesas(mode, density):
    rng = np.random.default_rng(41)
    fog = Fog(True, mode, density=density, start=0.75, end=7.0, color=(0.3, 0.6, 0.9, 0.2))
    modelview = np.eye(4, dtype=np.float32)
    modelview[2] = (0.1, 0.2, 1.3, -4)
    position, colors = np.ones((POINTS, 4), np.float32), rng.random((POINTS, 4), np.float32)
    position[:, :2], position[:, 2] = pixel_centers(), rng.normal(0, 2, POINTS)

    def setup(on: Any) -> None:
        load(on, on.GL_MODELVIEW, modelview)
        load(on, on.GL_PROJECTION, np.diag([1, 1, 0.01, 1]))  # keeps all depths inside
        on.glEnable(on.GL_FOG)
        on.glFogi(on.GL_FOG_MODE, mode)
        on.glFogf(on.GL_FOG_DENSITY, fog.density)
        on.glFogf(on.GL_FOG_START, fog.start)
        on.glFogf(on.GL_FOG_END, fog.end)
        on.glFogfv(on.GL_FOG_COLOR, fog.color)

    program = fixed_function.program(State(fog=fog), {})
    inputs = VertexInputs(position, colors, position[:, :3], (), modelview, np.eye(4, dtype=np.float32), (), {})
    ours = np.empty_like(colors)
    program.shade(program.vertex(inputs).values, {}, ours)
    assert same_bits(ours, fragments_on_mesa(setup, {"vertex": position, "color": colors}))
