"""glPushAttrib and glPopAttrib, as in Mesa.

Mesa restores less than GL 2.1, sec. 6.1.14, requires (main/attrib.c):

- A pop restores only those pushed groups that Mesa has marked as changed since the push.
- A shininess that is set for the first time marks the materials as changed, even if it is the initial one.
- A pop clears the marks made since its push, so an outer pop does not restore these changes.
- GL_LIGHTING_BIT restores whether each light is enabled; GL_ENABLE_BIT does not.
- A colour, normal, texture coordinate or material that was set since the push, but used by no vertex, is only hidden:
  the next change of state, and the next glBegin, make it current again.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

from softshadow import tokens as gl
from softshadow.context import Context, thread
from softshadow.context.color_indices import ColorIndices
from softshadow.context.evaluators import EvaluatorSettings
from softshadow.context.state_groups import Followed
from softshadow.frozen import evolve, evolve_to
from softshadow.gl.attribute_groups import BITS_OF_FIELDS, GROUPS, changed_groups, needs_calls, with_group, with_groups
from softshadow.gl.calls import is_allowed, spelled_like_gl
from softshadow.gl.errors import fail
from softshadow.gl.framebuffers import glDrawBuffer, glDrawBuffers, glReadBuffer
from softshadow.gl.materials import start_to_follow
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.pipeline.commands import CreateTexture, SetSampler
from softshadow.pixel_transfer import PixelTransfer
from softshadow.state import State, TextureUnit
from softshadow.state.texturing import BINDINGS
from softshadow.texture import Sampler, initial_sampler, stored_name

DEEPEST_ATTRIBUTES = 16
USED_BY_VERTICES = gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT  # groups that have none of the `OtherAttributes`
WITH_MATERIALS = gl.GL_LIGHTING_BIT | gl.GL_ENABLE_BIT  # groups with materials, or with whether they follow colours
WITH_BUFFERS = gl.GL_COLOR_BUFFER_BIT | gl.GL_PIXEL_MODE_BIT
NO_SAMPLERS: dict[tuple[int, int], Sampler] = {}


class OtherAttributes(NamedTuple):
    """Attributes outside `State`; calls that change one mark its group in `Context.touched`."""

    hints: dict[int, int]
    matrix_mode: int
    active_unit: int
    list_base: int
    draw_buffers: tuple[int, ...]
    read_buffer: int
    pixel_zoom: tuple[float, float]
    pixel_transfer: PixelTransfer
    color_indices: ColorIndices
    evaluators: EvaluatorSettings


class SavedAttributes(NamedTuple):
    """An entry of the attribute stack: the whole state; `mask` says which groups the pop restores.

    The stack holds plain tuples, which are made faster. The materials of `state` do not contain the colour `followed`.

    `touched` are the bits of the groups that had changed between the previous push and this one, and `current` the
    fields of `softshadow.context.CurrentVertex`. What may change is a copy, and is saved only if `mask` includes it.
    """

    mask: int
    touched: int
    state: State
    followed: Followed | None
    current: tuple[Any, ...]
    samplers: dict[tuple[int, int], Sampler]  # of the bound textures, by (target, key in the storage)
    others: OtherAttributes
    never_set: frozenset[str]  # as in `PendingAttributes`


def glPushAttrib(mask: int) -> None:
    """Save the groups of state in `mask` until the matching pop."""
    context = thread.context
    try:
        if not (context.ready or is_allowed(context, glPushAttrib, mask)):
            return
        if len(context.attribute_stack) == DEEPEST_ATTRIBUTES:
            fail(gl.GL_STACK_OVERFLOW, "glPushAttrib", f"this stack holds {DEEPEST_ATTRIBUTES} entries")
            return
        state = context.drawn_state if context.changed else context.groups[""].value
        touched, others = context.touched | context.touched_before, context.others_at_push
        if state is not context.state_at_push:
            touched, others = touched | changed_groups(context.state_at_push, state), None
        if others is None or context.touched & ~USED_BY_VERTICES:
            others = context.others_at_push = _other_attributes(context, state)
        if mask & USED_BY_VERTICES and context.pending.old_values:
            context.update_current()
            state = context.drawn_state
        current, samplers = context.current, NO_SAMPLERS
        if mask & gl.GL_TEXTURE_BIT:
            known = context.stream.bound_samplers
            samplers = (
                known[1] if known is not None and known[0] is state.units else _bound_samplers(context, state.units)
            )
        entry = (  # the fields of SavedAttributes
            mask,
            touched,
            state,
            context.state_groups.followed,
            (
                current.color,
                current.normal,
                tuple(current.texcoords),
                current.raster,
                current.edge,
                current.secondary,
                current.fog_coordinate,
                current.index,
            )
            if mask & gl.GL_CURRENT_BIT
            else (),
            samplers,
            others,
            context.pending.never_set,
        )
        context.attribute_stack.append(entry)
        context.touched, context.touched_before, context.state_at_push = 0, 0, state
    except CONVERTING as error:
        raise refusal(glPushAttrib, error, mask) from error


def _other_attributes(context: Context, state: State) -> OtherAttributes:
    framebuffers = context.objects.framebuffers
    return OtherAttributes(
        context.hints.copy(),
        context.matrix_mode,
        context.active_unit,
        context.list_base,
        framebuffers[state.draw_framebuffer].draw_buffers,
        framebuffers[state.read_framebuffer].read_buffer,
        context.pixel_zoom,
        context.pixel_transfer,
        context.color_indices,
        context.evaluators,
    )


def _bound_samplers(context: Context, units: tuple[TextureUnit, ...]) -> dict[tuple[int, int], Sampler]:
    textures, samplers = context.objects.textures, {}
    bound = ((target, getattr(unit, binding)) for target, binding in BINDINGS.items() for unit in units)
    for target, name in dict.fromkeys(bound):
        key = stored_name(target, name)
        if key in textures:
            samplers[target, key] = textures[key].sampler
        elif key <= 0:  # a default texture (name 0) always exists in GL; the storage creates it at its first use
            samplers[target, key] = initial_sampler(target)
    context.stream.bound_samplers = units, samplers
    return samplers


def glPopAttrib() -> None:
    """Restore the groups of state saved by the last push."""
    context = thread.context
    if not (context.ready or is_allowed(context, glPopAttrib)):
        return
    if not context.attribute_stack:
        fail(gl.GL_STACK_UNDERFLOW, "glPopAttrib", "there was no glPushAttrib before it")
        return
    if not context.ready:
        context.separate()
    entry = context.attribute_stack.pop()
    mask, touched = entry[0], entry[1]
    if _undo_unused(context, mask):
        context.touched_before = touched
        return
    if mask & gl.GL_CURRENT_BIT and context.pending.old_values:
        context.update_current()
    state = context.drawn_state if context.changed else context.groups[""].value
    changed = marked = context.touched | context.touched_before
    if state is not context.state_at_push:
        changed |= changed_groups(context.state_at_push, state)
    mask &= changed
    if mask:
        saved = SavedAttributes(*entry)
        if _is_simple(context, state, saved):
            _restore_at_once(context, _bits_in(mask), state, saved)
        else:
            for bit in _bits_in(mask):
                _restore(context, bit, saved)
        if mask & WITH_BUFFERS:
            _restore_buffers(context, mask, saved)
        state = context.drawn_state
    if marked & ~USED_BY_VERTICES or state is not entry[2]:
        context.others_at_push = None
    context.touched, context.touched_before, context.state_at_push = 0, touched, state


def _undo_unused(context: Context, mask: int) -> bool:
    """Undo all changes since the push, if no draw has used them and the bits of `mask` restore each of them.

    Return whether that is so; otherwise nothing is undone. No vertices may be collected.
    """
    pending, groups = context.pending, context.state_groups
    if groups.root.value is not context.state_at_push or context.touched or context.touched_before:
        return False
    if pending.names or pending.hidden or pending.old_values:
        return False
    if groups.changed:
        for group in groups.changed:
            bits, before = BITS_OF_FIELDS.get(group.field), group.value.__dict__
            if bits is None or group.parent is not groups.root:
                return False
            for field, value in group.fields.items():
                if value is not before[field] and not bits.get(field, 0) & mask:
                    return False
        groups.undo()
    return True


def _is_simple(context: Context, state: State, saved: SavedAttributes) -> bool:
    """Return whether no vertices, attributes or materials wait, and materials follow colours as before.

    Then all groups are restored together; otherwise one by one.
    """
    before, after, pending = saved.state.lighting, state.lighting, context.pending
    return (
        before.front is after.front
        and before.back is after.back
        and before.color_material == after.color_material
        and before.color_material_face == after.color_material_face
        and before.color_material_mode == after.color_material_mode
        and not (pending.names or pending.hidden)
        and not context.has_collected
    )


def _restore_at_once(context: Context, bits: tuple[int, ...], state: State, saved: SavedAttributes) -> None:
    """Restore several groups where `_is_simple`; the materials follow the colour that they followed at the push."""
    context.state = with_groups(bits, state, saved.state)
    for bit in bits:
        if bit == gl.GL_LIGHTING_BIT:
            context.state_groups.followed, context.pending.never_set = saved.followed, saved.never_set
        elif bit in OTHERS:
            OTHERS[bit](context, saved)


def _restore(context: Context, bit: int, saved: SavedAttributes) -> None:
    """Restore one group; if Mesa does it by GL calls, these flush the collected vertices first."""
    now = context.state if bit & WITH_MATERIALS else context.drawn_state
    restored = with_group(bit, now, saved.state)
    if context.has_collected and (needs_calls(bit, now, restored) or _needs_more_calls(context, bit, saved)):
        context.separate()
        now = context.state if bit & WITH_MATERIALS else context.drawn_state
        restored = with_group(bit, now, saved.state)
    if restored is not now:
        context.state = restored
    restore_others = OTHERS.get(bit)
    if restore_others is not None:
        restore_others(context, saved)
    if bit == gl.GL_ENABLE_BIT and saved.state.lighting.color_material and not now.lighting.color_material:
        start_to_follow(context)


@cache
def _bits_in(mask: int) -> tuple[int, ...]:
    """Return the bits of a mask in the order in which Mesa restores their groups."""
    return tuple(bit for bit in GROUPS if mask & bit)


def _needs_more_calls(context: Context, bit: int, saved: SavedAttributes) -> bool:
    """Return whether Mesa makes GL calls to restore what is not in `State`."""
    return (
        bit == gl.GL_PIXEL_MODE_BIT
        or (
            bit == gl.GL_COLOR_BUFFER_BIT
            and (context.color_indices != saved.others.color_indices or _sets_draw_buffer(context, saved))
        )
        or (bit == gl.GL_HINT_BIT and context.hints != saved.others.hints)
        or (bit == gl.GL_TEXTURE_BIT and context.active_unit != saved.others.active_unit)
    )


def _restore_current(context: Context, saved: SavedAttributes) -> None:
    for name in context.pending.names:
        if "." not in name:
            context.pending.hidden.setdefault(name, context.attribute(name))
    now = context.current
    (
        now.color, now.normal, now.texcoords[:], now.raster, now.edge, now.secondary, now.fog_coordinate, now.index
    ) = saved.current  # fmt: skip


def _restore_materials(context: Context, saved: SavedAttributes) -> None:
    pending, old = context.pending, context.settled(saved.state.lighting, saved.followed)
    for name in pending.names:
        if "." in name and name not in pending.old_values:
            pending.hidden.setdefault(name, context.attribute(name))
    values = {name: context.attribute(name) for name in pending.old_values if "." in name}
    state, pending.never_set = context.state, saved.never_set
    if state.lighting.front is not old.front or state.lighting.back is not old.back:
        lighting = evolve_to(old, state.lighting, front=old.front, back=old.back)
        context.state = evolve_to(saved.state, state, lighting=lighting)
    for name, value in values.items():  # a pending value stays; the restored one is the current value below it
        pending.old_values[name] = context.attribute(name)
        context.set_attribute(name, value)


def _restore_textures(context: Context, saved: SavedAttributes) -> None:
    context.select_unit(saved.others.active_unit)
    for (target, name), sampler in saved.samplers.items():
        texture = context.objects.textures.get(name)
        if texture is None and name > 0:  # deleted since the push: binding the name creates it again
            context.execute(CreateTexture(name, target))
        if sampler != (texture.sampler if texture is not None else initial_sampler(target)):
            context.execute(SetSampler(name, sampler))


def _restore_hints(context: Context, saved: SavedAttributes) -> None:
    context.hints = saved.others.hints.copy()


def _restore_list_base(context: Context, saved: SavedAttributes) -> None:
    context.list_base = saved.others.list_base


def _restore_pixel_mode(context: Context, saved: SavedAttributes) -> None:
    context.pixel_zoom = saved.others.pixel_zoom
    maps = context.pixel_transfer.maps  # which no attribute group has
    context.pixel_transfer = evolve(saved.others.pixel_transfer, maps=maps)


def _restore_matrix_mode(context: Context, saved: SavedAttributes) -> None:
    context.select_matrices(saved.others.matrix_mode)


def _restore_evaluators(context: Context, saved: SavedAttributes) -> None:
    context.evaluators = saved.others.evaluators


def _restore_color_indices(context: Context, saved: SavedAttributes) -> None:
    context.color_indices = saved.others.color_indices


def _restore_enabled(context: Context, saved: SavedAttributes) -> None:
    if context.evaluators.enabled != saved.others.evaluators.enabled:
        context.evaluators = evolve(context.evaluators, enabled=saved.others.evaluators.enabled)
    if context.color_indices.logic_enabled != saved.others.color_indices.logic_enabled:
        context.color_indices = evolve(context.color_indices, logic_enabled=saved.others.color_indices.logic_enabled)


# what is restored besides the fields of `State`
OTHERS = {
    gl.GL_CURRENT_BIT: _restore_current,
    gl.GL_LIGHTING_BIT: _restore_materials,
    gl.GL_TEXTURE_BIT: _restore_textures,
    gl.GL_HINT_BIT: _restore_hints,
    gl.GL_LIST_BIT: _restore_list_base,
    gl.GL_PIXEL_MODE_BIT: _restore_pixel_mode,
    gl.GL_TRANSFORM_BIT: _restore_matrix_mode,
    gl.GL_EVAL_BIT: _restore_evaluators,
    gl.GL_COLOR_BUFFER_BIT: _restore_color_indices,
    gl.GL_ENABLE_BIT: _restore_enabled,
}


def _sets_draw_buffer(context: Context, saved: SavedAttributes) -> bool:
    """Return whether Mesa sets the saved draw buffers: it compares them with the window's, whatever is bound."""
    before, after = saved.others.draw_buffers, context.objects.window.draw_buffers
    return before is not after and _in_use(before) != _in_use(after)


def _in_use(draw_buffers: tuple[int, ...]) -> tuple[int, ...]:
    """Return the draw buffers up to the last that is not GL_NONE."""
    if len(draw_buffers) == 1:
        return draw_buffers
    end = len(draw_buffers)
    while end > 1 and draw_buffers[end - 1] == gl.GL_NONE:
        end -= 1
    return draw_buffers[:end] or (gl.GL_NONE,)


def _restore_buffers(context: Context, mask: int, saved: SavedAttributes) -> None:
    # by GL calls: it is an error if the framebuffer that is bound now does not have the buffer
    if mask & gl.GL_COLOR_BUFFER_BIT and _sets_draw_buffer(context, saved):
        buffers = _in_use(saved.others.draw_buffers)
        # glDrawBuffers does not take GL_FRONT, which may mean several buffers
        glDrawBuffer(buffers[0]) if len(buffers) == 1 else glDrawBuffers(buffers)
    if mask & gl.GL_PIXEL_MODE_BIT:
        glReadBuffer(saved.others.read_buffer)


__all__ = spelled_like_gl(globals())
