"""The state and the draws of wild sequences."""

from collections.abc import Callable
from typing import Any

import numpy as np

from bounds.wild_values import ARRAYS, CHOICES, INTEGERS, MODES, NUMBERS, PLANES, SIGNATURES, WINDOWS
from mesa.gl_calls import Call


class WildWriter:
    """Writes the calls of one sequence; `wildness` is the part of the numbers that are not ordinary."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng = rng
        self.calls: list[Call] = []
        self.size: tuple[int, int] = self.pick(WINDOWS)
        self.wildness: float = self.pick([0.0, 0.01, 0.05, 0.1, 0.4])

    def call(self, name: str, *arguments: Any) -> None:
        self.calls.append((name, arguments))

    def pick(self, choices: Any) -> Any:
        return choices[int(self.rng.integers(len(choices)))]

    def chance(self, probability: float) -> bool:
        return bool(self.rng.random() < probability)

    def number(self, low: float = -2.0, high: float = 2.0) -> float:
        return self.pick(NUMBERS) if self.chance(self.wildness) else round(float(self.rng.uniform(low, high)), 3)

    def integer(self, low: int, high: int) -> int:
        return self.pick(INTEGERS) if self.chance(self.wildness) else int(self.rng.integers(low, high + 1))

    def box(self) -> list[int]:
        """Return a rectangle about the window: x, y, width, height."""
        width, height = self.size
        corner = [self.integer(-20, width), self.integer(-20, height)]
        return [*corner, self.integer(0, 2 * width), self.integer(0, 2 * height)]

    def argument(self, kind: str) -> Any:
        if kind in CHOICES:
            return self.pick(CHOICES[kind])
        if len(kind) > 1:
            return [self.argument(kind[0]) for _ in range(int(kind[1:]))]
        makers: dict[str, Callable[[], Any]] = {
            "f": self.number,
            "c": lambda: self.number(0, 1),
            "i": lambda: self.integer(-3, 300),
            "w": lambda: self.number(0, 12),
            "?": lambda: self.chance(0.6),
        }
        return makers[kind]()

    # -- state ---------------------------------------------------------------------------------------------------------
    def state(self) -> None:
        name, kinds = self.pick(SIGNATURES)
        self.call(name, *map(self.argument, kinds))

    def boxes(self) -> None:
        self.call(self.pick(["glViewport", "glScissor"]), *self.box())

    def sane_view(self) -> None:
        """Matrices and viewport that show something again."""
        for mode in ("GL_PROJECTION", "GL_MODELVIEW"):
            self.call("glMatrixMode", mode)
            self.call("glLoadIdentity")
        self.call("glViewport", 0, 0, *self.pick([self.size, (32, 32), (100, 60)]))
        if self.chance(0.5):
            self.call("gluPerspective", 60.0, 1.3, 0.1, self.pick([10.0, 1e6]))
            self.call("glTranslatef", 0.0, 0.0, -2.0)
        for capability in ("GL_SCISSOR_TEST", "GL_CULL_FACE", "GL_COLOR_LOGIC_OP", "GL_CLIP_PLANE0", "GL_CLIP_PLANE2"):
            if self.chance(0.7):
                self.call("glDisable", capability)

    def counting(self) -> None:
        """The state of shadow volumes: only the stencil buffer changes."""
        self.call("glEnable", "GL_STENCIL_TEST")
        self.call("glEnable", "GL_DEPTH_TEST")
        self.call("glDepthMask", False)
        self.call("glColorMask", False, False, False, False)
        self.call("glStencilFunc", "GL_ALWAYS", 0, 255)
        self.call("glStencilMask", 255)
        self.call("glStencilOpSeparate", "GL_FRONT", "GL_KEEP", "GL_KEEP", "GL_INCR_WRAP")
        self.call("glStencilOpSeparate", "GL_BACK", "GL_KEEP", "GL_DECR_WRAP", "GL_DECR_WRAP")

    def plain(self) -> None:
        """The state of most draws: nothing but a depth test."""
        for capability in ("GL_STENCIL_TEST", "GL_ALPHA_TEST", "GL_BLEND", "GL_COLOR_LOGIC_OP"):
            self.call("glDisable", capability)
        self.call("glEnable", "GL_DEPTH_TEST")
        self.call("glDepthFunc", "GL_LESS")
        self.call("glDepthMask", True)
        self.call("glColorMask", True, True, True, True)

    # -- drawing -------------------------------------------------------------------------------------------------------
    def vertices(self, count: int, size: int = 4) -> np.ndarray:
        spread = self.pick([0.05, 0.3, 1.0, 3.0, 100.0])
        places = self.rng.uniform(-spread, spread, (count, 4)) + self.rng.uniform(-1, 1, 4)
        if self.chance(0.7):
            places[:, 3] = 1
        wild = self.rng.random((count, 4)) < self.wildness * 0.3
        places[wild] = self.rng.choice(NUMBERS, int(wild.sum()))
        return places[:, :size]

    def immediate(self) -> None:
        self.call("glBegin", self.pick(MODES))
        for vertex in self.vertices(self.pick([0, 1, 2, 3, 4, 6, 9, 24])).round(4).tolist():
            if self.chance(0.3):
                self.call("glColor4f", *(self.number(0, 1) for _ in range(4)))
            if self.chance(0.3):
                self.call("glTexCoord4f", *(self.number() for _ in range(3)), self.pick([1.0, self.number()]))
            if self.chance(0.2):
                self.call("glNormal3f", *(self.number() for _ in range(3)))
            self.call("glVertex4f", *vertex)
        self.call("glEnd")

    def arrays(self) -> None:
        count = self.pick([0, 1, 3, 4, 12, 40])
        for array in ["GL_VERTEX_ARRAY", *ARRAYS]:
            if array != "GL_VERTEX_ARRAY" and self.chance(0.7):
                continue
            call, sizes = ARRAYS[array]
            size = self.pick(sizes) if sizes else 3
            self.call("glEnableClientState", array)
            values = self.vertices(count, size).astype(np.float32)
            self.call(call, *((size,) if sizes else ()), "GL_FLOAT", 0, values)
        mode = self.pick(MODES)
        if self.chance(0.5):
            first = int(self.rng.integers(0, count + 1))
            self.call("glDrawArrays", mode, first, self.pick([0, count - first, count - first]))
        else:
            n = self.pick([0, 3, 12]) if count else 0
            indices = self.rng.integers(0, max(count, 1), n, dtype=np.uint32)
            self.call("glDrawElements", mode, n, "GL_UNSIGNED_INT", indices)
        for array in ARRAYS:
            if self.chance(0.9):
                self.call("glDisableClientState", array)

    def odd_arrays(self) -> None:
        """Arrays of any type and stride, in client memory or in a buffer object, perhaps too short or empty."""
        count, stride = self.pick([0, 1, 3, 12]), self.pick([0, 0, 16, 40])
        if self.chance(0.4):
            self.call("glBindBuffer", "GL_ARRAY_BUFFER", "buffer 0")
            self.call(
                "glBufferData", "GL_ARRAY_BUFFER", self.rng.integers(0, 256, count * 40, np.uint8), "GL_STATIC_DRAW"
            )
            pointers: list[Any] = [None, 0, 4, 400]
        else:
            kind = self.pick([np.float32, np.int16, np.float64])
            pointers = [self.vertices(count).astype(np.float32).astype(kind) if self.chance(0.9) else []]
        with_color = self.chance(0.5)
        for array in ("GL_VERTEX_ARRAY", "GL_COLOR_ARRAY")[: 1 + with_color]:
            self.call("glEnableClientState", array)
            kind = self.pick(["GL_FLOAT", "GL_SHORT", "GL_DOUBLE", "GL_INT"])
            self.call(ARRAYS[array][0], self.pick(ARRAYS[array][1]), kind, stride, self.pick(pointers))
        self.call("glBindBuffer", "GL_ARRAY_BUFFER", 0)
        mode = self.pick(MODES)
        first, n = self.pick([0, 0, 1]), self.pick([0, 1, count])
        self.pick([
            lambda: self.call("glDrawArrays", mode, first, n),
            lambda: self.call("glMultiDrawArrays", mode, [0, first], [n, 0], 2),
            lambda: self.call("glDrawElements", mode, n, "GL_UNSIGNED_BYTE", np.arange(n, dtype=np.uint8)),
            lambda: self.call("glDrawRangeElements", mode, 0, n, n, "GL_UNSIGNED_SHORT", np.arange(n, dtype=np.uint16)),
        ])()  # fmt: skip
        for array in ("GL_VERTEX_ARRAY", "GL_COLOR_ARRAY"):
            self.call("glDisableClientState", array)

    def clear(self) -> None:
        self.call("glClear", " | ".join(plane for plane in PLANES if self.chance(0.6)) or PLANES[0])
