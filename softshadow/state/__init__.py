"""The state of a GL context as frozen values: defaults are GL's initial values, numbers are GL's own tokens.

A change is `frozen.replace`, a snapshot is a reference. Every group prints as the GL calls that make it.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

from softshadow.state.common import BLACK, WHITE, Color
from softshadow.state.fragments import (
    ALL_BITS,
    BLEND_FACTORS,
    STENCIL_OPS,
    AlphaTest,
    Blend,
    ColorBuffer,
    Depth,
    Stencil,
    StencilFace,
)
from softshadow.state.lighting import INITIAL_LIGHTS, Fog, Light, Lighting, Material
from softshadow.state.rasterization import ClipPlanes, Cull, Polygon, Scissor, Viewport
from softshadow.state.texturing import Combine, CubeMaps, TexGen, TextureUnit

__all__ = [
    "ALL_BITS",
    "BLACK",
    "BLEND_FACTORS",
    "INITIAL_LIGHTS",
    "STENCIL_OPS",
    "TEXTURE_UNITS",
    "WHITE",
    "AlphaTest",
    "Blend",
    "ClipPlanes",
    "Color",
    "ColorBuffer",
    "Combine",
    "CubeMaps",
    "Cull",
    "Depth",
    "Fog",
    "Light",
    "Lighting",
    "Material",
    "Polygon",
    "Scissor",
    "State",
    "Stencil",
    "StencilFace",
    "TexGen",
    "TextureUnit",
    "Viewport",
]

TEXTURE_UNITS = 8


@dataclass(frozen=True)
class State:
    """The whole state that a draw depends on, besides matrices, current vertex attributes and bound objects'
    contents."""

    viewport: Viewport = Viewport()
    scissor: Scissor = Scissor()
    alpha: AlphaTest = AlphaTest()
    stencil: Stencil = Stencil()
    depth: Depth = Depth()
    cull: Cull = Cull()
    polygon: Polygon = Polygon()
    blend: Blend = Blend()
    color: ColorBuffer = ColorBuffer()
    lighting: Lighting = Lighting()
    units: tuple[TextureUnit, ...] = (TextureUnit(),) * TEXTURE_UNITS
    cube_maps: CubeMaps = CubeMaps()
    fog: Fog = Fog()
    clip_planes: ClipPlanes = ClipPlanes()
    draw_framebuffer: int = 0
    read_framebuffer: int = 0
    program: int = 0

    def calls(self) -> list[str]:
        """Return the GL calls that make the groups which differ from GL's initial state."""
        initial, made = State(), []
        for group in fields(self):
            value, before = getattr(self, group.name), getattr(initial, group.name)
            if value == before:
                continue
            if group.name == "units":
                for index, unit in enumerate(self.units):
                    if unit != before[index]:
                        made += unit.calls(index)
            elif group.name == "program":
                made.append(f"glUseProgram({value})")
            elif group.name.endswith("framebuffer"):
                made.append(f"glBindFramebuffer(GL_{group.name.upper()}, {value})")
            else:
                standing = set(before.calls())
                made += [call for call in value.calls() if call not in standing]
        return made

    def __str__(self) -> str:
        return "\n".join(self.calls()) or "# GL's initial state"
