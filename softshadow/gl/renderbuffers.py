"""Renderbuffers: images that can only be attached to framebuffer objects."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import LARGEST_SIDE
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.framebuffers import attach, attachment_problem, bound_framebuffer, target_problem
from softshadow.gl.names import generate, names_argument, reserve
from softshadow.gl.texture_queries import channel_bits
from softshadow.image import DRAWN_ENCODINGS, FORMATS, WITH_STENCIL, storage_format
from softshadow.pipeline.commands import AttachRenderbuffer, DefineRenderbuffer, DeleteRenderbuffers
from softshadow.tokens import token_name

CHANNELS = {
    getattr(gl, f"GL_RENDERBUFFER_{name}_SIZE"): getattr(gl, f"GL_TEXTURE_{name}_SIZE")
    for name in ("RED", "GREEN", "BLUE", "ALPHA", "DEPTH", "STENCIL")
}


def glFramebufferRenderbuffer(target: int, attachment: int, renderbuffertarget: int, renderbuffer: int) -> None:
    """Attach a renderbuffer to the bound framebuffer object; renderbuffer 0 detaches."""
    operation, name = "glFramebufferRenderbuffer", int(renderbuffer)
    if (context := outside_begin(operation)) is None:
        return None
    if problem := target_problem(target):
        return fail(problem[0], operation, problem[1])
    if renderbuffertarget != gl.GL_RENDERBUFFER:
        return fail(
            gl.GL_INVALID_ENUM,
            operation,
            f"renderbuffertarget={token_name(renderbuffertarget)}: expected GL_RENDERBUFFER",
        )
    if name and name not in context.objects.renderbuffers:
        return fail(gl.GL_INVALID_OPERATION, operation, f"renderbuffer={name}: expected one that has been bound before")
    if problem := attachment_problem(context, target, attachment):
        return fail(problem[0], operation, problem[1])
    if name and attachment == gl.GL_DEPTH_STENCIL_ATTACHMENT:
        internal_format = context.objects.renderbuffers[name].internal_format
        if internal_format and internal_format not in WITH_STENCIL:
            message = f"renderbuffer={name}: expected depth and stencil, it is {token_name(internal_format)}"
            return fail(gl.GL_INVALID_OPERATION, operation, message)
    framebuffer = bound_framebuffer(context, target)
    attach(context, attachment, lambda point: AttachRenderbuffer(framebuffer, point, name))
    return None


def glGenRenderbuffers(n: int, renderbuffers: Any = None) -> Any:
    """Return unused renderbuffer names: an int for n = 1, else an array."""
    return generate("glGenRenderbuffers", "renderbuffer", n, renderbuffers)


def glBindRenderbuffer(target: int, renderbuffer: int) -> None:
    """Bind a renderbuffer for glRenderbufferStorage and queries."""
    if (context := outside_begin("glBindRenderbuffer")) is None:
        return None
    name = int(renderbuffer)
    if target != gl.GL_RENDERBUFFER:
        return fail(gl.GL_INVALID_ENUM, "glBindRenderbuffer", f"target={token_name(target)}: expected GL_RENDERBUFFER")
    if name and name not in context.objects.renderbuffers:
        reserve(context, "renderbuffer", name)
        context.execute(DefineRenderbuffer(name))
    context.renderbuffer = name
    return None


def glRenderbufferStorage(target: int, internalformat: int, width: int, height: int) -> None:
    """Allocate the image of the bound renderbuffer, filled with zeros."""
    operation = "glRenderbufferStorage"
    if (context := outside_begin(operation)) is None:
        return None
    if target != gl.GL_RENDERBUFFER:
        return fail(gl.GL_INVALID_ENUM, operation, f"target={token_name(target)}: expected GL_RENDERBUFFER")
    if context.renderbuffer == 0:
        return fail(gl.GL_INVALID_OPERATION, operation, "no renderbuffer is bound")
    format = FORMATS.get(internalformat)
    if format is None or internalformat in (1, 2, 3, 4) or format.encoding not in DRAWN_ENCODINGS:
        return fail(
            gl.GL_INVALID_ENUM,
            operation,
            f"internalformat={token_name(internalformat)}: expected a format of this subset",
        )
    if not (0 <= width <= LARGEST_SIDE and 0 <= height <= LARGEST_SIDE):
        return fail(gl.GL_INVALID_VALUE, operation, f"width={width}, height={height}: expected 0 to {LARGEST_SIDE}")
    stored = storage_format(internalformat)
    context.execute(DefineRenderbuffer(context.renderbuffer, stored, internalformat, width, height))
    return None


def glGetRenderbufferParameteriv(target: int, pname: int, params: Any = None) -> Any:
    """Return a property of the bound renderbuffer, an int."""
    context, operation = outside_begin("glGetRenderbufferParameteriv"), "glGetRenderbufferParameteriv"
    if context is None or not is_one_of(operation, "target", target, (gl.GL_RENDERBUFFER,), "GL_RENDERBUFFER"):
        return None
    if context.renderbuffer == 0:
        return fail(gl.GL_INVALID_OPERATION, operation, "no renderbuffer is bound")
    image = context.objects.renderbuffers[context.renderbuffer]
    answers = {
        gl.GL_RENDERBUFFER_WIDTH: image.width,
        gl.GL_RENDERBUFFER_HEIGHT: image.height,
        gl.GL_RENDERBUFFER_INTERNAL_FORMAT: image.internal_format or gl.GL_RGBA,
        **{name: channel_bits(image, size) for name, size in CHANNELS.items()},
    }
    if not is_one_of(operation, "pname", pname, answers, "GL_RENDERBUFFER_WIDTH … GL_RENDERBUFFER_STENCIL_SIZE"):
        return None
    if params is not None:
        np.asarray(params)[:1] = answers[pname]
    return answers[pname]


def glDeleteRenderbuffers(*arguments: Any) -> None:
    """Delete renderbuffers: (name), (names) or (n, names). They are detached from the bound framebuffers."""
    if (context := outside_begin("glDeleteRenderbuffers")) is None:
        return None
    names = [name for name in names_argument("glDeleteRenderbuffers", arguments) if name > 0]
    for framebuffer in {context.state.draw_framebuffer, context.state.read_framebuffer}:
        for point, attachment in list(context.objects.framebuffers[framebuffer].attachments.items()):
            if attachment.renderbuffer in names:
                context.execute(AttachRenderbuffer(framebuffer, point, 0))
    if context.renderbuffer in names:
        context.renderbuffer = 0
    existing = tuple(name for name in names if name in context.objects.renderbuffers)
    if existing:
        context.execute(DeleteRenderbuffers(existing))


def glIsRenderbuffer(renderbuffer: int) -> bool:
    """Return whether a renderbuffer of this name exists; the first glBindRenderbuffer creates it."""
    context = outside_begin("glIsRenderbuffer")
    return context is not None and int(renderbuffer) in context.objects.renderbuffers


__all__ = spelled_like_gl(globals())
