"""glEnable, glDisable, glIsEnabled and glHint."""

from __future__ import annotations

from typing import Any

from softshadow import tokens as gl
from softshadow.context import Context, thread
from softshadow.context.evaluators import COMPONENTS
from softshadow.context.state_groups import UNITS
from softshadow.frozen import evolve
from softshadow.gl.calls import in_lists, is_allowed, spelled_like_gl
from softshadow.gl.errors import is_one_of, outside_begin
from softshadow.gl.evaluator_maps import switch_map
from softshadow.gl.materials import start_to_follow
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.gl.vertex_arrays import CLIENT_STATES, is_array_enabled, switch_array
from softshadow.state import State
from softshadow.state.texturing import SWITCHES

# capability: (group of the state, field)
CAPABILITIES: dict[int, tuple[str, str]] = {
    gl.GL_SCISSOR_TEST: ("scissor", "enabled"),
    gl.GL_ALPHA_TEST: ("alpha", "enabled"),
    gl.GL_STENCIL_TEST: ("stencil", "enabled"),
    gl.GL_STENCIL_TEST_TWO_SIDE_EXT: ("stencil", "two_side"),
    gl.GL_DEPTH_TEST: ("depth", "enabled"),
    gl.GL_DEPTH_CLAMP: ("depth", "clamp"),
    gl.GL_CULL_FACE: ("cull", "enabled"),
    gl.GL_POLYGON_OFFSET_FILL: ("polygon", "offset_fill"),
    gl.GL_POLYGON_OFFSET_LINE: ("polygon", "offset_line"),
    gl.GL_POLYGON_OFFSET_POINT: ("polygon", "offset_point"),
    gl.GL_POLYGON_SMOOTH: ("polygon", "smooth"),
    gl.GL_POLYGON_STIPPLE: ("polygon", "stippled"),
    gl.GL_LINE_SMOOTH: ("lines", "smooth"),
    gl.GL_LINE_STIPPLE: ("lines", "stippled"),
    gl.GL_POINT_SMOOTH: ("points", "smooth"),
    gl.GL_POINT_SPRITE: ("points", "sprites"),
    gl.GL_BLEND: ("blend", "enabled"),
    gl.GL_COLOR_LOGIC_OP: ("blend", "logic_enabled"),
    gl.GL_DITHER: ("color", "dither"),
    gl.GL_MULTISAMPLE: ("color", "multisample"),
    gl.GL_SAMPLE_ALPHA_TO_COVERAGE: ("color", "alpha_to_coverage"),
    gl.GL_SAMPLE_ALPHA_TO_ONE: ("color", "alpha_to_one"),
    gl.GL_SAMPLE_COVERAGE: ("color", "sample_coverage"),
    gl.GL_LIGHTING: ("lighting", "enabled"),
    gl.GL_COLOR_MATERIAL: ("lighting", "color_material"),
    gl.GL_NORMALIZE: ("lighting", "normalize"),
    gl.GL_RESCALE_NORMAL: ("lighting", "rescale_normal"),
    gl.GL_FOG: ("fog", "enabled"),
    gl.GL_COLOR_SUM: ("fog", "color_sum"),
    gl.GL_TEXTURE_CUBE_MAP_SEAMLESS: ("cube_maps", "seamless"),
}
UNIT_CAPABILITIES = SWITCHES
TEXTURE_GENERATION = (gl.GL_TEXTURE_GEN_S, gl.GL_TEXTURE_GEN_T, gl.GL_TEXTURE_GEN_R, gl.GL_TEXTURE_GEN_Q)
LIGHTS = range(gl.GL_LIGHT0, gl.GL_LIGHT7 + 1)
CLIP_PLANES = range(gl.GL_CLIP_PLANE0, gl.GL_CLIP_PLANE5 + 1)
MAPS = {*COMPONENTS, gl.GL_AUTO_NORMAL}
KNOWN = {
    gl.GL_INDEX_LOGIC_OP,
    *MAPS,
    *CAPABILITIES,
    *UNIT_CAPABILITIES,
    *TEXTURE_GENERATION,
    *LIGHTS,
    *CLIP_PLANES,
    *CLIENT_STATES,
}
# those that only set one field of a group: (group in `Context.groups`, field)
PLACES = CAPABILITIES | {light: (f"lighting.lights.{index}", "enabled") for index, light in enumerate(LIGHTS)}
del PLACES[gl.GL_STENCIL_TEST_TWO_SIDE_EXT], PLACES[gl.GL_COLOR_MATERIAL]
A_CAPABILITY = "a capability of this subset"
HINTS = (
    gl.GL_PERSPECTIVE_CORRECTION_HINT, gl.GL_POINT_SMOOTH_HINT, gl.GL_LINE_SMOOTH_HINT, gl.GL_POLYGON_SMOOTH_HINT,
    gl.GL_FOG_HINT, gl.GL_TEXTURE_COMPRESSION_HINT, gl.GL_GENERATE_MIPMAP_HINT,
)  # fmt: skip


def glEnable(cap: int) -> None:
    """Enable a capability."""
    context = thread.context
    try:
        if context.ready or is_allowed(context, glEnable, cap):
            place = PLACES.get(cap)
            if place is not None:
                context.change_field(*place, True)
            elif _is_known("glEnable", cap):
                _switch_other(context, cap, True)
    except CONVERTING as error:
        raise refusal(glEnable, error, cap) from error


def glDisable(cap: int) -> None:
    """Disable a capability."""
    context = thread.context
    try:
        if context.ready or is_allowed(context, glDisable, cap):
            place = PLACES.get(cap)
            if place is not None:
                context.change_field(*place, False)
            elif _is_known("glDisable", cap):
                _switch_other(context, cap, False)
    except CONVERTING as error:
        raise refusal(glDisable, error, cap) from error


