"""Texture sampling at many coordinates, bit for bit as llvmpipe.

`sample` is the entry: it reads the texture's sampler state, selects mipmap levels (`level_of_detail`), samples their
images (`filtering`, `box_filtering`, `cube_filtering`) and writes RGBA.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow.errors import StateError
from softshadow.jit import kernel
from softshadow.programs import cube_maps
from softshadow.programs.anisotropy import sample_ellipses
from softshadow.programs.box_filtering import BOXES, box_wraps, sample_box
from softshadow.programs.cube_filtering import HEAVIEST, LINEAR, NEAREST, PIXELS_OF_A_BLOCK, filter_cube
from softshadow.programs.filtering import UNORM8_STEP, in_8_bits, sample_image, wraps_of
from softshadow.programs.level_of_detail import (
    FILTERS,
    Levels,
    select_levels,
    squared_texels_per_pixel,
    texels_per_pixel,
)
from softshadow.programs.program import needs_blocks
from softshadow.programs.reads import note_read
from softshadow.programs.wrapping import ONE
from softshadow.texture import Texture
from softshadow.tokens import (
    GL_CLAMP_TO_EDGE,
    GL_LINEAR,
    GL_NONE,
    GL_TEXTURE_1D,
    GL_TEXTURE_2D,
    GL_TEXTURE_3D,
    GL_TEXTURE_CUBE_MAP,
)

WEIGHT_STEPS = np.float32(256.0)


def base_format(texture: Texture) -> int:
    """Return the base internal format used by texture environments; for a depth texture its depth mode."""
    image = texture.base()
    if image is None:
        raise StateError(f"texture {texture.name}: no image; define one with glTexImage2D")
    return texture.sampler.depth_mode if image.format.kind == "depth" else image.format.base


def is_complete(texture: Texture) -> bool:
    """Return whether the texture is complete, so that it can be sampled.

    Its base image must exist, with a mipmap filter all its levels, and for a cube map all six faces of each. The sizes
    must match, and all images must have the same internal format.

    References: GL 2.1 sec. 3.8.10.
    """
    mipmaps = FILTERS[texture.sampler.min_filter][1] != GL_NONE
    return _has_levels(texture, texture.last_level() if mipmaps else texture.sampler.base_level)


def is_mipmap_complete(texture: Texture) -> bool:
    """Return whether all levels exist, whatever the filter; only then Mesa draws to a level other than the base."""
    return _has_levels(texture, texture.last_level())


def _has_levels(texture: Texture, last: int) -> bool:
    image, base = texture.base(), texture.sampler.base_level
    if image is None or 0 in (image.width, image.height, image.slices):
        return False
    format, internal_format, *sides = image.layout
    for level in range(base, last + 1):
        if level > base:
            sides = [max(side // 2, 1) for side in sides]
        layout, images = (
            (format, internal_format, *sides),
            [texture.images.get((face, level)) for face in texture.faces],
        )
        if not all(image is not None and image.layout == layout for image in images):
            return False
    return last >= base


def project(coordinates: np.ndarray) -> np.ndarray:
    """Return (s, t, r) / q of coordinates (N, 4), computed as s * (1/q)."""
    with np.errstate(all="ignore"):  # q = 0 gives infinities, as in GL
        projected: np.ndarray = coordinates[:, :3] * (ONE / coordinates[:, 3:])
    return projected


def project_with_reference(coordinates: np.ndarray) -> np.ndarray:
    """Return (s, t, r, q) / q (N, 4): on cube maps the fixed function compares depths with q / q, about 1."""
    with np.errstate(all="ignore"):
        projected: np.ndarray = coordinates * (ONE / coordinates[:, 3:])
    return projected


class Lookup(NamedTuple):
    """Positions in a texture's images: coordinates (N, 3), faces (N,) of a cube map or None.

    The coordinates are s, t and r, or s, t and the reference of a depth comparison; `wraps` are the codes of the wrap
    modes on the texture's axes.
    """

    texture: Texture
    wraps: tuple[int, ...]
    coordinates: np.ndarray
    faces: np.ndarray | None


def divide(coordinates: np.ndarray) -> np.ndarray:
    """Return (s, t, r) / q of coordinates (N, 4) as GLSL's division operator: rounded once.

    texture2DProj and the fixed function use `project` instead, which differs in the last bit of a quarter of all
    quotients. That bit selects the texel if a coordinate lies on the edge between two.
    """
    quotients = np.empty((3, len(coordinates)), coordinates.dtype)
    divide_all(np.ascontiguousarray(coordinates.T), quotients)
    return quotients.T


@kernel
def divide_all(coordinates, quotients):
    """Write (s, t, r) / q of coordinates (4, N) to `quotients` (3, N); q = 0 gives infinities, as in GL."""
    for c in range(3):
        for n in range(coordinates.shape[1]):
            quotients[c, n] = coordinates[c, n] / coordinates[3, n]


def sample(texture: Texture, coordinates: np.ndarray, out: np.ndarray) -> None:
    """Fill `out` (N, k) with the first k channels of the texture's RGBA at coordinates.

    If `needs_blocks` is True, the coordinates must be those of complete 2x2 blocks of pixels (see `Program.blocks`).

    Parameters
    ----------
    coordinates : (N, 3)         s, t, and r for depth comparison (t in a 1-D texture); for a 3-D texture s, t, r;
                                 s and t of a rectangle are in texels; for a cube map (N, 3) or (N, 4): direction s, t,
                                 r and, for depth comparison, the reference
    out : (N, k)                 k is 4 for a cube map; an incomplete texture gives (0, 0, 0, 1)

    Raises
    ------
    StateError                   blocks are needed, and the coordinates are not complete blocks
    """
    image, sampler = texture.base(), texture.sampler
    if image is None or not is_complete(texture):
        out[:] = (0.0, 0.0, 0.0, 1.0)[: out.shape[1]]
        return
    if needs_blocks(texture) and len(coordinates) % PIXELS_OF_A_BLOCK:
        raise StateError(
            f"texture {texture.name}: GL_TEXTURE_MIN_FILTER and GL_TEXTURE_MAG_FILTER differ, which needs fragments in "
            "2x2 blocks; set both to GL_NEAREST or both to GL_LINEAR"
        )
    lookup = look_up(texture, coordinates)
    if texture.is_anisotropic:
        sample_ellipses(texture, coordinates, n_levels_of_ellipses(texture), out)
    elif filters_cube_in_float(texture):
        sample_cube_in_float(lookup, levels_of(texture, coordinates), out)
    elif sampler.min_filter == sampler.mag_filter:
        sample_level(lookup, 0, sampler.mag_filter, out)
    else:
        sample_levels(lookup, levels_of(texture, coordinates), out)
    note_read(texture, coordinates, out)


def levels_of(texture: Texture, coordinates: np.ndarray) -> Levels:
    """Return the mipmap levels of all pixels (N,), selected per block; for a mipmapped cube map per pixel."""
    image, sampler = texture.base(), texture.sampler
    assert image is not None
    last = texture.last_level() - sampler.base_level
    if texture.target == GL_TEXTURE_1D:
        lengths = texels_per_pixel(coordinates, image.width)
        levels = select_levels(lengths * lengths, sampler, last, lengths)
        return Levels(*(np.repeat(a, PIXELS_OF_A_BLOCK) for a in levels))
    if texture.target != GL_TEXTURE_CUBE_MAP:
        sides = (image.width, image.height, image.slices) if texture.target == GL_TEXTURE_3D else None
        squared = squared_texels_per_pixel(coordinates, *(sides or (image.width, image.height)))
    else:
        squared = cube_maps.squared_texels_per_pixel(np.ascontiguousarray(coordinates), image.width)
        squared = squared if is_mipmapped(texture) else squared[::PIXELS_OF_A_BLOCK]
    levels = select_levels(squared, sampler, last)
    return Levels(*(np.repeat(a, len(coordinates) // len(squared)) for a in levels)) if len(squared) else levels


def look_up(texture: Texture, coordinates: np.ndarray) -> Lookup:
    """Return the lookup positions for coordinates; on cube maps every face is clamped to its edge, as in llvmpipe."""
    if texture.target != GL_TEXTURE_CUBE_MAP:
        first = texture.images.get((0, 0)) or texture.base()
        assert first is not None
        wraps = wraps_of(texture.sampler, first) if texture.target == GL_TEXTURE_2D else box_wraps(texture, first)
        return Lookup(texture, wraps, coordinates, None)
    faces, places = cube_maps.on_faces(np.ascontiguousarray(coordinates), needs_level_of_detail(texture))
    return Lookup(texture, (GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE), places, faces)


def needs_level_of_detail(texture: Texture) -> bool:
    """Return whether llvmpipe computes a level of detail from derivatives."""
    sampler, within = texture.sampler, FILTERS[texture.sampler.min_filter][0]
    depends = is_mipmapped(texture) or within != sampler.mag_filter
    return depends and max(sampler.min_lod, 0.0) != sampler.max_lod


def is_mipmapped(texture: Texture) -> bool:
    """Return whether llvmpipe filters between levels; it does not if level 0 is the only one."""
    sampler = texture.sampler
    only_level = texture.last_level() == 0 and sampler.max_lod > 0
    return FILTERS[sampler.min_filter][1] != GL_NONE and not only_level


def n_levels_of_ellipses(texture: Texture) -> int:
    """Return how many levels an anisotropic filter selects from; without a mipmap filter as well, if they are there."""
    sampler = texture.sampler
    selects = is_mipmapped(texture) or FILTERS[sampler.min_filter][0] != sampler.mag_filter
    return texture.last_level() - sampler.base_level + 1 if selects and is_mipmap_complete(texture) else 1


def filters_cube_in_float(texture: Texture) -> bool:
    """Return whether a cube map's filter crosses face edges or may differ between the pixels of a block."""
    sampler, within = texture.sampler, FILTERS[texture.sampler.min_filter][0]
    crosses = sampler.seamless and GL_LINEAR in (within, sampler.mag_filter)
    by_pixel = is_mipmapped(texture) and within != sampler.mag_filter
    return texture.target == GL_TEXTURE_CUBE_MAP and (bool(crosses) or by_pixel)


