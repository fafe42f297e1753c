"""State of texture units: bound textures, combiners, generated coordinates; and seamless cube maps."""

from __future__ import annotations

from dataclasses import dataclass, field

from softshadow import tokens as gl
from softshadow.state.common import Color, numbers, printed_calls, switch
from softshadow.tokens import token_name

OF_PROGRAMS = (gl.GL_TEXTURE_CUBE_MAP, gl.GL_TEXTURE_2D)

TARGETS = {  # of textures, and what the fields of `TextureUnit` call them; a unit samples the first that is enabled
    gl.GL_TEXTURE_CUBE_MAP: "cube",
    gl.GL_TEXTURE_3D: "3d",
    gl.GL_TEXTURE_RECTANGLE: "rectangle",
    gl.GL_TEXTURE_2D: "2d",
    gl.GL_TEXTURE_1D: "1d",
}
BINDINGS = {target: f"bound_{name}" for target, name in TARGETS.items()}
SWITCHES = {target: f"enabled_{name}" for target, name in TARGETS.items()}
SHOWN = ((gl.GL_TEXTURE_2D, "GL_TEXTURE_2D"), (gl.GL_TEXTURE_CUBE_MAP, "GL_TEXTURE_CUBE_MAP"))
SHOWN_IN_USE = (
    (gl.GL_TEXTURE_1D, "GL_TEXTURE_1D"),
    (gl.GL_TEXTURE_RECTANGLE, "GL_TEXTURE_RECTANGLE"),
    (gl.GL_TEXTURE_3D, "GL_TEXTURE_3D"),
)


@dataclass(frozen=True)
class TexGen:
    """Generation of one texture coordinate; the eye plane is stored multiplied by the inverse modelview matrix."""

    enabled: bool = False
    mode: int = gl.GL_EYE_LINEAR
    object_plane: Color = (0.0, 0.0, 0.0, 0.0)
    eye_plane: Color = (0.0, 0.0, 0.0, 0.0)


def _initial_gen() -> tuple[TexGen, TexGen, TexGen, TexGen]:
    planes = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))
    s, t, r, q = (TexGen(object_plane=p, eye_plane=p) for p in planes)
    return s, t, r, q


@dataclass(frozen=True, repr=False)
class Combine:
    """State of GL_COMBINE for RGB and alpha: function, sources and operands of up to three arguments, scale."""

    mode_rgb: int = gl.GL_MODULATE
    mode_alpha: int = gl.GL_MODULATE
    sources_rgb: tuple[int, int, int] = (gl.GL_TEXTURE, gl.GL_PREVIOUS, gl.GL_CONSTANT)
    sources_alpha: tuple[int, int, int] = (gl.GL_TEXTURE, gl.GL_PREVIOUS, gl.GL_CONSTANT)
    operands_rgb: tuple[int, int, int] = (gl.GL_SRC_COLOR, gl.GL_SRC_COLOR, gl.GL_SRC_ALPHA)
    operands_alpha: tuple[int, int, int] = (gl.GL_SRC_ALPHA, gl.GL_SRC_ALPHA, gl.GL_SRC_ALPHA)
    rgb_scale: float = 1.0
    alpha_scale: float = 1.0

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        settings = [f"GL_COMBINE_RGB, {token_name(self.mode_rgb)}", f"GL_COMBINE_ALPHA, {token_name(self.mode_alpha)}"]
        for part in ("rgb", "alpha"):
            for kind in ("source", "operand"):
                values = getattr(self, f"{kind}s_{part}")
                settings += [f"GL_{kind.upper()}{i}_{part.upper()}, {token_name(v)}" for i, v in enumerate(values)]
        settings += [f"GL_RGB_SCALE, {self.rgb_scale:g}", f"GL_ALPHA_SCALE, {self.alpha_scale:g}"]
        return [f"glTexEnvf(GL_TEXTURE_ENV, {setting})" for setting in settings]


@dataclass(frozen=True, repr=False)
class TextureUnit:
    """One texture unit: enabled targets, bound textures, environment, coordinate generation."""

    enabled_2d: bool = False
    enabled_cube: bool = False
    enabled_1d: bool = False
    enabled_rectangle: bool = False
    enabled_3d: bool = False
    bound_2d: int = 0
    bound_cube: int = 0
    bound_1d: int = 0
    bound_rectangle: int = 0
    bound_3d: int = 0
    env_mode: int = gl.GL_MODULATE
    env_color: Color = (0.0, 0.0, 0.0, 0.0)
    combine: Combine = Combine()
    lod_bias: float = 0.0
    gen: tuple[TexGen, TexGen, TexGen, TexGen] = field(default_factory=_initial_gen)

    def __repr__(self) -> str:
        return "\n".join(self.calls(0)[1:])  # a unit does not know its number

    def bound(self, target: int) -> int:
        """Return the name of the texture bound to a target."""
        return int(getattr(self, BINDINGS[target]))

    def enabled(self, target: int) -> bool:
        """Return whether a target is enabled."""
        return bool(getattr(self, SWITCHES[target]))

    @property
    def targets(self) -> tuple[int, ...]:
        """The enabled targets; the unit samples the first whose texture is complete."""
        if not (self.enabled_2d or self.enabled_cube or self.enabled_1d or self.enabled_rectangle or self.enabled_3d):
            return ()  # as in most units: draws ask all of them
        return tuple(target for target, field in SWITCHES.items() if getattr(self, field))

    @property
    def sampled_targets(self) -> tuple[int, ...]:
        """The targets whose textures a draw may sample: 2-D textures and cube maps, and others if they are enabled.

        Shading programs sample 2-D textures and cube maps, enabled or not.
        """
        if self.enabled_1d or self.enabled_rectangle or self.enabled_3d:
            return tuple(TARGETS)
        return OF_PROGRAMS

    def calls(self, index: int) -> list[str]:
        """Return the GL calls that make this state."""
        calls = [f"glActiveTexture(GL_TEXTURE{index})"]
        for target, name in (*SHOWN, *SHOWN_IN_USE):
            if (target, name) in SHOWN or self.enabled(target) or self.bound(target):
                calls += [switch(name, self.enabled(target)), f"glBindTexture({name}, {self.bound(target)})"]
        calls += [
            f"glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, {token_name(self.env_mode)})",
            f"glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, ({numbers(*self.env_color)}))",
        ]
        if self.env_mode == gl.GL_COMBINE:
            calls += self.combine.calls()
        if self.lod_bias:
            calls.append(f"glTexEnvf(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, {self.lod_bias:g})")
        for name, gen in zip("STRQ", self.gen, strict=True):
            if gen.enabled:
                calls.append(f"glTexGeni(GL_{name}, GL_TEXTURE_GEN_MODE, {token_name(gen.mode)})")
                if gen.mode == gl.GL_OBJECT_LINEAR:
                    calls.append(f"glTexGenfv(GL_{name}, GL_OBJECT_PLANE, ({numbers(*gen.object_plane)}))")
                elif gen.mode == gl.GL_EYE_LINEAR:
                    calls.append(f"glTexGenfv(GL_{name}, GL_EYE_PLANE, ({numbers(*gen.eye_plane)}))")
                calls.append(switch(f"GL_TEXTURE_GEN_{name}", True))
        return calls


@dataclass(frozen=True, repr=False)
class CubeMaps:
    """GL_TEXTURE_CUBE_MAP_SEAMLESS: whether linear filters read across the edges of a cube map's faces."""

    seamless: bool = False

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [switch("GL_TEXTURE_CUBE_MAP_SEAMLESS", self.seamless)]
