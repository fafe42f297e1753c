"""Framebuffer objects are complete where they are on Mesa: depth and stencil in one image, all mipmaps defined."""

from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = (8, 8)
PACKED = ("GL_DEPTH24_STENCIL8", "GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8")
COLOR = ("GL_RGBA8", "GL_RGBA", "GL_UNSIGNED_BYTE")
Attached = tuple[str, str, int, int]  # kind, point, which object, level


def status(objects: list[tuple[str, ...]], attached: list[Attached], levels: int = 1, last: int = 1000) -> Any:
    """Return a program that creates renderbuffers and textures, attaches them, and returns the status.

    An object of one token is a renderbuffer of that format; three are a texture's internal format, format and type.
    """

    def program(gl: Any) -> list[np.ndarray]:
        names = []
        for tokens in objects:
            formats = [getattr(gl, token) for token in tokens]
            names.append(gl.glGenTextures(1) if len(formats) == 3 else gl.glGenRenderbuffers(1))
            if len(formats) == 1:
                gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, names[-1])
                gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, formats[0], 4, 4)
                continue
            gl.glBindTexture(gl.GL_TEXTURE_2D, names[-1])
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAX_LEVEL, last)
            for level in range(levels):
                side = 4 >> level
                gl.glTexImage2D(gl.GL_TEXTURE_2D, level, formats[0], side, side, 0, formats[1], formats[2], None)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        for kind, point, number, level in attached:
            place = (gl.GL_FRAMEBUFFER, getattr(gl, f"GL_{point}_ATTACHMENT" + "0" * (point == "COLOR")))
            if kind == "texture":
                gl.glFramebufferTexture2D(*place, gl.GL_TEXTURE_2D, names[number], level)
            else:
                gl.glFramebufferRenderbuffer(*place, gl.GL_RENDERBUFFER, names[number])
        return [np.array([int(gl.glCheckFramebufferStatus(gl.GL_FRAMEBUFFER))])]

    return program


def buffers(kinds: tuple[str, str], numbers: tuple[int, int]) -> list[Attached]:
    return [(kinds[0], "DEPTH", numbers[0], 0), (kinds[1], "STENCIL", numbers[1], 0)]


PROGRAMS = {
    "depth and stencil apart": status(
        [("GL_DEPTH_COMPONENT24",), ("GL_STENCIL_INDEX8",)], buffers(("buffer", "buffer"), (0, 1))
    ),
    "stencil alone": status([("GL_STENCIL_INDEX8",)], [("buffer", "STENCIL", 0, 0)]),
    "packed in one": status([PACKED[:1]], buffers(("buffer", "buffer"), (0, 0))),
    "packed in two": status([PACKED[:1]] * 2, buffers(("buffer", "buffer"), (0, 1))),
    "packed in two textures": status([PACKED] * 2, buffers(("texture", "texture"), (0, 1))),
    "packed in a texture": status([PACKED], buffers(("texture", "texture"), (0, 0))),
    "texture and renderbuffer": status([PACKED, PACKED[:1]], buffers(("texture", "buffer"), (0, 1))),
    "level of a half chain": status([COLOR], [("texture", "COLOR", 0, 1)], levels=2),
    "level of a whole chain": status([COLOR], [("texture", "COLOR", 0, 1)], levels=3),
    "level of a chain cut short": status([COLOR], [("texture", "COLOR", 0, 1)], levels=2, last=1),
    "base of a half chain": status([COLOR], [("texture", "COLOR", 0, 0)], levels=2),
    "packed level of a half chain": status([PACKED], [("texture", "DEPTH_STENCIL", 0, 1)], levels=2),
}


@pytest.mark.parametrize("name", PROGRAMS)
def test_framebuffers_are_complete_where_they_are_on_mesa(name):
    comparison = compare(PROGRAMS[name], SIZE)
    assert comparison, str(comparison)


@pytest.mark.parametrize("format", ["GL_DEPTH24_STENCIL8", "GL_DEPTH32F_STENCIL8"])
def test_depth_and_stencil_are_read_together_as_on_mesa(format):
    def program(gl: Any) -> list[np.ndarray]:
        rng = np.random.default_rng(2)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, gl.glGenRenderbuffers(1))
        buffer = int(gl.glGetIntegerv(gl.GL_RENDERBUFFER_BINDING))
        gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, getattr(gl, format), *SIZE)
        place = (gl.GL_FRAMEBUFFER, gl.GL_DEPTH_STENCIL_ATTACHMENT)
        gl.glFramebufferRenderbuffer(*place, gl.GL_RENDERBUFFER, buffer)
        gl.glDrawBuffer(gl.GL_NONE)
        gl.glClearStencil(5)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
        for cap in (gl.GL_DEPTH_TEST, gl.GL_STENCIL_TEST):
            gl.glEnable(cap)
        gl.glStencilOp(gl.GL_INCR, gl.GL_INCR, gl.GL_INCR)
        gl.glBegin(gl.GL_TRIANGLES)
        for corner in rng.uniform(-1.5, 1.5, (12, 3)).tolist():
            gl.glVertex3f(*corner)
        gl.glEnd()
        return [np.array(gl.glReadPixels(0, 0, *SIZE, gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8))]

    comparison = compare(program, SIZE)
    assert comparison, str(comparison)
