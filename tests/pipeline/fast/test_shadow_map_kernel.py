"""The program "shadow-map" in one kernel leaves the bits of the shading stage."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import random_triangles, same_window
from softshadow import gl
from softshadow.pipeline import explain_paths, set_threads, threads, use_short_cuts
from softshadow.pipeline.commands import Vertices
from softshadow.pipeline.fast import shadow_map_kernel

WRAPS = (gl.GL_CLAMP_TO_BORDER, gl.GL_CLAMP_TO_EDGE, gl.GL_REPEAT, gl.GL_MIRRORED_REPEAT, gl.GL_CLAMP)


def drawn_under_a_map(seed, size=(48, 40), count=8, **context_options):
    """A window after triangles, some of them small, were drawn under a random map with a random light."""
    rng = np.random.default_rng(seed)
    context = gl.create_context(*size, **context_options)
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    for name in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, gl.GL_NEAREST)
    for name in (gl.GL_TEXTURE_WRAP_S, gl.GL_TEXTURE_WRAP_T):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, int(rng.choice(WRAPS)))
    gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, (rng.random(),) * 4)
    stored = int(rng.choice([gl.GL_DEPTH_COMPONENT16, gl.GL_DEPTH_COMPONENT24, gl.GL_DEPTH_COMPONENT32F, gl.GL_RGBA8]))
    given_as = gl.GL_RGBA if stored == gl.GL_RGBA8 else gl.GL_DEPTH_COMPONENT
    height, width = rng.integers(1, 17, 2).tolist()
    texels = rng.random((height, width, 4) if given_as == gl.GL_RGBA else (height, width)).astype(np.float32)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, stored, width, height, 0, given_as, gl.GL_FLOAT, texels)
    gl.glUseProgram(gl.program("shadow-map"))
    gl.glUniformMatrix4fv(0, 1, gl.GL_FALSE, rng.normal(0, 1, (4, 4)).astype(np.float32))
    program = gl.glGetIntegerv(gl.GL_CURRENT_PROGRAM)
    gl.glUniform4f(gl.glGetUniformLocation(program, "ambient"), *map(float, rng.random(4)))
    gl.glUniform1f(gl.glGetUniformLocation(program, "bias"), float(rng.choice([0.0, 0.1])))
    gl.glColorMask(*(bool(b) for b in rng.random(4) < 0.8))
    gl.glEnable(gl.GL_DEPTH_TEST)
    triangles = random_triangles(rng, count)
    position, color, normal = (context.frozen(rows) for rows in (triangles.position, triangles.color, triangles.normal))
    context.draw(gl.GL_TRIANGLES, Vertices(position, color, normal, ()))
    return context


@given(st.integers(0, 2**32 - 1), st.sampled_from([1, 2]))
def test_one_kernel_leaves_what_the_shading_stage_leaves(seed, thread_count):
    before = threads()
    try:
        set_threads(thread_count)
        window = drawn_under_a_map(seed)
        with use_short_cuts(False):
            assert same_window(window, drawn_under_a_map(seed))
    finally:
        set_threads(before)


def test_spans_longer_than_what_is_shaded_at_a_time_go_on():
    size = (2 * shadow_map_kernel.AT_A_TIME + 50, 5)
    window = drawn_under_a_map(1, size, 20)
    with use_short_cuts(False):
        assert same_window(window, drawn_under_a_map(1, size, 20))
    assert len(np.unique(window.storage.window.color.view.reshape(-1, 4), axis=0)) > 100


@pytest.mark.parametrize(("option", "is_taken"), [({}, True), ({"precision": "exact"}, False)])
def test_only_float32_is_shaded_in_one_kernel(option, is_taken):
    with explain_paths() as paths:
        for seed in range(8):
            drawn_under_a_map(seed, **option)
    shadings = {path.shading for path in paths}
    assert ("shadow-map kernel" in shadings) == is_taken
    assert "program" in shadings  # where the map holds colours, for one


@pytest.mark.interpreted
def test_interpreted_the_kernel_leaves_what_the_shading_stage_leaves():
    window = drawn_under_a_map(5, (12, 9), 3)
    with use_short_cuts(False):
        assert same_window(window, drawn_under_a_map(5, (12, 9), 3))
