"""Framebuffers and the storage of a context: everything that a command can change.

As in llvmpipe, the default framebuffer is rasterised and stored top row first, framebuffer objects bottom row first.
The last bits of an interpolated depth depend on this order.
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
LARGEST_SIDE = 16384  # Mesa's limit; with 8 sub-pixel bits, integer coverage is exact far beyond it


NOTHING = Format(gl.GL_NONE, "none", np.uint8, 1)  # an attached level or renderbuffer without an image


def attached_image(image: Image, attachment: int) -> Image:
    """Return the image that an attachment point uses: the stencil image of a packed one at GL_STENCIL_ATTACHMENT."""
    if attachment == gl.GL_STENCIL_ATTACHMENT and image.stencil is not None:
        return image.stencil
    return image


@dataclass(frozen=True)
class Attachment:
    """A level of a texture, or a renderbuffer's image, attached to a framebuffer object."""

    image: Image
    texture: int = 0
    face: int = 0
    level: int = 0
    renderbuffer: int = 0


@dataclass(eq=False)
class Framebuffer:
    """The buffers that a draw writes. A missing buffer is None: its test passes and nothing is written.

    `draw_buffers` are the buffers set by glDrawBuffers, up to `DRAW_BUFFERS`; all others are GL_NONE. `flipped`: row 0
    is the top row, as in the default framebuffer. `clamps`: glGet returns colours clamped to [0, 1]; for a framebuffer
    object, Mesa decides this by its float buffers, but only when it checks whether the object is complete.
    """

    name: int
    attachments: dict[int, Attachment] = field(default_factory=dict)
    flipped: bool = False
    clamps: bool = False
    draw_buffers: tuple[int, ...] = (gl.GL_COLOR_ATTACHMENT0,)
    read_buffer: int = gl.GL_COLOR_ATTACHMENT0
    accumulation: np.ndarray | None = None

    def image(self, attachment: int) -> Image | None:
        """Return the image at an attachment point, or None."""
        attached = self.attachments.get(attachment)
        return attached.image if attached else None

    def attaches(self, texture: int) -> bool:
        """Return whether an image of a texture is attached."""
        return bool(texture) and any(each.texture == texture for each in self.attachments.values())

    @property
    def color(self) -> Image | None:
        """The image of the first draw buffer; None for GL_NONE or without an attachment."""
        return self._color_buffer(self.draw_buffer_at(0))

    @property
    def colors(self) -> tuple[Image, ...]:
        """The images that colours are written to: one per draw buffer that has an image."""
        images = [self._color_buffer(buffer) for buffer in self.draw_buffers]
        return tuple([image for image in images if image is not None])

    def draw_buffer_at(self, index: int) -> int:
        """Return the token of a draw buffer by its index."""
        return self.draw_buffers[index] if index < len(self.draw_buffers) else gl.GL_NONE

    @property
    def first_color(self) -> Image | None:
        """The image of the first colour attachment, drawn to or not; None without any."""
        points = [
            point for point in self.attachments if point in range(gl.GL_COLOR_ATTACHMENT0, gl.GL_DEPTH_ATTACHMENT)
        ]
        return self.image(min(points)) if points else None

    @property
    def read_color(self) -> Image | None:
        """The image of the read buffer, or None."""
        return self._color_buffer(self.read_buffer)

    def _color_buffer(self, buffer: int) -> Image | None:
        # GL_BACK, GL_FRONT, GL_LEFT ... are all the one colour buffer of the window
        attachment = gl.GL_COLOR_ATTACHMENT0 if self.name == DEFAULT and buffer != gl.GL_NONE else buffer
        return self.image(attachment)

    @property
    def depth(self) -> Image | None:
        """The depth buffer, or None."""
        return self.image(gl.GL_DEPTH_ATTACHMENT)

    @property
    def stencil(self) -> Image | None:
        """The stencil buffer, or None."""
        return self.image(gl.GL_STENCIL_ATTACHMENT)

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) of the smallest attachment, (0, 0) without any."""
        if not self.attachments:
            return (0, 0)
        if self.name == DEFAULT:  # all buffers of the window have its size
            image = next(iter(self.attachments.values())).image
            return image.width, image.height
        sizes = [(attached.image.width, attached.image.height) for attached in self.attachments.values()]
        if sizes.count(sizes[0]) == len(sizes):
            return sizes[0]
        widths, heights = zip(*sizes, strict=True)
        return min(widths), min(heights)


def default_framebuffer(
    width: int, height: int, depth_format: str = "d24", stencil_bits: int = 8, precision: str = "mesa"
) -> Framebuffer:
    """Return the window: RGBA8 and stencil cleared to 0, depth cleared to 1.

    Raises
    ------
    ValueError
        A size outside 1 to 16384, more or less than 1 to 8 stencil bits, an unknown depth format or precision.
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
    stored_depth = EXACT_DEPTH if precision == "exact" else DEPTH_FORMATS[depth_format]
    stored_stencil = Format(gl.GL_STENCIL_INDEX, "stencil", np.uint8, 1, (1 << stencil_bits) - 1)
    try:
        color = Image.new(FORMATS[gl.GL_RGBA8], int(width), int(height), gl.GL_RGBA8)
        depth = Image.new(stored_depth, int(width), int(height), gl.GL_DEPTH_COMPONENT24)
        stencil = Image.new(stored_stencil, int(width), int(height), gl.GL_STENCIL_INDEX8)
    except MemoryError:
        raise StateError(f"a {width} x {height} framebuffer does not fit in memory") from None
    depth.cells[:] = stored_depth.largest or 1.0
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

    `visibility_cache` and `geometry_cache` speed up draws that repeat earlier ones (`softshadow.pipeline.fast`), with
    the same result.
    """

    framebuffers: dict[int, Framebuffer]
    textures: dict[int, Texture] = field(default_factory=dict)
    renderbuffers: dict[int, Image] = field(default_factory=dict)
    queries: dict[int, int] = field(default_factory=dict)
    active_query: int = 0
    visibility_cache: Any = None
    geometry_cache: Any = None

    @property
    def window(self) -> Framebuffer:
        """The default framebuffer."""
        return self.framebuffers[DEFAULT]

    def write_pending(self) -> None:
        """Write the pending rows of all buffers (`Image.write_later`)."""
        for target in self.framebuffers.values():
            for attachment in target.attachments.values():
                attachment.image.write_pending()

    def note_passed(self, query: int, fragments: int) -> None:
        """Add fragments that have passed to the count of a query; 0 is none."""
        if query:
            self.queries[query] += fragments

    def is_attached(self, texture: int) -> bool:
        """Return whether an image of a texture is attached to a framebuffer."""
        return any(target.attaches(texture) for target in self.framebuffers.values())

    def reattach(self, texture: int, face: int, level: int, image: Image) -> None:
        """Attach the new image of a texture's level wherever the level is attached."""
        for target in self.framebuffers.values():
            for point, attachment in target.attachments.items():
                if (attachment.texture, attachment.face, attachment.level) == (texture, face, level) and texture:
                    target.attachments[point] = replace(attachment, image=attached_image(image, point))


__all__ = ["DEFAULT", "STENCIL8", "Attachment", "Framebuffer", "Storage", "default_framebuffer"]
