"""`diff_programs` names the first call after which two programs differ, and its line."""

import pytest

from softshadow.testing import diff_programs

SIZE = (12, 8)


def boxes(gl, color=0.2, detour=False):
    gl.glEnable(gl.GL_SCISSOR_TEST)
    for number in range(3):
        if detour and number == 1:
            gl.glEnable(gl.GL_BLEND)
            gl.glDisable(gl.GL_BLEND)
        gl.glScissor(4 * number, 2, 3, 3)
        gl.glClearColor(color if number == 1 else 1.0, 0.4, 0.6, 1.0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)


def other_color(gl):
    boxes(gl, color=0.8)


def detour(gl):
    boxes(gl, detour=True)


def fewer_boxes(gl):
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glScissor(0, 2, 3, 3)
    gl.glClearColor(1.0, 0.4, 0.6, 1.0)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)


SIDES = [
    ("softshadow", "softshadow"),
    pytest.param(("mesa", "mesa"), marks=pytest.mark.mesa),
    pytest.param(("softshadow", "mesa"), marks=pytest.mark.mesa),
]


@pytest.mark.parametrize("on", SIDES)
def test_the_first_call_with_other_pixels_is_named(on):
    divergence = diff_programs(boxes, other_color, SIZE, on)
    assert divergence.a.number == divergence.b.number == 7
    assert divergence.a.text.startswith("glClear(")
    assert divergence.a.line.startswith("boxes line ")
    (difference,) = divergence.differences
    assert (difference.buffer, difference.count, difference.x, difference.y) == ("color", 9, 4, 2)
    assert (difference.ours[0], difference.theirs[0]) == (51, 204)
    assert "call 7" in str(divergence)


@pytest.mark.parametrize("on", SIDES)
def test_calls_that_only_set_state_may_differ(on):
    assert diff_programs(boxes, detour, SIZE, on) is None


@pytest.mark.parametrize("on", SIDES)
def test_a_program_that_ends_early_is_told(on):
    divergence = diff_programs(boxes, fewer_boxes, SIZE, on)
    assert divergence.b is None
    assert divergence.a.number == 7
    assert "b: draws nothing more" in str(divergence)
    assert [difference.count for difference in divergence.differences] == [9]


@pytest.mark.mesa
def test_a_framebuffer_object_stays_bound_while_the_window_is_looked_at():
    def program(gl):
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        texture = gl.glGenTextures(1)
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 4, 4, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
        gl.glClearColor(1.0, 0.0, 0.0, 1.0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        assert gl.glGetIntegerv(gl.GL_DRAW_FRAMEBUFFER_BINDING) == 1

    assert diff_programs(program, program, SIZE, ("mesa", "mesa")) is None


def test_unknown_sides_name_the_nearest():
    with pytest.raises(ValueError, match="did you mean 'mesa'"):
        diff_programs(boxes, boxes, SIZE, ("messa", "mesa"))
