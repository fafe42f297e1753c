"""Several colour buffers at once have the bits of Mesa: draws, clears and blits into mixed formats, random state."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.testing import compare, run_on_mesa

pytestmark = pytest.mark.mesa

SIZE = (20, 16)
FORMATS = ("GL_RGBA8", "GL_RGBA8", "GL_RGB8", "GL_R8", "GL_RGBA32F", "GL_R32F", "GL_RG8", "GL_RGBA16F")
FACTORS = ("GL_ONE", "GL_ZERO", "GL_SRC_ALPHA", "GL_ONE_MINUS_SRC_ALPHA", "GL_DST_COLOR", "GL_DST_ALPHA")


def attach(gl: Any, rng: np.random.Generator, count: int) -> list[str]:
    """Bind a framebuffer object with `count` colour buffers and a packed depth and stencil buffer."""
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    formats = [str(rng.choice(FORMATS)) for _ in range(count)]
    depth = (gl.GL_DEPTH_STENCIL_ATTACHMENT, "GL_DEPTH24_STENCIL8")
    points = [(gl.GL_COLOR_ATTACHMENT0 + i, name) for i, name in enumerate(formats)]
    for point, name in [*points, depth]:
        buffer = gl.glGenRenderbuffers(1)
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, buffer)
        gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, getattr(gl, name), *SIZE)
        gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, point, gl.GL_RENDERBUFFER, buffer)
    return formats


def choose(gl: Any, rng: np.random.Generator, count: int) -> None:
    """Choose draw buffers in any order, with gaps; an attachment point without an image is allowed."""
    chosen = [gl.GL_COLOR_ATTACHMENT0 + int(i) for i in rng.permutation(count + 1)]
    gl.glDrawBuffers(len(chosen), [gl.GL_NONE if rng.random() < 0.2 else mode for mode in chosen])


def set_state(gl: Any, rng: np.random.Generator) -> None:
    def switch(name: str, chance: float) -> None:
        (gl.glEnable if rng.random() < chance else gl.glDisable)(getattr(gl, name))

    for name, chance in (
        ("GL_BLEND", 0.5), ("GL_COLOR_LOGIC_OP", 0.2), ("GL_ALPHA_TEST", 0.3), ("GL_DEPTH_TEST", 0.4),
        ("GL_SCISSOR_TEST", 0.3), ("GL_STENCIL_TEST", 0.3),
    ):  # fmt: skip
        switch(name, chance)
    gl.glBlendFunc(*(getattr(gl, str(rng.choice(FACTORS))) for _ in range(2)))
    gl.glLogicOp(gl.GL_CLEAR + int(rng.integers(16)))
    gl.glAlphaFunc(gl.GL_NEVER + int(rng.integers(1, 8)), float(rng.choice([0.25, 0.3, 0.5, 1.5])))
    gl.glStencilOp(gl.GL_KEEP, gl.GL_INCR, gl.GL_INVERT)
    gl.glColorMask(*(int(rng.random() < 0.8) for _ in range(4)))
    gl.glScissor(2, 3, int(rng.integers(1, 20)), int(rng.integers(1, 16)))


def shapes(gl: Any, rng: np.random.Generator) -> None:
    gl.glBegin(gl.GL_TRIANGLES)
    for x, y, z in rng.uniform(-1.2, 1.2, (9, 3)).tolist():
        gl.glColor4f(*(rng.integers(0, 256, 4) / 255).tolist())
        gl.glVertex3f(x, y, z)
    gl.glEnd()


def read_all(gl: Any, count: int) -> list[np.ndarray]:
    answers = []
    for index in range(count):
        gl.glReadBuffer(gl.GL_COLOR_ATTACHMENT0 + index)
        answers.append(gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_FLOAT))
    answers.append(gl.glReadPixels(0, 0, *SIZE, gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_INT))
    return [np.array(answer) for answer in answers]


def program_of(seed: int):
    def program(gl: Any) -> list[np.ndarray]:
        rng = np.random.default_rng(seed)
        gl.glClearColor(*rng.random(4).tolist())
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        shapes(gl, rng)
        count = int(rng.integers(1, 5))
        attach(gl, rng, count)
        answers = []
        for _ in range(4):
            choose(gl, rng, count)
            set_state(gl, rng)
            if rng.random() < 0.6:
                gl.glClearColor(*rng.uniform(-0.5, 1.5, 4).tolist())
                gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
            shapes(gl, rng)
            if rng.random() < 0.3:
                gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, 0)
                gl.glBlitFramebuffer(0, 0, *SIZE, 0, 0, *SIZE, gl.GL_COLOR_BUFFER_BIT, gl.GL_NEAREST)
                gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, gl.glGetIntegerv(gl.GL_DRAW_FRAMEBUFFER_BINDING))
            answers += read_all(gl, count)
            answers.append(np.array([int(gl.glGetIntegerv(gl.GL_DRAW_BUFFER0 + i)) for i in range(8)]))
        return answers

    return program


@pytest.mark.parametrize("seed", range(12))
def test_every_draw_buffer_has_the_bits_of_mesa(seed):
    comparison = compare(program_of(seed), SIZE)
    assert comparison, str(comparison)


MODES = (
    "GL_NONE", "GL_FRONT", "GL_BACK", "GL_LEFT", "GL_RIGHT", "GL_FRONT_LEFT", "GL_BACK_LEFT", "GL_FRONT_RIGHT",
    "GL_FRONT_AND_BACK", "GL_AUX0", "GL_AUX1", "GL_COLOR_ATTACHMENT0", "GL_COLOR_ATTACHMENT2", "GL_COLOR_ATTACHMENT7",
    "GL_LESS",
)  # fmt: skip


@pytest.mark.parametrize("framebuffer", [0, 1])
def test_error_codes_and_names_of_draw_buffers_are_those_of_mesa(framebuffer):
    def program(gl: Any) -> list[list[int]]:
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
        rng, answers = np.random.default_rng(7), []
        chosen = [[mode] for mode in MODES] + [list(rng.choice(MODES, rng.integers(0, 10))) for _ in range(150)]
        for names in chosen:
            modes = [getattr(gl, name) for name in names]
            for call, arguments in (("glDrawBuffers", (len(modes), modes)), ("glDrawBuffer", modes[:1])):
                if not arguments:
                    continue
                try:
                    getattr(gl, call)(*arguments)
                except Exception as error:
                    if not hasattr(error, "err"):
                        raise
                answers.append(
                    [int(gl.glGetError()), *(int(gl.glGetIntegerv(gl.GL_DRAW_BUFFER0 + i)) for i in range(8))]
                )
        return answers

    with gl.create_context(*SIZE):
        ours = program(gl)
    assert ours == run_on_mesa(program, SIZE).returned
