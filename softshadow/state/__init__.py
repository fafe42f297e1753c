"""The state of a GL context as frozen dataclasses: defaults are GL's initial values, enums are GL's tokens.

Change it with `frozen.evolve`; keep a reference to save it. Every group prints as the GL calls that set it.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

from softshadow.state.common import BLACK, WHITE, Color, printed_calls
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
from softshadow.state.lighting import INITIAL_LIGHTS, Fog, Lighting, LightState, MaterialState
from softshadow.state.rasterization import ClipPlanes, Cull, Lines, Points, Polygon, Scissor, Viewport
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
    "LightState",
    "Lighting",
    "Lines",
    "MaterialState",
    "Points",
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


@dataclass(frozen=True, repr=False)
class State:
    """The state that draws depend on, except matrices, current vertex attributes and contents of bound objects."""

    viewport: Viewport = Viewport()
    scissor: Scissor = Scissor()
    alpha: AlphaTest = AlphaTest()
    stencil: Stencil = Stencil()
    depth: Depth = Depth()
    cull: Cull = Cull()
    polygon: Polygon = Polygon()
    lines: Lines = Lines()
    points: Points = Points()
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

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that set the groups which differ from GL's initial state."""
        initial_state, calls = State(), []
        for group in fields(self):
            value, initial = getattr(self, group.name), getattr(initial_state, group.name)
            if value == initial:
                continue
            if group.name == "units":
                for index, unit in enumerate(self.units):
                    if unit != initial[index]:
                        calls += unit.calls(index)
            elif group.name == "program":
                calls.append(f"glUseProgram({value})")
            elif group.name.endswith("framebuffer"):
                calls.append(f"glBindFramebuffer(GL_{group.name.upper()}, {value})")
            else:
                initial_calls = set(initial.calls())
                calls += [call for call in value.calls() if call not in initial_calls]
        return calls
