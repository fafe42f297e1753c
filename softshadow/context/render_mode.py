"""Where draws go: into the framebuffer, or into the buffers of glSelectBuffer and glFeedbackBuffer; and on condition.

References: GL 2.1, sec. 5.2 (selection) and 5.3 (feedback); feedback.c of Mesa 22.3.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from softshadow import tokens as gl

MOST_NAMES = 64
DEPTH_SCALE = np.float32(0xFFFFFFFF)
NEAREST, FARTHEST = np.float32(1.0), np.float32(-1.0)  # before anything is hit


@dataclass
class Selection:
    """The hit records of GL_SELECT: the name stack, and the depths hit since it was last changed."""

    buffer: np.ndarray | None = None
    size: int = 0
    count: int = 0  # numbers written, also those for which there was no room
    hits: int = 0
    names: list[int] = field(default_factory=list)
    nearest: np.float32 = NEAREST
    farthest: np.float32 = FARTHEST
    is_hit: bool = False

    def hit(self, depths: np.ndarray) -> None:
        """Note vertices at window depths, float32."""
        if not len(depths):
            return
        self.is_hit = True
        known = depths[~np.isnan(depths)]
        if len(known):
            self.nearest = min(self.nearest, np.float32(known.min()))
            self.farthest = max(self.farthest, np.float32(known.max()))

    def end_record(self) -> None:
        """Write the hit record of the current names, if something was hit."""
        if not self.is_hit:
            return
        depths = [int(DEPTH_SCALE * depth) & 0xFFFFFFFF for depth in (self.nearest, self.farthest)]
        for number in (len(self.names), *depths, *self.names):
            if self.buffer is not None and self.count < self.size:
                self.buffer[self.count] = number
            self.count += 1
        self.hits += 1
        self.forget_hits()

    def forget_hits(self) -> None:
        """Begin a new record."""
        self.is_hit, self.nearest, self.farthest = False, NEAREST, FARTHEST


@dataclass
class Feedback:
    """The values of GL_FEEDBACK; `kind` is GL_2D ... GL_4D_COLOR_TEXTURE."""

    buffer: np.ndarray | None = None
    size: int = 0
    kind: int = gl.GL_2D
    count: int = 0  # values written, also those for which there was no room
    resets_line: bool = False  # the next line begins a stipple pattern

    def write(self, *values: float) -> None:
        """Write values while there is room."""
        for value in values:
            if self.buffer is not None and self.count < self.size:
                self.buffer[self.count] = value
            self.count += 1

    def write_vertex(self, window: np.ndarray, color: np.ndarray, texcoord: np.ndarray) -> None:
        """Write a vertex: window x, y, z and clip w (4,), colour (4,) and texture coordinates (4,), as `kind` says."""
        n_coordinates = {gl.GL_2D: 2, gl.GL_4D_COLOR_TEXTURE: 4}.get(self.kind, 3)
        self.write(*window[:n_coordinates].tolist())
        if self.kind not in (gl.GL_2D, gl.GL_3D):
            self.write(*color.tolist())
        if self.kind in (gl.GL_3D_COLOR_TEXTURE, gl.GL_4D_COLOR_TEXTURE):
            self.write(*texcoord.tolist())


@dataclass
class RenderMode:
    """What becomes of draws: `mode` is GL_RENDER, GL_SELECT or GL_FEEDBACK.

    `condition` is the query of glBeginConditionalRender, and whether draws are carried out if nothing passed.
    """

    mode: int = gl.GL_RENDER
    selection: Selection = field(default_factory=Selection)
    feedback: Feedback = field(default_factory=Feedback)
    condition: tuple[int, bool] | None = None
    has_gate: bool = False  # whether the context asks for these before each command
