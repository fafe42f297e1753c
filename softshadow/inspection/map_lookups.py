"""Lookups of shadow maps and other textures by one fragment: the texels that were read, and how they were compared.

They are made from the noted reads of the shading functions themselves, so they are what the picture was drawn with.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Image
from softshadow.pipeline.raster.fragment_ops import compare
from softshadow.programs.filtering import RED, fetch, nearest_places, texels_of
from softshadow.programs.program import needs_blocks
from softshadow.programs.reads import Read
from softshadow.programs.sampling import look_up
from softshadow.programs.wrapping import linear_texels
from softshadow.state.texturing import OF_PROGRAMS
from softshadow.texture import Texture
from softshadow.tokens import token_name

FACES = ("+x", "-x", "+y", "-y", "+z", "-z")
FUNCTIONS = ("GL_NEVER", "GL_LESS", "GL_EQUAL", "GL_LEQUAL", "GL_GREATER", "GL_NOTEQUAL", "GL_GEQUAL", "GL_ALWAYS")


@dataclass(frozen=True)
class Tap:
    """One texel that was read.

    Attributes
    ----------
    x, y, gl_y : int             texel, from the left, from the top and from the bottom
    face : str                   of a cube map, "+x" to "-z"; else ""
    inside : bool                False: it lies outside the texture, and its border colour was read
    stored : float               red, or the depth
    depth : float or None        what it was compared with, after the bias
    lit : bool or None           the result of the comparison
    weight : float               of the result
    purpose : str                what the read is for, where a program has several: "search" or "taps"
    """

    x: int
    y: int
    gl_y: int
    face: str
    inside: bool
    stored: float
    depth: float | None
    lit: bool | None
    weight: float
    purpose: str


@dataclass(frozen=True)
class MapLookup:
    """All reads of one texture by one fragment.

    Attributes
    ----------
    texture : int                its name
    light : str                  whose light is added with it; "" if that is not known
    x, y, gl_y, face, stored, depth     those of the middle tap
    bias : float or None         what the program has subtracted from the depth; None if the texture unit compares
    compare : str                "LEQUAL" ...; "" if depths are not compared one by one
    measure : str                "depth", or "distance": what is stored and compared, in world units
    farthest : float             greater depths or distances count as this one
    lit : float or None          the weighted share of the taps that are lit; of a filtered map what the program finds
    visible : float or None      the visibility that the program returns: another one where the map does not decide
    values : tuple               the channels of the last read
    silhouette_point : tuple or None    s and t of the silhouette point in the cell of texels
    taps : tuple of Tap
    caster, caster_triangle      the object, and its triangle, that was drawn last into the texel of the middle tap, or
                                 of the first one in shadow; "" and None where nothing was drawn
    """

    texture: int
    light: str
    x: int
    y: int
    gl_y: int
    face: str
    stored: float
    depth: float | None
    bias: float | None
    compare: str
    measure: str
    farthest: float
    lit: float | None
    visible: float | None
    values: tuple[float, ...]
    silhouette_point: tuple[float, float] | None
    taps: tuple[Tap, ...]
    caster: str = ""
    caster_triangle: int | None = None

    @property
    def deciding_tap(self) -> Tap:
        """The first tap in shadow, else the middle one."""
        dark = [tap for tap in self.taps if tap.lit is False and tap.purpose != "search"]
        middle = next(
            (tap for tap in self.taps if (tap.x, tap.y, tap.face) == (self.x, self.y, self.face)), self.taps[0]
        )
        return dark[0] if dark and middle.lit is not False else middle


class Texel(NamedTuple):
    """A texel of an image of a texture: column, row from the bottom, weight, and the image."""

    column: int
    row: int
    weight: float
    image: Image
    face: int


def map_lookups(reads: Iterable[Read], place: int, visible: float | None, light: str) -> tuple[MapLookup, ...]:
    """Return the lookups of depths and of what is compared with depths.

    Parameters
    ----------
    reads : of the fragments that were shaded together
    place : int                  the number of the fragment among them
    visible : float or None      the visibility that the program returned for it
    """
    by_texture: dict[int, list[Read]] = {}
    for read in reads:
        by_texture.setdefault(read.texture.name, []).append(read)
    lookups = [_lookup(group, place, visible, light) for group in by_texture.values()]
    found = [each for each in lookups if each is not None]
    points = [reads for reads in by_texture.values() if reads[0].compared is None and len(reads) > 1]
    if len(found) == 1 and points:  # a silhouette map beside the depth map: the first read is the cell's own
        s, t = (float(c) for c in points[0][0].values[place][:2])
        found[0] = replace(found[0], silhouette_point=(s, t), lit=visible)
    return tuple(found)


def _lookup(reads: list[Read], place: int, visible: float | None, light: str) -> MapLookup | None:
    texture = reads[0].texture
    image = texture.base()
    assert image is not None
    by_unit = image.format.kind == "depth" and texture.sampler.compare_mode != gl.GL_NONE
    if not by_unit and reads[0].compared is None and image.format.kind != "depth":
        return None
    function = texture.sampler.compare_func if by_unit else gl.GL_LEQUAL
    taps: list[Tap] = []
    values: tuple[float, ...] = ()
    first = reads[0].compared
    measure, farthest = ("depth", 1.0) if first is None else (first.measure, first.farthest)
    compares = by_unit or image.format.kind == "depth" or measure == "distance"
    for read in reads:
        row = place_in(read, place)
        if row is None:
            continue
        values = tuple(float(v) for v in read.values[row])
        depth = reference_of(read, row, image, by_unit)
        purpose = read.compared.purpose if read.compared else ""
        weight = 1.0 if read.compared is None or read.compared.weights is None else float(read.compared.weights[row])
        for texel in texels_read(texture, read.coordinates[row]):
            stored = value_of(texture, texel, read.coordinates.dtype)
            passes = bool(compare(function, depth, stored)) if compares and depth is not None else None
            taps.append(_tap(texel, stored, depth, passes, weight * texel.weight, purpose))
    if not taps:
        return None
    counted = [tap for tap in taps if tap.purpose != "search"] or taps
    middle = counted[len(counted) // 2]
    lit = share_of(counted) if compares else visible
    return MapLookup(
        texture.name, light, middle.x, middle.y, middle.gl_y, middle.face, middle.stored, middle.depth,
        None if first is None else first.bias,
        token_name(function, FUNCTIONS).removeprefix("GL_") if compares and middle.depth is not None else "",
        measure, farthest, lit, visible, values, None, tuple(taps),
    )  # fmt: skip


def place_in(read: Read, place: int) -> int | None:
    """Return the row of a read that belongs to a fragment, or None: some reads are made for some fragments only."""
    if read.compared is None or read.compared.rows is None:
        return place
    rows = np.flatnonzero(read.compared.rows == place)
    return int(rows[0]) if len(rows) else None


def reference_of(read: Read, row: int, image: Image, by_unit: bool) -> Any:
    """Return the depth that a read is compared with, as its texture unit or its program compares it; or None."""
    if not by_unit:
        return None if read.compared is None else read.compared.depths[row]
    coordinates = read.coordinates[row]
    is_cube = read.texture.target == gl.GL_TEXTURE_CUBE_MAP
    if is_cube and len(coordinates) < 4:
        return None
    reference = coordinates[3 if is_cube else 2]
    return min(max(reference, reference.dtype.type(0)), reference.dtype.type(1)) if image.format.largest else reference


def share_of(taps: list[Tap]) -> float | None:
    """Return the weighted share of lit taps; None if they were not compared."""
    if any(tap.lit is None for tap in taps):
        return None
    total = sum(tap.weight for tap in taps)
    return sum(tap.weight for tap in taps if tap.lit) / total if total else 0.0


def _tap(texel: Texel, stored: float, depth: Any, lit: bool | None, weight: float, purpose: str) -> Tap:
    image = texel.image
    inside = 0 <= texel.column < image.width and 0 <= texel.row < image.height
    face = FACES[texel.face] if texel.face >= 0 else ""
    return Tap(
        texel.column, image.height - 1 - texel.row, texel.row, face, inside, stored,
        None if depth is None else float(depth), lit, weight, purpose,
    )  # fmt: skip


def texels_read(texture: Texture, coordinates: np.ndarray) -> list[Texel]:
    """Return the texels that one lookup in a 2-D texture or cube map reads, with their weights.

    None where the level depends on a 2x2 block.
    """
    if needs_blocks(texture) or texture.target not in OF_PROGRAMS:
        return []
    lookup = look_up(texture, coordinates[np.newaxis])
    face = -1 if lookup.faces is None else int(lookup.faces[0])
    image = texture.base(max(face, 0))
    assert image is not None
    s, t = lookup.coordinates[0, :2]
    if texture.sampler.mag_filter == gl.GL_NEAREST:
        column, row = nearest_places(np.ascontiguousarray(lookup.coordinates.T), image, lookup.wraps)
        return [Texel(int(column[0]), int(row[0]), 1.0, image, face)]
    columns, rows = (
        linear_texels(at, side, wrap)
        for at, side, wrap in zip((s, t), (image.width, image.height), lookup.wraps, strict=True)
    )
    (i0, i1, x), (j0, j1, y) = columns, rows
    corners = [(i, j, u * v) for j, v in ((j0, 1 - y), (j1, y)) for i, u in ((i0, 1 - x), (i1, x))]
    return [Texel(int(i), int(j), float(weight), image, face) for i, j, weight in corners]


def value_of(texture: Texture, texel: Texel, real: np.dtype) -> float:
    """Return the first channel of a texel, or of the border colour."""
    cells, border, unit = texels_of(texel.image, texture.sampler, np.dtype(real))
    return fetch(cells, texel.image.width, border, unit, texel.column, texel.row, RED)
