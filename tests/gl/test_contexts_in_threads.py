"""Several contexts that draw at the same time, each in a Python thread of its own."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import numpy as np
import pytest

from softshadow import gl, techniques
from softshadow.errors import StateError
from softshadow.pipeline import set_threads, threads
from softshadow.scene import Scene

SIZE = (96, 72)
DRAWN = [("volume-zfail", "boxes"), ("map", "torus"), ("planar", "overlapping"), ("volume-zpass", "torus")]


def draw(name: str, scene: str) -> list[np.ndarray]:
    """Return colour, depth and stencil of a technique drawn in a context of its own."""
    technique = techniques.get(name)
    with gl.create_context(*SIZE):
        for _ in technique.steps(gl, Scene.named(scene), size=SIZE, **technique.validate_options({})):
            pass
        return [
            gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE),
            gl.glReadPixels(0, 0, *SIZE, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT),
            gl.glReadPixels(0, 0, *SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE),
        ]


@pytest.mark.parametrize("most", [1, 2])
def test_pictures_drawn_at_the_same_time_are_those_drawn_one_by_one(most: int) -> None:
    before = threads()
    set_threads(most)
    start = Barrier(len(DRAWN))

    def together(name: str, scene: str) -> list[np.ndarray]:
        start.wait()
        return draw(name, scene)

    try:
        alone = [draw(*each) for each in DRAWN]
        with ThreadPoolExecutor(len(DRAWN)) as pool:
            futures = [pool.submit(together, *each) for each in DRAWN]
            at_once = [future.result() for future in futures]
    finally:
        set_threads(before)
    for expected, drawn in zip(alone, at_once, strict=True):
        for image, same in zip(expected, drawn, strict=True):
            np.testing.assert_array_equal(image, same)


def test_the_current_context_belongs_to_its_thread() -> None:
    with gl.create_context(8, 8):
        gl.glClearColor(1, 0, 0, 1)
        with ThreadPoolExecutor(1) as pool, pytest.raises(StateError, match="no current context"):
            pool.submit(gl.glClear, gl.GL_COLOR_BUFFER_BIT).result()
