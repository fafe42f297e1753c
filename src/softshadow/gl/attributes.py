"""glPushAttrib and glPopAttrib: the groups of GL 2.1's state tables (sec. 6.2)."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, replace
from typing import Any

from softshadow import tokens as gl
from softshadow.context import Context, CurrentVertex
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.capabilities import CAPABILITIES, CLIP_PLANES, GENERATED, LIGHTS, UNIT_CAPABILITIES, is_on, switched
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.framebuffers import glDrawBuffer, glReadBuffer
from softshadow.gl.materials import follow_color
from softshadow.gl.textures import BINDINGS
from softshadow.pipeline.commands import CreateTexture, SetSampler
from softshadow.state import State
from softshadow.texture import Sampler

DEEPEST_ATTRIBUTES = 16
# bit: {group of the state: its fields that the bit saves, or all}
GROUPS: dict[int, dict[str, tuple[str, ...]]] = {
    gl.GL_COLOR_BUFFER_BIT: {"alpha": (), "blend": (), "color": ("mask", "clear", "dither")},
    gl.GL_ACCUM_BUFFER_BIT: {"color": ("clear_accum",)},
    gl.GL_DEPTH_BUFFER_BIT: {"depth": ("enabled", "func", "write", "clear")},
    gl.GL_STENCIL_BUFFER_BIT: {"stencil": ()},
    gl.GL_FOG_BIT: {"fog": ()},
    gl.GL_LIGHTING_BIT: {
        "lighting": (
            "enabled", "lights", "model_ambient", "local_viewer", "two_side", "color_control", "front", "back",
            "color_material", "color_material_face", "color_material_mode", "shade_model",
        ),
    },
    gl.GL_LINE_BIT: {"polygon": ("line_width",)},
    gl.GL_POINT_BIT: {"polygon": ("point_size",)},
    gl.GL_POLYGON_BIT: {
        "cull": (),
        "polygon": ("mode_front", "mode_back", "offset_fill", "offset_line", "offset_point", "factor", "units"),
    },
    gl.GL_SCISSOR_BIT: {"scissor": ()},
    gl.GL_TEXTURE_BIT: {"units": ()},
    gl.GL_TRANSFORM_BIT: {"clip_planes": (), "lighting": ("normalize", "rescale_normal"), "depth": ("clamp",)},
    gl.GL_VIEWPORT_BIT: {"viewport": ()},
    gl.GL_MULTISAMPLE_BIT: {"color": ("multisample",)},
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Saved:
    """What a push keeps: all of it, since a state is a reference; the mask says what the pop brings back."""

    mask: int
    state: State
    current: CurrentVertex
    hints: dict[int, int]
    matrix_mode: int
    active_unit: int
    list_base: int
    draw_buffer: int
    read_buffer: int
    samplers: dict[tuple[int, int], Sampler]  # of the bound textures, by (target, name)


@in_lists
def glPushAttrib(mask: int) -> None:
    """Keep the groups of state that `mask` names until the matching pop."""
    context = outside_begin("glPushAttrib")
    if context is None:
        return
    if len(context.attribute_stack) == DEEPEST_ATTRIBUTES:
        fail(gl.GL_STACK_OVERFLOW, "glPushAttrib", f"this stack holds {DEEPEST_ATTRIBUTES} entries")
        return
    framebuffers, state = context.storage.framebuffers, context.state
    vertex = replace(context.current, texcoords=list(context.current.texcoords))
    context.attribute_stack.append(
        Saved(
            mask=int(mask),
            state=state,
            current=vertex,
            hints=copy(context.hints),
            matrix_mode=context.matrix_mode,
            active_unit=context.active_unit,
            list_base=context.list_base,
            draw_buffer=framebuffers[state.draw_framebuffer].draw_buffer,
            read_buffer=framebuffers[state.read_framebuffer].read_buffer,
            samplers=_bound_samplers(context) if mask & gl.GL_TEXTURE_BIT else {},
        )
    )


def _bound_samplers(context: Context) -> dict[tuple[int, int], Sampler]:
    textures, found = context.storage.textures, {}
    for unit in context.state.units:
        for target, binding in BINDINGS.items():
            name = getattr(unit, binding)
            if name in textures:
                found[target, name] = textures[name].sampler
    return found


@in_lists
def glPopAttrib() -> None:
    """Bring back the groups of state of the last push."""
    context = outside_begin("glPopAttrib")
    if context is None:
        return
    if not context.attribute_stack:
        fail(gl.GL_STACK_UNDERFLOW, "glPopAttrib", "there was no glPushAttrib before it")
        return
    saved: Saved = context.attribute_stack.pop()
    state = context.state
    for bit, groups in GROUPS.items():
        if saved.mask & bit:
            for group, fields in groups.items():
                state = replace(state, **{group: _restored(getattr(state, group), getattr(saved.state, group), fields)})
    context.settle()
    context.change_state(_with_capabilities(state, saved.state) if saved.mask & gl.GL_ENABLE_BIT else state)
    _restore_the_rest(context, saved)


def _restored(now: Any, before: Any, fields: tuple[str, ...]) -> Any:
    return replace(now, **{field: getattr(before, field) for field in fields}) if fields else before


def _with_capabilities(state: State, before: State) -> State:
    """Return the state with every capability as it was before."""
    everywhere = [(cap, 0) for cap in (*CAPABILITIES, *LIGHTS, *CLIP_PLANES)]
    of_units = [(cap, unit) for cap in (*UNIT_CAPABILITIES, *GENERATED) for unit in range(len(state.units))]
    for cap, unit in (*everywhere, *of_units):
        on = is_on(before, cap, unit)
        if is_on(state, cap, unit) != on:
            state = switched(state, cap, unit, on)
    return state


def _restore_the_rest(context: Context, saved: Saved) -> None:
    """Bring back what is not in the context's state value, and what follows from it."""
    mask = saved.mask
    if mask & gl.GL_CURRENT_BIT:
        context.current = saved.current
    if mask & gl.GL_HINT_BIT:
        context.hints = saved.hints
    if mask & gl.GL_LIST_BIT:
        context.list_base = saved.list_base
    if mask & gl.GL_TRANSFORM_BIT:
        context.matrix_mode = saved.matrix_mode
    if mask & gl.GL_TEXTURE_BIT:
        context.active_unit = saved.active_unit
        for (target, name), sampler in saved.samplers.items():
            if name not in context.storage.textures:  # deleted meanwhile: binding the name makes it anew
                context.execute(CreateTexture(name, target))
            if context.storage.textures[name].sampler != sampler:
                context.execute(SetSampler(name, sampler))
    if mask & (gl.GL_CURRENT_BIT | gl.GL_ENABLE_BIT):
        follow_color(context)
    framebuffers, state = context.storage.framebuffers, context.state
    # through GL's calls: the buffer may be none of the framebuffer that is bound now, which is an error
    if mask & gl.GL_COLOR_BUFFER_BIT and framebuffers[state.draw_framebuffer].draw_buffer != saved.draw_buffer:
        glDrawBuffer(saved.draw_buffer)
    if mask & gl.GL_PIXEL_MODE_BIT and framebuffers[state.read_framebuffer].read_buffer != saved.read_buffer:
        glReadBuffer(saved.read_buffer)


__all__ = spelled_like_gl(globals())
