"""Slivers that are culled by their unsnapped corners, beside vertices that need clipping, as on Mesa."""

import os
from typing import Literal

import numpy as np
import pytest

from softshadow.pipeline import use_short_cuts
from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = (48, 40)
POLICIES: tuple[bool | Literal["always"], ...] = (True, "always", False)  # draws wait under the first one only
MODES = ("GL_TRIANGLES", "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN", "GL_QUADS", "GL_QUAD_STRIP", "GL_POLYGON")
WAYS = ("begin", "pairs", "list", "arrays", "elements", "buffers", "draws", "groups")
N = 256  # vertices of most draws
PROGRAMS = 40 if os.environ.get("SOFTSHADOW_LANE") == "all" else 6  # of each mode and way


def seeds(mode, way):
    first = 1000 * MODES.index(mode) + 100 * WAYS.index(way)
    return range(first, first + PROGRAMS)


def slivers(seed, n=N, outside=1):
    """Return n vertices (n, 4), all near one line, with some of them out of the view volume."""
    random = np.random.default_rng(seed)
    ends = random.uniform(-0.9, 0.9, (2, 4)) * (1, 1, 0.9, 0)
    places = random.uniform(0, 1, (n, 1))
    vertices = ends[0] + places * (ends[1] - ends[0])
    vertices[:, :2] += random.normal(0, 3e-4, (n, 2)) * random.integers(0, 2, (n, 1))
    vertices[:, 3] = 1
    if outside:
        chosen = random.choice(n, outside, replace=False)
        vertices[chosen, random.integers(0, 3)] = random.choice([-1, 1]) * random.uniform(1.05, 2)
    return vertices.astype(np.float32)


def state(gl, seed):
    random = np.random.default_rng(seed + 1000)
    gl.glEnable(gl.GL_CULL_FACE)
    gl.glCullFace(random.choice([gl.GL_FRONT, gl.GL_BACK]))
    gl.glFrontFace(random.choice([gl.GL_CW, gl.GL_CCW]))
    if random.integers(0, 2):
        gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_INCR_WRAP, gl.GL_INCR_WRAP)  # no sliver hides another one
    if random.integers(0, 2):
        gl.glColorMask(0, 0, 0, 0)
    if random.integers(0, 3) == 0:
        gl.glProvokingVertex(gl.GL_FIRST_VERTEX_CONVENTION)


def pair(gl, mode, vertices):
    gl.glBegin(mode)
    for vertex in vertices.tolist():
        gl.glVertex4f(*vertex)
    gl.glEnd()


def draw(gl, way, mode, vertices, seed):
    random = np.random.default_rng(seed + 2000)
    if way == "begin":
        pair(gl, mode, vertices)
    elif way == "groups":  # which Mesa draws together; the last pair is not complete
        for part in np.split(vertices[:-2], range(24, len(vertices) - 2, 24)):
            gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "part")
            pair(gl, mode, part)
            gl.glPopDebugGroup()
    elif way in ("pairs", "list"):
        parts = np.array_split(vertices, len(vertices) // 8)
        if way == "list":
            gl.glNewList(1, gl.GL_COMPILE)
        for part in parts:
            pair(gl, mode, part)
        if way == "list":
            gl.glEndList()
            gl.glCallList(1)
    else:
        if way == "buffers":
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, gl.glGenBuffers(1))
            gl.glBufferData(gl.GL_ARRAY_BUFFER, vertices.nbytes, vertices, gl.GL_STATIC_DRAW)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(4, gl.GL_FLOAT, 0, None if way == "buffers" else vertices)
        if way == "elements":
            indices = random.integers(0, len(vertices), len(vertices)).astype(np.uint32)
            gl.glDrawElements(mode, len(indices), gl.GL_UNSIGNED_INT, indices)
        elif way == "draws":
            for first in range(0, len(vertices), 16):
                gl.glColor3f(*random.random(3).tolist())
                gl.glDrawArrays(mode, first, 16)
        else:
            gl.glDrawArrays(mode, 0, len(vertices))


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("mode", MODES)
def test_slivers_are_culled_by_their_unsnapped_corners_where_one_vertex_is_clipped(mode, way):
    for seed in seeds(mode, way):
        for outside in (1, 24):

            def program(gl, seed=seed, outside=outside):
                state(gl, seed)
                draw(gl, way, getattr(gl, mode), slivers(seed, outside=outside), seed)

            with use_short_cuts(POLICIES[seed % 3]):
                comparison = compare(program, SIZE)
            assert comparison, f"seed {seed}, {outside} outside: {comparison}"


@pytest.mark.parametrize("way", ["begin", "arrays", "elements"])
@pytest.mark.parametrize("mode", MODES)
def test_only_the_segments_with_a_clipped_vertex_cull_so(mode, way):
    for seed in seeds(mode, way):

        def program(gl, seed=seed):
            state(gl, seed)
            draw(gl, way, getattr(gl, mode), slivers(seed, 9000), seed)

        comparison = compare(program, SIZE)
        assert comparison, f"seed {seed}: {comparison}"


@pytest.mark.parametrize("policy", POLICIES[:2])
@pytest.mark.parametrize("writes_color", [False, True])
@pytest.mark.parametrize("way", ["arrays", "elements", "buffers"])
def test_triangles_that_are_used_again_are_culled_anew(way, writes_color, policy):
    for seed in (6, 8, 12, 16):  # in which the picture depends on it

        def program(gl, seed=seed):
            vertices = slivers(seed, 6000)
            gl.glEnable(gl.GL_STENCIL_TEST)
            gl.glColorMask(*[writes_color] * 4)
            for culled in (None, gl.GL_FRONT, gl.GL_BACK, None, gl.GL_BACK, gl.GL_FRONT):
                (gl.glDisable if culled is None else gl.glEnable)(gl.GL_CULL_FACE)
                gl.glCullFace(culled or gl.GL_BACK)
                gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR_WRAP if culled == gl.GL_FRONT else gl.GL_DECR_WRAP)
                draw(gl, way, gl.GL_TRIANGLE_STRIP, vertices, seed)
                gl.glFinish()

        with use_short_cuts(policy):
            comparison = compare(program, SIZE)
        assert comparison, f"seed {seed}: {comparison}"
