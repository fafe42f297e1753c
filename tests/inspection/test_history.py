"""Pixel histories: complete, and in agreement with the buffers and the ledger."""

from collections import Counter
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from draws import draw
from inspection.recorded_frames import ALL_BUFFERS, SIZE, covering, random_frame, set_groups
from softshadow import gl as facade
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.inspection import ledger_of, pixel_history
from softshadow.inspection.replay import copy_window
from softshadow.pipeline.commands import Clear
from softshadow.state import StencilFace

pytestmark = pytest.mark.interpreted

STEP = 2.0**-23  # a 24-bit depth is rounded, and its quotient is again
COUNTED = ("passed", "alpha failed", "stencil failed", "depth failed")


def all_pixels(size=SIZE):
    return [(x, y) for y in range(size[1]) for x in range(size[0])]


@settings(max_examples=20)
@given(st.integers(0, 2**32 - 1), st.sampled_from(["d24", "d32f"]), st.integers(1, 8))
def test_last_row_equals_the_buffers(seed, depth_format, bits):
    context = random_frame(seed, depth_format=depth_format, stencil_bits=bits)
    window = copy_window(context.storage.window).buffers()
    for x, y in all_pixels()[:: 1 + seed % 7]:
        rows = pixel_history(context.frame, x, y).rows
        if rows:
            assert rows[-1].color_after == tuple(window.color[y, x, :3])
            assert (rows[-1].depth_after, rows[-1].stencil_after) == (window.depth[y, x], window.stencil[y, x])
        else:
            assert (window.color[y, x].any(), window.depth[y, x], window.stencil[y, x]) == (False, 1, 0)


@settings(max_examples=10)
@given(st.integers(0, 2**32 - 1))
def test_histories_of_all_pixels_have_the_verdicts_of_the_ledger(seed):
    frame = random_frame(seed).frame
    rows = [row for x, y in all_pixels() for row in pixel_history(frame, x, y)]
    fragments = [row for row in rows if row.triangle is not None]
    verdicts, total = Counter(row.verdict for row in fragments), ledger_of(frame).total
    assert {name: verdicts[name] for name in COUNTED} == {name: total.fragments[name] for name in COUNTED}
    assert sum(row.stencil_before != row.stencil_after for row in fragments) == total.stencil_updates


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=10)
def test_every_row_starts_where_the_one_before_ended(seed):
    frame = random_frame(seed).frame
    for x, y in all_pixels()[::11]:
        rows = pixel_history(frame, x, y).rows
        for before, after in pairwise(rows):
            assert (after.stored_z, after.stencil_before) == (before.depth_after, before.stencil_after)
            assert (after.step, after.draw or 0) >= (before.step, 0)


def counting_context() -> Context:
    """A surface at z = 0.5, and a counter that goes up where the depth test fails."""
    context = Context(*SIZE)
    context.execute(Clear(context.state, ALL_BUFFERS))
    set_groups(context, depth=replace(context.state.depth, enabled=True))
    context.labels.append("surface")
    draw(context, context.state, covering(0.0))
    context.end_step("surface")
    face = StencilFace(zfail=gl.GL_INCR)
    set_groups(context, stencil=replace(context.state.stencil, enabled=True, front=face, back=face))
    context.labels[:] = ["volume"]
    return context


def last_reason(context: Context, x: int = 5, y: int = 5) -> str:
    context.end_step("last")
    return pixel_history(context.frame, x, y)[-1].reason


def test_reason_of_a_failed_depth_test_names_the_operation_that_followed():
    context = counting_context()
    draw(context, context.state, covering(0.25))
    assert last_reason(context) == "depth test LESS: 0.625 < 0.5 is false, so zfail INCR: stencil 0 -> 1"


def test_reason_of_a_failed_stencil_test_has_the_masked_values():
    context = counting_context()
    face = StencilFace(func=gl.GL_EQUAL, ref=3, read_mask=0x0E, sfail=gl.GL_REPLACE, write_mask=0x01)
    set_groups(context, stencil=replace(context.state.stencil, front=face, back=face))
    draw(context, context.state, covering(-0.5))
    expected = "stencil test EQUAL: (3 & 0x0E) == (0 & 0x0E) is false, so sfail REPLACE: stencil 0 -> 1 under mask 0x01"
    assert last_reason(context) == expected


def test_reason_of_a_passed_fragment_says_what_it_wrote():
    context = counting_context()
    set_groups(context, stencil=replace(context.state.stencil, enabled=False))
    draw(context, context.state, covering(-0.5))
    assert last_reason(context) == "depth test LESS: 0.25 < 0.5 is true: colour and depth written"


def test_depths_that_six_digits_do_not_tell_apart_get_more():
    context = counting_context()
    draw(context, context.state, covering(2.0**-22))
    left, right = last_reason(context).split(": ")[1].split(" is ")[0].split(" < ")
    assert float(left) > float(right)


