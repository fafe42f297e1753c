"""Texture objects: the images of their levels and faces, and their sampling parameters."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from weakref import ReferenceType, ref

from softshadow import tokens as gl
from softshadow.image import Image

DEFAULTS = {  # keys in the storage of the textures named 0, by target
    gl.GL_TEXTURE_2D: 0,
    gl.GL_TEXTURE_CUBE_MAP: -1,
    gl.GL_TEXTURE_1D: -2,
    gl.GL_TEXTURE_RECTANGLE: -3,
    gl.GL_TEXTURE_3D: -4,
}
KNOWN_SAMPLERS = 16  # of a texture


def stored_name(target: int, name: int) -> int:
    """Return the key of a texture in the storage: its name, or that of its target in `DEFAULTS` if the name is 0."""
    return name or DEFAULTS[target]


@dataclass(frozen=True)
class Sampler:
    """The state of glTexParameter; defaults are GL's initial values (see `initial_sampler` for rectangles).

    `unit_lod_bias` belongs to the texture unit: it is 0 in the texture object itself, see `Texture.in_unit`.
    `ignores_depth_mode`: lookups take depths as GL_LUMINANCE, see `looked_up_as`.
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
    ignores_depth_mode: bool = False
    base_level: int = 0
    max_level: int = 1000
    min_lod: float = -1000.0
    max_lod: float = 1000.0
    lod_bias: float = 0.0
    unit_lod_bias: float = 0.0
    seamless: int = gl.GL_FALSE
    generate_mipmap: bool = False
    priority: float = 1.0
    max_anisotropy: float = 1.0

    @property
    def looked_up_as(self) -> int:
        """The format that a depth is looked up as: `depth_mode`, or what Mesa makes of it.

        Mesa keeps it with the image of the base level. Where glCopyTexImage2D defines the image, Mesa takes
        GL_LUMINANCE, until GL_DEPTH_TEXTURE_MODE or GL_TEXTURE_BASE_LEVEL changes, or glTexImage2D defines an image.
        Texture environments follow `depth_mode`.
        """
        return gl.GL_LUMINANCE if self.ignores_depth_mode else self.depth_mode


RECTANGLE_SAMPLER = Sampler(
    min_filter=gl.GL_LINEAR, wrap_s=gl.GL_CLAMP_TO_EDGE, wrap_t=gl.GL_CLAMP_TO_EDGE, wrap_r=gl.GL_CLAMP_TO_EDGE
)


def initial_sampler(target: int) -> Sampler:
    """Return the sampler parameters of a new texture."""
    return RECTANGLE_SAMPLER if target == gl.GL_TEXTURE_RECTANGLE else INITIAL_SAMPLER


INITIAL_SAMPLER = Sampler()


@dataclass(eq=False)
class Texture:
    """A texture object: images by (face, level); row 0 of an image is at the bottom.

    Only cube maps have faces other than 0. A 1-D texture is one of one row; rectangles have no mipmaps.
    """

    name: int
    target: int
    sampler: Sampler = Sampler()
    images: dict[tuple[int, int], Image] = field(default_factory=dict)
    _known: list[ReferenceType[Texture]] = field(default_factory=list, init=False, repr=False)  # with other parameters

    def base(self, face: int = 0) -> Image | None:
        """Return the image of the base level, or None if it is not defined."""
        return self.images.get((face, self.sampler.base_level))

    def last_level(self, face: int = 0) -> int:
        """Return the number of the smallest mipmap level of the base image; without an image, the base level."""
        image, sampler = self.base(face), self.sampler
        if image is None or self.target == gl.GL_TEXTURE_RECTANGLE:
            return sampler.base_level
        largest = max(image.width, image.height, image.slices, 1)
        return min(sampler.base_level + largest.bit_length() - 1, sampler.max_level)

    @property
    def faces(self) -> tuple[int, ...]:
        """The indices of the faces: six for a cube map, one for any other texture."""
        return tuple(range(6)) if self.target == gl.GL_TEXTURE_CUBE_MAP else (0,)

    @property
    def is_anisotropic(self) -> bool:
        """Whether lookups average the texels in an ellipse; Mesa ignores fractions of the limit.

        1-D textures, with which Mesa crashes, cube maps and comparisons of depths are filtered as without the limit.
        """
        sampler, image = self.sampler, self.base()
        if sampler.max_anisotropy < 2 or self.target in (gl.GL_TEXTURE_1D, gl.GL_TEXTURE_CUBE_MAP) or image is None:
            return False
        return image.format.kind != "depth" or sampler.compare_mode == gl.GL_NONE

    def with_sampler(self, sampler: Sampler) -> Texture:
        """Return the texture with other parameters, images shared; one that is still in use is found again."""
        known = self._known
        if not known or len(known) >= KNOWN_SAMPLERS:
            known[:] = [ref(self)]
        for reference in known:
            texture = reference()
            if texture is not None and texture.sampler == sampler:
                return texture
        other = Texture(self.name, self.target, sampler, self.images)
        other._known = known
        known.append(ref(other))
        return other

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
