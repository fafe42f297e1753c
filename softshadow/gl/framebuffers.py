"""Framebuffer objects: names, attachments, completeness; selection of colour buffers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.framebuffer import DEFAULT, DRAW_BUFFERS, LARGEST_SIDE, Attachment, Framebuffer
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.names import generate, names_argument, reserve
from softshadow.pipeline.commands import (
    AttachTexture,
    Command,
    CreateFramebuffer,
    DeleteFramebuffers,
    SelectBuffers,
)
from softshadow.programs.sampling import is_mipmap_complete
from softshadow.tokens import token_name

Problem = tuple[int, str]
COLOR_ATTACHMENTS = tuple(range(gl.GL_COLOR_ATTACHMENT0, gl.GL_COLOR_ATTACHMENT7 + 1))
KINDS = {gl.GL_DEPTH_ATTACHMENT: ("depth",), gl.GL_STENCIL_ATTACHMENT: ("stencil",)}
COLOR_RENDERABLE = (gl.GL_RED, gl.GL_RG, gl.GL_RGB, gl.GL_RGBA)  # GL 4.5, sec. 9.4.1; Mesa allows luminance, too
FLAT = (gl.GL_TEXTURE_2D, gl.GL_TEXTURE_RECTANGLE)  # targets of textures with one image per level
EXPECTED_TARGET = "expected GL_FRAMEBUFFER, GL_DRAW_FRAMEBUFFER or GL_READ_FRAMEBUFFER"
BUFFER_NAMES = ("GL_NONE", "GL_FRONT", "GL_BACK")
WINDOW_BUFFERS = (
    gl.GL_NONE, gl.GL_FRONT, gl.GL_BACK, gl.GL_LEFT, gl.GL_FRONT_LEFT, gl.GL_BACK_LEFT, gl.GL_FRONT_AND_BACK,
)  # fmt: skip
SEVERAL = (gl.GL_FRONT, gl.GL_LEFT, gl.GL_RIGHT, gl.GL_FRONT_AND_BACK)  # glDrawBuffers takes only single buffers
MISSING_BUFFERS = (gl.GL_RIGHT, gl.GL_FRONT_RIGHT, gl.GL_BACK_RIGHT, gl.GL_AUX0, gl.GL_AUX1, gl.GL_AUX2, gl.GL_AUX3)
BINDINGS = {
    gl.GL_FRAMEBUFFER: ("draw_framebuffer", "read_framebuffer"),
    gl.GL_DRAW_FRAMEBUFFER: ("draw_framebuffer",),
    gl.GL_READ_FRAMEBUFFER: ("read_framebuffer",),
}


# -- framebuffer objects -----------------------------------------------------------------------------------------------
def glGenFramebuffers(n: int, framebuffers: Any = None) -> Any:
    """Return unused framebuffer names: an int for n = 1, else an array."""
    return generate("glGenFramebuffers", "framebuffer", n, framebuffers)


def glBindFramebuffer(target: int, framebuffer: int) -> None:
    """Bind a framebuffer object for drawing, reading or both; 0 is the window."""
    if (context := outside_begin("glBindFramebuffer")) is None:
        return None
    name = int(framebuffer)
    if target not in BINDINGS:
        return fail(gl.GL_INVALID_ENUM, "glBindFramebuffer", f"target={token_name(target)}: {EXPECTED_TARGET}")
    if name not in context.objects.framebuffers:
        reserve(context, "framebuffer", name)
        context.execute(CreateFramebuffer(name))
    for field in BINDINGS[target]:
        context.change_field("", field, name)
    return None


def glDeleteFramebuffers(*arguments: Any) -> None:
    """Delete framebuffer objects: (name), (names) or (n, names). If one is bound, the window is bound instead."""
    if (context := outside_begin("glDeleteFramebuffers")) is None:
        return None
    names = [name for name in names_argument("glDeleteFramebuffers", arguments) if name > 0]
    for binding in BINDINGS[gl.GL_FRAMEBUFFER]:
        if getattr(context.state, binding) in names:
            context.change_field("", binding, DEFAULT)
    existing = tuple(name for name in names if name in context.objects.framebuffers)
    if existing:
        context.execute(DeleteFramebuffers(existing))


def glIsFramebuffer(framebuffer: int) -> bool:
    """Return whether a framebuffer object of this name exists; the first glBindFramebuffer creates it."""
    context = outside_begin("glIsFramebuffer")
    return context is not None and framebuffer != DEFAULT and int(framebuffer) in context.objects.framebuffers


def glFramebufferTexture2D(target: int, attachment: int, textarget: int, texture: int, level: int) -> None:
    """Attach a level of a texture to the bound framebuffer object; texture 0 detaches."""
    operation, name = "glFramebufferTexture2D", int(texture)
    if (context := outside_begin(operation)) is None:
        return None
    problem = (
        target_problem(target)
        or (_texture_problem(context, textarget, name, level) if name else None)
        or attachment_problem(context, target, attachment)
    )
    if problem:
        return fail(problem[0], operation, problem[1])
    face = textarget - gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X if name and textarget not in FLAT else 0
    framebuffer = bound_framebuffer(context, target)
    attach(context, attachment, lambda point: AttachTexture(framebuffer, point, name, face, level))
    return None


def attach(context: Context, attachment: int, command: Callable[[int], Command]) -> None:
    """Execute a command for each attachment point; GL_DEPTH_STENCIL_ATTACHMENT means two points."""
    both = attachment == gl.GL_DEPTH_STENCIL_ATTACHMENT
    for point in (gl.GL_DEPTH_ATTACHMENT, gl.GL_STENCIL_ATTACHMENT) if both else (attachment,):
        context.execute(command(point))


def bound_framebuffer(context: Context, target: int) -> int:
    """Return the name of the framebuffer bound to a target."""
    return int(getattr(context.state, BINDINGS[target][0]))


def target_problem(target: int) -> Problem | None:
    """Return (error code, message) if a target is not a framebuffer target, else None."""
    return None if target in BINDINGS else (gl.GL_INVALID_ENUM, f"target={token_name(target)}: {EXPECTED_TARGET}")


def attachment_problem(context: Context, target: int, attachment: int) -> Problem | None:
    """Return (error code, message) if nothing can be attached there, else None; `target` must be valid."""
    if bound_framebuffer(context, target) == DEFAULT:
        return gl.GL_INVALID_OPERATION, "the window is bound: its buffers cannot be replaced"
    if attachment in range(gl.GL_COLOR_ATTACHMENT7 + 1, gl.GL_COLOR_ATTACHMENT0 + 32):
        return gl.GL_INVALID_OPERATION, f"attachment={attachment:#x}: expected GL_COLOR_ATTACHMENT0 to 7"
    if attachment not in (*COLOR_ATTACHMENTS, *KINDS, gl.GL_DEPTH_STENCIL_ATTACHMENT):
        return gl.GL_INVALID_ENUM, (
            f"attachment={token_name(attachment)}: expected GL_COLOR_ATTACHMENT0 to 7, GL_DEPTH_ATTACHMENT, "
            "GL_STENCIL_ATTACHMENT or GL_DEPTH_STENCIL_ATTACHMENT"
        )
    return None


def _texture_problem(context: Context, textarget: int, name: int, level: int) -> Problem | None:
    texture = context.objects.textures.get(name)
    if texture is None:
        return gl.GL_INVALID_OPERATION, f"texture={name}: expected a texture that has been bound before"
    faces = range(gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X, gl.GL_TEXTURE_CUBE_MAP_NEGATIVE_Z + 1)
    if textarget not in FLAT and textarget not in faces:
        expected = "expected GL_TEXTURE_2D, GL_TEXTURE_RECTANGLE or a face of GL_TEXTURE_CUBE_MAP"
        return gl.GL_INVALID_ENUM, f"textarget={token_name(textarget)}: {expected}"
    if texture.target != (textarget if textarget in FLAT else gl.GL_TEXTURE_CUBE_MAP):
        kinds = f"expected a texture for {token_name(textarget)}, got a {token_name(texture.target)}"
        return gl.GL_INVALID_OPERATION, f"texture={name}: {kinds}"
    if not 0 <= level < LARGEST_SIDE.bit_length():
        return gl.GL_INVALID_VALUE, f"level={level}: expected 0 to {LARGEST_SIDE.bit_length() - 1}"
    return None


def framebuffer_status(context: Context, framebuffer: int) -> int:
    """Return the completeness status of a framebuffer, as glCheckFramebufferStatus returns it."""
    if framebuffer == DEFAULT:
        return gl.GL_FRAMEBUFFER_COMPLETE
    target = context.objects.framebuffers[framebuffer]
    attachments = target.attachments
    target.clamps = all(attachment.image.format.kind != "float" for attachment in attachments.values())
    if not all(_is_complete(context, point, attachment) for point, attachment in attachments.items()):
        return gl.GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT
    if depth_and_stencil_differ(target):
        return gl.GL_FRAMEBUFFER_UNSUPPORTED
    return gl.GL_FRAMEBUFFER_COMPLETE if attachments else gl.GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT


def can_be_drawn_to(context: Context) -> bool:
    """Return whether the draw framebuffer is complete."""
    name, stream = context.groups[""].fields["draw_framebuffer"], context.stream
    if name not in (DEFAULT, stream.complete_framebuffer):
        if framebuffer_status(context, name) != gl.GL_FRAMEBUFFER_COMPLETE:
            return False
        stream.complete_framebuffer = name
    return True


def can_draw(context: Context, operation: str) -> bool:
    """Return whether the draw framebuffer is complete; otherwise the call fails."""
    if can_be_drawn_to(context):
        return True
    name = context.groups[""].fields["draw_framebuffer"]
    fail(gl.GL_INVALID_FRAMEBUFFER_OPERATION, operation, f"framebuffer {name} is not complete")
    return False


def depth_and_stencil_differ(target: Framebuffer) -> bool:
    """Return whether depth and stencil are attached from two objects, which Gallium drivers do not support."""
    attachments = [target.attachments[point] for point in KINDS if point in target.attachments]
    return len({(each.texture, each.renderbuffer) for each in attachments}) > 1


def _shares_depth_and_stencil(target: Framebuffer) -> bool:
    """Return whether depth and stencil have the same object attached, or both nothing."""
    depth, stencil = (target.attachments.get(point) for point in KINDS)
    return (depth is None) == (stencil is None) and not depth_and_stencil_differ(target)


def _is_complete(context: Context, point: int, attachment: Attachment) -> bool:
    image, texture = attachment.image, context.objects.textures.get(attachment.texture)
    if not (image.width > 0 and image.height > 0):
        return False
    if texture is not None and attachment.level > texture.sampler.base_level and not is_mipmap_complete(texture):
        return False
    if point in KINDS:
        return image.format.kind in KINDS[point]
    return image.format.is_drawn_to and image.blocks is None and image.format.base in COLOR_RENDERABLE


def glCheckFramebufferStatus(target: int) -> int:
    """Return GL_FRAMEBUFFER_COMPLETE, or why the bound framebuffer is incomplete; 0 after an error."""
    if (context := outside_begin("glCheckFramebufferStatus")) is None:
        return 0
    if target not in BINDINGS:
        fail(gl.GL_INVALID_ENUM, "glCheckFramebufferStatus", f"target={token_name(target)}: {EXPECTED_TARGET}")
        return 0
    return framebuffer_status(context, bound_framebuffer(context, target))


def glGetFramebufferAttachmentParameteriv(target: int, attachment: int, pname: int, params: Any = None) -> Any:
    """Return a property of an attachment of the bound framebuffer object."""
    operation = "glGetFramebufferAttachmentParameteriv"
    if (context := outside_begin(operation)) is None:
        return None
    if problem := target_problem(target):
        return fail(problem[0], operation, problem[1])
    if bound_framebuffer(context, target) == DEFAULT:
        return fail(gl.GL_INVALID_ENUM, operation, "the window is bound: this subset queries only framebuffer objects")
    if problem := attachment_problem(context, target, attachment):
        return fail(problem[0], operation, problem[1])
    both, bound = attachment == gl.GL_DEPTH_STENCIL_ATTACHMENT, bound_framebuffer(context, target)
    if both and not _shares_depth_and_stencil(context.objects.framebuffers[bound]):
        return fail(gl.GL_INVALID_OPERATION, operation, "depth and stencil attachments are not the same object")
    attached = context.objects.framebuffers[bound].attachments.get(gl.GL_DEPTH_ATTACHMENT if both else attachment)
    kind = gl.GL_NONE if attached is None else gl.GL_TEXTURE if attached.texture else gl.GL_RENDERBUFFER
    answers = {gl.GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE: kind, gl.GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME: 0}
    texture_only = (gl.GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL, gl.GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_CUBE_MAP_FACE)
    if attached is None and pname in texture_only:
        return fail(gl.GL_INVALID_OPERATION, operation, f"pname={token_name(pname)}: nothing is attached there")
    if attached is not None:
        answers[gl.GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME] = attached.texture or attached.renderbuffer
    if attached is not None and attached.texture:
        cube = context.objects.textures[attached.texture].target == gl.GL_TEXTURE_CUBE_MAP
        answers[gl.GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL] = attached.level
        answers[gl.GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_CUBE_MAP_FACE] = (
            gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X + attached.face if cube else 0
        )
    if pname not in answers:
        return fail(gl.GL_INVALID_ENUM, operation, f"pname={token_name(pname)}: expected a property of this attachment")
    if params is not None:
        np.asarray(params)[:1] = answers[pname]
    return answers[pname]


# -- colour buffers ----------------------------------------------------------------------------------------------------
@in_lists
def glDrawBuffer(mode: int) -> None:
    """Select the one colour buffer of the draw framebuffer that is written, or GL_NONE."""
    _select("glDrawBuffer", "draw", int(mode))


@in_lists
def glReadBuffer(mode: int) -> None:
    """Select the colour buffer of the read framebuffer that is read."""
    _select("glReadBuffer", "read", int(mode))


@in_lists
def glDrawBuffers(*arguments: Any) -> None:
    """Select the colour buffers that are written: (buffers) or (n, buffers)."""
    operation, buffers = "glDrawBuffers", np.ravel(arguments[-1])
    if (context := outside_begin(operation)) is None:
        return None
    context.touched |= gl.GL_COLOR_BUFFER_BIT
    n = int(arguments[0]) if len(arguments) == 2 else len(buffers)
    if not 0 <= n <= DRAW_BUFFERS:
        return fail(gl.GL_INVALID_VALUE, operation, f"n={n}: expected 0 to {DRAW_BUFFERS}")
    modes = [int(mode) for mode in buffers[:n]]
    name = context.state.draw_framebuffer
    for index, mode in enumerate(modes):
        if problem := _several_problem(name, modes, index) or _buffer_problem(name, mode):
            return fail(problem[0], operation, problem[1])
    _select_buffers(context, SelectBuffers(name, draw_buffers=tuple(modes)))
    return None


def _several_problem(framebuffer: int, modes: list[int], index: int) -> Problem | None:
    """Return (error code, message) if a buffer is not allowed in a list of several, else None."""
    mode, in_window = modes[index], framebuffer == DEFAULT
    if mode == gl.GL_BACK and in_window and len(modes) > 1:
        return gl.GL_INVALID_OPERATION, "buffers=GL_BACK: expected no other buffer beside it"
    if mode in SEVERAL or (mode == gl.GL_BACK and not in_window):
        return gl.GL_INVALID_ENUM, f"buffers={token_name(mode, BUFFER_NAMES)}: expected names of single buffers"
    before = [other for other in modes[:index] if other != gl.GL_NONE]
    if mode in before or (in_window and before and mode in WINDOW_BUFFERS and mode != gl.GL_NONE):
        return gl.GL_INVALID_OPERATION, f"buffers={token_name(mode, BUFFER_NAMES)}: expected each buffer once"
    return None


def _select(operation: str, which: str, mode: int) -> None:
    if (context := outside_begin(operation)) is None:
        return None
    drawn = which == "draw"
    context.touched |= gl.GL_COLOR_BUFFER_BIT if drawn else gl.GL_PIXEL_MODE_BIT
    name = context.state.draw_framebuffer if drawn else context.state.read_framebuffer
    if problem := _buffer_problem(name, mode):
        return fail(problem[0], operation, problem[1])
    _select_buffers(context, SelectBuffers(name, (mode,)) if drawn else SelectBuffers(name, read_buffer=mode))
    return None


def _select_buffers(context: Context, command: SelectBuffers) -> None:
    """Execute a command, unless the buffers are selected already: programs select them for each picture."""
    target = context.objects.framebuffers[command.framebuffer]
    is_new = command.draw_buffers not in (None, target.draw_buffers)
    if is_new or command.read_buffer not in (None, target.read_buffer):
        context.execute(command)


def _buffer_problem(framebuffer: int, mode: int) -> Problem | None:
    """Return (error code, message) if a framebuffer has no such colour buffer, else None."""
    attachments = range(gl.GL_COLOR_ATTACHMENT0, gl.GL_COLOR_ATTACHMENT0 + 32)
    if mode not in WINDOW_BUFFERS and mode not in MISSING_BUFFERS and mode not in attachments:
        return gl.GL_INVALID_ENUM, f"mode={token_name(mode, BUFFER_NAMES)}: expected a colour buffer"
    if mode in (WINDOW_BUFFERS if framebuffer == DEFAULT else (gl.GL_NONE, *COLOR_ATTACHMENTS)):
        return None
    expected = "GL_NONE, GL_FRONT or GL_BACK" if framebuffer == DEFAULT else "GL_NONE or GL_COLOR_ATTACHMENT0 to 7"
    return gl.GL_INVALID_OPERATION, (
        f"mode={token_name(mode, BUFFER_NAMES)}: expected {expected} for framebuffer {framebuffer}"
    )


__all__ = spelled_like_gl(globals())
