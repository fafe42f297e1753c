"""State of lighting and fog: lights, materials, the light model."""

from __future__ import annotations

from dataclasses import dataclass, fields

from softshadow import tokens as gl
from softshadow.state.common import BLACK, WHITE, Color, numbers, printed_calls, switch
from softshadow.tokens import token_name


@dataclass(frozen=True)
class LightState:
    """One light source; position and spot direction are in eye space, as GL stores them."""

    enabled: bool = False
    ambient: Color = BLACK
    diffuse: Color = BLACK
    specular: Color = BLACK
    position: Color = (0.0, 0.0, 1.0, 0.0)
    spot_direction: tuple[float, float, float] = (0.0, 0.0, -1.0)
    spot_exponent: float = 0.0
    spot_cutoff: float = 180.0
    constant_attenuation: float = 1.0
    linear_attenuation: float = 0.0
    quadratic_attenuation: float = 0.0

    def calls(self, index: int) -> list[str]:
        """Return the GL calls that make this state."""
        name = f"GL_LIGHT{index}"
        calls = [switch(name, self.enabled)]
        for parameter in fields(self)[1:]:
            value, initial = getattr(self, parameter.name), getattr(INITIAL_LIGHTS[index], parameter.name)
            if value != initial:
                arguments = f"({numbers(*value)})" if isinstance(value, tuple) else f"{value:g}"
                suffix = "fv" if isinstance(value, tuple) else "f"
                calls.append(f"glLight{suffix}({name}, GL_{parameter.name.upper()}, {arguments})")
        return calls


@dataclass(frozen=True)
class MaterialState:
    """State of glMaterial for one side."""

    ambient: Color = (0.2, 0.2, 0.2, 1.0)
    diffuse: Color = (0.8, 0.8, 0.8, 1.0)
    specular: Color = BLACK
    emission: Color = BLACK
    shininess: float = 0.0

    def calls(self, face: str) -> list[str]:
        """Return the GL calls that make this state."""
        colors = ("ambient", "diffuse", "specular", "emission")
        calls = [f"glMaterialfv({face}, GL_{c.upper()}, ({numbers(*getattr(self, c))}))" for c in colors]
        return [*calls, f"glMaterialf({face}, GL_SHININESS, {self.shininess:g})"]


LAST_VERTEX = gl.GL_LAST_VERTEX_CONVENTION
INITIAL_LIGHTS = (LightState(diffuse=WHITE, specular=WHITE), *(LightState() for _ in range(7)))


@dataclass(frozen=True, repr=False)
class Lighting:
    """Lights, light model, materials and shade model."""

    enabled: bool = False
    lights: tuple[LightState, ...] = INITIAL_LIGHTS
    model_ambient: Color = (0.2, 0.2, 0.2, 1.0)
    local_viewer: bool = False
    two_side: bool = False
    color_control: int = gl.GL_SINGLE_COLOR
    front: MaterialState = MaterialState()
    back: MaterialState = MaterialState()
    color_material: bool = False
    color_material_face: int = gl.GL_FRONT_AND_BACK
    color_material_mode: int = gl.GL_AMBIENT_AND_DIFFUSE
    normalize: bool = False
    rescale_normal: bool = False
    shade_model: int = gl.GL_SMOOTH
    provoking_vertex: int = gl.GL_LAST_VERTEX_CONVENTION

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        calls = [switch("GL_LIGHTING", self.enabled), f"glShadeModel({token_name(self.shade_model)})"]
        calls += (
            [f"glProvokingVertex({token_name(self.provoking_vertex)})"] if self.provoking_vertex != LAST_VERTEX else []
        )
        for index, light in enumerate(self.lights):
            if light != INITIAL_LIGHTS[index]:
                calls += light.calls(index)
        calls += [
            f"glLightModelfv(GL_LIGHT_MODEL_AMBIENT, ({numbers(*self.model_ambient)}))",
            f"glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, {int(self.local_viewer)})",
            f"glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, {int(self.two_side)})",
            f"glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, {token_name(self.color_control)})",
        ]
        if self.front == self.back:
            calls += self.front.calls("GL_FRONT_AND_BACK")
        else:
            calls += self.front.calls("GL_FRONT") + self.back.calls("GL_BACK")
        return [
            *calls,
            f"glColorMaterial({token_name(self.color_material_face)}, {token_name(self.color_material_mode)})",
            switch("GL_COLOR_MATERIAL", self.color_material),
            switch("GL_NORMALIZE", self.normalize),
            switch("GL_RESCALE_NORMAL", self.rescale_normal),
        ]


@dataclass(frozen=True, repr=False)
class Fog:
    """State of glFog, GL_FOG and GL_COLOR_SUM.

    `source` says whether fog depends on GL_FRAGMENT_DEPTH, the distance, or on the GL_FOG_COORD of the vertices.
    """

    enabled: bool = False
    mode: int = gl.GL_EXP
    density: float = 1.0
    start: float = 0.0
    end: float = 1.0
    color: Color = (0.0, 0.0, 0.0, 0.0)
    source: int = gl.GL_FRAGMENT_DEPTH
    color_sum: bool = False

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [
            switch("GL_FOG", self.enabled),
            f"glFogi(GL_FOG_MODE, {token_name(self.mode)})",
            f"glFogf(GL_FOG_DENSITY, {self.density:g})",
            f"glFogf(GL_FOG_START, {self.start:g})",
            f"glFogf(GL_FOG_END, {self.end:g})",
            f"glFogfv(GL_FOG_COLOR, ({numbers(*self.color)}))",
            f"glFogi(GL_FOG_COORD_SRC, {token_name(self.source)})",
            switch("GL_COLOR_SUM", self.color_sum),
        ]
