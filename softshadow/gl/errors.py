"""GL's errors: recorded for glGetError, and raised unless the context was made with ``raise_errors=False``."""

from __future__ import annotations

from collections.abc import Container
from numbers import Integral
from typing import Any

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.errors import SoftShadowError
from softshadow.tokens import token_name

ERROR_NAMES = (
    "GL_INVALID_ENUM", "GL_INVALID_VALUE", "GL_INVALID_OPERATION", "GL_STACK_OVERFLOW", "GL_STACK_UNDERFLOW",
    "GL_OUT_OF_MEMORY", "GL_INVALID_FRAMEBUFFER_OPERATION",
)  # fmt: skip
FIRST_DISTINCT_TOKEN = 0x100  # numbers below are shared by many tokens: GL_ZERO, GL_FALSE, GL_POINTS ...


class GLError(SoftShadowError):
    """A GL call that failed and changed nothing. PyOpenGL's own error has `err` to `result`, too.

    Attributes
    ----------
    err : int, GL's error code
    description : str, its words as gluErrorString has them; PyOpenGL: bytes, and only once the error has been printed
    baseOperation : str, the call; PyOpenGL: the function
    result : None, since a failed call has none
    operation : str, the call
    """

    result = None

    def __init__(self, err: int, operation: str, message: str) -> None:
        argument, colon, expected = message.partition(": ")
        named = colon and "=" in argument.split(" ")[0]
        said = f"{operation}({argument}): {expected}" if named else f"{operation}: {message}"
        name = token_name(err, ERROR_NAMES)
        super().__init__(f"{name}: {said}")
        self.err, self.operation, self.baseOperation = err, operation, operation
        self.description = name.removeprefix("GL_").replace("ENUM", "ENUMERANT").replace("_", " ").lower()


def fail(code: int, operation: str, message: str) -> Any:
    """Record an error and raise it, or return None where the context only records.

    `message` is "argument=value: expected ...", the value as the caller spelled it.
    """
    context = current()
    if context.error == gl.GL_NO_ERROR:  # GL keeps the first until it is asked
        context.error = code
    if context.raise_errors:
        raise GLError(code, operation, message)
    return None


def glGetError() -> int:
    """Return the first error since the last call, and forget it. Between glBegin and glEnd it is an error itself."""
    context = current()
    if context.primitive is not None:
        context.error = context.error or gl.GL_INVALID_OPERATION  # recorded only: PyOpenGL does not check this call
        return gl.GL_NO_ERROR
    code, context.error = context.error, gl.GL_NO_ERROR
    return code


def wrong_enum(operation: str, argument: str, value: Any, expected: str) -> Any:
    """Fail with GL_INVALID_ENUM for one argument."""
    is_token = isinstance(value, Integral) and int(value) >= FIRST_DISTINCT_TOKEN
    spelled = token_name(int(value)) if is_token else repr(value)
    return fail(gl.GL_INVALID_ENUM, operation, f"{argument}={spelled}: expected {expected}")


def is_one_of(operation: str, argument: str, value: Any, allowed: Container[int], expected: str) -> bool:
    """Return whether an enum argument is allowed; if not, the call has failed."""
    if value in allowed:
        return True
    wrong_enum(operation, argument, value, expected)
    return False


def outside_begin(operation: str) -> Context | None:
    """Return the current context; None when the call has failed because it stands between glBegin and glEnd."""
    context = current()
    if context.primitive is None:
        return context
    fail(gl.GL_INVALID_OPERATION, operation, "not allowed between glBegin and glEnd")
    return None


__all__ = ["GLError", "glGetError"]
