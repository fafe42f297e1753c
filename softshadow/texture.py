"""Texture objects: levels and faces of images, and the sampler that reads them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from softshadow import tokens as gl
from softshadow.image import Image

DEFAULT_CUBE_MAP = -1  # what the cube map named 0 is stored as; 0 is the 2-D texture of that name


def stored_name(target: int, name: int) -> int:
    """Return what a texture of a target is stored as: its name, or what stands for the cube map named 0."""
    return name if name or target == gl.GL_TEXTURE_2D else DEFAULT_CUBE_MAP


@dataclass(frozen=True)
class Sampler:
    """What glTexParameter sets; initial values are GL's.

    `unit_lod_bias` is that of the texture unit: it stays 0 in the texture object itself, see `Texture.in_unit`.
    """

    min_filter: int = gl.GL_NEAREST_MIPMAP_LINEAR
    mag_filter: int = gl.GL_LINEAR
    wrap_s: int = gl.GL_REPEAT
    wrap_t: int = gl.GL_REPEAT
    wrap_r: int = gl.GL_REPEAT
    border_color: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    compare_mode: int = gl.GL_NONE
    compare_func: int = gl.GL_LEQUAL
    depth_mode: int = gl.GL_LUMINANCE
    base_level: int = 0
    max_level: int = 1000
    min_lod: float = -1000.0
    max_lod: float = 1000.0
    lod_bias: float = 0.0
    unit_lod_bias: float = 0.0
    seamless: int = gl.GL_FALSE
    generate_mipmap: bool = False
    priority: float = 1.0


@dataclass(eq=False)
class Texture:
    """A texture object: images by (face, level); the face of a 2-D texture is 0, row 0 of an image is at the bottom."""

    name: int
    target: int
    sampler: Sampler = Sampler()
    images: dict[tuple[int, int], Image] = field(default_factory=dict)

    def base(self, face: int = 0) -> Image | None:
        """The image of the base level, or None while it has not been defined."""
        return self.images.get((face, self.sampler.base_level))

    def last_level(self, face: int = 0) -> int:
        """The number of the smallest level that mipmaps of the base image have; the base level without an image."""
        image, sampler = self.base(face), self.sampler
        if image is None:
            return sampler.base_level
        return min(sampler.base_level + max(image.width, image.height, 1).bit_length() - 1, sampler.max_level)

    @property
    def faces(self) -> tuple[int, ...]:
        """The numbers of the faces: six of a cube map, one of a 2-D texture."""
        return tuple(range(6)) if self.target == gl.GL_TEXTURE_CUBE_MAP else (0,)

    def in_unit(self, lod_bias: float, seamless: bool) -> Texture:
        """Return the texture, over the same images, as a unit of that bias samples it.

        `seamless` is GL_TEXTURE_CUBE_MAP_SEAMLESS of the context.
        """
        is_seamless = int(seamless or self.sampler.seamless)
        if (self.sampler.unit_lod_bias, self.sampler.seamless) == (lod_bias, is_seamless):
            return self
        sampler = replace(self.sampler, unit_lod_bias=lod_bias, seamless=is_seamless)
        return Texture(self.name, self.target, sampler, self.images)

    def copy(self) -> Texture:
        return Texture(self.name, self.target, self.sampler, {k: i.copy() for k, i in self.images.items()})
