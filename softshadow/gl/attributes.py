"""glPushAttrib and glPopAttrib, as Mesa has them.

Mesa is less thorough than GL 2.1, sec. 6.1.14 (main/attrib.c):

- Of the groups that were pushed, it brings back those that it has seen change since.
- A pop forgets what was changed between it and its push: an outer pop does not bring it back.
- The switches of single lights come back with GL_LIGHTING_BIT, not with GL_ENABLE_BIT.
- A colour, normal, texture coordinate or material that was given since the push, and that no vertex took along, is only
  hidden: the next change of state, and the next glBegin, make it current again.
"""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass

from softshadow import tokens as gl
from softshadow.context import Context, CurrentVertex
from softshadow.framebuffer import Framebuffer
from softshadow.frozen import evolve
from softshadow.gl.attribute_groups import GROUPS, calls_made, changed_groups, with_group
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.framebuffers import glDrawBuffer, glDrawBuffers, glReadBuffer
from softshadow.gl.materials import start_to_follow
from softshadow.gl.textures import BINDINGS
from softshadow.pipeline.commands import CreateTexture, SetSampler
from softshadow.state import State
from softshadow.texture import Sampler, stored_name

DEEPEST_ATTRIBUTES = 16


@dataclass(frozen=True, eq=False)
class Saved:
    """What a push keeps: all of it, since a state is a reference; the mask says what the pop brings back.

    `touched` are the groups that had been changed since the push before.
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
    samplers: dict[tuple[int, int], Sampler]  # of the bound textures, by (target, stored name)


@in_lists
def glPushAttrib(mask: int) -> None:
    """Keep the groups of state that `mask` names until the matching pop."""
    context = outside_begin("glPushAttrib")
    if context is None:
        return
    if len(context.attribute_stack) == DEEPEST_ATTRIBUTES:
        fail(gl.GL_STACK_OVERFLOW, "glPushAttrib", f"this stack holds {DEEPEST_ATTRIBUTES} entries")
        return
    touched = _touched(context)
    if mask & (gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT):
        context.pending.read(context)
    framebuffers, state = context.storage.framebuffers, context.state
    context.attribute_stack.append(
        Saved(
            mask=int(mask),
            touched=touched,
            state=state,
            current=evolve(context.current, texcoords=list(context.current.texcoords)),
            hints=copy(context.hints),
            matrix_mode=context.matrix_mode,
            active_unit=context.active_unit,
            list_base=context.list_base,
            draw_buffers=_named(framebuffers[state.draw_framebuffer]),
            read_buffer=framebuffers[state.read_framebuffer].read_buffer,
            samplers=_bound_samplers(context) if mask & gl.GL_TEXTURE_BIT else {},
        )
    )
    context.touched, context.seen = 0, state


def _touched(context: Context) -> int:
    """Return the groups that were changed since the last push or pop."""
    return context.touched | changed_groups(context.seen, context.state)


def _bound_samplers(context: Context) -> dict[tuple[int, int], Sampler]:
    textures, found = context.storage.textures, {}
    for unit in context.state.units:
        for target, binding in BINDINGS.items():
            name = stored_name(target, getattr(unit, binding))
            if name in textures:
                found[target, name] = textures[name].sampler
            elif name <= 0:  # those named 0 are there from the beginning, but made when they are first used
                found[target, name] = Sampler()
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
    context.settle()
    saved: Saved = context.attribute_stack.pop()
    if saved.mask & gl.GL_CURRENT_BIT:
        context.pending.read(context)
    mask = saved.mask & _touched(context)
    for bit in GROUPS:
        if mask & bit:
            _bring_back(context, bit, saved)
    _bring_back_buffers(context, mask, saved)
    context.touched, context.seen = saved.touched, context.state


def _bring_back(context: Context, bit: int, saved: Saved) -> None:
    """Bring back one group; what this makes Mesa call hands on the attributes given."""
    now = context.state
    restored = with_group(bit, now, saved.state)
    if calls_made(bit, now, restored) or _sets_more(context, bit, saved):
        context.settle()
        now = context.state
    context.state = with_group(bit, now, saved.state)
    if bit == gl.GL_CURRENT_BIT:
        _bring_back_current(context, saved)
    elif bit == gl.GL_LIGHTING_BIT:
        _bring_back_materials(context, saved)
    elif bit == gl.GL_TEXTURE_BIT:
        context.active_unit = saved.active_unit
        _bring_back_samplers(context, saved)
    elif bit == gl.GL_HINT_BIT:
        context.hints = copy(saved.hints)
    elif bit == gl.GL_LIST_BIT:
        context.list_base = saved.list_base
    elif bit == gl.GL_TRANSFORM_BIT:
        context.matrix_mode = saved.matrix_mode
    elif bit == gl.GL_ENABLE_BIT and saved.state.lighting.color_material and not now.lighting.color_material:
        start_to_follow(context)


def _sets_more(context: Context, bit: int, saved: Saved) -> bool:
    """Return whether Mesa makes calls for what is not in `State`."""
    return (
        bit == gl.GL_PIXEL_MODE_BIT
        or (bit == gl.GL_COLOR_BUFFER_BIT and _sets_draw_buffer(context, saved))
        or (bit == gl.GL_HINT_BIT and context.hints != saved.hints)
        or (bit == gl.GL_TEXTURE_BIT and context.active_unit != saved.active_unit)
    )


def _bring_back_current(context: Context, saved: Saved) -> None:
    for name in context.pending.names:
        if "." not in name:
            context.pending.waiting.setdefault(name, context.attribute(name))
    context.current = evolve(saved.current, texcoords=list(saved.current.texcoords))


def _bring_back_materials(context: Context, saved: Saved) -> None:
    given = context.pending
    for name in given.names:
        if "." in name and name not in given.before:
            given.waiting.setdefault(name, context.attribute(name))
    standing = {name: context.attribute(name) for name in given.before if "." in name}
    before = saved.state.lighting
    context.state = evolve(context.state, lighting=evolve(context.state.lighting, front=before.front, back=before.back))
    for name, value in standing.items():  # given and never handed on: the one that is popped stands below it
        given.before[name] = context.attribute(name)
        context.set_attribute(name, value)


def _bring_back_samplers(context: Context, saved: Saved) -> None:
    for (target, name), sampler in saved.samplers.items():
        standing = context.storage.textures.get(name)
        if standing is None and name > 0:  # deleted meanwhile: binding the name makes it anew
            context.execute(CreateTexture(name, target))
        if sampler != (standing.sampler if standing is not None else Sampler()):
            context.execute(SetSampler(name, sampler))


def _sets_draw_buffer(context: Context, saved: Saved) -> bool:
    """Return whether Mesa chooses the draw buffers of the push anew: it compares them with the window's, always."""
    return saved.draw_buffers != _named(context.storage.window)


def _named(target: Framebuffer) -> tuple[int, ...]:
    """Return the draw buffers up to the last that is not GL_NONE."""
    return tuple(target.draw_buffer_at(i) for i in range(_last_named(target) + 1))


def _last_named(target: Framebuffer) -> int:
    return max((i for i, mode in enumerate(target.draw_buffers) if mode != gl.GL_NONE), default=0)


def _bring_back_buffers(context: Context, mask: int, saved: Saved) -> None:
    # through GL's calls: the buffer may be none of the framebuffer that is bound now, which is an error
    if mask & gl.GL_COLOR_BUFFER_BIT and _sets_draw_buffer(context, saved):
        # GL_FRONT cannot stand in glDrawBuffers, which takes single buffers only
        glDrawBuffer(saved.draw_buffers[0]) if len(saved.draw_buffers) == 1 else glDrawBuffers(saved.draw_buffers)
    if mask & gl.GL_PIXEL_MODE_BIT:
        glReadBuffer(saved.read_buffer)


__all__ = spelled_like_gl(globals())
