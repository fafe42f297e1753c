"""Pixel transfer: what glPixelTransfer and glPixelMap do to pixels on their way between client memory and buffers.

All arithmetic is Mesa's, in float32: a product, then a sum; maps are looked up at the nearest entry.

References: GL 2.1, sec. 3.6.3, 3.6.5; pixeltransfer.c of Mesa 22.3.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from softshadow import tokens as gl

F32 = np.float32
TOO_LARGE = F32(2**31)
LARGEST_MAP = 256  # entries
COLOR_MAPS = (gl.GL_PIXEL_MAP_R_TO_R, gl.GL_PIXEL_MAP_G_TO_G, gl.GL_PIXEL_MAP_B_TO_B, gl.GL_PIXEL_MAP_A_TO_A)
INDEX_MAPS = (gl.GL_PIXEL_MAP_I_TO_R, gl.GL_PIXEL_MAP_I_TO_G, gl.GL_PIXEL_MAP_I_TO_B, gl.GL_PIXEL_MAP_I_TO_A)
INTEGER_MAPS = (gl.GL_PIXEL_MAP_I_TO_I, gl.GL_PIXEL_MAP_S_TO_S)
MAPS = (*INTEGER_MAPS, *INDEX_MAPS, *COLOR_MAPS)
LARGEST_UINT = 2**32 - 1
UNCHANGED = (1.0, 0.0)  # scale and bias


def _initial_maps() -> Mapping[int, np.ndarray]:
    return {name: np.zeros(1, F32) for name in MAPS}


@dataclass(frozen=True)
class PixelTransfer:
    """The state of glPixelTransfer and the tables of glPixelMap; defaults are GL's initial values.

    scales : (scale, bias) of red, green, blue and alpha
    maps : float32 tables by the token of glPixelMap
    """

    scales: tuple[tuple[float, float], ...] = (UNCHANGED,) * 4
    depth: tuple[float, float] = UNCHANGED
    index_shift: int = 0
    index_offset: int = 0
    map_color: bool = False
    map_stencil: bool = False
    maps: Mapping[int, np.ndarray] = field(default_factory=_initial_maps, compare=False, repr=False)

    @property
    def changes_color(self) -> bool:
        """Whether colours are changed."""
        return self.map_color or self.scales != (UNCHANGED,) * 4

    @property
    def through_floats(self) -> bool:
        """Whether Mesa converts colours to floats on the way, although shift and offset do not change them."""
        return self.changes_color or self.changes_index

    @property
    def changes_depth(self) -> bool:
        """Whether depths are changed."""
        return self.depth != UNCHANGED

    @property
    def changes_stencil(self) -> bool:
        """Whether stencil values are changed."""
        return self.map_stencil or self.changes_index

    @property
    def changes_index(self) -> bool:
        """Whether indices are shifted or moved."""
        return self.index_shift != 0 or self.index_offset != 0

    def scaled(self, rgba: np.ndarray) -> np.ndarray:
        """Return colours (..., 4) float32 after scale and bias."""
        out = rgba.astype(F32)
        with np.errstate(all="ignore"):
            for channel, (scale, bias) in enumerate(self.scales):
                if (scale, bias) != UNCHANGED:
                    out[..., channel] = out[..., channel] * F32(scale) + F32(bias)
        return out

    def color(self, rgba: np.ndarray) -> np.ndarray:
        """Return colours (..., 4) float32 after scale, bias and maps."""
        out = self.scaled(rgba)
        if self.map_color:
            for channel, name in enumerate(COLOR_MAPS):
                table = self.maps[name]
                place = np.rint(np.fmax(out[..., channel], F32(0)).clip(0, 1) * F32(len(table) - 1))
                out[..., channel] = table[place.astype(np.int64)]
        return out

    def drawn_color(self, rgba: np.ndarray) -> np.ndarray:
        """Return colours (h, w, 4) float32 of glDrawPixels and glCopyPixels, rows in the order of Mesa's texture.

        Mesa looks red and green up in a texture of 256 x 256 entries of 8 bits, into which it stretches the maps. Blue
        and alpha it takes, by mistake, from red and green of the image itself, at the place (blue, alpha).
        """
        out = self.scaled(rgba)
        if self.map_color:
            row, column = (_nearest(out[..., channel], size) for channel, size in ((3, len(out)), (2, out.shape[1])))
            for channel, name in enumerate(COLOR_MAPS[:2]):
                table = self.maps[name]
                entries = table[np.arange(LARGEST_MAP) * len(table) // LARGEST_MAP]
                bytes_of_entries = np.rint(entries * F32(255)).astype(F32)
                place = _nearest(out[..., channel], LARGEST_MAP)
                out[..., channel] = bytes_of_entries[place] * (F32(1) / F32(255))
            out[..., 2:] = rgba[row, column, :2]
        return out

    def scaled_depth(self, z: np.ndarray) -> np.ndarray:
        """Return depths float32 after scale and bias, clamped to [0, 1]."""
        scale, bias = self.depth
        return np.clip(z * F32(scale) + F32(bias), F32(0), F32(1))

    def scaled_depth_units(self, units: np.ndarray) -> np.ndarray:
        """Return depths of 32 bits, float64, after scale and bias in double precision, as whole numbers."""
        scale, bias = self.depth
        scaled: np.ndarray = np.floor(np.clip(units * scale + bias * LARGEST_UINT, 0.0, LARGEST_UINT))
        return scaled

    def shifted(self, indices: np.ndarray) -> np.ndarray:
        """Return indices int64 after shift and offset, modulo 2**32."""
        shift = self.index_shift
        moved = indices << min(shift, 63) if shift > 0 else indices >> min(-shift, 63)
        shifted: np.ndarray = (moved + self.index_offset) & 0xFFFFFFFF
        return shifted

    def uploaded_stencil(self, indices: np.ndarray) -> np.ndarray:
        """Return client indices int64 as stencil values uint8."""
        if self.changes_index:
            indices = self.shifted(indices)
        return self._mapped(indices)

    def read_stencil(self, values: np.ndarray) -> np.ndarray:
        """Return stencil values uint8 on their way to the client."""
        if self.changes_index:
            values = self.shifted(values.astype(np.int64)).astype(np.uint8)
        return self._mapped(values)

    def _mapped(self, indices: np.ndarray) -> np.ndarray:
        if self.map_stencil:
            table = self.maps[gl.GL_PIXEL_MAP_S_TO_S]
            indices = table[indices.astype(np.int64) & (len(table) - 1)].astype(np.int64)
        return indices.astype(np.uint8)

    def indexed_color(self, indices: np.ndarray) -> np.ndarray:
        """Return the colours (..., 4) float32 of colour indices int64."""
        tables = [self.maps[name] for name in INDEX_MAPS]
        return np.stack([table[indices & (len(table) - 1)] for table in tables], axis=-1)


def _nearest(coordinate: np.ndarray, size: int) -> np.ndarray:
    """Return the index of the nearest of `size` texels, clamped to the edge.

    What is too large for an integer of 32 bits becomes its lowest one where llvmpipe converts it, and so texel 0.
    """
    with np.errstate(all="ignore"):
        scaled = np.trunc(coordinate * F32(size))
        place = np.fmin(np.fmax(scaled, 0), size - 1).astype(np.int64)
    return np.where(scaled >= TOO_LARGE, 0, place)
