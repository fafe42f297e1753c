"""The textures, framebuffers and reads of wild sequences."""

from typing import Any

import numpy as np

from bounds.wild_values import CHOICES, CUBE_FACES, DEPTHS, NUMBERS, PLANES, POINTS, SIDES, TEXTURE_TARGETS, WIDTHS
from bounds.wild_writer import WildWriter
from mesa.random_images import INTERNAL_FORMATS, PIXEL_FORMATS, PIXEL_TYPES
from mesa.random_mipmaps import MIN_FILTERS


class WildImageWriter(WildWriter):
    """Writes also calls about images."""

    def texture(self) -> None:
        target = self.pick(TEXTURE_TARGETS)
        self.call("glBindTexture", target, self.pick(CHOICES["texture name"][:3]))
        width, height, level = self.pick(SIDES), self.pick(SIDES), self.pick([0, 0, 0, 0, 1, 2])
        faces = ["GL_TEXTURE_2D"]
        if target != "GL_TEXTURE_2D":
            faces, height = CUBE_FACES[: self.pick([6, 6, 1])], width
        internal, pixel_format, kind, pixels = self.image(width, height)
        for face in faces:
            image = (internal, width, height, 0, pixel_format, kind, pixels)
            self.call("glTexImage2D", face, level, *image)
        if self.chance(0.3):
            self.call("glGenerateMipmap", target)
        if self.chance(0.6):
            self.call("glTexParameteri", target, "GL_TEXTURE_MIN_FILTER", self.pick(MIN_FILTERS))
        if self.chance(0.2):
            self.call("glGetTexImage", self.pick(faces), self.pick([0, level, 1]), pixel_format, kind)

    def image(self, width: int, height: int) -> tuple[Any, str, str, np.ndarray | None]:
        """Return internal format, format, type and pixels; often None."""
        if self.chance(0.3):
            internal, pixel_format, kind = self.pick(DEPTHS), "GL_DEPTH_COMPONENT", self.pick(list(PIXEL_TYPES))
            if internal.endswith("STENCIL8"):
                return internal, "GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8", None
        else:
            internal, pixel_format = self.pick(INTERNAL_FORMATS), self.pick(list(PIXEL_FORMATS))
            kind = self.pick(list(PIXEL_TYPES))
        if self.chance(0.3):
            return internal, pixel_format, kind, None
        return internal, pixel_format, kind, self.pixels(width, height, pixel_format, kind)

    def pixels(self, width: int, height: int, pixel_format: str, kind: str) -> np.ndarray:
        shape = (height, width, PIXEL_FORMATS.get(pixel_format, 1))
        dtype = np.dtype(PIXEL_TYPES[kind])
        if dtype.kind == "f":
            values = self.rng.uniform(-0.1, 1.1, shape)
            values[self.rng.random(shape) < self.wildness * 0.3] = self.pick(NUMBERS)
            with np.errstate(over="ignore"):
                return values.astype(dtype)
        return self.rng.integers(np.iinfo(dtype).min, np.iinfo(dtype).max, shape, dtype=dtype, endpoint=True)

    def change_texture(self) -> None:
        """Copy into a texture, replace a part of it, or make its mipmaps."""
        target = self.pick(["GL_TEXTURE_2D", *CUBE_FACES[:2]])
        level = self.pick([0, 0, 1, 2])
        internal, pixel_format, kind, pixels = self.image(8, 5)
        x, y = self.integer(-3, 40), self.integer(-3, 40)
        width, height = self.pick(SIDES), self.pick(SIDES)
        way = self.pick(["copy", "copy part", "part", "mipmaps", "get"])
        if way == "copy":
            self.call("glCopyTexImage2D", target, level, internal, x, y, width, height, 0)
        elif way == "copy part":
            place = (self.integer(0, 9), self.integer(0, 9))
            self.call("glCopyTexSubImage2D", target, level, *place, x, y, width, height)
        elif way == "part" and pixels is not None:
            place = (self.integer(0, 9), self.integer(0, 9))
            self.call("glTexSubImage2D", target, level, *place, self.pick([0, 8]), 5, pixel_format, kind, pixels)
        elif way == "mipmaps":
            self.call("glGenerateMipmap", self.pick(TEXTURE_TARGETS))
        else:
            self.call("glGetTexImage", target, level, pixel_format, kind)

    def framebuffer(self) -> None:
        """A framebuffer object; its attachments differ in size and format, or are missing."""
        self.call(
            "glBindFramebuffer",
            self.pick(CHOICES["bound framebuffer"]),
            self.pick(["framebuffer 0"] * 2 + ["framebuffer 1"]),
        )
        points = [point for point in POINTS if self.chance(0.5)]
        self.rng.shuffle(points)
        if self.chance(0.7):
            color = self.pick([["GL_COLOR_ATTACHMENT0"], POINTS[:2], []])
            points = [*color, "GL_DEPTH_STENCIL_ATTACHMENT"][:: self.pick([1, -1])]
        for number, point in enumerate(points):
            self.attach(point, number)
        if not any(point.startswith("GL_COLOR") for point in points):
            self.call("glDrawBuffer", "GL_NONE")
            self.call("glReadBuffer", "GL_NONE")
        self.call("glCheckFramebufferStatus", "GL_FRAMEBUFFER")
        self.call("glClear", "GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_COLOR_BUFFER_BIT")

    def attach(self, point: str, number: int) -> None:
        formats = {"GL_DEPTH_ATTACHMENT": DEPTHS, "GL_STENCIL_ATTACHMENT": ["GL_STENCIL_INDEX8", DEPTHS[-2]]}
        formats["GL_DEPTH_STENCIL_ATTACHMENT"] = DEPTHS[-2:]
        internal = self.pick(formats.get(point, ["GL_RGBA8", "GL_RGBA8", "GL_RGBA32F", "GL_R8", "GL_RGB8"]))
        side = (self.pick(WIDTHS), self.pick(WIDTHS[1:]))
        if self.chance(self.wildness * 0.2):
            side = (self.pick([0, 16384, 16385, -1]), self.pick([0, 1]))
        if self.chance(0.7):
            name = f"renderbuffer {number}"
            self.call("glBindRenderbuffer", "GL_RENDERBUFFER", name)
            self.call("glRenderbufferStorage", "GL_RENDERBUFFER", internal, *side)
            self.call("glFramebufferRenderbuffer", "GL_FRAMEBUFFER", point, "GL_RENDERBUFFER", name)
            return
        name, level = f"texture {3 + number}", self.pick([0, 0, 0, 1])
        kind = ("GL_RGBA", "GL_UNSIGNED_BYTE") if point.startswith("GL_COLOR") else ("GL_DEPTH_COMPONENT", "GL_FLOAT")
        if internal.endswith("STENCIL8"):
            kind = ("GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8")
        self.call("glBindTexture", "GL_TEXTURE_2D", name)
        self.call("glTexImage2D", "GL_TEXTURE_2D", level, internal, *side, 0, *kind, None)
        self.call("glFramebufferTexture2D", "GL_FRAMEBUFFER", point, "GL_TEXTURE_2D", name, level)

    def blit(self) -> None:
        for target in ("GL_READ_FRAMEBUFFER", "GL_DRAW_FRAMEBUFFER"):
            if self.chance(0.5):
                self.call("glBindFramebuffer", target, self.pick(CHOICES["framebuffer"]))
        corners = [self.integer(-30, 130) for _ in range(8)]
        mask = self.pick([*PLANES[:3], "GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT"])
        self.call("glBlitFramebuffer", *corners, mask, self.pick(["GL_NEAREST", "GL_LINEAR"]))

    def read(self) -> None:
        pixel_format = self.pick([*PIXEL_FORMATS, "GL_DEPTH_COMPONENT", "GL_STENCIL_INDEX"])
        x, y = self.integer(-30, 130), self.integer(-30, 130)
        kind = self.pick(list(PIXEL_TYPES))
        self.call("glReadPixels", x, y, self.pick(SIDES), self.pick(SIDES), pixel_format, kind)
