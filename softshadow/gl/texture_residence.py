"""Residence and priorities of textures: all are resident, and no priority has an effect.

References: GL 2.1, sec. 3.8.12; texobj.c of Mesa 22.3.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.frozen import evolve
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.textures import clamped_priority
from softshadow.pipeline.commands import SetSampler


def glAreTexturesResident(*arguments: Any) -> Any:
    """Return whether textures are resident, uint8: (textures), (textures, output), (n, textures[, output]).

    They always are. After an error of GL the numbers are those of `output`, or zeros.
    """
    if len(arguments) == 3:
        n, textures, output = arguments
    elif len(arguments) == 2 and np.ndim(arguments[0]) == 0:
        (n, textures), output = arguments, None
    elif len(arguments) in (1, 2):
        textures, output = arguments[0], arguments[1] if len(arguments) == 2 else None
        n = np.size(textures)
    else:
        raise TypeError("glAreTexturesResident: expected 1 to 3 arguments")
    names = np.ravel(np.asarray(textures))[: max(int(n), 0)].tolist()
    answer = np.zeros(max(int(n), 0), np.uint8) if output is None else np.asarray(output)
    context, operation = outside_begin("glAreTexturesResident"), "glAreTexturesResident"
    if context is None:
        return answer
    if n < 0:
        return fail(gl.GL_INVALID_VALUE, operation, f"n={n}: expected 0 or more")
    for name in names:
        if not _exists(context, int(name)):
            fail(gl.GL_INVALID_VALUE, operation, f"textures: {name} is not the name of a texture")
            return answer
    answer[...] = 1
    return answer


def _exists(context: Context, name: int) -> bool:
    return name > 0 and (name in context.objects.textures or name in context.generated_textures)


def glPrioritizeTextures(n: int, textures: Any, priorities: Any) -> None:
    """Set priorities of textures, clamped to [0, 1]; what is no name of a texture is left out."""
    count = max(int(n), 0)
    names, numbers = (np.ravel(np.asarray(values))[:count].tolist() for values in (textures, priorities))
    if len(names) < count or len(numbers) < count:
        raise ValueError(f"glPrioritizeTextures: n={n}, with {len(names)} textures and {len(numbers)} priorities")
    compiled = current().compiled_list
    is_carried_out = compiled is None or compiled.executes  # Mesa's lists record one call for each texture
    if n < 0 and is_carried_out and outside_begin("glPrioritizeTextures") is not None:
        fail(gl.GL_INVALID_VALUE, "glPrioritizeTextures", f"n={n}: expected 0 or more")
    for name, priority in zip(names, numbers, strict=True):
        _prioritize(int(name), clamped_priority(priority))


@in_lists
def _prioritize(name: int, priority: float) -> None:
    context = outside_begin("glPrioritizeTextures")
    if context is None or name <= 0:
        return
    if name in context.generated_textures:
        context.generated_textures[name] = priority
    texture = context.objects.textures.get(name)
    if texture is not None and texture.sampler.priority != priority:
        context.touched |= gl.GL_TEXTURE_BIT
        context.execute(SetSampler(name, evolve(texture.sampler, priority=priority)))


__all__ = spelled_like_gl(globals())
