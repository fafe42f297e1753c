"""Draws that take the triangles of recent draws leave the bits of draws that set up their own."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow import gl
from softshadow.context import Context
from softshadow.pipeline import use_short_cuts
from softshadow.pipeline.fast import geometry_cache, recent_triangles
from softshadow.pipeline.fast.batch import admission, geometry
from softshadow.pipeline.fast.recent_triangles import RecentTriangles

SIZE = 40
seeds = st.integers(0, 2**32 - 1)


@pytest.fixture(autouse=True)
def hits(monkeypatch):
    """Let small draws be compared, too; return the list of what was found."""
    monkeypatch.setattr(geometry, "least_compared", lambda _: 1)
    monkeypatch.setattr(geometry, "SMALL", 0)
    monkeypatch.setattr(geometry_cache, "FEW_VERTICES", 0)
    monkeypatch.setattr(admission, "LONG_DRAW", 40)
    found, look_up = [], RecentTriangles.look_up

    def noted(self, key):
        content = look_up(self, key)
        if content is not None:
            found.append(content)
        return content

    monkeypatch.setattr(RecentTriangles, "look_up", noted)
    return found


class Frame:
    """Passes over a few meshes: colours under changing lights, and front or back faces in the stencil buffer."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.meshes = [self.mesh(n) for n in (20, 60)]
        self.alphas = [self.rng.random((len(mesh), 4)).astype(np.float32) for mesh in self.meshes]

    def mesh(self, n: int) -> np.ndarray:
        """Return homogeneous positions in and around the frustum, or only inside."""
        mesh = np.ones((n, 4), np.float32)
        mesh[:, :3] = self.rng.uniform(-1, 1, (n, 3)) * self.rng.choice([0.5, 1.6])
        return mesh

    def chance(self, p: float = 0.5) -> bool:
        return bool(self.rng.random() < p)

    def switch(self, cap: int, p: float = 0.5) -> None:
        (gl.glEnable if self.chance(p) else gl.glDisable)(cap)

    def set_state(self) -> None:
        for cap in (gl.GL_CULL_FACE, gl.GL_LIGHTING, gl.GL_LIGHT0, gl.GL_LIGHT1, gl.GL_STENCIL_TEST):
            self.switch(cap)
        for cap in (gl.GL_BLEND, gl.GL_SCISSOR_TEST, gl.GL_POLYGON_OFFSET_FILL, gl.GL_DEPTH_CLAMP):
            self.switch(cap, 0.1)
        self.switch(gl.GL_CLIP_PLANE0, 0.3)
        for cap in (gl.GL_LINE_SMOOTH, gl.GL_POLYGON_STIPPLE):  # with which Mesa cuts quads in another way
            self.switch(cap, 0.1)
        first, last = gl.GL_FIRST_VERTEX_CONVENTION, gl.GL_LAST_VERTEX_CONVENTION
        gl.glProvokingVertex(first if self.chance(0.1) else last)
        gl.glDepthRange(0.25 * self.chance(0.1), 1)
        gl.glCullFace(int(self.rng.choice([gl.GL_FRONT, gl.GL_BACK])))
        gl.glFrontFace(int(self.rng.choice([gl.GL_CW, gl.GL_CCW])))
        gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, int(self.chance(0.2)))
        gl.glShadeModel(gl.GL_FLAT if self.chance(0.2) else gl.GL_SMOOTH)
        gl.glDepthFunc(int(self.rng.choice([gl.GL_LESS, gl.GL_LEQUAL])))
        gl.glStencilOp(gl.GL_KEEP, int(self.rng.choice([gl.GL_KEEP, gl.GL_INCR_WRAP])), gl.GL_INCR)
        gl.glColorMask(*[self.chance(0.6)] * 4)
        gl.glViewport(0, 0, SIZE, SIZE - 4 * int(self.chance(0.1)))
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glLoadIdentity()
        gl.glScalef(1, 1, float(self.rng.choice([1, 0.5, -1], p=[0.8, 0.1, 0.1])))

    def draw_something(self) -> None:
        number = int(self.rng.integers(len(self.meshes)))
        mesh = self.meshes[number]
        if self.chance(0.05):
            mesh[int(self.rng.integers(len(mesh))), :2] *= np.float32(0.5)  # the same memory, other positions
        gl.glVertexPointer(4, gl.GL_FLOAT, 0, mesh)
        gl.glColorPointer(4, gl.GL_FLOAT, 0, self.alphas[number])
        (gl.glEnableClientState if self.chance() else gl.glDisableClientState)(gl.GL_COLOR_ARRAY)
        gl.glNormal3f(*self.rng.uniform(-1, 1, 3).tolist())
        mode = gl.GL_TRIANGLES if self.chance(0.8) else gl.GL_QUADS
        if self.chance(0.8):
            gl.glDrawArrays(mode, 0, len(mesh))
        else:
            gl.glDrawElements(mode, 12, gl.GL_UNSIGNED_INT, np.arange(12, dtype=np.uint32))

    def drawn(self, passes: int = 12) -> Context:
        context = gl.create_context(SIZE, SIZE)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 255)
        gl.glScissor(3, 5, 30, 20)
        gl.glPolygonOffset(1.5, 2)
        gl.glClipPlane(gl.GL_CLIP_PLANE0, (1.0, 0.3, 0.1, 0.4))
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        for _ in range(passes):
            self.set_state()
            for _ in range(int(self.rng.integers(1, 4))):
                self.draw_something()
        gl.glFinish()
        return context


