"""What depths of a texture are looked up as depends on how its image was defined, as on Mesa."""

import random
from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

MODES = ("GL_ALPHA", "GL_INTENSITY", "GL_LUMINANCE", "GL_RED")
DEPTH, HEIGHT = 0.6303, 8


def random_steps(seed: int) -> list[tuple[str, Any]]:
    """Return changes of parameters, uploads and copies in any order."""
    rng = random.Random(seed)
    values = {
        "mode": lambda: rng.choice(MODES),
        "base": lambda: rng.choice((0, 0, 0, 1)),
        "copy": lambda: (rng.choice((0, 0, 0, 1)), rng.choice((16, 8))),
        "upload": lambda: (rng.choice((0, 0, 0, 1)), rng.choice((16, 8))),
    }
    kinds = [rng.choice(("mode", "mode", "base", "copy", "copy", "copy", "upload")) for _ in range(rng.randint(2, 4))]
    return [(kind, values[kind]()) for kind in kinds]


def carry_out(gl: Any, step: str, value: Any) -> None:
    target = gl.GL_TEXTURE_2D
    if step == "mode":
        gl.glTexParameteri(target, gl.GL_DEPTH_TEXTURE_MODE, getattr(gl, value))
    elif step == "base":
        gl.glTexParameteri(target, gl.GL_TEXTURE_BASE_LEVEL, value)
    elif step == "copy":
        level, width = value
        gl.glCopyTexImage2D(target, level, gl.GL_DEPTH_COMPONENT, 0, 0, width, HEIGHT, 0)
    else:
        level, width = value
        depths = np.full((HEIGHT, width), DEPTH, np.float32)
        gl.glTexImage2D(
            target, level, gl.GL_DEPTH_COMPONENT, width, HEIGHT, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, depths
        )


@pytest.mark.parametrize("seed", range(40))
def test_depths_have_the_channels_that_mesa_gives_them(seed: int) -> None:
    steps = random_steps(seed)

    def program(gl: Any) -> None:
        gl.glClearDepth(DEPTH)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        for step, value in steps:
            carry_out(gl, step, value)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glColor4f(0.9, 0.5, 0.25, 0.7)
        gl.glRectf(-0.8, -0.9, 0.7, 0.4)

    assert str(compare(program, (24, 16))) == "no pixel differs", steps