def _switch_other(context: Context, cap: int, on: bool) -> None:
    unit = context.active_unit
    if cap in CLIENT_STATES:  # accepted by Mesa, though GL has glEnableClientState for it
        switch_array(context.arrays, cap, on)
    elif cap in MAPS:
        switch_map(context, cap, on)
    elif cap == gl.GL_INDEX_LOGIC_OP:
        if context.color_indices.logic_enabled != on:
            context.flush()
            context.touched |= gl.GL_COLOR_BUFFER_BIT | gl.GL_ENABLE_BIT
            context.color_indices = evolve(context.color_indices, logic_enabled=on)
    elif cap in UNIT_CAPABILITIES:
        context.change_field(UNITS[unit], UNIT_CAPABILITIES[cap], on)
    elif cap in TEXTURE_GENERATION:
        gen, index = context.groups[UNITS[unit]].fields["gen"], TEXTURE_GENERATION.index(cap)
        if gen[index].enabled != on:
            context.change_field(UNITS[unit], "gen", with_item(gen, index, evolve(gen[index], enabled=on)))
    elif cap in CLIP_PLANES:
        enabled, index = context.groups["clip_planes"].fields["enabled"], cap - gl.GL_CLIP_PLANE0
        if enabled[index] != on:
            context.change_field("clip_planes", "enabled", with_item(enabled, index, on))
    elif is_on(context.drawn_state, cap, unit) != on:
        if cap == gl.GL_COLOR_MATERIAL:
            context.mark_materials()
        context.change_state(with_capability(context.state, cap, unit, on))
        if cap == gl.GL_COLOR_MATERIAL and on:
            start_to_follow(context)


def _is_known(operation: str, cap: int) -> bool:
    """Return whether a capability is known; otherwise the call fails."""
    return is_one_of(operation, "cap", cap, KNOWN, A_CAPABILITY)


def is_on(state: State, cap: int, unit: int) -> bool:
    """Return whether a known capability is enabled; `unit` is the texture unit, for texture capabilities."""
    if cap in CAPABILITIES:
        group, field = CAPABILITIES[cap]
        return bool(getattr(getattr(state, group), field))
    if cap in UNIT_CAPABILITIES:
        return bool(getattr(state.units[unit], UNIT_CAPABILITIES[cap]))
    if cap in TEXTURE_GENERATION:
        return state.units[unit].gen[TEXTURE_GENERATION.index(cap)].enabled
    if cap in LIGHTS:
        return state.lighting.lights[cap - gl.GL_LIGHT0].enabled
    return state.clip_planes.enabled[cap - gl.GL_CLIP_PLANE0]


def with_capability(state: State, cap: int, unit: int, on: bool) -> State:
    """Return the state with a known capability enabled or disabled."""
    if cap in CAPABILITIES:
        group, field = CAPABILITIES[cap]
        changed: Any = evolve(getattr(state, group), **{field: on})
        if cap == gl.GL_STENCIL_TEST_TWO_SIDE_EXT:
            changed = evolve(changed, back=changed.other_back, other_back=changed.back)
        return evolve(state, **{group: changed})
    if cap in LIGHTS:
        index = cap - gl.GL_LIGHT0
        lights = with_item(state.lighting.lights, index, evolve(state.lighting.lights[index], enabled=on))
        return evolve(state, lighting=evolve(state.lighting, lights=lights))
    if cap in CLIP_PLANES:
        enabled = with_item(state.clip_planes.enabled, cap - gl.GL_CLIP_PLANE0, on)
        return evolve(state, clip_planes=evolve(state.clip_planes, enabled=enabled))
    old = state.units[unit]
    if cap in UNIT_CAPABILITIES:
        field = UNIT_CAPABILITIES[cap]
        new = evolve(old, **{field: on})
    else:
        index = TEXTURE_GENERATION.index(cap)
        new = evolve(old, gen=with_item(old.gen, index, evolve(old.gen[index], enabled=on)))
    return evolve(state, units=with_item(state.units, unit, new))


def with_item(items: tuple[Any, ...], index: int, item: Any) -> Any:
    """Return a tuple with one item replaced."""
    return (*items[:index], item, *items[index + 1 :])


def glIsEnabled(cap: int) -> bool | None:
    """Return whether a capability is enabled."""
    context: Context | None = outside_begin("glIsEnabled")
    if context is None or not _is_known("glIsEnabled", cap):
        return None
    if cap in CLIENT_STATES:
        return is_array_enabled(context.arrays, cap)
    if cap in MAPS:
        return cap in context.evaluators.enabled
    if cap == gl.GL_INDEX_LOGIC_OP:
        return context.color_indices.logic_enabled
    return is_on(context.state, cap, context.active_unit)


@in_lists
def glHint(target: int, mode: int) -> None:
    """Set a hint; it has no effect besides what glGet returns."""
    context = outside_begin("glHint")
    modes = (gl.GL_DONT_CARE, gl.GL_FASTEST, gl.GL_NICEST)
    if context is None or not is_one_of("glHint", "mode", mode, modes, "GL_DONT_CARE, GL_FASTEST or GL_NICEST"):
        return
    if is_one_of("glHint", "target", target, HINTS, "a hint of GL 2.1 (sec. 5.6)"):
        if context.hints.get(target, gl.GL_DONT_CARE) != mode:
            context.flush()
            context.touched |= gl.GL_HINT_BIT
        context.hints[target] = int(mode)


__all__ = spelled_like_gl(globals())