def sample_cube_in_float(lookup: Lookup, levels: Levels, out: np.ndarray) -> None:
    """Fill `out` (N, 4) from a cube map for which `filters_cube_in_float` is True."""
    texture, sampler, faces = lookup.texture, lookup.texture.sampler, lookup.faces
    within, between = FILTERS[sampler.min_filter]
    assert faces is not None
    linear = np.where(levels.minified, within, sampler.mag_filter) == GL_LINEAR
    beside_linear = linear.reshape(-1, PIXELS_OF_A_BLOCK).any(axis=1).repeat(PIXELS_OF_A_BLOCK)
    kinds = np.where(linear, LINEAR, np.where(beside_linear, HEAVIEST, NEAREST)).astype(np.int8)
    lower = np.zeros_like(levels.lower) if between == GL_NONE else levels.lower
    if within != sampler.mag_filter:
        lower = np.where(levels.minified, lower, 0)
    out[:] = filter_cube(texture, lower + sampler.base_level, faces, lookup.coordinates, kinds)
    mixed = levels.weight > 0
    if between == GL_LINEAR and mixed.any():
        upper = filter_cube(texture, levels.upper + sampler.base_level, faces, lookup.coordinates, kinds)
        out[mixed] = mix_in_float(out[mixed], upper[mixed], levels.weight[mixed, np.newaxis])


