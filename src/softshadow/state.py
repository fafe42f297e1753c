"""The state of a GL context as frozen values: defaults are GL's initial values, numbers are GL's own tokens.

A change is `frozen.replace`, a snapshot is a reference. Every group prints as the GL calls that make it.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields

from softshadow import tokens as gl
from softshadow.tokens import token_name

Color = tuple[float, float, float, float]
BLACK: Color = (0.0, 0.0, 0.0, 1.0)
WHITE: Color = (1.0, 1.0, 1.0, 1.0)
ALL_BITS = 0xFF  # masks start with every bit that a stencil buffer can have

STENCIL_OPS = ("GL_KEEP", "GL_ZERO", "GL_REPLACE", "GL_INCR", "GL_DECR", "GL_INVERT", "GL_INCR_WRAP", "GL_DECR_WRAP")
BLEND_FACTORS = ("GL_ZERO", "GL_ONE")


def _switch(capability: str, on: bool) -> str:
    return f"{'glEnable' if on else 'glDisable'}({capability})"


def _numbers(*values: float) -> str:
    return ", ".join(f"{v:g}" for v in values)


@dataclass(frozen=True)
class Viewport:
    """glViewport and glDepthRange. Pixels; y counts from the bottom."""

    x: int = 0
    y: int = 0
    width: int = 0
    height: int = 0
    near: float = 0.0
    far: float = 1.0

    def calls(self) -> list[str]:
        return [
            f"glViewport({self.x}, {self.y}, {self.width}, {self.height})",
            f"glDepthRange({_numbers(self.near, self.far)})",
        ]


@dataclass(frozen=True)
class Scissor:
    """GL_SCISSOR_TEST and glScissor. Pixels; y counts from the bottom."""

    enabled: bool = False
    x: int = 0
    y: int = 0
    width: int = 0
    height: int = 0

    def calls(self) -> list[str]:
        return [
            _switch("GL_SCISSOR_TEST", self.enabled),
            f"glScissor({self.x}, {self.y}, {self.width}, {self.height})",
        ]


@dataclass(frozen=True)
class AlphaTest:
    enabled: bool = False
    func: int = gl.GL_ALWAYS
    ref: float = 0.0

    def calls(self) -> list[str]:
        return [_switch("GL_ALPHA_TEST", self.enabled), f"glAlphaFunc({token_name(self.func)}, {self.ref:g})"]


@dataclass(frozen=True)
class StencilFace:
    """What glStencilFunc, glStencilOp and glStencilMask set for one facing."""

    func: int = gl.GL_ALWAYS
    ref: int = 0
    read_mask: int = ALL_BITS
    sfail: int = gl.GL_KEEP
    zfail: int = gl.GL_KEEP
    zpass: int = gl.GL_KEEP
    write_mask: int = ALL_BITS

    def calls(self, face: str = "") -> list[str]:
        suffix, first = ("Separate", f"{face}, ") if face else ("", "")
        ops = ", ".join(token_name(op, STENCIL_OPS) for op in (self.sfail, self.zfail, self.zpass))
        return [
            f"glStencilFunc{suffix}({first}{token_name(self.func)}, {self.ref}, 0x{self.read_mask & 0xFF:02X})",
            f"glStencilOp{suffix}({first}{ops})",
            f"glStencilMask{suffix}({first}0x{self.write_mask & 0xFF:02X})",
        ]


@dataclass(frozen=True)
class Stencil:
    """Stencil test of both facings, and the clear value.

    There are two back states: GL 2.0's, and that of GL_EXT_stencil_two_side. `back` is the one in use, that of the
    extension where `two_side`; `other_back` is the other one. `active_back` is what glActiveStencilFaceEXT sets.
    """

    enabled: bool = False
    front: StencilFace = StencilFace()
    back: StencilFace = StencilFace()
    clear: int = 0
    two_side: bool = False
    active_back: bool = False
    other_back: StencilFace = StencilFace()

    def calls(self) -> list[str]:
        if self.two_side:
            both = ["glActiveStencilFaceEXT(GL_FRONT)", *self.front.calls()]
            both += ["glActiveStencilFaceEXT(GL_BACK)", *self.back.calls()]
            faces = ["glEnable(GL_STENCIL_TEST_TWO_SIDE_EXT)", *both]
        elif self.front == self.back:
            faces = self.front.calls()
        else:
            faces = self.front.calls("GL_FRONT") + self.back.calls("GL_BACK")
        return [_switch("GL_STENCIL_TEST", self.enabled), *faces, f"glClearStencil({self.clear})"]


@dataclass(frozen=True)
class Depth:
    """Depth test, write mask, clear value and GL_DEPTH_CLAMP."""

    enabled: bool = False
    func: int = gl.GL_LESS
    write: bool = True
    clear: float = 1.0
    clamp: bool = False

    def calls(self) -> list[str]:
        return [
            _switch("GL_DEPTH_TEST", self.enabled),
            f"glDepthFunc({token_name(self.func)})",
            f"glDepthMask({'GL_TRUE' if self.write else 'GL_FALSE'})",
            _switch("GL_DEPTH_CLAMP", self.clamp),
            f"glClearDepth({self.clear:g})",
        ]


@dataclass(frozen=True)
class Cull:
    enabled: bool = False
    face: int = gl.GL_BACK
    front_face: int = gl.GL_CCW

    def calls(self) -> list[str]:
        return [
            _switch("GL_CULL_FACE", self.enabled),
            f"glCullFace({token_name(self.face)})",
            f"glFrontFace({token_name(self.front_face)})",
        ]


@dataclass(frozen=True)
class Polygon:
    """Polygon mode, polygon offset, and the sizes of lines and points."""

    mode_front: int = gl.GL_FILL
    mode_back: int = gl.GL_FILL
    offset_fill: bool = False
    offset_line: bool = False
    offset_point: bool = False
    factor: float = 0.0
    units: float = 0.0
    line_width: float = 1.0
    point_size: float = 1.0

    def calls(self) -> list[str]:
        return [
            f"glPolygonMode(GL_FRONT, {token_name(self.mode_front)})",
            f"glPolygonMode(GL_BACK, {token_name(self.mode_back)})",
            _switch("GL_POLYGON_OFFSET_FILL", self.offset_fill),
            _switch("GL_POLYGON_OFFSET_LINE", self.offset_line),
            _switch("GL_POLYGON_OFFSET_POINT", self.offset_point),
            f"glPolygonOffset({_numbers(self.factor, self.units)})",
            f"glLineWidth({self.line_width:g})",
            f"glPointSize({self.point_size:g})",
        ]


@dataclass(frozen=True)
class Blend:
    enabled: bool = False
    src_rgb: int = gl.GL_ONE
    dst_rgb: int = gl.GL_ZERO
    src_alpha: int = gl.GL_ONE
    dst_alpha: int = gl.GL_ZERO
    equation_rgb: int = gl.GL_FUNC_ADD
    equation_alpha: int = gl.GL_FUNC_ADD
    color: Color = (0.0, 0.0, 0.0, 0.0)
    logic_enabled: bool = False
    logic_op: int = gl.GL_COPY

    def calls(self) -> list[str]:
        factors = (self.src_rgb, self.dst_rgb, self.src_alpha, self.dst_alpha)
        return [
            _switch("GL_BLEND", self.enabled),
            f"glBlendFuncSeparate({', '.join(token_name(f, BLEND_FACTORS) for f in factors)})",
            f"glBlendEquationSeparate({token_name(self.equation_rgb)}, {token_name(self.equation_alpha)})",
            f"glBlendColor({_numbers(*self.color)})",
            _switch("GL_COLOR_LOGIC_OP", self.logic_enabled),
            f"glLogicOp({token_name(self.logic_op)})",
        ]


@dataclass(frozen=True)
class ColorBuffer:
    """Colour mask and clear colours.

    GL_DITHER and GL_MULTISAMPLE are on in GL; at 8 bits, and with one sample a pixel, they are without effect.
    """

    mask: tuple[bool, bool, bool, bool] = (True, True, True, True)
    clear: Color = (0.0, 0.0, 0.0, 0.0)
    clear_accum: Color = (0.0, 0.0, 0.0, 0.0)
    dither: bool = True
    multisample: bool = True

    def calls(self) -> list[str]:
        return [
            f"glColorMask({', '.join('GL_TRUE' if on else 'GL_FALSE' for on in self.mask)})",
            f"glClearColor({_numbers(*self.clear)})",
            f"glClearAccum({_numbers(*self.clear_accum)})",
            _switch("GL_DITHER", self.dither),
            _switch("GL_MULTISAMPLE", self.multisample),
        ]


@dataclass(frozen=True)
class Light:
    """One light source; position and spot direction are in eye space, as GL keeps them."""

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
        name = f"GL_LIGHT{index}"
        made = [_switch(name, self.enabled)]
        for parameter in fields(self)[1:]:
            value, initial = getattr(self, parameter.name), getattr(INITIAL_LIGHTS[index], parameter.name)
            if value != initial:
                numbers = f"({_numbers(*value)})" if isinstance(value, tuple) else f"{value:g}"
                suffix = "fv" if isinstance(value, tuple) else "f"
                made.append(f"glLight{suffix}({name}, GL_{parameter.name.upper()}, {numbers})")
        return made


@dataclass(frozen=True)
class Material:
    ambient: Color = (0.2, 0.2, 0.2, 1.0)
    diffuse: Color = (0.8, 0.8, 0.8, 1.0)
    specular: Color = BLACK
    emission: Color = BLACK
    shininess: float = 0.0

    def calls(self, face: str) -> list[str]:
        colors = ("ambient", "diffuse", "specular", "emission")
        made = [f"glMaterialfv({face}, GL_{c.upper()}, ({_numbers(*getattr(self, c))}))" for c in colors]
        return [*made, f"glMaterialf({face}, GL_SHININESS, {self.shininess:g})"]


INITIAL_LIGHTS = (Light(diffuse=WHITE, specular=WHITE), *(Light() for _ in range(7)))


@dataclass(frozen=True)
class Lighting:
    """Lights, light model, materials and shade model."""

    enabled: bool = False
    lights: tuple[Light, ...] = INITIAL_LIGHTS
    model_ambient: Color = (0.2, 0.2, 0.2, 1.0)
    local_viewer: bool = False
    two_side: bool = False
    color_control: int = gl.GL_SINGLE_COLOR
    front: Material = Material()
    back: Material = Material()
    color_material: bool = False
    color_material_face: int = gl.GL_FRONT_AND_BACK
    color_material_mode: int = gl.GL_AMBIENT_AND_DIFFUSE
    normalize: bool = False
    rescale_normal: bool = False
    shade_model: int = gl.GL_SMOOTH

    def calls(self) -> list[str]:
        made = [_switch("GL_LIGHTING", self.enabled), f"glShadeModel({token_name(self.shade_model)})"]
        for index, light in enumerate(self.lights):
            if light != INITIAL_LIGHTS[index]:
                made += light.calls(index)
        made += [
            f"glLightModelfv(GL_LIGHT_MODEL_AMBIENT, ({_numbers(*self.model_ambient)}))",
            f"glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, {int(self.local_viewer)})",
            f"glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, {int(self.two_side)})",
            f"glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, {token_name(self.color_control)})",
        ]
        if self.front == self.back:
            made += self.front.calls("GL_FRONT_AND_BACK")
        else:
            made += self.front.calls("GL_FRONT") + self.back.calls("GL_BACK")
        return [
            *made,
            f"glColorMaterial({token_name(self.color_material_face)}, {token_name(self.color_material_mode)})",
            _switch("GL_COLOR_MATERIAL", self.color_material),
            _switch("GL_NORMALIZE", self.normalize),
            _switch("GL_RESCALE_NORMAL", self.rescale_normal),
        ]


@dataclass(frozen=True)
class TexGen:
    """Generation of one texture coordinate; the eye plane is kept as GL keeps it, times the inverse modelview."""

    enabled: bool = False
    mode: int = gl.GL_EYE_LINEAR
    object_plane: Color = (0.0, 0.0, 0.0, 0.0)
    eye_plane: Color = (0.0, 0.0, 0.0, 0.0)


def _initial_gen() -> tuple[TexGen, TexGen, TexGen, TexGen]:
    planes = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))
    s, t, r, q = (TexGen(object_plane=p, eye_plane=p) for p in planes)
    return s, t, r, q


@dataclass(frozen=True)
class Combine:
    """What GL_COMBINE does: functions, sources and operands of up to three arguments, scales; for RGB and alpha."""

    mode_rgb: int = gl.GL_MODULATE
    mode_alpha: int = gl.GL_MODULATE
    sources_rgb: tuple[int, int, int] = (gl.GL_TEXTURE, gl.GL_PREVIOUS, gl.GL_CONSTANT)
    sources_alpha: tuple[int, int, int] = (gl.GL_TEXTURE, gl.GL_PREVIOUS, gl.GL_CONSTANT)
    operands_rgb: tuple[int, int, int] = (gl.GL_SRC_COLOR, gl.GL_SRC_COLOR, gl.GL_SRC_ALPHA)
    operands_alpha: tuple[int, int, int] = (gl.GL_SRC_ALPHA, gl.GL_SRC_ALPHA, gl.GL_SRC_ALPHA)
    rgb_scale: float = 1.0
    alpha_scale: float = 1.0

    def calls(self) -> list[str]:
        made = [f"GL_COMBINE_RGB, {token_name(self.mode_rgb)}", f"GL_COMBINE_ALPHA, {token_name(self.mode_alpha)}"]
        for part in ("rgb", "alpha"):
            for kind in ("source", "operand"):
                values = getattr(self, f"{kind}s_{part}")
                made += [f"GL_{kind.upper()}{i}_{part.upper()}, {token_name(v)}" for i, v in enumerate(values)]
        made += [f"GL_RGB_SCALE, {self.rgb_scale:g}", f"GL_ALPHA_SCALE, {self.alpha_scale:g}"]
        return [f"glTexEnvf(GL_TEXTURE_ENV, {setting})" for setting in made]


@dataclass(frozen=True)
class TextureUnit:
    """What one texture unit does: enabled targets, bound names, environment, coordinate generation."""

    enabled_2d: bool = False
    enabled_cube: bool = False
    bound_2d: int = 0
    bound_cube: int = 0
    env_mode: int = gl.GL_MODULATE
    env_color: Color = (0.0, 0.0, 0.0, 0.0)
    combine: Combine = Combine()
    lod_bias: float = 0.0
    gen: tuple[TexGen, TexGen, TexGen, TexGen] = field(default_factory=_initial_gen)

    def calls(self, index: int) -> list[str]:
        made = [
            f"glActiveTexture(GL_TEXTURE{index})",
            _switch("GL_TEXTURE_2D", self.enabled_2d),
            f"glBindTexture(GL_TEXTURE_2D, {self.bound_2d})",
            _switch("GL_TEXTURE_CUBE_MAP", self.enabled_cube),
            f"glBindTexture(GL_TEXTURE_CUBE_MAP, {self.bound_cube})",
            f"glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, {token_name(self.env_mode)})",
            f"glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, ({_numbers(*self.env_color)}))",
        ]
        if self.env_mode == gl.GL_COMBINE:
            made += self.combine.calls()
        if self.lod_bias:
            made.append(f"glTexEnvf(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, {self.lod_bias:g})")
        for name, gen in zip("STRQ", self.gen, strict=True):
            if gen.enabled:
                made.append(f"glTexGeni(GL_{name}, GL_TEXTURE_GEN_MODE, {token_name(gen.mode)})")
                if gen.mode == gl.GL_OBJECT_LINEAR:
                    made.append(f"glTexGenfv(GL_{name}, GL_OBJECT_PLANE, ({_numbers(*gen.object_plane)}))")
                elif gen.mode == gl.GL_EYE_LINEAR:
                    made.append(f"glTexGenfv(GL_{name}, GL_EYE_PLANE, ({_numbers(*gen.eye_plane)}))")
                made.append(_switch(f"GL_TEXTURE_GEN_{name}", True))
        return made


@dataclass(frozen=True)
class CubeMaps:
    """Whether linear filters of all cube maps go on over the edges of the faces."""

    seamless: bool = False

    def calls(self) -> list[str]:
        return [_switch("GL_TEXTURE_CUBE_MAP_SEAMLESS", self.seamless)]


@dataclass(frozen=True)
class Fog:
    enabled: bool = False
    mode: int = gl.GL_EXP
    density: float = 1.0
    start: float = 0.0
    end: float = 1.0
    color: Color = (0.0, 0.0, 0.0, 0.0)

    def calls(self) -> list[str]:
        return [
            _switch("GL_FOG", self.enabled),
            f"glFogi(GL_FOG_MODE, {token_name(self.mode)})",
            f"glFogf(GL_FOG_DENSITY, {self.density:g})",
            f"glFogf(GL_FOG_START, {self.start:g})",
            f"glFogf(GL_FOG_END, {self.end:g})",
            f"glFogfv(GL_FOG_COLOR, ({_numbers(*self.color)}))",
        ]


@dataclass(frozen=True)
class ClipPlanes:
    """User clip planes in eye space, as GL keeps them."""

    enabled: tuple[bool, ...] = (False,) * 6
    equations: tuple[Color, ...] = ((0.0, 0.0, 0.0, 0.0),) * 6

    def calls(self) -> list[str]:
        return [
            call
            for i, (on, plane) in enumerate(zip(self.enabled, self.equations, strict=True))
            if on
            for call in (f"glClipPlane(GL_CLIP_PLANE{i}, ({_numbers(*plane)}))", _switch(f"GL_CLIP_PLANE{i}", True))
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