def test_reason_of_a_failed_alpha_test_has_both_alphas():
    context = counting_context()
    set_groups(context, alpha=replace(context.state.alpha, enabled=True, func=gl.GL_GREATER, ref=0.6))
    draw(context, context.state, covering(-0.5, (1, 1, 1, 0.4)))
    assert last_reason(context) == "alpha test GREATER: 0.4 > 0.6 is false: discarded"


def test_alpha_that_is_no_number_is_compared_as_one():
    with facade.create_context(*SIZE) as context:
        facade.glBindTexture(gl.GL_TEXTURE_2D, facade.glGenTextures(1))
        texel = np.array([[[1, 1, 1, np.nan]]], np.float32)
        facade.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA32F, 1, 1, 0, gl.GL_RGBA, gl.GL_FLOAT, texel)
        facade.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        facade.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
        for capability in (gl.GL_TEXTURE_2D, gl.GL_ALPHA_TEST):
            facade.glEnable(capability)
        facade.glAlphaFunc(gl.GL_GREATER, 0.6)
        facade.glRectf(-1, -1, 1, 1)
        context.end_step("last")
    assert pixel_history(context.frame, 5, 5)[-1].verdict == "passed"
    assert copy_window(context.storage.window).buffers().color[5, 5].tolist() == [255, 255, 255, 0]


def test_culled_triangles_and_pixels_outside_the_scissor_box_have_rows():
    context = counting_context()
    set_groups(context, cull=replace(context.state.cull, enabled=True, face=gl.GL_FRONT))
    draw(context, context.state, covering(-0.5))
    set_groups(
        context,
        cull=replace(context.state.cull, enabled=False),
        scissor=replace(context.state.scissor, enabled=True, x=0, y=0, width=2, height=2),
    )
    draw(context, context.state, covering(-0.5))
    context.end_step("last")
    history = pixel_history(context.frame, 5, 5)
    assert [row.verdict for row in history] == ["clear", "passed", "culled", "scissor"]
    assert history[2].reason == "front-facing triangle, and GL_CULL_FACE is on with GL_FRONT: no fragment"
    assert history[3].reason == "outside the scissor box x 0 to 2, GL y 0 to 2"
    assert [row.verdict for row in pixel_history(context.frame, 1, SIZE[1] - 1)][-1] == "passed"


def test_rows_name_step_object_and_triangle():
    context = counting_context()
    context.labels[:] = ["group", "volume"]
    draw(context, context.state, covering(0.25))
    context.end_step("count")
    row = pixel_history(context.frame, 0, 0)[-1]
    assert (row.step, row.title, row.draw, row.object, row.triangle) == (1, "count", 1, "volume", 0)
    assert (row.front_facing, row.z, row.stored_z) == (
        True,
        pytest.approx(0.625, abs=STEP),
        pytest.approx(0.5, abs=STEP),
    )


def test_clears_have_rows_with_what_they_write():
    context = Context(*SIZE)
    set_groups(
        context,
        color=replace(context.state.color, clear=(0.0, 0.5, 1.0, 1.0)),
        stencil=replace(context.state.stencil, clear=7, front=StencilFace(write_mask=0x05)),
    )
    context.execute(Clear(context.state, ALL_BUFFERS))
    (row,) = pixel_history(context.frame, 3, 3)
    assert row.reason == "glClear: colour (0, 0.5, 1, 1), depth 1, stencil 7 under mask 0x05"
    assert (row.verdict, row.stencil_after, row.color_after, row.draw) == ("clear", 5, (0, 128, 255), None)


def test_table_tells_both_conventions_of_y():
    history = pixel_history(counting_context().frame, 2, 3)
    assert str(history).startswith("pixel x=2 y=3 (GL y=8)\n")
    assert len(str(history).splitlines()) == 2 + 2 * len(history)  # the reason stands below its row
    assert history._repr_html_().count("<tr>") == 1 + len(history)


def test_history_of_a_part_tells_only_its_own_pixel():
    context = Context(*SIZE)
    set_groups(context, scissor=replace(context.state.scissor, enabled=True, x=4, y=0, width=1, height=1))
    draw(context, context.state, covering(0.0))
    passed = [p for p in all_pixels() if any(row.verdict == "passed" for row in pixel_history(context.frame, *p))]
    assert passed == [(4, SIZE[1] - 1)]


@pytest.mark.parametrize(("x", "y"), [(-1, 0), (0, SIZE[1]), (SIZE[0], 0), (1.5, 0), (True, 0), ("1", 0)])
def test_pixels_outside_the_window_are_refused(x, y):
    with pytest.raises(ValueError, match="expected a whole number from 0 to"):
        pixel_history(random_frame(0).frame, x, y)


def test_numpy_integers_are_pixels():
    assert pixel_history(random_frame(0).frame, np.int64(1), np.uint8(2)).x == 1
