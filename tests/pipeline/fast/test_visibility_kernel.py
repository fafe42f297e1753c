"""The kernel of the "map-visibility" programs leaves the bits of the shading stage."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import random_triangles
from softshadow import gl
from softshadow.pipeline import explain_paths, set_threads, threads, use_short_cuts
from softshadow.pipeline.commands import Vertices
from softshadow.techniques.visibility_buffer import set_uniforms

WRAPS = (gl.GL_CLAMP_TO_BORDER, gl.GL_CLAMP_TO_EDGE, gl.GL_REPEAT, gl.GL_MIRRORED_REPEAT, gl.GL_CLAMP)
FORMATS = (gl.GL_DEPTH_COMPONENT16, gl.GL_DEPTH_COMPONENT24, gl.GL_DEPTH_COMPONENT24, gl.GL_DEPTH_COMPONENT32F)


def bind_random_map(rng) -> None:
    """Bind a new depth texture of a random size to the active unit."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    for name in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, gl.GL_NEAREST)
    for name in (gl.GL_TEXTURE_WRAP_S, gl.GL_TEXTURE_WRAP_T):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, int(rng.choice(WRAPS)))
    gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, (rng.random(),) * 4)
    height, width = rng.integers(1, 17, 2).tolist()
    texels = rng.random((height, width)).astype(np.float32)
    depth = (0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, texels)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, int(rng.choice(FORMATS)), width, height, *depth)


def visibilities(seed: int, n_maps: int, size=(48, 40), n_triangles: int = 8, **options) -> np.ndarray:
    """Return a float buffer after triangles that are compared with so many random maps."""
    rng = np.random.default_rng(seed)
    context = gl.create_context(*size, **options)
    gl.glBindTexture(gl.GL_TEXTURE_2D, target := gl.glGenTextures(1))
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA32F, *size, 0, gl.GL_RGBA, gl.GL_FLOAT, None)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, target, 0)
    program = gl.program("map-visibility" if n_maps == 0 else "map-visibility-8")
    gl.glUseProgram(program)
    gl.glMatrixMode(gl.GL_TEXTURE)
    for unit in reversed(range(max(n_maps, 1))):
        gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
        bind_random_map(rng)
        gl.glLoadMatrixf(rng.normal(0, 1, 16).astype(np.float32))
    set_uniforms(gl, program, bias=float(rng.choice([0.0, 0.1])), behind=float(rng.choice([0.0, 1.0])))
    own = {"cone": float(rng.choice([0.2, np.inf])), "side": 16.0} if n_maps == 0 else {"maps": n_maps}
    set_uniforms(gl, program, **own)
    triangles = random_triangles(rng, n_triangles)
    arrays = triangles.position, triangles.color, triangles.normal, rng.normal(0, 1, (len(triangles.position), 4))
    position, color, normal, texcoord = (context.frozen(rows) for rows in arrays)
    context.draw(gl.GL_TRIANGLES, Vertices(position, color, normal, (texcoord,) * 8))
    return np.array(gl.glReadPixels(0, 0, *size, gl.GL_RGBA, gl.GL_FLOAT))


def in_one_kernel(*arguments, **options) -> np.ndarray:
    with use_short_cuts("always"):
        return visibilities(*arguments, **options)


def by_the_stages(*arguments, **options) -> np.ndarray:
    with use_short_cuts(False):
        return visibilities(*arguments, **options)


@given(st.integers(0, 2**32 - 1), st.integers(0, 8), st.sampled_from([1, 2]))
def test_one_kernel_leaves_the_bits_of_the_shading_stage(seed, n_maps, thread_count):
    before = threads()
    try:
        set_threads(thread_count)
        kernel = in_one_kernel(seed, n_maps)
        assert kernel.tobytes() == by_the_stages(seed, n_maps).tobytes()
    finally:
        set_threads(before)


@pytest.mark.parametrize("n_maps", [0, 3])
def test_spans_longer_than_a_block_are_continued(n_maps):
    kernel = in_one_kernel(2, n_maps, (850, 5), 20)
    assert kernel.tobytes() == by_the_stages(2, n_maps, (850, 5), 20).tobytes()
    assert len(np.unique(kernel)) > 1


@pytest.mark.parametrize(("option", "is_used"), [({}, True), ({"precision": "exact"}, False)])
def test_only_float32_is_shaded_in_one_kernel(option, is_used):
    with explain_paths() as paths:
        for n_maps in (0, 2, 8):
            in_one_kernel(5, n_maps, **option)
    assert {path.shading == "map-visibility kernel" for path in paths} == {is_used}


@pytest.mark.interpreted
@pytest.mark.parametrize("n_maps", [0, 2])
def test_the_interpreted_kernel_leaves_the_bits_of_the_shading_stage(n_maps):
    assert in_one_kernel(5, n_maps, (12, 9), 3).tobytes() == by_the_stages(5, n_maps, (12, 9), 3).tobytes()
