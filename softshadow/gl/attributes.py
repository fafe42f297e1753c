"""glPushAttrib and glPopAttrib, as in Mesa.

Mesa restores less than GL 2.1, sec. 6.1.14, requires (main/attrib.c):

- A pop restores only those pushed groups that Mesa has marked as changed since the push.
- A pop clears the marks made since its push, so an outer pop does not restore these changes.
- GL_LIGHTING_BIT restores whether each light is enabled; GL_ENABLE_BIT does not.
- A colour, normal, texture coordinate or material that was set since the push, but used by no vertex, is only hidden:
  the next change of state, and the next glBegin, make it current again.
"""

from __future__ import annotations

from copy import copy
from typing import NamedTuple

from softshadow import tokens as gl
from softshadow.context import Context, CurrentVertex, thread
from softshadow.context.evaluators import EvaluatorSettings
from softshadow.framebuffer import Framebuffer
from softshadow.frozen import evolve
from softshadow.gl.attribute_groups import GROUPS, changed_groups, needs_calls, with_group
from softshadow.gl.calls import is_allowed, spelled_like_gl
from softshadow.gl.errors import fail
from softshadow.gl.framebuffers import glDrawBuffer, glDrawBuffers, glReadBuffer
from softshadow.gl.materials import start_to_follow
from softshadow.gl.textures import BINDINGS
from softshadow.pipeline.commands import CreateTexture, SetSampler
from softshadow.state import State, TextureUnit
from softshadow.texture import Sampler, stored_name

DEEPEST_ATTRIBUTES = 16
INITIAL_SAMPLER = Sampler()
_last_bound: list[tuple[tuple[TextureUnit, ...], list[tuple[int, int]]]] = [((), [])]


class SavedAttributes(NamedTuple):
    """An entry of the attribute stack: the whole state; `mask` says which groups the pop restores.

    `touched` are the bits of the groups that had changed between the previous push and this one.
    """

    mask: int
    touched: int
    state: State
    current: CurrentVertex
    hints: dict[int, int]
    matrix_mode: int
    active_unit: int
    list_base: int
    draw_buffers: tuple[int, ...]
    read_buffer: int
    pixel_zoom: tuple[float, float]
    evaluators: EvaluatorSettings
    samplers: dict[tuple[int, int], Sampler]  # of the bound textures, by (target, key in the storage)


def glPushAttrib(mask: int) -> None:
    """Save the groups of state in `mask` until the matching pop."""
    context = thread.context
    if not (context.ready or is_allowed(context, glPushAttrib, mask)):
        return
    if len(context.attribute_stack) == DEEPEST_ATTRIBUTES:
        fail(gl.GL_STACK_OVERFLOW, "glPushAttrib", f"this stack holds {DEEPEST_ATTRIBUTES} entries")
        return
    touched = _changed_since_push(context, context.state)
    if mask & (gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT) and context.pending.old_values:
        context.update_current()
    framebuffers, state = context.objects.framebuffers, context.state
    context.attribute_stack.append(
        SavedAttributes(  # in the order of its fields
            int(mask),
            touched,
            state,
            _copy_of(context.current),
            copy(context.hints) if context.hints else {},
            context.matrix_mode,
            context.active_unit,
            context.list_base,
            _draw_buffers(framebuffers[state.draw_framebuffer]),
            framebuffers[state.read_framebuffer].read_buffer,
            context.pixel_zoom,
            context.evaluators,
            _bound_samplers(context, state) if mask & gl.GL_TEXTURE_BIT else {},
        )
    )
    context.touched, context.state_at_push = 0, state


def _changed_since_push(context: Context, state: State) -> int:
    """Return the bits of the groups that have changed since the last push or pop."""
    if state is context.state_at_push:
        return context.touched
    return context.touched | changed_groups(context.state_at_push, state)


def _copy_of(current: CurrentVertex) -> CurrentVertex:
    return CurrentVertex(current.color, current.normal, current.texcoords.copy(), current.raster)


def _bound_samplers(context: Context, state: State) -> dict[tuple[int, int], Sampler]:
    textures, samplers = context.objects.textures, {}
    for target, name in _bound_names(state.units):
        if name in textures:
            samplers[target, name] = textures[name].sampler
        elif name <= 0:  # a default texture (name 0) always exists in GL; the storage creates it at its first use
            samplers[target, name] = INITIAL_SAMPLER
    return samplers


def _bound_names(units: tuple[TextureUnit, ...]) -> list[tuple[int, int]]:
    """Return target and stored name of all bound textures; the same list for the same units as in the last call."""
    known, names = _last_bound[0]
    if known is not units:
        bound = ((target, getattr(unit, binding)) for target, binding in BINDINGS.items() for unit in units)
        names = [(target, stored_name(target, name)) for target, name in dict.fromkeys(bound)]
        _last_bound[0] = units, names
    return names


