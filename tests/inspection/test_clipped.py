"""Triangles that clipping cuts away have a row at the pixels that they would cover."""

import numpy as np

from softshadow import gl
from softshadow.inspection import pixel_history


def slanted(gl_):
    """A rectangle through the eye's view that begins before the near plane and ends behind the far plane."""
    gl_.glMatrixMode(gl_.GL_PROJECTION)
    gl_.glLoadIdentity()
    gl_.glFrustum(-1, 1, -1, 1, 1, 10)
    gl_.glMatrixMode(gl_.GL_MODELVIEW)
    gl_.glBegin(gl_.GL_TRIANGLES)
    for corner in ((-40, -1, -0.5), (40, -1, -0.5), (0, -1, -40)):
        gl_.glVertex3f(*corner)
    gl_.glEnd()


def rows_at(setup, x, y, size=(16, 16)):
    with gl.create_context(*size) as context:
        setup(gl)
        context.end_step("all")
    return pixel_history(context.frame, x, y).rows


def test_near_and_far_plane_cut_a_triangle_away():
    # in row r from the top the floor y = -1 is seen at the distance 1 / |y|, y being -1 to 1 from the bottom
    far, seen = rows_at(slanted, 8, 8), rows_at(slanted, 8, 12)
    assert [(row.verdict, row.triangle) for row in far] == [("clipped", 0)]
    assert "beyond the far plane" in far[0].reason
    assert [row.verdict for row in seen] == ["passed"]
    assert rows_at(slanted, 8, 3) == ()  # the triangle is behind the eye there

    def nearer(gl_):
        slanted(gl_)
        gl_.glClear(gl_.GL_COLOR_BUFFER_BIT)
        gl_.glTranslatef(0, 0.5, 0)  # y = -0.5: at the bottom the distance is 0.5
        gl_.glBegin(gl_.GL_TRIANGLES)
        for corner in ((-40, -1, -0.25), (40, -1, -0.25), (0, -1, -40)):
            gl_.glVertex3f(*corner)
        gl_.glEnd()

    last = rows_at(nearer, 8, 15)[-1]
    assert (last.verdict, last.reason) == ("clipped", "cut away by clipping: here it lies in front of the near plane")


def test_user_clip_planes_cut_triangles_away():
    def half(gl_):
        gl_.glEnable(gl_.GL_CLIP_PLANE0)
        gl_.glClipPlane(gl_.GL_CLIP_PLANE0, (1.0, 0.0, 0.0, 0.0))
        gl_.glRectf(-1, -1, 1, 1)

    assert [row.verdict for row in rows_at(half, 12, 5)] == ["passed"]
    left = rows_at(half, 3, 5)
    assert [row.verdict for row in left] == ["clipped"]
    assert "clip plane 0" in left[0].reason


def test_depth_clamp_clips_neither_near_nor_far():
    def clamped(gl_):
        gl_.glEnable(gl_.GL_DEPTH_CLAMP)
        gl_.glBegin(gl_.GL_QUADS)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            gl_.glVertex3f(x, y, 3.0)
        gl_.glEnd()

    assert [row.verdict for row in rows_at(clamped, 5, 5)] == ["passed"]


def test_clipped_rows_do_not_change_the_pixel():
    row = rows_at(slanted, 8, 8)[0]
    assert (row.z, row.stored_z, row.depth_after) == (None, 1.0, 1.0)
    assert row.color_before == row.color_after == (0, 0, 0)
    assert np.isfinite(row.stencil_after)
