"""Random sequences of calls with values that GL accepts and nobody expects: huge, negative, infinite, NaN, empty.

A sequence need not be a sensible program: calls may fail, buffers may be missing, rectangles lie anywhere.
"""

import numpy as np

from bounds.wild_images import WildImageWriter
from bounds.wild_values import ASKED, SIDES
from mesa.gl_calls import Call
from softshadow.programs.builtin import BUILTIN

NAMES = [program.name for program in BUILTIN]


class WildProgramWriter(WildImageWriter):
    """Writes also scenes, lists, queries, deletions and questions."""

    def listed(self) -> None:
        number = self.pick([1, 2])
        self.call("glNewList", number, self.pick(["GL_COMPILE", "GL_COMPILE_AND_EXECUTE"]))
        for _ in range(self.pick([0, 1, 3])):
            self.pick([self.state, self.state, self.immediate, self.arrays])()
        self.call("glEndList")
        self.call("glCallList", self.pick([number, 1, 2, 3]))

    def counted(self) -> None:
        self.call("glBeginQuery", "GL_SAMPLES_PASSED", "query 0")
        self.pick([self.immediate, self.arrays, self.clear])()
        self.call("glEndQuery", "GL_SAMPLES_PASSED")
        self.call("glGetQueryObjectuiv", "query 0", "GL_QUERY_RESULT")

    def unprojected(self) -> None:
        call = self.pick(["gluProject", "gluUnProject"])
        matrices = [np.array([self.number() for _ in range(16)]).reshape(4, 4) for _ in range(2)]
        view = np.array([0, 0, *self.pick([(64, 48), (0, 0), (1, 2**31 - 1)])], np.int32)
        self.call(call, *(self.number() for _ in range(3)), *self.pick([(), (*matrices, view)]))

    def rectangles(self) -> None:
        """Images and bitmaps at raster positions anywhere, zoomed to anything."""
        if self.chance(0.5):
            self.call("glPixelZoom", *(self.pick([1.0, -1.0, 0.0, 2.5, 100.0, self.number()]) for _ in range(2)))
        if self.chance(0.7):
            name = self.pick(["glRasterPos4f", "glRasterPos3f", "glWindowPos3f"])
            spread = 150 if name == "glWindowPos3f" else 1.5
            self.call(name, *(self.number(-spread, spread) for _ in range(int(name[-2]))))
        width, height = self.pick(SIDES), self.pick(SIDES)
        way = self.pick(["draw", "draw", "bitmap", "copy"])
        if way == "draw":
            _, pixel_format, kind, pixels = self.image(width, height)
            self.call("glDrawPixels", width, height, pixel_format, kind, pixels)
        elif way == "bitmap":
            bits = self.rng.integers(0, 256, height * (-(-width // 8) + 3) + 3, np.uint8)
            self.call("glBitmap", width, height, *(self.number(-20, 20) for _ in range(4)), bits)
        else:
            corner = (self.integer(-20, 100), self.integer(-20, 100))
            self.call("glCopyPixels", *corner, width, height, "GL_COLOR")

    def shader(self) -> None:
        """A built-in program, whose textures may be anything."""
        self.call("glUseProgram", self.pick([0, *(f"program:{name}" for name in NAMES)]))

    def scene(self) -> None:
        """Draws that likely reach the buffers, with a little unusual state."""
        if self.chance(0.5):
            self.framebuffer() if self.chance(0.8) else self.call("glBindFramebuffer", "GL_FRAMEBUFFER", 0)
        self.sane_view()
        self.pick([self.plain, self.plain, self.counting])()
        for _ in range(self.pick([0, 0, 1, 2])):
            self.pick([self.state, self.state, self.boxes])()
        for _ in range(self.pick([1, 3, 6])):
            self.pick([self.immediate, self.immediate, self.arrays])()
        if self.chance(0.2):
            self.clear()

    def delete(self) -> None:
        """Delete an object that may be bound, attached or in use."""
        kind = self.pick(["Textures", "Textures", "Framebuffers", "Renderbuffers", "Queries", "Buffers"])
        singular = {"Queries": "query"}.get(kind, kind[:-1].lower())
        number = self.pick([0, 0, 1, 3, 4])
        self.call(f"glDelete{kind}", 1, [f"{singular} {number}"])

    def ask(self) -> None:
        """Ask for a value, also as another type than it has."""
        kind = self.pick(["Floatv", "Integerv", "Doublev", "Booleanv"])
        self.call(f"glGet{kind}", self.pick(ASKED))


# how often each is chosen
OFTEN = {
    "state": 14, "immediate": 6, "arrays": 3, "boxes": 1, "sane_view": 2, "scene": 8, "counting": 2, "plain": 2,
    "clear": 1, "texture": 2, "change_texture": 1, "framebuffer": 2, "blit": 1, "read": 1, "odd_arrays": 2,
    "delete": 1, "ask": 1, "listed": 1, "counted": 1, "unprojected": 1,
    "rectangles": 2, "shader": 1,
}  # fmt: skip
ACTIONS = [action for action, often in OFTEN.items() for _ in range(often)]


def wild_program(seed: int) -> tuple[list[Call], tuple[int, int]]:
    """Return the sequence of a seed and the (width, height) of its window; the same ones each time."""
    writer = WildProgramWriter(np.random.default_rng([12, seed]))
    for _ in range(int(writer.rng.integers(3, 25))):
        getattr(writer, writer.pick(ACTIONS))()
    return writer.calls, writer.size
