"""Which GL calls draw, ask, or belong to programs in a shading language, by their names."""

from __future__ import annotations

import re
from functools import lru_cache

DRAWS = re.compile(r"gl(Begin|Rect|Draw(?!Buffer)|MultiDraw|CallList|Bitmap|CopyPixels|EvalMesh|EvalPoint|Accum)")
QUERIES = re.compile(r"gl(Get|Is|Read|AreTexturesResident|CheckFramebufferStatus|FenceSync|ClientWaitSync|WaitSync)")
SHADERS = re.compile(
    r"gl(CreateShader|CreateProgram|ShaderSource|CompileShader|AttachShader|AttachObject|DetachShader|DetachObject"
    r"|DeleteShader|DeleteProgram|DeleteObject|LinkProgram|ValidateProgram|Uniform|ProgramUniform|VertexAttrib"
    r"|EnableVertexAttrib|DisableVertexAttrib|BindAttribLocation|BindFragDataLocation|GenPrograms|BindProgram"
    r"|ProgramString|ProgramEnvParameter|ProgramLocalParameter|ProgramParameter|PatchParameter|TransformFeedback)"
)


@lru_cache(4096)
def is_draw(name: str) -> bool:
    """Return whether a call draws, or carries out a list that may draw."""
    return DRAWS.match(name) is not None


@lru_cache(4096)
def is_query(name: str) -> bool:
    """Return whether a call only returns something."""
    return QUERIES.match(name) is not None and name != "glReadBuffer"


@lru_cache(4096)
def is_shading(name: str) -> bool:
    """Return whether a call belongs to programs in GLSL or in the older assembly languages."""
    return SHADERS.match(name) is not None
