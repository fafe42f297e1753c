"""A slide and its program stand side by side, line by line, with the lines of a step marked."""

import pytest

from softshadow import listings
from softshadow.lessons import code_beside_slide, run_listing


@pytest.mark.thin(2)
@pytest.mark.parametrize("name", listings.names())
def test_every_step_of_every_listing_marks_lines(name: str) -> None:
    for step, title in enumerate(code_beside_slide(name).titles):
        shown = code_beside_slide(name, step)
        assert title in str(shown)
        assert any(step in row.steps for _, rows in shown.functions for row in rows)
        assert 'class="now' in shown._repr_html_()


def test_lines_that_a_correction_adds_have_nothing_at_the_left() -> None:
    rows = [row for _, rows in code_beside_slide("volume-zpass", 1).functions for row in rows]
    (added,) = [row for row in rows if "glEnable(GL_CULL_FACE)" in row.running]
    assert added.printed == ""
    assert added.steps == (1,)
    same = [row for row in rows if row.printed == row.running]
    assert any("glStencilOp(GL_KEEP, GL_KEEP, GL_INCR)" in row.running for row in same)


def test_a_step_that_does_not_exist_is_refused() -> None:
    with pytest.raises(ValueError, match="step=9: expected 0 to 1"):
        code_beside_slide("stencil-quads", 9)


def test_a_listing_runs_as_printed_and_as_corrected() -> None:
    printed, corrected = (run_listing("volume-zpass", as_printed, (48, 36)) for as_printed in (True, False))
    assert printed.stencil.max() == 0  # E1
    assert corrected.stencil.max() > 0
