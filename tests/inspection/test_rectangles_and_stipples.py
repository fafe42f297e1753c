"""Rectangles of depths, stipples and smooth points in recordings: saved, loaded, and told by histories."""

from pathlib import Path

import numpy as np

import softshadow as ss
from softshadow import gl


def recorded() -> ss.Run:
    with gl.record(32, 24) as recording:
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
        gl.glEnable(gl.GL_POLYGON_STIPPLE)
        gl.glPolygonStipple(np.arange(128, dtype=np.uint8))
        gl.glRectf(-1, -1, 0.5, 0.5)
        gl.glEnable(gl.GL_LINE_STIPPLE)
        gl.glLineStipple(2, 0x0F0F)
        gl.glBegin(gl.GL_LINES)
        gl.glVertex2f(-1, -1)
        gl.glVertex2f(1, 1)
        gl.glEnd()
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_ALWAYS)
        gl.glRasterPos2f(0, 0)
        gl.glDrawPixels(4, 4, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, np.full((4, 4), 0.25, np.float32))
        gl.glDrawPixels(4, 4, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE, np.full((4, 4), 7, np.uint8))
        gl.glEnable(gl.GL_POINT_SMOOTH)
        gl.glPointSize(5)
        gl.glBegin(gl.GL_POINTS)
        gl.glVertex2f(-0.5, 0.5)
        gl.glEnd()
    return recording.run


def test_a_saved_run_has_the_same_buffers_and_histories(tmp_path: Path) -> None:
    run = recorded()
    run.save(tmp_path / "run.npz")
    loaded = ss.load_run(tmp_path / "run.npz")
    for name in ("image", "depth", "stencil"):
        assert (getattr(run, name) == getattr(loaded, name)).all()
    for y in range(24):
        for x in range(32):
            assert str(run.pixel(x, y)) == str(loaded.pixel(x, y))


def test_every_last_row_is_the_final_value() -> None:
    run = recorded()
    for y in range(24):
        for x in range(32):
            rows = run.pixel(x, y)
            assert (rows[-1].depth_after, rows[-1].stencil_after) == (run.depth[y, x], run.stencil[y, x])
            assert rows[-1].color_after == tuple(run.image[y, x])[: len(rows[-1].color_after)]


def test_rectangles_are_told_by_their_calls() -> None:
    reasons = [row.reason for row in recorded().pixel(18, 10)]
    assert "glDrawPixels or glCopyPixels of depths" in reasons
    assert "glDrawPixels or glCopyPixels of stencil values" in reasons


def test_histories_have_the_rows_of_a_zoomed_rectangle_in_an_object(tmp_path: Path) -> None:
    with gl.record(8, 8) as recording:
        name = gl.glGenFramebuffers(1)
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, gl.glGenRenderbuffers(1))
        gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_RGBA8, 8, 8)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name)
        gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_RENDERBUFFER, 1)
        gl.glViewport(0, 0, 8, 8)
        gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
        gl.glPixelZoom(1, -0.5)
        gl.glWindowPos2i(3, 3)
        gl.glDrawPixels(1, 3, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, np.full((3, 1, 4), 255, np.uint8))
        gl.glReadPixels(3, 0, 1, 8, gl.GL_RED, gl.GL_UNSIGNED_BYTE, column := np.zeros(8, np.uint8))
    recording.run.save(tmp_path / "run.npz")
    drawn = column > 0
    assert np.flatnonzero(drawn).tolist() == [1, 2], "rows from the bottom"
    for run in (recording.run, ss.load_run(tmp_path / "run.npz")):
        told = [bool(run.pixel(3, 7 - row, framebuffer=name).rows) for row in range(8)]
        assert told == drawn.tolist()
