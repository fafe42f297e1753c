"""Framebuffers and the storage of a context: everything that a command can change.

The default framebuffer is rasterised and stored top row first, framebuffer objects bottom row first, as llvmpipe does
(the last bits of an interpolated depth depend on it).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.errors import StateError
from softshadow.image import D24, D32F, EXACT_DEPTH, FORMATS, STENCIL8, Format, Image
from softshadow.texture import Texture

DEFAULT = 0
DEPTH_FORMATS = {"d24": D24, "d32f": D32F}
DRAW_BUFFERS = 8
LARGEST_SIDE = 16384  # Mesa's own limit; 8 sub-pixel bits keep integer coverage exact far beyond


NOTHING = Format(gl.GL_NONE, "none", np.uint8, 1)  # of an attached level or renderbuffer that has no image yet


def plane_for(image: Image, attachment: int) -> Image:
    """Return the plane of an image that serves an attachment point: of packed depth-stencil images, the stencil."""
    if attachment == gl.GL_STENCIL_ATTACHMENT and image.stencil is not None:
        return image.stencil
    return image


@dataclass(frozen=True)
class Attachment:
    """A level of a texture (or a renderbuffer's image) that stands as a buffer of a framebuffer object."""

    image: Image
    texture: int = 0
    face: int = 0
    level: int = 0
    renderbuffer: int = 0


@dataclass(eq=False)
class Framebuffer:
    """The buffers that a draw writes. A missing buffer is None: its test passes and nothing is written.

    `draw_buffers` are the names of glDrawBuffers, up to `DRAW_BUFFERS` of them; what it does not name is GL_NONE.
    `flipped` says that row 0 is the top row (the default framebuffer), `clamps` that glGet answers colours clamped to
    [0, 1]: Mesa finds out whether an object has buffers of floats when it first asks whether it is complete.
    """

    name: int
    attachments: dict[int, Attachment] = field(default_factory=dict)
    flipped: bool = False
    clamps: bool = False
    draw_buffers: tuple[int, ...] = (gl.GL_COLOR_ATTACHMENT0,)
    read_buffer: int = gl.GL_COLOR_ATTACHMENT0
    accumulation: np.ndarray | None = None

    def image(self, attachment: int) -> Image | None:
        found = self.attachments.get(attachment)
        return found.image if found else None

    @property
    def color(self) -> Image | None:
        """The image of the first draw buffer, or None (GL_NONE, or nothing attached)."""
        return self._color_buffer(self.draw_buffer_at(0))

    @property
    def colors(self) -> tuple[Image, ...]:
        """The images that colours are written to: one per draw buffer that has an image."""
        images = (self._color_buffer(choice) for choice in self.draw_buffers)
        return tuple(image for image in images if image is not None)

    def draw_buffer_at(self, index: int) -> int:
        """Return the name of a draw buffer, counted from 0."""
        return self.draw_buffers[index] if index < len(self.draw_buffers) else gl.GL_NONE

    @property
    def first_color(self) -> Image | None:
        """The first colour attachment, whichever is written, or None."""
        points = [
            point for point in self.attachments if point in range(gl.GL_COLOR_ATTACHMENT0, gl.GL_DEPTH_ATTACHMENT)
        ]
        return self.image(min(points)) if points else None

    @property
    def read_color(self) -> Image | None:
        """The image that colours are read from, or None."""
        return self._color_buffer(self.read_buffer)

    def _color_buffer(self, choice: int) -> Image | None:
        # the window has one colour buffer, whatever it is called (GL_BACK, GL_FRONT, GL_LEFT ...)
        named = gl.GL_COLOR_ATTACHMENT0 if self.name == DEFAULT and choice != gl.GL_NONE else choice
        return self.image(named)

    @property
    def depth(self) -> Image | None:
        return self.image(gl.GL_DEPTH_ATTACHMENT)

    @property
    def stencil(self) -> Image | None:
        return self.image(gl.GL_STENCIL_ATTACHMENT)

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) of the smallest attachment, (0, 0) without any."""
        images = [a.image for a in self.attachments.values()]
        return (min(i.width for i in images), min(i.height for i in images)) if images else (0, 0)


def default_framebuffer(
    width: int, height: int, depth_format: str = "d24", stencil_bits: int = 8, precision: str = "mesa"
) -> Framebuffer:
    """Return the window: RGBA8 cleared to 0, depth cleared to 1, stencil cleared to 0.

    Raises
    ------
    ValueError
        A size, depth format, number of stencil bits (1-8) or precision that does not exist; sizes are 1 to 16384.
    """
    for name, value in (("width", width), ("height", height)):
        if not isinstance(value, int | np.integer) or not 1 <= value <= LARGEST_SIDE:
            raise ValueError(f"{name}={value!r}: expected a whole number of pixels from 1 to {LARGEST_SIDE}")
    if depth_format not in DEPTH_FORMATS:
        raise ValueError(f"depth_format={depth_format!r}: expected 'd24' or 'd32f'")
    if stencil_bits not in range(1, 9):
        raise ValueError(f"stencil_bits={stencil_bits!r}: expected 1 to 8")
    if precision not in ("mesa", "exact"):
        raise ValueError(f"precision={precision!r}: expected 'mesa' or 'exact'")
    depth_cells = EXACT_DEPTH if precision == "exact" else DEPTH_FORMATS[depth_format]
    stencil_cells = Format(gl.GL_STENCIL_INDEX, "stencil", np.uint8, 1, (1 << stencil_bits) - 1)
    try:
        color = Image.new(FORMATS[gl.GL_RGBA8], int(width), int(height), gl.GL_RGBA8)
        depth = Image.new(depth_cells, int(width), int(height), gl.GL_DEPTH_COMPONENT24)
        stencil = Image.new(stencil_cells, int(width), int(height), gl.GL_STENCIL_INDEX8)
    except MemoryError:
        raise StateError(f"a {width} x {height} framebuffer does not fit in memory") from None
    depth.cells[:] = depth_cells.largest or 1.0
    return Framebuffer(
        DEFAULT,
        {
            gl.GL_COLOR_ATTACHMENT0: Attachment(color),
            gl.GL_DEPTH_ATTACHMENT: Attachment(depth),
            gl.GL_STENCIL_ATTACHMENT: Attachment(stencil),
        },
        flipped=True,
        clamps=True,
        draw_buffers=(gl.GL_FRONT,),
        read_buffer=gl.GL_FRONT,
    )


@dataclass(eq=False)
class Storage:
    """The objects of one context by name: framebuffers (0 is the window), textures, renderbuffers and query results.

    `visibility_cache` speeds up draws that repeat earlier ones (`softshadow.pipeline.fast.visibility_cache`); it
    changes no result.
    """

    framebuffers: dict[int, Framebuffer]
    textures: dict[int, Texture] = field(default_factory=dict)
    renderbuffers: dict[int, Image] = field(default_factory=dict)
    queries: dict[int, int] = field(default_factory=dict)
    active_query: int = 0
    visibility_cache: Any = None

    @property
    def window(self) -> Framebuffer:
        return self.framebuffers[DEFAULT]

    def settle(self) -> None:
        """Write what is still to be written to buffers (`Image.write_later`)."""
        for target in self.framebuffers.values():
            for attachment in target.attachments.values():
                attachment.image.settle()

    def reattach(self, texture: int, face: int, level: int, image: Image) -> None:
        """Let framebuffer objects follow a level of a texture to its new image."""
        for target in self.framebuffers.values():
            for point, attachment in target.attachments.items():
                if (attachment.texture, attachment.face, attachment.level) == (texture, face, level) and texture:
                    target.attachments[point] = replace(attachment, image=plane_for(image, point))


__all__ = ["DEFAULT", "STENCIL8", "Attachment", "Framebuffer", "Storage", "default_framebuffer"]
