"""A history agrees with the buffers where a sliver is culled by its unsnapped corners."""

from softshadow import gl
from softshadow.inspection import pixel_history

# by its snapped corners it is a front face, which covers the centre of one pixel
SLIVER = ((-0.5686, 0.0628, 0.9248), (-0.6914, 0.9876, -0.4518), (-0.62999990752, 0.52520001228, 0.1453))
BESIDE = ((1.9919, -0.8428, -0.435), (0.1932, 0.7167, 0.1131), (0.1972, 0.2167, -0.4587))
X, ROW = 56, 52


def history_and_color(triangles, culled=gl.GL_BACK):
    with gl.create_context(300, 200) as context:
        gl.glEnable(gl.GL_CULL_FACE)
        gl.glCullFace(culled)
        gl.glBegin(gl.GL_TRIANGLES)
        for corner in (corner for triangle in triangles for corner in triangle):
            gl.glVertex3f(*corner)
        gl.glEnd()
        color = gl.glReadPixels(X, 199 - ROW, 1, 1, gl.GL_RED, gl.GL_UNSIGNED_BYTE)
        context.end_step("all")
    return pixel_history(context.frame, X, ROW).rows, int(color.ravel()[0])


def test_beside_a_clipped_triangle_it_is_culled_as_the_face_that_its_unsnapped_corners_make():
    (row,), color = history_and_color([SLIVER, BESIDE])
    assert (row.verdict, row.front_facing, color) == ("culled", False, 0)
    assert row.reason == "back-facing triangle, and GL_CULL_FACE is on with GL_BACK: no fragment"


def test_where_nothing_is_clipped_its_snapped_corners_count():
    (row,), color = history_and_color([SLIVER])
    assert (row.verdict, row.front_facing, color) == ("passed", True, 255)


def test_a_face_that_either_way_is_culled_keeps_its_facing():
    (row,), color = history_and_color([SLIVER, BESIDE], gl.GL_FRONT)
    assert (row.verdict, row.front_facing, color) == ("culled", True, 0)