def same_buffers(a: Context, b: Context) -> bool:
    """Return whether colour, depth and stencil of two windows are equal, bit for bit."""
    pairs = zip(a.storage.window.attachments.values(), b.storage.window.attachments.values(), strict=True)
    return all(one.image.view.tobytes() == other.image.view.tobytes() for one, other in pairs)


@given(seeds)
def test_recent_triangles_leave_the_bits_of_new_ones(seed):
    with use_short_cuts(False):
        expected = Frame(seed).drawn()
    assert same_buffers(Frame(seed).drawn(), expected)


def test_many_draws_take_recent_triangles(hits):
    for seed in range(20):
        Frame(seed).drawn()
    kinds = {type(content) for content in hits}
    assert len(hits) > 12
    assert kinds == {tuple, geometry.RunTriangles}  # of single draws without colours, and of runs


CLOSE: dict[str, list[tuple[Any, ...]]] = {  # calls with numbers that are equal in their first six digits
    "depth range": [("glDepthRange", near, 0.9) for near in (0.1, 0.1000004)],
    "polygon offset": [("glPolygonOffset", 0.0, units) for units in (100000.0, 100000.4)],
    "clip plane": [("glClipPlane", gl.GL_CLIP_PLANE0, (1.0, 0.0, 0.0, d)) for d in (0.1015625, 0.10156252)],
}


def counted(mesh: np.ndarray, call: tuple, colors: bool) -> np.ndarray:
    """Draw a mesh where the stencil test passes, after a call, and return the buffers."""
    getattr(gl, call[0])(*call[1:])
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glColorMask(*[colors] * 4)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, mesh)
    gl.glDrawArrays(gl.GL_TRIANGLES, 0, len(mesh))
    depth = gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_DEPTH_COMPONENT, gl.GL_UNSIGNED_INT)
    return np.stack([depth, gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_INT)])


@pytest.mark.parametrize("colors", [False, True])
@pytest.mark.parametrize("close", CLOSE)
def test_numbers_that_are_printed_alike_are_told_apart(close, colors):
    rng = np.random.default_rng(3)
    mesh = rng.uniform(-1, 1, (90, 3)).astype(np.float32)
    mesh[::2, 0] = -CLOSE["clip plane"][1][2][3]  # on one clip plane, and outside of the other

    def drawn() -> list[np.ndarray]:
        with gl.create_context(SIZE, SIZE):
            for capability in (gl.GL_DEPTH_TEST, gl.GL_STENCIL_TEST, gl.GL_POLYGON_OFFSET_FILL, gl.GL_CLIP_PLANE0):
                gl.glEnable(capability)
            gl.glStencilFunc(gl.GL_ALWAYS, 0, 255)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_INCR, gl.GL_INCR)
            gl.glClipPlane(gl.GL_CLIP_PLANE0, (1.0, 0.0, 0.0, 2.0))
            gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
            return [counted(mesh, call, colors) for call in CLOSE[close] for _ in range(3)]

    with use_short_cuts(False):
        expected = drawn()
    assert not np.array_equal(expected[0], expected[-1])
    np.testing.assert_array_equal(drawn(), expected)


def test_draws_of_a_run_are_told_apart_by_the_planes_of_each(hits):
    """Each of two draws is clipped by plane 0, by another one, or by none, in all pairs and each pair twice."""
    mesh = np.random.default_rng(5).uniform(-1, 1, (2, 30, 3)).astype(np.float32)

    def drawn() -> list[bytes]:
        with gl.create_context(SIZE, SIZE):
            gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
            buffers = []
            for pair in [divmod(number, 3) for number in range(9) for _ in range(2)]:
                gl.glClear(gl.GL_COLOR_BUFFER_BIT)
                for rows, kind in zip(mesh, pair, strict=True):
                    (gl.glEnable if kind else gl.glDisable)(gl.GL_CLIP_PLANE0)
                    gl.glClipPlane(gl.GL_CLIP_PLANE0, (1.0, 0.0, 0.0, 0.3 * kind - 0.4))
                    gl.glVertexPointer(3, gl.GL_FLOAT, 0, rows)
                    gl.glDrawArrays(gl.GL_TRIANGLES, 0, len(rows))
                buffers.append(gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_RGB, gl.GL_UNSIGNED_BYTE).tobytes())
            return buffers

    with use_short_cuts(False):
        expected = drawn()
    assert len(set(expected)) == 9
    assert drawn() == expected
    assert hits


def test_only_the_latest_draws_are_remembered():
    recent = RecentTriangles()
    for n in range(3 * recent_triangles.MOST_RECENT):
        recent.add(n, n + 100, [np.zeros(10)], [])
    found = [n for n in range(3 * recent_triangles.MOST_RECENT) if recent.look_up(n) is not None]
    assert found == list(range(2 * recent_triangles.MOST_RECENT, 3 * recent_triangles.MOST_RECENT))


def test_large_draws_are_not_remembered(monkeypatch):
    monkeypatch.setattr(recent_triangles, "MOST_BYTES", 100)
    recent = RecentTriangles()
    recent.add("small", 1, [np.zeros(10)], [])
    recent.add("large", 2, [np.zeros(10), np.zeros(10)], [])
    assert (recent.look_up("small"), recent.look_up("large")) == (1, None)
