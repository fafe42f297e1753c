"""Features of whole passes: queries, framebuffer objects, accumulation."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from softshadow.bench.corpus.features.feature import Around, feature

SIDE = 512


def occlusion_query(gl: Any) -> Around:
    """Fragments that pass the tests, counted by a query."""
    query = int(np.ravel(gl.glGenQueries(1))[0])

    @contextmanager
    def counted() -> Iterator[None]:
        gl.glBeginQuery(gl.GL_SAMPLES_PASSED, query)
        yield
        gl.glEndQuery(gl.GL_SAMPLES_PASSED)
        gl.glGetQueryObjectuiv(query, gl.GL_QUERY_RESULT)

    return counted


def accumulated(gl: Any) -> Around:
    """Pictures added in the accumulation buffer."""

    @contextmanager
    def added() -> Iterator[None]:
        yield
        gl.glAccum(gl.GL_MULT, 0.5)
        gl.glAccum(gl.GL_ACCUM, 0.5)
        gl.glAccum(gl.GL_RETURN, 1.0)

    return added


def copied_to_texture(gl: Any) -> Around:
    """Pictures copied to the texture of the next frame."""

    @contextmanager
    def copied() -> Iterator[None]:
        yield
        gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, 0, 0, 256, 256)

    return copied


def framebuffer_bytes(gl: Any) -> Around:
    """A texture of bytes as target, shown by a blit."""
    return _framebuffer(gl, gl.GL_RGBA8)


def framebuffer_floats(gl: Any) -> Around:
    """A texture of floats as target, shown by a blit."""
    return _framebuffer(gl, gl.GL_RGBA32F)


def _framebuffer(gl: Any, internal: int) -> Around:
    bound, texture, target = gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D), gl.glGenTextures(1), gl.GL_TEXTURE_2D
    gl.glBindTexture(target, texture)
    gl.glTexImage2D(target, 0, internal, SIDE, SIDE, 0, gl.GL_RGBA, gl.GL_FLOAT, None)
    gl.glTexParameteri(target, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    gl.glBindTexture(target, int(np.ravel(bound)[0]))
    framebuffer, depth = gl.glGenFramebuffers(1), gl.glGenRenderbuffers(1)
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, depth)
    gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH24_STENCIL8, SIDE, SIDE)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, target, texture, 0)
    for attachment in (gl.GL_DEPTH_ATTACHMENT, gl.GL_STENCIL_ATTACHMENT):
        gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, attachment, gl.GL_RENDERBUFFER, depth)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)

    @contextmanager
    def drawn() -> Iterator[None]:
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
        yield
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, framebuffer)
        gl.glBlitFramebuffer(0, 0, SIDE, 480, 0, 0, SIDE, 480, gl.GL_COLOR_BUFFER_BIT, gl.GL_NEAREST)
        gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, 0)

    return drawn


FEATURES = tuple(map(feature, (occlusion_query, accumulated, copied_to_texture, framebuffer_bytes, framebuffer_floats)))