def sample_level(lookup: Lookup, level: int, filter_name: int, out: np.ndarray) -> None:
    """Fill `out` (N, 4) from one level, counted from the base level, with one filter."""
    texture, linear = lookup.texture, filter_name == GL_LINEAR
    images, level = texture.images, level + texture.sampler.base_level
    if texture.target in BOXES:
        sample_box(images[0, level], texture, lookup.wraps, linear, lookup.coordinates, out)
    elif lookup.faces is None:
        sample_image(images[0, level], texture.sampler, lookup.wraps, linear, lookup.coordinates, out)
    else:
        for face in np.unique(lookup.faces):
            pixels = np.nonzero(lookup.faces == face)[0]
            part = np.empty((out.shape[1], len(pixels)), out.dtype).T
            coordinates = lookup.coordinates[pixels]
            sample_image(images[int(face), level], texture.sampler, lookup.wraps, linear, coordinates, part)
            out[pixels] = part


def sample_levels(lookup: Lookup, levels: Levels, out: np.ndarray) -> None:
    """Fill `out` (N, 4) from the mipmap levels selected for each pixel."""
    texture = lookup.texture
    image, sampler = texture.base(), texture.sampler
    assert image is not None
    within, between = FILTERS[sampler.min_filter]

    def fill(selected: np.ndarray, pixel_levels: np.ndarray, filter_name: int, into: np.ndarray) -> None:
        for level in np.unique(pixel_levels[selected]):
            pixels = np.nonzero(selected & (pixel_levels == level))[0]
            part = np.empty((out.shape[1], len(pixels)), out.dtype).T
            faces = None if lookup.faces is None else lookup.faces[pixels]
            part_lookup = lookup._replace(coordinates=lookup.coordinates[pixels], faces=faces)
            sample_level(part_lookup, int(level), filter_name, part)
            into[pixels] = part

    small = levels.minified if within != sampler.mag_filter else np.ones(len(out), bool)
    if between == GL_NONE:
        levels = levels._replace(lower=np.zeros_like(levels.lower))
    fill(small, levels.lower, within, out)
    fill(~small, np.zeros_like(levels.lower), sampler.mag_filter, out)
    both = small & (levels.weight > 0)
    if between == GL_LINEAR and both.any():
        upper = np.empty_like(out)
        fill(both, levels.upper, within, upper)
        mix = mix_in_8_bits if in_8_bits(image, lookup.wraps) else mix_in_float
        out[both] = mix(out[both], upper[both], levels.weight[both, np.newaxis])


def mix_in_float(a: np.ndarray, b: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return the mixture of float colours."""
    mixed: np.ndarray = weight * (b - a) + a
    return mixed


def mix_in_8_bits(a: np.ndarray, b: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return the interpolation of colours that are multiples of 1/255, rounded as llvmpipe's 8-bit interpolation."""
    lower, upper = (np.rint(c * np.float32(255)).astype(np.int32) for c in (a, b))
    steps = np.trunc(weight * WEIGHT_STEPS).astype(np.int32)
    mixed: np.ndarray = (lower + (((upper - lower) * steps * 128 + 16384) >> 15)).astype(np.float32) * UNORM8_STEP
    return mixed
