"""Borders of texels are dropped as by Mesa: from images of one, two and three dimensions, and from copies."""

from typing import Any

import numpy as np
import pytest

from mesa.random_formats import SIZE, Textures
from softshadow.testing import compare

pytestmark = pytest.mark.mesa


def with_borders(seed: int) -> Any:
    """Return a program that defines and copies images with borders, and reads what is left."""

    def program(gl: Any) -> list[np.ndarray]:
        make, told = Textures(gl, seed), []
        gl.glWindowPos2i(0, 0)
        gl.glDrawPixels(*SIZE, *make.pixels(("GL_RGBA", "GL_FLOAT"), *SIZE))
        for kind, dimensions in (("1D", 1), ("2D", 2), ("3D", 3), ("2D", 2)):
            target, pair = make.new(f"GL_TEXTURE_{kind}"), make.pair()
            sides = [int(side) for side in make.rng.integers(3, 12, dimensions)]
            flat = [*sides, 1, 1]
            pixels = make.pixels(pair, flat[0], flat[1] * flat[2])
            getattr(gl, f"glTexImage{kind}")(target, 0, gl.GL_RGBA8, *sides, 1, *pixels)
            names = ("WIDTH", "HEIGHT", "DEPTH", "BORDER")
            tokens = [getattr(gl, f"GL_TEXTURE_{name}") for name in names]
            told.append(np.array([int(gl.glGetTexLevelParameteriv(target, 0, token)) for token in tokens]))
            told.append(np.ravel(gl.glGetTexImage(target, 0, gl.GL_RGBA, gl.GL_FLOAT)))
            if dimensions == 2:
                gl.glCopyTexImage2D(target, 0, gl.GL_RGB, 3, 4, 10, 7, 1)
            elif dimensions == 1:
                gl.glCopyTexImage1D(target, 0, gl.GL_RGB, 3, 4, 10, 1)
            told.append(np.ravel(gl.glGetTexImage(target, 0, gl.GL_RGBA, gl.GL_FLOAT)))
        for target, border, width in (
            (gl.GL_TEXTURE_2D, 2, 8), (gl.GL_TEXTURE_2D, -1, 8), (gl.GL_TEXTURE_2D, 1, 1),
            (gl.GL_TEXTURE_RECTANGLE, 1, 8),
        ):  # fmt: skip
            for call, arguments in (
                (gl.glTexImage2D, (gl.GL_RGBA, width, 8, border, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)),
                (gl.glCopyTexImage2D, (gl.GL_RGBA, 0, 0, width, 8, border)),
            ):
                try:
                    call(target, 0, *arguments)
                    told.append(np.array([0]))
                except gl.GLError as error:
                    told.append(np.array([int(error.err)]))
        return told

    return program


@pytest.mark.parametrize("seed", range(3))
def test_images_without_their_borders_are_those_of_mesa(seed: int) -> None:
    compared = compare(with_borders(seed), SIZE)
    assert compared, str(compared)