def glPopAttrib() -> None:
    """Restore the groups of state saved by the last push."""
    context = thread.context
    if not (context.ready or is_allowed(context, glPopAttrib)):
        return
    if not context.attribute_stack:
        fail(gl.GL_STACK_UNDERFLOW, "glPopAttrib", "there was no glPushAttrib before it")
        return
    context.flush()
    saved: SavedAttributes = context.attribute_stack.pop()
    if saved.mask & gl.GL_CURRENT_BIT and context.pending.old_values:
        context.update_current()
    state = context.state
    mask = saved.mask & _changed_since_push(context, state)
    if mask:
        for bit in GROUPS:
            if mask & bit:
                _restore(context, bit, saved)
        _restore_buffers(context, mask, saved)
        state = context.state
    context.touched, context.state_at_push = saved.touched, state


def _restore(context: Context, bit: int, saved: SavedAttributes) -> None:
    """Restore one group; if Mesa does it by GL calls, these flush the collected vertices first."""
    now = context.state
    restored = with_group(bit, now, saved.state)
    if needs_calls(bit, now, restored) or _needs_more_calls(context, bit, saved):
        context.flush()
        now = context.state
    context.state = with_group(bit, now, saved.state)
    if bit == gl.GL_CURRENT_BIT:
        _restore_current(context, saved)
    elif bit == gl.GL_LIGHTING_BIT:
        _restore_materials(context, saved)
    elif bit == gl.GL_TEXTURE_BIT:
        context.active_unit = saved.active_unit
        _restore_samplers(context, saved)
    elif bit == gl.GL_HINT_BIT:
        context.hints = copy(saved.hints)
    elif bit == gl.GL_LIST_BIT:
        context.list_base = saved.list_base
    elif bit == gl.GL_PIXEL_MODE_BIT:
        context.pixel_zoom = saved.pixel_zoom
    elif bit == gl.GL_TRANSFORM_BIT:
        context.matrix_mode = saved.matrix_mode
    elif bit == gl.GL_EVAL_BIT:
        context.evaluators = saved.evaluators
    if bit == gl.GL_ENABLE_BIT:
        context.evaluators = evolve(context.evaluators, enabled=saved.evaluators.enabled)
    if bit == gl.GL_ENABLE_BIT and saved.state.lighting.color_material and not now.lighting.color_material:
        start_to_follow(context)


def _needs_more_calls(context: Context, bit: int, saved: SavedAttributes) -> bool:
    """Return whether Mesa makes GL calls to restore what is not in `State`."""
    return (
        bit == gl.GL_PIXEL_MODE_BIT
        or (bit == gl.GL_COLOR_BUFFER_BIT and _sets_draw_buffer(context, saved))
        or (bit == gl.GL_HINT_BIT and context.hints != saved.hints)
        or (bit == gl.GL_TEXTURE_BIT and context.active_unit != saved.active_unit)
    )


def _restore_current(context: Context, saved: SavedAttributes) -> None:
    for name in context.pending.names:
        if "." not in name:
            context.pending.hidden.setdefault(name, context.attribute(name))
    context.current = _copy_of(saved.current)


def _restore_materials(context: Context, saved: SavedAttributes) -> None:
    pending, old = context.pending, saved.state.lighting
    for name in pending.names:
        if "." in name and name not in pending.old_values:
            pending.hidden.setdefault(name, context.attribute(name))
    values = {name: context.attribute(name) for name in pending.old_values if "." in name}
    context.state = evolve(context.state, lighting=evolve(context.state.lighting, front=old.front, back=old.back))
    for name, value in values.items():  # a pending value stays; the restored one is the current value below it
        pending.old_values[name] = context.attribute(name)
        context.set_attribute(name, value)


def _restore_samplers(context: Context, saved: SavedAttributes) -> None:
    for (target, name), sampler in saved.samplers.items():
        texture = context.objects.textures.get(name)
        if texture is None and name > 0:  # deleted since the push: binding the name creates it again
            context.execute(CreateTexture(name, target))
        if sampler != (texture.sampler if texture is not None else Sampler()):
            context.execute(SetSampler(name, sampler))


def _sets_draw_buffer(context: Context, saved: SavedAttributes) -> bool:
    """Return whether Mesa sets the saved draw buffers: it compares them with the window's, whatever is bound."""
    return saved.draw_buffers != _draw_buffers(context.objects.window)


def _draw_buffers(target: Framebuffer) -> tuple[int, ...]:
    """Return the draw buffers up to the last that is not GL_NONE."""
    if len(target.draw_buffers) == 1:
        return target.draw_buffers
    last = max((i for i, mode in enumerate(target.draw_buffers) if mode != gl.GL_NONE), default=0)
    return tuple(target.draw_buffer_at(i) for i in range(last + 1))


def _restore_buffers(context: Context, mask: int, saved: SavedAttributes) -> None:
    # by GL calls: it is an error if the framebuffer that is bound now does not have the buffer
    if mask & gl.GL_COLOR_BUFFER_BIT and _sets_draw_buffer(context, saved):
        # glDrawBuffers does not take GL_FRONT, which may mean several buffers
        glDrawBuffer(saved.draw_buffers[0]) if len(saved.draw_buffers) == 1 else glDrawBuffers(saved.draw_buffers)
    if mask & gl.GL_PIXEL_MODE_BIT:
        glReadBuffer(saved.read_buffer)


__all__ = spelled_like_gl(globals())
