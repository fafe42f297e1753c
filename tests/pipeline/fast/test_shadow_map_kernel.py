"""The kernel of the program "shadow-map" leaves the bits of the shading stage."""

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


def draw_with_shadow_map(seed, size=(48, 40), n_triangles=8, **context_options):
    """Return a window with triangles shaded by a random shadow map under a random light."""
    rng = np.random.default_rng(seed)
    context = gl.create_context(*size, **context_options)
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    for name in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, gl.GL_NEAREST)
    for name in (gl.GL_TEXTURE_WRAP_S, gl.GL_TEXTURE_WRAP_T):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, int(rng.choice(WRAPS)))
    gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, (rng.random(),) * 4)
    internal_format = int(
        rng.choice([gl.GL_DEPTH_COMPONENT16, gl.GL_DEPTH_COMPONENT24, gl.GL_DEPTH_COMPONENT32F, gl.GL_RGBA8])
    )
    format = gl.GL_RGBA if internal_format == gl.GL_RGBA8 else gl.GL_DEPTH_COMPONENT
    height, width = rng.integers(1, 17, 2).tolist()
    texels = rng.random((height, width, 4) if format == gl.GL_RGBA else (height, width)).astype(np.float32)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal_format, width, height, 0, format, gl.GL_FLOAT, texels)
    gl.glUseProgram(gl.program("shadow-map"))
    gl.glUniformMatrix4fv(0, 1, gl.GL_FALSE, rng.normal(0, 1, (4, 4)).astype(np.float32))
    program = gl.glGetIntegerv(gl.GL_CURRENT_PROGRAM)
    gl.glUniform4f(gl.glGetUniformLocation(program, "ambient"), *map(float, rng.random(4)))
    gl.glUniform1f(gl.glGetUniformLocation(program, "bias"), float(rng.choice([0.0, 0.1])))
    gl.glColorMask(*(bool(b) for b in rng.random(4) < 0.8))
    gl.glEnable(gl.GL_DEPTH_TEST)
    triangles = random_triangles(rng, n_triangles)
    position, color, normal = (context.frozen(rows) for rows in (triangles.position, triangles.color, triangles.normal))
    context.draw(gl.GL_TRIANGLES, Vertices(position, color, normal, ()))
    return context


@given(st.integers(0, 2**32 - 1), st.sampled_from([1, 2]))
def test_one_kernel_leaves_the_bits_of_the_shading_stage(seed, thread_count):
    before = threads()
    try:
        set_threads(thread_count)
        window = draw_with_shadow_map(seed)
        with use_short_cuts(False):
            assert same_window(window, draw_with_shadow_map(seed))
    finally:
        set_threads(before)


def test_spans_longer_than_a_chunk_are_continued():
    size = (2 * shadow_map_kernel.AT_A_TIME + 50, 5)
    window = draw_with_shadow_map(1, size, 20)
    with use_short_cuts(False):
        assert same_window(window, draw_with_shadow_map(1, size, 20))
    assert len(np.unique(window.storage.window.color.view.reshape(-1, 4), axis=0)) > 100


@pytest.mark.parametrize(("option", "is_used"), [({}, True), ({"precision": "exact"}, False)])
def test_only_float32_is_shaded_in_one_kernel(option, is_used):
    with explain_paths() as paths:
        for seed in range(8):
            draw_with_shadow_map(seed, **option)
    shadings = {path.shading for path in paths}
    assert ("shadow-map kernel" in shadings) == is_used
    assert "program" in shadings  # for example where the map holds colours


@pytest.mark.interpreted
def test_the_interpreted_kernel_leaves_the_bits_of_the_shading_stage():
    window = draw_with_shadow_map(5, (12, 9), 3)
    with use_short_cuts(False):
        assert same_window(window, draw_with_shadow_map(5, (12, 9), 3))
