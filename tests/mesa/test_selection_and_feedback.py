"""Hit records and feedback values are those of Mesa, for random scenes in immediate mode, arrays and lists."""

from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

SIZE = (48, 32)
KINDS = ("GL_2D", "GL_3D", "GL_3D_COLOR", "GL_3D_COLOR_TEXTURE", "GL_4D_COLOR_TEXTURE")


class Scene:
    """Random primitives under random state, some of them clipped."""

    def __init__(self, seed: int, is_feedback: bool = False) -> None:
        self.rng = rng = np.random.default_rng(seed)
        self.polygon_mode = str(rng.choice(["GL_FILL", "GL_FILL", "GL_LINE", "GL_POINT"]))
        self.lit, self.two_side, self.culled = (bool(rng.random() < p) for p in (0.4, 0.3, 0.3))
        self.offset, self.plane, self.textured = (bool(rng.random() < p) for p in (0.3, 0.3, 0.3))
        self.flat = bool(rng.random() < 0.3)
        # Mesa leaves flat colours of new vertices undefined
        self.reach = 0.9 if is_feedback and self.flat else 1.6
        self.plane = self.plane and self.reach > 1
        self.primitives = [
            (int(rng.integers(0, 10)), int(rng.integers(0, 3)), self._rows(int(rng.integers(1, 8))))
            for _ in range(int(rng.integers(1, 7)))
        ]

    def _rows(self, count: int) -> np.ndarray:
        rows = self.rng.uniform(-1, 1, (count, 12)).astype(np.float32)
        rows[:, :3] *= self.reach
        rows[:, 3:7] = np.abs(rows[:, 3:7])
        return rows

    def set_up(self, gl: Any) -> None:
        gl.glMatrixMode(gl.GL_PROJECTION)
        if self.reach > 1:
            gl.glFrustum(-1, 1, -1, 1, 1, 6)
            gl.glTranslatef(0, 0, -2.5)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glViewport(3, 2, 40, 27)
        gl.glDepthRange(0.1, 0.8)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, getattr(gl, self.polygon_mode))
        gl.glShadeModel(gl.GL_FLAT if self.flat else gl.GL_SMOOTH)
        for name, on in (("LIGHTING", self.lit), ("LIGHT0", True), ("CULL_FACE", self.culled),
                         ("CLIP_PLANE0", self.plane), ("COLOR_MATERIAL", True)):  # fmt: skip
            if on:
                gl.glEnable(getattr(gl, f"GL_{name}"))
        gl.glClipPlane(gl.GL_CLIP_PLANE0, [0.6, 0.3, 0.1, 0.3])
        gl.glLightModeli(gl.GL_LIGHT_MODEL_TWO_SIDE, int(self.two_side))
        if self.offset:
            for name in ("FILL", "LINE", "POINT"):
                gl.glEnable(getattr(gl, f"GL_POLYGON_OFFSET_{name}"))
            gl.glPolygonOffset(1.5, 7)
        if self.textured:
            gl.glEnable(gl.GL_TEXTURE_2D)
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
            texels = np.full((2, 2, 4), 200, np.uint8)
            gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 2, 2, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
            gl.glMatrixMode(gl.GL_TEXTURE)
            gl.glScalef(2, 3, 4)
            gl.glMatrixMode(gl.GL_MODELVIEW)

    def draw(self, gl: Any, number: int) -> None:
        mode, way, rows = self.primitives[number]
        if way == 1:
            gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
            gl.glEnableClientState(gl.GL_COLOR_ARRAY)
            gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.ascontiguousarray(rows[:, :3]))
            gl.glColorPointer(4, gl.GL_FLOAT, 0, np.ascontiguousarray(rows[:, 3:7]))
            gl.glDrawArrays(mode, 0, len(rows))
            gl.glDisableClientState(gl.GL_COLOR_ARRAY)
            gl.glDisableClientState(gl.GL_VERTEX_ARRAY)
            gl.glColor4f(0.5, 0.25, 0.75, 1)
            return
        if way == 2:
            gl.glNewList(1, gl.GL_COMPILE)
        gl.glBegin(mode)
        for row in rows.tolist():
            gl.glColor4f(*row[3:7])
            gl.glNormal3f(*row[9:12])
            gl.glTexCoord2f(*row[7:9])
            gl.glVertex3f(*row[:3])
        gl.glEnd()
        if way == 2:
            gl.glEndList()
            gl.glCallList(1)


def feedback(seed: int) -> Any:
    scene = Scene(seed, is_feedback=True)

    def program(gl: Any) -> dict[str, np.ndarray]:
        scene.set_up(gl)
        values = gl.glFeedbackBuffer(4000, getattr(gl, KINDS[seed % len(KINDS)]))
        gl.glRenderMode(gl.GL_FEEDBACK)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        for number in range(len(scene.primitives)):
            gl.glPassThrough(number + 0.5)
            scene.draw(gl, number)
        gl.glRasterPos3f(0.1, 0.2, 0.3)
        gl.glBitmap(8, 1, 0, 0, 3, 4, bytes([255, 0, 0, 0]))
        gl.glDrawPixels(1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, np.zeros((1, 1, 4), np.uint8))
        gl.glCopyPixels(0, 0, 1, 1, gl.GL_COLOR)
        tokens = gl.glRenderMode(gl.GL_RENDER)
        gl.glBegin(gl.GL_POINTS)
        gl.glVertex2f(0, 0)
        gl.glEnd()
        return {"values": np.array(values, np.float32), "tokens": np.array([token[0] for token in tokens])}

    return program


def selection(seed: int) -> Any:
    scene = Scene(seed)

    def program(gl: Any) -> dict[str, np.ndarray]:
        scene.set_up(gl)
        numbers = gl.glSelectBuffer(400)
        gl.glRenderMode(gl.GL_SELECT)
        gl.glInitNames()
        gl.glPushName(7)
        for number in range(len(scene.primitives)):
            if number % 3 == 1:
                gl.glPushName(number)
            elif number % 3 == 2:
                gl.glLoadName(100 + number)
            else:
                gl.glPopName()
                gl.glPushName(50)
            scene.draw(gl, number)
        gl.glLoadName(9)
        gl.glRasterPos3f(0.1, 0.2, 0.3)
        records = gl.glRenderMode(gl.GL_RENDER)
        near_far = [value for record in records for value in (record.near, record.far, *record.names)]
        return {"numbers": np.array(numbers, np.uint32), "records": np.array(near_far)}

    return program


SEEDS = [*range(10), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(10, 200))]


@pytest.mark.mesa
@pytest.mark.parametrize("seed", SEEDS)
def test_feedback_values_are_those_of_mesa(seed: int) -> None:
    assert (comparison := compare(feedback(seed), SIZE)), comparison


@pytest.mark.mesa
@pytest.mark.parametrize("seed", SEEDS)
def test_hit_records_are_those_of_mesa(seed: int) -> None:
    assert (comparison := compare(selection(seed), SIZE)), comparison
