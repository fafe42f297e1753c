"""Texture objects: the images of their levels and faces, and their sampling parameters."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from softshadow import tokens as gl
from softshadow.image import Image

DEFAULT_CUBE_MAP = -1  # key of the cube map named 0 in the storage; key 0 is the 2-D texture named 0


def stored_name(target: int, name: int) -> int:
    """Return the key of a texture in the storage: its name, or `DEFAULT_CUBE_MAP` for the cube map named 0."""
    return name if name or target == gl.GL_TEXTURE_2D else DEFAULT_CUBE_MAP


@dataclass(frozen=True)
class Sampler:
    """The state of glTexParameter; defaults are GL's initial values.

    `unit_lod_bias` belongs to the texture unit: it is 0 in the texture object itself, see `Texture.in_unit`.
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
    """A texture object: images by (face, level); a 2-D texture has face 0; row 0 of an image is at the bottom."""

    name: int
    target: int
    sampler: Sampler = Sampler()
    images: dict[tuple[int, int], Image] = field(default_factory=dict)

    def base(self, face: int = 0) -> Image | None:
        """Return the image of the base level, or None if it is not defined."""
        return self.images.get((face, self.sampler.base_level))

    def last_level(self, face: int = 0) -> int:
        """Return the number of the smallest mipmap level of the base image; without an image, the base level."""
        image, sampler = self.base(face), self.sampler
        if image is None:
            return sampler.base_level
        return min(sampler.base_level + max(image.width, image.height, 1).bit_length() - 1, sampler.max_level)

    @property
    def faces(self) -> tuple[int, ...]:
        """The indices of the faces: six for a cube map, one for a 2-D texture."""
        return tuple(range(6)) if self.target == gl.GL_TEXTURE_CUBE_MAP else (0,)

    def in_unit(self, lod_bias: float, seamless: bool) -> Texture:
        """Return the texture as a unit with this level-of-detail bias samples it; the images are shared.

        `seamless` is the context's GL_TEXTURE_CUBE_MAP_SEAMLESS.
        """
        is_seamless = int(seamless or self.sampler.seamless)
        if (self.sampler.unit_lod_bias, self.sampler.seamless) == (lod_bias, is_seamless):
            return self
        sampler = replace(self.sampler, unit_lod_bias=lod_bias, seamless=is_seamless)
        return Texture(self.name, self.target, sampler, self.images)

    def copy(self) -> Texture:
        """Return a copy with images of its own."""
        return Texture(self.name, self.target, self.sampler, {k: i.copy() for k, i in self.images.items()})
