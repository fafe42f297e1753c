"""Lines: one pixel per step along the major direction, ends by the diamond exit rule."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow import gl
from softshadow.pipeline.geometry.clip import outcodes
from softshadow.pipeline.geometry.lines import assemble_lines, clip_lines, set_up_lines
from softshadow.pipeline.raster.ordered import list_fragments
from softshadow.pipeline.records import Region

pytestmark = pytest.mark.interpreted

SIZE = 24
NO_PLANES = np.empty((0, 4), np.float32)
ends = st.tuples(*[st.integers(4, 4 * SIZE - 4).map(lambda quarter: quarter / 4)] * 2)


def coverage(positions: list[tuple[float, float]], width: float = 1, strip: bool = False) -> np.ndarray:
    """Return how many of the lines between positions cover each pixel, (SIZE, SIZE), row 0 on top."""
    window = np.ones((len(positions), 4), np.float32)
    window[:, :2] = positions
    lines = assemble_lines(gl.GL_LINE_STRIP if strip else gl.GL_LINES, len(positions))
    with np.errstate(all="ignore"):  # as in pipeline.draw: a line without length
        setup = set_up_lines(
            window, lines, np.arange(len(lines), dtype=np.int32), np.full(len(lines), width, np.float64)
        )
    fragments = list_fragments(setup, Region(0, SIZE, 0, SIZE, 1))
    counts = np.zeros((SIZE, SIZE), int)
    np.add.at(counts, (fragments.row, fragments.column), 1)
    return counts


@given(ends, ends, st.integers(1, 5))
def test_a_line_has_its_width_in_pixels_across_its_major_direction(start, end, width):
    extent = abs(end[0] - start[0]), abs(end[1] - start[1])
    counts = np.pad(coverage([start, end], width), 0)
    steps = counts.sum(axis=0 if extent[0] >= extent[1] else 1)
    inside = all(width < coordinate < SIZE - width for coordinate in (*start, *end))
    assert counts.max(initial=0) <= 1
    # at either end, less than a step may lie outside the diamonds of the pixels there
    assert max(extent) - 2 < np.count_nonzero(steps) <= max(extent) + 1
    assert not inside or set(steps) <= {0, width}


@given(st.lists(ends, min_size=3, max_size=3), st.booleans())
def test_the_shared_end_of_two_lines_in_one_direction_is_covered_once(positions, along_x):
    positions = sorted(positions) if along_x else sorted(positions, key=lambda place: place[1])
    first, second = (abs(np.subtract(b, a)) for a, b in pairwise(positions))
    if all(step[0] > step[1] if along_x else step[1] > step[0] for step in (first, second)):
        counts = coverage(positions, strip=True)
        assert counts.sum(axis=0 if along_x else 1).max(initial=0) <= 1


def test_a_line_between_pixel_centers_has_its_first_pixel_and_not_its_last():
    for end in ((12.5, 5.5), (5.5, 12.5), (19.5, 12.5), (12.5, 19.5), (16.5, 19.5), (8.5, 5.5)):
        counts = coverage([(12.5, 12.5), end])
        assert counts[12, 12] == 1
        assert counts[int(end[1]), int(end[0])] == 0
        assert counts.sum() == max(abs(end[0] - 12.5), abs(end[1] - 12.5))


def test_a_line_without_length_covers_nothing():
    assert coverage([(5.5, 5.5), (5.5, 5.5)]).sum() == 0


@pytest.mark.parametrize(("mode", "n_lines"), [(gl.GL_LINES, 2), (gl.GL_LINE_STRIP, 4), (gl.GL_LINE_LOOP, 5)])
def test_lines_are_assembled_in_the_order_of_gl(mode, n_lines):
    assembled = assemble_lines(mode, 5)
    assert len(assembled) == n_lines
    assert assembled[0].tolist() == [0, 1]
    assert assembled[-1].tolist() == {gl.GL_LINES: [2, 3], gl.GL_LINE_STRIP: [3, 4], gl.GL_LINE_LOOP: [4, 0]}[mode]
    assert assemble_lines(mode, 1).shape == assemble_lines(mode, 0).shape == (0, 2)


@given(st.lists(st.floats(-3, 3, width=32), min_size=8, max_size=8))
def test_a_clipped_line_is_inside_the_frustum_and_on_the_line(numbers):
    clip = np.array(numbers, np.float32).reshape(2, 4)
    clip[:, 3] = np.abs(clip[:, 3]) + 0.5
    codes = outcodes(clip, False, NO_PLANES)
    along = np.float32([[0], [1]])
    clipped = clip_lines(clip, along, np.array([[0, 1]], np.int32), codes, NO_PLANES)
    for vertex in clipped.triangles.ravel():
        x, y, z, w = clipped.clip[vertex]
        assert max(abs(x), abs(y), abs(z)) <= w + 1e-5  # a few roundings of numbers up to 3
        assert clipped.clip[vertex] == pytest.approx(
            clip[0] + clipped.values[vertex, 0] * (clip[1] - clip[0]), abs=1e-5
        )


def test_colors_change_along_a_line_with_perspective():
    with gl.create_context(64, 4):
        gl.glBegin(gl.GL_LINES)
        gl.glColor3f(0, 0, 0)
        gl.glVertex4f(-1, 0.25, 0, 1)
        gl.glColor3f(1, 0, 0)
        gl.glVertex4f(3, 0.75, 0, 3)
        gl.glEnd()
        red = gl.glReadPixels(0, 2, 64, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)[0, :, 0].astype(int)
    t = (np.arange(64) + 0.5) / 64
    assert np.abs(red - 255 * (t / 3) / (1 - t + t / 3)).max() <= 1  # rounded once


def test_the_last_vertex_of_a_line_gives_flat_colors():
    with gl.create_context(8, 8):
        gl.glShadeModel(gl.GL_FLAT)
        gl.glBegin(gl.GL_LINE_STRIP)
        for x, color in ((-3, (1, 0, 0)), (0, (0, 1, 0)), (3, (0, 0, 1))):
            gl.glColor3f(*color)
            gl.glVertex2f(x, 0.1)
        gl.glEnd()
        row = gl.glReadPixels(0, 4, 8, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)[0, :, :3]
    assert row.tolist() == [[0, 255, 0]] * 4 + [[0, 0, 255]] * 4
